//! One pair: an avatar dressed in a garment, and what was measured.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

use bespoke::error::{Error, ErrorKind, Result};
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::skeleton::Skeleton;
use bespoke::input::skin::SkinWeights;
use bespoke::options::Options;
use bespoke::session::{Precision, Session};
use glam::DVec3;
use serde::Serialize;

use crate::regularity::{asymmetry, opening_growth};
use closet::mesh::Mesh;
use closet::skeleton::BONES;
use closet::{Sample, skeleton};

/// What became of a pair. Lengths are in the normalised space, in which a skeleton is 2 long.
#[derive(Clone, Debug, Serialize)]
pub struct Outcome {
    /// The name of the garment.
    pub garment: &'static str,
    /// The name of the avatar.
    pub avatar: &'static str,
    /// Why there is no result: a sentence.
    pub error: Option<String>,
    /// Pairs of triangles that intersect, by the exact verifier: garment and garment, garment and avatar.
    pub intersections: Option<[u64; 2]>,
    /// Wall seconds, with everything that a session does.
    pub seconds: f64,
    /// Newton iterations of the inflation and of the fit.
    pub iterations: [u32; 2],
    /// How far the avatar was inflated; 1 is all of it.
    pub t: f64,
    /// Whether the fit ended by its tolerance, and not by the limit of iterations or where no step made it better.
    pub converged: bool,
    /// Smallest distance of the garment to itself and to the avatar; none where it is beyond d-hat.
    pub distances: [Option<f64>; 2],
    /// Mean and maximum over the garment's triangles; no unit, 0 for any similarity of the design. None without a result.
    pub distortion: Option<[f64; 2]>,
    /// How far garment and avatar are from their mirror images, in millimetres; none without a result.
    pub asymmetry: Option<[f64; 2]>,
    /// How much the openings grew against the cloth beside them, the least and the most of them; none without a result.
    pub opening_growth: Option<[f64; 2]>,
    /// Vertices of garment and avatar.
    pub vertices: [usize; 2],
    /// The garment on the avatar, in the avatar's space; empty without a result.
    #[serde(skip)]
    pub positions: Vec<[f32; 3]>,
    /// The distortion of each triangle; empty without a result.
    #[serde(skip)]
    pub distortions: Vec<f32>,
}

impl Outcome {
    /// Whether there is a result, without an intersection.
    pub fn is_verified(&self) -> bool {
        self.error.is_none() && self.intersections == Some([0, 0])
    }
}

/// Dresses `body` in `garment`; `names` are theirs, garment first. With `mannequin`, the fit aims at the clearance that
/// the garment has there.
pub fn dress(
    names: [&'static str; 2],
    garment: &Sample,
    body: &Sample,
    mannequin: Option<&Sample>,
    options: &Options,
) -> Outcome {
    let mut outcome = Outcome {
        garment: names[0],
        avatar: names[1],
        error: None,
        intersections: None,
        seconds: 0.0,
        iterations: [0; 2],
        t: 0.0,
        converged: false,
        distances: [None; 2],
        vertices: [&garment.mesh, &body.mesh].map(|mesh| mesh.positions.len()),
        distortion: None,
        asymmetry: None,
        opening_growth: None,
        positions: Vec::new(),
        distortions: Vec::new(),
    };
    let clock = Instant::now();
    let ran = catch_unwind(AssertUnwindSafe(|| run(garment, body, mannequin, options, &mut outcome)))
        .unwrap_or_else(|_| Err(Error::new(ErrorKind::Internal, "it panicked, which is a defect of the library")));
    outcome.seconds = clock.elapsed().as_secs_f64();
    match ran {
        Ok(positions) => measure(&mut outcome, garment, body, positions),
        Err(error) => outcome.error = Some(error.message),
    }
    outcome
}

/// Fills in what the session measures, as far as it comes; where it leaves the garment's vertices.
fn run(
    garment: &Sample,
    body: &Sample,
    mannequin: Option<&Sample>,
    options: &Options,
    outcome: &mut Outcome,
) -> Result<Vec<DVec3>> {
    let mut session = session(garment, body, mannequin, options)?;
    let ended = session.run();
    let report = session.report();
    outcome.intersections = report.verification.map(|v| [v.garment_garment, v.garment_avatar]);
    outcome.iterations = [report.inflate.iterations, report.fit.iterations];
    outcome.t = report.t;
    outcome.converged = report.converged;
    outcome.distances = [report.min_distance_self, report.min_distance_avatar].map(|d| d.is_finite().then_some(d));
    ended?;
    let distortion = session.distortion()?;
    outcome.distortion = Some(mean_and_largest(&distortion));
    outcome.distortions = distortion.into_iter().map(|d| d as f32).collect();
    session.garment_as_read(Precision::F32)
}

/// Fills in what is measured on the garment at `positions`, which takes no part in the seconds of the session.
fn measure(outcome: &mut Outcome, garment: &Sample, body: &Sample, positions: Vec<DVec3>) {
    let designed = mesh(&garment.mesh);
    let dressed = TriangleMesh { positions, triangles: designed.triangles.clone() };
    outcome.asymmetry = Some([&dressed, &mesh(&body.mesh)].map(|mesh| 1e3 * asymmetry(mesh)));
    outcome.opening_growth = opening_growth(&designed, &dressed.positions);
    outcome.positions = dressed.positions.into_iter().map(|p| p.as_vec3().to_array()).collect();
}

/// Mean and largest of numbers from 0 on.
pub fn mean_and_largest(values: &[f64]) -> [f64; 2] {
    let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
    [mean, values.iter().copied().fold(0.0, f64::max)]
}

/// A session with all its inputs set.
pub fn session(garment: &Sample, body: &Sample, mannequin: Option<&Sample>, options: &Options) -> Result<Session> {
    let mut session = Session::new();
    session.set_options(options.clone())?;
    session.set_garment(mesh(&garment.mesh), Precision::F32)?;
    session.set_source_skeleton(bones(&garment.skeleton))?;
    session.set_target_avatar(mesh(&body.mesh))?;
    session.set_target_skeleton(bones(&body.skeleton))?;
    if let Some(mannequin) = mannequin {
        session.set_source_avatar(mesh(&mannequin.mesh))?;
    }
    if !body.skin.is_empty() {
        let (weights, vertices) = (body.skin.concat(), body.mesh.positions.len());
        session.set_target_skin(SkinWeights::from_dense(&weights, body.skin.len(), vertices, "skin weights")?)?;
    }
    if !garment.no_fit.is_empty() {
        let mut weights = vec![1.0; garment.mesh.positions.len()];
        garment.no_fit.iter().for_each(|&v| weights[v as usize] = 0.0);
        session.set_vertex_fit_weights(weights)?;
    }
    Ok(session)
}

/// The mesh as a caller reads it who stores 32-bit positions.
pub fn mesh(mesh: &Mesh) -> TriangleMesh {
    let positions = mesh.positions.iter().map(|&p| Precision::F32.round(p)).collect();
    TriangleMesh { positions, triangles: mesh.triangles.clone() }
}

fn bones(skeleton: &skeleton::Skeleton) -> Skeleton {
    Skeleton { joints: skeleton.joints.to_vec(), bones: BONES.to_vec() }
}
