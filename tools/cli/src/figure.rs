//! A character or an outfit as it is in its file: the rig, and the parts that hang on it, all in the bind pose.

use std::path::{Path, PathBuf};

use bespoke::input::coordinate_system::CoordinateSystem;
use bespoke::input::rig::{Rig, RigJoint};
use bespoke::input::skeleton::Skeleton;
use bespoke::input::skin::SkinWeights;
use bespoke::rig::reading::Reading;
use bespoke_gltf::{Document, Instance, Primitive, Scene};
use glam::{DMat4, DVec3};

use crate::failure::{Failure, Result};
use crate::obj::{self, Beside, Joints};
use crate::output;
use crate::parts::pattern::Patterns;
use crate::parts::{Kind, Named, Role, Sorted, sort};

/// One material of one mesh at one node.
#[derive(Clone, Debug)]
pub struct Part {
    /// Index of the node.
    pub node: usize,
    /// Name of the node.
    pub node_name: String,
    /// Index of the mesh.
    pub mesh: usize,
    /// Which of the figure's meshes it belongs to.
    pub instance: usize,
    /// The primitive of its mesh.
    pub primitive: Primitive,
    /// Name of the material; empty where it has none.
    pub material: String,
    /// Names of the mesh's morph targets.
    pub morphs: Vec<String>,
    /// The joint that it hangs on without skin weights.
    pub hangs_on: Option<u32>,
    /// For each vertex of this part, its index in the mesh.
    pub vertices: Vec<u32>,
    /// Where they are in the bind pose, in the file's space.
    pub positions: Vec<DVec3>,
    /// Triangles of them.
    pub triangles: Vec<[u32; 3]>,
    /// Joints of the rig with weights, for each vertex; empty lists where it is on no rig.
    pub influences: Vec<Vec<(u32, f64)>>,
    /// What it is.
    pub sorted: Sorted,
    /// Whether it is a garment that is to be dressed.
    pub chosen: bool,
}

impl Part {
    /// As the user chooses it: node and material.
    pub fn name(&self) -> String {
        if self.material.is_empty() { self.node_name.clone() } else { format!("{}:{}", self.node_name, self.material) }
    }
}

/// What the user says of the parts.
#[derive(Clone, Debug, Default)]
pub struct Choice {
    /// The garments.
    pub garments: Option<Patterns>,
    /// The body.
    pub body: Option<Patterns>,
}

/// A file, read.
pub struct Figure {
    /// The file.
    pub file: PathBuf,
    /// As it is.
    pub document: Document,
    /// What it shows.
    pub scene: Scene,
    /// The joints in the bind pose; without any where the file has no skin. Where the file says which bone a joint is, that is
    /// its name here.
    pub rig: Rig,
    /// The node of each joint.
    pub joint_nodes: Vec<usize>,
    /// All parts of the character with most vertices, and all that is on no rig.
    pub parts: Vec<Part>,
    /// What was passed over, in words.
    pub notes: Vec<String>,
    /// Where it was an OBJ file, and not glTF.
    pub obj: Option<obj::Source>,
}

impl Figure {
    /// Reads a file.
    ///
    /// # Errors
    /// With the file, and where in it.
    pub fn open(file: &Path, role: Role, choice: &Choice) -> Result<Self> {
        Self::open_with(file, role, choice, &Beside::default())
    }

    /// The same, where an OBJ file has others beside it.
    ///
    /// # Errors
    /// As [`Self::open`], and where the file is none that has others beside it.
    pub fn open_with(file: &Path, role: Role, choice: &Choice, beside: &Beside) -> Result<Self> {
        if obj::is_obj(file) {
            let (document, source, joints) = obj::open(file, role, beside)?;
            let mut figure = Self::of_document(file, document)?;
            figure.take_joints(source, joints);
            figure.sort_parts(role, choice)?;
            return Ok(figure);
        }
        if *beside != Beside::default() {
            return Err(Failure::usage(format!(
                "{}: skeleton, skin weights and axes are given beside OBJ files alone; this one has its own",
                file.display()
            )));
        }
        let document = Document::open(file).map_err(|e| Failure::no_result(e.to_string()))?;
        let mut figure = Self::of_document(file, document)?;
        figure.sort_parts(role, choice)?;
        Ok(figure)
    }

    /// What it shows, not yet sorted.
    fn of_document(file: &Path, document: Document) -> Result<Self> {
        let fail = |e: bespoke_gltf::Error| Failure::no_result(e.to_string());
        let named = |e: bespoke_gltf::Error| fail(e.in_file(file.display().to_string()));
        let scene = document.scene().map_err(named)?;
        let materials = document.materials().map_err(named)?;
        let mut notes: Vec<String> = scene.notes.iter().map(|note| format!("{}: {note}", file.display())).collect();
        let character = scene.characters.first();
        if scene.characters.len() > 1 {
            notes.push(format!(
                "{}: there are {} characters; the one with most vertices is taken",
                file.display(),
                scene.characters.len()
            ));
        }
        let joints = character.map(|c| c.joints.as_slice()).unwrap_or_default();
        let rig = Rig {
            joints: joints
                .iter()
                .map(|joint| RigJoint {
                    name: joint.bone.clone().unwrap_or_else(|| joint.name.clone()),
                    parent: joint.parent.map(|parent| parent as u32),
                    bind: DMat4::from_cols_array_2d(&joint.bind),
                })
                .collect(),
        };
        let joint_nodes = joints.iter().map(|joint| joint.node).collect();
        let mut parts = Vec::new();
        let instances = character.map(|c| c.meshes.as_slice()).unwrap_or_default().iter().chain(&scene.loose);
        for (index, instance) in instances.enumerate() {
            for primitive in &instance.geometry.primitives {
                parts.push(part(index, instance, primitive, &materials));
            }
        }
        parts.retain(|part| !part.triangles.is_empty());
        Ok(Self { file: file.to_path_buf(), document, scene, rig, joint_nodes, parts, notes, obj: None })
    }

    /// The joints of an OBJ file as they were given, in their order; where there are no skin weights, the parts have none.
    fn take_joints(&mut self, source: obj::Source, joints: Option<Joints>) {
        let number: Vec<u32> = self.joint_nodes.iter().map(|&node| node as u32).collect();
        for row in self.parts.iter_mut().flat_map(|part| &mut part.influences) {
            if !source.has_skin {
                row.clear();
            }
            row.iter_mut().for_each(|(joint, _)| *joint = number[*joint as usize]);
            row.sort_by_key(|&(joint, _)| joint);
        }
        if let Some(joints) = joints {
            self.rig = joints.rig();
            self.joint_nodes = (0..self.rig.joints.len()).collect();
        }
        self.notes.extend(source.notes.iter().cloned());
        self.obj = Some(source);
    }

    /// Whether the vertices of its parts have weights on its joints.
    pub fn has_skin(&self) -> bool {
        !self.rig.joints.is_empty() && self.obj.as_ref().is_none_or(|source| source.has_skin)
    }

    /// What its joints are, by their names and else by their places and what they move.
    pub fn reading(&self) -> Reading {
        let worn = self.parts.iter().filter(|part| part.sorted.kind != Kind::Prop);
        let rows = worn.flat_map(|part| &part.influences).cloned();
        let skin = self.has_skin().then(|| SkinWeights::from_rows(self.rig.joints.len(), rows));
        Reading::new(&self.rig, skin.as_ref())
    }

    /// Its joints where they have no names.
    pub fn skeleton(&self) -> Option<&Skeleton> {
        self.obj.as_ref()?.skeleton.as_ref()
    }

    /// In which coordinate system it stands here: that of glTF. Of a glTF file this is known to be so: meshes and joints are bound to
    /// each other.
    pub fn space(&self) -> CoordinateSystem {
        let trusted = self.obj.as_ref().is_none_or(|source| source.space.trusted);
        CoordinateSystem { trusted, ..CoordinateSystem::default() }
    }

    /// The meshes, numbered as `instance` of a part.
    pub fn instance(&self, index: usize) -> &Instance {
        let on_rig = self.scene.characters.first().map(|c| c.meshes.as_slice()).unwrap_or_default();
        on_rig.get(index).unwrap_or_else(|| &self.scene.loose[index - on_rig.len()])
    }

    /// All meshes, in that order.
    pub fn instances(&self) -> impl Iterator<Item = &Instance> {
        self.scene.characters.first().map(|c| c.meshes.as_slice()).unwrap_or_default().iter().chain(&self.scene.loose)
    }

    /// The parts of one kind.
    pub fn of(&self, kind: Kind) -> impl Iterator<Item = &Part> {
        self.parts.iter().filter(move |part| part.sorted.kind == kind)
    }

    /// # Errors
    /// Where the file has no skin; `then` says what follows from it.
    pub fn need_rig(&self, then: &str) -> Result<()> {
        if self.rig.joints.is_empty() {
            return Err(Failure::no_result(format!("{}: there is no skin in it: {then}", self.file.display())));
        }
        Ok(())
    }

    /// The form of the file in words.
    pub fn format(&self) -> String {
        if self.obj.is_some() {
            return "OBJ".into();
        }
        let form = match self.document.form() {
            bespoke_gltf::Form::Glb => "GLB",
            bespoke_gltf::Form::Gltf => "glTF",
        };
        match self.scene.humanoid.as_ref().map(|map| map.version) {
            Some(bespoke_gltf::Vrm::Zero) => format!("VRM 0 ({form})"),
            Some(bespoke_gltf::Vrm::One) => format!("VRM 1 ({form})"),
            None => form.to_string(),
        }
    }

    /// Whether this program has written a part: its garments have a skin of their own.
    fn is_put_on(&self, part: &Part) -> bool {
        let skin = self.instance(part.instance).skin.map(|skin| self.scene.skins[skin].name.as_str());
        skin == Some(output::SKIN) || self.obj.as_ref().is_some_and(|source| source.worn.contains(&part.node_name))
    }

    fn sort_parts(&mut self, role: Role, choice: &Choice) -> Result<()> {
        let names: Vec<(&str, &str)> =
            self.parts.iter().map(|part| (part.node_name.as_str(), part.material.as_str())).collect();
        for patterns in [&choice.garments, &choice.body].into_iter().flatten() {
            if let Some(idle) = patterns.idle(&names).first() {
                return Err(Failure::usage(format!(
                    "{}: '{idle}' is the name of no part; there are {}",
                    self.file.display(),
                    self.parts.iter().map(Part::name).collect::<Vec<_>>().join(", ")
                )));
            }
        }
        let named: Vec<Named> = self
            .parts
            .iter()
            .map(|part| Named {
                node: &part.node_name,
                material: &part.material,
                hangs_on: part.hangs_on.map(|joint| self.rig.joints[joint as usize].name.as_str()),
                is_put_on: self.is_put_on(part),
            })
            .collect();
        let mut sorted = sort(&named, role);
        // An OBJ file that is one thing is what it is given as.
        if let (true, [only]) = (self.obj.is_some(), &mut sorted[..]) {
            let kind = if role == Role::Outfit { Kind::Garment } else { Kind::Body };
            *only = Sorted { kind, reason: "it is all that is in the file".into(), by_material: false };
        }
        for (part, mut sorted) in self.parts.iter_mut().zip(sorted) {
            let is_in = |patterns: &Patterns| patterns.choose(&part.node_name, &part.material);
            match choice.body.as_ref().map(is_in) {
                Some(true) => sorted = Sorted { kind: Kind::Body, reason: "as given".into(), by_material: false },
                Some(false) if sorted.kind == Kind::Body => {
                    sorted = Sorted { kind: Kind::Prop, reason: "not among the given body".into(), by_material: false };
                }
                _ => {}
            }
            // Skin and hair of a node are no garment, unless just they are meant.
            let is_bare = matches!(sorted.kind, Kind::Body | Kind::Hair) && sorted.by_material;
            let is_meant = |patterns: &Patterns| {
                is_in(patterns) && (!is_bare || patterns.choose_by_material(&part.node_name, &part.material))
            };
            match choice.garments.as_ref().map(is_meant) {
                Some(true) => {
                    sorted = Sorted { kind: Kind::Garment, reason: "as given".into(), by_material: false };
                    part.chosen = true;
                }
                Some(false) => {}
                None => part.chosen = sorted.kind == Kind::Garment,
            }
            part.sorted = sorted;
        }
        Ok(())
    }
}

/// The part of `instance` that is one primitive, with the vertices that it uses.
fn part(index: usize, instance: &Instance, primitive: &Primitive, materials: &[String]) -> Part {
    let geometry = &instance.geometry;
    let mut new = vec![u32::MAX; geometry.positions.len()];
    let mut vertices = Vec::new();
    let triangles = geometry.triangles[primitive.triangles.clone()].iter().map(|triangle| {
        triangle.map(|v| {
            let own = &mut new[v as usize];
            if *own == u32::MAX {
                *own = vertices.len() as u32;
                vertices.push(v);
            }
            *own
        })
    });
    let triangles = triangles.collect();
    let influences = |&v: &u32| geometry.influences.get(v as usize).cloned().unwrap_or_default();
    let of_rig =
        instance.skin.is_none().then(|| geometry.influences.first()?.first().map(|&(joint, _)| joint)).flatten();
    Part {
        node: instance.node,
        node_name: instance.name.clone(),
        mesh: instance.mesh,
        instance: index,
        primitive: primitive.clone(),
        material: primitive.material.map(|material| materials[material].clone()).unwrap_or_default(),
        morphs: geometry.morphs.iter().map(|morph| morph.name.clone()).collect(),
        hangs_on: of_rig,
        positions: vertices.iter().map(|&v| DVec3::from_array(geometry.positions[v as usize])).collect(),
        influences: vertices.iter().map(influences).collect(),
        triangles,
        vertices,
        sorted: Sorted { kind: Kind::Body, reason: String::new(), by_material: false },
        chosen: false,
    }
}
