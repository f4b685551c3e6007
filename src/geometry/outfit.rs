//! In which order the garments of an outfit are worn, found by where they lie on the body that they were made for.
//!
//! Of two garments the inner one is the one of which more lies in the other: whose points see that in more than half of the
//! directions. A shirt is in its jacket and the tail of a shirt in the trousers that it is tucked into, but neither is a jacket in
//! its shirt nor are trousers in the shirt-tail; loose cloth over tight cloth is no matter, and neither are seams, holes, pieces
//! or winding. Where neither is in the other, as a backpack and a coat, the one nearer to the body is the inner one.

use std::collections::BTreeSet;

use glam::DVec3;
use rayon::prelude::*;

use super::closest_point::ClosestPoint;
use super::cover::{DIRECTIONS, direction};
use super::mesh::TriangleMesh;
use super::spread::spread;
use crate::control::{Cancel, Cancelled};

/// Points looked at on each garment, spread evenly.
const POINTS: usize = 1000;

/// As a share of the points of a garment: fewer than so many in another one say nothing.
const FEW: f64 = 0.005;

/// Garments are beside each other where they are nearer than this share of the outfit's longest side.
const BESIDE: f64 = 0.03;

/// Of two garments, which is beneath the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WornPair {
    /// The garment beneath, by its index.
    pub inner: u32,
    /// The garment above it.
    pub outer: u32,
    /// From 0, as much speaks for the other order, to 1, nothing does; at most a half where neither encloses the other and
    /// the distance from the body decides.
    pub confidence: f64,
    /// True where the order does not follow it: with surer pairs it would have gone around in a circle.
    pub is_overruled: bool,
}

/// How an outfit is worn.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OutfitOrder {
    /// The garments from the innermost outwards, by their indices; of those that do not meet, the first comes first.
    pub order: Vec<u32>,
    /// The pairs of garments that meet, the surest first.
    pub pairs: Vec<WornPair>,
}

/// The order in which `garments` are worn. All meshes are in one coordinate system, as they were modelled; `body` is the body
/// that wears them, where it is there. It works in the threads of the rayon pool in which it is called.
///
/// # Errors
/// [`Cancelled`].
pub fn outfit_order(
    garments: &[&TriangleMesh],
    body: Option<&TriangleMesh>,
    cancel: &Cancel,
) -> Result<OutfitOrder, Cancelled> {
    let directions: Vec<DVec3> = (0..DIRECTIONS).map(|k| direction(k, DIRECTIONS)).collect();
    let worn: Vec<Worn> = garments.par_iter().map(|garment| Worn::new(garment)).collect();
    let body = body.map(ClosestPoint::new);
    let size = worn.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), garment| {
        (low.min(garment.low), high.max(garment.high))
    });
    let beside = BESIDE * (size.1 - size.0).max_element();
    let count = garments.len() as u32;
    let pairs: Vec<[u32; 2]> = (0..count).flat_map(|a| (a + 1..count).map(move |b| [a, b])).collect();
    let compare = |&[a, b]: &[u32; 2]| {
        cancel.check()?;
        let [first, second] = [a, b].map(|k| &worn[k as usize]);
        let votes = [first.points_in(second, &directions), second.points_in(first, &directions)];
        let (votes, trust) = match (enough(votes), &body) {
            (true, _) => (votes, 1.0),
            (false, Some(body)) => (first.nearer_than(second, body, beside), 0.5),
            (false, None) => return Ok(None),
        };
        if !enough(votes) {
            return Ok(None);
        }
        let [inner, outer] = if votes[0] >= votes[1] { [a, b] } else { [b, a] };
        let confidence = trust * f64::from(votes[0].abs_diff(votes[1])) / f64::from(votes[0] + votes[1]);
        Ok(Some(WornPair { inner, outer, confidence, is_overruled: false }))
    };
    let found = pairs.par_iter().map(compare).collect::<Result<Vec<Option<WornPair>>, Cancelled>>()?;
    Ok(in_order(garments.len(), found.into_iter().flatten().collect()))
}

/// The order that follows the surest pairs.
pub fn in_order(count: usize, mut pairs: Vec<WornPair>) -> OutfitOrder {
    pairs.sort_by(|a, b| {
        b.confidence.total_cmp(&a.confidence).then_with(|| (a.inner, a.outer).cmp(&(b.inner, b.outer)))
    });
    // What is above each garment, at once or with others between.
    let mut above: Vec<BTreeSet<u32>> = vec![BTreeSet::new(); count];
    for pair in &mut pairs {
        pair.is_overruled = pair.inner == pair.outer || above[pair.outer as usize].contains(&pair.inner);
        if pair.is_overruled {
            continue;
        }
        let mut further = above[pair.outer as usize].clone();
        further.insert(pair.outer);
        for (garment, above) in (0u32..).zip(&mut above) {
            if garment == pair.inner || above.contains(&pair.inner) {
                above.extend(&further);
            }
        }
    }
    let mut order = Vec::with_capacity(count);
    let mut left: BTreeSet<u32> = (0..count as u32).collect();
    while let Some(&first) = left.iter().find(|&&g| !left.iter().any(|&under| above[under as usize].contains(&g))) {
        left.remove(&first);
        order.push(first);
    }
    OutfitOrder { order, pairs }
}

/// Whether there are so many votes that they are no accident.
fn enough([a, b]: [u32; 2]) -> bool {
    f64::from(a.max(b)) >= FEW * POINTS as f64
}

/// A garment of the outfit.
struct Worn {
    tree: ClosestPoint,
    points: Vec<DVec3>,
    low: DVec3,
    high: DVec3,
}

impl Worn {
    fn new(mesh: &TriangleMesh) -> Self {
        let corners = || mesh.triangles.iter().flatten().map(|&v| mesh.positions[v as usize]);
        Self {
            tree: ClosestPoint::new(mesh),
            points: spread(mesh, POINTS).into_iter().map(|(p, _)| p).collect(),
            low: corners().fold(DVec3::INFINITY, DVec3::min),
            high: corners().fold(DVec3::NEG_INFINITY, DVec3::max),
        }
    }

    /// How many of its points lie in `other`.
    fn points_in(&self, other: &Worn, directions: &[DVec3]) -> u32 {
        let is_in = |p: &&DVec3| {
            // Outside of its box, a plane separates the point from the other garment.
            p.cmpge(other.low).all()
                && p.cmple(other.high).all()
                && 2 * directions.iter().filter(|&&d| other.tree.meets_ray(**p, d)).count() > DIRECTIONS
        };
        self.points.iter().filter(is_in).count() as u32
    }

    /// At how many points beside each other it is nearer to the body than `other`, and the other way round.
    fn nearer_than(&self, other: &Worn, body: &ClosestPoint, beside: f64) -> [u32; 2] {
        let mut votes = [0, 0];
        for (mine, points, tree) in [(0, &self.points, &other.tree), (1, &other.points, &self.tree)] {
            for &p in points {
                let Some(there) = tree.closest(p).filter(|there| there.distance < beside) else { continue };
                let is_nearer = body.distance(p) < body.distance(there.point);
                votes[if is_nearer { mine } else { 1 - mine }] += 1;
            }
        }
        votes
    }
}
