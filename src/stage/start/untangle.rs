//! Untangling: a garment that passes through itself as it was designed is pulled apart before the inflation begins, where
//! that takes small displacements.
//!
//! Vertices walk down the gradient of the length of the intersection contours ([`super::contour`]) until a contour is gone. The
//! design stays what it is: only the start of the solve moves, and the shape terms then restore the shape on the right side
//! of the contact. A garment that is crumpled all over is smoothed before that. What is not untangled stays as it was, so that no
//! pair of triangles intersects that did not in the design.

use glam::DVec3;

use super::contour::contour_length;
use super::projection::ProjectedAvatar;
use super::smooth::Smoother;
use crate::control::Cancel;
use crate::error::Result;
use crate::geometry::crumpled::crumpled;
use crate::geometry::mesh::{NO_PIECE, Topology, TriangleMesh, label_pieces};
use crate::verify::intersections_with_cancel;

/// Steps at most.
const MAX_STEPS: usize = 120;
/// Steps without fewer intersections or a shorter contour, after which it ends.
const PATIENCE: usize = 24;
/// The longest displacement of a step, in mean lengths of the edges at a vertex.
const STRIDE: f64 = 0.15;
/// The farthest that a vertex may end from its place in the design, in the same measure.
const FARTHEST: f64 = 2.5;
/// How often a step is averaged over neighbours.
const SMOOTHING: usize = 2;
/// Steps that help nothing, after which the stride is halved.
const HALVED_AFTER: usize = 6;
/// How much farther than necessary the vertices go, the first of these with which nothing new intersects.
const MARGINS: [f64; 5] = [1.0, 0.7, 0.4, 0.2, 0.1];
/// How often it is tried, each time with what could not be pulled apart left as it is.
const ROUNDS: usize = 4;
/// Rounds of smoothing before that, where the garment is crumpled; the first of these after which nothing intersects that did not in
/// the design.
const SMOOTHINGS: [usize; 3] = [6, 20, 60];
/// What still intersects then is pulled apart where it is less than this share of what intersects in the design.
const FEW: f64 = 0.5;
/// Rings of vertices around what is left as it is that stay as well.
const FROZEN_RINGS: usize = 3;

/// A garment that is pulled apart but for a larger share of its intersections than this begins as designed: little would be
/// gained, and what is left is locked between layers that may not pass each other any more.
const MOST_REMAINING: f64 = 0.5;

/// A garment of which this share of the area passes through itself beside where it is is smoothed, where it cannot be pulled apart as
/// it is.
const CRUMPLED: f64 = 0.1;

/// A garment whose initial self-intersections were pulled apart, wholly or partly.
#[derive(Clone)]
pub struct Untangled {
    /// Where the vertices begin.
    pub start: Vec<DVec3>,
    /// The pairs of triangles that still intersect: some of those that did.
    pub remaining: Vec<[u32; 2]>,
}

/// [`untangle`], unless too much remains or that brings the garment into the avatar as it begins. Of the intersecting `pairs`
/// those that are `joined`, in ascending order, are to stay.
///
/// # Errors
/// `Cancelled`.
pub fn begin_apart(
    garment: &TriangleMesh,
    [pairs, joined]: [&[[u32; 2]]; 2],
    avatar: &ProjectedAvatar,
    cancel: &Cancel,
) -> Result<Option<Untangled>> {
    let apart = |pairs: &[[u32; 2]]| pairs.iter().filter(|pair| joined.binary_search(pair).is_err()).count();
    if apart(pairs) == 0 {
        return Ok(None);
    }
    let is_less = |untangled: &Untangled| apart(&untangled.remaining) as f64 <= MOST_REMAINING * apart(pairs) as f64;
    let mut untangled = untangle(garment, pairs, cancel)?.filter(is_less);
    let is_crumpled = || crumpled(garment, pairs).is_some_and(|crumpled| crumpled.share > CRUMPLED);
    if untangled.as_ref().is_none_or(|untangled| apart(&untangled.remaining) > 0) && is_crumpled() {
        let left = untangled.as_ref().map_or(usize::MAX, |untangled| untangled.remaining.len());
        let smoothed = begin_smoothed(garment, pairs, cancel)?.filter(is_less);
        untangled = smoothed.filter(|smoothed| smoothed.remaining.len() < left).or(untangled);
    }
    let Some(untangled) = untangled else { return Ok(None) };
    let pulled = TriangleMesh { positions: untangled.start.clone(), triangles: garment.triangles.clone() };
    let hits = intersections_with_cancel(&pulled, Some(&avatar.start_mesh()), 1, cancel)?.count;
    Ok((hits == 0).then_some(untangled))
}

/// Pulls apart what intersects in `garment`, whose intersecting pairs of triangles are `pairs`, in ascending order. None where
/// nothing could be done.
///
/// # Errors
/// `Cancelled`.
pub fn untangle(garment: &TriangleMesh, pairs: &[[u32; 2]], cancel: &Cancel) -> Result<Option<Untangled>> {
    if pairs.is_empty() {
        return Ok(None);
    }
    let mut descent = Descent::new(garment);
    for _ in 0..ROUNDS {
        let untangled = descent.run(pairs, cancel)?;
        let is_new = |pair: &&[u32; 2]| pairs.binary_search(pair).is_err();
        let new: Vec<[u32; 2]> = untangled.remaining.iter().filter(is_new).copied().collect();
        if new.is_empty() {
            let is_less = untangled.remaining.len() < pairs.len();
            return is_less.then(|| descent.with_margin(untangled, cancel)).transpose();
        }
        // What could not be pulled apart stays as designed, with what is around it, and the rest is tried again.
        descent.freeze(&new, &untangled.remaining);
    }
    Ok(None)
}

/// [`untangle`] for a crumpled garment: where noise has moved vertices by as much as their edges are long, contours are everywhere,
/// and lead nowhere. So the start alone is smoothed first. None where that does not help.
///
/// # Errors
/// `Cancelled`.
fn begin_smoothed(garment: &TriangleMesh, pairs: &[[u32; 2]], cancel: &Cancel) -> Result<Option<Untangled>> {
    let smoother = Smoother::new(garment);
    for rounds in SMOOTHINGS {
        let start = smoother.smoothed(&garment.positions, rounds);
        let mesh = TriangleMesh { positions: start, triangles: garment.triangles.clone() };
        let remaining = intersections_with_cancel(&mesh, None, usize::MAX, cancel)?.pairs;
        if remaining.len() as f64 > FEW * pairs.len() as f64 {
            continue;
        }
        let done = match untangle(&mesh, &remaining, cancel)? {
            Some(done) => done,
            None => Untangled { start: mesh.positions, remaining },
        };
        if done.remaining.iter().all(|pair| pairs.binary_search(pair).is_ok()) {
            return Ok(Some(done));
        }
    }
    Ok(None)
}

struct Descent<'a> {
    garment: &'a TriangleMesh,
    topology: Topology,
    /// Mean length of the edges at each vertex.
    lengths: Vec<f64>,
    /// Edges at each vertex.
    degrees: Vec<f64>,
    /// Vertices that stay where they are.
    is_frozen: Vec<bool>,
}

impl<'a> Descent<'a> {
    fn new(garment: &'a TriangleMesh) -> Self {
        let count = garment.positions.len();
        let topology = Topology::new(count, &garment.triangles);
        let lengths = topology.mean_edge_lengths(&garment.positions);
        let mut degrees = vec![0.0; count];
        topology.edges.iter().flatten().for_each(|&v| degrees[v as usize] += 1.0);
        Self { garment, topology, lengths, degrees, is_frozen: vec![false; count] }
    }

    /// Walks down the length of the contours of `designed`, and returns the positions with the fewest intersections on the way,
    /// with all of these.
    fn run(&self, designed: &[[u32; 2]], cancel: &Cancel) -> Result<Untangled> {
        let mut mesh = self.garment.clone();
        let mut pairs = designed.to_vec();
        let mut best = Untangled { start: mesh.positions.clone(), remaining: pairs.clone() };
        let mut least = (usize::MAX, f64::INFINITY);
        let (mut since, mut stride) = (0, STRIDE);
        for _ in 0..MAX_STEPS {
            let movable = self.movable(&pairs);
            let (length, gradient) = contour_length(&mesh.positions, &mesh.triangles, &movable);
            if (movable.len(), length) < least {
                least = (movable.len(), length);
                best = Untangled { start: mesh.positions.clone(), remaining: pairs };
                since = 0;
            }
            if movable.is_empty() || since >= PATIENCE {
                break;
            }
            since += 1;
            if since % HALVED_AFTER == 0 {
                stride *= 0.5;
            }
            self.displace(&mut mesh.positions, &self.displacement(&gradient, stride));
            pairs = intersections_with_cancel(&mesh, None, usize::MAX, cancel)?.pairs;
        }
        Ok(best)
    }

    /// The pairs of which something may move.
    fn movable(&self, pairs: &[[u32; 2]]) -> Vec<[u32; 2]> {
        let corners = |pair: &[u32; 2]| pair.map(|t| self.garment.triangles[t as usize]);
        let moves = |pair: &&[u32; 2]| corners(pair).iter().flatten().any(|&v| !self.is_frozen[v as usize]);
        pairs.iter().filter(moves).copied().collect()
    }

    /// The step of each vertex, smoothed over the surface.
    fn displacement(&self, gradient: &[DVec3], stride: f64) -> Vec<DVec3> {
        let mut step: Vec<DVec3> = gradient.iter().map(|g| -*g / g.length().max(1.0)).collect();
        let longest = |step: &[DVec3]| step.iter().map(|d| d.length()).fold(0.0, f64::max);
        let before = longest(&step);
        for _ in 0..SMOOTHING {
            let mut sums = vec![DVec3::ZERO; step.len()];
            for &[a, b] in &self.topology.edges {
                sums[a as usize] += step[b as usize];
                sums[b as usize] += step[a as usize];
            }
            for ((d, sum), degree) in step.iter_mut().zip(sums).zip(&self.degrees) {
                *d = 0.5 * (*d + sum / degree.max(1.0));
            }
        }
        let scale = (before / longest(&step).max(f64::MIN_POSITIVE)).min(2.0);
        step.iter().zip(&self.lengths).map(|(d, length)| stride * length * scale * *d).collect()
    }

    fn displace(&self, positions: &mut [DVec3], step: &[DVec3]) {
        for (v, p) in positions.iter_mut().enumerate().filter(|&(v, _)| !self.is_frozen[v]) {
            let design = self.garment.positions[v];
            *p = design + (*p + step[v] - design).clamp_length_max(FARTHEST * self.lengths[v]);
        }
    }

    /// Goes on the way that the vertices went, so that something is left between the layers.
    fn with_margin(&self, untangled: Untangled, cancel: &Cancel) -> Result<Untangled> {
        let mut mesh = self.garment.clone();
        for further in MARGINS {
            let way = untangled.start.iter().zip(&self.garment.positions);
            mesh.positions = way.map(|(&p, &design)| p + further * (p - design)).collect();
            let remaining = intersections_with_cancel(&mesh, None, usize::MAX, cancel)?.pairs;
            if remaining.iter().all(|pair| untangled.remaining.binary_search(pair).is_ok()) {
                return Ok(Untangled { start: mesh.positions, remaining });
            }
        }
        Ok(untangled)
    }

    /// Freezes the triangles of the pairs in `new`, those of the pairs in `remaining` that hang together with them, and what is
    /// around them.
    fn freeze(&mut self, new: &[[u32; 2]], remaining: &[[u32; 2]]) {
        let corners = |t: u32| self.garment.triangles[t as usize];
        let chain = |pair: &[u32; 2]| {
            let [[a, b, c], [d, e, f]] = pair.map(corners);
            [[a, b], [b, c], [c, d], [d, e], [e, f]]
        };
        let links = remaining.iter().flat_map(chain);
        let (clusters, _) = label_pieces(self.is_frozen.len(), links);
        let mut bad: Vec<u32> = new.iter().map(|&[t, _]| clusters[corners(t)[0] as usize]).collect();
        bad.sort_unstable();
        let in_bad = |v: usize| clusters[v] != NO_PIECE && bad.binary_search(&clusters[v]).is_ok();
        let mut freezes: Vec<bool> = (0..clusters.len()).map(in_bad).collect();
        for _ in 0..FROZEN_RINGS {
            let before = freezes.clone();
            for &[a, b] in &self.topology.edges {
                freezes[a as usize] |= before[b as usize];
                freezes[b as usize] |= before[a as usize];
            }
        }
        self.is_frozen.iter_mut().zip(freezes).for_each(|(frozen, freezes)| *frozen |= freezes);
    }
}
