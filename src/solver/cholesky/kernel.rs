//! Dense kernels on one front: blocked Cholesky factorisation of its panel, and the product that is subtracted from its
//! contribution block (a symmetric rank-k update, SYRK).
//!
//! A panel holds the columns of a supernode, column-major: first the rows of the supernode itself, then those below,
//! then zeros up to its leading dimension `ld`, a multiple of 8. Every entry is its first value minus the products of
//! its row and its column, in the order of the columns, whatever the tiles are. So neither the number of threads nor
//! the width of the SIMD vectors changes a bit.

use std::ops::Range;

use crate::simd::lanes::{Lanes, Scalar, for_this_processor};

/// Rows and columns of a register tile; leading dimensions are multiples of it.
pub(super) const TILE: usize = 8;
/// Block size of the blocked factorisation (LAPACK's `nb`): columns whose diagonal block is factorised before the rows
/// below it are solved for.
pub(super) const BLOCK_WIDTH: usize = 6 * TILE;
/// Columns of a contribution block that are computed together: whole tiles and whole vertices.
pub(super) const COLUMN_GROUP: usize = 3 * TILE;

/// `n`, rounded up to whole tiles.
pub(super) const fn padded(n: usize) -> usize {
    n.next_multiple_of(TILE)
}

/// Scalars of a contribution block with `rows` rows. Only its lower triangle is stored, in strips of eight columns,
/// each from the row of its first diagonal entry down.
pub(super) const fn contribution_len(rows: usize) -> usize {
    contribution_start(rows, padded(rows) / TILE)
}

/// Offset of strip `block` of eight columns.
pub(super) const fn contribution_start(rows: usize, block: usize) -> usize {
    let rows = padded(rows);
    TILE * block * rows - TILE * TILE * block * block.saturating_sub(1) / 2
}

/// Offset of the diagonal entry of `column` in a contribution block with `rows` rows; the entries below it follow.
#[inline]
pub(super) const fn contribution_diagonal(rows: usize, column: usize) -> usize {
    let (block, k) = (column / TILE, column % TILE);
    contribution_start(rows, block) + k * (padded(rows) - TILE * block) + k
}

/// Rows that are computed together: those of a column group, or of the largest register tile.
const fn strip_rows<V: Lanes>() -> usize {
    if V::COUNT * V::STRIPS > COLUMN_GROUP { V::COUNT * V::STRIPS } else { COLUMN_GROUP }
}

/// A factorised diagonal tile: a lower triangular factor.
#[derive(Clone, Copy)]
struct Triangle<T> {
    /// `lower[n][q]` is the entry in row `q` and column `n`.
    lower: [[T; TILE]; TILE],
    /// Reciprocals of the diagonal.
    inverse: [T; TILE],
}

impl<T: Scalar> Triangle<T> {
    fn zero() -> Self {
        Self { lower: [[T::default(); TILE]; TILE], inverse: [T::default(); TILE] }
    }

    /// # Safety
    /// `width` columns of `width` scalars, `ld` apart, can be read at `from`.
    #[inline(always)]
    unsafe fn read(from: *const T, ld: usize, width: usize) -> Self {
        let mut triangle = Self::zero();
        for n in 0..width {
            for q in n..width {
                // SAFETY: the caller's promise.
                triangle.lower[n][q] = unsafe { *from.add(n * ld + q) };
            }
            triangle.inverse[n] = T::ONE / triangle.lower[n][n];
        }
        triangle
    }
}

/// Mode of a tile: products are subtracted from the values that it holds.
const KEEP: u8 = 0;
/// Products are subtracted from zero.
const ZERO: u8 = 1;
/// As [`KEEP`], then a triangular solve from the right (TRSM).
const SOLVE: u8 = 2;

/// The micro-kernel: subtracts `a b^T` from a tile of `S` SIMD vectors of rows and `N` columns, as `MODE` says.
///
/// # Safety
/// The tile can be written in columns `ldc` apart; `a` and `b` can be read in `depth` columns `ld` apart, rows as in
/// the tile and as many as its columns. The processor has the instructions.
#[allow(clippy::too_many_arguments, clippy::needless_range_loop)]
#[inline(always)]
unsafe fn tile<V: Lanes, const S: usize, const N: usize, const MODE: u8>(
    c: *mut V::Scalar,
    ldc: usize,
    a: *const V::Scalar,
    b: *const V::Scalar,
    ld: usize,
    depth: usize,
    triangle: &Triangle<V::Scalar>,
) {
    // SAFETY: the caller's promise. (Loops, not closures: a closure would be compiled without the instructions that are
    // chosen at run time.)
    unsafe {
        let mut sums = [[V::splat(V::Scalar::default()); S]; N];
        if MODE != ZERO {
            for n in 0..N {
                for s in 0..S {
                    sums[n][s] = V::load(c.add(n * ldc + s * V::COUNT));
                }
            }
        }
        for p in 0..depth {
            let (a, b) = (a.add(p * ld), b.add(p * ld));
            let mut rows = [V::splat(V::Scalar::default()); S];
            for s in 0..S {
                rows[s] = V::load(a.add(s * V::COUNT));
            }
            for n in 0..N {
                let column = V::splat(*b.add(n));
                for s in 0..S {
                    sums[n][s] = sums[n][s].minus_product(rows[s], column);
                }
            }
        }
        if MODE == SOLVE {
            for n in 0..N {
                let inverse = V::splat(triangle.inverse[n]);
                for s in 0..S {
                    sums[n][s] = sums[n][s].times(inverse);
                }
                for q in n + 1..N {
                    let entry = V::splat(triangle.lower[n][q]);
                    for s in 0..S {
                        sums[q][s] = sums[q][s].minus_product(sums[n][s], entry);
                    }
                }
            }
        }
        for n in 0..N {
            for s in 0..S {
                sums[n][s].store(c.add(n * ldc + s * V::COUNT));
            }
        }
    }
}

/// [`tile`] for as many `rows`, a multiple of 8, one strip below the other.
///
/// # Safety
/// As [`tile`].
#[allow(clippy::too_many_arguments)]
#[inline(always)]
unsafe fn strips<V: Lanes, const N: usize, const MODE: u8>(
    c: *mut V::Scalar,
    ldc: usize,
    a: *const V::Scalar,
    b: *const V::Scalar,
    ld: usize,
    depth: usize,
    triangle: &Triangle<V::Scalar>,
    rows: usize,
) {
    let mut i = 0;
    while i < rows {
        // SAFETY: the caller's promise; a strip ends within the rows.
        unsafe {
            let (c, a) = (c.add(i), a.add(i));
            match ((rows - i) / V::COUNT).min(V::STRIPS) {
                0 => {
                    tile::<V::Rest, 1, N, MODE>(c, ldc, a, b, ld, depth, triangle);
                    i += V::Rest::COUNT;
                }
                1 => {
                    tile::<V, 1, N, MODE>(c, ldc, a, b, ld, depth, triangle);
                    i += V::COUNT;
                }
                2 => {
                    tile::<V, 2, N, MODE>(c, ldc, a, b, ld, depth, triangle);
                    i += 2 * V::COUNT;
                }
                _ => {
                    tile::<V, 3, N, MODE>(c, ldc, a, b, ld, depth, triangle);
                    i += 3 * V::COUNT;
                }
            }
        }
    }
}

/// [`strips`] with `width` columns, 1 to 8.
///
/// # Safety
/// As [`strips`].
#[allow(clippy::too_many_arguments)]
#[inline(always)]
unsafe fn columns<V: Lanes, const MODE: u8>(
    width: usize,
    c: *mut V::Scalar,
    ldc: usize,
    a: *const V::Scalar,
    b: *const V::Scalar,
    ld: usize,
    depth: usize,
    triangle: &Triangle<V::Scalar>,
    rows: usize,
) {
    // SAFETY: the caller's promise.
    unsafe {
        match width {
            1 => strips::<V, 1, MODE>(c, ldc, a, b, ld, depth, triangle, rows),
            2 => strips::<V, 2, MODE>(c, ldc, a, b, ld, depth, triangle, rows),
            3 => strips::<V, 3, MODE>(c, ldc, a, b, ld, depth, triangle, rows),
            4 => strips::<V, 4, MODE>(c, ldc, a, b, ld, depth, triangle, rows),
            5 => strips::<V, 5, MODE>(c, ldc, a, b, ld, depth, triangle, rows),
            6 => strips::<V, 6, MODE>(c, ldc, a, b, ld, depth, triangle, rows),
            7 => strips::<V, 7, MODE>(c, ldc, a, b, ld, depth, triangle, rows),
            _ => strips::<V, 8, MODE>(c, ldc, a, b, ld, depth, triangle, rows),
        }
    }
}

/// The panel of one front: a pointer to its columns. Copies point to the same memory.
#[derive(Clone, Copy)]
pub(super) struct Panel<T> {
    start: *mut T,
    ld: usize,
}

// SAFETY: it is an address; the unsafe functions that read or write there state which rows other threads may not use.
unsafe impl<T> Send for Panel<T> {}
// SAFETY: as above.
unsafe impl<T> Sync for Panel<T> {}

impl<T: Scalar> Panel<T> {
    /// The panel in `memory`, whole columns of `ld` scalars.
    pub(super) fn new(memory: &mut [T], ld: usize) -> Self {
        Self { start: memory.as_mut_ptr(), ld }
    }

    /// Factorises the diagonal block: columns `begin..end` in the rows from `begin` to `padded(end)`. `begin` is a
    /// multiple of 8, and the columns before it are finished in these rows. False where a pivot is not positive and
    /// finite.
    ///
    /// # Safety
    /// The panel has these columns and rows, and no other thread uses these rows meanwhile.
    pub(super) unsafe fn factorise_diagonal(self, begin: usize, end: usize) -> bool {
        let Self { start, ld } = self;
        // SAFETY: the caller's promise.
        unsafe {
            for_this_processor!(factorise_diagonal<T>(start: *mut T, ld: usize, begin: usize, end: usize) -> bool)
        }
    }

    /// Solves for columns `begin..end`, at most [`BLOCK_WIDTH`], in `rows`, whole tiles of rows below `padded(end)`,
    /// after [`Self::factorise_diagonal`] and where the columns before are finished.
    ///
    /// # Safety
    /// The panel has these columns and rows, no other thread uses these rows meanwhile, and none writes those from
    /// `begin` to `end`.
    pub(super) unsafe fn finish_rows(self, begin: usize, end: usize, rows: Range<usize>) {
        let Self { start, ld } = self;
        let (top, count) = (rows.start, rows.len());
        // SAFETY: the caller's promise.
        unsafe {
            for_this_processor!(finish_rows<T>(
                start: *mut T,
                ld: usize,
                begin: usize,
                end: usize,
                top: usize,
                count: usize
            ))
        }
    }
}

#[inline(always)]
unsafe fn factorise_diagonal<V: Lanes>(start: *mut V::Scalar, ld: usize, begin: usize, end: usize) -> bool {
    let bottom = padded(end);
    for j in (begin..end).step_by(TILE) {
        let width = TILE.min(end - j);
        // SAFETY: the tile's rows and columns are within the panel, and so are those before and above it.
        unsafe {
            let rows = start.add(j);
            let corner = rows.add(j * ld);
            columns::<V, KEEP>(width, corner, ld, rows, rows, ld, j, &Triangle::zero(), TILE);
            if !factorise_tile::<V>(corner, ld, width) {
                return false;
            }
            let triangle = Triangle::read(corner, ld, width);
            let below = j + TILE;
            columns::<V, SOLVE>(width, corner.add(TILE), ld, start.add(below), rows, ld, j, &triangle, bottom - below);
        }
    }
    true
}

/// Scalar Cholesky factorisation of a diagonal tile of `width` columns; the rows below them, up to eight, are solved
/// for.
#[inline(always)]
unsafe fn factorise_tile<V: Lanes>(corner: *mut V::Scalar, ld: usize, width: usize) -> bool {
    let mut tile = [[V::Scalar::default(); TILE]; TILE];
    for (n, column) in tile.iter_mut().enumerate().take(width) {
        // SAFETY: the caller's promise.
        *column = unsafe { corner.add(n * ld).cast::<[V::Scalar; TILE]>().read() };
    }
    for n in 0..width {
        let pivot = tile[n][n];
        if !(pivot > V::Scalar::default() && pivot.is_number()) {
            return false;
        }
        let root = pivot.root();
        let inverse = V::Scalar::ONE / root;
        tile[n][n] = root;
        for entry in &mut tile[n][n + 1..] {
            *entry *= inverse;
        }
        for m in n + 1..width {
            for q in m..TILE {
                tile[m][q] = V::scalar_minus_product(tile[m][q], tile[n][q], tile[n][m]);
            }
        }
    }
    for (n, column) in tile.iter().enumerate().take(width) {
        // SAFETY: the caller's promise.
        unsafe { corner.add(n * ld).cast::<[V::Scalar; TILE]>().write(*column) };
    }
    true
}

#[inline(always)]
unsafe fn finish_rows<V: Lanes>(start: *mut V::Scalar, ld: usize, begin: usize, end: usize, top: usize, count: usize) {
    let mut triangles = [Triangle::zero(); BLOCK_WIDTH / TILE];
    for (k, triangle) in triangles.iter_mut().enumerate().take((end - begin).div_ceil(TILE)) {
        let j = begin + k * TILE;
        // SAFETY: the tile is on the diagonal of the panel.
        *triangle = unsafe { Triangle::read(start.add(j * ld + j), ld, TILE.min(end - j)) };
    }
    // A strip of rows stays in the L1 cache while all the columns are applied to it.
    for i in (top..top + count).step_by(strip_rows::<V>()) {
        let rows = strip_rows::<V>().min(top + count - i);
        for (triangle, j) in triangles.iter().zip((begin..end).step_by(TILE)) {
            // SAFETY: these rows and columns are within the panel.
            unsafe {
                let (a, b) = (start.add(i), start.add(j));
                columns::<V, SOLVE>(TILE.min(end - j), a.add(j * ld), ld, a, b, ld, j, triangle, rows);
            }
        }
    }
}

/// Sets column group `group` of a contribution block to `-L L^T`, where L is the part of a finished panel with `depth`
/// columns that begins at row `below` and has the `rows` rows of the contribution block.
pub(super) fn negative_product<T: Scalar>(
    contribution: &mut [T],
    rows: usize,
    group: usize,
    panel: &[T],
    ld: usize,
    below: usize,
    depth: usize,
) {
    let first = group * COLUMN_GROUP;
    let last = (first + COLUMN_GROUP).min(padded(rows));
    assert!(
        first < last
            && contribution.len() == contribution_start(rows, last / TILE) - contribution_start(rows, first / TILE)
    );
    assert!(below + padded(rows) <= ld && depth * ld <= panel.len());
    let (c, a) = (contribution.as_mut_ptr(), panel[below + first..].as_ptr());
    let (left, width) = (padded(rows) - first, last - first);
    // SAFETY: the asserts: the blocks are as long as the loops there take them to be, and rows `below + first ..` of
    // the panel are as many as those of the blocks.
    unsafe {
        for_this_processor!(product_group<T>(
            c: *mut T,
            left: usize,
            width: usize,
            a: *const T,
            ld: usize,
            depth: usize
        ))
    }
}

#[inline(always)]
unsafe fn product_group<V: Lanes>(
    c: *mut V::Scalar,
    rows: usize,
    width: usize,
    a: *const V::Scalar,
    ld: usize,
    depth: usize,
) {
    for i in (0..rows).step_by(strip_rows::<V>()) {
        let bottom = rows.min(i + strip_rows::<V>());
        let mut block = c;
        for j in (0..width).step_by(TILE) {
            let top = i.max(j);
            // SAFETY: a block has the rows from its own first column down, and follows the block before.
            unsafe {
                if top < bottom {
                    let (c, ldc) = (block.add(top - j), rows - j);
                    strips::<V, TILE, ZERO>(c, ldc, a.add(top), a.add(j), ld, depth, &Triangle::zero(), bottom - top);
                }
                block = block.add(TILE * (rows - j));
            }
        }
    }
}
