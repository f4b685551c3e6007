//! The factorisation itself: fronts from the leaves of the tree to its root.
//!
//! A front is the matrix's entries in the columns of a supernode and what the children leave to it. Its columns are
//! factorised; what is left of its rows waits in the work space for the parent. Sums have the order of the children, so
//! that it does not matter who does what when.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

use super::kernel::{GROUP, Panel, STEP, negative_product, padded, update_diagonal, update_len, update_start};
use super::symbolic::{Node, Plan, Task};
use crate::control::{Cancel, Cancelled};
use crate::solver::pattern::Pattern;

/// Fewest products that are worth asking whether another thread has time.
const SHARE: usize = 250_000;
/// The same for scalars that are gathered.
const SHARE_OF_COPIES: usize = 16_000;

/// One factorisation on its way.
pub(super) struct Factorisation<'a> {
    pub plan: &'a Plan,
    pub pattern: &'a Pattern,
    /// The matrix.
    pub matrix: &'a [f64],
    pub cancel: &'a Cancel,
    /// Whether a pivot was not positive.
    pub failed: AtomicBool,
}

/// What the children of a node left to it.
#[derive(Clone, Copy)]
pub(super) struct Left<'a> {
    work: &'a [f64],
    /// Where `work` begins in the work space.
    start: usize,
}

impl<'a> Left<'a> {
    #[inline]
    fn update(self, child: &Node) -> &'a [f64] {
        &self.work[child.update.start - self.start..][..update_len(child.rows)]
    }

    /// Right-hand side `column` of a child.
    #[inline]
    pub(super) fn vector(self, child: &Node, column: usize) -> &'a [f64] {
        &self.work[child.update.start - self.start + column * child.ld..][..child.ld]
    }
}

impl Factorisation<'_> {
    /// Does the last task and all before it. False where the matrix is not positive definite.
    pub(super) fn run(self, values: &mut [f64], work: &mut [f64]) -> Result<bool, Cancelled> {
        let Some(last) = self.plan.tasks.len().checked_sub(1) else { return Ok(false) };
        self.task(last, values, work);
        self.cancel.check()?;
        Ok(!self.failed.into_inner())
    }

    fn is_over(&self) -> bool {
        self.failed.load(Ordering::Relaxed) || self.cancel.is_requested()
    }

    /// `values` and `work` are the task's parts, with those before.
    fn task(&self, t: usize, values: &mut [f64], work: &mut [f64]) {
        let task = &self.plan.tasks[t];
        let first_value = self.plan.panels(task).start;
        if !task.before.is_empty() {
            rayon::scope(|scope| {
                let (mut values, mut at) = (&mut *values, first_value);
                for (&b, work) in task.before.iter().zip(parts(self.plan, task, work)) {
                    let len = self.plan.panels(&self.plan.tasks[b]).end - at;
                    let (part, rest) = std::mem::take(&mut values).split_at_mut(len);
                    (values, at) = (rest, at + len);
                    scope.spawn(move |_| self.task(b, part, work));
                }
            });
        }
        for s in task.nodes.clone() {
            if self.is_over() {
                return;
            }
            let node = &self.plan.nodes[s];
            let panel = &mut values[node.panel - first_value..][..node.panel_len()];
            let region = &mut work[node.region.start - task.region.start..][..node.region.len()];
            if !self.front(s, panel, region) {
                self.failed.store(true, Ordering::Relaxed);
            }
        }
    }

    fn front(&self, s: usize, panel: &mut [f64], region: &mut [f64]) -> bool {
        let node = &self.plan.nodes[s];
        let (left, update) = divided(node, region);
        self.gather(s, left, 0..node.columns, panel);
        self.scatter(s, panel);
        if !factorise_panel(node, panel) {
            return false;
        }
        let groups = padded(node.rows).div_ceil(GROUP);
        self.update(s, panel, left, 0..groups, &mut update[..update_len(node.rows)]);
        true
    }

    /// Sets columns `columns` of the panel, which are `to`, to what the children left for them.
    fn gather(&self, s: usize, left: Left<'_>, columns: Range<usize>, to: &mut [f64]) {
        let node = &self.plan.nodes[s];
        if columns.len() > GROUP && to.len() > SHARE_OF_COPIES {
            let middle = columns.start + columns.len() / 6 * 3;
            let (first, second) = to.split_at_mut((middle - columns.start) * node.ld);
            rayon::join(
                || self.gather(s, left, columns.start..middle, first),
                || self.gather(s, left, middle..columns.end, second),
            );
            return;
        }
        to.fill(0.0);
        for child in self.plan.children(s) {
            let places = self.plan.places(child);
            extend(child, left.update(child), places, columns.clone(), to, |column| {
                let start = (column - columns.start) * node.ld;
                start + column..start + node.ld
            });
        }
    }

    /// Adds the matrix's own entries.
    fn scatter(&self, s: usize, panel: &mut [f64]) {
        let node = &self.plan.nodes[s];
        let (ld, col_ptr) = (node.ld, self.pattern.col_ptr());
        for k in 0..node.columns / 3 {
            let v = self.plan.vertex_at[node.first / 3 + k];
            for (c, from) in self.pattern.diagonal(v).into_iter().enumerate() {
                let to = (3 * k + c) * (ld + 1);
                add(&mut panel[to..to + 3 - c], &self.matrix[from..from + 3 - c]);
            }
        }
        for block in self.plan.blocks(s) {
            let (j, target) = (3 * block.column as usize, block.target as usize);
            for c in 0..3 {
                let from = col_ptr[j + c] as usize + 3 - c + 3 * block.place as usize;
                let column = &self.matrix[from..from + 3];
                if block.transposed {
                    for (r, value) in column.iter().enumerate() {
                        panel[target + r * ld + c] += value;
                    }
                } else {
                    add(&mut panel[target + c * ld..][..3], column);
                }
            }
        }
    }

    /// Groups `groups` of the update matrix, which are `update`.
    fn update(&self, s: usize, panel: &[f64], left: Left<'_>, groups: Range<usize>, update: &mut [f64]) {
        let node = &self.plan.nodes[s];
        if groups.len() > 1 && update.len() * node.columns > SHARE {
            // Columns to the left are longer.
            let middle = groups.start + (groups.len() * 2).div_ceil(5);
            let start = |group: usize| update_start(node.rows, group * GROUP / 8);
            let (first, second) = update.split_at_mut(start(middle) - start(groups.start));
            rayon::join(
                || self.update(s, panel, left, groups.start..middle, first),
                || self.update(s, panel, left, middle..groups.end, second),
            );
            return;
        }
        let mut rest = update;
        for group in groups {
            let columns = group * GROUP..(group * GROUP + GROUP).min(padded(node.rows));
            let (start, end) = (update_start(node.rows, columns.start / 8), update_start(node.rows, columns.end / 8));
            let (update, others) = rest.split_at_mut(end - start);
            rest = others;
            negative_product(update, node.rows, group, panel, node.ld, node.columns, node.columns);
            let own = node.columns + columns.start..node.columns + columns.end.min(node.rows);
            for child in self.plan.children(s) {
                let places = self.plan.places(child);
                extend(child, left.update(child), places, own.clone(), update, |column| {
                    let diagonal = update_diagonal(node.rows, column - node.columns) - start;
                    diagonal..diagonal + node.columns + node.rows - column
                });
            }
        }
    }
}

/// Cuts `work`, the work space of `task`, into the regions of those before it. They follow one another up or down, and
/// need not fill it: they belong to the first of the task's nodes, it to the last.
pub(super) fn parts<'a>(plan: &Plan, task: &Task, mut work: &'a mut [f64]) -> Vec<&'a mut [f64]> {
    let regions = || task.before.iter().map(|&t| plan.tasks[t].region.clone());
    let up = regions().is_sorted_by_key(|region| region.start);
    let mut start = task.region.start;
    regions()
        .map(|region| {
            let (below, rest) = std::mem::take(&mut work).split_at_mut(region.start - start);
            let (part, above) = rest.split_at_mut(region.len());
            if up {
                (work, start) = (above, region.end);
            } else {
                work = below;
            }
            part
        })
        .collect()
}

/// What the children left in the region of `node`, and the place for its own update matrix.
pub(super) fn divided<'a>(node: &Node, region: &'a mut [f64]) -> (Left<'a>, &'a mut [f64]) {
    let len = node.update.len();
    if node.update.start == node.region.start {
        let (update, work) = region.split_at_mut(len);
        (Left { work, start: node.update.end }, update)
    } else {
        let (work, update) = region.split_at_mut(region.len() - len);
        (Left { work, start: node.region.start }, update)
    }
}

#[inline(always)]
fn add(to: &mut [f64], values: &[f64]) {
    for (to, value) in to.iter_mut().zip(values) {
        *to += value;
    }
}

/// Adds to `to` those columns of a child's update matrix that are among `columns` of the front. `column_at` says where
/// in `to` a column of the front is, from its diagonal down.
#[inline(always)]
fn extend(
    child: &Node,
    update: &[f64],
    places: &[u32],
    columns: Range<usize>,
    to: &mut [f64],
    column_at: impl Fn(usize) -> Range<usize>,
) {
    let first = places.partition_point(|&place| 3 * (place as usize) < columns.start);
    let count = places[first..].partition_point(|&place| 3 * (place as usize) < columns.end);
    for (k, &place) in places[first..first + count].iter().enumerate() {
        for c in 0..3 {
            let (j, column) = (3 * (first + k) + c, 3 * place as usize + c);
            let from = &update[update_diagonal(child.rows, j)..][..child.rows - j];
            let (own, below) = from.split_at(3 - c);
            let to = &mut to[column_at(column)];
            add(&mut to[..3 - c], own);
            for (place, value) in places[first + k + 1..].iter().zip(below.as_chunks::<3>().0) {
                add(&mut to[3 * *place as usize - column..][..3], value);
            }
        }
    }
}

/// False where a pivot is not positive.
fn factorise_panel(node: &Node, memory: &mut [f64]) -> bool {
    let panel = Panel::new(memory, node.ld);
    let bottom = padded(node.columns + node.rows);
    for begin in (0..node.columns).step_by(STEP) {
        let end = node.columns.min(begin + STEP);
        // SAFETY: the panel is borrowed by this function alone, and has `bottom` rows, which the leading dimension
        // holds.
        if !unsafe { panel.factorise_diagonal(begin, end) } {
            return false;
        }
        finish_rows(panel, begin, end, padded(end)..bottom);
    }
    true
}

fn finish_rows(panel: Panel, begin: usize, end: usize, rows: Range<usize>) {
    if rows.len() > GROUP && rows.len() * (end - begin) * (begin + end) / 2 > SHARE {
        let middle = rows.start + (rows.len() / 2).next_multiple_of(GROUP);
        rayon::join(
            || finish_rows(panel, begin, end, rows.start..middle),
            || finish_rows(panel, begin, end, middle..rows.end),
        );
        return;
    }
    // SAFETY: the panel is borrowed by the caller's caller, and each part of the rows is looked at by one thread. The
    // rows from `begin` to `end` are above all of them.
    unsafe { panel.finish_rows(begin, end, rows) };
}
