//! Sparse Cholesky factorisation of the Hessian by the multifrontal method on all processors, and triangular solves.
//!
//! The symbolic factorisation is done once for a pattern, on the graph of the vertices, each of which stands for three
//! unknowns: a fill-reducing ordering, the elimination tree, its supernodes, the tasks for the threads, and the layout
//! of factor and work space. The numeric factorisation passes the values through dense frontal matrices, from the
//! leaves of the tree to its root, independent subtrees in parallel. The result has the same bits with any number of
//! threads.
//!
//! | step | file | literature |
//! | --- | --- | --- |
//! | approximate minimum degree ordering (faer's) | `ordering` | \[1\] |
//! | elimination tree, postorder, column counts by row subtrees | `supernodes` | \[2\] |
//! | relaxed supernodes, here by a model of a front's time | `supernodes` | \[3\] |
//! | frontal matrices, contribution blocks, extend-add by relative indices | `symbolic`, `numeric` | \[4\], \[5\] |
//!
//! Column counts take time in proportion to the factor's vertex entries, little beside its values; the faster algorithm
//! of Gilbert, Ng and Peyton \[6\] is not used.
//!
//! 1. P. R. Amestoy, T. A. Davis, I. S. Duff: An approximate minimum degree ordering algorithm. SIAM J. Matrix Anal. Appl.
//!    17(4), 1996.
//! 2. J. W. H. Liu: The role of elimination trees in sparse factorization. SIAM J. Matrix Anal. Appl. 11(1), 1990.
//! 3. C. Ashcraft, R. Grimes: The influence of relaxed supernode partitions on the multifrontal method. ACM Trans. Math.
//!    Softw. 15(4), 1989.
//! 4. I. S. Duff, J. K. Reid: The multifrontal solution of indefinite sparse symmetric linear equations. ACM Trans. Math.
//!    Softw. 9(3), 1983.
//! 5. J. W. H. Liu: The multifrontal method for sparse matrix solution: theory and practice. SIAM Review 34(1), 1992.
//! 6. J. R. Gilbert, E. G. Ng, B. W. Peyton: An efficient algorithm to compute row and column counts for sparse Cholesky
//!    factorization. SIAM J. Matrix Anal. Appl. 15(4), 1994.

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
use symbolic::Symbolic;

/// Right-hand sides that are solved for in one pass over the factor.
const MAX_RHS: usize = 2;

/// The symbolic factorisation of one pattern, and the factor of the last matrix.
#[derive(Default)]
pub struct Factor {
    /// Empty before an analysis.
    symbolic: Symbolic,
    values: Buffer,
    work: Buffer,
    /// Right-hand sides in the order of elimination, as bits of `f64`.
    x: Vec<AtomicU64>,
    cancel: Cancel,
}

impl Factor {
    /// A factor without a pattern. `cancel` is checked during analysis and factorisation.
    pub fn new(cancel: Cancel) -> Self {
        Self { cancel, ..Self::default() }
    }

    /// Symbolic factorisation of `pattern`: orders and analyses it. The memory of the previous one is reused, and
    /// `limit` does not count it. The factor of the last matrix is lost.
    ///
    /// # Errors
    /// `Internal` where memory runs out, `MemoryLimit`, `Cancelled` (checked once, at the end); after an error there is
    /// no symbolic factorisation.
    pub fn analyse(&mut self, limit: MemoryLimit, pattern: &Pattern) -> Result<()> {
        self.symbolic = Symbolic::default();
        let failed = |reason: &str| Error::new(ErrorKind::Internal, format!("the symbolic factorisation {reason}"));
        let order = minimum_degree(pattern).map_err(|_| failed("ran out of memory or indices"))?;
        let graph = Graph::new(pattern);
        let symbolic = Symbolic::new(&graph, Supernodes::new(&graph, order))
            .ok_or_else(|| failed("has a front that is too large"))?;
        let unknowns = MAX_RHS * 3 * pattern.vertex_count();
        let bytes = self.values.memory_for(symbolic.values)
            + self.work.memory_for(symbolic.work)
            + (unknowns * size_of::<AtomicU64>()) as u64
            + symbolic.memory();
        limit.check(&[Part { name: "the factorisation of the garment's linear system", bytes }])?;
        if !self.values.resize(symbolic.values) || !self.work.resize(symbolic.work) {
            return Err(Error::new(ErrorKind::Internal, "there is no memory for the factorisation's work space"));
        }
        self.x = (0..unknowns).map(|_| AtomicU64::new(0)).collect();
        self.cancel.check()?;
        self.symbolic = symbolic;
        Ok(())
    }

    /// Numeric factorisation of the matrix with the given values (lower triangle, in the order of `pattern`, which is
    /// the one that was analysed). Returns whether it is numerically positive definite; only then there is a factor.
    ///
    /// # Errors
    /// [`Cancelled`]; the token is checked between two fronts.
    pub fn factorise(&mut self, pattern: &Pattern, values: &[f64]) -> Result<bool, Cancelled> {
        let Self { symbolic, cancel, .. } = self;
        Factorisation { symbolic, pattern, matrix: values, cancel, failed: AtomicBool::new(false) }
            .run(&mut self.values, &mut self.work)
    }

    /// Replaces each of the `columns` right-hand sides in `rhs` (one after the other) by the solution.
    pub fn solve(&mut self, rhs: &mut [f64], columns: usize) {
        let n = rhs.len().checked_div(columns).unwrap_or(0);
        if n == 0 {
            return;
        }
        for rhs in rhs.chunks_mut(MAX_RHS * n) {
            let columns = rhs.len() / n;
            let Self { symbolic, values, work, x, .. } = self;
            for (to, &v) in x.chunks_exact(3 * columns).zip(&symbolic.vertex_at) {
                for (k, x) in to.iter().enumerate() {
                    let from = k % columns * n + 3 * v as usize + k / columns;
                    x.store(rhs[from].to_bits(), Ordering::Relaxed);
                }
            }
            Solve { symbolic, values, x, columns }.run(work);
            for (from, &v) in x.chunks_exact(3 * columns).zip(&symbolic.vertex_at) {
                for (k, x) in from.iter().enumerate() {
                    let to = k % columns * n + 3 * v as usize + k / columns;
                    rhs[to] = f64::from_bits(x.load(Ordering::Relaxed));
                }
            }
        }
    }

    /// Bytes held.
    pub fn memory(&self) -> u64 {
        self.values.memory() + self.work.memory() + bytes(&self.x) + self.symbolic.memory()
    }

    /// Number of scalars in the factor.
    pub fn value_count(&self) -> usize {
        self.symbolic.values
    }
}
