//! Scalars that begin where a cache line does.

use std::ops::{Deref, DerefMut};

const LINE: usize = 8;

#[derive(Clone, Copy)]
#[repr(C, align(64))]
struct Line([f64; LINE]);

/// So many zeros at first, in whole cache lines.
pub(super) struct Buffer(Vec<Line>);

impl Buffer {
    /// At least `len` scalars. `None` where there is no memory.
    pub(super) fn new(len: usize) -> Option<Self> {
        let lines = len.div_ceil(LINE);
        let mut memory = Vec::new();
        memory.try_reserve_exact(lines).ok()?;
        memory.resize(lines, Line([0.0; LINE]));
        Some(Self(memory))
    }

    /// Bytes that so many scalars take.
    pub(super) const fn bytes(len: usize) -> u64 {
        (len.div_ceil(LINE) * size_of::<Line>()) as u64
    }
}

impl Deref for Buffer {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        // SAFETY: a line is eight scalars and nothing else.
        unsafe { std::slice::from_raw_parts(self.0.as_ptr().cast(), LINE * self.0.len()) }
    }
}

impl DerefMut for Buffer {
    fn deref_mut(&mut self) -> &mut [f64] {
        // SAFETY: as above.
        unsafe { std::slice::from_raw_parts_mut(self.0.as_mut_ptr().cast(), LINE * self.0.len()) }
    }
}
