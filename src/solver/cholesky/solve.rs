//! Substitution: from the leaves of the tree to its root and back.
//!
//! On the way up a front's vector is kept where its update matrix was, for the parent to take what is below its
//! columns. On the way down a front reads the solution of its ancestors, which are done.

use std::sync::atomic::{AtomicU64, Ordering};

use super::numeric::{divided, parts};
use super::substitution;
use super::symbolic::Plan;

/// One or two right-hand sides on their way.
pub(super) struct Solve<'a> {
    pub plan: &'a Plan,
    /// The factor.
    pub values: &'a [f64],
    /// Bits of the right-hand sides, then of the solutions: for each position as many as there are columns. Each is
    /// written by the one task that eliminates it, and read by those that come after.
    pub x: &'a [AtomicU64],
    pub columns: usize,
}

impl Solve<'_> {
    pub(super) fn run(&self, work: &mut [f64]) {
        if let Some(last) = self.plan.tasks.len().checked_sub(1) {
            self.up(last, work);
            self.down(last, work);
        }
    }

    #[inline]
    fn get(&self, row: usize, column: usize) -> f64 {
        f64::from_bits(self.x[row * self.columns + column].load(Ordering::Relaxed))
    }

    #[inline]
    fn set(&self, row: usize, column: usize, value: f64) {
        self.x[row * self.columns + column].store(value.to_bits(), Ordering::Relaxed);
    }

    fn up(&self, t: usize, work: &mut [f64]) {
        let task = &self.plan.tasks[t];
        if !task.before.is_empty() {
            rayon::scope(|scope| {
                for (&b, work) in task.before.iter().zip(parts(self.plan, task, work)) {
                    scope.spawn(move |_| self.up(b, work));
                }
            });
        }
        for s in task.nodes.clone() {
            let node = &self.plan.nodes[s];
            let region = &mut work[node.region.start - task.region.start..][..node.region.len()];
            self.forward(s, region);
        }
    }

    fn forward(&self, s: usize, region: &mut [f64]) {
        let node = &self.plan.nodes[s];
        let (left, update) = divided(node, region);
        let panel = &self.values[node.panel..][..node.panel_len()];
        for column in 0..self.columns {
            let vector = &mut update[column * node.ld..][..node.ld];
            for (k, value) in vector[..node.columns].iter_mut().enumerate() {
                *value = self.get(node.first + k, column);
            }
            vector[node.columns..].fill(0.0);
            for child in self.plan.children(s) {
                let from = &left.vector(child, column)[child.columns..][..child.rows];
                for (place, value) in self.plan.places(child).iter().zip(from.as_chunks::<3>().0) {
                    let to = &mut vector[3 * *place as usize..][..3];
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

    fn down(&self, t: usize, work: &mut [f64]) {
        let task = &self.plan.tasks[t];
        for s in task.nodes.clone().rev() {
            let node = &self.plan.nodes[s];
            self.backward(s, &mut work[node.update.start - task.region.start..][..node.update.len()]);
        }
        if !task.before.is_empty() {
            rayon::scope(|scope| {
                for (&b, work) in task.before.iter().zip(parts(self.plan, task, work)) {
                    scope.spawn(move |_| self.down(b, work));
                }
            });
        }
    }

    fn backward(&self, s: usize, room: &mut [f64]) {
        let node = &self.plan.nodes[s];
        let panel = &self.values[node.panel..][..node.panel_len()];
        for column in 0..self.columns {
            let vector = &mut room[column * node.ld..][..node.ld];
            let (own, below) = vector.split_at_mut(node.columns);
            for (k, value) in own.iter_mut().enumerate() {
                *value = self.get(node.first + k, column);
            }
            for (&row, to) in self.plan.rows(node).iter().zip(below.as_chunks_mut::<3>().0) {
                *to = std::array::from_fn(|c| self.get(3 * row as usize + c, column));
            }
            below[node.rows..].fill(0.0);
            substitution::backward(panel, node.ld, node.columns, vector);
            for (k, value) in vector[..node.columns].iter().enumerate() {
                self.set(node.first + k, column, *value);
            }
        }
    }
}
