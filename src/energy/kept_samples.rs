//! Samples of the distance field that are kept: a Newton step asks for the derivatives where the line search of the step
//! before has asked for the value, and the gradient beside a value costs hardly more than the value.

use std::ops::Range;
use std::sync::{RwLock, RwLockReadGuard, RwLockWriteGuard};

use glam::DVec3;

use crate::memory::bytes;

/// Elements whose samples are kept under one lock.
const BLOCK: usize = 32;

/// Distance and gradient at a point.
pub(super) type FieldSample = (f64, DVec3);

/// What was sampled last, for each element of a fit term.
#[derive(Debug)]
pub(super) struct KeptSamples {
    blocks: Vec<RwLock<Block>>,
}

/// The same for consecutive elements.
#[derive(Debug)]
pub(super) struct Block {
    /// Where the corners of each element were; not a number before it was sampled.
    corners: Vec<[DVec3; 3]>,
    /// The samples of all of them.
    samples: Vec<FieldSample>,
    /// The first of these among the samples of all elements.
    first: usize,
}

impl Block {
    /// The samples of the element that is the `k`-th of the block, whose own are `own` among those of all elements; to be
    /// filled for `corners`.
    pub(super) fn replace(&mut self, k: usize, corners: [DVec3; 3], own: Range<usize>) -> &mut [FieldSample] {
        self.corners[k] = corners;
        &mut self.samples[own.start - self.first..own.end - self.first]
    }

    /// The same samples, where they were taken for `corners`.
    pub(super) fn get(&self, k: usize, corners: [DVec3; 3], own: Range<usize>) -> Option<&[FieldSample]> {
        (self.corners[k] == corners).then(|| &self.samples[own.start - self.first..own.end - self.first])
    }
}

impl KeptSamples {
    /// Room for elements of which each has so many samples.
    pub(super) fn new(counts: impl Iterator<Item = usize>) -> Self {
        let mut blocks = Vec::new();
        let mut first = 0;
        let counts: Vec<usize> = counts.collect();
        for counts in counts.chunks(BLOCK) {
            let samples: usize = counts.iter().sum();
            blocks.push(RwLock::new(Block {
                corners: vec![[DVec3::NAN; 3]; counts.len()],
                samples: vec![(0.0, DVec3::ZERO); samples],
                first,
            }));
            first += samples;
        }
        Self { blocks }
    }

    /// Bytes held.
    pub(super) fn memory(&self) -> u64 {
        // Lists that are as long as at the beginning, whoever fills them now.
        let held =
            |block: &RwLock<Block>| block.read().map_or(0, |block| bytes(&block.corners) + bytes(&block.samples));
        bytes(&self.blocks) + self.blocks.iter().map(held).sum::<u64>()
    }

    /// The blocks that a range of elements lies in, each with its part of the range and its first element.
    pub(super) fn parts(range: Range<usize>) -> impl Iterator<Item = (usize, Range<usize>, usize)> {
        (range.start / BLOCK..range.end.div_ceil(BLOCK)).map(move |block| {
            let first = block * BLOCK;
            (block, range.start.max(first)..range.end.min(first + BLOCK), first)
        })
    }

    /// A block to be read; none while another thread fills it.
    pub(super) fn read(&self, block: usize) -> Option<RwLockReadGuard<'_, Block>> {
        self.blocks[block].try_read().ok()
    }

    /// A block to be filled; none while another thread uses it.
    pub(super) fn write(&self, block: usize) -> Option<RwLockWriteGuard<'_, Block>> {
        self.blocks[block].try_write().ok()
    }
}
