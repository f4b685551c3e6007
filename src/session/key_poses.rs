//! Key poses of the target rig, and the small offsets that keep the garment out of the body there.

use std::sync::Arc;

use super::Session;
use super::pose_solve::{PoseCorrection, PoseSolve};
use crate::control::Stage;
use crate::error::{Error, ErrorKind, Result};
use crate::input::key_pose::KeyPose;
use crate::input::rig::Rig;
use crate::input::skin::SkinWeights;
use crate::rig::pose_path::PosePath;
use crate::stage::setup::layer_skin::skin_with_layers;

impl Session {
    /// A pose of the target rig, in which the garment is to keep out of the body; one more. They are numbered from 0. In
    /// [`Stage::Done`] too, with the result as it is.
    ///
    /// # Errors
    /// `InvalidState` without a target rig, or while a run is under way; `InvalidArgument` for another number of motions than
    /// joints, a number that is not finite, a motion without inverse.
    pub fn add_key_pose(&mut self, pose: KeyPose) -> Result<()> {
        self.posing()?;
        let index = self.inputs.key_poses.len();
        let path = self.target_rig().and_then(|rig| PosePath::new(&rig, pose.motions.clone()));
        path.map_err(|error| Error::new(error.kind, format!("{}: {}", pose.title(index), error.message)))?;
        self.inputs.key_poses.push(Arc::new(pose));
        Ok(())
    }

    /// Removes all key poses.
    ///
    /// # Errors
    /// `InvalidState` while a run is under way.
    pub fn clear_key_poses(&mut self) -> Result<()> {
        self.posing()?;
        self.inputs.key_poses.clear();
        self.corrections.clear();
        Ok(())
    }

    /// Finds the correction of each key pose: from the result on, body and garment go there by their skin weights, the garment's
    /// limited to so many joints a vertex, and the garment gives way where one would pass through the other. The result stays as
    /// it is. Corrections that are there already, for as many joints, are not sought again.
    ///
    /// # Errors
    /// `InvalidState` before the end, without skin weights of the target avatar, and where the result is not in the avatar's own
    /// pose; `InvalidArgument` for no influences; `Cancelled`, after which what was found is kept; `MemoryLimit`, `Internal`.
    pub fn solve_pose_corrections(&mut self, influences: usize) -> Result<()> {
        if self.stage == Stage::Done && self.pose.is_some() {
            return Err(Error::new(
                ErrorKind::InvalidState,
                "pose corrections: the result is not in the avatar's own pose, from which key poses begin",
            ));
        }
        let weights = self.garment_skin(influences)?;
        self.corrections.resize_with(self.inputs.key_poses.len(), || None);
        for index in 0..self.corrections.len() {
            if self.corrections[index].as_ref().is_some_and(|(of, _)| *of == influences) {
                continue;
            }
            let outcome = self.correct(index, &weights);
            self.enter(Stage::Done);
            let title = self.inputs.key_poses[index].title(index);
            let correction = outcome.map_err(|error| match error.kind {
                ErrorKind::Cancelled => self.answer(error),
                kind => Error::new(kind, format!("{title}: {}", error.message)),
            })?;
            self.corrections[index] = Some((influences, correction));
        }
        Ok(())
    }

    /// The correction of a key pose, with the skin weights for as many joints a vertex as it was solved for.
    ///
    /// # Errors
    /// `InvalidArgument` where there is no such pose, `InvalidState` where it is not solved.
    pub fn pose_correction(&self, index: usize) -> Result<&PoseCorrection> {
        let Some(pose) = self.inputs.key_poses.get(index) else {
            return Err(Error::new(
                ErrorKind::InvalidArgument,
                format!("key pose {index}: there are {}; they count from 0", self.inputs.key_poses.len()),
            ));
        };
        match self.corrections.get(index) {
            Some(Some((_, correction))) if self.stage == Stage::Done => Ok(correction),
            _ => Err(Error::new(
                ErrorKind::InvalidState,
                format!("{}: it is not solved; call solve_pose_corrections after the end", pose.title(index)),
            )),
        }
    }

    /// Joints of the target rig, as far as it is set.
    ///
    /// # Errors
    /// `InvalidState` without one.
    pub fn target_rig_size(&self) -> Result<usize> {
        Ok(self.target_rig()?.joints.len())
    }

    /// Refuses to change key poses while a run is under way.
    fn posing(&self) -> Result<()> {
        if self.stage == Stage::Done { Ok(()) } else { self.setting("a key pose") }
    }

    /// The target rig, in its caller's coordinates.
    fn target_rig(&self) -> Result<Arc<Rig>> {
        self.inputs.rigs.target.clone().ok_or_else(|| {
            Error::new(ErrorKind::InvalidState, "the target rig is missing: call set_target_rig before it")
        })
    }

    fn correct(&self, index: usize, weights: &SkinWeights) -> Result<PoseCorrection> {
        let (Some(snapshot), Some(skin)) = (&self.snapshot, &self.inputs.skin) else {
            return Err(Error::new(ErrorKind::Internal, "there is no result with skin weights"));
        };
        let path = PosePath::new(&*self.target_rig()?, self.inputs.key_poses[index].motions.clone())?;
        let body_skin = skin_with_layers(skin, &snapshot.body).into_owned();
        // In single precision, as a host has them. Of the vertices in one place, all have the same.
        let row = |&vertex: &u32| {
            let weights = weights.weights(vertex as usize).iter();
            weights.map(|&(joint, weight)| (joint, f64::from(weight as f32))).collect::<Vec<_>>()
        };
        let rows = snapshot.problem.weld.vertex_of.iter().map(row);
        let garment_skin = SkinWeights::from_rows(weights.joint_count(), rows);
        let added = self.added_joints()?.iter().map(|joint| joint.parent).collect();
        self.beside_the_run(move |solve| PoseSolve { solve, path, body_skin, garment_skin, added }.run())
    }
}
