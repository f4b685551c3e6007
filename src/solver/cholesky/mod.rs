//! Sparse Cholesky factorisation of the Hessian by the multifrontal method on all processors, and triangular solves.
//!
//! The symbolic factorisation is done once for a pattern, on the graph of the vertices, each of which stands for three
//! unknowns: a fill-reducing ordering, the elimination tree, its supernodes, the tasks for the threads, and the layout
//! of factor and work space. The numeric factorisation passes the values through dense frontal matrices, from the
//! leaves of the tree to its root, independent subtrees in parallel. The result has the same bits with any number of
//! threads.
//!
//! A large factor can be one in 32 bits: half the memory, and about half the time. Then the matrix is scaled to a unit diagonal
//! first, `S A S` with `S_jj = A_jj^(-1/2)`, which is nearly the best of all diagonal scalings \[7\]: stiff and soft parts
//! of a garment differ by many orders of magnitude. Such a factor is a preconditioner, see
//! [`super::conjugate_gradients`].
//!
//! | step | file | literature |
//! | --- | --- | --- |
//! | approximate minimum degree ordering (faer's) | `ordering` | \[1\] |
//! | nested dissection of large garments (feral-metis') | `ordering` | \[8\] |
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
//! 7. A. van der Sluis: Condition numbers and equilibration of matrices. Numerische Mathematik 14, 1969.
//! 8. G. Karypis, V. Kumar: A fast and high quality multilevel scheme for partitioning irregular graphs. SIAM J. Sci. Comput.
//!    20(1), 1998.

mod buffer;
mod kernel;
mod numeric;
mod ordering;
mod solve;
mod substitution;
mod supernodes;
mod symbolic;

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use rayon::prelude::*;

use super::pattern::Pattern;
use crate::control::{Cancel, Cancelled};
use crate::error::{Error, ErrorKind, Result};
use crate::memory::{MemoryLimit, Part, bytes};
use crate::simd::lanes::Scalar;
use buffer::Buffer;
use numeric::Factorisation;
pub(super) use ordering::Graph;
use ordering::fill_reducing;
use solve::Solve;
use supernodes::Supernodes;
use symbolic::Symbolic;

/// Right-hand sides that are solved for in one pass over the factor.
const MAX_RHS: usize = 2;

/// Of a factor's numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precision {
    /// 64 bits.
    #[default]
    Double,
    /// 32 bits.
    Single,
}

/// Memory for a factor and for what is computed on the way to it.
#[derive(Default)]
struct Storage<T> {
    values: Buffer<T>,
    work: Buffer<T>,
}

impl<T: Scalar + Default> Storage<T> {
    fn memory(&self) -> u64 {
        self.values.memory() + self.work.memory()
    }

    fn memory_for(&self, symbolic: &Symbolic) -> u64 {
        self.values.memory_for(symbolic.values) + self.work.memory_for(symbolic.work)
    }

    /// Fits it to `symbolic`. False where memory ran out.
    fn resize(&mut self, symbolic: &Symbolic) -> bool {
        self.values.resize(symbolic.values) && self.work.resize(symbolic.work)
    }

    fn factorise(
        &mut self,
        symbolic: &Symbolic,
        pattern: &Pattern,
        matrix: &[T],
        cancel: &Cancel,
    ) -> Result<bool, Cancelled> {
        Factorisation { symbolic, pattern, matrix, cancel, failed: AtomicBool::new(false) }
            .run(&mut self.values, &mut self.work)
    }

    fn solve(&mut self, symbolic: &Symbolic, x: &[AtomicU64], columns: usize) {
        Solve { symbolic, values: &self.values, x, columns }.run(&mut self.work);
    }
}

/// The symbolic factorisation of one pattern, and the factor of the last matrix.
pub struct Factor {
    /// Empty before an analysis.
    symbolic: Symbolic,
    precision: Precision,
    /// One of the two is empty.
    double: Storage<f64>,
    single: Storage<f32>,
    /// The matrix in 32 bits, scaled, and what its rows and columns are scaled by.
    scaled: Vec<f32>,
    scale: Vec<f64>,
    /// Right-hand sides in the order of elimination, as bits of `f64`.
    x: Vec<AtomicU64>,
    cancel: Cancel,
    /// A factor with at least so many scalars is one in 32 bits.
    single_from: usize,
}

impl Default for Factor {
    fn default() -> Self {
        Self::new(Cancel::default())
    }
}

impl Factor {
    /// A factor without a pattern, in 64 bits whatever its size. `cancel` is checked during analysis and factorisation.
    pub fn new(cancel: Cancel) -> Self {
        Self {
            symbolic: Symbolic::default(),
            precision: Precision::Double,
            double: Storage::default(),
            single: Storage::default(),
            scaled: Vec::new(),
            scale: Vec::new(),
            x: Vec::new(),
            cancel,
            single_from: usize::MAX,
        }
    }

    /// The same, in 32 bits where it has at least so many scalars.
    pub fn in_single_from(mut self, scalars: usize) -> Self {
        self.single_from = scalars;
        self
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
        let graph = Graph::new(pattern);
        let order = fill_reducing(pattern, &graph).ok_or_else(|| failed("ran out of memory or indices"))?;
        let symbolic = Symbolic::new(&graph, Supernodes::new(&graph, order))
            .ok_or_else(|| failed("has a front that is too large"))?;
        drop(graph);
        let precision = if symbolic.values >= self.single_from { Precision::Single } else { Precision::Double };
        self.allocate(limit, &symbolic, pattern, precision)?;
        self.x = (0..MAX_RHS * 3 * pattern.vertex_count()).map(|_| AtomicU64::new(0)).collect();
        self.cancel.check()?;
        self.symbolic = symbolic;
        Ok(())
    }

    /// Goes on in 64 bits, with `pattern`, which is the one that was analysed. The factor of the last matrix is lost.
    ///
    /// # Errors
    /// `Internal` where memory runs out, `MemoryLimit`; then there is no symbolic factorisation any more.
    pub fn widen(&mut self, limit: MemoryLimit, pattern: &Pattern) -> Result<()> {
        let symbolic = std::mem::take(&mut self.symbolic);
        self.allocate(limit, &symbolic, pattern, Precision::Double)?;
        self.symbolic = symbolic;
        Ok(())
    }

    /// The memory for a factor in `precision`; none is left in the other.
    fn allocate(
        &mut self,
        limit: MemoryLimit,
        symbolic: &Symbolic,
        pattern: &Pattern,
        precision: Precision,
    ) -> Result<()> {
        let storage = match precision {
            Precision::Double => self.double.memory_for(symbolic),
            Precision::Single => {
                let (n, entries) = (3 * pattern.vertex_count(), pattern.value_count());
                self.single.memory_for(symbolic) + (entries * size_of::<f32>() + n * size_of::<f64>()) as u64
            }
        };
        let unknowns = MAX_RHS * 3 * pattern.vertex_count();
        let bytes = storage + (unknowns * size_of::<AtomicU64>()) as u64 + symbolic.memory();
        limit.check(&[Part { name: "the factorisation of the garment's linear system", bytes }])?;
        self.precision = precision;
        let fits = match precision {
            Precision::Double => {
                self.single = Storage::default();
                (self.scaled, self.scale) = (Vec::new(), Vec::new());
                self.double.resize(symbolic)
            }
            Precision::Single => {
                self.double = Storage::default();
                self.single.resize(symbolic)
            }
        };
        if fits {
            Ok(())
        } else {
            Err(Error::new(ErrorKind::Internal, "there is no memory for the factorisation's work space"))
        }
    }

    /// Of the factor.
    pub fn precision(&self) -> Precision {
        self.precision
    }

    /// Numeric factorisation of the matrix with the given values (lower triangle, in the order of `pattern`, which is
    /// the one that was analysed). Returns whether it is numerically positive definite; only then there is a factor.
    ///
    /// # Errors
    /// [`Cancelled`]; the token is checked between two fronts.
    pub fn factorise(&mut self, pattern: &Pattern, values: &[f64]) -> Result<bool, Cancelled> {
        let Self { symbolic, precision, double, single, scaled, scale, cancel, .. } = self;
        match precision {
            Precision::Double => double.factorise(symbolic, pattern, values, cancel),
            Precision::Single => {
                scale_to_unit_diagonal(pattern, values, scaled, scale);
                single.factorise(symbolic, pattern, scaled, cancel)
            }
        }
    }

    /// Replaces each of the `columns` right-hand sides in `rhs` (one after the other) by the solution.
    pub fn solve(&mut self, rhs: &mut [f64], columns: usize) {
        let n = rhs.len().checked_div(columns).unwrap_or(0);
        if n == 0 {
            return;
        }
        for rhs in rhs.chunks_mut(MAX_RHS * n) {
            let columns = rhs.len() / n;
            self.scale_columns(rhs, n);
            let Self { symbolic, precision, double, single, x, .. } = self;
            for (to, &v) in x.chunks_exact(3 * columns).zip(&symbolic.vertex_at) {
                for (k, x) in to.iter().enumerate() {
                    let from = k % columns * n + 3 * v as usize + k / columns;
                    x.store(rhs[from].to_bits(), Ordering::Relaxed);
                }
            }
            match precision {
                Precision::Double => double.solve(symbolic, x, columns),
                Precision::Single => single.solve(symbolic, x, columns),
            }
            for (from, &v) in x.chunks_exact(3 * columns).zip(&symbolic.vertex_at) {
                for (k, x) in from.iter().enumerate() {
                    let to = k % columns * n + 3 * v as usize + k / columns;
                    rhs[to] = f64::from_bits(x.load(Ordering::Relaxed));
                }
            }
            self.scale_columns(rhs, n);
        }
    }

    /// Multiplies by what the matrix was scaled by, if it was.
    fn scale_columns(&self, columns: &mut [f64], n: usize) {
        if self.precision == Precision::Single {
            for column in columns.chunks_exact_mut(n) {
                column.iter_mut().zip(&self.scale).for_each(|(x, scale)| *x *= scale);
            }
        }
    }

    /// Bytes held.
    pub fn memory(&self) -> u64 {
        self.double.memory()
            + self.single.memory()
            + bytes(&self.scaled)
            + bytes(&self.scale)
            + bytes(&self.x)
            + self.symbolic.memory()
    }

    /// Number of scalars in the factor.
    pub fn value_count(&self) -> usize {
        self.symbolic.values
    }
}

/// The matrix `values` with a unit diagonal, in 32 bits, and what rows and columns are multiplied by for it. Where its diagonal
/// is not positive, it is not scaled, and will be refused.
fn scale_to_unit_diagonal(pattern: &Pattern, values: &[f64], scaled: &mut Vec<f32>, scale: &mut Vec<f64>) {
    let n = pattern.vertex_count();
    let inverse_root = |pivot: f64| if pivot > 0.0 && pivot.is_finite() { 1.0 / pivot.sqrt() } else { 1.0 };
    scale.clear();
    scale.extend((0..n as u32).flat_map(|v| pattern.diagonal(v)).map(|d| inverse_root(values[d])));
    scaled.resize(pattern.value_count(), 0.0);
    let scale = &scale[..];
    let mut rest = &mut scaled[..];
    let columns: Vec<&mut [f32]> = (0..n)
        .map(|v| {
            let entries = pattern.col_ptr()[3 * v + 3] - pattern.col_ptr()[3 * v];
            rest.split_off_mut(..entries as usize).unwrap_or_default()
        })
        .collect();
    columns.into_par_iter().enumerate().with_min_len(256).for_each(|(v, to)| {
        let below = pattern.column(v);
        let rows = |axis: usize| {
            let others = below.iter().flat_map(|&w| (0..3).map(move |r| 3 * w as usize + r));
            (3 * v + axis..3 * v + 3).chain(others)
        };
        let mut to = to.iter_mut();
        for (axis, start) in pattern.diagonal(v as u32).into_iter().enumerate() {
            let own = scale[3 * v + axis];
            for (from, row) in values[start..].iter().zip(rows(axis)) {
                if let Some(to) = to.next() {
                    *to = (from * own * scale[row]) as f32;
                }
            }
        }
    });
}
