//! Solves a sparse symmetric system for many right-hand sides: faer's simplicial Cholesky factorisation, after its
//! approximate minimum degree ordering.
//!
//! Not its supernodal one: that multiplies dense matrices by a library that asks for the sizes of the caches by running a
//! program, which a library in somebody else's process must not do.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::sparse::linalg::amd;
use faer::sparse::linalg::cholesky::simplicial::{
    SimplicialLltRef, factorize_simplicial_numeric_llt, factorize_simplicial_numeric_llt_scratch,
    factorize_simplicial_symbolic_cholesky, factorize_simplicial_symbolic_cholesky_scratch,
    prefactorize_symbolic_cholesky, prefactorize_symbolic_cholesky_scratch,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, Mat, Par};

use crate::control::Cancel;
use crate::error::{Error, ErrorKind, Result};

/// The lower triangle of a symmetric matrix, column after column with the diagonal first.
pub(super) struct Columns {
    /// Where each column begins, and where the last one ends.
    pub(super) start: Vec<u32>,
    /// The row of each value, ascending in a column.
    pub(super) rows: Vec<u32>,
    /// The values.
    pub(super) values: Vec<f64>,
}

/// The solution for each column of `sides`; none where the matrix is not positive definite.
///
/// # Errors
/// `Internal` without memory, `Cancelled`.
pub(super) fn solve(matrix: &Columns, sides: &Mat<f64>, cancel: &Cancel) -> Result<Option<Mat<f64>>> {
    let no_memory = || Error::new(ErrorKind::Internal, "there is no memory for the system of the skin weights");
    let n = sides.nrows();
    let buffer = |request| MemBuffer::try_new(request).map_err(|_| no_memory());
    let (mut order, mut place) = (vec![0u32; n], vec![0u32; n]);
    let pattern = SymbolicSparseColMatRef::new_checked(n, n, &matrix.start, None, &matrix.rows);
    let mut memory = buffer(amd::order_maybe_unsorted_scratch::<u32>(n, matrix.rows.len()))?;
    let control = amd::Control::default();
    amd::order_maybe_unsorted(&mut order, &mut place, pattern, control, MemStack::new(&mut memory))
        .map_err(|_| no_memory())?;

    let upper = matrix.upper_in_order(&place);
    let pattern = SymbolicSparseColMatRef::new_checked(n, n, &upper.start, None, &upper.rows);
    let (mut tree, mut counts) = (vec![0i32; n], vec![0u32; n]);
    let request = prefactorize_symbolic_cholesky_scratch::<u32>(n, upper.rows.len())
        .or(factorize_simplicial_symbolic_cholesky_scratch::<u32>(n))
        .or(factorize_simplicial_numeric_llt_scratch::<u32, f64>(n));
    let mut memory = buffer(request)?;
    let tree = prefactorize_symbolic_cholesky(&mut tree, &mut counts, pattern, MemStack::new(&mut memory));
    let symbolic = factorize_simplicial_symbolic_cholesky(pattern, tree, &counts, MemStack::new(&mut memory))
        .map_err(|_| no_memory())?;
    cancel.check()?;
    let mut factor = vec![0.0; symbolic.len_val()];
    let values = SparseColMatRef::new(pattern, &upper.values);
    let regularization = LltRegularization::default();
    let numeric =
        factorize_simplicial_numeric_llt(&mut factor, values, regularization, &symbolic, MemStack::new(&mut memory));
    if numeric.is_err() {
        return Ok(None);
    }
    cancel.check()?;
    let mut x = Mat::from_fn(n, sides.ncols(), |i, k| sides[(order[i] as usize, k)]);
    SimplicialLltRef::new(&symbolic, &factor).solve_in_place_with_conj(
        Conj::No,
        x.as_mut(),
        Par::Seq,
        MemStack::new(&mut memory),
    );
    Ok(Some(Mat::from_fn(n, sides.ncols(), |i, k| x[(place[i] as usize, k)])))
}

impl Columns {
    /// The upper triangle with each row and column at its `place`.
    fn upper_in_order(&self, place: &[u32]) -> Self {
        let mut entries = Vec::with_capacity(self.rows.len());
        for (column, range) in self.start.windows(2).enumerate() {
            for k in range[0] as usize..range[1] as usize {
                let (a, b) = (place[column], place[self.rows[k] as usize]);
                entries.push((a.max(b), a.min(b), self.values[k]));
            }
        }
        entries.sort_unstable_by_key(|&(column, row, _)| (column, row));
        let start = (0..=place.len() as u32).map(|c| entries.partition_point(|e| e.0 < c) as u32).collect();
        Self { start, rows: entries.iter().map(|e| e.1).collect(), values: entries.iter().map(|e| e.2).collect() }
    }
}
