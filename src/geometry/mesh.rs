//! Triangle meshes and what is derived from their connectivity.

use glam::DVec3;

/// Vertices and triangles.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TriangleMesh {
    /// Position of each vertex.
    pub positions: Vec<DVec3>,
    /// Three vertex indices a triangle.
    pub triangles: Vec<[u32; 3]>,
}

impl TriangleMesh {
    /// Triangles of their own corners, which share no vertices: corner c of triangle k is vertex 3 k + c.
    pub fn from_corners(corners: impl IntoIterator<Item = [DVec3; 3]>) -> Self {
        let positions: Vec<DVec3> = corners.into_iter().flatten().collect();
        let triangles = (0..positions.len() as u32 / 3).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
        Self { positions, triangles }
    }

    /// Its vertices with other triangles on them.
    pub fn with_triangles(&self, triangles: impl IntoIterator<Item = [u32; 3]>) -> Self {
        Self { positions: self.positions.clone(), triangles: triangles.into_iter().collect() }
    }

    /// The corners of a triangle.
    #[inline]
    pub fn corners(&self, triangle: u32) -> [DVec3; 3] {
        self.triangles[triangle as usize].map(|v| self.positions[v as usize])
    }

    /// The mean of the corners of a triangle.
    pub fn centre(&self, triangle: u32) -> DVec3 {
        self.corners(triangle).iter().sum::<DVec3>() / 3.0
    }

    /// Whether each vertex is a corner of a triangle.
    pub fn used_vertices(&self) -> Vec<bool> {
        let mut used = vec![false; self.positions.len()];
        self.triangles.iter().flatten().for_each(|&v| used[v as usize] = true);
        used
    }

    /// Six times the volume inside, negative where triangles face inwards. Of an open mesh, that of the cones from the mean of its
    /// vertices.
    pub fn signed_volume(&self) -> f64 {
        let middle = self.positions.iter().sum::<DVec3>() / self.positions.len().max(1) as f64;
        let corners = |t: &[u32; 3]| t.map(|v| self.positions[v as usize] - middle);
        self.triangles.iter().map(corners).map(|[a, b, c]| a.dot(b.cross(c))).sum()
    }

    /// Area of each triangle.
    pub fn areas(&self) -> Vec<f64> {
        self.triangles.iter().map(|&t| triangle_area(t.map(|v| self.positions[v as usize]))).collect()
    }

    /// A third of the area of the triangles at each vertex.
    pub fn vertex_areas(&self) -> Vec<f64> {
        vertex_areas(&self.positions, &self.triangles)
    }
}

/// The area vector of the closed curve through `points`: half the sum of the cross products along it. It is the largest area under which
/// the curve is seen, along the line of sight.
pub fn area_vector(points: &[DVec3]) -> DVec3 {
    let next = points.iter().cycle().skip(1);
    points.iter().zip(next).map(|(&p, &q)| 0.5 * (p - points[0]).cross(q - points[0])).sum()
}

/// For each of so many vertices, those to which an edge leads from it.
pub fn neighbours(vertices: usize, edges: &[[u32; 2]]) -> Vec<Vec<u32>> {
    let mut neighbours = vec![Vec::new(); vertices];
    for &[a, b] in edges {
        neighbours[a as usize].push(b);
        neighbours[b as usize].push(a);
    }
    neighbours
}

/// A third of the area of the `triangles` at each of `positions`.
pub fn vertex_areas(positions: &[DVec3], triangles: &[[u32; 3]]) -> Vec<f64> {
    let mut areas = vec![0.0; positions.len()];
    for t in triangles {
        let share = triangle_area(t.map(|v| positions[v as usize])) / 3.0;
        t.iter().for_each(|&v| areas[v as usize] += share);
    }
    areas
}

/// Area of a triangle.
#[inline]
pub fn triangle_area([a, b, c]: [DVec3; 3]) -> f64 {
    0.5 * (b - a).cross(c - a).length()
}

/// A triangle whose doubled area is below this share of its longest edge squared has no area: its normal would be the
/// noise of coordinates that came in 32 bits.
pub const NO_AREA: f64 = 1e-6;

/// False for a degenerate triangle: its corners lie on a line or in a point, up to [`NO_AREA`].
pub fn has_area(corners: [DVec3; 3]) -> bool {
    is_wide(corners, NO_AREA)
}

/// Whether the doubled area of a triangle is more than this share of its longest edge squared.
pub fn is_wide([a, b, c]: [DVec3; 3], share: f64) -> bool {
    let longest = (b - a).length_squared().max((c - b).length_squared()).max((a - c).length_squared());
    (b - a).cross(c - a).length() > share * longest
}

/// Two triangles over one edge: `t1 = (v1, v2, v3)` and `t2 = (v2, v1, v4)`, as in Eq. 2 of the paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Hinge {
    /// `[v1, v2, v3, v4]`: the shared edge, then the corner opposite to it in each triangle.
    pub vertices: [u32; 4],
    /// Indices of `t1` and `t2`.
    pub triangles: [u32; 2],
}

/// A closed boundary curve: each vertex once, in order, the last joined to the first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BoundaryLoop {
    /// Vertex indices along the curve.
    pub vertices: Vec<u32>,
}

/// A non-manifold edge with more triangles than this is hinged between consecutive triangles only, not between all
/// pairs, whose number grows with the square.
const MAX_FAN: usize = 32;

/// The connectivity of a mesh. Triangles that repeat an index take no part in it.
///
/// Everything is in an order that depends on the indices alone.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Topology {
    /// Every edge once, the lower index first, in ascending order.
    pub edges: Vec<[u32; 2]>,
    /// Pairs of triangles over a common edge, in the order of their edges.
    ///
    /// `t1` is the triangle of lower index and gives the direction of the edge; `v4` is the other corner of `t2`,
    /// whichever way `t2` is wound. So an inconsistently wound neighbour makes the hinge that it would make after
    /// a flip. An edge with more than two triangles gives a hinge for every pair of them. Two triangles with the
    /// same three corners (`v3 = v4`) make none.
    pub hinges: Vec<Hinge>,
    /// Closed boundary curves, each in the direction of its triangles' half-edges and from its lowest vertex;
    /// ordered by that vertex. A curve that meets itself in a vertex is split there.
    pub loops: Vec<BoundaryLoop>,
    /// Boundary curves that do not close: where a boundary runs into an edge of three or more triangles.
    pub open_boundaries: Vec<Vec<u32>>,
    /// Number of connected components; triangles that share a vertex belong to the same one.
    pub components: usize,
    vertex_count: usize,
}

/// A directed side of a triangle: its edge, triangle, opposite corner, and whether it runs from low to high.
#[derive(Clone, Copy)]
struct HalfEdge {
    edge: [u32; 2],
    triangle: u32,
    opposite: u32,
    ascending: bool,
}

impl Topology {
    /// Derives the connectivity. Every index in `triangles` must be below `vertex_count`
    /// ([`TriangleMesh::check`] makes sure).
    pub fn new(vertex_count: usize, triangles: &[[u32; 3]]) -> Self {
        let mut half_edges = Vec::with_capacity(3 * triangles.len());
        for (t, &[a, b, c]) in triangles.iter().enumerate() {
            if a == b || b == c || c == a {
                continue;
            }
            for (from, to, opposite) in [(a, b, c), (b, c, a), (c, a, b)] {
                let edge = [from.min(to), from.max(to)];
                half_edges.push(HalfEdge { edge, triangle: t as u32, opposite, ascending: from < to });
            }
        }
        half_edges.sort_unstable_by_key(|h| (h.edge, h.triangle));

        let mut topology = Self { vertex_count, ..Self::default() };
        let mut boundary = Vec::new();
        for fan in half_edges.chunk_by(|h, k| h.edge == k.edge) {
            topology.edges.push(fan[0].edge);
            if let [h] = fan {
                let [low, high] = h.edge;
                boundary.push(if h.ascending { [low, high] } else { [high, low] });
            }
            for i in 0..fan.len() {
                let end = if fan.len() > MAX_FAN { (i + 2).min(fan.len()) } else { fan.len() };
                topology.hinges.extend(fan[i + 1..end].iter().filter_map(|k| hinge(&fan[i], k)));
            }
        }
        (topology.loops, topology.open_boundaries) = trace_boundary(&boundary);
        topology.components = label_pieces(vertex_count, topology.edges.iter().copied()).1;
        topology
    }

    /// Mean length of the edges at each vertex, 0 for a vertex without edges.
    pub fn mean_edge_lengths(&self, positions: &[DVec3]) -> Vec<f64> {
        let mut sums = vec![(0.0, 0u32); self.vertex_count];
        for &[a, b] in &self.edges {
            let length = positions[a as usize].distance(positions[b as usize]);
            for v in [a, b] {
                let (sum, count) = &mut sums[v as usize];
                *sum += length;
                *count += 1;
            }
        }
        sums.into_iter().map(|(sum, count)| sum / f64::from(count.max(1))).collect()
    }
}

/// The hinge of two half-edges over one edge, `h` in the triangle of lower index.
fn hinge(h: &HalfEdge, k: &HalfEdge) -> Option<Hinge> {
    let [low, high] = h.edge;
    let (v1, v2) = if h.ascending { (low, high) } else { (high, low) };
    (h.opposite != k.opposite)
        .then_some(Hinge { vertices: [v1, v2, h.opposite, k.opposite], triangles: [h.triangle, k.triangle] })
}

/// Chains directed boundary edges: closed curves, and open ones.
///
/// Walks along the half-edges; only where winding is inconsistent and no half-edge leads on is one walked
/// backwards. Whenever the walk meets itself, the part since then is cut off as a closed curve.
fn trace_boundary(boundary: &[[u32; 2]]) -> (Vec<BoundaryLoop>, Vec<Vec<u32>>) {
    // Local numbers for the boundary's vertices, in ascending order.
    let mut vertices: Vec<u32> = boundary.iter().flatten().copied().collect();
    vertices.sort_unstable();
    vertices.dedup();
    let local = |v: u32| vertices.partition_point(|&w| w < v);
    let mut leaving = vec![Vec::new(); vertices.len()];
    let mut arriving = vec![Vec::new(); vertices.len()];
    for (e, &[from, to]) in boundary.iter().enumerate() {
        leaving[local(from)].push((e, local(to)));
        arriving[local(to)].push((e, local(from)));
    }

    // Curves that cannot close begin at a vertex with an odd number of edges; those along their half-edges first.
    let odd = |v: &usize| (leaving[*v].len() + arriving[*v].len()) % 2 == 1;
    let (begin, end): (Vec<_>, Vec<_>) =
        (0..vertices.len()).filter(odd).partition(|&v| leaving[v].len() > arriving[v].len());
    let starts = begin.into_iter().chain(end).chain(0..vertices.len());

    let mut walked = vec![false; boundary.len()];
    let mut cursors = vec![[0usize; 2]; vertices.len()];
    let mut place = vec![usize::MAX; vertices.len()];
    let (mut loops, mut open) = (Vec::new(), Vec::new());
    for start in starts {
        let mut path = vec![start];
        place[start] = 0;
        loop {
            let v = path[path.len() - 1];
            let mut next = None;
            for (side, edges) in [&leaving[v], &arriving[v]].into_iter().enumerate() {
                let cursor = &mut cursors[v][side];
                while *cursor < edges.len() && walked[edges[*cursor].0] {
                    *cursor += 1;
                }
                if let Some(&edge) = edges.get(*cursor) {
                    next = Some(edge);
                    break;
                }
            }
            let Some((edge, to)) = next else { break };
            walked[edge] = true;
            if place[to] == usize::MAX {
                place[to] = path.len();
                path.push(to);
            } else {
                let mut curve: Vec<u32> = path[place[to]..].iter().map(|&w| vertices[w]).collect();
                for w in path.drain(place[to] + 1..) {
                    place[w] = usize::MAX;
                }
                let lowest = (0..curve.len()).min_by_key(|&i| curve[i]).unwrap_or(0);
                curve.rotate_left(lowest);
                loops.push(BoundaryLoop { vertices: curve });
            }
        }
        for &w in &path {
            place[w] = usize::MAX;
        }
        if path.len() > 1 {
            open.push(path.into_iter().map(|w| vertices[w]).collect());
        }
    }
    loops.sort_by(|a, b| a.vertices.cmp(&b.vertices));
    (loops, open)
}

/// The label of a vertex that belongs to no piece (connected component).
pub const NO_PIECE: u32 = u32::MAX;

/// The piece of each vertex: connected components under `links` between vertices, by union-find, numbered from 0 in the
/// order of their lowest vertices; [`NO_PIECE`] for a vertex without a link. And the number of pieces.
pub fn label_pieces(vertex_count: usize, links: impl Iterator<Item = [u32; 2]>) -> (Vec<u32>, usize) {
    let mut parent: Vec<u32> = (0..vertex_count as u32).collect();
    let mut linked = vec![false; vertex_count];
    let find = |parent: &mut [u32], mut v: u32| {
        while parent[v as usize] != v {
            let above = parent[parent[v as usize] as usize];
            parent[v as usize] = above;
            v = above;
        }
        v
    };
    for [a, b] in links {
        linked[a as usize] = true;
        linked[b as usize] = true;
        let (a, b) = (find(&mut parent, a), find(&mut parent, b));
        // The lowest vertex of a piece is its root, so that it is labelled first.
        parent[a.max(b) as usize] = a.min(b);
    }
    let mut count = 0;
    let mut labels = vec![NO_PIECE; vertex_count];
    for v in (0..vertex_count as u32).filter(|&v| linked[v as usize]) {
        let root = find(&mut parent, v);
        if root == v {
            labels[v as usize] = count;
            count += 1;
        } else {
            labels[v as usize] = labels[root as usize];
        }
    }
    (labels, count as usize)
}
