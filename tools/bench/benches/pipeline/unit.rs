//! The unit in which the benchmark counts: one sparse Cholesky factorisation of a garment's surface term.
//!
//! faer's supernodal factorisation, one thread, the vertices ordered by minimum degree. It asks nothing of the library's
//! own solver, so that the unit stays what it is whatever becomes of that.

use std::collections::BTreeSet;
use std::time::Instant;

use bespoke::geometry::mesh::{Topology, TriangleMesh};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::perm::PermRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::linalg::{SupernodalThreshold, amd};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Par, Side};

type Failure = Box<dyn std::error::Error>;

/// A matrix with the surface term's pattern, analysed.
pub struct Unit {
    col_ptr: Vec<u32>,
    rows: Vec<u32>,
    values: Vec<f64>,
    symbolic: SymbolicCholesky<u32>,
    factor: Vec<f64>,
    scratch: MemBuffer,
}

impl Unit {
    /// The matrix of a garment: three rows a vertex, and an entry for any two vertices of one hinge. The values are those
    /// of a Laplacian, which is positive definite with what is added to its diagonal; their time does not depend on them.
    pub fn new(garment: &TriangleMesh) -> Result<Self, Failure> {
        let n = garment.positions.len();
        let mut below = vec![BTreeSet::new(); n];
        for hinge in Topology::new(n, &garment.triangles).hinges {
            for v in hinge.vertices {
                below[v as usize].extend(hinge.vertices.into_iter().filter(|&w| w > v));
            }
        }
        let mut degree: Vec<f64> = below.iter().map(|rows| rows.len() as f64).collect();
        below.iter().flatten().for_each(|&row| degree[row as usize] += 1.0);

        let (mut col_ptr, mut rows, mut values) = (vec![0u32], Vec::new(), Vec::new());
        for (v, below) in below.iter().enumerate() {
            for axis in 0..3 {
                for row in axis..3 {
                    rows.push((3 * v + row) as u32);
                    values.push(if row == axis { 3.0 * degree[v] + 1.0 } else { 0.0 });
                }
                for &w in below {
                    rows.extend((0..3).map(|row| 3 * w + row));
                    values.extend([-1.0; 3]);
                }
                col_ptr.push(rows.len() as u32);
            }
        }
        let (forward, inverse) = order(&below)?;
        let symbolic = factorize_symbolic_cholesky(
            SymbolicSparseColMatRef::new_checked(3 * n, 3 * n, &col_ptr, None, &rows),
            Side::Lower,
            SymmetricOrdering::Custom(PermRef::new_checked(&forward, &inverse, 3 * n)),
            CholeskySymbolicParams {
                supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
                ..Default::default()
            },
        )
        .map_err(|e| format!("{e:?}"))?;
        let scratch = symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default());
        let (factor, scratch) = (vec![0.0; symbolic.len_val()], MemBuffer::try_new(scratch)?);
        Ok(Self { col_ptr, rows, values, symbolic, factor, scratch })
    }

    /// Wall seconds of one factorisation.
    pub fn measure(&mut self) -> Result<f64, Failure> {
        let n = self.col_ptr.len() - 1;
        let pattern = SymbolicSparseColMatRef::new_checked(n, n, &self.col_ptr, None, &self.rows);
        let clock = Instant::now();
        self.symbolic
            .factorize_numeric_llt(
                &mut self.factor,
                SparseColMatRef::new(pattern, &self.values),
                Side::Lower,
                LltRegularization::default(),
                Par::Seq,
                MemStack::new(&mut self.scratch),
                Default::default(),
            )
            .map_err(|e| format!("the unit's matrix is not positive definite: {e:?}"))?;
        Ok(clock.elapsed().as_secs_f64())
    }
}

/// Minimum degree order of the vertices, each expanded to its three rows: forward and inverse.
fn order(below: &[BTreeSet<u32>]) -> Result<(Vec<u32>, Vec<u32>), Failure> {
    let n = below.len();
    let (mut col_ptr, mut rows) = (vec![0u32], Vec::new());
    for (v, below) in below.iter().enumerate() {
        rows.push(v as u32);
        rows.extend(below);
        col_ptr.push(rows.len() as u32);
    }
    let (mut forward, mut inverse) = (vec![0u32; n], vec![0u32; n]);
    let mut scratch = MemBuffer::try_new(amd::order_maybe_unsorted_scratch::<u32>(n, rows.len()))?;
    amd::order_maybe_unsorted(
        &mut forward,
        &mut inverse,
        SymbolicSparseColMatRef::new_checked(n, n, &col_ptr, None, &rows),
        amd::Control::default(),
        MemStack::new(&mut scratch),
    )
    .map_err(|e| format!("{e:?}"))?;
    let expand = |order: &[u32]| order.iter().flat_map(|&v| [3 * v, 3 * v + 1, 3 * v + 2]).collect();
    Ok((expand(&forward), expand(&inverse)))
}
