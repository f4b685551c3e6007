//! A neck that is too low: the joint from which the arms branch off and the head goes on lies between the arms, so that the
//! head begins below the collar.
//!
//! Two things say so, and both must: the plane across the neck cuts the arms, which it does not in the other figure; and the
//! shoulders' joints lie higher beside the neck than they do there. Where in both skeletons the arms branch off at the
//! chest, nothing is wrong.

use std::f64::consts::TAU;

use glam::DVec3;

use super::{Figure, Misplaced};
use crate::geometry::mesh::TriangleMesh;
use crate::geometry::section::Section;
use crate::input::diagnostic::JointFault;
use crate::maths;

/// A bone goes on where another leaves its end within 60 degrees of its direction.
const GOES_ON: f64 = 0.5;
/// No joint but that of the head lies farther beyond the neck than this, in the figure that is right.
const LAST: f64 = 0.15;
/// Planes across the neck, up to the highest.
const STEP: f64 = 0.02;
const HIGHEST: f64 = 0.4;
/// A plane cuts limbs where its section reaches farther than the shoulders' joints, and this many times as far as in the
/// middle of all directions. Chins, hair and big heads do one of the two.
const LIMBS: f64 = 1.6;
/// The highest plane that cuts limbs is farther above the neck than in the other figure by this at least. In 72 pairs of
/// real bodies it was so by up to 0.08 where the neck was right, and by 0.1 to 0.4 where it was too low.
const CUTS: f64 = 0.09;
/// And in the other figure it is not farther than this: there 0.08 was the most, too.
const PROPER: f64 = 0.09;
/// The shoulders are higher beside the neck than in the other figure by this at least: by up to 0.06 in pairs where it was
/// right, and by 0.14 to 0.33 where it was too low.
const HIGHER: f64 = 0.1;
/// Directions around the neck.
const SECTORS: usize = 16;

/// A joint from which limbs branch off, and beyond which a head goes on, with a bone of its own or without.
struct Neck {
    joint: u32,
    /// The bone from the trunk.
    bone: u32,
    /// The head's bone.
    head: Option<u32>,
    /// Where the bones of the limbs lead.
    sides: Vec<u32>,
}

/// The necks of `figure` that are too low, seen from `other`; `garment` is around the other's skeleton and stands for its body
/// where that is not known.
pub(super) fn find(figure: &Figure, other: &Figure, garment: Option<&TriangleMesh>) -> Vec<Misplaced> {
    let Some(flesh) = &figure.flesh else { return Vec::new() };
    let Some(reference) = other.flesh.as_ref().map(|flesh| &*flesh.mesh).or(garment) else { return Vec::new() };
    let low = |neck: Neck| {
        let (place, along) = (figure.place(neck.joint), figure.beyond(&neck)?);
        let other_along = other.beyond(&neck)?;
        let proper = other.limb_height(&neck, reference, other_along);
        let cuts = figure.limb_height(&neck, &flesh.mesh, along) - proper;
        let higher = figure.shoulder_height(&neck, along) - other.shoulder_height(&neck, other_along);
        // What is right lies between the two: shoulders differ, and planes above them cut the slopes of the neck.
        let lift = cuts.min(higher);
        (proper <= PROPER && cuts >= CUTS && higher >= HIGHER)
            .then(|| figure.misplaced(neck.bone, neck.joint, JointFault::Low, lift, Some(place + lift * along)))
    };
    other.necks().into_iter().filter_map(low).collect()
}

impl Figure {
    fn necks(&self) -> Vec<Neck> {
        let bones = 0..self.skeleton.bones.len() as u32;
        bones
            .flat_map(|bone| self.skeleton.bones[bone as usize].map(|joint| self.neck(bone, joint)))
            .flatten()
            .collect()
    }

    /// The neck at `joint`, if there is one, where `bone` comes from the trunk.
    fn neck(&self, bone: u32, joint: u32) -> Option<Neck> {
        let place = self.place(joint);
        let along = (place - self.place(self.other(bone, joint))).try_normalize()?;
        let goes_on =
            |&other: &u32| (self.place(self.other(other, joint)) - place).normalize_or_zero().dot(along) > GOES_ON;
        let others = self.graph.bones_at(joint).iter().copied().filter(|&other| other != bone);
        let (on, aside): (Vec<u32>, Vec<u32>) = others.partition(goes_on);
        let ends = |bones: &[u32]| bones.iter().map(|&other| self.other(other, joint)).collect::<Vec<_>>();
        let (heads, sides) = (ends(&on), ends(&aside));
        let head = heads.first().copied();
        let is_last = (0..self.skeleton.joints.len() as u32)
            .filter(|&other| Some(other) != head)
            .all(|other| (self.place(other) - place).dot(along) < LAST);
        let is_neck = sides.len() >= 2 && heads.len() <= 1 && head.is_none_or(|head| self.graph.is_leaf(head));
        (is_neck && is_last).then_some(Neck { joint, bone, head, sides })
    }

    /// The direction from the neck into the head; without a bone there, away from the trunk, whose last bone may be bent.
    fn beyond(&self, neck: &Neck) -> Option<DVec3> {
        let place = self.place(neck.joint);
        neck.head.map_or_else(|| place - self.skeleton.mean_joint(), |head| self.place(head) - place).try_normalize()
    }

    /// How far the highest of the limbs' joints is above the neck.
    fn shoulder_height(&self, neck: &Neck, along: DVec3) -> f64 {
        let height = |&side: &u32| (self.place(side) - self.place(neck.joint)).dot(along);
        neck.sides.iter().map(height).fold(f64::NEG_INFINITY, f64::max)
    }

    /// How far above the neck the highest plane across `along` is that cuts limbs of `mesh`; 0 where none does.
    fn limb_height(&self, neck: &Neck, mesh: &TriangleMesh, along: DVec3) -> f64 {
        let place = self.place(neck.joint);
        let aside = |&side: &u32| (self.place(side) - place).reject_from_normalized(along).length();
        let shoulders = neck.sides.iter().map(aside).fold(0.0, f64::max);
        let cuts = |&height: &f64| {
            let [middle, farthest] = reach(mesh, place + height * along, along);
            farthest >= shoulders && farthest >= LIMBS * middle && farthest > 0.0
        };
        let heights = (0..).map(|k| STEP * f64::from(k)).take_while(|&height| height <= HIGHEST);
        heights.filter(cuts).last().unwrap_or(0.0)
    }
}

/// How far the section of the plane through `centre` across `along` reaches: in the middle of all directions, and at the
/// farthest.
fn reach(mesh: &TriangleMesh, centre: DVec3, along: DVec3) -> [f64; 2] {
    let mut reach = [0.0_f64; SECTORS];
    for [a, b] in Section::cut(mesh, centre, along).segments() {
        for p in (0..=8).map(|k| a.lerp(*b, f64::from(k) / 8.0)) {
            let turn = maths::atan2(p.y, p.x).rem_euclid(TAU) / TAU;
            let sector = &mut reach[((turn * SECTORS as f64) as usize).min(SECTORS - 1)];
            *sector = sector.max(p.length());
        }
    }
    reach.sort_by(f64::total_cmp);
    [reach[SECTORS / 2], reach[SECTORS - 1]]
}
