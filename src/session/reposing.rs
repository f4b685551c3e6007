//! REPOSE: the body goes from the pose in which the garment was solved to its own, piece by piece, and takes the garment along.

use std::sync::Arc;

use glam::{DAffine3, DVec3};

use super::way::Way;
use crate::contact::{Avatar, Surface};
use crate::control::Cancel;
use crate::geometry::mesh::TriangleMesh;
use crate::input::body::Body;
use crate::input::coordinate_system::CoordinateSystem;
use crate::input::diagnostic::Diagnostic;
use crate::input::skin::SkinWeights;
use crate::options::Options;
use crate::solver::newton::State;
use crate::stage::blockage::pushes;
use crate::stage::contact_guard::ContactGuard;
use crate::stage::objective::Objective;
use crate::stage::repose::Repose;
use crate::stage::setup::layer_skin::places_beneath;
use crate::stage::setup::problem::{Problem, collapse_unused};

/// No joint turns by more than this many degrees in a piece: each vertex goes straight where it should go along an arc.
const PIECE: f64 = 12.0;

/// The problem in the source's pose with the garment as the inflation left it, to which a run returns where the way is closed.
pub(super) struct Posed {
    pub(super) problem: Arc<Problem>,
    pub(super) body: Arc<Body>,
    pub(super) x: Vec<DVec3>,
}

/// The problem in the target's own pose, and the way there.
pub(super) struct Reposing {
    pub(super) problem: Arc<Problem>,
    pub(super) body: Arc<Body>,
    way: Way,
    /// Weights of the garment's vertices, on the target rig; known once the way begins.
    pub(super) skin: Option<SkinWeights>,
    pub(super) pieces: u32,
    /// The piece under way.
    pub(super) piece: u32,
    pub(super) step: Option<Repose>,
    /// Iterations so far.
    pub(super) iterations: u32,
    /// What was left behind.
    pub(super) posed: Option<Posed>,
}

impl Reposing {
    pub(super) fn new(problem: Arc<Problem>, body: Arc<Body>, way: Way) -> Self {
        let pieces = (way.posing.largest_turn().to_degrees() / PIECE).ceil().max(1.0) as u32;
        Self { problem, body, way, skin: None, pieces, piece: 0, step: None, iterations: 0, posed: None }
    }

    /// Where the body is at the beginning of a piece, as a share of the way from its own pose.
    fn share(&self, piece: u32) -> f64 {
        f64::from(self.pieces - piece) / f64::from(self.pieces)
    }

    /// The vertices of body and layers at the beginning of a piece, in the caller's coordinates.
    pub(super) fn body_points(&self, piece: u32) -> Vec<DVec3> {
        if piece == self.pieces {
            return self.body.mesh.positions.clone();
        }
        self.way.points(self.share(piece))
    }

    /// The avatar without its layers where it is now, in the caller's coordinates.
    pub(super) fn avatar_points(&self, t: f64) -> Vec<DVec3> {
        let (from, to) = (self.body_points(self.piece), self.body_points((self.piece + 1).min(self.pieces)));
        let between = from.iter().zip(&to).map(|(a, b)| a.lerp(*b, t));
        between.take(self.body.avatar_positions().len()).collect()
    }

    /// The body in the normalised space.
    pub(super) fn normalised(&self, points: &[DVec3], system: &CoordinateSystem) -> Vec<DVec3> {
        let normalization = &self.problem.target_normalization;
        let internal = points.iter().map(|&p| normalization.normalise(system.position_to_internal(p)));
        let mut mesh = TriangleMesh { positions: internal.collect(), triangles: self.problem.avatar.triangles.clone() };
        collapse_unused(&mut mesh);
        mesh.positions
    }

    /// Weights of garment vertices at `x` on the body at `body`: those of the nearest point.
    pub(super) fn garment_skin(&self, x: &[DVec3], body: &TriangleMesh) -> SkinWeights {
        self.way.skin.at(&places_beneath(body, x))
    }

    /// How garment vertices at `x` go along with the body in a piece.
    pub(super) fn along(&self, x: &[DVec3], system: &CoordinateSystem) -> Vec<DVec3> {
        let Some(skin) = &self.skin else { return vec![DVec3::ZERO; x.len()] };
        let motions = self.way.motions_between(self.share(self.piece), self.share(self.piece + 1));
        let normalization = &self.problem.target_normalization;
        // The motions are in the internal coordinates of the body as told, before any turn.
        let told =
            |&p: &DVec3| self.way.system.position_to_internal(system.position_from_internal(normalization.restore(p)));
        let points: Vec<DVec3> = x.iter().map(told).collect();
        let moved = self.way.posing.moved(&motions, skin, &points);
        let back =
            |p: DVec3| normalization.normalise(system.position_to_internal(self.way.system.position_from_internal(p)));
        moved.into_iter().zip(x).map(|(p, x)| back(p) - *x).collect()
    }

    /// The objective of a piece: the avatar goes from its beginning to its end.
    pub(super) fn objective(&self, system: &CoordinateSystem, options: &Options, cancel: &Cancel) -> Objective {
        let start = self.normalised(&self.body_points(self.piece), system);
        let end = self.normalised(&self.body_points(self.piece + 1), system);
        let motion = start.iter().zip(&end).map(|(&a, &b)| b - a).collect();
        let surface = Surface::new(start.len(), self.problem.avatar.triangles.clone());
        let bodies = self.problem.bodies(Avatar { surface, start, motion });
        let (shape, distances) = (self.problem.shape.clone(), self.problem.distances);
        let mut objective = Objective::new(shape, None, bodies, distances, options, cancel.clone());
        objective.release_places();
        objective.contact.set_intersecting_at_rest(&self.problem.designed_intersections);
        objective
    }
}

impl Reposing {
    /// What closes the way where the garment at `state` does not let the body pass: the part that resists most, and the other
    /// one that pushes hardest against it.
    pub(super) fn blocked(&self, contact: &ContactGuard, state: &State) -> Diagnostic {
        let joints = self.way.common.joints.len();
        let (mut resistance, mut force) = (vec![0.0; joints], vec![0.0; joints]);
        let owner = |v: u32| self.way.common.owner[self.way.skin.dominant_joint(v as usize)? as usize];
        for push in pushes(contact.barrier(), state.configuration()) {
            if let Some(joint) = owner(push.vertex) {
                resistance[joint as usize] += push.resistance.max(0.0);
                force[joint as usize] += push.force;
            }
        }
        let most = |values: &[f64], but: Option<u32>| {
            let others = (0u32..).zip(values).filter(|&(joint, value)| *value > 0.0 && Some(joint) != but);
            others.max_by(|(i, a), (j, b)| a.total_cmp(b).then(j.cmp(i))).map(|(joint, _)| joint)
        };
        let first = most(&resistance, None);
        let second = first.and_then(|first| most(&force, Some(first)));
        let share = (f64::from(self.piece) + state.t) / f64::from(self.pieces);
        Diagnostic::PoseBlocked { share, joints: first.into_iter().chain(second).collect() }
    }

    /// How each joint of the target rig moves from its bind pose to that in which the garment is solved, in the caller's
    /// coordinates.
    pub(super) fn motions(&self) -> Vec<DAffine3> {
        let map = self.way.system.affine_to_internal();
        self.way.posing.motions(1.0).iter().map(|motion| map.inverse() * *motion * map).collect()
    }
}
