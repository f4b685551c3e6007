//! Buffers of element derivatives, and their parallel summation by column blocks.
//!
//! The columns of the Hessian and the entries of the gradient are partitioned by vertices into blocks. Each block is
//! written by one thread, without locks or private copies, and sums its elements in a fixed order: the sums have the
//! same bits for any partition.

use std::cmp::Ordering;

use glam::DVec3;

use super::pattern::{PairCollector, Pattern};
use crate::energy::{Direction, Row, Sink};
use crate::memory::bytes;
use crate::simd::f64x4::{F64x4, Kernel, dispatch};

/// Vertices of most elements, at most: those of two edges, or of a point and a triangle.
const CORNERS: usize = 4;

/// Vertices of any element, at most: those of four points on edges. Such are few; each of their rank-one updates is stored in two
/// parts.
const MOST_CORNERS: usize = 2 * CORNERS;

/// Rank-one updates of one stored element; an element with more is stored as several.
const ROWS: usize = 6;

/// The derivatives of one element: rank-one updates over the same vertices.
#[derive(Clone, Copy, Debug)]
struct ElementDerivatives {
    vertices: [u32; MOST_CORNERS],
    /// Index of the first part of its first rank-one update.
    first: u32,
    corners: u8,
    /// Number of its rank-one updates.
    rows: u8,
    /// Whether any of its updates adds to the Hessian.
    curved: bool,
}

impl ElementDerivatives {
    fn new(vertices: &[u32], first: usize, rows: usize, curved: bool) -> Self {
        let mut element = Self {
            vertices: [0; MOST_CORNERS],
            first: first as u32,
            corners: vertices.len().min(MOST_CORNERS) as u8,
            rows: rows as u8,
            curved,
        };
        for (to, &v) in element.vertices.iter_mut().zip(vertices) {
            *to = v;
        }
        element
    }

    #[inline]
    fn corners(&self) -> &[u32] {
        &self.vertices[..self.corners as usize]
    }
}

/// A rank-one update, or a part of one: adds `g a` to the gradient and `h a a^T` to the Hessian, with the term's weight in g
/// and h. A row for each vertex holds its component of the direction a; the fourth entries of the rows pack g, h and the
/// component of a along t, which are those of the first part. 128 bytes, two cache lines.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
struct RankOneUpdate([[f64; 4]; CORNERS]);

impl RankOneUpdate {
    #[inline(always)]
    fn new(row: &Row, weight: f64) -> Self {
        let [a, b, c, d] = row.components;
        let with = |p: DVec3, other| [p.x, p.y, p.z, other];
        Self([with(a, row.g * weight), with(b, row.h * weight), with(c, row.t), with(d, 0.0)])
    }

    /// Derivative along the direction.
    #[inline(always)]
    fn g(&self) -> f64 {
        self.0[0][3]
    }

    /// Second derivative along the direction.
    #[inline(always)]
    fn h(&self) -> f64 {
        self.0[1][3]
    }

    /// The direction's component along t.
    #[inline(always)]
    fn t(&self) -> f64 {
        self.0[2][3]
    }
}

/// Bytes of an element in a buffer, at most.
pub(super) const ELEMENT_BYTES: usize = size_of::<ElementDerivatives>() + ROWS * size_of::<RankOneUpdate>();

/// The derivatives of a chunk of elements of one term.
#[derive(Clone, Debug, Default)]
pub(super) struct ElementBuffer {
    weight: f64,
    elements: Vec<ElementDerivatives>,
    rows: Vec<RankOneUpdate>,
    /// Derivative by t.
    pub t_gradient: f64,
    /// Second derivative by t.
    pub t_hessian: f64,
}

impl ElementBuffer {
    /// Clears it, for a term with this weight.
    pub fn clear(&mut self, weight: f64) {
        self.elements.clear();
        self.rows.clear();
        (self.weight, self.t_gradient, self.t_hessian) = (weight, 0.0, 0.0);
    }

    /// Bytes held.
    pub fn memory(&self) -> u64 {
        bytes(&self.elements) + bytes(&self.rows)
    }
}

impl Sink for ElementBuffer {
    fn rank_one(&mut self, a: Direction<'_>, g: f64, h: f64) {
        debug_assert!(a.vertices.len() <= MOST_CORNERS);
        let part = |components: &[DVec3]| {
            let mut row = Row { g, h, t: a.t, ..Row::default() };
            for (component, &c) in row.components.iter_mut().zip(components) {
                *component = c;
            }
            row
        };
        let row = part(a.components);
        if a.vertices.len() <= CORNERS {
            return self.low_rank(a.vertices, &[row]);
        }
        let first = self.rows.len();
        let update = RankOneUpdate::new(&row, self.weight);
        self.t_gradient += update.g() * row.t;
        self.t_hessian += update.h() * row.t * row.t;
        self.rows.push(update);
        self.rows.push(RankOneUpdate::new(&part(&a.components[CORNERS..]), self.weight));
        self.elements.push(ElementDerivatives::new(a.vertices, first, 1, update.h() != 0.0));
    }

    fn low_rank(&mut self, vertices: &[u32], rows: &[Row]) {
        debug_assert!(vertices.len() <= CORNERS);
        for rows in rows.chunks(ROWS) {
            let first = self.rows.len();
            let mut curved = false;
            for row in rows {
                let update = RankOneUpdate::new(row, self.weight);
                self.t_gradient += update.g() * row.t;
                self.t_hessian += update.h() * row.t * row.t;
                curved |= update.h() != 0.0;
                self.rows.push(update);
            }
            self.elements.push(ElementDerivatives::new(vertices, first, rows.len(), curved));
        }
    }
}

/// Vertex-to-element adjacency: for each vertex its elements, in their order.
#[derive(Clone, Debug, Default)]
pub(super) struct VertexElements {
    /// For each vertex, where its entries begin.
    start: Vec<u32>,
    entries: Vec<Entry>,
}

/// A corner of an element.
#[derive(Clone, Copy, Debug, Default)]
struct Entry {
    buffer: u32,
    /// Index of the element times [`MOST_CORNERS`], and the corner.
    corner: u32,
}

impl VertexElements {
    /// Finds the elements of `buffers` around each of `vertex_count` vertices.
    pub fn find(&mut self, vertex_count: usize, buffers: &[ElementBuffer]) {
        self.start.clear();
        self.start.resize(vertex_count + 1, 0);
        for element in buffers.iter().flat_map(|buffer| &buffer.elements) {
            for &v in element.corners() {
                self.start[v as usize] += 1;
            }
        }
        let mut sum = 0;
        for start in &mut self.start {
            sum += *start;
            *start = sum;
        }
        self.entries.resize(sum as usize, Entry::default());
        // A counting sort from the end: entries stay in order, and the counts end as start offsets.
        for buffer in (0..buffers.len()).rev() {
            for (r, element) in buffers[buffer].elements.iter().enumerate().rev() {
                for (c, &v) in element.corners().iter().enumerate() {
                    let at = &mut self.start[v as usize];
                    *at -= 1;
                    self.entries[*at as usize] = Entry { buffer: buffer as u32, corner: (r * MOST_CORNERS + c) as u32 };
                }
            }
        }
    }

    /// The number of entries of the vertices below `vertex`.
    pub fn entries_below(&self, vertex: usize) -> u32 {
        self.start[vertex]
    }

    /// Bytes held.
    pub fn memory(&self) -> u64 {
        bytes(&self.start) + bytes(&self.entries)
    }

    fn of(&self, vertex: usize) -> &[Entry] {
        &self.entries[self.start[vertex] as usize..self.start[vertex + 1] as usize]
    }
}

/// A column block: consecutive vertices, with their part of the system.
pub(super) struct ColumnBlock<'a> {
    /// The first vertex.
    pub first: usize,
    /// Their columns of the Hessian.
    pub hessian: &'a mut [f64],
    /// Their part of the gradient, three entries a vertex.
    pub gradient: &'a mut [f64],
    /// Their part of the mixed derivatives with t.
    pub border: &'a mut [f64],
    /// Pairs that are missing in the pattern.
    pub missing: PairCollector,
}

/// Scratch memory of a thread while it sums.
#[derive(Default)]
pub(super) struct Scratch {
    /// For each vertex of the pattern, its index among the rows of the last column that has it.
    mark: Vec<u32>,
    /// A dense block column: the diagonal block, then those below, each by columns with a fourth, unused entry.
    blocks: Vec<[[f64; 4]; 3]>,
}

impl Scratch {
    /// Scratch memory for `pattern`.
    pub fn new(pattern: &Pattern) -> Self {
        Self { mark: vec![0; pattern.vertex_count()], blocks: Vec::new() }
    }
}

impl ColumnBlock<'_> {
    /// Adds the derivatives in `buffers` to its vertices.
    pub fn add(
        &mut self,
        pattern: &Pattern,
        buffers: &[ElementBuffer],
        vertex_elements: &VertexElements,
        scratch: &mut Scratch,
    ) {
        dispatch(Sum { block: self, pattern, buffers, vertex_elements, scratch });
    }

    /// Adds the sums of one vertex, the `local`-th of the block.
    fn store(
        &mut self,
        pattern: &Pattern,
        local: usize,
        gradient: [f64; 4],
        border: [f64; 4],
        blocks: &[[[f64; 4]; 3]],
    ) {
        for axis in 0..3 {
            self.gradient[3 * local + axis] += gradient[axis];
            self.border[3 * local + axis] += border[axis];
        }
        let offset = pattern.diagonal(self.first as u32)[0];
        let [diagonal, below @ ..] = blocks else { return };
        for (c, start) in pattern.diagonal((self.first + local) as u32).into_iter().enumerate() {
            let column = &mut self.hessian[start - offset..][..3 - c + 3 * below.len()];
            let (top, rest) = column.split_at_mut(3 - c);
            for (h, b) in top.iter_mut().zip(&diagonal[c][c..]) {
                *h += b;
            }
            for (h, b) in rest.as_chunks_mut::<3>().0.iter_mut().zip(below) {
                for (h, b) in h.iter_mut().zip(b[c]) {
                    *h += b;
                }
            }
        }
    }
}

/// The SIMD kernel of [`ColumnBlock::add`].
struct Sum<'a, 'b> {
    block: &'a mut ColumnBlock<'b>,
    pattern: &'a Pattern,
    buffers: &'a [ElementBuffer],
    vertex_elements: &'a VertexElements,
    scratch: &'a mut Scratch,
}

impl Kernel for Sum<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<V: F64x4>(self) {
        let Self { block, pattern, buffers, vertex_elements, scratch: Scratch { mark, blocks } } = self;
        for local in 0..block.gradient.len() / 3 {
            let v = block.first + local;
            let entries = vertex_elements.of(v);
            if entries.is_empty() {
                continue;
            }
            let below = pattern.column(v);
            for (k, &w) in below.iter().enumerate() {
                mark[w as usize] = k as u32;
            }
            blocks.clear();
            blocks.resize(1 + below.len(), [[0.0; 4]; 3]);
            let (gradient, border) = (V::splat(0.0), V::splat(0.0));
            let mut column = Column { v, below, mark, blocks, missing: &mut block.missing, gradient, border };
            for entry in entries {
                let buffer = &buffers[entry.buffer as usize];
                let corner = entry.corner as usize % MOST_CORNERS;
                let element = &buffer.elements[entry.corner as usize / MOST_CORNERS];
                if element.corners as usize <= CORNERS {
                    column.add::<1>(buffer, element, corner);
                } else {
                    column.add::<2>(buffer, element, corner);
                }
            }
            let Column { gradient, border, .. } = column;
            let [mut g, mut b] = [[0.0; 4]; 2];
            gradient.store(&mut g);
            border.store(&mut b);
            block.store(pattern, local, g, b, blocks);
        }
    }
}

/// The block column of a vertex while it is summed.
struct Column<'a, V> {
    v: usize,
    /// The vertices of the blocks below the diagonal, and for each vertex its index among them, if it is one of them.
    below: &'a [u32],
    mark: &'a [u32],
    blocks: &'a mut [[[f64; 4]; 3]],
    missing: &'a mut PairCollector,
    gradient: V,
    border: V,
}

impl<V: F64x4> Column<'_, V> {
    /// Adds an element whose corner `corner` is the vertex, and whose updates have `PARTS` parts.
    #[inline(always)]
    fn add<const PARTS: usize>(&mut self, buffer: &ElementBuffer, element: &ElementDerivatives, corner: usize) {
        let rows = &buffer.rows[element.first as usize..][..element.rows as usize * PARTS];
        let rows: &[[RankOneUpdate; PARTS]] = rows.as_chunks().0;
        // With one part it is the first, as the compiler then knows.
        let of = |row: &[RankOneUpdate; PARTS], corner: usize| -> [f64; 4] {
            row[(corner / CORNERS).min(PARTS - 1)].0[corner % CORNERS]
        };
        for row in rows {
            let component = V::load(&of(row, corner));
            self.gradient = self.gradient.add_scaled(row[0].g(), component);
            self.border = self.border.add_scaled(row[0].h() * row[0].t(), component);
        }
        if !element.curved {
            return;
        }
        for (other, &w) in element.corners().iter().enumerate() {
            let place = match (w as usize).cmp(&self.v) {
                Ordering::Less => continue,
                Ordering::Equal => 0,
                Ordering::Greater => {
                    let k = self.mark[w as usize] as usize;
                    if self.below.get(k) != Some(&w) {
                        self.missing.add(self.v as u32, w);
                        continue;
                    }
                    1 + k
                }
            };
            let sum = &mut self.blocks[place];
            let [mut x, mut y, mut z] = [V::load(&sum[0]), V::load(&sum[1]), V::load(&sum[2])];
            for row in rows {
                let [a, b, c, _] = of(row, corner);
                let component = V::load(&of(row, other));
                x = x.add_scaled(row[0].h() * a, component);
                y = y.add_scaled(row[0].h() * b, component);
                z = z.add_scaled(row[0].h() * c, component);
            }
            x.store(&mut sum[0]);
            y.store(&mut sum[1]);
            z.store(&mut sum[2]);
        }
    }
}
