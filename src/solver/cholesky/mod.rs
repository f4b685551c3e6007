//! Sparse Cholesky factorisation of the Hessian on all processors, and substitution with it.
//!
//! The order of elimination is computed once for a pattern, by approximate minimum degree on the vertices, and so is
//! everything else that follows from the pattern: the elimination tree, its supernodes, who does what, and where in
//! memory it lies. Numbers then go through dense fronts, three coordinates of a vertex at once, independent parts of
//! the tree at the same time. The result has the same bits with any number of threads.

mod buffer;
mod kernel;
mod numeric;
mod ordering;
mod solve;
mod substitution;
mod supernodes;
mod symbolic;

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use super::pattern::Pattern;
use crate::control::{Cancel, Cancelled};
use crate::error::{Error, ErrorKind, Result};
use crate::memory::{MemoryLimit, Part, bytes};
use buffer::Buffer;
use numeric::Factorisation;
use ordering::{Graph, minimum_degree};
use solve::Solve;
use supernodes::Supernodes;
use symbolic::Plan;

/// Right-hand sides that go through a factor together.
const TOGETHER: usize = 2;

/// The symbolic analysis of one pattern, and the factor of the last matrix.
#[derive(Default)]
pub struct Factor {
    /// Empty before an analysis.
    plan: Plan,
    values: Buffer,
    work: Buffer,
    /// Right-hand sides in the order of elimination.
    x: Vec<AtomicU64>,
    cancel: Cancel,
}

impl Factor {
    /// A factor without a pattern, whose work ends once somebody asks to stop.
    pub fn new(cancel: Cancel) -> Self {
        Self { cancel, ..Self::default() }
    }

    /// Orders and analyses `pattern`, in the memory of the one before, which `limit` does not count. The factor of the
    /// last matrix is gone.
    ///
    /// # Errors
    /// `Internal` where memory runs out, `MemoryLimit`, `Cancelled` (looked at in the end); then there is nothing to
    /// factorise with.
    pub fn analyse(&mut self, limit: MemoryLimit, pattern: &Pattern) -> Result<()> {
        self.plan = Plan::default();
        let failed = |what: &str| Error::new(ErrorKind::Internal, format!("the symbolic factorisation {what}"));
        let order = minimum_degree(pattern).map_err(|_| failed("ran out of memory or indices"))?;
        let graph = Graph::new(pattern);
        let plan =
            Plan::new(&graph, Supernodes::new(&graph, order)).ok_or_else(|| failed("has a front that is too large"))?;
        let unknowns = TOGETHER * 3 * pattern.vertex_count();
        let bytes = self.values.memory_for(plan.values)
            + self.work.memory_for(plan.work)
            + (unknowns * size_of::<AtomicU64>()) as u64
            + plan.memory();
        limit.check(&[Part { what: "the factorisation of the garment's linear system", bytes }])?;
        if !self.values.resize(plan.values) || !self.work.resize(plan.work) {
            return Err(Error::new(ErrorKind::Internal, "there is no memory for the factorisation's work space"));
        }
        self.x = (0..unknowns).map(|_| AtomicU64::new(0)).collect();
        self.cancel.check()?;
        self.plan = plan;
        Ok(())
    }

    /// Factorises the matrix with the given values (lower triangle, in the order of `pattern`, which is the one that
    /// was analysed). Returns whether it is numerically positive definite; only then there is a factor.
    ///
    /// # Errors
    /// [`Cancelled`]; the token is looked at between two fronts.
    pub fn factorise(&mut self, pattern: &Pattern, values: &[f64]) -> Result<bool, Cancelled> {
        let Self { plan, cancel, .. } = self;
        Factorisation { plan, pattern, matrix: values, cancel, failed: AtomicBool::new(false) }
            .run(&mut self.values, &mut self.work)
    }

    /// Replaces each of the `columns` right-hand sides in `rhs` (one after the other) by the solution.
    pub fn solve(&mut self, rhs: &mut [f64], columns: usize) {
        let n = rhs.len().checked_div(columns).unwrap_or(0);
        if n == 0 {
            return;
        }
        for rhs in rhs.chunks_mut(TOGETHER * n) {
            let columns = rhs.len() / n;
            let Self { plan, values, work, x, .. } = self;
            for (to, &v) in x.chunks_exact(3 * columns).zip(&plan.vertex_at) {
                for (k, x) in to.iter().enumerate() {
                    let from = k % columns * n + 3 * v as usize + k / columns;
                    x.store(rhs[from].to_bits(), Ordering::Relaxed);
                }
            }
            Solve { plan, values, x, columns }.run(work);
            for (from, &v) in x.chunks_exact(3 * columns).zip(&plan.vertex_at) {
                for (k, x) in from.iter().enumerate() {
                    let to = k % columns * n + 3 * v as usize + k / columns;
                    rhs[to] = f64::from_bits(x.load(Ordering::Relaxed));
                }
            }
        }
    }

    /// Bytes that it holds.
    pub fn memory(&self) -> u64 {
        self.values.memory() + self.work.memory() + bytes(&self.x) + self.plan.memory()
    }

    /// Number of scalars in the factor.
    pub fn value_count(&self) -> usize {
        self.plan.values
    }
}
