//! Skin weights of the result, on the joints of the target rig, and the garment's own joints, which come along.

use std::sync::Arc;

use glam::{DAffine3, DVec3};

use super::Session;
use super::inputs::Inputs;
use super::snapshot::Snapshot;
use crate::control::{Cancel, Stage};
use crate::error::{Error, ErrorKind, Result};
use crate::geometry::mesh::TriangleMesh;
use crate::input::skin::SkinWeights;
use crate::rig::joint_map::{MappedJoint, Reason};
use crate::rig::weights::own_joints::{AddedJoint, SourceRig, keep_own};
use crate::rig::weights::{TransferOptions, limited, move_as_one, transfer};
use crate::stage::setup::loose_pieces::LoosePieces;

/// A loose piece whose longest side is below this, in the normalised space, moves as one; a belt does not.
const BUTTON: f64 = 0.15;

/// What makes a result move.
#[derive(Debug)]
pub struct GarmentSkin {
    /// Weights of the caller's garment vertices, on the joints of the target rig and the added ones after them; of any number
    /// of joints.
    pub weights: SkinWeights,
    /// The garment's own joints, numbered on from those of the target rig, in the target's coordinate system.
    pub added: Vec<AddedJoint>,
}

impl Session {
    /// Skin weights of the garment as it is now, each vertex with at most so many joints: above 0, of sum 1. They are found
    /// once; a step forgets them.
    ///
    /// # Errors
    /// `InvalidState` before the end, or where the target avatar has no skin weights, `InvalidArgument` for 0 influences,
    /// `Cancelled`.
    pub fn garment_skin(&self, influences: usize) -> Result<SkinWeights> {
        if influences == 0 {
            return Err(Error::new(
                ErrorKind::InvalidArgument,
                "garment skin: the number of influences for each vertex is 0; engines take 4 or 8",
            ));
        }
        Ok(limited(&self.whole_skin()?.weights, influences))
    }

    /// The garment's own joints, those of a skirt or a cape, in the order of their numbers, which follow on those of the target
    /// rig.
    ///
    /// # Errors
    /// As [`Self::garment_skin`].
    pub fn added_joints(&self) -> Result<Vec<AddedJoint>> {
        Ok(self.whole_skin()?.added.clone())
    }

    pub(super) fn whole_skin(&self) -> Result<Arc<GarmentSkin>> {
        if let Some(found) = self.skin.get() {
            return Ok(found.clone());
        }
        let (Some(snapshot), Stage::Done) = (&self.snapshot, self.stage) else {
            return Err(Error::new(
                ErrorKind::InvalidState,
                "garment skin: there is no result yet; run the session to its end first",
            ));
        };
        if self.inputs.skin.is_none() {
            return Err(Error::new(
                ErrorKind::InvalidState,
                "garment skin: the target avatar has no skin weights to take over; set them before prepare",
            ));
        }
        let (snapshot, inputs) = (snapshot.clone(), self.inputs.clone());
        let found = Arc::new(self.aside(move |cancel| snapshot.garment_skin(&inputs, cancel))?);
        Ok(self.skin.get_or_init(|| found).clone())
    }
}

impl Snapshot {
    fn garment_skin(&self, inputs: &Inputs, cancel: &Cancel) -> Result<GarmentSkin> {
        let Some(body_skin) = &inputs.skin else { return Err(Error::new(ErrorKind::Internal, "there is no skin")) };
        let problem = &self.problem;
        let [vertices, triangles] = self.body.avatar_size();
        let body = TriangleMesh {
            positions: problem.avatar.positions[..vertices].to_vec(),
            triangles: problem.avatar.triangles[..triangles].to_vec(),
        };
        let garment = TriangleMesh { positions: self.x.clone(), triangles: problem.triangles.clone() };
        let transferred = transfer(&garment, &body, body_skin, &TransferOptions::default(), cancel)?;
        let mut weights = transferred;
        let mut added = Vec::new();
        if let Some(own) = inputs.garment_skin() {
            // Of the vertices in one place, the first speaks.
            let rows = problem.weld.vertex_of.iter().map(|&v| own.weights(v as usize).to_vec());
            let own = SkinWeights::from_rows(own.joint_count(), rows);
            added = self.added_joints(inputs, &own)?;
            weights = keep_own(&weights, &own, &added)?;
            let from_internal = self.coordinate_system().affine_to_internal().inverse();
            added.iter_mut().for_each(|joint| joint.bind = from_internal * joint.bind);
        }
        let weights = move_as_one(&weights, &self.stiff_groups())?;
        let rows: Vec<usize> = problem.weld.scatter(&(0..self.x.len()).collect::<Vec<_>>());
        let rows = rows.into_iter().map(|welded| weights.weights(welded).to_vec());
        Ok(GarmentSkin { weights: SkinWeights::from_rows(weights.joint_count(), rows), added })
    }

    /// What moves as one: the caller's rigid groups, carried pieces that are stiff, and small loose pieces such as buttons.
    fn stiff_groups(&self) -> Vec<Vec<u32>> {
        let problem = &self.problem;
        let stiff = problem.carried.stiff().map(|(vertices, _)| vertices.to_vec());
        let mut groups: Vec<Vec<u32>> = problem.callers_groups.iter().cloned().chain(stiff).collect();
        let mut is_grouped = vec![false; problem.rest.len()];
        groups.iter().flatten().for_each(|&v| is_grouped[v as usize] = true);
        for piece in LoosePieces::find(&problem.rest, &problem.triangles).pieces {
            let points = || piece.vertices.iter().map(|&v| problem.rest[v as usize]);
            let (low, high) = (points().reduce(DVec3::min), points().reduce(DVec3::max));
            let side = high.zip(low).map_or(0.0, |(high, low)| (high - low).max_element());
            if side < BUTTON && !piece.vertices.iter().any(|&v| is_grouped[v as usize]) {
                groups.push(piece.vertices);
            }
        }
        groups
    }

    /// The garment's own joints, in the internal coordinate system.
    fn added_joints(&self, inputs: &Inputs, own: &SkinWeights) -> Result<Vec<AddedJoint>> {
        let rigs = inputs.posed_rigs()?;
        let map = inputs.joint_map_of(&rigs)?;
        let [source, target] = rigs;
        let targets: Vec<Option<u32>> = map.joints.iter().map(counterpart).collect();
        let parents: Vec<Option<u32>> = source.rig.joints.iter().map(|joint| joint.parent).collect();
        let binds: Vec<DAffine3> = source.rig.joints.iter().map(|joint| DAffine3::from_mat4(joint.bind)).collect();
        let rig = SourceRig { parents: &parents, binds: &binds, map: &targets, target_joints: target.rig.joints.len() };
        let found = rig.own_joints(own, source.skin.as_deref());
        let problem = &self.problem;
        let designed: Vec<DVec3> = problem.rest.iter().map(|&p| problem.source_normalization.restore(p)).collect();
        let fitted: Vec<DVec3> = self.x.iter().map(|&p| problem.target_normalization.restore(p)).collect();
        Ok(rig.added_joints(&found, own, &designed, &fitted))
    }
}

/// The joint of the target that moves what a joint of the source moves; none for one that is the garment's own: no part of a
/// body, and nothing that helps one.
fn counterpart(joint: &MappedJoint) -> Option<u32> {
    joint.target.filter(|_| joint.part.is_some() || joint.helps || joint.reason != Reason::Ancestor)
}
