//! Initial self-intersections of the garment, and the pairs of primitives that are exempt from contact because of them.
//!
//! Two triangles that do not intersect can only begin to where a point of one meets the other, or two of their edges
//! meet. A pair of such primitives is *exempt* where every pair of triangles that it belongs to intersects already, and
//! *constrained* otherwise. So disjoint triangles have all their primitives constrained and stay disjoint, while
//! intersecting ones may move through each other and separate where nothing else is in the way. The set of intersecting
//! pairs only ever gets smaller.
//!
//! A constrained pair that also belongs to intersecting triangles lies where the surface passes through itself. It cannot
//! keep the distance that other pairs keep, and has a group of its own ([`CollisionGroup::Intersecting`]).
//!
//! The literature calls the problem *untangling*: Baraff, Witkin and Kass 2003, "Untangling cloth"; Volino and
//! Magnenat-Thalmann 2006, "Resolving surface collisions through intersection contour minimization". Both pull
//! intersecting cloth apart. Here the exempt pairs get no force: the other terms may separate them, and from then on they
//! stay separate.

use std::collections::HashMap;

use super::candidate_set::CollisionGroup;
use super::distance::PairType;
use super::surface::Surface;

/// The intersecting pairs of triangles of one surface, and its exempt pairs of primitives.
#[derive(Clone, Debug, Default)]
pub struct ExemptPairs {
    /// The lower index first, in ascending order.
    triangle_pairs: Vec<[u32; 2]>,
    /// The pairs of primitives of intersecting triangles, in the form that [`canonical`] gives them; true where exempt.
    is_exempt: HashMap<[u32; 4], bool>,
    /// For each vertex, whether an intersecting triangle has it.
    is_intersecting: Vec<bool>,
}

impl ExemptPairs {
    /// The exempt pairs of primitives for these intersecting pairs of `surface`'s triangles, in any order.
    pub fn new(surface: &Surface, triangle_pairs: &[[u32; 2]]) -> Self {
        let mut sorted: Vec<[u32; 2]> = triangle_pairs.iter().map(|&[s, t]| [s.min(t), s.max(t)]).collect();
        sorted.sort_unstable();
        sorted.dedup();
        let mut exempt = Self { triangle_pairs: sorted, ..Self::default() };
        exempt.find_exempt(surface);
        exempt
    }

    /// True without any pair.
    pub fn is_empty(&self) -> bool {
        self.triangle_pairs.is_empty()
    }

    /// The intersecting pairs of triangles, the lower index first, in ascending order.
    pub fn triangle_pairs(&self) -> &[[u32; 2]] {
        &self.triangle_pairs
    }

    /// Whether two triangles are an intersecting pair.
    pub fn contains(&self, s: u32, t: u32) -> bool {
        self.triangle_pairs.binary_search(&[s.min(t), s.max(t)]).is_ok()
    }

    /// The group of a pair of garment primitives, as the broad phase has it; none where it is exempt.
    #[inline]
    pub fn group(&self, pair_type: PairType, pair: [u32; 4]) -> Option<CollisionGroup> {
        if self.is_empty() || !pair.iter().all(|&v| self.is_intersecting[v as usize]) {
            return Some(CollisionGroup::Garment);
        }
        match self.is_exempt.get(&canonical(pair_type, pair)) {
            None => Some(CollisionGroup::Garment),
            Some(false) => Some(CollisionGroup::Intersecting),
            Some(true) => None,
        }
    }

    fn find_exempt(&mut self, surface: &Surface) {
        self.is_intersecting = vec![false; surface.vertex_count];
        let adjacency = VertexTriangles::new(surface, self.triangle_pairs.iter().flatten().copied());
        let mut is_exempt = HashMap::new();
        for &[s, t] in &self.triangle_pairs {
            for (pair_type, pair) in primitive_pairs(surface, s, t) {
                pair.iter().for_each(|&v| self.is_intersecting[v as usize] = true);
                is_exempt.entry(canonical(pair_type, pair)).or_insert_with(|| {
                    adjacency.all_triangle_pairs(surface, pair_type, pair, |s, t| self.contains(s, t))
                });
            }
        }
        self.is_exempt = is_exempt;
    }
}

/// The pairs of triangles of `surface` that hold any of the given pairs of primitives, the lower index first, in ascending
/// order.
pub fn triangle_pairs_of(surface: &Surface, pairs: &[(PairType, [u32; 4])]) -> Vec<[u32; 2]> {
    if pairs.is_empty() {
        return Vec::new();
    }
    let adjacency = VertexTriangles::new(surface, 0..surface.triangles.len() as u32);
    let mut found = Vec::new();
    for &(pair_type, pair) in pairs {
        adjacency.all_triangle_pairs(surface, pair_type, pair, |s, t| {
            found.push([s.min(t), s.max(t)]);
            true
        });
    }
    found.sort_unstable();
    found.dedup();
    found
}

/// One form for a pair of primitives, however its vertices are ordered. A point and a triangle have the point first and the
/// triangle in descending order; of two edges, each has its lower end first and the lower edge leads. The order of the last
/// two distinguishes the two types.
#[inline]
pub fn canonical(pair_type: PairType, [a, b, c, d]: [u32; 4]) -> [u32; 4] {
    match pair_type {
        PairType::PointTriangle => {
            let mut corners = [b, c, d];
            corners.sort_unstable();
            [a, corners[2], corners[1], corners[0]]
        }
        PairType::EdgeEdge => {
            let (e, f) = ([a.min(b), a.max(b)], [c.min(d), c.max(d)]);
            let [[a, b], [c, d]] = if e < f { [e, f] } else { [f, e] };
            [a, b, c, d]
        }
    }
}

/// The pairs of primitives of two triangles that have no vertex in common.
fn primitive_pairs(surface: &Surface, s: u32, t: u32) -> Vec<(PairType, [u32; 4])> {
    let [p, q] = [s, t].map(|t| surface.triangles[t as usize]);
    let mut pairs = Vec::with_capacity(15);
    for (points, triangle, index) in [(p, q, t), (q, p, s)] {
        let [a, b, c] = triangle;
        if surface.ownership(index).face() {
            pairs.extend(
                points.iter().filter(|v| !triangle.contains(v)).map(|&v| (PairType::PointTriangle, [v, a, b, c])),
            );
        }
    }
    for i in 0..3 {
        for j in 0..3 {
            let ([a, b], [c, d]) = ([p[i], p[(i + 1) % 3]], [q[j], q[(j + 1) % 3]]);
            if a != b && c != d && a != c && a != d && b != c && b != d {
                pairs.push((PairType::EdgeEdge, [a, b, c, d]));
            }
        }
    }
    pairs
}

/// Vertex-to-triangle adjacency of the vertices of some triangles.
struct VertexTriangles(HashMap<u32, Vec<u32>>);

impl VertexTriangles {
    fn new(surface: &Surface, triangles: impl Iterator<Item = u32>) -> Self {
        let mut adjacency: HashMap<u32, Vec<u32>> = HashMap::new();
        for t in triangles {
            for v in surface.triangles[t as usize] {
                adjacency.entry(v).or_default();
            }
        }
        for (t, corners) in (0..).zip(&surface.triangles) {
            for (k, v) in corners.iter().enumerate() {
                // A triangle that repeats a corner is listed once there.
                if !corners[..k].contains(v)
                    && let Some(list) = adjacency.get_mut(v)
                {
                    list.push(t);
                }
            }
        }
        Self(adjacency)
    }

    fn of(&self, v: u32) -> &[u32] {
        self.0.get(&v).map_or(&[], Vec::as_slice)
    }

    /// Whether `test` holds for all the pairs of triangles that hold the pair of primitives.
    fn all_triangle_pairs(
        &self,
        surface: &Surface,
        pair_type: PairType,
        [a, b, c, d]: [u32; 4],
        mut test: impl FnMut(u32, u32) -> bool,
    ) -> bool {
        let corners = |t: u32| &surface.triangles[t as usize];
        match pair_type {
            PairType::PointTriangle => {
                let faces = self.of(b).iter().filter(|&&t| corners(t).contains(&c) && corners(t).contains(&d));
                faces.clone().all(|&t| self.of(a).iter().all(|&s| test(s, t)))
            }
            PairType::EdgeEdge => {
                let at = |p: u32, q: u32| self.of(p).iter().filter(move |&&t| corners(t).contains(&q));
                at(a, b).all(|&s| at(c, d).all(|&t| test(s, t)))
            }
        }
    }
}
