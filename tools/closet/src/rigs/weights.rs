//! Skin weights on a full rig: which limb, from the closet's 15 joints; where on it, by the distance along it.

use std::collections::BTreeMap;

use glam::DVec3;

use super::role::{FINGERS, Role, SIDES, Side};
use crate::Sample;
use crate::mesh::Mesh;
use crate::skeleton::{ARMS, LEGS, NECK, ROOT, WAIST};

/// How many joints move a vertex at most.
pub const INFLUENCES: usize = 4;

/// Passes of smoothing over the edges, after those of the closet's own skin.
const PASSES: usize = 6;

/// Flesh stands off the trunk beyond this distance from the spine, in lengths of the chest: not, and clearly.
const OFF_TRUNK: [f64; 2] = [0.2, 0.3];

/// Joints one after the other, with the distance along the chain at which each begins and half the length over which it
/// takes over from the one before.
struct Chain {
    roles: Vec<Role>,
    points: Vec<DVec3>,
    starts: Vec<f64>,
    bands: Vec<f64>,
}

impl Chain {
    /// Of roles with the share of the shorter neighbour that the passage to each takes.
    fn new(places: &BTreeMap<Role, DVec3>, roles: &[(Role, f64)], end: DVec3) -> Self {
        let mut points: Vec<DVec3> = roles.iter().map(|(role, _)| places[role]).collect();
        points.push(end);
        let mut starts = vec![0.0];
        for pair in points.windows(2) {
            starts.push(starts[starts.len() - 1] + pair[0].distance(pair[1]));
        }
        let length = |k: usize| starts[k + 1] - starts[k];
        let shorter = |k: usize| if k == 0 { length(0) } else { length(k - 1).min(length(k)) };
        let bands = roles.iter().enumerate().map(|(k, (_, share))| (share * shorter(k)).max(1e-6)).collect();
        Self { roles: roles.iter().map(|(role, _)| *role).collect(), points, starts, bands }
    }

    /// How far along the chain the nearest point to `p` is, and how far that is from `p`.
    fn nearest(&self, p: DVec3) -> (f64, f64) {
        let mut best = (0.0, f64::INFINITY);
        for (k, pair) in self.points.windows(2).enumerate() {
            let axis = pair[1] - pair[0];
            let t = ((p - pair[0]).dot(axis) / axis.length_squared().max(1e-12)).clamp(0.0, 1.0);
            let distance = p.distance(pair[0] + t * axis);
            if distance < best.1 {
                best = (self.starts[k] + t * axis.length(), distance);
            }
        }
        best
    }

    /// Adds `weight`, shared among the roles.
    fn share(&self, p: DVec3, weight: f64, weights: &mut BTreeMap<Role, f64>) {
        let (s, _) = self.nearest(p);
        let mut rest = weight;
        for k in (1..self.roles.len()).rev() {
            let begun = step(self.starts[k] - self.bands[k], self.starts[k] + self.bands[k], s);
            *weights.entry(self.roles[k]).or_default() += rest * begun;
            rest *= 1.0 - begun;
        }
        *weights.entry(self.roles[0]).or_default() += rest;
    }
}

/// From 0 at `low` to 1 at `high`, smoothly.
fn step(low: f64, high: f64, x: f64) -> f64 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// For each vertex the weight of each role.
pub fn weights(body: &Sample, places: &BTreeMap<Role, DVec3>) -> Vec<BTreeMap<Role, f64>> {
    let limbs: [Vec<usize>; 5] =
        [vec![ROOT, WAIST, NECK], ARMS[0].to_vec(), ARMS[1].to_vec(), LEGS[0].to_vec(), LEGS[1].to_vec()];
    let limb = |v: usize| limbs.each_ref().map(|joints| joints.iter().map(|&joint| body.skin[joint][v]).sum::<f64>());
    let shares = smoothed(&body.mesh, (0..body.mesh.positions.len()).map(limb).collect());
    let trunk = Chain::new(
        places,
        &[
            (Role::Hips, 0.0),
            (Role::Spine(0), 0.6),
            (Role::Spine(1), 0.6),
            (Role::Spine(2), 0.6),
            (Role::Neck, 0.4),
            (Role::Head, 0.5),
        ],
        places[&Role::HeadEnd],
    );
    let limbs = SIDES.map(|side| (side, arm(places, side), leg(places, side), Fingers::new(places, side)));
    let chest = body.skeleton.joints[WAIST].distance(body.skeleton.joints[NECK]);
    let vertex = |(v, (&p, share)): (usize, (&DVec3, &[f64; 5]))| {
        let mut weights = BTreeMap::new();
        trunk.share(p, share[0], &mut weights);
        to_head(trunk.nearest(p).1 / chest, body.skin[NECK][v], &mut weights);
        for (k, (side, arm, leg, fingers)) in limbs.iter().enumerate() {
            to_clavicle(p, *side, places, &mut weights);
            arm.share(p, share[1 + k], &mut weights);
            fingers.take(p, &mut weights);
            leg.share(p, share[3 + k], &mut weights);
        }
        weights.retain(|_, weight| *weight > 0.0);
        weights
    };
    body.mesh.positions.iter().zip(&shares).enumerate().map(vertex).collect()
}

fn arm(places: &BTreeMap<Role, DVec3>, side: Side) -> Chain {
    let roles = [
        (Role::UpperArm(side), 0.0),
        (Role::UpperArmTwist(side), 0.6),
        (Role::LowerArm(side), 0.3),
        (Role::LowerArmTwist(side), 0.6),
        (Role::Wrist(side), 0.3),
        (Role::Hand(side), 0.5),
    ];
    Chain::new(places, &roles, places[&Role::Finger(side, 2, 2)])
}

fn leg(places: &BTreeMap<Role, DVec3>, side: Side) -> Chain {
    let roles = [
        (Role::Thigh(side), 0.0),
        (Role::ThighTwist(side), 0.6),
        (Role::Calf(side), 0.3),
        (Role::Foot(side), 0.3),
        (Role::Toe(side), 0.5),
    ];
    Chain::new(places, &roles, places[&Role::ToeEnd(side)])
}

/// What belongs to the head, with this weight, goes over to it from neck and chest where it is `far` off the spine, in lengths of
/// the chest: a chin in front of the neck, at whatever height.
fn to_head(far: f64, weight: f64, weights: &mut BTreeMap<Role, f64>) {
    let part = weight * step(OFF_TRUNK[0], OFF_TRUNK[1], far);
    let mut moved = 0.0;
    for (_, weight) in weights.iter_mut().filter(|(role, _)| matches!(role, Role::Spine(_) | Role::Neck)) {
        moved += part * *weight;
        *weight -= part * *weight;
    }
    *weights.entry(Role::Head).or_default() += moved;
}

/// The flesh between the neck and a shoulder goes over from the spine to the clavicle.
fn to_clavicle(p: DVec3, side: Side, places: &BTreeMap<Role, DVec3>, weights: &mut BTreeMap<Role, f64>) {
    let [inner, shoulder] = [Role::Clavicle(side), Role::UpperArm(side)].map(|role| places[&role]);
    let out = step(inner.x.abs(), 1.1 * shoulder.x.abs(), p.x * shoulder.x.signum());
    let reach = 0.9 * (shoulder.x - inner.x).abs();
    let part = 0.8 * out * (1.0 - step(0.3 * reach, reach, (p.z - shoulder.z).abs()));
    let mut moved = 0.0;
    for role in [Role::Spine(1), Role::Spine(2), Role::Neck] {
        if let Some(weight) = weights.get_mut(&role) {
            moved += part * *weight;
            *weight -= part * *weight;
        }
    }
    *weights.entry(Role::Clavicle(side)).or_default() += moved;
}

/// The fingers of a hand.
struct Fingers {
    side: Side,
    chains: Vec<Chain>,
}

impl Fingers {
    fn new(places: &BTreeMap<Role, DVec3>, side: Side) -> Self {
        let chain = |finger: usize| {
            let roles = [0, 1, 2].map(|k| (Role::Finger(side, finger, k), 0.4));
            let [last, before] = [2, 1].map(|k| places[&Role::Finger(side, finger, k)]);
            Chain::new(places, &roles, last + (last - before))
        };
        Self { side, chains: (0..FINGERS).map(chain).collect() }
    }

    /// What lies beyond a knuckle goes over from the hand to the nearest finger.
    fn take(&self, p: DVec3, weights: &mut BTreeMap<Role, f64>) {
        let Some(hand) = weights.get_mut(&Role::Hand(self.side)).filter(|weight| **weight > 0.0) else { return };
        let distance = |chain: &&Chain| chain.nearest(p).1;
        let nearest = self.chains.iter().min_by(|a, b| distance(a).total_cmp(&distance(b))).expect("five fingers");
        let [start, next] = [nearest.points[0], nearest.points[1]];
        let along = next - start;
        let taken = *hand * step(-0.5, 0.5, (p - start).dot(along) / along.length_squared());
        *hand -= taken;
        nearest.share(p, taken, weights);
    }
}

/// Averages over the edges.
fn smoothed(mesh: &Mesh, mut values: Vec<[f64; 5]>) -> Vec<[f64; 5]> {
    let edges = mesh.edges();
    for _ in 0..PASSES {
        let mut sums: Vec<([f64; 5], f64)> = values.iter().map(|v| (*v, 1.0)).collect();
        for edge in &edges {
            for [v, w] in [edge.vertices, [edge.vertices[1], edge.vertices[0]]] {
                let (sum, count) = &mut sums[v as usize];
                sum.iter_mut().zip(&values[w as usize]).for_each(|(sum, value)| *sum += value);
                *count += 1.0;
            }
        }
        values = sums.into_iter().map(|(sum, count)| sum.map(|value| value / count)).collect();
    }
    values
}

/// The largest weights, at most [`INFLUENCES`] of them, which sum to 1; by falling weight.
pub fn largest(weights: impl IntoIterator<Item = (usize, f64)>) -> Vec<(usize, f64)> {
    let mut all: Vec<(usize, f64)> = weights.into_iter().filter(|(_, weight)| *weight > 1e-4).collect();
    all.sort_by(|(i, a), (j, b)| b.total_cmp(a).then(i.cmp(j)));
    all.truncate(INFLUENCES);
    let sum: f64 = all.iter().map(|(_, weight)| weight).sum();
    all.iter_mut().for_each(|(_, weight)| *weight /= sum);
    all
}
