//! Derivatives of elements, written down as they come and then summed vertex by vertex.
//!
//! Whoever owns a vertex owns its columns of the Hessian and its entries of the gradient, so owners need no locks and
//! no arrays of their own; and as each sums its elements in the order in which they stand, the sums have the same bits
//! whoever the owners are.

use std::cmp::Ordering;

use glam::DVec3;

use super::pattern::{PairCollector, Pattern};
use crate::energy::{Direction, Row, Sink};
use crate::memory::bytes;
use crate::simd::four::{Four, Kernel, dispatch};

/// Vertices of an element, at most.
const CORNERS: usize = 4;

/// Rows of one element; more make several.
const ROWS: usize = 6;

/// What an element adds: rank-one pieces over the same vertices.
#[derive(Clone, Copy, Debug)]
struct ElementDerivatives {
    vertices: [u32; CORNERS],
    /// Its first row.
    first: u32,
    corners: u8,
    rows: u8,
    /// Whether any of its rows adds to the Hessian.
    curved: bool,
}

impl ElementDerivatives {
    #[inline]
    fn corners(&self) -> &[u32] {
        &self.vertices[..self.corners as usize]
    }
}

/// A rank-one update, with the term's weight: for each vertex the component of its direction, and in the fourth places
/// what else belongs to it. Two lines of the cache.
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

/// Bytes that a buffer takes for an element, at most.
pub(super) const ELEMENT_BYTES: usize = size_of::<ElementDerivatives>() + ROWS * size_of::<RankOneUpdate>();

/// The derivatives of some elements of one term.
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
    /// Begins anew, for a term with this weight.
    pub fn clear(&mut self, weight: f64) {
        self.elements.clear();
        self.rows.clear();
        (self.weight, self.t_gradient, self.t_hessian) = (weight, 0.0, 0.0);
    }

    /// Bytes that it holds.
    pub fn memory(&self) -> u64 {
        bytes(&self.elements) + bytes(&self.rows)
    }
}

impl Sink for ElementBuffer {
    fn rank_one(&mut self, a: Direction<'_>, g: f64, h: f64) {
        let mut row = Row { g, h, t: a.t, ..Row::default() };
        for (component, &c) in row.components.iter_mut().zip(a.components) {
            *component = c;
        }
        self.low_rank(a.vertices, &[row]);
    }

    fn low_rank(&mut self, vertices: &[u32], rows: &[Row]) {
        debug_assert!(vertices.len() <= CORNERS);
        let corners = vertices.len().min(CORNERS) as u8;
        for rows in rows.chunks(ROWS) {
            let first = self.rows.len() as u32;
            let mut curved = false;
            for row in rows {
                let update = RankOneUpdate::new(row, self.weight);
                self.t_gradient += update.g() * row.t;
                self.t_hessian += update.h() * row.t * row.t;
                curved |= update.h() != 0.0;
                self.rows.push(update);
            }
            let mut element =
                ElementDerivatives { vertices: [0; CORNERS], first, corners, rows: rows.len() as u8, curved };
            for (to, &v) in element.vertices.iter_mut().zip(vertices) {
                *to = v;
            }
            self.elements.push(element);
        }
    }
}

/// For each vertex the elements that it takes part in, in their order.
#[derive(Clone, Debug, Default)]
pub(super) struct VertexElements {
    /// For each vertex, where its entries begin.
    start: Vec<u32>,
    entries: Vec<Entry>,
}

/// A corner of a element.
#[derive(Clone, Copy, Debug, Default)]
struct Entry {
    buffer: u32,
    /// Index of the element times [`CORNERS`], and the corner.
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
        // From the end, so that entries come to stand in order and the counts end as the beginnings.
        for buffer in (0..buffers.len()).rev() {
            for (r, element) in buffers[buffer].elements.iter().enumerate().rev() {
                for (c, &v) in element.corners().iter().enumerate() {
                    let at = &mut self.start[v as usize];
                    *at -= 1;
                    self.entries[*at as usize] = Entry { buffer: buffer as u32, corner: (r * CORNERS + c) as u32 };
                }
            }
        }
    }

    /// The number of entries of the vertices below `vertex`.
    pub fn entries_below(&self, vertex: usize) -> u32 {
        self.start[vertex]
    }

    /// Bytes that it holds.
    pub fn memory(&self) -> u64 {
        bytes(&self.start) + bytes(&self.entries)
    }

    fn of(&self, vertex: usize) -> &[Entry] {
        &self.entries[self.start[vertex] as usize..self.start[vertex + 1] as usize]
    }
}

/// Some consecutive vertices, with their part of the system.
pub(super) struct ColumnBlock<'a> {
    /// The first vertex.
    pub first: usize,
    /// Their columns of the Hessian.
    pub hessian: &'a mut [f64],
    /// Their part of the gradient, three entries a vertex.
    pub gradient: &'a mut [f64],
    /// Their part of the mixed derivatives with t.
    pub border: &'a mut [f64],
    /// Pairs that the pattern lacks.
    pub missing: PairCollector,
}

/// What a thread needs while it sums.
#[derive(Default)]
pub(super) struct Scratch {
    /// For each vertex of the pattern, its place among the rows of the column that it was last in.
    mark: Vec<u32>,
    /// A block column by columns of blocks, each with a fourth entry that does not count: first the diagonal block,
    /// then those below.
    blocks: Vec<[[f64; 4]; 3]>,
}

impl Scratch {
    /// For `pattern`.
    pub fn new(pattern: &Pattern) -> Self {
        Self { mark: vec![0; pattern.vertex_count()], blocks: Vec::new() }
    }
}

impl ColumnBlock<'_> {
    /// Adds what `buffers` have for its vertices.
    pub fn add(
        &mut self,
        pattern: &Pattern,
        buffers: &[ElementBuffer],
        vertex_elements: &VertexElements,
        scratch: &mut Scratch,
    ) {
        dispatch(Sum { owner: self, pattern, buffers, vertex_elements, scratch });
    }

    /// Adds the sums of one vertex, the `local`-th of the owner.
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

/// The work of [`ColumnBlock::add`].
struct Sum<'a, 'b> {
    owner: &'a mut ColumnBlock<'b>,
    pattern: &'a Pattern,
    buffers: &'a [ElementBuffer],
    vertex_elements: &'a VertexElements,
    scratch: &'a mut Scratch,
}

impl Kernel for Sum<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Four>(self) {
        let Self { owner, pattern, buffers, vertex_elements, scratch: Scratch { mark, blocks } } = self;
        for local in 0..owner.gradient.len() / 3 {
            let v = owner.first + local;
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
            let (mut gradient, mut border) = (V::splat(0.0), V::splat(0.0));
            for entry in entries {
                let buffer = &buffers[entry.buffer as usize];
                let corner = entry.corner as usize % CORNERS;
                let element = &buffer.elements[entry.corner as usize / CORNERS];
                let rows = &buffer.rows[element.first as usize..][..element.rows as usize];
                for row in rows {
                    let component = V::load(&row.0[corner]);
                    gradient = gradient.add_scaled(row.g(), component);
                    border = border.add_scaled(row.h() * row.t(), component);
                }
                if !element.curved {
                    continue;
                }
                for (other, &w) in element.corners().iter().enumerate() {
                    let place = match (w as usize).cmp(&v) {
                        Ordering::Less => continue,
                        Ordering::Equal => 0,
                        Ordering::Greater => {
                            let k = mark[w as usize] as usize;
                            if below.get(k) != Some(&w) {
                                owner.missing.add(v as u32, w);
                                continue;
                            }
                            1 + k
                        }
                    };
                    let block = &mut blocks[place];
                    let [mut x, mut y, mut z] = [V::load(&block[0]), V::load(&block[1]), V::load(&block[2])];
                    for row in rows {
                        let [a, b, c, _] = row.0[corner];
                        let component = V::load(&row.0[other]);
                        x = x.add_scaled(row.h() * a, component);
                        y = y.add_scaled(row.h() * b, component);
                        z = z.add_scaled(row.h() * c, component);
                    }
                    x.store(&mut block[0]);
                    y.store(&mut block[1]);
                    z.store(&mut block[2]);
                }
            }
            let [mut g, mut b] = [[0.0; 4]; 2];
            gradient.store(&mut g);
            border.store(&mut b);
            owner.store(pattern, local, g, b, blocks);
        }
    }
}
