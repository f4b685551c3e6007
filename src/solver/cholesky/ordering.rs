//! The adjacency graph of the garment's vertices, and a fill-reducing elimination order: approximate minimum degree (Amestoy,
//! Davis and Duff 1996), and for large garments nested dissection (Karypis and Kumar 1998).

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::amd;
use faer::sparse::{FaerError, SymbolicSparseColMatRef};
use feral_metis::{CscPattern, metis_order};

use crate::memory::bytes;
use crate::solver::pattern::Pattern;

/// An adjacent vertex: one that shares an element.
#[derive(Clone, Copy, Debug)]
pub(in crate::solver) struct Neighbour {
    /// The vertex.
    pub vertex: u32,
    /// Index of the edge's block among those below the diagonal, in the block column of the smaller vertex.
    pub index: u32,
}

/// The pattern as an undirected graph in compressed form: each edge is stored at both of its vertices.
pub(in crate::solver) struct Graph {
    start: Vec<u32>,
    neighbours: Vec<Neighbour>,
}

impl Graph {
    pub(in crate::solver) fn new(pattern: &Pattern) -> Self {
        let n = pattern.vertex_count();
        let mut start = vec![0u32; n + 2];
        for j in 0..n {
            let column = pattern.column(j);
            start[j + 2] += column.len() as u32;
            for &i in column {
                start[i as usize + 2] += 1;
            }
        }
        for j in 2..n + 2 {
            start[j] += start[j - 1];
        }
        let mut neighbours = vec![Neighbour { vertex: 0, index: 0 }; start[n + 1] as usize];
        let mut put = |at: usize, vertex: u32, index: usize| {
            neighbours[start[at + 1] as usize] = Neighbour { vertex, index: index as u32 };
            start[at + 1] += 1;
        };
        for j in 0..n {
            for (index, &i) in pattern.column(j).iter().enumerate() {
                put(j, i, index);
                put(i as usize, j as u32, index);
            }
        }
        Self { start, neighbours }
    }

    /// Bytes held.
    pub(in crate::solver) fn memory(&self) -> u64 {
        bytes(&self.start) + bytes(&self.neighbours)
    }

    /// Number of vertices.
    pub(super) fn vertex_count(&self) -> usize {
        self.start.len() - 2
    }

    /// The neighbours of `vertex`.
    #[inline]
    pub(in crate::solver) fn neighbours(&self, vertex: u32) -> &[Neighbour] {
        let v = vertex as usize;
        &self.neighbours[self.start[v] as usize..self.start[v + 1] as usize]
    }
}

/// From so many vertices on, nested dissection needs fewer operations than minimum degree, and gains more than its ordering costs.
const DISSECTED_FROM: usize = 20_000;

/// The vertices in an order of elimination with little fill; none where memory or the indices run out.
pub(super) fn fill_reducing(pattern: &Pattern, graph: &Graph) -> Option<Vec<u32>> {
    let dissected = (graph.vertex_count() >= DISSECTED_FROM).then(|| nested_dissection(graph)).flatten();
    dissected.or_else(|| minimum_degree(pattern).ok())
}

/// The vertices in an approximate minimum degree order, computed by faer.
fn minimum_degree(pattern: &Pattern) -> Result<Vec<u32>, FaerError> {
    let n = pattern.vertex_count();
    let mut col_ptr = vec![0u32];
    let mut rows = Vec::new();
    for j in 0..n {
        rows.push(j as u32);
        rows.extend_from_slice(pattern.column(j));
        col_ptr.push(rows.len() as u32);
    }
    let (mut order, mut inverse) = (vec![0u32; n], vec![0u32; n]);
    let mut memory = MemBuffer::try_new(amd::order_maybe_unsorted_scratch::<u32>(n, rows.len()))
        .map_err(|_| FaerError::OutOfMemory)?;
    amd::order_maybe_unsorted(
        &mut order,
        &mut inverse,
        SymbolicSparseColMatRef::new_checked(n, n, &col_ptr, None, &rows),
        amd::Control::default(),
        MemStack::new(&mut memory),
    )?;
    Ok(order)
}

/// The vertices in an order by nested dissection, computed by feral-metis from a fixed seed; none where it fails.
fn nested_dissection(graph: &Graph) -> Option<Vec<u32>> {
    let n = graph.vertex_count();
    let mut starts = vec![0_i32];
    let mut rows: Vec<i32> = Vec::new();
    for v in 0..n as u32 {
        let from = rows.len();
        // Its entry on the diagonal belongs to the pattern.
        rows.push(i32::try_from(v).ok()?);
        rows.extend(graph.neighbours(v).iter().map(|neighbour| neighbour.vertex as i32));
        rows[from..].sort_unstable();
        starts.push(i32::try_from(rows.len()).ok()?);
    }
    let order = metis_order(&CscPattern::new(n, &starts, &rows)?).ok()?;
    order.into_iter().map(|v| u32::try_from(v).ok()).collect()
}
