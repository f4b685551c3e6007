//! Numeric multifrontal factorisation (Duff and Reid 1983; Liu 1992): fronts from the leaves of the tree to its root.
//!
//! A front is assembled from the matrix's entries in the columns of a supernode and, by extend-add, from the
//! contribution blocks of its children. Its columns are factorised; the Schur complement on its rows is its own
//! contribution block (Liu's update matrix), which stays in the work space until the parent has added it. Children are
//! added in a fixed order, so the bits do not depend on the scheduling.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

use super::kernel::{
    BLOCK_WIDTH, COLUMN_GROUP, Panel, contribution_diagonal, contribution_len, contribution_start, negative_product,
    padded,
};
use super::symbolic::{Node, Symbolic, Task};
use crate::control::{Cancel, Cancelled};
use crate::simd::lanes::Scalar;
use crate::solver::pattern::Pattern;

/// Multiply-adds below which dense work on one front is not split for a second thread.
const MIN_SPLIT_MULTIPLY_ADDS: usize = 250_000;
/// The same for assembly, in scalars of the panel.
const MIN_SPLIT_COPIES: usize = 16_000;

/// A numeric factorisation in progress.
pub(super) struct Factorisation<'a, T> {
    pub symbolic: &'a Symbolic,
    pub pattern: &'a Pattern,
    /// The matrix's values, in the order of `pattern`.
    pub matrix: &'a [T],
    pub cancel: &'a Cancel,
    /// Whether a pivot was not positive.
    pub failed: AtomicBool,
}

/// The contribution blocks of a node's children, in the node's region of the work space.
#[derive(Clone, Copy)]
pub(super) struct ContributionBlocks<'a, T> {
    work: &'a [T],
    /// Where `work` begins in the work space.
    start: usize,
}

impl<'a, T> ContributionBlocks<'a, T> {
    #[inline]
    fn block(self, child: &Node) -> &'a [T] {
        &self.work[child.contribution.start - self.start..][..contribution_len(child.rows)]
    }

    /// The vector of a child in the forward pass, for right-hand side `column`.
    #[inline]
    pub(super) fn vector(self, child: &Node, column: usize) -> &'a [T] {
        &self.work[child.contribution.start - self.start + column * child.ld..][..child.ld]
    }
}

impl<T: Scalar> Factorisation<'_, T> {
    /// Runs the last task and all its dependencies. False where the matrix is not positive definite.
    pub(super) fn run(self, values: &mut [T], work: &mut [T]) -> Result<bool, Cancelled> {
        let Some(last) = self.symbolic.tasks.len().checked_sub(1) else { return Ok(false) };
        self.run_task(last, values, work);
        self.cancel.check()?;
        Ok(!self.failed.into_inner())
    }

    fn is_stopped(&self) -> bool {
        self.failed.load(Ordering::Relaxed) || self.cancel.is_requested()
    }

    /// Runs a task after its dependencies. `values` and `work` are the parts of factor and work space that belong to
    /// them.
    fn run_task(&self, t: usize, values: &mut [T], work: &mut [T]) {
        let task = &self.symbolic.tasks[t];
        let first_value = self.symbolic.panels(task).start;
        if !task.dependencies.is_empty() {
            rayon::scope(|scope| {
                let (mut values, mut at) = (&mut *values, first_value);
                for (&b, work) in task.dependencies.iter().zip(dependency_regions(self.symbolic, task, work)) {
                    let len = self.symbolic.panels(&self.symbolic.tasks[b]).end - at;
                    let (part, rest) = std::mem::take(&mut values).split_at_mut(len);
                    (values, at) = (rest, at + len);
                    scope.spawn(move |_| self.run_task(b, part, work));
                }
            });
        }
        for s in task.nodes.clone() {
            if self.is_stopped() {
                return;
            }
            let node = &self.symbolic.nodes[s];
            let panel = &mut values[node.panel - first_value..][..node.panel_len()];
            let region = &mut work[node.region.start - task.region.start..][..node.region.len()];
            if !self.factorise_front(s, panel, region) {
                self.failed.store(true, Ordering::Relaxed);
            }
        }
    }

    fn factorise_front(&self, s: usize, panel: &mut [T], region: &mut [T]) -> bool {
        let node = &self.symbolic.nodes[s];
        let (children, contribution) = split_region(node, region);
        self.assemble(s, children, 0..node.columns, panel);
        self.scatter(s, panel);
        if !factorise_panel(node, panel) {
            return false;
        }
        let groups = padded(node.rows).div_ceil(COLUMN_GROUP);
        self.compute_contribution(s, panel, children, 0..groups, &mut contribution[..contribution_len(node.rows)]);
        true
    }

    /// Assembles columns `columns` of the panel, stored in `to`, from the children's contribution blocks.
    fn assemble(&self, s: usize, children: ContributionBlocks<'_, T>, columns: Range<usize>, to: &mut [T]) {
        let node = &self.symbolic.nodes[s];
        if columns.len() > COLUMN_GROUP && to.len() > MIN_SPLIT_COPIES {
            let middle = columns.start + columns.len() / 6 * 3;
            let (first, second) = to.split_at_mut((middle - columns.start) * node.ld);
            rayon::join(
                || self.assemble(s, children, columns.start..middle, first),
                || self.assemble(s, children, middle..columns.end, second),
            );
            return;
        }
        to.fill(T::default());
        for child in self.symbolic.children(s) {
            let relative_indices = self.symbolic.relative_indices(child);
            extend_add(child, children.block(child), relative_indices, columns.clone(), to, |column| {
                let start = (column - columns.start) * node.ld;
                start + column..start + node.ld
            });
        }
    }

    /// Scatters the matrix's own entries into the panel.
    fn scatter(&self, s: usize, panel: &mut [T]) {
        let node = &self.symbolic.nodes[s];
        let (ld, col_ptr) = (node.ld, self.pattern.col_ptr());
        for k in 0..node.columns / 3 {
            let v = self.symbolic.vertex_at[node.first / 3 + k];
            for (c, from) in self.pattern.diagonal(v).into_iter().enumerate() {
                let to = (3 * k + c) * (ld + 1);
                add(&mut panel[to..to + 3 - c], &self.matrix[from..from + 3 - c]);
            }
        }
        for block in self.symbolic.blocks(s) {
            let (j, target) = (3 * block.column as usize, block.target as usize);
            for c in 0..3 {
                let from = col_ptr[j + c] as usize + 3 - c + 3 * block.index as usize;
                let column = &self.matrix[from..from + 3];
                if block.transposed {
                    for (r, value) in column.iter().enumerate() {
                        panel[target + r * ld + c] += *value;
                    }
                } else {
                    add(&mut panel[target + c * ld..][..3], column);
                }
            }
        }
    }

    /// Computes column groups `groups` of the contribution block, stored in `contribution`.
    fn compute_contribution(
        &self,
        s: usize,
        panel: &[T],
        children: ContributionBlocks<'_, T>,
        groups: Range<usize>,
        contribution: &mut [T],
    ) {
        let node = &self.symbolic.nodes[s];
        if groups.len() > 1 && contribution.len() * node.columns > MIN_SPLIT_MULTIPLY_ADDS {
            // Columns to the left are longer.
            let middle = groups.start + (groups.len() * 2).div_ceil(5);
            let start = |group: usize| contribution_start(node.rows, group * COLUMN_GROUP / 8);
            let (first, second) = contribution.split_at_mut(start(middle) - start(groups.start));
            rayon::join(
                || self.compute_contribution(s, panel, children, groups.start..middle, first),
                || self.compute_contribution(s, panel, children, middle..groups.end, second),
            );
            return;
        }
        let mut rest = contribution;
        for group in groups {
            let columns = group * COLUMN_GROUP..(group * COLUMN_GROUP + COLUMN_GROUP).min(padded(node.rows));
            let (start, end) =
                (contribution_start(node.rows, columns.start / 8), contribution_start(node.rows, columns.end / 8));
            let (contribution, others) = rest.split_at_mut(end - start);
            rest = others;
            negative_product(contribution, node.rows, group, panel, node.ld, node.columns, node.columns);
            let own = node.columns + columns.start..node.columns + columns.end.min(node.rows);
            for child in self.symbolic.children(s) {
                let relative_indices = self.symbolic.relative_indices(child);
                extend_add(child, children.block(child), relative_indices, own.clone(), contribution, |column| {
                    let diagonal = contribution_diagonal(node.rows, column - node.columns) - start;
                    diagonal..diagonal + node.columns + node.rows - column
                });
            }
        }
    }
}

/// Splits `work`, the work space of `task`, into the regions of its dependencies. Their addresses ascend or descend,
/// and they need not fill it: they are children of the task's first node, while `work` is the region of its last.
pub(super) fn dependency_regions<'a, T>(symbolic: &Symbolic, task: &Task, mut work: &'a mut [T]) -> Vec<&'a mut [T]> {
    let regions = || task.dependencies.iter().map(|&t| symbolic.tasks[t].region.clone());
    let ascending = regions().is_sorted_by_key(|region| region.start);
    let mut start = task.region.start;
    regions()
        .map(|region| {
            let (below, rest) = std::mem::take(&mut work).split_at_mut(region.start - start);
            let (part, above) = rest.split_at_mut(region.len());
            if ascending {
                (work, start) = (above, region.end);
            } else {
                work = below;
            }
            part
        })
        .collect()
}

/// Splits the region of `node` into its children's contribution blocks and the space for its own.
pub(super) fn split_region<'a, T>(node: &Node, region: &'a mut [T]) -> (ContributionBlocks<'a, T>, &'a mut [T]) {
    let len = node.contribution.len();
    if node.contribution.start == node.region.start {
        let (contribution, work) = region.split_at_mut(len);
        (ContributionBlocks { work, start: node.contribution.end }, contribution)
    } else {
        let (work, contribution) = region.split_at_mut(region.len() - len);
        (ContributionBlocks { work, start: node.region.start }, contribution)
    }
}

#[inline(always)]
fn add<T: Scalar>(to: &mut [T], values: &[T]) {
    for (to, value) in to.iter_mut().zip(values) {
        *to += *value;
    }
}

/// Extend-add (Liu 1992): adds to `to` those columns of a child's contribution block that are among `columns` of the
/// front. `column_at` gives the range in `to` of a column of the front, from its diagonal down.
#[inline(always)]
fn extend_add<T: Scalar>(
    child: &Node,
    contribution: &[T],
    relative_indices: &[u32],
    columns: Range<usize>,
    to: &mut [T],
    column_at: impl Fn(usize) -> Range<usize>,
) {
    let first = relative_indices.partition_point(|&index| 3 * (index as usize) < columns.start);
    let count = relative_indices[first..].partition_point(|&index| 3 * (index as usize) < columns.end);
    for (k, &index) in relative_indices[first..first + count].iter().enumerate() {
        for c in 0..3 {
            let (j, column) = (3 * (first + k) + c, 3 * index as usize + c);
            let from = &contribution[contribution_diagonal(child.rows, j)..][..child.rows - j];
            let (own, below) = from.split_at(3 - c);
            let to = &mut to[column_at(column)];
            add(&mut to[..3 - c], own);
            for (index, value) in relative_indices[first + k + 1..].iter().zip(below.as_chunks::<3>().0) {
                add(&mut to[3 * *index as usize - column..][..3], value);
            }
        }
    }
}

/// Blocked factorisation of a panel. False where a pivot is not positive.
fn factorise_panel<T: Scalar>(node: &Node, memory: &mut [T]) -> bool {
    let panel = Panel::new(memory, node.ld);
    let bottom = padded(node.columns + node.rows);
    for begin in (0..node.columns).step_by(BLOCK_WIDTH) {
        let end = node.columns.min(begin + BLOCK_WIDTH);
        // SAFETY: the panel is borrowed by this function alone, and has `bottom` rows, which the leading dimension
        // holds.
        if !unsafe { panel.factorise_diagonal(begin, end) } {
            return false;
        }
        finish_rows(panel, begin, end, padded(end)..bottom);
    }
    true
}

fn finish_rows<T: Scalar>(panel: Panel<T>, begin: usize, end: usize, rows: Range<usize>) {
    if rows.len() > COLUMN_GROUP && rows.len() * (end - begin) * (begin + end) / 2 > MIN_SPLIT_MULTIPLY_ADDS {
        let middle = rows.start + (rows.len() / 2).next_multiple_of(COLUMN_GROUP);
        rayon::join(
            || finish_rows(panel, begin, end, rows.start..middle),
            || finish_rows(panel, begin, end, middle..rows.end),
        );
        return;
    }
    // SAFETY: the panel is borrowed by the caller's caller, and each part of the rows is used by one thread. The
    // rows from `begin` to `end` are above all of them.
    unsafe { panel.finish_rows(begin, end, rows) };
}
