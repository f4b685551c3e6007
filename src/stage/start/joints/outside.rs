//! Joints and bones outside of the body.

use glam::DVec3;

use super::{Figure, Misplaced};
use crate::geometry::section::Section;
use crate::input::diagnostic::JointFault;

/// A joint or a part of a bone that is farther from the body than this is outside of it. In 30 real bodies that were fitted
/// well, tips stuck out by up to 0.05, as the top of a head above its hair, and bones by up to 0.06, as a neck between a head
/// and a trunk that were modelled apart.
const OUTSIDE: f64 = 0.1;
/// Places along a bone.
const PLACES: usize = 32;
/// Where less of a last bone than this is inside of the body, no limb is there: hands, a head or legs that the body goes
/// without.
const LIMB: f64 = 0.5;
/// A last bone that is no limb's leaves the body over this length at least, seen from half of which the body is all around.
/// Real limbs whose bones left them, over up to 0.5, had the body on one side.
const STRAY: f64 = 0.2;
/// A bone that is no limb's begins where so many bones meet.
const FORK: usize = 3;
/// A bone with another last one of this length at the same joint is one of a pair.
const ALIKE: f64 = 0.1;

/// What is outside in both figures.
pub(super) fn find(target: &Figure, source: &Figure) -> Vec<Misplaced> {
    let mut found = Vec::new();
    for joint in 0..target.skeleton.joints.len() as u32 {
        let strays = [target, source].map(|figure| figure.stray(joint));
        // No limb in one figure is no limb in the other, unless that has one.
        if let [Some(in_target), in_source] = strays
            && (in_source.is_some() || source.flesh.is_none())
        {
            found.push(in_target);
            let bone = in_target.bone.index;
            found.push(in_source.unwrap_or_else(|| source.collapsed(bone, joint, 1.0)));
        } else {
            found.extend(
                [(target, source), (source, target)].into_iter().filter_map(|(it, other)| it.outside(joint, other)),
            );
        }
    }
    found.extend([target, source].into_iter().flat_map(Figure::bones_outside));
    found
}

impl Figure {
    /// Whether a joint is outside of the body, and how far; 0 where it is not.
    fn outside_by(&self, p: DVec3) -> f64 {
        let Some(flesh) = &self.flesh else { return 0.0 };
        let distance = flesh.distance(p);
        if distance.is_finite() && distance >= OUTSIDE && flesh.excludes(p) { distance } else { 0.0 }
    }

    /// A last joint whose bone is no limb's, such as a root on the floor: outside of the body and between its parts.
    fn stray(&self, joint: u32) -> Option<Misplaced> {
        let flesh = self.flesh.as_ref()?;
        let &[bone] = self.graph.bones_at(joint) else { return None };
        let from = self.other(bone, joint);
        let (a, b) = (self.place(from), self.place(joint));
        if self.graph.degree(from) < FORK || self.is_paired(bone, joint, from) || !flesh.excludes(b) {
            return None;
        }
        let places = (1..=PLACES).map(|k| a.lerp(b, k as f64 / PLACES as f64));
        let outside: Vec<DVec3> = places.filter(|&p| flesh.excludes(p)).collect();
        let length = a.distance(b);
        let share = outside.len() as f64 / PLACES as f64;
        if share < LIMB || share * length < STRAY {
            return None;
        }
        let between = outside.iter().filter(|&&p| Section::cut(&flesh.mesh, p, b - a).encloses(p)).count();
        (2 * between >= outside.len()).then(|| self.collapsed(bone, joint, share))
    }

    /// The finding about a joint whose bone is no limb's, this share of it outside: it is best where that bone begins.
    fn collapsed(&self, bone: u32, joint: u32, share: f64) -> Misplaced {
        let place = self.place(self.other(bone, joint));
        self.misplaced(bone, joint, JointFault::Stray, share * place.distance(self.place(joint)), Some(place))
    }

    fn is_paired(&self, bone: u32, joint: u32, from: u32) -> bool {
        let length = |joint: u32| self.place(from).distance(self.place(joint));
        let alike = |&other: &u32| {
            let end = self.other(other, from);
            other != bone && self.graph.is_leaf(end) && (length(end) / length(joint) - 1.0).abs() < ALIKE
        };
        self.graph.bones_at(from).iter().any(alike)
    }

    /// A joint outside of the body, whose neighbours are inside. The better place of a last one is the last on its bone that
    /// is inside, that of another is in the middle of the limb beside it. Many rigs end beyond the tips of their limbs, and
    /// lengthened on one side alone a bone no longer means the same on both: so a last joint has to be inside in the `other`
    /// figure.
    fn outside(&self, joint: u32, other: &Self) -> Option<Misplaced> {
        let flesh = self.flesh.as_ref()?;
        if self.graph.is_leaf(joint) && !other.flesh.as_ref().is_some_and(|flesh| flesh.contains(other.place(joint))) {
            return None;
        }
        let (p, bones) = (self.place(joint), self.graph.bones_at(joint));
        let distance = self.outside_by(p);
        let neighbours = || bones.iter().map(|&bone| self.place(self.other(bone, joint)));
        if distance == 0.0 || !neighbours().all(|q| flesh.contains(q)) {
            return None;
        }
        let &[bone] = bones else {
            // The bone that the limb hangs on comes first in most rigs.
            let middle = flesh.middle_near(p);
            return Some(self.misplaced(*bones.first()?, joint, JointFault::Outside, distance, middle));
        };
        let from = self.place(self.other(bone, joint));
        let places = (0..PLACES).rev().map(|k| k as f64 / PLACES as f64);
        let share = places.take_while(|&share| share >= LIMB).find(|&share| flesh.contains(from.lerp(p, share)))?;
        Some(self.misplaced(bone, joint, JointFault::Outside, distance, Some(from.lerp(p, share))))
    }

    /// Bones between joints inside that leave the body.
    fn bones_outside(&self) -> Vec<Misplaced> {
        let Some(flesh) = &self.flesh else { return Vec::new() };
        let farthest = |bone: u32| {
            let [a, b] = self.skeleton.bones[bone as usize].map(|joint| self.place(joint));
            let places = (1..PLACES).map(|k| a.lerp(b, k as f64 / PLACES as f64));
            let far: Vec<f64> = places.map(|p| self.outside_by(p)).collect();
            let farthest = far.into_iter().fold(0.0, f64::max);
            (farthest > 0.0 && flesh.contains(a) && flesh.contains(b)).then_some(farthest)
        };
        let finding = |bone: u32| {
            let distance = farthest(bone)?;
            Some(self.misplaced(bone, self.skeleton.bones[bone as usize][1], JointFault::BoneOutside, distance, None))
        };
        (0..self.skeleton.bones.len() as u32).filter_map(finding).collect()
    }
}
