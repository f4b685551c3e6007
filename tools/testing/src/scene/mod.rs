//! Random small retargets, each determined by its recipe alone: skeletons, a body, a garment, spaces, precision and options.
//!
//! A scene without flaws is *sound*: the garment is clean, lies around bones of the source skeleton and leaves room for the
//! limbs beside them, so that a result must come out. Flaws make it anything that a caller may hand in.

mod body;
mod flaws;
mod garment;
mod setting;
mod skeleton;

use std::sync::Arc;

use bespoke::control::Cancel;
use bespoke::error::Result;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::coordinate_system::CoordinateSystem;
use bespoke::input::skeleton::Skeleton;
use bespoke::input::skin::SkinWeights;
use bespoke::input::weld::Weld;
use bespoke::options::Options;
use bespoke::session::{Precision, Session};
use bespoke::stage::setup::problem::{Inputs, Problem};
use glam::DVec3;

pub use flaws::Flaw;

use crate::Random;

/// What a scene is made from. Each part draws from its own stream of the seed, so that a flaw less leaves the rest as it
/// was.
#[derive(Clone, Debug, PartialEq)]
pub struct Recipe {
    /// Of all that is random.
    pub seed: u64,
    /// What is wrong with the scene.
    pub flaws: Vec<Flaw>,
}

impl Recipe {
    /// Without flaws.
    pub fn sound(seed: u64) -> Self {
        Self { seed, flaws: Vec::new() }
    }

    /// Sound for two seeds of three, one to three flaws for the third.
    pub fn mixed(seed: u64) -> Self {
        if !seed.is_multiple_of(3) {
            return Self::sound(seed);
        }
        let mut random = stream(seed, 0);
        let count = 1 + below(&mut random, 3);
        let mut flaws: Vec<Flaw> = (0..count).map(|_| Flaw::ALL[below(&mut random, Flaw::ALL.len())]).collect();
        flaws.sort_unstable();
        flaws.dedup();
        Self { seed, flaws }
    }

    fn has(&self, flaw: Flaw) -> bool {
        self.flaws.contains(&flaw)
    }
}

/// The generator of one part of a scene.
fn stream(seed: u64, part: u64) -> Random {
    let mut z = seed.wrapping_add(part.wrapping_mul(0x9E37_79B9_7F4A_7C15));
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    Random::new(z ^ (z >> 31))
}

fn below(random: &mut Random, count: usize) -> usize {
    (random.unit() * count as f64) as usize
}

fn between(random: &mut Random, low: f64, high: f64) -> f64 {
    low + (high - low) * random.unit()
}

fn chance(random: &mut Random, probability: f64) -> bool {
    random.unit() < probability
}

fn direction(random: &mut Random) -> DVec3 {
    loop {
        let v = random.vector();
        if (0.01..1.0).contains(&v.length_squared()) {
            return v.normalize();
        }
    }
}

/// A retarget as a caller hands it in: every mesh and skeleton in its own space, rounded to the caller's precision.
#[derive(Clone, Debug)]
pub struct Scene {
    /// In the source's coordinate system.
    pub garment: TriangleMesh,
    /// In which the garment is given and read.
    pub precision: Precision,
    /// In the source's coordinate system.
    pub source_skeleton: Skeleton,
    /// In the target's coordinate system.
    pub avatar: TriangleMesh,
    /// In the target's coordinate system.
    pub target_skeleton: Skeleton,
    /// The body that the garment was designed on, for some.
    pub source_avatar: Option<TriangleMesh>,
    /// Weights of the avatar's vertices, for some.
    pub skin: Option<SkinWeights>,
    /// One a vertex of the garment, for some.
    pub fit_weights: Option<Vec<f64>>,
    /// Of garment, source skeleton and source avatar.
    pub source_coordinate_system: CoordinateSystem,
    /// Of avatar and target skeleton.
    pub target_coordinate_system: CoordinateSystem,
    /// What the caller asks for.
    pub options: Options,
}

impl Scene {
    /// The scene of a recipe.
    pub fn new(recipe: &Recipe) -> Self {
        let seed = recipe.seed;
        let (source, target) = skeleton::pair(&mut stream(seed, 1), recipe.has(Flaw::OtherPose));
        let bodies = body::Bodies::new(&mut stream(seed, 2), &source, &target, recipe.has(Flaw::ThickBody));
        let mut garment = garment::around(&mut stream(seed, 3), &source, &bodies);
        let mut avatar = bodies.on_target.clone();
        for &flaw in &recipe.flaws {
            flaw.spoil(&mut stream(seed, 100 + flaw as u64), &mut garment, &mut avatar);
        }
        let mut scene = Self {
            precision: Precision::F64,
            fit_weights: None,
            source_avatar: None,
            skin: None,
            source_coordinate_system: CoordinateSystem::default(),
            target_coordinate_system: CoordinateSystem::default(),
            options: Options::default(),
            garment,
            source_skeleton: source,
            avatar,
            target_skeleton: target,
        };
        setting::choose(&mut stream(seed, 4), &mut scene, &bodies, recipe);
        scene
    }

    /// A session with all the inputs set.
    pub fn session(&self) -> Result<Session> {
        let mut session = Session::new();
        session.set_options(self.options.clone())?;
        session.set_source_coordinate_system(self.source_coordinate_system)?;
        session.set_target_coordinate_system(self.target_coordinate_system)?;
        session.set_garment(self.garment.clone(), self.precision)?;
        session.set_source_skeleton(self.source_skeleton.clone())?;
        session.set_target_avatar(self.avatar.clone())?;
        session.set_target_skeleton(self.target_skeleton.clone())?;
        if let Some(mesh) = &self.source_avatar {
            session.set_source_avatar(mesh.clone())?;
        }
        if let Some(skin) = &self.skin {
            session.set_target_skin(skin.clone())?;
        }
        if let Some(weights) = &self.fit_weights {
            session.set_vertex_fit_weights(weights.clone())?;
        }
        Ok(session)
    }

    /// The problem that a session with these inputs poses.
    pub fn problem(&self) -> Result<Problem> {
        let mesh = |space: &CoordinateSystem, mesh: &TriangleMesh| TriangleMesh {
            positions: mesh.positions.iter().map(|&p| space.position_to_internal(p)).collect(),
            triangles: mesh.triangles.iter().map(|&t| space.triangle(t)).collect(),
        };
        let skeleton = |space: &CoordinateSystem, skeleton: &Skeleton| Skeleton {
            joints: skeleton.joints.iter().map(|&p| space.position_to_internal(p)).collect(),
            bones: skeleton.bones.clone(),
        };
        let (weld, _) = Weld::new(&self.garment);
        Problem::new(
            &Inputs {
                garment: &mesh(&self.source_coordinate_system, &weld.mesh),
                weld: Arc::new(weld.clone()),
                source_skeleton: &skeleton(&self.source_coordinate_system, &self.source_skeleton),
                avatar: &mesh(&self.target_coordinate_system, &self.avatar).into(),
                target_skeleton: &skeleton(
                    &self.target_coordinate_system,
                    &self.target_skeleton.aligned_to(&self.source_skeleton)?,
                ),
                skin: self.skin.as_ref(),
                ends: [None, None],
                source_avatar: self
                    .source_avatar
                    .as_ref()
                    .map(|body| mesh(&self.source_coordinate_system, body))
                    .as_ref(),
                fit_weights: self.fit_weights.as_ref().map(|weights| weld.gather(weights)).as_deref(),
                pins: &[],
                rigid_groups: &[],
                curves: &[],
                offset: 0.0,
                coordinate_error: 0.0,
                turns: true,
                known: Arc::default(),
            },
            &self.options,
            &Cancel::new(),
            &mut Vec::new(),
        )
    }
}
