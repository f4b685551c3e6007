//! Conjugate gradients with a factor in 32 bits as preconditioner: solutions in 64 bits at half the price.
//!
//! For `H x = b`, with `M` the product of the factor and its transpose (M. R. Hestenes, E. Stiefel 1952):
//!
//! ```text
//! a = r^T z / p^T H p,    x += a p,    r -= a H p,    z = M^-1 r,    p = z + (r^T z / its last value) p
//! ```
//!
//! `r^T z` estimates the square of the error in the norm of H, which is what a Newton step counts in: twice what the
//! quadratic model still has to give. M is H but for the rounding of 32 bits, so that one or two steps do; a direction from
//! the factor alone would be less: its error against soft directions, in the tangent planes of stiff contacts, is what the
//! step with H takes away.
//!
//! Sums are taken in pieces of fixed size, in order: the same bits for any number of threads.

use rayon::prelude::*;

use super::cholesky::{Factor, Graph};
use super::pattern::Pattern;
use crate::control::{Cancel, Cancelled};
use crate::memory::bytes;

/// It ends where the error, estimated as a fraction of the first, is below this.
const TOLERANCE: f64 = 1e-3;
/// From an error of so many times that, one more step is the last: it makes the error smaller in any case, mostly by ten times
/// and more, and to estimate it once more would take another solve.
const NEARLY: f64 = 10.0;
/// Steps after which the factor is no good.
const MAX_STEPS: usize = 10;
/// Vertices that a thread multiplies at once.
const VERTICES: usize = 512;
/// Terms of an inner product that are added one after the other.
const TERMS: usize = 4096;

/// Right-hand sides that are solved for together, at most.
const MAX_COLUMNS: usize = 2;

/// Solves with one pattern.
#[derive(Default)]
pub struct ConjugateGradients {
    /// The neighbours of each vertex; none before [`Self::set_pattern`].
    graph: Option<Graph>,
    residual: Vec<f64>,
    preconditioned: Vec<f64>,
    direction: Vec<f64>,
    product: Vec<f64>,
}

impl ConjugateGradients {
    /// Takes up another pattern.
    pub fn set_pattern(&mut self, pattern: &Pattern) {
        self.graph = Some(Graph::new(pattern));
    }

    /// Frees all memory.
    pub fn clear(&mut self) {
        *self = Self::default();
    }

    /// Bytes held.
    pub fn memory(&self) -> u64 {
        let vectors = [&self.residual, &self.preconditioned, &self.direction, &self.product];
        self.graph.as_ref().map_or(0, Graph::memory) + vectors.into_iter().map(bytes).sum::<u64>()
    }

    /// Replaces each of the one or two `columns` right-hand sides in `rhs` (one after the other) by the solution for the matrix
    /// with these `values` in the order of `pattern`, the one that was set; `factor` is of about this matrix. Returns the steps
    /// that it took. `None` where it does not converge: then `rhs` is as it was.
    ///
    /// # Errors
    /// [`Cancelled`]; `cancel` is checked before each step.
    pub fn solve(
        &mut self,
        pattern: &Pattern,
        values: &[f64],
        factor: &mut Factor,
        rhs: &mut [f64],
        columns: usize,
        cancel: &Cancel,
    ) -> Result<Option<usize>, Cancelled> {
        let Self { graph: Some(graph), residual, preconditioned, direction, product } = self else { return Ok(None) };
        assert!(columns <= MAX_COLUMNS && rhs.len() == columns * 3 * pattern.vertex_count());
        let n = 3 * pattern.vertex_count();
        let inner = |a: &[f64], b: &[f64]| -> [f64; MAX_COLUMNS] {
            let mut columns = a.chunks_exact(n.max(1)).zip(b.chunks_exact(n.max(1)));
            std::array::from_fn(|_| columns.next().map_or(0.0, |(a, b)| inner_product(a, b)))
        };
        let mut x = vec![0.0; rhs.len()];
        residual.clear();
        residual.extend_from_slice(rhs);
        preconditioned.clear();
        preconditioned.extend_from_slice(rhs);
        factor.solve(preconditioned, columns);
        direction.clear();
        direction.extend_from_slice(preconditioned);
        product.resize(rhs.len(), 0.0);
        let first = inner(residual, preconditioned);
        let mut error = first;
        let mut is_last = false;
        let is_below = |error: &[f64], tolerance: f64| {
            error.iter().zip(&first).all(|(now, first)| *now <= tolerance * tolerance * first)
        };
        for step in 1..=MAX_STEPS {
            cancel.check()?;
            for (product, direction) in product.chunks_exact_mut(n.max(1)).zip(direction.chunks_exact(n.max(1))) {
                multiply(pattern, values, graph, direction, product);
            }
            let curvature = inner(direction, product);
            // A column that is solved stays as it is.
            let length: [f64; MAX_COLUMNS] =
                std::array::from_fn(|c| if error[c] == 0.0 { 0.0 } else { error[c] / curvature[c] });
            if (0..columns).any(|c| error[c] != 0.0 && !(error[c] > 0.0 && curvature[c] > 0.0)) {
                return Ok(None);
            }
            add(n, length, direction, &mut x);
            if is_last {
                rhs.copy_from_slice(&x);
                return Ok(Some(step));
            }
            add(n, length.map(|a| -a), product, residual);
            preconditioned.copy_from_slice(residual);
            factor.solve(preconditioned, columns);
            let next = inner(residual, preconditioned);
            if is_below(&next[..columns], TOLERANCE) {
                rhs.copy_from_slice(&x);
                return Ok(Some(step));
            }
            for c in 0..columns {
                let kept = if error[c] == 0.0 { 0.0 } else { next[c] / error[c] };
                let entries = c * n..(c + 1) * n;
                direction[entries.clone()]
                    .iter_mut()
                    .zip(&preconditioned[entries])
                    .for_each(|(p, z)| *p = z + kept * *p);
            }
            error = next;
            is_last = is_below(&error[..columns], NEARLY * TOLERANCE);
        }
        Ok(None)
    }
}

/// Adds multiples of the columns of `from` to those of `to`, which have `n` rows.
fn add(n: usize, factors: [f64; MAX_COLUMNS], from: &[f64], to: &mut [f64]) {
    for ((to, from), factor) in to.chunks_exact_mut(n.max(1)).zip(from.chunks_exact(n.max(1))).zip(factors) {
        to.iter_mut().zip(from).for_each(|(to, from)| *to += factor * from);
    }
}

fn inner_product(a: &[f64], b: &[f64]) -> f64 {
    let parts: Vec<f64> =
        a.par_chunks(TERMS).zip(b.par_chunks(TERMS)).map(|(a, b)| a.iter().zip(b).map(|(a, b)| a * b).sum()).collect();
    parts.iter().sum()
}

/// `product = H x`. Each row is summed by one thread, over the vertex itself and its neighbours in their order.
fn multiply(pattern: &Pattern, values: &[f64], graph: &Graph, x: &[f64], product: &mut [f64]) {
    product.par_chunks_mut(3 * VERTICES).enumerate().for_each(|(chunk, product)| {
        for (k, to) in product.as_chunks_mut::<3>().0.iter_mut().enumerate() {
            let v = chunk * VERTICES + k;
            let own = pattern.diagonal(v as u32);
            let [a, b, c] = [x[3 * v], x[3 * v + 1], x[3 * v + 2]];
            let (first, second, third) = (&values[own[0]..][..3], &values[own[1]..][..2], values[own[2]]);
            let mut sum = [
                first[0] * a + first[1] * b + first[2] * c,
                first[1] * a + second[0] * b + second[1] * c,
                first[2] * a + second[1] * b + third * c,
            ];
            for neighbour in graph.neighbours(v as u32) {
                let w = neighbour.vertex as usize;
                let other = &x[3 * w..][..3];
                // The block is in the column of the smaller vertex.
                let columns = pattern.diagonal(w.min(v) as u32);
                for (axis, start) in columns.into_iter().enumerate() {
                    let column = &values[start + 3 - axis + 3 * neighbour.index as usize..][..3];
                    if w > v {
                        sum[axis] += column[0] * other[0] + column[1] * other[1] + column[2] * other[2];
                    } else {
                        sum.iter_mut().zip(column).for_each(|(sum, value)| *sum += value * other[axis]);
                    }
                }
            }
            *to = sum;
        }
    });
}
