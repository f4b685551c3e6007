//! Dense kernels of forward and backward substitution: one right-hand side, the panel of one front.
//!
//! A front's vector holds the entries of its columns, then of its rows, then finite padding up to the panel's leading
//! dimension.

use super::kernel::TILE;
use crate::simd::lanes::{Lanes, Scalar, for_this_processor};

/// Forward substitution: solves with the lower triangle of a panel of `columns` columns, and subtracts the product of
/// its rows below with the solution from the rest of `vector`.
pub(super) fn forward<T: Scalar>(panel: &[T], ld: usize, columns: usize, vector: &mut [T]) {
    assert!(panel.len() == ld * columns && vector.len() == ld && columns <= ld && ld.is_multiple_of(TILE));
    let (panel, vector) = (panel.as_ptr(), vector.as_mut_ptr());
    // SAFETY: the asserts are what it asks for.
    unsafe { for_this_processor!(forward_front<T>(panel: *const T, ld: usize, columns: usize, vector: *mut T)) }
}

/// Backward substitution: subtracts from the columns' part of `vector` the product of the transposed rows below with
/// the rest, and solves with the transposed triangle.
pub(super) fn backward<T: Scalar>(panel: &[T], ld: usize, columns: usize, vector: &mut [T]) {
    assert!(panel.len() == ld * columns && vector.len() == ld && columns <= ld && ld.is_multiple_of(TILE));
    let (panel, vector) = (panel.as_ptr(), vector.as_mut_ptr());
    // SAFETY: the asserts are what it asks for.
    unsafe { for_this_processor!(backward_front<T>(panel: *const T, ld: usize, columns: usize, vector: *mut T)) }
}

/// # Safety
/// The panel has `columns` columns of `ld` scalars, not fewer than there are columns and a multiple of 8; the vector
/// has as many as a column. The processor has the instructions.
#[inline(always)]
unsafe fn forward_front<V: Lanes>(panel: *const V::Scalar, ld: usize, columns: usize, vector: *mut V::Scalar) {
    for j in (0..columns).step_by(TILE) {
        let width = TILE.min(columns - j);
        // SAFETY: the tile and what is below it are within the panel and the vector.
        unsafe {
            let corner = panel.add(j * ld + j);
            let top = vector.add(j);
            let mut x = [V::Scalar::default(); TILE];
            for (n, x) in x.iter_mut().enumerate().take(width) {
                *x = *top.add(n) / *corner.add(n * ld + n);
                *top.add(n) = *x;
                for q in n + 1..TILE {
                    *top.add(q) = V::scalar_minus_product(*top.add(q), *corner.add(n * ld + q), *x);
                }
            }
            let (below, rows) = (corner.add(TILE), ld - j - TILE);
            if width == TILE {
                subtract_columns::<V, TILE>(top.add(TILE), below, ld, rows, &x);
            } else {
                for (n, x) in x.iter().enumerate().take(width) {
                    subtract_columns::<V, 1>(top.add(TILE), below.add(n * ld), ld, rows, &[*x]);
                }
            }
        }
    }
}

/// Subtracts columns times `x` from `y`.
///
/// # Safety
/// `rows` scalars at `y`, a multiple of 8, and in each column can be read, those at `y` written.
#[allow(clippy::needless_range_loop)]
#[inline(always)]
unsafe fn subtract_columns<V: Lanes, const N: usize>(
    y: *mut V::Scalar,
    columns: *const V::Scalar,
    ld: usize,
    rows: usize,
    x: &[V::Scalar; N],
) {
    // SAFETY: the caller's promise.
    unsafe {
        let mut factors = [V::splat(V::Scalar::default()); N];
        for n in 0..N {
            factors[n] = V::splat(x[n]);
        }
        let whole = rows - rows % V::COUNT;
        for i in (0..whole).step_by(V::COUNT) {
            let mut sum = V::load(y.add(i));
            for n in 0..N {
                sum = sum.minus_product(V::load(columns.add(n * ld + i)), factors[n]);
            }
            sum.store(y.add(i));
        }
        if whole < rows {
            subtract_columns::<V::Rest, N>(y.add(whole), columns.add(whole), ld, rows - whole, x);
        }
    }
}

/// # Safety
/// As [`forward_front`].
#[inline(always)]
unsafe fn backward_front<V: Lanes>(panel: *const V::Scalar, ld: usize, columns: usize, vector: *mut V::Scalar) {
    const HALF: usize = TILE / 2;
    for j in (0..columns).step_by(TILE).rev() {
        let width = TILE.min(columns - j);
        // SAFETY: as in `forward_front`.
        unsafe {
            let corner = panel.add(j * ld + j);
            let top = vector.add(j);
            let (below, y, rows) = (corner.add(TILE), top.add(TILE), ld - j - TILE);
            let mut products = [V::Scalar::default(); TILE];
            if width == TILE {
                let first = minus_products::<V::Rest, HALF>(y, below, ld, rows);
                let second = minus_products::<V::Rest, HALF>(y, below.add(HALF * ld), ld, rows);
                products[..HALF].copy_from_slice(&first);
                products[HALF..].copy_from_slice(&second);
            } else {
                for (n, product) in products.iter_mut().enumerate().take(width) {
                    [*product] = minus_products::<V::Rest, 1>(y, below.add(n * ld), ld, rows);
                }
            }
            for n in (0..width).rev() {
                let mut sum = *top.add(n) + products[n];
                for q in n + 1..TILE {
                    sum = V::scalar_minus_product(sum, *corner.add(n * ld + q), *top.add(q));
                }
                *top.add(n) = sum / *corner.add(n * ld + n);
            }
        }
    }
}

/// The negative inner products of `N` columns with `y`. Each is summed in eight lanes, whatever the SIMD width, so that
/// the bits do not depend on it.
///
/// # Safety
/// As [`subtract_columns`].
#[allow(clippy::needless_range_loop)]
#[inline(always)]
unsafe fn minus_products<V: Lanes, const N: usize>(
    y: *const V::Scalar,
    columns: *const V::Scalar,
    ld: usize,
    rows: usize,
) -> [V::Scalar; N] {
    // SAFETY: the caller's promise; there are no more than two vectors in eight lanes.
    unsafe {
        let parts = TILE / V::COUNT;
        let mut sums = [[V::splat(V::Scalar::default()); 2]; N];
        for i in (0..rows).step_by(TILE) {
            for part in 0..parts {
                let at = i + part * V::COUNT;
                let y = V::load(y.add(at));
                for n in 0..N {
                    sums[n][part] = sums[n][part].minus_product(V::load(columns.add(n * ld + at)), y);
                }
            }
        }
        let mut totals = [V::Scalar::default(); N];
        for n in 0..N {
            let mut lanes = [V::Scalar::default(); TILE];
            for part in 0..parts {
                sums[n][part].store(lanes.as_mut_ptr().add(part * V::COUNT));
            }
            totals[n] =
                ((lanes[0] + lanes[4]) + (lanes[1] + lanes[5])) + ((lanes[2] + lanes[6]) + (lanes[3] + lanes[7]));
        }
        totals
    }
}
