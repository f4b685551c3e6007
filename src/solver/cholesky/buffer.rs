//! Arrays of scalars aligned to cache lines.

use std::ops::{Deref, DerefMut};

use crate::memory::bytes;

/// Bytes of a cache line, and of the widest vectors.
const LINE: usize = 64;
/// Scalars that may have to be skipped to reach the next cache line.
const SLACK: usize = LINE / size_of::<f64>() - 1;

/// An aligned array of scalars whose values are unspecified after [`Buffer::resize`].
#[derive(Default)]
pub(super) struct Buffer {
    memory: Vec<f64>,
    len: usize,
}

impl Buffer {
    /// Makes it `len` scalars long, with unspecified values. False where the allocation failed: then it is empty.
    pub(super) fn resize(&mut self, len: usize) -> bool {
        if self.memory.len() < len + SLACK {
            // The old values are not needed, so they are freed first: both arrays are never held at once.
            *self = Self::default();
            if Vec::<f64>::new().try_reserve_exact(len + SLACK).is_err() {
                return false;
            }
            // Zeros from the system cost nothing before they are touched.
            self.memory = vec![0.0; len + SLACK];
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
        self.memory().max(((len + SLACK) * size_of::<f64>()) as u64)
    }

    fn start(&self) -> usize {
        self.memory.as_ptr().align_offset(LINE).min(SLACK)
    }
}

impl Deref for Buffer {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        if self.len == 0 { &[] } else { &self.memory[self.start()..][..self.len] }
    }
}

impl DerefMut for Buffer {
    fn deref_mut(&mut self) -> &mut [f64] {
        let start = self.start();
        if self.len == 0 { &mut [] } else { &mut self.memory[start..][..self.len] }
    }
}
