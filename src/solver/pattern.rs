//! Sparsity pattern of the Hessian.
//!
//! The matrix is symmetric and made of 3 x 3 blocks, one for each pair of vertices that share an element. The
//! lower triangle is stored in compressed sparse columns (CSC), and the positions of a block's entries follow from its
//! index in its block column: assembly scatters directly into the array that is factorised.

use crate::memory::bytes;

/// Sparsity of a symmetric block matrix, lower triangle, diagonal included.
#[derive(Clone, Debug, Default)]
pub struct Pattern {
    /// For each block column, where its rows begin in `rows`.
    column_start: Vec<u32>,
    /// Block rows strictly below the diagonal, ascending in each column.
    rows: Vec<u32>,
    /// Where the scalar columns begin.
    col_ptr: Vec<u32>,
}

/// Collects pairs of vertices before they become a [`Pattern`].
#[derive(Clone, Debug, Default)]
pub struct PairCollector {
    pairs: Vec<u64>,
}

impl PairCollector {
    /// Adds all the pairs among `vertices`.
    pub fn add_clique(&mut self, vertices: &[u32]) {
        for (k, &a) in vertices.iter().enumerate() {
            for &b in &vertices[..k] {
                self.add(a, b);
            }
        }
    }

    /// Adds one pair.
    #[inline]
    pub fn add(&mut self, a: u32, b: u32) {
        if a != b {
            self.pairs.push((u64::from(a.min(b)) << 32) | u64::from(a.max(b)));
        }
    }

    /// True without any pair.
    pub fn is_empty(&self) -> bool {
        self.pairs.is_empty()
    }

    /// Moves the pairs of `other` here.
    pub fn append(&mut self, other: &mut PairCollector) {
        self.pairs.append(&mut other.pairs);
    }
}

impl Pattern {
    /// The pattern over `vertex_count` vertices with the collected pairs.
    pub fn new(vertex_count: usize, mut collected: PairCollector) -> Self {
        collected.pairs.sort_unstable();
        collected.pairs.dedup();
        let mut column_start = vec![0u32; vertex_count + 1];
        for &p in &collected.pairs {
            column_start[(p >> 32) as usize + 1] += 1;
        }
        for j in 0..vertex_count {
            column_start[j + 1] += column_start[j];
        }
        let rows: Vec<u32> = collected.pairs.iter().map(|&p| p as u32).collect();
        let mut col_ptr = Vec::with_capacity(3 * vertex_count + 1);
        let mut end = 0;
        col_ptr.push(end);
        for below in column_start.windows(2).map(|ends| ends[1] - ends[0]) {
            for c in 0..3 {
                end += 3 - c + 3 * below;
                col_ptr.push(end);
            }
        }
        Self { column_start, rows, col_ptr }
    }

    /// The union of this pattern and further pairs.
    pub fn extended(&self, mut extra: PairCollector) -> Self {
        for j in 0..self.vertex_count() {
            for &i in self.column(j) {
                extra.add(j as u32, i);
            }
        }
        Self::new(self.vertex_count(), extra)
    }

    /// Bytes held.
    pub fn memory(&self) -> u64 {
        [&self.column_start, &self.rows, &self.col_ptr].into_iter().map(bytes).sum()
    }

    /// Number of block columns.
    pub fn vertex_count(&self) -> usize {
        self.column_start.len().saturating_sub(1)
    }

    /// Number of stored scalars.
    pub fn value_count(&self) -> usize {
        self.col_ptr.last().map_or(0, |&end| end as usize)
    }

    /// Block rows strictly below the diagonal of block column `j`, ascending. Each of the three scalar columns holds
    /// the entries of the diagonal block, those on and below the diagonal, and then three for each block row.
    pub fn column(&self, j: usize) -> &[u32] {
        &self.rows[self.column_start[j] as usize..self.column_start[j + 1] as usize]
    }

    /// Scalar column pointers of the lower triangle; the first entry of a column is its diagonal.
    pub fn col_ptr(&self) -> &[u32] {
        &self.col_ptr
    }

    /// Scalar row indices of the lower triangle. They follow from the blocks, and are not kept.
    pub fn row_idx(&self) -> Vec<u32> {
        let scalar_column = |j: usize, c: u32| {
            let own = c..3;
            let below = self.column(j).iter().flat_map(|&i| [3 * i, 3 * i + 1, 3 * i + 2]);
            own.map(move |r| 3 * j as u32 + r).chain(below)
        };
        (0..self.vertex_count()).flat_map(|j| (0..3).flat_map(move |c| scalar_column(j, c))).collect()
    }

    /// Offset of the diagonal entry of each of the three scalar columns of block column `j`; the entries below it
    /// within the diagonal block follow.
    #[inline]
    pub fn diagonal(&self, j: u32) -> [usize; 3] {
        let j = 3 * j as usize;
        [self.col_ptr[j] as usize, self.col_ptr[j + 1] as usize, self.col_ptr[j + 2] as usize]
    }
}
