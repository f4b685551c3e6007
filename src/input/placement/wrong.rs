//! What is wrong with a mesh that its distance from the bones suggests and their way through it proves.
//!
//! Thick bodies and wide garments lie not much farther from their bones in a wrong unit or turned, and garments around few bones
//! nearer to them in many a reading. So a reading that is a little nearer is tried on what nobody designs: a body beside its
//! bones, a garment whose bones pass beside its openings and through its cloth.

use std::cell::OnceCell;

use glam::DVec3;

use super::evidence::{Threaded, Threading, inside_share};
use super::size::{Mend, Surroundings};
use super::tilt::{self, Tilt};
use crate::geometry::mesh::TriangleMesh;
use crate::input::coordinate_system::AxisTurn;
use crate::input::skeleton::Skeleton;

/// A reading is tried where it is so many times nearer: another unit or other axes, and a turn of a body.
const TRIED: f64 = 1.15;
const TRIED_TURN: f64 = 1.06;
/// A body that is turned by less than this, in degrees, and a garment, finds its way.
const LEAST_TURN: f64 = 15.0;
/// Of the bones' length, the share that is inside a body in a right reading at least, and by how much more that has to be than as
/// it is: for another unit, and for a turn.
const INSIDE: f64 = 0.8;
const MORE_INSIDE: f64 = 0.3;
const MORE_INSIDE_TURNED: f64 = 0.2;
/// The same where the reading is so many times nearer.
const MUCH_NEARER: f64 = 1.9;
const ALMOST_ALL: f64 = 0.9;
const LITTLE_MORE: f64 = 0.08;
/// The same for a body of which much is no flesh, such as that of a skeleton, where the reading is so many times nearer: as it is,
/// no more may be inside than this share of what is then.
const NEARER: f64 = 1.3;
const HALF_INSIDE: f64 = 0.45;
const AS_IT_IS: f64 = 0.5;
/// So many more bones have to go through openings, and not through cloth; one of a garment that has bones in its openings as it is
/// where the reading is as much nearer as that.
const MORE_THREADED: usize = 2;

/// How a mesh has to be read.
#[derive(Clone, Debug, PartialEq)]
pub enum Wrong {
    /// In another unit or other axes.
    Read(Mend),
    /// Turned back.
    Turned(Tilt),
}

impl Wrong {
    /// Said as surely as what mends the distances by much.
    fn proven(self) -> Self {
        match self {
            Self::Read(mend) => Self::Read(Mend { is_proven: true, ..mend }),
            turned => turned,
        }
    }
}

/// The points about which meshes are turned by mistake: the origin of coordinates, and the middle of the joints, by their mean
/// and of the box around them.
fn centres(skeleton: &Skeleton) -> [DVec3; 3] {
    let mean = skeleton.joints.iter().sum::<DVec3>() / skeleton.joints.len().max(1) as f64;
    let (low, high) = skeleton.joints.iter().fold((DVec3::MAX, DVec3::MIN), |(l, h), &p| (l.min(p), h.max(p)));
    [DVec3::ZERO, mean, 0.5 * (low + high)]
}

/// The skeleton as it lies in a mesh that is read by `mend`.
fn read(skeleton: &Skeleton, mend: &Mend) -> Skeleton {
    let back = mend.clone().inverse().turn;
    let joints = skeleton.joints.iter().map(|&p| back.apply(p) / mend.factor).collect();
    Skeleton { joints, bones: skeleton.bones.clone() }
}

/// The skeleton as it lies in a mesh that is turned back by `tilt`.
fn turned(skeleton: &Skeleton, tilt: &Tilt) -> Skeleton {
    let joints = skeleton.joints.iter().map(|&p| tilt.inverse().apply(p)).collect();
    Skeleton { joints, bones: skeleton.bones.clone() }
}

/// The readings to try, the nearer first: another unit or other axes, and a turn.
fn readings(around: &Surroundings, skeleton: &Skeleton, tried_turn: f64) -> Vec<(Wrong, f64)> {
    let is_other = |mend: &Mend| mend.factor != 1.0 || mend.turn != AxisTurn::IDENTITY;
    let mend = around.nearest().filter(|mend| is_other(mend) && mend.gain >= TRIED);
    let is_tried = |(tilt, gain): &(Tilt, f64)| *gain >= tried_turn && tilt.degrees.abs() >= LEAST_TURN;
    let tilt = tilt::nearest(around, &centres(skeleton)).filter(is_tried);
    let mut all: Vec<(Wrong, f64)> = mend.into_iter().map(|mend| (Wrong::Read(mend.clone()), mend.gain)).collect();
    all.extend(tilt.map(|(tilt, gain)| (Wrong::Turned(tilt), gain)));
    all.sort_by(|a, b| b.1.total_cmp(&a.1));
    all
}

/// What is wrong with a body, whose `around` knows no skin. On a skeleton without a branch, such as an arm's, bones may go on where
/// the body has ended.
pub fn of_body(body: &TriangleMesh, around: &Surroundings, skeleton: &Skeleton) -> Option<Wrong> {
    let mut degree = vec![0_u32; skeleton.joints.len()];
    skeleton.bones.iter().flatten().for_each(|&j| degree[j as usize] += 1);
    if degree.iter().all(|&degree| degree < 3) {
        return None;
    }
    let as_it_is = OnceCell::new();
    let is_right = |(wrong, gain): &(Wrong, f64)| {
        let before = *as_it_is.get_or_init(|| inside_share(body, skeleton));
        let enough = match wrong {
            Wrong::Read(_) => MORE_INSIDE,
            Wrong::Turned(_) => MORE_INSIDE_TURNED,
        };
        if before + LITTLE_MORE > 1.0 {
            return false;
        }
        let inside = match wrong {
            Wrong::Read(mend) => inside_share(body, &read(skeleton, mend)),
            Wrong::Turned(tilt) => inside_share(body, &turned(skeleton, tilt)),
        };
        inside >= INSIDE && inside - before >= enough
            || *gain >= MUCH_NEARER && inside >= ALMOST_ALL && inside - before >= LITTLE_MORE
            || *gain >= NEARER && inside >= HALF_INSIDE && before <= AS_IT_IS * inside
    };
    readings(around, skeleton, TRIED_TURN).into_iter().find(is_right).map(|(wrong, _)| wrong.proven())
}

/// What is wrong with a garment against the skeleton that it was designed on.
pub fn of_garment(garment: &TriangleMesh, around: &Surroundings, skeleton: &Skeleton) -> Option<Wrong> {
    let tried = readings(around, skeleton, TRIED);
    if tried.is_empty() {
        return None;
    }
    let threaded = Threaded::new(garment);
    let as_it_is = threaded.on(skeleton);
    let is_right = |(wrong, gain): &(Wrong, f64)| {
        let on: Threading = match wrong {
            Wrong::Read(mend) => threaded.on(&read(skeleton, mend)),
            Wrong::Turned(tilt) => threaded.on(&turned(skeleton, tilt)),
        };
        let least = if *gain >= MUCH_NEARER && as_it_is.through > 0 { 1 } else { MORE_THREADED };
        on.better_than(&as_it_is).is_some_and(|more| more >= least)
    };
    tried.into_iter().find(is_right).map(|(wrong, _)| wrong.proven())
}
