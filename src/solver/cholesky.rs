//! Sparse Cholesky factorisation of the Hessian, by faer.
//!
//! The ordering is computed once for a pattern, by approximate minimum degree on the vertices, and expanded to their
//! three coordinates. One thread: faer's supernodal loop is serial, and asking for more makes it slower.

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::perm::PermRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::linalg::{SupernodalThreshold, amd};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side};

use super::pattern::Pattern;
use crate::error::{Error, ErrorKind, Result};
use crate::memory::{MemoryLimit, Part, bytes};

/// The symbolic analysis of one pattern, and the factor of the last matrix.
pub struct Factor {
    symbolic: SymbolicCholesky<u32>,
    values: Vec<f64>,
    memory: MemBuffer,
    scratch: usize,
}

impl Factor {
    /// Orders and analyses `pattern`.
    ///
    /// # Errors
    /// `Internal` where memory runs out.
    pub fn analyse(pattern: &Pattern) -> Result<Self> {
        Self::analyse_within(MemoryLimit::NONE, pattern)
    }

    /// [`Self::analyse`], as long as the factor has room.
    ///
    /// # Errors
    /// As [`Self::analyse`], and `MemoryLimit`.
    pub fn analyse_within(limit: MemoryLimit, pattern: &Pattern) -> Result<Self> {
        let failed = |_| Error::new(ErrorKind::Internal, "the symbolic factorisation ran out of memory or indices");
        let n = pattern.vertex_count();
        let (forward, inverse) = ordering(pattern).map_err(failed)?;
        let symbolic = factorize_symbolic_cholesky(
            SymbolicSparseColMatRef::new_checked(3 * n, 3 * n, pattern.col_ptr(), None, pattern.row_idx()),
            Side::Lower,
            SymmetricOrdering::Custom(PermRef::new_checked(&forward, &inverse, 3 * n)),
            CholeskySymbolicParams {
                supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
                ..Default::default()
            },
        )
        .map_err(failed)?;
        let scratch = StackReq::any_of(&[
            symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default()),
            symbolic.solve_in_place_scratch::<f64>(2, Par::Seq),
        ]);
        let scratch_bytes = scratch.unaligned_bytes_required();
        let bytes = (size_of::<f64>() * symbolic.len_val() + scratch_bytes) as u64;
        limit.check(&[Part { what: "the factorisation of the garment's linear system", bytes }])?;
        let memory = MemBuffer::try_new(scratch)
            .map_err(|_| Error::new(ErrorKind::Internal, "there is no memory for the factorisation's work space"))?;
        Ok(Self { values: vec![0.0; symbolic.len_val()], symbolic, memory, scratch: scratch_bytes })
    }

    /// Factorises the matrix with the given values (lower triangle, in the order of `pattern`). Returns false where it
    /// is not numerically positive definite.
    pub fn factorise(&mut self, pattern: &Pattern, values: &[f64]) -> bool {
        let n = 3 * pattern.vertex_count();
        let symbolic = SymbolicSparseColMatRef::new_checked(n, n, pattern.col_ptr(), None, pattern.row_idx());
        self.symbolic
            .factorize_numeric_llt(
                &mut self.values,
                SparseColMatRef::new(symbolic, values),
                Side::Lower,
                LltRegularization::default(),
                Par::Seq,
                MemStack::new(&mut self.memory),
                Default::default(),
            )
            .is_ok()
    }

    /// Replaces each of the `columns` right-hand sides in `rhs` (one after the other) by the solution.
    pub fn solve(&mut self, rhs: &mut [f64], columns: usize) {
        let n = self.symbolic.nrows();
        LltRef::new(&self.symbolic, &self.values).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(rhs, n, columns),
            Par::Seq,
            MemStack::new(&mut self.memory),
        );
    }

    /// Bytes that it holds, but for the symbolic analysis, which is small.
    pub fn memory(&self) -> u64 {
        bytes(&self.values) + self.scratch as u64
    }

    /// Number of scalars in the factor.
    pub fn value_count(&self) -> usize {
        self.values.len()
    }
}

/// Minimum degree ordering of the vertices, three coordinates each: forward and inverse permutation.
fn ordering(pattern: &Pattern) -> std::result::Result<(Vec<u32>, Vec<u32>), faer::sparse::FaerError> {
    let n = pattern.vertex_count();
    let mut col_ptr = vec![0u32];
    let mut rows = Vec::new();
    for j in 0..n {
        rows.push(j as u32);
        rows.extend_from_slice(pattern.column(j));
        col_ptr.push(rows.len() as u32);
    }
    let (mut forward, mut inverse) = (vec![0u32; n], vec![0u32; n]);
    let mut memory = MemBuffer::try_new(amd::order_maybe_unsorted_scratch::<u32>(n, rows.len()))
        .map_err(|_| faer::sparse::FaerError::OutOfMemory)?;
    amd::order_maybe_unsorted(
        &mut forward,
        &mut inverse,
        SymbolicSparseColMatRef::new_checked(n, n, &col_ptr, None, &rows),
        amd::Control::default(),
        MemStack::new(&mut memory),
    )?;
    let expand = |p: &[u32]| p.iter().flat_map(|&v| [3 * v, 3 * v + 1, 3 * v + 2]).collect::<Vec<u32>>();
    Ok((expand(&forward), expand(&inverse)))
}
