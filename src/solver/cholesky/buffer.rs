//! Arrays of scalars aligned to cache lines.

use std::ops::{Deref, DerefMut};

use crate::memory::bytes;
use crate::simd::lanes::Scalar;

/// Bytes of a cache line, and of the widest vectors.
const LINE: usize = 64;

/// An aligned array of scalars whose values are unspecified after [`Buffer::resize`].
#[derive(Default)]
pub(super) struct Buffer<T> {
    memory: Vec<T>,
    len: usize,
}

impl<T: Scalar> Buffer<T> {
    /// Scalars that may have to be skipped to reach the next cache line.
    const SLACK: usize = LINE / size_of::<T>() - 1;

    /// Makes it `len` scalars long, with unspecified values. False where the allocation failed: then it is empty.
    pub(super) fn resize(&mut self, len: usize) -> bool {
        if self.memory.len() < len + Self::SLACK {
            // The old values are not needed, so they are freed first: both arrays are never held at once.
            *self = Self::default();
            if Vec::<T>::new().try_reserve_exact(len + Self::SLACK).is_err() {
                return false;
            }
            // Zeros from the system cost nothing before they are touched.
            self.memory = vec![T::default(); len + Self::SLACK];
        }
        self.len = len;
        true
    }

    /// Bytes held.
    pub(super) fn memory(&self) -> u64 {
        bytes(&self.memory)
    }

    /// Bytes held after a resize to `len` scalars.
    pub(super) fn memory_for(&self, len: usize) -> u64 {
        self.memory().max(((len + Self::SLACK) * size_of::<T>()) as u64)
    }

    fn start(&self) -> usize {
        self.memory.as_ptr().align_offset(LINE).min(Self::SLACK)
    }
}

impl<T: Scalar> Deref for Buffer<T> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        if self.len == 0 { &[] } else { &self.memory[self.start()..][..self.len] }
    }
}

impl<T: Scalar> DerefMut for Buffer<T> {
    fn deref_mut(&mut self) -> &mut [T] {
        let start = self.start();
        if self.len == 0 { &mut [] } else { &mut self.memory[start..][..self.len] }
    }
}
