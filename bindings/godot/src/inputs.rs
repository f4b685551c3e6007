//! What a script has set, and how the scene is read from it.

use godot::builtin::{Array, PackedVector3Array, VarDictionary, Variant};
use godot::classes::{Node3D, Resource};
use godot::meta::ToGodot;
use godot::obj::Gd;

use crate::engine::is;
use crate::figure::{Figure, Part, Taken};
use crate::findings::Scene;
use crate::job::{Design, Wanted};
use crate::native::*;
use crate::options::Options;
use crate::painted;
use crate::scene::{Skeleton, meshes, skeleton_of};
use crate::session::{Failure, Influences, Mapped, Result, Session};

/// A mesh that was set, with the skeleton that it was set with.
#[derive(Default)]
pub struct Input {
    /// A MeshInstance3D, a mesh, or an array of them; nil for none.
    pub mesh: Variant,
    /// Its Skeleton3D, where one was given.
    pub skeleton: Variant,
    /// The bone map of that skeleton.
    pub bone_map: Option<Gd<Resource>>,
}

impl Input {
    /// As set by a script.
    pub fn new(mesh: Variant, skeleton: Option<Gd<Node3D>>) -> Self {
        let mut input = Self::default();
        input.set(mesh, skeleton);
        input
    }

    /// Replaces the mesh; the bone map stays.
    pub fn set(&mut self, mesh: Variant, skeleton: Option<Gd<Node3D>>) {
        self.mesh = mesh;
        self.skeleton = skeleton.map_or(Variant::nil(), |node| node.to_variant());
    }

    /// The Skeleton3D that was given, or that of the first mesh that has one.
    fn skeleton(&self, what: &str) -> Result<Option<Gd<Node3D>>> {
        if !self.skeleton.is_nil() {
            let node = self.skeleton.try_to::<Gd<Node3D>>().ok().filter(Gd::is_instance_valid);
            return match node.filter(|node| is(node, "Skeleton3D")) {
                Some(node) => Ok(Some(node)),
                None => Err(Failure::skeleton(format!(
                    "{what}: its skeleton is no Skeleton3D, or it was freed; set it again"
                ))),
            };
        }
        let shown = meshes(&self.mesh, what)?;
        Ok(shown.iter().filter_map(|one| skeleton_of(&one.node?.get()?)).next())
    }

    fn need_skeleton(&self, what: &str) -> Result<Skeleton> {
        let node = self.skeleton(what)?.ok_or_else(|| {
            Failure::skeleton(format!("{what}: no Skeleton3D moves its mesh; say which one its bones are in"))
        })?;
        Skeleton::read(&node, self.bone_map.as_ref(), what)
    }
}

/// Pins of the garment.
#[derive(Default)]
pub struct Pins {
    /// Vertices, or the channel that they are painted in; nil for none.
    pub vertices: Variant,
    /// Where they are held; empty: where they are on the nearest bone.
    pub targets: PackedVector3Array,
}

/// All that a script sets.
pub struct Inputs {
    /// The garment.
    pub garment: Input,
    /// The body that it was made for.
    pub source_body: Input,
    /// The body to dress.
    pub avatar: Input,
    /// Meshes of the body to dress, and what each is to the garment.
    pub roles: Vec<(Variant, i64)>,
    /// What it wears already.
    pub layers: Vec<Input>,
    /// What goes along with the garment.
    pub followers: Vec<Input>,
    /// Names of bones that correspond.
    pub pairs: VarDictionary,
    /// Fit weights of the garment's vertices, or the channel that they are painted in; nil for none.
    pub fit_weights: Variant,
    /// Vertices that are held.
    pub pins: Pins,
    /// Vertices that stay rigid bodies, or the channels that they are painted in.
    pub rigid_groups: Vec<Variant>,
    /// Blend shapes of the avatar that the garment is to answer.
    pub answers: Vec<String>,
    /// Options of the library.
    pub options: Options,
    /// Joints for each vertex of the result.
    pub influences: i64,
}

impl Default for Inputs {
    fn default() -> Self {
        Self {
            garment: Input::default(),
            source_body: Input::default(),
            avatar: Input::default(),
            roles: Vec::new(),
            layers: Vec::new(),
            followers: Vec::new(),
            pairs: VarDictionary::new(),
            fit_weights: Variant::nil(),
            pins: Pins::default(),
            rigid_groups: Vec::new(),
            answers: Vec::new(),
            options: Options::default(),
            influences: 4,
        }
    }
}

impl Inputs {
    /// The skeleton that the garment was made around: its own, or that of the body that it was made for.
    fn source_skeleton(&self) -> Result<Skeleton> {
        let (garment, body) = (&self.garment, &self.source_body);
        let own = match garment.skeleton("garment")? {
            None if !body.mesh.is_nil() => body.skeleton("source body")?,
            own => own,
        };
        let node = own.ok_or_else(|| {
            Failure::skeleton(
                "garment: no Skeleton3D moves its mesh; say which one it was made around, or set the body that it was made for",
            )
        })?;
        Skeleton::read(&node, garment.bone_map.as_ref(), "garment")
    }

    /// Reads all that is set out of the scene.
    ///
    /// # Errors
    /// Something that is missing, was freed, or cannot be used.
    pub fn read_scene(&self) -> Result<Scene> {
        let source = self.source_skeleton()?;
        let garment = meshes(&self.garment.mesh, "garment")?;
        if garment.len() != 1 {
            return Err(Failure::argument(format!(
                "garment: there are {} meshes; dress them one after the other, each with those before it as layers",
                garment.len()
            )));
        }
        let mut garment = Figure::read(garment, &source, &self.garment.skeleton, &Taken::Basis)?;
        // What it is to answer takes the place of what it has under that name.
        garment.shapes.retain(|shape| !self.answers.contains(&shape.name));
        let now = Taken::AsItIs(&[]);
        let source_body = match self.source_body.mesh.is_nil() {
            true => None,
            false => {
                let shown = meshes(&self.source_body.mesh, "source body")?;
                Some(Figure::read(shown, &source, &self.source_body.skeleton, &now)?)
            }
        };
        let target = self.avatar.need_skeleton("avatar")?;
        let shown = meshes(&self.avatar.mesh, "avatar")?;
        let avatar = Figure::read(shown, &target, &self.avatar.skeleton, &Taken::AsItIs(&self.answers))?;
        let layer = |layer: &Input| Figure::read(meshes(&layer.mesh, "layer")?, &target, &layer.skeleton, &now);
        let layers = self.layers.iter().map(layer).collect::<Result<_>>()?;
        let mut followers = Vec::new();
        for follower in &self.followers {
            for shown in meshes(&follower.mesh, "follower")? {
                followers.push(Figure::read(vec![shown], &source, &follower.skeleton, &Taken::Basis)?);
            }
        }
        Ok(Scene { source, target, garment, source_body, avatar, layers, followers })
    }

    /// A session with all that is in the scene.
    ///
    /// # Errors
    /// What the library refuses.
    pub fn fill(&self, scene: &Scene) -> Result<Session> {
        let session = Session::new()?;
        let (source, target) = (scene.source.joints.len(), scene.target.joints.len());
        let influences = |which, skin: &Option<Influences>, joints| match skin {
            Some(skin) => session.set_influences(which, skin, joints),
            None => Ok(()),
        };
        session.set_options(&self.options.to_native())?;
        session.set_godot_space()?;
        session.set_garment(&scene.garment.positions, &scene.garment.triangles)?;
        influences(bespoke_session_set_garment_skin_influences, &scene.garment.skin, source)?;
        for shape in &scene.garment.shapes {
            session.add_garment_morph(&shape.name, &shape.offsets)?;
        }
        session.set_source_rig(&scene.source.joints)?;
        if let Some(body) = &scene.source_body {
            session.set_source_avatar(&body.positions, &body.triangles)?;
            influences(bespoke_session_set_source_skin_influences, &body.skin, source)?;
        }
        session.set_target_rig(&scene.target.joints)?;
        session.set_target_avatar(&scene.avatar.positions, &scene.avatar.triangles)?;
        influences(bespoke_session_set_target_skin_influences, &scene.avatar.skin, target)?;
        if let Some(roles) = self.roles(&scene.avatar)? {
            session.set_avatar_parts(&roles)?;
        }
        for shape in &scene.avatar.answered {
            session.add_target_morph(&shape.name, &shape.offsets)?;
        }
        for layer in &scene.layers {
            session.add_layer(&layer.positions, &layer.triangles)?;
        }
        for follower in &scene.followers {
            session.add_follower(&follower.positions, &follower.triangles)?;
        }
        session.set_joint_pairs(&self.pairs(&scene.source, &scene.target)?)?;
        self.set_vertices(&session, &scene.garment)?;
        Ok(session)
    }

    /// What each triangle of the avatar is to the garment; none where nothing was said.
    fn roles(&self, avatar: &Figure) -> Result<Option<Vec<u32>>> {
        let mut roles = vec![BESPOKE_PART_ROLE_AUTOMATIC; avatar.triangles.len()];
        for (mesh, role) in &self.roles {
            let role = u32::try_from(*role).unwrap_or(u32::MAX);
            for shown in meshes(mesh, "avatar role")? {
                let is_it = |part: &&Part| match shown.node {
                    Some(node) => part.shown.node == Some(node),
                    None => part.shown.mesh == shown.mesh,
                };
                let part = avatar.parts.iter().find(is_it).ok_or_else(|| {
                    Failure::argument(format!("{}: it is no mesh of the avatar; set it with the others", shown.name))
                })?;
                roles[part.first_triangle..][..part.arrays.triangles.len()].fill(role);
            }
        }
        Ok((!self.roles.is_empty()).then_some(roles))
    }

    /// What is said of single vertices.
    fn set_vertices(&self, session: &Session, garment: &Figure) -> Result<()> {
        let Some(part) = garment.parts.first() else { return Ok(()) };
        if let Some(weights) = painted::numbers(&self.fit_weights, &part.arrays, "fit weights")? {
            session.set_vertex_fit_weights(&weights)?;
        }
        let pins = painted::vertices(&self.pins.vertices, &part.arrays, "pins")?;
        let targets: Vec<[f32; 3]> = self.pins.targets.as_slice().iter().map(|p| [p.x, p.y, p.z]).collect();
        if !targets.is_empty() && targets.len() != pins.len() {
            return Err(Failure::argument(format!(
                "pins: there are {} targets for {} vertices; give one for each, or none",
                targets.len(),
                pins.len()
            )));
        }
        if !pins.is_empty() {
            session.set_pins(&pins, (!targets.is_empty()).then_some(&targets))?;
        }
        for group in &self.rigid_groups {
            for piece in painted::groups(group, &part.arrays, "rigid group")? {
                session.add_rigid_group(&piece)?;
            }
        }
        Ok(())
    }

    /// What is to be read of the result.
    pub fn wanted(&self, scene: &Scene) -> Wanted {
        let has_skin = scene.avatar.skin.is_some();
        Wanted {
            garment: Design::new(&scene.garment),
            followers: scene.followers.iter().map(Design::new).collect(),
            answers: scene.avatar.answered.iter().map(|shape| shape.name.clone()).collect(),
            influences: if has_skin { self.influences as usize } else { 0 },
            joints: scene.target.joints.len(),
        }
    }

    fn pairs(&self, source: &Skeleton, target: &Skeleton) -> Result<Vec<[u32; 2]>> {
        let find = |skeleton: &Skeleton, name: &Variant, whose: &str| {
            let unknown = || {
                Failure::argument(format!("joint pairs: '{name}' is no bone of {whose}'s skeleton '{}'", skeleton.name))
            };
            skeleton.find(&name.to_string()).map(|bone| bone as u32).ok_or_else(unknown)
        };
        let pair = |(from, to): (Variant, Variant)| {
            let from = find(source, &from, "the garment")?;
            let is_none = to.is_nil() || to.to_string().is_empty();
            Ok([from, if is_none { BESPOKE_NO_JOINT } else { find(target, &to, "the avatar")? }])
        };
        self.pairs.iter_shared().map(pair).collect()
    }

    /// Which bones correspond, as scripts read it.
    ///
    /// # Errors
    /// As for `read_scene`.
    pub fn read_joint_map(&self) -> Result<Array<VarDictionary>> {
        let (source, target) = (self.source_skeleton()?, self.avatar.need_skeleton("avatar")?);
        let session = Session::new()?;
        session.set_source_rig(&source.joints)?;
        session.set_target_rig(&target.joints)?;
        session.set_joint_pairs(&self.pairs(&source, &target)?)?;
        let map = session.joint_map()?;
        let row = |(name, mapped): (&String, &Mapped)| {
            let mut row = VarDictionary::new();
            let found = mapped.target.and_then(|bone| target.names.get(bone as usize));
            row.set("source", name.as_str());
            row.set("target", found.map_or("", String::as_str));
            row.set("reason", i64::from(mapped.reason));
            row.set("confidence", mapped.confidence);
            row.set("part", mapped.part.as_str());
            row
        };
        Ok(source.names.iter().zip(&map).map(row).collect())
    }
}
