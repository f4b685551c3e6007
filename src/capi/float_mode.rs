//! The floating-point mode of the caller's thread: set to IEEE 754's default during a call, and put back.
//!
//! Hosts change it: audio and animation threads flush subnormal numbers to zero, some round otherwise or trap what is
//! inexact. The exact predicates hold in the default mode only, and equal bits need equal modes. Threads that are started
//! during a call inherit its mode.

/// The default mode, until it is dropped.
pub(super) struct DefaultMode {
    before: register::Mode,
}

impl DefaultMode {
    /// Remembers the mode of this thread and sets the default.
    pub(super) fn enter() -> Self {
        let before = register::read();
        if before != register::DEFAULT {
            register::write(register::DEFAULT);
        }
        Self { before }
    }
}

impl Drop for DefaultMode {
    fn drop(&mut self) {
        // Compared again: the work in between may have raised flags, which the host is not to find.
        if register::read() != self.before {
            register::write(self.before);
        }
    }
}

/// MXCSR: rounding, masks and flags of exceptions, subnormal numbers.
#[cfg(target_arch = "x86_64")]
mod register {
    use std::arch::asm;

    pub(super) type Mode = u32;

    /// Round to nearest, all exceptions masked, no flag raised, subnormal numbers as they are.
    pub(super) const DEFAULT: Mode = 0x1F80;

    pub(super) fn read() -> Mode {
        let mut mode: Mode = 0;
        // SAFETY: every x86-64 processor has the register; its 32 bits are stored in `mode`, and nothing else changes.
        unsafe { asm!("stmxcsr [{}]", in(reg) &raw mut mode, options(nostack, preserves_flags)) };
        mode
    }

    pub(super) fn write(mode: Mode) {
        // SAFETY: what is loaded is the default or what `read` gave, so no reserved bit is set. Between the two this thread
        // runs in the default mode, which is the one that compiled code relies on.
        unsafe { asm!("ldmxcsr [{}]", in(reg) &raw const mode, options(nostack, preserves_flags, readonly)) };
    }
}

/// FPCR: rounding, traps, subnormal numbers.
#[cfg(target_arch = "aarch64")]
mod register {
    use std::arch::asm;

    pub(super) type Mode = u64;

    /// Round to nearest, no traps, subnormal numbers as they are.
    pub(super) const DEFAULT: Mode = 0;

    pub(super) fn read() -> Mode {
        let mode: Mode;
        // SAFETY: every AArch64 processor lets programs read the register.
        unsafe { asm!("mrs {}, fpcr", out(reg) mode, options(nostack, nomem, preserves_flags)) };
        mode
    }

    pub(super) fn write(mode: Mode) {
        // SAFETY: what is written is the default or what `read` gave. Between the two this thread runs in the default mode,
        // which is the one that compiled code relies on.
        unsafe { asm!("msr fpcr, {}", in(reg) mode, options(nostack, preserves_flags)) };
    }
}

/// No such register is known: the mode stays as it is.
#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
mod register {
    pub(super) type Mode = ();

    pub(super) const DEFAULT: Mode = ();

    pub(super) fn read() -> Mode {}

    pub(super) fn write(_: Mode) {}
}
