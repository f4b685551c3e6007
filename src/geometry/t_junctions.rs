//! T-junctions: vertices on an edge of a triangle that does not have them, as where one side of an edge was split and the other
//! was not.
//!
//! Such an edge and the shorter ones beside it are borders that nobody sees: a slit without width, which opens as the cloth
//! bends, and a curve that turns back on itself at both ends. Sliver caps ([`super::sliver_caps`]) close it.

use std::collections::HashMap;

use glam::DVec3;

use super::border_edges::{BorderEdge, border_edges};

/// An edge of one triangle, beside which other triangles have vertices on it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TJunction {
    /// The ends of the edge, in the order in which its triangle has them.
    pub edge: [u32; 2],
    /// Its triangle.
    pub triangle: u32,
    /// The vertices on it, from the first end to the second; one at least.
    pub between: Vec<u32>,
}

/// The T-junctions of a mesh, in the order of their triangles. A vertex is on an edge that is nearer to it than `reach`. Both
/// sides have the ends of the edge in common: seams whose sides have not are left as they are.
pub fn find(positions: &[DVec3], triangles: &[[u32; 3]], reach: f64) -> Vec<TJunction> {
    let mut borders = border_edges(triangles);
    borders.sort_unstable_by_key(|border| (border.triangle, border.corner));
    let mut at: HashMap<u32, Vec<BorderEdge>> = HashMap::new();
    for border in &borders {
        border.ends.iter().for_each(|&v| at.entry(v).or_default().push(*border));
    }
    borders.iter().filter_map(|border| junction(positions, &at, *border, reach)).collect()
}

/// The pairs of triangles that touch at T-junctions without an edge between them, the lower one first, in ascending order.
pub fn touching_pairs(junctions: &[TJunction], triangles: &[[u32; 3]]) -> Vec<[u32; 2]> {
    let mut on: HashMap<u32, Vec<u32>> = HashMap::new();
    for junction in junctions {
        junction.between.iter().for_each(|&v| on.entry(v).or_default().push(junction.triangle));
    }
    let mut pairs = Vec::new();
    for (t, corners) in (0u32..).zip(triangles) {
        for &other in corners.iter().filter_map(|v| on.get(v)).flatten().filter(|&&other| other != t) {
            pairs.push([t.min(other), t.max(other)]);
        }
    }
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}

impl TJunction {
    /// The caps that close it, without area.
    pub fn caps(&self) -> impl Iterator<Item = [u32; 3]> + '_ {
        let [first, last] = self.edge;
        let before = std::iter::once(first).chain(self.between.iter().copied());
        before.zip(&self.between).map(move |(v, &w)| [v, w, last])
    }
}

/// Follows the border edges that lie on `border` from its first end to its second.
fn junction(
    positions: &[DVec3],
    at: &HashMap<u32, Vec<BorderEdge>>,
    border: BorderEdge,
    reach: f64,
) -> Option<TJunction> {
    let [first, last] = border.ends;
    let [from, to] = border.ends.map(|v| positions[v as usize]);
    let edge = to - from;
    let length = edge.length();
    let along = |v: u32| (positions[v as usize] - from).dot(edge) / length;
    let is_on = |v: u32| {
        let s = along(v);
        s > reach && s < length - reach && positions[v as usize].distance(from + edge * (s / length)) <= reach
    };
    let mut junction = TJunction { edge: border.ends, triangle: border.triangle, between: vec![] };
    let (mut here, mut reached) = (first, 0.0);
    loop {
        let others = at.get(&here)?.iter().filter(|other| other.triangle != border.triangle);
        let next = others.filter_map(|other| {
            let to = if other.ends[0] == here { other.ends[1] } else { other.ends[0] };
            let goes_on = to == last && !junction.between.is_empty() || is_on(to) && along(to) > reached;
            goes_on.then_some(to)
        });
        let to = next.min()?;
        if to == last {
            return Some(junction);
        }
        junction.between.push(to);
        (here, reached) = (to, along(to));
    }
}
