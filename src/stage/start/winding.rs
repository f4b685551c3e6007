//! Around which bones the closed curves of a surface wind.
//!
//! A closed curve winds around a bone where it is linked with the skeleton there: no motion that keeps clear of the bones
//! takes it off them. The skeleton is a graph in space whose ends go on to infinity, so that each path from one end to
//! another is a line, and so is each of its cycles; the linking numbers of a curve with these lines say what it winds
//! around. They are counted, not integrated: from each bone a curtain hangs along one direction to infinity, and a curve is
//! linked with a line as often as it crosses the curtains along it, with signs. So each edge of the surface has a vector of
//! crossings, the edges of a triangle sum up to nothing unless a bone passes through the triangle, and what is left over at
//! the edges that close a spanning tree of the surface generates the vectors of all its closed curves. None of that
//! depends on how the surface is cut into triangles.
//!
//! What the ends do beyond the skeleton is arbitrary, and a ring beyond a hand is not around it. So the ends lead away
//! sideways, in several directions one after the other, and the majority decides.

use std::collections::BTreeSet;
use std::f64::consts::TAU;

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use crate::geometry::mesh::{NO_PIECE, TriangleMesh};
use crate::maths;

/// Directions in which the ends go on, one after the other.
const ENDS: usize = 5;
/// Their angle to the bone's own: a ring of radius r is around a bone's end up to 0.27 r beyond it.
const TILT: f64 = 75.0 * TAU / 360.0;
/// Ends go on for as many sizes of the scene.
const FAR: f64 = 1e3;
/// The direction of the curtains: none that a modelled skeleton has.
const CURTAIN: DVec3 = DVec3::new(0.267_261_241_912, -0.534_522_483_824, 0.801_783_725_737);
/// Below this a residual of whole numbers is none.
const NONE: f64 = 1e-6;

/// A bone, or one of the ends that go on: a segment of the graph, seen along the curtains.
#[derive(Clone, Copy)]
struct Strand {
    ends: [DVec2; 2],
    heights: [f64; 2],
}

/// The skeleton as a graph: joints where ends of bones coincide, and the lines through it.
struct Graph {
    /// The bones with a length: their index and the joints at their ends.
    bones: Vec<(u32, [usize; 2])>,
    /// Joints with one bone: position, and the direction in which that bone ends there.
    ends: Vec<[DVec3; 2]>,
    /// Lines: for each of them, the strands that it runs along, with signs. Bones come first, then ends.
    lines: Vec<Vec<(usize, f64)>>,
}

/// What a piece of the surface winds around.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Winding {
    /// A closed curve on it is linked with the skeleton. Not always with one bone: a sash is around the chest between neck and
    /// shoulder.
    pub linked: bool,
    /// The segments that closed curves on it are linked with, ascending. Segments in a row without a branch are all the same to
    /// a curve, and come together.
    pub segments: Vec<u32>,
}

/// For each of `count` pieces what it winds around. `edges` are those of `garment`, each once in ascending
/// order, the lower index first; `pieces` has the piece of each vertex; ends of segments at one place are one joint.
pub fn windings(
    garment: &TriangleMesh,
    edges: &[[u32; 2]],
    pieces: &[u32],
    count: usize,
    segments: &[[DVec3; 2]],
) -> Vec<Winding> {
    let graph = Graph::new(segments);
    let points = || garment.positions.iter().chain(segments.iter().flatten()).copied();
    let low = points().fold(DVec3::INFINITY, DVec3::min);
    let high = points().fold(DVec3::NEG_INFINITY, DVec3::max);
    let far = FAR * low.distance(high);
    let axes = CURTAIN.normalize().any_orthonormal_pair();
    let flat = |p: DVec3| (DVec2::new(p.dot(axes.0), p.dot(axes.1)), p.dot(CURTAIN));
    let strand = |[a, b]: [DVec3; 2]| {
        let ((a, ha), (b, hb)) = (flat(a), flat(b));
        Strand { ends: [a, b], heights: [ha, hb] }
    };
    let vertices: Vec<(DVec2, f64)> = garment.positions.iter().map(|&p| flat(p)).collect();
    let bones: Vec<Strand> = graph.bones.iter().map(|&(k, _)| strand(segments[k as usize])).collect();
    let crossed = crossings(edges, &vertices, &bones);

    let votes: Vec<Vec<Winding>> = (0..ENDS)
        .into_par_iter()
        .map(|k| {
            let turn = TAU * k as f64 / ENDS as f64;
            let away = |&[tip, along]: &[DVec3; 2]| {
                let (u, v) = along.any_orthonormal_pair();
                let aside = maths::cos(turn) * u + maths::sin(turn) * v;
                strand([tip, tip + far * (maths::cos(TILT) * along + maths::sin(TILT) * aside)])
            };
            let ends: Vec<Strand> = graph.ends.iter().map(away).collect();
            let beyond = crossings(edges, &vertices, &ends);
            Surface { garment, edges, pieces, count }.windings(&graph, &crossed, &beyond)
        })
        .collect();
    let most = |is: &dyn Fn(&Winding) -> bool, piece: usize| {
        2 * votes.iter().filter(|windings| is(&windings[piece])).count() > ENDS
    };
    (0..count)
        .map(|piece| Winding {
            linked: most(&|winding| winding.linked, piece),
            segments: graph
                .bones
                .iter()
                .map(|&(segment, _)| segment)
                .filter(|segment| most(&|winding| winding.segments.contains(segment), piece))
                .collect(),
        })
        .collect()
}

/// What each of `loops`, closed curves of vertices of `mesh` in order, winds around.
pub fn windings_of_loops(mesh: &TriangleMesh, loops: &[&[u32]], segments: &[[DVec3; 2]]) -> Vec<Winding> {
    // Each loop has vertices of its own: two that touch in one are two curves all the same.
    let (mut curves, mut edges, mut pieces) = (TriangleMesh::default(), Vec::new(), Vec::new());
    for (piece, vertices) in (0u32..).zip(loops) {
        let (first, count) = (curves.positions.len() as u32, vertices.len() as u32);
        curves.positions.extend(vertices.iter().map(|&v| mesh.positions[v as usize]));
        pieces.extend(vertices.iter().map(|_| piece));
        edges.extend((1..count).map(|k| [first + k - 1, first + k]));
        edges.push([first, first + count - 1]);
    }
    edges.sort_unstable();
    windings(&curves, &edges, &pieces, loops.len(), segments)
}

/// For each edge the strands whose curtains it crosses, with signs, from its lower vertex to the other.
fn crossings(edges: &[[u32; 2]], vertices: &[(DVec2, f64)], strands: &[Strand]) -> Vec<Vec<(usize, f64)>> {
    let of_edge = |&[u, v]: &[u32; 2]| {
        let (u, v) = (vertices[u as usize], vertices[v as usize]);
        let crossed = strands.iter().enumerate().filter_map(|(k, strand)| strand.crossed([u, v]).map(|sign| (k, sign)));
        crossed.collect()
    };
    edges.par_iter().map(of_edge).collect()
}

impl Strand {
    /// The sign with which an edge crosses the curtain, if it does.
    fn crossed(&self, [(u, hu), (v, hv)]: [(DVec2, f64); 2]) -> Option<f64> {
        let [p, q] = self.ends;
        let side = |a: DVec2, b: DVec2, c: DVec2| (b - a).perp_dot(c - a);
        // Half-open: what lies on a line is on its left.
        let (from, to) = (side(p, q, u), side(p, q, v));
        if (from >= 0.0) == (to >= 0.0) {
            return None;
        }
        let (start, end) = (side(u, v, p), side(u, v, q));
        if (start >= 0.0) == (end >= 0.0) {
            return None;
        }
        let edge = hu + (hv - hu) * (from / (from - to));
        let strand = self.heights[0] + (self.heights[1] - self.heights[0]) * (start / (start - end));
        (edge > strand).then_some(if from >= 0.0 { 1.0 } else { -1.0 })
    }
}

impl Graph {
    fn new(segments: &[[DVec3; 2]]) -> Self {
        let mut places: Vec<[u64; 3]> = segments.iter().flatten().map(key).collect();
        places.sort_unstable();
        places.dedup();
        let joint = |p: &DVec3| places.partition_point(|place| *place < key(p));
        let bones: Vec<(u32, [usize; 2])> =
            (0u32..).zip(segments).map(|(k, [a, b])| (k, [joint(a), joint(b)])).filter(|(_, [a, b])| a != b).collect();
        let mut at = vec![Vec::new(); places.len()];
        for (local, &(_, [a, b])) in bones.iter().enumerate() {
            at[a].push(local);
            at[b].push(local);
        }

        let mut ends = Vec::new();
        // The signed strands of the way from each joint to the root of its component.
        let mut ways: Vec<Option<Vec<(usize, f64)>>> = vec![None; places.len()];
        let mut lines = Vec::new();
        for root in 0..places.len() {
            if ways[root].is_some() || at[root].is_empty() {
                continue;
            }
            ways[root] = Some(Vec::new());
            let (mut stack, mut tree, mut component) = (vec![root], BTreeSet::new(), BTreeSet::new());
            let mut first: Option<Vec<(usize, f64)>> = None;
            while let Some(j) = stack.pop() {
                let way = ways[j].clone().unwrap_or_default();
                if let [local] = at[j][..] {
                    let (segment, [a, _]) = bones[local];
                    let [p, q] = segments[segment as usize];
                    let (other, tip) = if a == j { (q, p) } else { (p, q) };
                    let mut line = vec![(bones.len() + ends.len(), -1.0)];
                    ends.push([tip, (tip - other).normalize_or(DVec3::Z)]);
                    line.extend(&way);
                    match &first {
                        None => first = Some(line),
                        Some(first) => lines.push(difference(&line, first)),
                    }
                }
                for &local in &at[j] {
                    component.insert(local);
                    let [a, b] = bones[local].1;
                    let other = if a == j { b } else { a };
                    if ways[other].is_none() {
                        tree.insert(local);
                        // From the other joint to this one, then on.
                        let mut on = vec![(local, if a == other { 1.0 } else { -1.0 })];
                        on.extend(&way);
                        ways[other] = Some(on);
                        stack.push(other);
                    }
                }
            }
            for &local in component.difference(&tree) {
                let [from, to] = bones[local].1.map(|j| ways[j].clone().unwrap_or_default());
                let mut cycle = vec![(local, 1.0)];
                cycle.extend(&to);
                lines.push(difference(&cycle, &from));
            }
        }
        Self { bones, ends, lines }
    }

    /// What a curve has that is linked once with each of some `strands`, by strand with a factor: its numbers for all lines.
    fn vector(&self, strands: &[(usize, f64)]) -> Vec<f64> {
        let of_line = |line: &Vec<(usize, f64)>| -> f64 {
            let factor = |&(strand, sign): &(usize, f64)| -> f64 {
                line.iter().filter(|(along, _)| *along == strand).map(|(_, direction)| sign * direction).sum()
            };
            strands.iter().map(factor).sum()
        };
        self.lines.iter().map(of_line).collect()
    }
}

fn key(p: &DVec3) -> [u64; 3] {
    // Adding 0 turns -0 into 0.
    p.to_array().map(|x| (x + 0.0).to_bits())
}

/// One way less another: what both run along cancels out.
fn difference(way: &[(usize, f64)], other: &[(usize, f64)]) -> Vec<(usize, f64)> {
    let mut sum: Vec<(usize, f64)> = way.to_vec();
    for &(strand, sign) in other {
        match sum.iter_mut().find(|(known, _)| *known == strand) {
            Some((_, known)) => *known -= sign,
            None => sum.push((strand, -sign)),
        }
    }
    sum.retain(|(_, sign)| *sign != 0.0);
    sum
}

/// The surface whose closed curves are looked at.
struct Surface<'a> {
    garment: &'a TriangleMesh,
    edges: &'a [[u32; 2]],
    pieces: &'a [u32],
    count: usize,
}

impl Surface<'_> {
    /// What each piece winds around, given the curtains that the edges cross: those of the bones of `graph`, and of its ends.
    fn windings(&self, graph: &Graph, crossed: &[Vec<(usize, f64)>], beyond: &[Vec<(usize, f64)>]) -> Vec<Winding> {
        let size = graph.lines.len();
        let none = vec![0.0; size];
        let first_end = graph.bones.len();
        let vectors: Vec<Option<Vec<f64>>> = crossed
            .par_iter()
            .zip(beyond)
            .map(|(bones, ends)| {
                let mut strands = bones.clone();
                strands.extend(ends.iter().map(|&(end, sign)| (first_end + end, sign)));
                (!strands.is_empty()).then(|| graph.vector(&strands))
            })
            .collect();
        let vector = |edge: usize| vectors[edge].as_ref().unwrap_or(&none);
        let mut pierced = vec![BTreeSet::new(); self.count];
        for t in self.garment.triangles.iter().filter(|[a, b, c]| a != b && b != c && c != a) {
            let mut sum = none.clone();
            let mut touched = false;
            for (from, to) in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])] {
                let Ok(edge) = self.edges.binary_search(&[from.min(to), from.max(to)]) else { continue };
                if let Some(vector) = &vectors[edge] {
                    let sign = if from < to { 1.0 } else { -1.0 };
                    sum.iter_mut().zip(vector).for_each(|(s, v)| *s += sign * v);
                    touched = true;
                }
            }
            if touched && sum.iter().any(|&s| s != 0.0) {
                pierced[self.pieces[t[0] as usize] as usize].insert(whole(&sum));
            }
        }

        let mut closed = vec![BTreeSet::new(); self.count];
        self.integrate(size, vector, &mut closed);
        let meridians: Vec<Vec<f64>> = (0..first_end).map(|bone| graph.vector(&[(bone, 1.0)])).collect();
        let winding = |(pierced, closed): (BTreeSet<Vec<i64>>, BTreeSet<Vec<i64>>)| {
            if closed.is_empty() {
                return Winding::default();
            }
            // A curve around a place where a bone passes through the surface winds around that bone, and encloses nothing.
            let mut filled = Basis::default();
            pierced.iter().for_each(|v| filled.add(&fractional(v)));
            let mut all = filled.clone();
            closed.iter().for_each(|v| all.add(&fractional(v)));
            let wound = graph.bones.iter().zip(&meridians).filter(|(_, m)| !filled.contains(m) && all.contains(m));
            Winding { linked: all.rows.len() > filled.rows.len(), segments: wound.map(|(bone, _)| bone.0).collect() }
        };
        pierced.into_iter().zip(closed).map(winding).collect()
    }

    /// Sums the vectors along a spanning tree of each piece; what is left over at the other edges is added to `closed`.
    fn integrate<'v>(&self, size: usize, vector: impl Fn(usize) -> &'v Vec<f64>, closed: &mut [BTreeSet<Vec<i64>>]) {
        let count = self.garment.positions.len();
        let mut first = vec![0usize; count + 1];
        self.edges.iter().flatten().for_each(|&v| first[v as usize + 1] += 1);
        (0..count).for_each(|v| first[v + 1] += first[v]);
        let mut next = first.clone();
        let mut at = vec![0usize; 2 * self.edges.len()];
        for (edge, ends) in self.edges.iter().enumerate() {
            for &v in ends {
                at[next[v as usize]] = edge;
                next[v as usize] += 1;
            }
        }
        let mut sums: Vec<Option<Vec<f64>>> = vec![None; count];
        let mut stack = Vec::new();
        for start in (0..count).filter(|&v| self.pieces[v] != NO_PIECE) {
            if sums[start].is_some() {
                continue;
            }
            sums[start] = Some(vec![0.0; size]);
            stack.push(start);
            while let Some(v) = stack.pop() {
                for &edge in &at[first[v]..first[v + 1]] {
                    let [low, high] = self.edges[edge].map(|w| w as usize);
                    let (other, sign) = if low == v { (high, 1.0) } else { (low, -1.0) };
                    let Some(here) = &sums[v] else { continue };
                    let there = || here.iter().zip(vector(edge)).map(|(s, d)| s + sign * d);
                    match &sums[other] {
                        None => {
                            let sum = there().collect();
                            sums[other] = Some(sum);
                            stack.push(other);
                        }
                        Some(known) if there().ne(known.iter().copied()) => {
                            let left: Vec<f64> = there().zip(known).map(|(a, b)| a - b).collect();
                            closed[self.pieces[v] as usize].insert(whole(&left));
                        }
                        Some(_) => {}
                    }
                }
            }
        }
    }
}

/// Sums of signs are whole numbers.
fn whole(vector: &[f64]) -> Vec<i64> {
    vector.iter().map(|&x| x as i64).collect()
}

fn fractional(vector: &[i64]) -> Vec<f64> {
    vector.iter().map(|&x| x as f64).collect()
}

/// A linear space, by rows that have been eliminated: each has 1 where the others have 0.
#[derive(Clone, Default)]
struct Basis {
    rows: Vec<(usize, Vec<f64>)>,
}

impl Basis {
    /// `vector` less its part in the space; and its largest element.
    fn reduced(&self, vector: &[f64]) -> (Vec<f64>, usize) {
        let mut left = vector.to_vec();
        for (pivot, row) in &self.rows {
            let factor = left[*pivot];
            if factor != 0.0 {
                left.iter_mut().zip(row).for_each(|(l, r)| *l -= factor * r);
            }
        }
        let largest = (0..left.len()).max_by(|&a, &b| left[a].abs().total_cmp(&left[b].abs())).unwrap_or(0);
        (left, largest)
    }

    fn contains(&self, vector: &[f64]) -> bool {
        let (left, largest) = self.reduced(vector);
        left.get(largest).is_none_or(|x| x.abs() < NONE)
    }

    fn add(&mut self, vector: &[f64]) {
        let (mut row, pivot) = self.reduced(vector);
        let Some(&factor) = row.get(pivot).filter(|x| x.abs() >= NONE) else { return };
        row.iter_mut().for_each(|x| *x /= factor);
        for (_, other) in &mut self.rows {
            let factor = other[pivot];
            if factor != 0.0 {
                other.iter_mut().zip(&row).for_each(|(o, r)| *o -= factor * r);
            }
        }
        self.rows.push((pivot, row));
    }
}
