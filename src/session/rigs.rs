//! Rigs in place of skeletons: what a caller says of them, and the skeletons that follow.

use std::sync::Arc;

use glam::{DMat4, DVec3};

use super::Session;
use super::inputs::{Inputs, check_skin, mesh_to_internal, missing};
use super::rig_inputs::Skeletons;
use super::way::Way;
use crate::control::Stage;
use crate::error::{Error, ErrorKind, Result};
use crate::geometry::mesh::TriangleMesh;
use crate::input::body::Body;
use crate::input::coordinate_system::CoordinateSystem;
use crate::input::diagnostic::Diagnostic;
use crate::input::rig::Rig;
use crate::input::skeleton::Skeleton;
use crate::input::skin::SkinWeights;
use crate::rig::clothed::clothed;
use crate::rig::common_skeleton::CommonSkeleton;
use crate::rig::joint_map::{CallersPair, JointMap};
use crate::rig::places::Character;
use crate::rig::posing::{LIMBS, Posing};
use crate::rig::reading::Reading;
use crate::rig::worn::Worn;
use crate::stage::setup::layer_skin::skin_with_layers;

impl Session {
    /// The rig of the body on which the garment was designed, in the source coordinate system, in the pose in which garment and
    /// source avatar are given. Takes the place of a source skeleton.
    ///
    /// # Errors
    /// `InvalidSkeleton`, `InvalidState`.
    pub fn set_source_rig(&mut self, rig: Rig) -> Result<()> {
        self.setting("the source rig")?;
        rig.check("source rig")?;
        self.inputs.rigs.source = Some(Arc::new(rig));
        self.inputs.source_skeleton = None;
        Ok(())
    }

    /// The rig of the body to dress, in the target coordinate system, in the pose in which the avatar is given. Takes the place of a
    /// target skeleton; the avatar's skin weights are then on its joints.
    ///
    /// # Errors
    /// `InvalidSkeleton`, `InvalidState`.
    pub fn set_target_rig(&mut self, rig: Rig) -> Result<()> {
        self.setting("the target rig")?;
        rig.check("target rig")?;
        self.inputs.rigs.target = Some(Arc::new(rig));
        self.inputs.target_skeleton = None;
        Ok(())
    }

    /// Skin weights of the garment on the joints of the source rig. Optional.
    ///
    /// # Errors
    /// `InvalidState`. The size is compared with rig and garment by `prepare`.
    pub fn set_garment_skin(&mut self, skin: SkinWeights) -> Result<()> {
        self.setting("the garment's skin weights")?;
        self.inputs.rigs.garment_skin = Some(Arc::new(skin));
        Ok(())
    }

    /// Skin weights of the source avatar on the joints of the source rig. Optional: they tell where the top of its head is, and
    /// which of its joints move nothing.
    ///
    /// # Errors
    /// `InvalidState`. The size is compared with rig and source avatar by `prepare`.
    pub fn set_source_skin(&mut self, skin: SkinWeights) -> Result<()> {
        self.setting("the source avatar's skin weights")?;
        self.inputs.rigs.source_skin = Some(Arc::new(skin));
        Ok(())
    }

    /// Joints of the source rig and those of the target rig that correspond to them, or none: they win over names and
    /// structure. Replaces earlier pairs.
    ///
    /// # Errors
    /// `InvalidState`. The joints are compared with the rigs' by `prepare` and by [`Self::joint_map`].
    pub fn set_joint_pairs(&mut self, pairs: Vec<CallersPair>) -> Result<()> {
        self.setting("the joint pairs")?;
        self.inputs.rigs.pairs = pairs.into();
        Ok(())
    }

    /// Joints of the target rig.
    ///
    /// # Errors
    /// `InvalidState` before the end, or without a target rig.
    pub fn target_joint_count(&self) -> Result<usize> {
        match (&self.inputs.rigs.target, self.stage()) {
            (Some(rig), Stage::Done) => Ok(rig.joints.len()),
            (None, _) => Err(Error::new(
                ErrorKind::InvalidState,
                "the target rig is missing: call set_target_rig before prepare",
            )),
            _ => Err(Error::new(ErrorKind::InvalidState, "there is no result yet; run the session to its end first")),
        }
    }

    /// Which joint of the target rig corresponds to each joint of the source rig, by what has been set so far.
    ///
    /// # Errors
    /// `InvalidState` where a side has neither rig nor skeleton, `InvalidWeights` where skin weights do not suit their rig,
    /// `InvalidArgument` where a caller's pair does not.
    pub fn joint_map(&self) -> Result<JointMap> {
        self.inputs.joint_map_of(&self.inputs.posed_rigs()?)
    }
}

/// A rig with its body in the internal coordinate system.
pub(super) struct PosedRig {
    pub(super) rig: Rig,
    body: Option<TriangleMesh>,
    pub(super) skin: Option<Arc<SkinWeights>>,
}

impl PosedRig {
    fn read(&self) -> Reading {
        Reading::new(&self.rig, self.skin.as_deref())
    }

    fn character(&self) -> Character<'_> {
        Character { rig: &self.rig, body: self.body.as_ref(), skin: self.skin.as_deref() }
    }
}

impl Inputs {
    /// The skeletons as they were set, or those that two rigs have in common. A skeleton beside a rig is read as a rig
    /// without names. Adds to `diagnostics`.
    ///
    /// # Errors
    /// `InvalidState` where one is missing, `InvalidWeights`, `InvalidSkeleton`, `InvalidArgument`.
    pub(super) fn skeletons(&self, diagnostics: &mut Vec<Diagnostic>) -> Result<Skeletons> {
        if self.rigs.source.is_none() && self.rigs.target.is_none() {
            let Some(source) = &self.source_skeleton else {
                return missing("the source skeleton", "set_source_skeleton or set_source_rig");
            };
            let Some(target) = &self.target_skeleton else {
                return missing("the target skeleton", "set_target_skeleton or set_target_rig");
            };
            let target = Arc::new(target.aligned_to(source)?);
            if let (Some(skin), Some(avatar)) = (&self.skin, &self.avatar) {
                check_skin(skin, target.joints.len(), avatar.positions.len(), "skin weights", "target skeleton")?;
            }
            return Ok(Skeletons {
                source: source.clone(),
                target,
                skin: self.skin.clone(),
                ends: [None, None],
                feet: None,
                way: None,
            });
        }
        let rigs = self.posed_rigs()?;
        let map = self.joint_map_of(&rigs)?;
        let [source, target] = rigs;
        let common = self.common_skeleton(&source, &target, &map)?;
        diagnostics.extend(common.unsure(&map));
        let skin = target.skin.as_deref().map(|skin| Arc::new(common.skin(skin)));
        let ends = |side: usize, skin: &Option<Arc<SkinWeights>>| {
            skin.as_deref().map(|skin| Arc::new(common.ends(side, skin)))
        };
        let ends = [ends(1, &target.skin), ends(0, &source.skin)];
        let from_internal = |system: &CoordinateSystem, skeleton: &Skeleton| {
            let joints: Vec<DVec3> = skeleton.joints.iter().map(|&p| system.position_from_internal(p)).collect();
            Arc::new(Skeleton { joints, bones: skeleton.bones.clone() })
        };
        Ok(Skeletons {
            source: from_internal(&self.source_coordinate_system, &common.source),
            target: from_internal(&self.target_coordinate_system, &common.target),
            skin,
            ends,
            feet: common.feet(),
            way: self.way(&target, &map.readings[1], &Arc::new(common))?,
        })
    }

    /// What the joints of the common skeleton of two rigs are called; none where skeletons were set.
    pub(super) fn joint_names(&self) -> Option<Vec<String>> {
        if self.rigs.source.is_none() && self.rigs.target.is_none() {
            return None;
        }
        let rigs = self.posed_rigs().ok()?;
        let map = self.joint_map_of(&rigs).ok()?;
        let [source, target] = rigs;
        Some(self.common_skeleton(&source, &target, &map).ok()?.names(&source.rig))
    }

    /// The skeleton that the rigs have in common for the garment.
    fn common_skeleton(&self, source: &PosedRig, target: &PosedRig, map: &JointMap) -> Result<CommonSkeleton> {
        let mesh = self.internal_garment();
        let garment = mesh.as_ref().map(|mesh| Worn { mesh, skin: self.garment_skin() });
        CommonSkeleton::new(source.character(), target.character(), map, garment)
    }

    /// The garment in the internal coordinate system.
    fn internal_garment(&self) -> Option<TriangleMesh> {
        self.garment.as_ref().map(|garment| mesh_to_internal(&self.source_coordinate_system, &garment.0))
    }

    /// The way of the target from the source's pose, where that is another one.
    fn way(&self, target: &PosedRig, reading: &Reading, common: &Arc<CommonSkeleton>) -> Result<Option<Way>> {
        let (Some(avatar), Some(skin)) = (&self.avatar, &target.skin) else { return Ok(None) };
        let order = target.rig.parents_first("target rig")?;
        let [others, own] = &common.landmarks;
        let Some(posing) = Posing::new(target.character(), reading, &order, own, others) else { return Ok(None) };
        let body = Body::new(avatar, &self.layers)?;
        let system = self.target_coordinate_system;
        let clothed = || self.internal_garment().map_or([true; LIMBS.len()], |garment| clothed(&garment, others));
        Ok(Some(Way {
            is_large: posing.is_large(clothed),
            posing: Arc::new(posing),
            common: common.clone(),
            system,
            skin: Arc::new(skin_with_layers(skin, &body).into_owned()),
            points: body.mesh.positions.iter().map(|&p| system.position_to_internal(p)).collect(),
        }))
    }

    /// The skin weights of the garment on the source rig, where the caller has set them.
    pub(super) fn garment_skin(&self) -> Option<&SkinWeights> {
        self.rigs.garment_skin.as_deref().filter(|_| self.rigs.source.is_some())
    }

    /// The map between these two.
    pub(super) fn joint_map_of(&self, [source, target]: &[PosedRig; 2]) -> Result<JointMap> {
        JointMap::new(&source.rig, &target.rig, [source.read(), target.read()], &self.rigs.pairs)
    }

    /// Both rigs with what is known of their bodies.
    pub(super) fn posed_rigs(&self) -> Result<[PosedRig; 2]> {
        let rigs = &self.rigs;
        let source = posed(
            [rigs.source.as_deref(), self.source_skeleton.as_deref().map(Rig::of_skeleton).as_ref()],
            &self.source_coordinate_system,
            ("source", "set_source_rig"),
        )?;
        let target = posed(
            [rigs.target.as_deref(), self.target_skeleton.as_deref().map(Rig::of_skeleton).as_ref()],
            &self.target_coordinate_system,
            ("target", "set_target_rig"),
        )?;
        let (joints, target_joints) = (source.joints.len(), target.joints.len());
        let garment = self.garment.as_ref().map(|garment| &garment.0);
        for (skin, mesh, count, name, rig) in [
            (&rigs.garment_skin, garment, joints, "garment skin weights", "source rig"),
            (&rigs.source_skin, self.source_avatar.as_ref(), joints, "source skin weights", "source rig"),
            (&self.skin, self.avatar.as_ref(), target_joints, "target skin weights", "target rig"),
        ] {
            if let (Some(skin), Some(mesh)) = (skin, mesh) {
                check_skin(skin, count, mesh.positions.len(), name, rig)?;
            }
        }
        let body = |mesh: &Option<Arc<TriangleMesh>>, system| mesh.as_ref().map(|mesh| mesh_to_internal(system, mesh));
        Ok([
            PosedRig {
                rig: source,
                body: body(&self.source_avatar, &self.source_coordinate_system),
                skin: rigs.source_skin.clone().filter(|_| self.source_avatar.is_some()),
            },
            PosedRig {
                rig: target,
                body: body(&self.avatar, &self.target_coordinate_system),
                skin: self.skin.clone().filter(|_| self.avatar.is_some()),
            },
        ])
    }
}

/// The rig that was set, in the internal coordinate system.
fn posed(given: [Option<&Rig>; 2], system: &CoordinateSystem, (side, call): (&str, &str)) -> Result<Rig> {
    let Some(rig) = given.into_iter().flatten().next() else {
        return Err(Error::new(
            ErrorKind::InvalidState,
            format!("the {side} rig is missing: call {call} before prepare and before the joint map is read"),
        ));
    };
    Ok(rig.mapped(DMat4::from(system.affine_to_internal())))
}
