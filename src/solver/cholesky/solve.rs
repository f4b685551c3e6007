//! Triangular solves: forward substitution from the leaves of the tree to its root, backward substitution from the root
//! to the leaves.
//!
//! In the forward pass a front's vector is kept in the place of its contribution block; its parent adds the entries
//! below the front's columns by the same relative indices. In the backward pass a front reads the solution at its
//! ancestors' columns, which are done.

use std::sync::atomic::{AtomicU64, Ordering};

use super::numeric::{dependency_regions, split_region};
use super::substitution;
use super::symbolic::Symbolic;
use crate::simd::lanes::Scalar;

/// A solve for up to [`super::MAX_RHS`] right-hand sides.
pub(super) struct Solve<'a, T> {
    pub symbolic: &'a Symbolic,
    /// The factor.
    pub values: &'a [T],
    /// Bits of the right-hand sides, then of the solutions, `columns` for each position in the elimination order. Each
    /// is written by the one task that eliminates it, and read by tasks that are ordered after it.
    pub x: &'a [AtomicU64],
    pub columns: usize,
}

impl<T: Scalar> Solve<'_, T> {
    pub(super) fn run(&self, work: &mut [T]) {
        if let Some(last) = self.symbolic.tasks.len().checked_sub(1) {
            self.forward_task(last, work);
            self.backward_task(last, work);
        }
    }

    #[inline]
    fn get(&self, row: usize, column: usize) -> T {
        T::nearest(f64::from_bits(self.x[row * self.columns + column].load(Ordering::Relaxed)))
    }

    #[inline]
    fn set(&self, row: usize, column: usize, value: T) {
        self.x[row * self.columns + column].store(value.widened().to_bits(), Ordering::Relaxed);
    }

    fn forward_task(&self, t: usize, work: &mut [T]) {
        let task = &self.symbolic.tasks[t];
        if !task.dependencies.is_empty() {
            rayon::scope(|scope| {
                for (&b, work) in task.dependencies.iter().zip(dependency_regions(self.symbolic, task, work)) {
                    scope.spawn(move |_| self.forward_task(b, work));
                }
            });
        }
        for s in task.nodes.clone() {
            let node = &self.symbolic.nodes[s];
            let region = &mut work[node.region.start - task.region.start..][..node.region.len()];
            self.forward_front(s, region);
        }
    }

    fn forward_front(&self, s: usize, region: &mut [T]) {
        let node = &self.symbolic.nodes[s];
        let (children, contribution) = split_region(node, region);
        let panel = &self.values[node.panel..][..node.panel_len()];
        for column in 0..self.columns {
            let vector = &mut contribution[column * node.ld..][..node.ld];
            for (k, value) in vector[..node.columns].iter_mut().enumerate() {
                *value = self.get(node.first + k, column);
            }
            vector[node.columns..].fill(T::default());
            for child in self.symbolic.children(s) {
                let from = &children.vector(child, column)[child.columns..][..child.rows];
                for (index, value) in self.symbolic.relative_indices(child).iter().zip(from.as_chunks::<3>().0) {
                    let to = &mut vector[3 * *index as usize..][..3];
                    to[0] += value[0];
                    to[1] += value[1];
                    to[2] += value[2];
                }
            }
            substitution::forward(panel, node.ld, node.columns, vector);
            for (k, value) in vector[..node.columns].iter().enumerate() {
                self.set(node.first + k, column, *value);
            }
        }
    }

    fn backward_task(&self, t: usize, work: &mut [T]) {
        let task = &self.symbolic.tasks[t];
        for s in task.nodes.clone().rev() {
            let node = &self.symbolic.nodes[s];
            self.backward_front(s, &mut work[node.contribution.start - task.region.start..][..node.contribution.len()]);
        }
        if !task.dependencies.is_empty() {
            rayon::scope(|scope| {
                for (&b, work) in task.dependencies.iter().zip(dependency_regions(self.symbolic, task, work)) {
                    scope.spawn(move |_| self.backward_task(b, work));
                }
            });
        }
    }

    fn backward_front(&self, s: usize, contribution: &mut [T]) {
        let node = &self.symbolic.nodes[s];
        let panel = &self.values[node.panel..][..node.panel_len()];
        for column in 0..self.columns {
            let vector = &mut contribution[column * node.ld..][..node.ld];
            let (own, below) = vector.split_at_mut(node.columns);
            for (k, value) in own.iter_mut().enumerate() {
                *value = self.get(node.first + k, column);
            }
            for (&row, to) in self.symbolic.rows(node).iter().zip(below.as_chunks_mut::<3>().0) {
                *to = std::array::from_fn(|c| self.get(3 * row as usize + c, column));
            }
            below[node.rows..].fill(T::default());
            substitution::backward(panel, node.ld, node.columns, vector);
            for (k, value) in vector[..node.columns].iter().enumerate() {
                self.set(node.first + k, column, *value);
            }
        }
    }
}
