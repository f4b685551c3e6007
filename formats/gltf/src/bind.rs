//! Where the joints were when the meshes were bound to them.
//!
//! A skin says where its joints were beside its mesh; where its mesh then stood in the file's world it does not say. Each
//! joint that rests as it was bound gives the same answer, so the one that most joints give is taken. A further skin is
//! placed by the joints that it shares with those before, so that all skins over one tree of nodes are one rig.

use std::collections::HashMap;

use glam::{DAffine3, DVec3};

use crate::nodes::{Nodes, affine};
use crate::skin::Skin;

/// How far two transforms may differ that are meant to be one, beside the size of the rig: files hold 32-bit numbers.
const TOLERANCE: f64 = 1e-3;

/// How many joints are asked where a skin stands. So many are enough for a majority.
const ASKED: usize = 512;

/// For each node that is in one of the skins `used`, its transform to the file's world in the bind pose.
///
/// Joints whose bind matrix has no inverse are left out.
pub(crate) fn binds(nodes: &Nodes, skins: &[Skin], used: &[usize]) -> HashMap<usize, DAffine3> {
    let mut binds: HashMap<usize, DAffine3> = HashMap::new();
    let mut used = used.to_vec();
    // The one that says most comes first.
    used.sort_by_key(|&skin| (std::cmp::Reverse(skins[skin].joints.len()), skin));
    for skin in used {
        let joints = skins[skin].joints.iter().zip(&skins[skin].inverse_binds);
        let joints: Vec<(usize, DAffine3, DAffine3)> = joints
            .map(|(&joint, inverse)| (joint, affine(inverse), affine(inverse).inverse()))
            .filter(|(.., bound)| bound.is_finite())
            .collect();
        let bound: Vec<DAffine3> = joints.iter().map(|(.., bound)| *bound).collect();
        let place = |known: &dyn Fn(usize) -> Option<DAffine3>| {
            let places: Vec<DAffine3> =
                joints.iter().filter_map(|(joint, inverse, _)| Some(known(*joint)? * *inverse)).collect();
            most_agreed(&places, &bound)
        };
        let shared = place(&|joint| binds.get(&joint).copied());
        let Some(place) = shared.or_else(|| place(&|joint| Some(affine(&nodes.all[joint].world)))) else { continue };
        for (joint, _, bound) in joints {
            binds.entry(joint).or_insert(place * bound);
        }
    }
    binds
}

/// Of some transforms of a skin that one with which most of the others agree on where its joints are; the earliest of those.
fn most_agreed(places: &[DAffine3], joints: &[DAffine3]) -> Option<DAffine3> {
    let places: Vec<DAffine3> = places.iter().step_by(places.len().div_ceil(ASKED).max(1)).copied().collect();
    let low = joints.iter().fold(DVec3::INFINITY, |low, joint| low.min(joint.translation));
    let high = joints.iter().fold(DVec3::NEG_INFINITY, |high, joint| high.max(joint.translation));
    // Joints in one place have no extent; any does then.
    let extent = Some(low.distance(high)).filter(|extent| *extent > 0.0).unwrap_or(1.0);
    let frame = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z].map(|axis| low + extent * axis);
    let carried: Vec<[DVec3; 4]> = places.iter().map(|place| frame.map(|p| place.transform_point3(p))).collect();
    let agree = |a: &[DVec3; 4], b: &[DVec3; 4]| {
        let size = a.iter().map(|p| p.distance(a[0])).fold(0.0, f64::max);
        a.iter().zip(b).all(|(p, q)| p.distance(*q) <= TOLERANCE * size)
    };
    let votes: Vec<usize> = carried.iter().map(|a| carried.iter().filter(|b| agree(a, b)).count()).collect();
    let most = *votes.iter().max()?;
    Some(places[votes.iter().position(|&v| v == most)?])
}
