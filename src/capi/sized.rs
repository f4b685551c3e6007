//! Structs that carry their own size, so that programs and libraries of different versions stay compatible.

use std::mem::{align_of, size_of};

use crate::error::{Error, ErrorKind, Result};

/// A struct whose first field is its `struct_size`.
///
/// # Safety
/// `repr(C)`, begins with a `u32`, has no padding, and any bit pattern is a value of it, all zeros included.
pub(super) unsafe trait Sized32: Copy {
    /// The smallest size that is accepted: that of the struct as it first was in this version of the binary interface.
    const FIRST_SIZE: usize = size_of::<Self>();
}

fn declared_size(pointer: *const u8, name: &str) -> Result<usize> {
    if pointer.is_null() {
        return Err(Error::new(ErrorKind::InvalidArgument, format!("{name}: the pointer is null")));
    }
    // SAFETY: not null, and the caller vouches for a struct that begins with a 32-bit size.
    let size = unsafe { pointer.cast::<u32>().read_unaligned() } as usize;
    Ok(size)
}

fn check_size<T: Sized32>(size: usize, name: &str) -> Result<()> {
    if size < T::FIRST_SIZE {
        return Err(Error::new(
            ErrorKind::InvalidArgument,
            format!("{name}: struct_size is {size}; set it to sizeof of the struct, which is {}", size_of::<T>()),
        ));
    }
    Ok(())
}

/// A copy of the caller's struct. What a shorter one, from an earlier header, lacks is zero. A longer one, from a later
/// header, is accepted where all it adds is zero.
///
/// # Safety
/// `pointer` is null or points to as many readable bytes as its first field says.
pub(super) unsafe fn read<T: Sized32>(pointer: *const T, name: &str) -> Result<T> {
    let bytes = pointer.cast::<u8>();
    let size = declared_size(bytes, name)?;
    check_size::<T>(size, name)?;
    for k in size_of::<T>()..size {
        // SAFETY: the caller vouches for `size` readable bytes.
        if unsafe { bytes.add(k).read() } != 0 {
            return Err(Error::new(
                ErrorKind::InvalidArgument,
                format!(
                    "{name}: byte {k} is set, which this version of the library ({} bytes) does not know",
                    size_of::<T>()
                ),
            ));
        }
    }
    let mut value = std::mem::MaybeUninit::<T>::zeroed();
    // SAFETY: the caller vouches for `size` readable bytes, and any bit pattern is a `T`, all zeros included.
    unsafe {
        std::ptr::copy_nonoverlapping(bytes, value.as_mut_ptr().cast(), size.min(size_of::<T>()));
        Ok(value.assume_init())
    }
}

/// Fills the caller's struct, all but its `struct_size`, as far as it goes. What a longer one, from a later header, adds
/// becomes zero.
///
/// # Safety
/// `pointer` is null or points to as many readable and writable bytes as its first field says.
pub(super) unsafe fn write<T: Sized32>(value: T, pointer: *mut T, name: &str) -> Result<()> {
    let size = declared_size(pointer.cast(), name)?;
    check_size::<T>(size, name)?;
    // SAFETY: passed on from the caller.
    unsafe { fill(value, pointer.cast(), size) };
    Ok(())
}

/// Fills the first of the caller's `capacity` structs, one after the other, each as large as the first says and as
/// [`write`] fills it, with `values`, and sets the `struct_size` of each.
///
/// # Safety
/// `pointer` is null or points to `capacity` times as many readable and writable bytes as its first field says.
pub(super) unsafe fn write_all<T: Sized32>(
    values: impl Iterator<Item = T>,
    pointer: *mut T,
    capacity: usize,
    name: &str,
) -> Result<()> {
    if capacity == 0 {
        return Ok(());
    }
    let size = declared_size(pointer.cast(), name)?;
    check_size::<T>(size, name)?;
    if !size.is_multiple_of(align_of::<T>()) {
        return Err(Error::new(
            ErrorKind::InvalidArgument,
            format!("{name}: struct_size is {size}; the structs of an array have a multiple of {}", align_of::<T>()),
        ));
    }
    for (k, value) in values.take(capacity).enumerate() {
        // SAFETY: the caller vouches for `capacity` structs of `size` bytes, of which this is one.
        unsafe {
            let to = pointer.cast::<u8>().add(k * size);
            to.cast::<u32>().write_unaligned(size as u32);
            fill(value, to, size);
        }
    }
    Ok(())
}

/// # Safety
/// `to` points to `size` writable bytes.
unsafe fn fill<T: Sized32>(value: T, to: *mut u8, size: usize) {
    let from = (&raw const value).cast::<u8>();
    let skip = size_of::<u32>();
    let known = size.min(size_of::<T>());
    // SAFETY: `value` holds `size_of::<T>()` bytes and the caller's struct `size`, both at least `known`, without overlap.
    unsafe {
        std::ptr::copy_nonoverlapping(from.add(skip), to.add(skip), known - skip);
        std::ptr::write_bytes(to.add(known), 0, size - known);
    }
}
