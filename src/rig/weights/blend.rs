//! Linear blend skinning: what joints do to the vertices that they move.

use glam::{DAffine3, DQuat, DVec3};

use crate::input::skin::SkinWeights;

/// How each joint moves what it owns when it is turned about its place, with all that hang on it. A parent may come after its
/// children; a circle of parents counts as roots.
pub fn place(joints: &[DVec3], parents: &[Option<u32>], turns: &[DQuat]) -> Vec<DAffine3> {
    let mut moves: Vec<Option<DAffine3>> = vec![None; joints.len()];
    for joint in 0..joints.len() {
        let mut chain = Vec::new();
        let mut next = Some(joint);
        while let Some(j) = next.filter(|&j| moves[j].is_none() && chain.len() < joints.len()) {
            chain.push(j);
            next = parents[j].map(|p| p as usize);
        }
        let mut above = next.and_then(|j| moves[j]).unwrap_or(DAffine3::IDENTITY);
        for j in chain.into_iter().rev() {
            let about = DAffine3::from_translation(joints[j]) * DAffine3::from_quat(turns[j]);
            above = above * about * DAffine3::from_translation(-joints[j]);
            moves[j] = Some(above);
        }
    }
    moves.into_iter().map(Option::unwrap_or_default).collect()
}

/// Where vertices lie whose joints move: the mean of what each joint makes of it, by weight. A vertex without weights stays.
pub fn linear_blend(positions: &[DVec3], skin: &SkinWeights, moves: &[DAffine3]) -> Vec<DVec3> {
    let of = |(v, &p): (usize, &DVec3)| {
        let weights = skin.weights(v);
        let sum: f64 = weights.iter().map(|&(_, weight)| weight).sum();
        let moved: DVec3 = weights.iter().map(|&(j, weight)| weight * moves[j as usize].transform_point3(p)).sum();
        if sum > 0.0 { moved / sum } else { p }
    };
    positions.iter().enumerate().map(of).collect()
}
