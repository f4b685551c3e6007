//! Lists that a caller has room for.

use crate::capi::view::invalid;
use crate::error::Result;

/// Where a list goes: to a caller who may have room for some of it only, and asks how long it is.
pub(super) struct List<T> {
    data: *mut T,
    capacity: usize,
    count: *mut usize,
}

impl<T> List<T> {
    /// `name`: for the message where there is room at null, which is refused before anything is computed.
    ///
    /// # Safety
    /// `data`: null, or to be written, `capacity` elements of any alignment; `count`: null, or to be written. Both for as long as the
    /// list is there.
    pub(super) unsafe fn new(data: *mut T, capacity: usize, count: *mut usize, name: &str) -> Result<Self> {
        if data.is_null() && capacity > 0 {
            return invalid(format!("{name}: the pointer is null, with room for {capacity}"));
        }
        Ok(Self { data, capacity, count })
    }

    /// Says how many there are, and writes the first that fit.
    pub(super) fn write(self, elements: impl ExactSizeIterator<Item = T>) {
        if !self.count.is_null() {
            // SAFETY: the caller of `new` vouches for it.
            unsafe { self.count.write(elements.len()) };
        }
        for (k, element) in elements.take(self.capacity).enumerate() {
            // SAFETY: it is one of `capacity` elements, for which the caller of `new` vouches.
            unsafe { self.data.add(k).write_unaligned(element) };
        }
    }
}
