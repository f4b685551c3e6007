//! Limbs of the source skeleton that are in another pose than the garment, such as arms that hang beside spread sleeves.
//!
//! Such a limb passes through the cloth, or lies beside a sleeve or leg within the rest of the garment, and the opening that it was
//! made for has nothing in it. Turned about the joint where it begins until it points there, it goes through the opening and through
//! no cloth: that proves it.

use glam::DVec3;

use super::evidence::{LEAF_REACH, MOST_BONES, Threaded};
use crate::geometry::turn;
use crate::input::skeleton::Skeleton;
use crate::maths;

/// A limb that meets no cloth is not turned by more than this, in degrees.
const MOST: f64 = 120.0;
/// An opening that a limb is made for is no farther from where that begins than this, in lengths of the limb, and no nearer.
const REACH: [f64; 2] = [0.3, 1.5];
/// A limb may go through an opening that is longer around than this share of the limb's length, and so many are tried.
const WIDE: f64 = 0.15;
const TRIED: usize = 8;
/// An opening is the end of a sleeve where cloth is around the limb at these shares of the way to it, in so many of so many
/// directions no farther away than this, in lengths of the limb.
const SLEEVE: [f64; 3] = [0.6, 0.75, 0.9];
const AROUND: (usize, usize) = (14, 16);
const NARROW: f64 = 0.3;
/// A garment with more empty openings than a body has limbs is a net, or damaged: there an opening proves something where it ends a sleeve.
const MANY: usize = 8;
/// Points along a bone.
const ALONG: usize = 32;

/// A limb of the skeleton that should be elsewhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TurnedLimb {
    /// The bone at which it begins, and the joint about which it is turned.
    pub bone: u32,
    /// That joint.
    pub joint: u32,
    /// The middle of the opening that it should go through.
    pub opening: DVec3,
    /// By how many degrees it is turned.
    pub degrees: f64,
}

/// The limbs of `skeleton` that are turned against the garment by `least` degrees or more.
pub fn turned(garment: &Threaded<'_>, skeleton: &Skeleton, least: f64) -> Vec<TurnedLimb> {
    if skeleton.bones.len() > MOST_BONES {
        return Vec::new();
    }
    let bones = skeleton.lengthened(0.0);
    let mut empty = garment.empty_openings(skeleton);
    let is_net = empty.len() > MANY;
    empty.retain(|&k| garment.is_cut(k));
    if empty.is_empty() {
        return Vec::new();
    }
    let pierced: Vec<bool> = bones.iter().map(|&bone| garment.passes_cloth(bone)).collect();
    // On one without a branch, such as an arm's, each end is the other's limb, and bones may end where a sleeve goes on.
    let is_branched = (0..skeleton.joints.len() as u32)
        .any(|joint| skeleton.bones.iter().filter(|bone| bone.contains(&joint)).count() > 2);
    let mut found: Vec<(usize, TurnedLimb)> = Vec::new();
    let mut taken = vec![false; skeleton.joints.len()];
    let directed = (0u32..).zip(&skeleton.bones).flat_map(|(bone, &[a, b])| [(bone, a, b), (bone, b, a)]);
    for (bone, joint, next) in directed {
        let limb = beyond(skeleton, bone, next);
        // The smaller part is the limb.
        if limb.contains(&joint) || 2 * limb.len() > skeleton.joints.len() {
            continue;
        }
        let root = skeleton.joints[joint as usize];
        let is_own = |&k: &usize| k == bone as usize || skeleton.bones[k].iter().all(|j| limb.contains(j));
        let own: Vec<usize> = (0..bones.len()).filter(is_own).collect();
        let is_pierced = own.iter().any(|&k| pierced[k]);
        if !is_pierced && (!is_branched || has_opening(garment, skeleton, &own)) {
            continue;
        }
        let far = |&j: &u32| skeleton.joints[j as usize].distance_squared(root);
        let Some(tip) = limb.iter().copied().max_by(|a, b| far(a).total_cmp(&far(b))) else { continue };
        let along = skeleton.joints[tip as usize] - root;
        let mut near: Vec<usize> = empty
            .iter()
            .copied()
            .filter(|&k| {
                let (middle, length) = garment.opening(k);
                let reach = middle.distance(root) / along.length().max(f64::MIN_POSITIVE);
                (REACH[0]..=REACH[1]).contains(&reach) && length > WIDE * along.length()
            })
            .collect();
        near.sort_by(|&a, &b| garment.opening(b).1.total_cmp(&garment.opening(a).1).then(a.cmp(&b)));
        for k in near.into_iter().take(TRIED) {
            let middle = garment.opening(k).0;
            let degrees = turn::angle_between(along, middle - root).to_degrees();
            if degrees < least {
                continue;
            }
            let rotation = turn::arc(along.normalize(), (middle - root).normalize());
            let mut moved = skeleton.clone();
            limb.iter().for_each(|&j| {
                let p = &mut moved.joints[j as usize];
                *p = root + rotation * (*p - root);
            });
            let [whole, reaching] = [0.0, LEAF_REACH].map(|reach| moved.lengthened(reach));
            let through = own.iter().any(|&k2| garment.goes_through(k, reaching[k2]));
            let passing = own.iter().filter(|&&k| garment.passes_cloth(whole[k])).count();
            let way = || own.iter().map(|&k2| whole[k2]);
            let reach = middle.distance(root);
            if through
                && passing == 0
                && (is_pierced && !is_net
                    || degrees <= MOST && is_in_sleeve(garment, way(), root, reach, along.length()))
            {
                found.push((limb.len(), TurnedLimb { bone, joint, opening: middle, degrees }));
            }
        }
    }
    // Of limbs within each other the one that needs the smaller turn.
    found.sort_by(|a, b| a.1.degrees.total_cmp(&b.1.degrees).then(a.0.cmp(&b.0)).then(a.1.bone.cmp(&b.1.bone)));
    let mut limbs = Vec::new();
    for (_, turned) in found {
        let [a, b] = skeleton.bones[turned.bone as usize];
        let limb = beyond(skeleton, turned.bone, if a == turned.joint { b } else { a });
        if limb.iter().all(|&j| !taken[j as usize]) {
            limb.iter().for_each(|&j| taken[j as usize] = true);
            limbs.push(turned);
        }
    }
    limbs
}

/// Whether these bones go through an opening that no other bone goes through.
fn has_opening(garment: &Threaded<'_>, skeleton: &Skeleton, own: &[usize]) -> bool {
    let segments = skeleton.lengthened(LEAF_REACH);
    (0..garment.openings()).any(|opening| {
        let mut through = (0..segments.len()).filter(|&k| garment.goes_through(opening, segments[k])).peekable();
        through.peek().is_some() && through.all(|k| own.contains(&k))
    })
}

/// Whether cloth is close around a limb of this `length` most of the way, along its `bones`, from `root` to what is `reach` away.
fn is_in_sleeve(
    garment: &Threaded<'_>,
    bones: impl Iterator<Item = [DVec3; 2]> + Clone,
    root: DVec3,
    reach: f64,
    length: f64,
) -> bool {
    let points = bones.flat_map(|[a, b]| (0..=ALONG).map(move |k| (a.lerp(b, k as f64 / ALONG as f64), b - a)));
    SLEEVE.iter().all(|share| {
        let beside = |p: DVec3| (p.distance(root) - share * reach).abs();
        let nearest = points.clone().min_by(|a, b| beside(a.0).total_cmp(&beside(b.0)));
        let Some((p, along)) = nearest else { return false };
        let (u, v) = along.normalize_or(DVec3::Z).any_orthonormal_pair();
        let towards = |k: usize| {
            let angle = std::f64::consts::TAU * k as f64 / AROUND.1 as f64;
            p + NARROW * length * (maths::cos(angle) * u + maths::sin(angle) * v)
        };
        (0..AROUND.1).filter(|&k| garment.passes_cloth([p, towards(k)])).count() >= AROUND.0
    })
}

/// The joints that `from` leads to without passing `bone`.
fn beyond(skeleton: &Skeleton, bone: u32, from: u32) -> Vec<u32> {
    let mut reached = vec![from];
    let mut next = 0;
    while let Some(&joint) = reached.get(next) {
        next += 1;
        for (_, ends) in (0u32..).zip(&skeleton.bones).filter(|(k, ends)| *k != bone && ends.contains(&joint)) {
            let other = if ends[0] == joint { ends[1] } else { ends[0] };
            if !reached.contains(&other) {
                reached.push(other);
            }
        }
    }
    reached
}
