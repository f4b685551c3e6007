//! Structs that carry their own size, so that a program and a library of different age understand each other.

use std::mem::size_of;

use crate::error::{Error, ErrorKind, Result};

/// A struct whose first field is its `struct_size`.
///
/// # Safety
/// `repr(C)`, begins with a `u32`, has no padding, and any bit pattern is a value of it, all zeros included.
pub(super) unsafe trait Sized32: Copy {}

fn declared_size(pointer: *const u8, what: &str) -> Result<usize> {
    if pointer.is_null() {
        return Err(Error::new(ErrorKind::InvalidArgument, format!("{what}: the pointer is null")));
    }
    // SAFETY: not null, and the caller vouches for a struct that begins with a 32-bit size.
    let size = unsafe { pointer.cast::<u32>().read_unaligned() } as usize;
    Ok(size)
}

fn check_size<T>(size: usize, what: &str) -> Result<()> {
    if size < size_of::<T>() {
        return Err(Error::new(
            ErrorKind::InvalidArgument,
            format!("{what}: struct_size is {size}; set it to sizeof of the struct, which is {}", size_of::<T>()),
        ));
    }
    Ok(())
}

/// A copy of the caller's struct. A longer one, from a later header, is accepted where all it adds is zero.
///
/// # Safety
/// `pointer` is null or points to as many readable bytes as its first field says.
pub(super) unsafe fn read<T: Sized32>(pointer: *const T, what: &str) -> Result<T> {
    let bytes = pointer.cast::<u8>();
    let size = declared_size(bytes, what)?;
    check_size::<T>(size, what)?;
    for k in size_of::<T>()..size {
        // SAFETY: the caller vouches for `size` readable bytes.
        if unsafe { bytes.add(k).read() } != 0 {
            return Err(Error::new(
                ErrorKind::InvalidArgument,
                format!(
                    "{what}: byte {k} is set, which this version of the library ({} bytes) does not know",
                    size_of::<T>()
                ),
            ));
        }
    }
    // SAFETY: at least `size_of::<T>()` readable bytes, and any bit pattern is a `T`.
    Ok(unsafe { pointer.read_unaligned() })
}

/// Fills the caller's struct, all but its `struct_size`. What a longer one, from a later header, adds becomes zero.
///
/// # Safety
/// `pointer` is null or points to as many readable and writable bytes as its first field says.
pub(super) unsafe fn write<T: Sized32>(value: T, pointer: *mut T, what: &str) -> Result<()> {
    let size = declared_size(pointer.cast(), what)?;
    check_size::<T>(size, what)?;
    let from = (&raw const value).cast::<u8>();
    let to = pointer.cast::<u8>();
    let skip = size_of::<u32>();
    // SAFETY: both sides hold `size_of::<T>()` bytes, the caller's at least `size`, and they are apart.
    unsafe {
        std::ptr::copy_nonoverlapping(from.add(skip), to.add(skip), size_of::<T>() - skip);
        std::ptr::write_bytes(to.add(size_of::<T>()), 0, size - size_of::<T>());
    }
    Ok(())
}
