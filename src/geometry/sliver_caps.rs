//! Sliver caps, triangles without area that close a T-junction, and the surface without them.
//!
//! Caps and needles are the two degenerate triangles of Botsch and Kobbelt 2001, "A robust procedure to eliminate
//! degenerate faces from triangle meshes": a cap has an angle near 180 degrees and no short edge, a needle a short edge.
//! A cap is removed by splitting the triangles beyond its longest edge; needles are left as they are.

use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap};

use glam::DVec3;

/// A triangle is a cap where both angles at its longest edge have a tangent below this: the third corner lies nearly on
/// that edge.
const MAX_TANGENT: f64 = 1e-2;

/// Splits allowed for each triangle of the mesh; caps beyond them stay. A cap takes one split, or a few where caps are
/// neighbours.
const MAX_SPLITS: usize = 8;

/// The triangles of a surface without its caps; none where it has no caps.
///
/// A cap `(v1, v2, v3)` with `v3` inside its longest edge is where `v1 v2` on the one side meets `v1 v3 v2` on the other.
/// The surface term does not couple the sides across it, since a triangle without area has no frame. So the cap is
/// removed, and each triangle `(v1, v2, p)` beyond the longest edge is split in `v3`, to `(v1, v3, p)` and `(v3, v2,
/// p)` in the same winding: with one such triangle this flips an edge. A cap whose longest edge has no other triangle
/// stays, as nothing lies beyond it.
///
/// The result is for terms that compare neighbours; it is not the surface that collides. Its order is unspecified,
/// but always the same for the same mesh. Every index must be below the number of `positions`.
pub fn without_caps(positions: &[DVec3], triangles: &[[u32; 3]]) -> Option<Vec<[u32; 3]>> {
    let caps: BinaryHeap<Cap> = (0u32..).zip(triangles).filter_map(|(k, t)| Cap::new(positions, k, t)).collect();
    if caps.is_empty() {
        return None;
    }
    let mut result =
        Retriangulation { triangles: triangles.iter().map(|&t| Some(t)).collect(), edge_triangles: HashMap::new() };
    (0u32..).zip(triangles).for_each(|(k, t)| result.join(k, t));
    let most = MAX_SPLITS.saturating_mul(triangles.len());
    result.split(positions, caps, most);
    Some(result.triangles.into_iter().flatten().collect())
}

/// The corners of a cap, its longest edge first, in its own winding; none for any other triangle.
fn cap_corners(positions: &[DVec3], &[a, b, c]: &[u32; 3]) -> Option<[u32; 3]> {
    if a == b || b == c || c == a {
        return None;
    }
    let at = |v: u32| positions[v as usize];
    let length = |[v, w, _]: &[u32; 3]| at(*v).distance_squared(at(*w));
    let turned = [[a, b, c], [b, c, a], [c, a, b]];
    let longest = turned.into_iter().max_by(|s, t| length(s).total_cmp(&length(t)))?;
    let [v1, v2, v3] = longest.map(at);
    let (edge, across) = (v2 - v1, v3 - v1);
    // All times the length of the edge.
    let height = edge.cross(across).length();
    let (before, behind) = (across.dot(edge), (v2 - v3).dot(edge));
    (before > 0.0 && behind > 0.0 && height <= MAX_TANGENT * before.min(behind)).then_some(longest)
}

/// A cap in the order of splitting: that of the longest edge first, for what lies beyond is then no cap, or one over the
/// same edge. In another order, caps next to caps would make inverted triangles.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct Cap {
    /// The bits of the squared length of its longest edge, which rise with it.
    length: u64,
    triangle: Reverse<u32>,
}

impl Cap {
    fn new(positions: &[DVec3], triangle: u32, t: &[u32; 3]) -> Option<Self> {
        let [v1, v2, _] = cap_corners(positions, t)?.map(|v| positions[v as usize]);
        Some(Self { length: v1.distance_squared(v2).to_bits(), triangle: Reverse(triangle) })
    }
}

/// The triangles during removal, with their edge-to-triangle adjacency.
struct Retriangulation {
    triangles: Vec<Option<[u32; 3]>>,
    /// The triangles at each edge. Never iterated over, so that its order does not matter.
    edge_triangles: HashMap<[u32; 2], Vec<u32>>,
}

fn edges(&[a, b, c]: &[u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]].map(|[v, w]| [v.min(w), v.max(w)])
}

impl Retriangulation {
    fn join(&mut self, k: u32, t: &[u32; 3]) {
        edges(t).into_iter().for_each(|e| self.edge_triangles.entry(e).or_default().push(k));
    }

    fn remove(&mut self, k: u32) {
        for edge in self.triangles[k as usize].take().iter().flat_map(edges) {
            self.edge_triangles.entry(edge).and_modify(|at| at.retain(|&o| o != k));
        }
    }

    fn add(&mut self, t: [u32; 3]) -> u32 {
        let k = self.triangles.len() as u32;
        self.triangles.push(Some(t));
        self.join(k, &t);
        k
    }

    /// Removes `caps`, and those that splitting makes, while no more than `most` triangles have to be split.
    fn split(&mut self, positions: &[DVec3], mut caps: BinaryHeap<Cap>, most: usize) {
        let mut splits = 0;
        while let Some(Cap { triangle: Reverse(cap), .. }) = caps.pop() {
            let Some([v1, v2, v3]) = self.triangles[cap as usize].and_then(|t| cap_corners(positions, &t)) else {
                continue;
            };
            let beyond: Vec<u32> = self
                .edge_triangles
                .get(&[v1.min(v2), v1.max(v2)])
                .into_iter()
                .flatten()
                .copied()
                // Not a triangle that repeats a corner, nor a copy of the cap, which lies on neither side of it.
                .filter(|&k| self.triangles[k as usize].is_some_and(|t| is_split_by(&t, [v1, v2, v3])))
                .collect();
            splits += beyond.len();
            if splits > most {
                return;
            }
            if beyond.is_empty() {
                continue;
            }
            self.remove(cap);
            for k in beyond {
                let Some(t) = self.triangles[k as usize] else { continue };
                self.remove(k);
                for old in [v2, v1] {
                    let half = t.map(|v| if v == old { v3 } else { v });
                    let k = self.add(half);
                    caps.extend(Cap::new(positions, k, &half));
                }
            }
        }
    }
}

/// True for a triangle over the edge `v1 v2` with a third corner other than `v3`.
fn is_split_by(t: &[u32; 3], cap: [u32; 3]) -> bool {
    t[0] != t[1] && t[1] != t[2] && t[2] != t[0] && t.iter().any(|v| !cap.contains(v))
}
