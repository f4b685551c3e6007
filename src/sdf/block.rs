//! A block: the nodes of 8^3 cells of the lattice, computed when first needed and read without a lock.

use std::cell::UnsafeCell;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use super::volume::BLOCK;

/// Nodes along one side: a cell's spline needs four of them, so the last ones are stored in the next block as well. Thus
/// all the nodes of a cell are in one block.
pub(super) const SIDE: usize = BLOCK + 3;

/// Nodes in a block.
const NODES: usize = SIDE * SIDE * SIDE;

/// A node not yet computed: not a number, whose sign bit is already that of the distance, negative inside.
const UNKNOWN: f32 = f32::NAN;

/// A block: signed distances at its nodes.
#[derive(Debug)]
pub(super) struct Block {
    /// A bit for each cell, set once its 4^3 nodes are known. Neither is ever cleared.
    known: [AtomicU64; BLOCK],
    nodes: UnsafeCell<[f32; NODES]>,
    /// Locked to write nodes, or to read nodes that may be unknown.
    filling: Mutex<()>,
    /// A triangle close to the block's centre, for the search tree.
    pub hint: u32,
}

// SAFETY: nodes are written only under the lock and only while they are unknown, so once each and before the first bit
// of a cell that holds them is set (release). Without the lock they are read only after that bit was seen (acquire).
unsafe impl Sync for Block {}

/// The 4^3 known nodes around a cell of a block.
#[derive(Clone, Copy)]
pub(super) struct Known<'a> {
    block: &'a Block,
    first: usize,
}

impl Block {
    /// A block without any distance; `inside` gives the sign of each node.
    pub fn new(inside: impl Fn([usize; 3]) -> bool, hint: u32) -> Self {
        let node = |n: usize| UNKNOWN.copysign(if inside(coordinates(n, SIDE)) { -1.0 } else { 1.0 });
        Self {
            known: Default::default(),
            nodes: UnsafeCell::new(std::array::from_fn(node)),
            filling: Mutex::new(()),
            hint,
        }
    }

    /// The nodes around a cell, once all of them are known. Coordinates are taken modulo the block, here as below.
    #[inline(always)]
    pub fn known(&self, cell: [usize; 3]) -> Option<Known<'_>> {
        let [i, j, k] = cell.map(|c| c % BLOCK);
        let known = self.known[i].load(Ordering::Acquire) & bit(j, k) != 0;
        known.then(|| Known { block: self, first: node_index([i, j, k]) })
    }

    /// The unknown ones among the nodes around a cell: bit n stands for the n-th of the 4^3.
    pub fn missing(&self, cell: [usize; 3]) -> u64 {
        let _filling = self.lock();
        // SAFETY: the lock is held.
        (0..64).filter(|&n| unsafe { *self.around(cell, n) }.is_nan()).fold(0, |bits, n| bits | 1 << n)
    }

    /// The distance at a node, where it is known; without a sign.
    pub fn node(&self, at: [usize; 3]) -> Option<f32> {
        debug_assert!(at.iter().all(|&c| c < SIDE));
        let _filling = self.lock();
        // SAFETY: the lock is held.
        let value = unsafe { *self.nodes.get().cast::<f32>().add(node_index(at.map(|c| c.min(SIDE - 1)))) };
        (!value.is_nan()).then_some(value.abs())
    }

    /// Stores `distances`, without a sign, at those of the 4^3 nodes around a cell that are unknown: now all are known.
    pub fn complete(&self, cell: [usize; 3], distances: &[f32; 64]) -> Known<'_> {
        let _filling = self.lock();
        for (n, &distance) in distances.iter().enumerate() {
            let node = self.around(cell, n);
            // SAFETY: the lock is held.
            unsafe {
                if (*node).is_nan() {
                    // A distance that is not a number must not look like an unknown one.
                    *node = distance.min(f32::INFINITY).copysign(*node);
                }
            }
        }
        let [i, j, k] = cell.map(|c| c % BLOCK);
        self.known[i].fetch_or(bit(j, k), Ordering::Release);
        Known { block: self, first: node_index([i, j, k]) }
    }

    /// The n-th of the 4^3 nodes around a cell.
    fn around(&self, cell: [usize; 3], n: usize) -> *mut f32 {
        let step = coordinates(n % 64, 4);
        let at = [0, 1, 2].map(|a| cell[a] % BLOCK + step[a]);
        // SAFETY: coordinates below 8 + 3 are within the array.
        unsafe { self.nodes.get().cast::<f32>().add(node_index(at)) }
    }

    /// A panic under the lock leaves each node either unknown or known, so poisoning is ignored.
    fn lock(&self) -> MutexGuard<'_, ()> {
        self.filling.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Known<'_> {
    /// Nodes (i, j, 0..4), for i and j below 4.
    #[inline(always)]
    pub fn row(self, i: usize, j: usize) -> [f32; 4] {
        debug_assert!(i < 4 && j < 4);
        // SAFETY: a cell's coordinates are below 8, so the row is within the array; its nodes are known and so are never
        // written again. The pointer does not pass through a reference to the array, of which others may be written.
        unsafe {
            self.block.nodes.get().cast::<f32>().add(self.first + node_index([i, j, 0])).cast::<[f32; 4]>().read()
        }
    }
}

/// Bit of cell (j, k) in its word.
#[inline(always)]
fn bit(j: usize, k: usize) -> u64 {
    1 << (j * BLOCK + k)
}

/// Index of a node in its block.
#[inline(always)]
fn node_index([i, j, k]: [usize; 3]) -> usize {
    (i * SIDE + j) * SIDE + k
}

/// The coordinates of entry `n` in a cube of the given side.
#[inline]
fn coordinates(n: usize, side: usize) -> [usize; 3] {
    [n / (side * side), (n / side) % side, n % side]
}
