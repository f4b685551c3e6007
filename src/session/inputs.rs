//! What a caller has set. Shared, so that a run keeps what it needs.

use std::sync::Arc;
use std::time::Instant;

use glam::DVec3;

use super::body_parts::BodyParts;
use super::pin::Pin;
use super::rig_inputs::{Rigs, Skeletons};
use super::shared::Shared;
use super::way::Way;
use super::{Session, Stage};
use crate::control::Cancel;
use crate::error::{Error, ErrorKind, Result};
use crate::geometry::mesh::TriangleMesh;
use crate::input::body::{Body, PartRole};
use crate::input::coordinate_system::{AxisTurn, CoordinateSystem};
use crate::input::curve::Curve;
use crate::input::diagnostic::{Diagnostic, Subject};
use crate::input::key_pose::KeyPose;
use crate::input::morph::Morph;
use crate::input::placement;
use crate::input::placement::scene::Scene;
use crate::input::precision::Precision;
use crate::input::skeleton::Skeleton;
use crate::input::skin::SkinWeights;
use crate::input::weld::Weld;
use crate::memory::{Sizes, bytes};
use crate::options::Options;
use crate::stage::setup::problem::{Inputs as ProblemInputs, Problem};
use crate::stage::start::joints::{self, Misplaced};

/// Everything that can be set, in the caller's own coordinate systems.
#[derive(Clone, Default)]
pub(super) struct Inputs {
    pub(super) garment: Option<(Arc<TriangleMesh>, Precision)>,
    pub(super) source_skeleton: Option<Arc<Skeleton>>,
    pub(super) avatar: Option<Arc<TriangleMesh>>,
    /// One for each triangle of the avatar; none where nothing is said.
    pub(super) roles: Option<Arc<[PartRole]>>,
    /// Likewise, where the caller will try without them, too.
    pub(super) dispensable: Option<Arc<[bool]>>,
    pub(super) layers: Vec<Arc<TriangleMesh>>,
    pub(super) target_skeleton: Option<Arc<Skeleton>>,
    pub(super) source_avatar: Option<Arc<TriangleMesh>>,
    pub(super) skin: Option<Arc<SkinWeights>>,
    pub(super) rigs: Rigs,
    pub(super) fit_weights: Option<Arc<[f64]>>,
    pub(super) pins: Vec<Pin>,
    pub(super) rigid_groups: Vec<Arc<[u32]>>,
    pub(super) curves: Vec<Arc<Curve>>,
    pub(super) garment_morphs: Vec<Arc<Morph>>,
    pub(super) target_morphs: Vec<Arc<Morph>>,
    pub(super) key_poses: Vec<Arc<KeyPose>>,
    /// How much of each the avatar is to have in a refit; none where nothing was said.
    pub(super) morph_weights: Vec<f64>,
    pub(super) followers: Vec<(Arc<TriangleMesh>, Precision)>,
    /// Garments that are worn together, as they were modelled; only their order is asked for.
    pub(super) outfit: Vec<Arc<TriangleMesh>>,
    pub(super) source_coordinate_system: CoordinateSystem,
    pub(super) target_coordinate_system: CoordinateSystem,
    pub(super) options: Options,
    pub(super) shared: Shared,
}

/// What does not depend on how the target stands, in the internal coordinate system.
pub(super) struct Design {
    garment: TriangleMesh,
    weld: Arc<Weld>,
    skeleton: Skeleton,
    source_avatar: Option<TriangleMesh>,
    skin: Option<Arc<SkinWeights>>,
    ends: [Option<Arc<SkinWeights>>; 2],
    feet: Option<[DVec3; 2]>,
}

/// The target in a pose, in its caller's coordinates.
pub(super) struct Stand {
    avatar: Arc<TriangleMesh>,
    layers: Vec<Arc<TriangleMesh>>,
    target: Arc<Skeleton>,
    /// The turn after which it faces as the source does, where that is known.
    pub(super) turn: Option<AxisTurn>,
}

/// A problem with the body as its caller would have it, and the coordinate system in which the target was read: the caller's,
/// turned where it faces another way.
pub(super) struct Setting {
    pub(super) problem: Problem,
    pub(super) body: Body,
    pub(super) system: CoordinateSystem,
    pub(super) turn: AxisTurn,
}

/// What is to be solved.
pub(super) struct Posed {
    /// The problem to begin with.
    pub(super) first: Setting,
    /// Where that is one in the source's pose: the problem in the target's own pose, and the way there.
    pub(super) own: Option<(Setting, Way)>,
    /// Where it is one in the target's own pose, although that is not the source's: what that could be exchanged for.
    pub(super) other: Option<(Design, Way)>,
    /// Seconds in which rigs were read and matched and the target was posed.
    pub(super) rig_seconds: f64,
    /// Seconds in which the second problem was set up.
    pub(super) own_seconds: f64,
}

impl Session {
    /// Refuses to set `name` after `prepare`.
    pub(super) fn setting(&self, name: &str) -> Result<()> {
        if self.stage == Stage::Setup {
            return Ok(());
        }
        Err(Error::new(
            ErrorKind::InvalidState,
            format!("{name} cannot be set after prepare; call reset first, which keeps the inputs"),
        ))
    }

    /// The same for what [`Self::refit`] takes into account, and a result may be there.
    pub(super) fn adjusting(&self, name: &str) -> Result<()> {
        if self.may_adjust() { Ok(()) } else { self.setting(name) }
    }

    /// Whether there is a result to go on from.
    pub(super) fn may_adjust(&self) -> bool {
        self.has_ended && matches!(self.stage, Stage::Done | Stage::Fit)
    }

    /// The garment, in the source coordinate system, around the source skeleton.
    ///
    /// # Errors
    /// `InvalidMesh`, `InvalidState`.
    pub fn set_garment(&mut self, mesh: TriangleMesh, precision: Precision) -> Result<()> {
        self.setting("the garment")?;
        mesh.check("garment")?;
        self.inputs.garment = Some((Arc::new(mesh), precision));
        self.inputs.shared.forget_garment();
        Ok(())
    }

    /// Vertices of the garment, once it is set.
    pub fn garment_vertex_count(&self) -> Option<usize> {
        self.inputs.garment.as_ref().map(|g| g.0.positions.len())
    }

    /// The skeleton that the garment was designed on, in the source coordinate system.
    ///
    /// # Errors
    /// `InvalidSkeleton`, `InvalidState`.
    pub fn set_source_skeleton(&mut self, skeleton: Skeleton) -> Result<()> {
        self.setting("the source skeleton")?;
        skeleton.check("source skeleton")?;
        self.inputs.source_skeleton = Some(Arc::new(skeleton));
        self.inputs.rigs.source = None;
        Ok(())
    }

    /// The body to dress, in the target coordinate system. It may be open, non-manifold, in pieces and pass through itself.
    ///
    /// # Errors
    /// `InvalidMesh`, `InvalidState`.
    pub fn set_target_avatar(&mut self, mesh: TriangleMesh) -> Result<()> {
        self.setting("the target avatar")?;
        mesh.check("target avatar")?;
        self.inputs.avatar = Some(Arc::new(mesh));
        self.inputs.shared.forget_avatar();
        Ok(())
    }

    /// The role of each triangle of the avatar. Optional: [`PartRole::Automatic`] for all.
    ///
    /// # Errors
    /// `InvalidState`. The number is compared with that of the avatar's triangles by `prepare`.
    pub fn set_avatar_parts(&mut self, roles: Vec<PartRole>) -> Result<()> {
        self.setting("the avatar's parts")?;
        self.inputs.roles = Some(roles.into());
        Ok(())
    }

    /// The triangles of the avatar without which the caller will try as well, such as a head. Where one of them holds the garment
    /// against a part that it touches at full size, the run is over at once: nothing else is tried, which rarely helps there.
    ///
    /// # Errors
    /// `InvalidState`.
    pub fn set_dispensable(&mut self, triangles: Vec<bool>) -> Result<()> {
        self.setting("the avatar's dispensable triangles")?;
        self.inputs.dispensable = (!triangles.is_empty()).then(|| triangles.into());
        Ok(())
    }

    /// Takes the roles of the avatar's triangles back.
    ///
    /// # Errors
    /// `InvalidState`.
    pub fn clear_avatar_parts(&mut self) -> Result<()> {
        self.setting("the avatar's parts")?;
        self.inputs.roles = None;
        Ok(())
    }

    /// Adds a garment that the avatar wears already, in the target coordinate system, such as the result of another session:
    /// it is treated as a part of the avatar, exactly as it is given. Layers are numbered from 0 in the order in which they
    /// are added, and stay with another avatar and after `reset`.
    ///
    /// # Errors
    /// `InvalidMesh`, `InvalidState`.
    pub fn add_layer(&mut self, mesh: TriangleMesh) -> Result<()> {
        self.setting("a layer")?;
        mesh.check(&format!("layer {}", self.layer_count()))?;
        self.inputs.layers.push(Arc::new(mesh));
        Ok(())
    }

    /// Removes all layers.
    ///
    /// # Errors
    /// `InvalidState`.
    pub fn clear_layers(&mut self) -> Result<()> {
        self.setting("the layers")?;
        self.inputs.layers.clear();
        Ok(())
    }

    /// Layers that the avatar wears.
    pub fn layer_count(&self) -> usize {
        self.inputs.layers.len()
    }

    /// The skeleton of the body to dress, in the target coordinate system: the same joints and bones as the source skeleton, the bones
    /// in any order and direction.
    ///
    /// # Errors
    /// `InvalidSkeleton`, `InvalidState`.
    pub fn set_target_skeleton(&mut self, skeleton: Skeleton) -> Result<()> {
        self.setting("the target skeleton")?;
        skeleton.check("target skeleton")?;
        self.inputs.target_skeleton = Some(Arc::new(skeleton));
        self.inputs.rigs.target = None;
        Ok(())
    }

    /// The body that the garment was designed on, in the source coordinate system. Optional: with it, each point of the garment aims
    /// at the clearance that it had there (see [`Options::designed_clearance`]); without it, at none.
    ///
    /// # Errors
    /// `InvalidMesh`, `InvalidState`.
    pub fn set_source_avatar(&mut self, mesh: TriangleMesh) -> Result<()> {
        self.setting("the source avatar")?;
        mesh.check("source avatar")?;
        self.inputs.source_avatar = Some(Arc::new(mesh));
        Ok(())
    }

    /// Skin weights of the target avatar. Optional: without them the nearest bone decides.
    ///
    /// # Errors
    /// `InvalidState`. The size is compared with the avatar's by `prepare`.
    pub fn set_target_skin(&mut self, skin: SkinWeights) -> Result<()> {
        self.setting("the skin weights")?;
        self.inputs.skin = Some(Arc::new(skin));
        Ok(())
    }

    /// How much each garment vertex should fit: 0 not at all, 1 as the others. Optional: 1 everywhere.
    ///
    /// # Errors
    /// `InvalidWeights` for a negative weight or one that is not finite, `InvalidState`.
    pub fn set_vertex_fit_weights(&mut self, weights: Vec<f64>) -> Result<()> {
        self.adjusting("the fit weights")?;
        if let Some((v, w)) = weights.iter().enumerate().find(|(_, w)| !(w.is_finite() && **w >= 0.0)) {
            return Err(Error::new(
                ErrorKind::InvalidWeights,
                format!("fit weights: vertex {v} has weight {w}; it must be finite and not negative"),
            ));
        }
        self.inputs.fit_weights = Some(weights.into());
        Ok(())
    }

    /// Axes, unit and winding of garment, source skeleton and source avatar.
    ///
    /// # Errors
    /// `InvalidArgument`, `InvalidState`.
    pub fn set_source_coordinate_system(&mut self, space: CoordinateSystem) -> Result<()> {
        self.setting("the source coordinate system")?;
        space.check("source coordinate system")?;
        self.inputs.source_coordinate_system = space;
        Ok(())
    }

    /// Axes, unit and winding of target avatar and target skeleton, and of the result.
    ///
    /// # Errors
    /// `InvalidArgument`, `InvalidState`.
    pub fn set_target_coordinate_system(&mut self, space: CoordinateSystem) -> Result<()> {
        self.setting("the target coordinate system")?;
        space.check("target coordinate system")?;
        self.inputs.target_coordinate_system = space;
        Ok(())
    }

    /// Weights, distances and limits.
    ///
    /// # Errors
    /// `InvalidArgument`, `InvalidState`.
    pub fn set_options(&mut self, options: Options) -> Result<()> {
        self.setting("the options")?;
        options.check()?;
        self.inputs.options = options;
        Ok(())
    }
}

impl Design {
    /// Bytes that it holds beside the inputs.
    pub(super) fn memory(&self) -> u64 {
        let meshes = [Some(&self.garment), self.source_avatar.as_ref(), Some(&self.weld.mesh)];
        meshes.into_iter().flatten().map(|mesh| bytes(&mesh.positions) + bytes(&mesh.triangles)).sum()
    }
}

impl Inputs {
    /// Bytes that they hold.
    pub(super) fn memory(&self) -> u64 {
        let mesh = |mesh: &Arc<TriangleMesh>| bytes(&mesh.positions) + bytes(&mesh.triangles);
        let meshes = [self.garment.as_ref().map(|g| &g.0), self.avatar.as_ref(), self.source_avatar.as_ref()];
        let worn = self.layers.iter().map(mesh).sum::<u64>();
        // With layers, the body is a mesh of its own.
        let body = if worn == 0 { 0 } else { worn + self.avatar.as_ref().map_or(0, mesh) };
        let weights = self.fit_weights.as_ref().map_or(0, |w| size_of_val(&w[..]) as u64);
        let skin = self.skin.as_ref().map_or(0, |skin| skin.memory());
        let groups: u64 = self.rigid_groups.iter().map(|group| size_of_val(&group[..]) as u64).sum();
        let curves: u64 = self.curves.iter().map(|curve| bytes(&curve.vertices)).sum();
        let controls = weights + bytes(&self.pins) + groups + curves;
        let further: u64 =
            self.garment_morphs.iter().chain(&self.target_morphs).map(|morph| morph.memory()).sum::<u64>()
                + self.followers.iter().map(|follower| mesh(&follower.0)).sum::<u64>()
                + self.outfit.iter().map(mesh).sum::<u64>()
                + self.key_poses.iter().map(|pose| bytes(&pose.motions)).sum::<u64>();
        meshes.into_iter().flatten().map(mesh).sum::<u64>()
            + worn
            + body
            + controls
            + skin
            + further
            + self.rigs.memory()
    }

    /// The sizes that are known from the inputs.
    pub(super) fn sizes(&self) -> Sizes {
        let vertices = |mesh: &Arc<TriangleMesh>| mesh.positions.len();
        let triangles = |mesh: &Arc<TriangleMesh>| mesh.triangles.len();
        Sizes {
            garment_vertices: self.garment.as_ref().map_or(0, |g| vertices(&g.0)),
            avatar_triangles: self.avatar.iter().chain(&self.layers).map(triangles).sum(),
            field: 0,
        }
    }

    /// Checks the inputs against each other and poses the problem, or two: one in the source's pose where the target stands
    /// in a very different one, and then that in the target's own. Adds to `diagnostics`.
    ///
    /// # Errors
    /// `InvalidState` where an input is missing, those of [`placement::check`] and of [`Problem::new`].
    pub(super) fn pose_problem(&self, cancel: &Cancel, diagnostics: &mut Vec<Diagnostic>) -> Result<Posed> {
        let Some((garment, _)) = &self.garment else { return missing("the garment", "set_garment") };
        if self.source_skeleton.is_none() && self.rigs.source.is_none() {
            return missing("the source skeleton", "set_source_skeleton or set_source_rig");
        }
        let Some(avatar) = &self.avatar else { return missing("the target avatar", "set_target_avatar") };
        let clock = Instant::now();
        let Skeletons { source, target, skin, ends, feet, way } = self.skeletons(diagnostics)?;
        let mut rig_seconds = clock.elapsed().as_secs_f64();
        self.check_wishes()?;
        self.check_garment_morphs(garment.positions.len())?;
        self.check_target_morphs(avatar.positions.len())?;
        let (weld, found) = self.shared.weld(garment, self.options.weld_distance, cancel)?;
        diagnostics.extend(found);
        cancel.check()?;
        let design = Design {
            garment: mesh_to_internal(&self.source_coordinate_system, &weld.mesh),
            weld,
            skeleton: skeleton_to_internal(&self.source_coordinate_system, &source),
            source_avatar: self.worn_by(&source, diagnostics)?,
            skin,
            ends,
            feet,
        };
        let mut stand = Stand { avatar: avatar.clone(), layers: self.layers.clone(), target, turn: None };
        let Some(way) = way.as_ref().filter(|way| way.is_large) else {
            let only = self.solve_in(&design, &stand, cancel, diagnostics)?;
            let other = way.map(|way| (design, way));
            return Ok(Posed { first: only, own: None, other, rig_seconds, own_seconds: 0.0 });
        };
        let clock = Instant::now();
        let posed = self.stand_on(way, 1.0, avatar);
        rig_seconds += clock.elapsed().as_secs_f64();
        let first = self.solve_in(&design, &posed, cancel, diagnostics)?;
        let clock = Instant::now();
        stand.turn = Some(first.turn);
        // All that there is to say of the inputs has been said.
        let own = self.solve_in(&design, &stand, cancel, &mut Vec::new())?;
        if own.problem.triangles != first.problem.triangles {
            // What closes its openings differs: there is no way from one to the other.
            return Ok(Posed { first: own, own: None, other: None, rig_seconds, own_seconds: 0.0 });
        }
        let own_seconds = clock.elapsed().as_secs_f64();
        Ok(Posed { first, own: Some((own, way.clone())), other: None, rig_seconds, own_seconds })
    }

    /// The body on its way.
    pub(super) fn stand_on(&self, way: &Way, share: f64, avatar: &TriangleMesh) -> Stand {
        let points = way.points(share);
        let mut rest = &points[..];
        let mut take = |mesh: &TriangleMesh| {
            let (own, others) = rest.split_at(mesh.positions.len());
            rest = others;
            Arc::new(TriangleMesh { positions: own.to_vec(), triangles: mesh.triangles.clone() })
        };
        Stand {
            avatar: take(avatar),
            layers: self.layers.iter().map(|layer| take(layer)).collect(),
            target: Arc::new(way.skeleton(share)),
            turn: None,
        }
    }

    /// The problem of the target as it stands.
    pub(super) fn solve_in(
        &self,
        design: &Design,
        stand: &Stand,
        cancel: &Cancel,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Result<Setting> {
        let Design { garment, weld, skeleton, source_avatar, skin, ends, feet } = design;
        let (avatar, target) = (&stand.avatar, &*stand.target);
        let precision = self.garment.as_ref().map_or(Precision::F32, |garment| garment.1);
        let told = self.target_coordinate_system;
        let parts = BodyParts::find(Subject::TargetAvatar, avatar, target, self.roles.as_deref())?;
        let turn = match stand.turn {
            Some(turn) => turn,
            None => placement::check(
                &Scene {
                    garment,
                    source_skeleton: skeleton,
                    source_avatar: source_avatar.as_ref(),
                    avatar: &mesh_to_internal(&told, &parts.compared()),
                    target_skeleton: &skeleton_to_internal(&told, target),
                    feet: *feet,
                    skin: skin.as_deref(),
                    source_coordinate_system: self.source_coordinate_system,
                    target_coordinate_system: told,
                },
                self.options.strict,
                diagnostics,
            )?,
        };
        cancel.check()?;
        let target_system = told.turned(turn);
        let pins = self.welded_pins(weld, &target_system)?;
        let rigid_groups = self.welded_groups(weld)?;
        let curves = self.welded_curves(weld)?;
        let roles = parts.resolved_roles(self.options.strict, diagnostics);
        let body = Body::with_roles(avatar, &stand.layers, &roles)?;
        let posed_body = body.with_mesh(mesh_to_internal(&target_system, &body.mesh));
        let mut target = skeleton_to_internal(&target_system, target);
        let mut source = skeleton.clone();
        let bodies = [Some(&posed_body.avatar()), source_avatar.as_ref()];
        let misplaced = self.misplaced_joints([&target, &source], bodies, garment, cancel)?;
        cancel.check()?;
        let mends = !self.options.strict;
        diagnostics.extend(misplaced.iter().map(|joint| match joint.skeleton {
            Subject::SourceSkeleton => joint.diagnostic(&self.source_coordinate_system, mends),
            _ => joint.diagnostic(&target_system, mends),
        }));
        if mends {
            joints::mend(&mut target, Subject::TargetSkeleton, &misplaced);
            joints::mend(&mut source, Subject::SourceSkeleton, &misplaced);
        }
        let problem = Problem::new(
            &ProblemInputs {
                garment,
                source_skeleton: &source,
                avatar: &posed_body,
                target_skeleton: &target,
                skin: skin.as_deref(),
                ends: ends.each_ref().map(Option::as_deref),
                source_avatar: source_avatar.as_ref(),
                fit_weights: self.fit_weights.as_ref().map(|weights| weld.gather(weights)).as_deref(),
                pins: &pins,
                rigid_groups: &rigid_groups,
                curves: &curves,
                offset: target_system.metres_per_unit * self.options.offset,
                weld: weld.clone(),
                coordinate_error: target_system.metres_per_unit * precision.error_near(&body.mesh),
                turns: !self.options.strict && !told.trusted,
                known: self.shared.garment(),
            },
            &self.options,
            cancel,
            diagnostics,
        )?;
        Ok(Setting { problem, body, system: target_system, turn })
    }

    /// The body that the garment was designed on, in the internal coordinate system, without what is no part of it.
    fn worn_by(&self, skeleton: &Skeleton, diagnostics: &mut Vec<Diagnostic>) -> Result<Option<TriangleMesh>> {
        let Some(mesh) = &self.source_avatar else { return Ok(None) };
        let parts = BodyParts::find(Subject::SourceAvatar, mesh, skeleton, None)?;
        let body = parts.sure_body_or_all(self.options.strict, diagnostics);
        Ok(Some(mesh_to_internal(&self.source_coordinate_system, &body)))
    }

    /// The joints of the target and of the source skeleton that do not lie where the bodies want them.
    fn misplaced_joints(
        &self,
        [target, source]: [&Skeleton; 2],
        [avatar, worn_by]: [Option<&TriangleMesh>; 2],
        garment: &TriangleMesh,
        cancel: &Cancel,
    ) -> Result<Vec<Misplaced>> {
        let target = self.shared.figure(Subject::TargetSkeleton, target, avatar, cancel)?;
        let source = self.shared.figure(Subject::SourceSkeleton, source, worn_by, cancel)?;
        Ok(target.zip(source).map_or_else(Vec::new, |(target, source)| joints::find(target, source, garment)))
    }
}

pub(super) fn mesh_to_internal(system: &CoordinateSystem, mesh: &TriangleMesh) -> TriangleMesh {
    TriangleMesh {
        positions: mesh.positions.iter().map(|&p| system.position_to_internal(p)).collect(),
        triangles: mesh.triangles.iter().map(|&t| system.triangle(t)).collect(),
    }
}

fn skeleton_to_internal(system: &CoordinateSystem, skeleton: &Skeleton) -> Skeleton {
    Skeleton {
        joints: skeleton.joints.iter().map(|&p| system.position_to_internal(p)).collect(),
        bones: skeleton.bones.clone(),
    }
}

pub(super) fn missing<T>(name: &str, call: &str) -> Result<T> {
    Err(Error::new(ErrorKind::InvalidState, format!("{name} is missing: call {call} before prepare")))
}

/// Refuses the weights `name` where they are not for the joints of `rig` and the vertices of their mesh.
pub(super) fn check_skin(skin: &SkinWeights, joints: usize, vertices: usize, name: &str, rig: &str) -> Result<()> {
    if (skin.joint_count(), skin.vertex_count()) == (joints, vertices) {
        return Ok(());
    }
    Err(Error::new(
        ErrorKind::InvalidWeights,
        format!(
            "{name}: they are for {} joints and {} vertices, the {rig} has {joints} joints and the mesh {vertices} vertices",
            skin.joint_count(),
            skin.vertex_count(),
        ),
    ))
}
