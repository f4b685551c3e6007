//! Joints that do not lie where the bodies want them, and where they would lie better.
//!
//! A skeleton decides where each part of a body begins, so a joint beside its limb decides wrongly and says nothing. Here
//! both skeletons are held against their bodies, and against each other. All lengths are in units in which the skeleton is
//! 2 long, but for those of [`Misplaced::length`] and [`Misplaced::place`].

mod flesh;
mod neck;
mod outside;
mod tip;

use std::convert::Infallible;
use std::sync::Arc;

use glam::DVec3;

use crate::geometry::mesh::TriangleMesh;
use crate::input::coordinate_system::CoordinateSystem;
use crate::input::diagnostic::{Bone, Diagnostic, JointFault, Subject};
use crate::input::skeleton::{BoneGraph, Skeleton};

pub use flesh::Flesh;

/// The longest side of a skeleton here.
const SIDE: f64 = 2.0;

/// A joint that lies wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Misplaced {
    /// The source or the target skeleton.
    pub skeleton: Subject,
    /// A bone that leads to it, its joints in the order from the other one to this one.
    pub bone: Bone,
    /// What is wrong with it.
    pub fault: JointFault,
    /// How far it is from the body, or from the better place.
    pub distance: f64,
    /// The same, in the skeleton's own unit.
    pub length: f64,
    /// The same, as a share of the bone's length.
    pub share: f64,
    /// The better place, in the skeleton's own coordinates; none where none is known.
    pub place: Option<DVec3>,
    /// It is better for sure.
    pub is_sure: bool,
}

impl Misplaced {
    /// The joint.
    pub fn joint(&self) -> u32 {
        self.bone.joints[1]
    }

    /// The place to which it is taken, if it is.
    fn taken(&self) -> Option<DVec3> {
        self.place.filter(|_| self.is_sure)
    }

    /// The diagnostic about it, for a skeleton whose caller has it in `system`.
    pub fn diagnostic(&self, system: &CoordinateSystem, mended: bool) -> Diagnostic {
        let &Self { skeleton, bone, fault, distance, length, share, place, .. } = self;
        Diagnostic::JointMisplaced {
            skeleton,
            bone,
            fault,
            distance,
            length: length / system.metres_per_unit,
            share,
            place: place.map(|place| system.position_from_internal(place).to_array()),
            mended: mended && self.taken().is_some(),
        }
    }
}

/// A skeleton and its body, where that is known.
pub struct Figure {
    subject: Subject,
    /// The skeleton, 2 long.
    skeleton: Skeleton,
    flesh: Option<Arc<Flesh>>,
    graph: BoneGraph,
    /// From the skeleton's own unit.
    scale: f64,
}

impl Figure {
    /// The figure of `skeleton` with its `body`; none for a skeleton without size.
    pub fn new(subject: Subject, skeleton: &Skeleton, body: Option<&TriangleMesh>) -> Option<Self> {
        Self::with_flesh(subject, skeleton, body, |mesh| Ok::<_, Infallible>(Arc::new(Flesh::new(mesh))))?.ok()
    }

    /// The same, and `flesh` makes that of the body's mesh, as large as the skeleton is here, or has it already.
    ///
    /// # Errors
    /// That of `flesh`.
    pub fn with_flesh<E>(
        subject: Subject,
        skeleton: &Skeleton,
        body: Option<&TriangleMesh>,
        flesh: impl FnOnce(TriangleMesh) -> Result<Arc<Flesh>, E>,
    ) -> Option<Result<Self, E>> {
        let scale = SIDE / skeleton.longest_side("").ok()?;
        let graph = BoneGraph::new(skeleton);
        let joints = skeleton.joints.iter().map(|&p| p * scale).collect();
        let skeleton = Skeleton { joints, bones: skeleton.bones.clone() };
        let figure = Self { subject, skeleton, flesh: None, graph, scale };
        let flesh = body.map(|mesh| flesh(figure.scaled(mesh))).transpose();
        Some(flesh.map(|flesh| Self { flesh, ..figure }))
    }

    /// A mesh in the skeleton's own coordinates, as large as the skeleton is here.
    fn scaled(&self, mesh: &TriangleMesh) -> TriangleMesh {
        let positions = mesh.positions.iter().map(|&p| p * self.scale).collect();
        TriangleMesh { positions, triangles: mesh.triangles.clone() }
    }

    /// Takes the joints that were found to their better places.
    fn take(&mut self, found: &[Misplaced]) {
        for misplaced in found.iter().filter(|misplaced| misplaced.skeleton == self.subject) {
            if let Some(place) = misplaced.taken() {
                self.skeleton.joints[misplaced.joint() as usize] = place * self.scale;
            }
        }
    }

    /// The joint at the other end of a bone.
    fn other(&self, bone: u32, joint: u32) -> u32 {
        let [a, b] = self.skeleton.bones[bone as usize];
        if a == joint { b } else { a }
    }

    fn place(&self, joint: u32) -> DVec3 {
        self.skeleton.joints[joint as usize]
    }

    /// A finding about `joint`, to which `bone` leads.
    fn misplaced(&self, bone: u32, joint: u32, fault: JointFault, distance: f64, place: Option<DVec3>) -> Misplaced {
        let from = self.other(bone, joint);
        Misplaced {
            skeleton: self.subject,
            bone: Bone { index: bone, joints: [from, joint] },
            fault,
            distance,
            length: distance / self.scale,
            share: distance / self.place(from).distance(self.place(joint)),
            place: place.map(|p| p / self.scale),
            is_sure: true,
        }
    }
}

/// The joints of both skeletons that lie wrong; `garment` is in the coordinates of the source skeleton. A joint that is
/// outside is looked at again where it was put.
pub fn find(mut target: Figure, mut source: Figure, garment: &TriangleMesh) -> Vec<Misplaced> {
    let mut found = outside::find(&target, &source);
    target.take(&found);
    source.take(&found);
    let garment = source.scaled(garment);
    let necks = neck::find(&target, &source, Some(&garment)).into_iter().chain(neck::find(&source, &target, None));
    for more in necks.chain(tip::find(&target, &source)).chain(tip::find(&source, &target)) {
        match found.iter_mut().find(|first| first.skeleton == more.skeleton && first.joint() == more.joint()) {
            Some(first) if more.is_sure => first.place = more.place,
            Some(_) => {}
            None => found.push(more),
        }
    }
    found
}

/// Takes the joints that were found in `skeleton` to their better places.
pub fn mend(skeleton: &mut Skeleton, subject: Subject, found: &[Misplaced]) {
    for misplaced in found.iter().filter(|misplaced| misplaced.skeleton == subject) {
        if let Some(place) = misplaced.taken() {
            skeleton.joints[misplaced.joint() as usize] = place;
        }
    }
}
