//! Avatars and garments that several sessions share: what was set of them, and what was computed of them once.
//!
//! What is shared is looked up by all that it is computed from ([`Memo`]), so a session comes to the same bits with it as without,
//! whatever else was set.

use std::sync::Arc;

use super::Session;
use super::pin::Pin;
use crate::control::Cancel;
use crate::error::{Error, ErrorKind, Result};
use crate::geometry::mesh::TriangleMesh;
use crate::input::body::PartRole;
use crate::input::coordinate_system::CoordinateSystem;
use crate::input::curve::Curve;
use crate::input::diagnostic::{Diagnostic, Subject};
use crate::input::morph::Morph;
use crate::input::precision::Precision;
use crate::input::rig::Rig;
use crate::input::skeleton::Skeleton;
use crate::input::skin::SkinWeights;
use crate::input::weld::Weld;
use crate::memo::{Memo, MeshBits};
use crate::sdf::{Field, FieldOptions};
use crate::stage::setup::known_garment::KnownGarment;
use crate::stage::start::joints::{Figure, Flesh};

/// Distance fields that are kept of an avatar. Sessions ask for one, but where the avatar is posed for a garment, or its skeleton
/// mended for it.
const FIELDS: usize = 4;
/// What else is kept, which takes far less.
const OTHERS: usize = 8;

/// A body to dress, for many sessions at once in any threads: mesh, skeleton or rig, weights, parts, layers, morphs and
/// coordinate system. Clones are the same; each session keeps what it uses.
#[derive(Clone)]
pub struct SharedAvatar {
    side: Arc<TargetSide>,
    memo: Arc<AvatarMemo>,
}

/// A garment to fit, likewise: mesh, source skeleton or rig, source avatar, weights, pins, rigid groups, curves, morphs, followers
/// and coordinate system.
#[derive(Clone)]
pub struct SharedGarment {
    side: Arc<SourceSide>,
    memo: Arc<GarmentMemo>,
}

struct TargetSide {
    avatar: Arc<TriangleMesh>,
    roles: Option<Arc<[PartRole]>>,
    layers: Vec<Arc<TriangleMesh>>,
    skeleton: Option<Arc<Skeleton>>,
    skin: Option<Arc<SkinWeights>>,
    rig: Option<Arc<Rig>>,
    morphs: Vec<Arc<Morph>>,
    coordinate_system: CoordinateSystem,
}

struct SourceSide {
    garment: (Arc<TriangleMesh>, Precision),
    skeleton: Option<Arc<Skeleton>>,
    avatar: Option<Arc<TriangleMesh>>,
    rig: Option<Arc<Rig>>,
    garment_skin: Option<Arc<SkinWeights>>,
    source_skin: Option<Arc<SkinWeights>>,
    fit_weights: Option<Arc<[f64]>>,
    pins: Vec<Pin>,
    rigid_groups: Vec<Arc<[u32]>>,
    curves: Vec<Arc<Curve>>,
    morphs: Vec<Arc<Morph>>,
    followers: Vec<(Arc<TriangleMesh>, Precision)>,
    coordinate_system: CoordinateSystem,
}

/// What was computed of an avatar.
struct AvatarMemo {
    /// By what the garment is fitted to, and the bits of the voxel.
    fields: Memo<(MeshBits, u64), Field>,
    flesh: Memo<MeshBits, Flesh>,
}

/// What was computed of a garment and of the body that it was designed on.
struct GarmentMemo {
    /// By the garment, and the bits of the distance at which seams are closed.
    welds: Memo<(MeshBits, u64), (Arc<Weld>, Vec<Diagnostic>)>,
    known: Arc<KnownGarment>,
    flesh: Memo<MeshBits, Flesh>,
}

/// What a session shares with others.
#[derive(Clone, Default)]
pub(super) struct Shared {
    avatar: Option<Arc<AvatarMemo>>,
    garment: Option<Arc<GarmentMemo>>,
    /// Of a garment that is not shared: what its own problems have in common.
    own: Arc<KnownGarment>,
}

impl Session {
    /// The target as it was set so far, to be used by other sessions, and by this one where it is told to.
    ///
    /// # Errors
    /// `InvalidState` without a target avatar.
    pub fn share_avatar(&self) -> Result<SharedAvatar> {
        let inputs = &self.inputs;
        let Some(avatar) = &inputs.avatar else {
            return Err(Error::new(
                ErrorKind::InvalidState,
                "there is no avatar to share: call set_target_avatar before",
            ));
        };
        let side = TargetSide {
            avatar: avatar.clone(),
            roles: inputs.roles.clone(),
            layers: inputs.layers.clone(),
            skeleton: inputs.target_skeleton.clone(),
            skin: inputs.skin.clone(),
            rig: inputs.rigs.target.clone(),
            morphs: inputs.target_morphs.clone(),
            coordinate_system: inputs.target_coordinate_system,
        };
        let memo = AvatarMemo { fields: Memo::new(FIELDS), flesh: Memo::new(OTHERS) };
        Ok(SharedAvatar { side: side.into(), memo: memo.into() })
    }

    /// The garment and all that was set of it so far, to be used by other sessions, and by this one where it is told to.
    ///
    /// # Errors
    /// `InvalidState` without a garment.
    pub fn share_garment(&self) -> Result<SharedGarment> {
        let inputs = &self.inputs;
        let Some(garment) = &inputs.garment else {
            return Err(Error::new(ErrorKind::InvalidState, "there is no garment to share: call set_garment before"));
        };
        let side = SourceSide {
            garment: garment.clone(),
            skeleton: inputs.source_skeleton.clone(),
            avatar: inputs.source_avatar.clone(),
            rig: inputs.rigs.source.clone(),
            garment_skin: inputs.rigs.garment_skin.clone(),
            source_skin: inputs.rigs.source_skin.clone(),
            fit_weights: inputs.fit_weights.clone(),
            pins: inputs.pins.clone(),
            rigid_groups: inputs.rigid_groups.clone(),
            curves: inputs.curves.clone(),
            morphs: inputs.garment_morphs.clone(),
            followers: inputs.followers.clone(),
            coordinate_system: inputs.source_coordinate_system,
        };
        let memo = GarmentMemo { welds: Memo::new(OTHERS), known: Arc::default(), flesh: Memo::new(OTHERS) };
        Ok(SharedGarment { side: side.into(), memo: memo.into() })
    }

    /// Dresses `avatar`, in place of all that was set of a target. What is set afterwards holds for this session alone.
    ///
    /// # Errors
    /// `InvalidState`.
    pub fn use_avatar(&mut self, avatar: &SharedAvatar) -> Result<()> {
        self.setting("a shared avatar")?;
        let (inputs, side) = (&mut self.inputs, &*avatar.side);
        inputs.avatar = Some(side.avatar.clone());
        inputs.roles.clone_from(&side.roles);
        inputs.layers.clone_from(&side.layers);
        inputs.target_skeleton.clone_from(&side.skeleton);
        inputs.skin.clone_from(&side.skin);
        inputs.rigs.target.clone_from(&side.rig);
        inputs.target_morphs.clone_from(&side.morphs);
        inputs.target_coordinate_system = side.coordinate_system;
        inputs.shared.avatar = Some(avatar.memo.clone());
        Ok(())
    }

    /// Fits `garment`, in place of all that was set of a garment and its source. What is set afterwards holds for this session
    /// alone.
    ///
    /// # Errors
    /// `InvalidState`.
    pub fn use_garment(&mut self, garment: &SharedGarment) -> Result<()> {
        self.setting("a shared garment")?;
        let (inputs, side) = (&mut self.inputs, &*garment.side);
        inputs.garment = Some(side.garment.clone());
        inputs.source_skeleton.clone_from(&side.skeleton);
        inputs.source_avatar.clone_from(&side.avatar);
        inputs.rigs.source.clone_from(&side.rig);
        inputs.rigs.garment_skin.clone_from(&side.garment_skin);
        inputs.rigs.source_skin.clone_from(&side.source_skin);
        inputs.fit_weights.clone_from(&side.fit_weights);
        inputs.pins.clone_from(&side.pins);
        inputs.rigid_groups.clone_from(&side.rigid_groups);
        inputs.curves.clone_from(&side.curves);
        inputs.garment_morphs.clone_from(&side.morphs);
        inputs.followers.clone_from(&side.followers);
        inputs.source_coordinate_system = side.coordinate_system;
        inputs.shared.garment = Some(garment.memo.clone());
        Ok(())
    }
}

impl Shared {
    /// Shares nothing of the target any more.
    pub(super) fn forget_avatar(&mut self) {
        self.avatar = None;
    }

    /// Shares nothing of the garment any more.
    pub(super) fn forget_garment(&mut self) {
        self.garment = None;
        self.own = Arc::default();
    }

    /// The distance field of a target.
    ///
    /// # Errors
    /// Those of [`Field::build`].
    pub(super) fn field(&self, mesh: &Arc<TriangleMesh>, options: FieldOptions, cancel: &Cancel) -> Result<Arc<Field>> {
        let build = || Field::build(mesh, options, cancel);
        match &self.avatar {
            Some(memo) => memo.fields.get((MeshBits(mesh.clone()), options.voxel.to_bits()), cancel, build),
            None => build().map(Arc::new),
        }
    }

    /// A garment's weld and what was found as it was made.
    ///
    /// # Errors
    /// `Cancelled`.
    pub(super) fn weld(
        &self,
        garment: &Arc<TriangleMesh>,
        distance: f64,
        cancel: &Cancel,
    ) -> Result<(Arc<Weld>, Vec<Diagnostic>)> {
        let make = || {
            let (weld, found) = Weld::closing_seams(garment, distance);
            (Arc::new(weld), found)
        };
        let Some(memo) = &self.garment else { return Ok(make()) };
        let known = memo.welds.get((MeshBits(garment.clone()), distance.to_bits()), cancel, || Ok(make()))?;
        Ok((*known).clone())
    }

    /// What is known of the garment.
    pub(super) fn garment(&self) -> Arc<KnownGarment> {
        self.garment.as_ref().map_or_else(|| self.own.clone(), |memo| memo.known.clone())
    }

    /// A skeleton with its body.
    ///
    /// # Errors
    /// `Cancelled`.
    pub(super) fn figure(
        &self,
        subject: Subject,
        skeleton: &Skeleton,
        body: Option<&TriangleMesh>,
        cancel: &Cancel,
    ) -> Result<Option<Figure>> {
        let known = match subject {
            Subject::TargetSkeleton => self.avatar.as_ref().map(|memo| &memo.flesh),
            _ => self.garment.as_ref().map(|memo| &memo.flesh),
        };
        Figure::with_flesh(subject, skeleton, body, |mesh| {
            let mesh = Arc::new(mesh);
            match known {
                Some(known) => known.get(MeshBits(mesh.clone()), cancel, || Ok(Flesh::new(mesh))),
                None => Ok(Arc::new(Flesh::new(mesh))),
            }
        })
        .transpose()
    }
}
