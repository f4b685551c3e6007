//! Closest points of a triangle soup and exact distances to it, by a tree of axis-aligned boxes.

use glam::DVec3;

use crate::geometry::mesh::TriangleMesh;
use crate::memory::bytes;

/// Triangles in one leaf.
const LEAF_SIZE: usize = 4;

/// Deepest path: halving the triangles at every level cannot need more with 32-bit indices.
const MAX_DEPTH: usize = 40;

/// The point of a mesh that is closest to a query.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closest {
    /// Distance from the query.
    pub distance: f64,
    /// Index of the triangle it lies on. With ties, which one is unspecified.
    pub triangle: u32,
    /// The point itself.
    pub point: DVec3,
    /// The normal of the triangle, twice its area long.
    pub normal: DVec3,
}

/// A box of the tree, stored in depth-first order: the first child of an inner box follows it.
#[derive(Clone, Copy, Debug)]
struct Node {
    low: DVec3,
    high: DVec3,
    /// Leaf: the first triangle. Inner box: the second child.
    start: u32,
    /// Number of triangles; 0 for an inner box.
    count: u32,
}

impl Node {
    #[inline]
    fn distance_squared(&self, p: DVec3) -> f64 {
        box_distance_squared(self.low, self.high, p)
    }
}

/// Squared distance of `p` from the box between two corners.
#[inline]
fn box_distance_squared(low: DVec3, high: DVec3, p: DVec3) -> f64 {
    (low - p).max(p - high).max(DVec3::ZERO).length_squared()
}

/// The box of a triangle, wider by `slack` all around.
#[inline]
fn bounds(&[a, b, c]: &[DVec3; 3], slack: f64) -> (DVec3, DVec3) {
    (a.min(b).min(c) - DVec3::splat(slack), a.max(b).max(c) + DVec3::splat(slack))
}

/// A search tree over the triangles of a mesh, which may be open, intersect itself or be degenerate.
#[derive(Clone, Debug)]
pub struct ClosestPoint {
    nodes: Vec<Node>,
    /// Corners, in the order of the leaves.
    corners: Vec<[DVec3; 3]>,
    /// The mesh's index of each entry of `corners`.
    triangles: Vec<u32>,
    /// By how much boxes are wider than what is in them: a triangle's rounded distance must not fall below that of its box, else
    /// pruning would depend on the path.
    slack: f64,
}

impl ClosestPoint {
    /// A tree over all the triangles of `mesh`.
    pub fn new(mesh: &TriangleMesh) -> Self {
        let of = |t: u32| mesh.triangles[t as usize].map(|v| mesh.positions[v as usize]);
        let mut order: Vec<u32> = (0..mesh.triangles.len() as u32).collect();
        let centres: Vec<DVec3> = order.iter().map(|&t| of(t).iter().sum::<DVec3>() / 3.0).collect();
        let largest = mesh.positions.iter().fold(0.0_f64, |m, p| m.max(p.abs().max_element()));
        let slack = 1e-14 * largest;
        let mut nodes = Vec::with_capacity(2 * order.len().div_ceil(LEAF_SIZE));
        if !order.is_empty() {
            build(&mut nodes, &mut order, 0, &|t| bounds(&of(t), slack), &centres);
        }
        Self { nodes, corners: order.iter().map(|&t| of(t)).collect(), triangles: order, slack }
    }

    /// Bytes that it holds.
    pub fn memory(&self) -> u64 {
        bytes(&self.nodes) + bytes(&self.corners) + bytes(&self.triangles)
    }

    /// Distance from `p` to the closest triangle; infinite without any.
    pub fn distance(&self, p: DVec3) -> f64 {
        self.search(p, None).map_or(f64::INFINITY, |(squared, _)| squared.sqrt())
    }

    /// The closest point to `p`; none without any triangle.
    pub fn closest(&self, p: DVec3) -> Option<Closest> {
        let (squared, slot) = self.search(p, None)?;
        let [a, b, c] = self.corners[slot];
        let point = closest_on_triangle(p, &[a, b, c]);
        let normal = (b - a).cross(c - a);
        Some(Closest { distance: squared.sqrt(), triangle: self.triangles[slot], point, normal })
    }

    /// The slot, in the tree's order, of a triangle closest to `p`: a hint for
    /// [`Self::distance_hinted`] nearby.
    pub(crate) fn hint(&self, p: DVec3) -> u32 {
        self.search(p, None).map_or(0, |(_, slot)| slot as u32)
    }

    /// The same as [`Self::distance`] to the last bit, sooner where the triangle at `hint` is close; and the hint
    /// for the next query nearby.
    pub(crate) fn distance_hinted(&self, p: DVec3, hint: u32) -> (f64, u32) {
        self.search(p, Some(hint as usize)).map_or((f64::INFINITY, 0), |(squared, slot)| (squared.sqrt(), slot as u32))
    }

    /// Whether the half-line from `p` along `direction` meets a triangle. A triangle that it meets in an edge or a corner, or
    /// that it lies in, may count or not.
    pub fn meets_ray(&self, p: DVec3, direction: DVec3) -> bool {
        let mut meets = false;
        self.along_ray(p, direction, |_, _| {
            meets = true;
            false
        });
        meets
    }

    /// [`Self::meets_ray`], where `last` is what a half-line nearby has met: it is looked at first, and becomes what this one meets.
    /// To begin with, `u32::MAX`.
    pub fn meets_ray_near(&self, p: DVec3, direction: DVec3, last: &mut u32) -> bool {
        let known = self.corners.get(*last as usize);
        if known.is_some_and(|corners| ray_triangle(p, direction, corners).is_some()) {
            return true;
        }
        let mut meets = false;
        self.slots_along_ray(p, direction, |_, slot| {
            (meets, *last) = (true, slot as u32);
            false
        });
        meets
    }

    /// Where the half-line from `p` along `direction` first meets a triangle, in multiples of `direction`. Edges and corners as
    /// for [`Self::meets_ray`].
    pub fn first_hit(&self, p: DVec3, direction: DVec3) -> Option<f64> {
        let mut first = None;
        self.along_ray(p, direction, |along, _| {
            first = Some(first.map_or(along, |first: f64| first.min(along)));
            true
        });
        first
    }

    /// The first triangle that the half-line from `p` along `direction` meets farther away than `beyond`: where, in multiples
    /// of `direction`, and its normal, twice its area long. Edges and corners as for [`Self::meets_ray`].
    pub fn next_hit(&self, p: DVec3, direction: DVec3, beyond: f64) -> Option<(f64, DVec3)> {
        let mut next: Option<(f64, DVec3)> = None;
        self.along_ray(p, direction, |along, [a, b, c]| {
            if along > beyond && next.is_none_or(|(nearest, _)| along < nearest) {
                next = Some((along, (*b - *a).cross(*c - *a)));
            }
            true
        });
        next
    }

    /// How often the half-line from `p` along `direction` leaves through the front of a triangle, less how often it enters. Edges
    /// and corners as for [`Self::meets_ray`].
    pub fn crossings(&self, p: DVec3, direction: DVec3) -> i32 {
        let mut count = 0;
        self.along_ray(p, direction, |_, [a, b, c]| {
            count += if (*b - *a).cross(*c - *a).dot(direction) > 0.0 { 1 } else { -1 };
            true
        });
        count
    }

    /// Calls `visit` with each triangle that the half-line meets and where, in no order, until it returns false.
    fn along_ray(&self, p: DVec3, direction: DVec3, mut visit: impl FnMut(f64, &[DVec3; 3]) -> bool) {
        self.slots_along_ray(p, direction, |along, slot| visit(along, &self.corners[slot]));
    }

    /// The same with the slot of each triangle.
    fn slots_along_ray(&self, p: DVec3, direction: DVec3, mut visit: impl FnMut(f64, usize) -> bool) {
        let inverse = direction.recip();
        let meets_box = |node: &Node| {
            let (to_low, to_high) = ((node.low - p) * inverse, (node.high - p) * inverse);
            let (near, far) = (to_low.min(to_high), to_low.max(to_high));
            // Not a number where the half-line runs within a face of the box: then the other axes decide.
            near.to_array().into_iter().fold(0.0, f64::max) <= far.to_array().into_iter().fold(f64::INFINITY, f64::min)
        };
        let mut stack = [0_u32; MAX_DEPTH];
        let mut height = usize::from(!self.nodes.is_empty());
        while height > 0 {
            height -= 1;
            let index = stack[height];
            let node = &self.nodes[index as usize];
            if !meets_box(node) {
                continue;
            }
            if node.count == 0 {
                stack[height] = node.start;
                stack[height + 1] = index + 1;
                height += 2;
                continue;
            }
            let from = node.start as usize;
            for (slot, corners) in (from..).zip(&self.corners[from..from + node.count as usize]) {
                if let Some(along) = ray_triangle(p, direction, corners)
                    && !visit(along, slot)
                {
                    return;
                }
            }
        }
    }

    /// Squared distance and slot of the closest triangle.
    fn search(&self, p: DVec3, hint: Option<usize>) -> Option<(f64, usize)> {
        let root = self.nodes.first()?;
        let mut best = f64::INFINITY;
        let mut slot = 0;
        if let Some(corners) = hint.and_then(|h| self.corners.get(h)) {
            best = closest_on_triangle(p, corners).distance_squared(p);
            slot = hint.unwrap_or(0);
        }
        let mut stack = [(0_u32, 0.0_f64); MAX_DEPTH];
        let mut height = 1;
        stack[0] = (0, root.distance_squared(p));
        while height > 0 {
            height -= 1;
            let (index, bound) = stack[height];
            if bound > best {
                continue;
            }
            let node = &self.nodes[index as usize];
            if node.count > 0 {
                let from = node.start as usize;
                for (i, corners) in self.corners[from..from + node.count as usize].iter().enumerate() {
                    // Takes a fraction of the distance to the triangle.
                    let (low, high) = bounds(corners, self.slack);
                    if box_distance_squared(low, high, p) > best {
                        continue;
                    }
                    let squared = closest_on_triangle(p, corners).distance_squared(p);
                    if squared < best {
                        (best, slot) = (squared, from + i);
                    }
                }
                continue;
            }
            let (near, far) = (index + 1, node.start);
            let near_bound = self.nodes[near as usize].distance_squared(p);
            let far_bound = self.nodes[far as usize].distance_squared(p);
            let (first, second) = if near_bound <= far_bound {
                ((near, near_bound), (far, far_bound))
            } else {
                ((far, far_bound), (near, near_bound))
            };
            if second.1 <= best {
                stack[height] = second;
                height += 1;
            }
            if first.1 <= best {
                stack[height] = first;
                height += 1;
            }
        }
        Some((best, slot))
    }
}

/// Appends the tree over `order`, whose first triangle has slot `offset`, and sorts `order` by leaves.
fn build(
    nodes: &mut Vec<Node>,
    order: &mut [u32],
    offset: usize,
    bounds: &dyn Fn(u32) -> (DVec3, DVec3),
    centres: &[DVec3],
) {
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (mut centre_low, mut centre_high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for &t in order.iter() {
        let (l, h) = bounds(t);
        (low, high) = (low.min(l), high.max(h));
        let c = centres[t as usize];
        (centre_low, centre_high) = (centre_low.min(c), centre_high.max(c));
    }
    let index = nodes.len();
    nodes.push(Node { low, high, start: offset as u32, count: order.len() as u32 });
    if order.len() <= LEAF_SIZE {
        return;
    }
    let extent = centre_high - centre_low;
    let axis = if extent.x >= extent.y && extent.x >= extent.z {
        0
    } else if extent.y >= extent.z {
        1
    } else {
        2
    };
    let middle = order.len() / 2;
    order.select_nth_unstable_by(middle, |&a, &b| {
        centres[a as usize][axis].total_cmp(&centres[b as usize][axis]).then(a.cmp(&b))
    });
    let (left, right) = order.split_at_mut(middle);
    build(nodes, left, offset, bounds, centres);
    let second = nodes.len() as u32;
    build(nodes, right, offset + middle, bounds, centres);
    nodes[index].start = second;
    nodes[index].count = 0;
}

/// A triangle narrower than the square root of this times its length is a sliver and counts as its three edges: the
/// projection onto its plane would be off by more.
const SLIVER: f64 = 1e-16;

/// The point of a triangle closest to `p`.
#[inline]
pub fn closest_on_triangle(p: DVec3, corners: &[DVec3; 3]) -> DVec3 {
    let [a, b, c] = *corners;
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let normal = ab.cross(ac);
    let area = normal.length_squared();
    let length = ab.length_squared().max(ac.length_squared());
    let sliver = area <= SLIVER * length * length;
    // Barycentric coordinates of b and c, times the area squared, of the projection onto the plane.
    let v = ap.cross(ac).dot(normal);
    let w = ab.cross(ap).dot(normal);
    let u = area - v - w;
    if !sliver && v >= 0.0 && w >= 0.0 && u >= 0.0 {
        let scale = area.recip();
        return a + (v * scale) * ab + (w * scale) * ac;
    }
    // Outside, the closest point is on an edge that the projection lies beyond.
    let mut best = a;
    let mut best_squared = f64::INFINITY;
    for (beyond, start, edge) in [(w, a, ab), (v, a, ac), (u, b, c - b)] {
        if sliver || beyond < 0.0 {
            let on_edge = closest_on_segment(p, start, edge);
            let squared = on_edge.distance_squared(p);
            if squared < best_squared {
                (best, best_squared) = (on_edge, squared);
            }
        }
    }
    best
}

/// Where the half-line from `p` meets the triangle: in multiples of `direction`.
pub fn ray_triangle(p: DVec3, direction: DVec3, [a, b, c]: &[DVec3; 3]) -> Option<f64> {
    let (a, b, c) = (*a - p, *b - p, *c - p);
    // Volumes that the line spans with each side: of one sign where it passes inside.
    let [u, v, w] = [[b, c], [c, a], [a, b]].map(|[s, t]| direction.dot(s.cross(t)));
    let inside = (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
    let volume = u + v + w;
    let along = a.dot((b - a).cross(c - a)) / volume;
    (inside && volume != 0.0 && along >= 0.0).then_some(along)
}

/// Barycentric coordinates of a point of a triangle: at least 0, of sum 1. In a triangle without area, the nearest
/// corner has weight 1.
pub fn barycentric(p: DVec3, [a, b, c]: [DVec3; 3]) -> [f64; 3] {
    let opposite = |q: DVec3, r: DVec3| (q - p).cross(r - p).length();
    let areas = [opposite(b, c), opposite(c, a), opposite(a, b)];
    let total: f64 = areas.iter().sum();
    if total > 0.0 && total.is_finite() {
        return areas.map(|area| area / total);
    }
    let squared = [a, b, c].map(|corner| corner.distance_squared(p));
    let nearest = (0..3).min_by(|&i, &j| squared[i].total_cmp(&squared[j])).unwrap_or(0);
    std::array::from_fn(|k| if k == nearest { 1.0 } else { 0.0 })
}

/// The parameter in [0, 1] of the point closest to `q` on the segment from the origin to `edge`; 0 where that is a point.
#[inline]
pub fn segment_parameter(q: DVec3, edge: DVec3) -> f64 {
    let length = edge.length_squared();
    if length > 0.0 { (q.dot(edge) / length).clamp(0.0, 1.0) } else { 0.0 }
}

/// The point of the segment from `a` along `edge` closest to `p`.
#[inline]
pub fn closest_on_segment(p: DVec3, a: DVec3, edge: DVec3) -> DVec3 {
    a + segment_parameter(p - a, edge) * edge
}
