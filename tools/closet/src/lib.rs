//! Sample bodies and garments, modelled by formulas: the same seed gives the same bits.
//!
//! ```text
//! skeleton -> body (implicit: loft) -> surface (polygonize -> clip -> remesh) -> skin
//!                 \-> jacket --------> surface -> texture
//! body -> rigs: full rigs by the names of different tools, poses
//! ```
//!
//! `files` writes them. The program of this package leaves the whole closet as files.

pub mod avatars;
pub mod body;
pub mod clip;
pub mod files;
pub mod garments;
pub mod implicit;
pub mod jacket;
pub mod loft;
pub mod mesh;
pub mod parts;
pub mod polygonize;
pub mod polyhedron;
pub mod random;
pub mod remesh;
pub mod rigs;
pub mod skeleton;
pub mod skin;
pub mod surface;
pub mod texture;
pub mod thickness;
pub mod tube;

use body::Build;
use glam::DVec3;
use implicit::Field;
use mesh::Mesh;
use parts::modelled;
use skeleton::{ARMS, LEGS, NECK, Proportions, Skeleton};
use texture::Texture;

/// Varies what is left to chance in the samples.
const SEED: u64 = 2025;

/// The samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The body on which the garments are designed.
    Mannequin,
    /// A much heavier body with shorter arms.
    Heavy,
    /// Big head and hands, long arms, bent forward, with horns that go through the head's surface.
    Creature,
    /// A quilted jacket on the mannequin.
    Jacket,
}

/// A sample: z up, facing -y, metres.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// Closed for a body, open for a garment.
    pub mesh: Mesh,
    /// Of the body itself, or of the mannequin for a garment.
    pub skeleton: Skeleton,
    /// For bodies, one row a joint, one weight a vertex; empty for garments.
    pub skin: Vec<Vec<f64>>,
    /// For garments; empty for bodies.
    pub texture: Texture,
    /// The vertices of a garment that need not fit.
    pub no_fit: Vec<u32>,
}

/// Models a sample. The result depends on `kind` alone.
pub fn sample(kind: Kind) -> Sample {
    if kind == Kind::Jacket {
        return jacket(1.0);
    }
    let (proportions, build) = shape(kind);
    let skeleton = proportions.skeleton();
    let solid = body::body(&skeleton, &build);
    let mut mesh = body_mesh(&skeleton, &build, &solid);
    let mut skin = skin::skin(&mesh, &solid);
    if kind == Kind::Creature {
        for side in [1.0, -1.0] {
            let horn = body::horn(&skeleton, &build, side);
            let horn_mesh = modelled(&horn, 0.009, |_| 0.012);
            for (row, more) in skin.iter_mut().zip(skin::skin(&horn_mesh, &horn)) {
                row.extend(more);
            }
            mesh.append(&horn_mesh);
        }
    }
    Sample { mesh, skeleton, skin, texture: Texture::default(), no_fit: Vec::new() }
}

/// Models the jacket with its edge lengths times `coarseness`.
pub fn jacket(coarseness: f64) -> Sample {
    let (proportions, build) = shape(Kind::Jacket);
    let skeleton = proportions.skeleton();
    let solid = body::body(&skeleton, &build);
    let jacket = jacket::jacket(&skeleton, &solid, SEED, coarseness);
    let (mesh, texture, no_fit) = (jacket.mesh, jacket.texture, jacket.no_fit);
    Sample { mesh, skeleton, skin: Vec::new(), texture, no_fit }
}

/// Coarse on trunk and limbs, fine on the face and the hands.
fn body_mesh(skeleton: &Skeleton, build: &Build, solid: &Field) -> Mesh {
    const COARSE: f64 = 0.024;
    let j = &skeleton.joints;
    let face = j[NECK] + build.head * DVec3::new(0.0, -0.04, 0.07);
    // Balls of finer triangles: centre, radius, edge length.
    let mut fine = vec![(face, 0.095 * build.head, 0.0085 * build.head)];
    for ([shoulder, elbow, wrist], [_, _, ankle]) in ARMS.into_iter().zip(LEGS) {
        fine.push((j[shoulder] - DVec3::Z * 0.06, 0.07, 0.016));
        let palm = j[wrist] + 0.08 * build.hands * (j[wrist] - j[elbow]).normalize();
        fine.push((palm, 0.11 * build.hands, 0.010 * build.hands));
        let toes = DVec3::new(j[ankle].x, j[ankle].y - 0.14 * build.feet, 0.02);
        fine.push((toes, 0.06 * build.feet, 0.012 * build.feet));
    }
    if build.ears > 0.0 {
        fine.push((face, 0.085 * build.head + build.ears, 0.013));
    }
    let edge_length = |p: DVec3| {
        fine.iter().fold(COARSE, |length, (centre, radius, edge)| {
            length.min(edge + 0.1 * (p.distance(*centre) - radius).max(0.0))
        })
    };
    modelled(solid, 0.0135, edge_length)
}

fn shape(kind: Kind) -> (Proportions, Build) {
    let mannequin = Proportions {
        ankle: 0.080,
        shin: 0.445,
        thigh: 0.450,
        leg_angle: 7.5,
        hip: 0.105,
        belly: 0.095,
        chest: 0.450,
        hunch: 0.010,
        shoulder: 0.172,
        shoulder_drop: 0.108,
        upper_arm: 0.285,
        forearm: 0.250,
        arm_angle: 53.0,
    };
    let build = Build {
        hips: 1.0,
        waist: 1.0,
        chest: 1.0,
        depth: 1.0,
        belly: 0.0,
        bust: 1.0,
        arms: 1.0,
        legs: 1.0,
        neck: 1.0,
        head: 1.0,
        jaw: 0.0,
        ears: 0.0,
        hands: 1.0,
        feet: 1.0,
    };
    match kind {
        Kind::Mannequin | Kind::Jacket => (mannequin, build),
        Kind::Heavy => (
            Proportions {
                shin: 0.425,
                thigh: 0.430,
                hip: 0.128,
                leg_angle: 9.0,
                shoulder: 0.205,
                upper_arm: 0.255,
                forearm: 0.220,
                arm_angle: 48.0,
                ..mannequin
            },
            Build {
                hips: 1.42,
                waist: 1.75,
                chest: 1.32,
                depth: 1.40,
                belly: 0.15,
                bust: 1.45,
                arms: 1.40,
                legs: 1.36,
                neck: 1.28,
                head: 1.05,
                jaw: 0.004,
                hands: 1.08,
                feet: 1.08,
                ..build
            },
        ),
        Kind::Creature => (
            Proportions {
                ankle: 0.090,
                shin: 0.300,
                thigh: 0.310,
                leg_angle: 10.0,
                hip: 0.110,
                chest: 0.400,
                hunch: 0.110,
                shoulder: 0.200,
                shoulder_drop: 0.070,
                upper_arm: 0.330,
                forearm: 0.320,
                arm_angle: 50.0,
                ..mannequin
            },
            Build {
                hips: 1.0,
                waist: 1.1,
                chest: 1.18,
                depth: 1.1,
                belly: 0.10,
                arms: 1.08,
                legs: 1.0,
                neck: 1.1,
                head: 1.5,
                jaw: 0.022,
                ears: 0.16,
                hands: 1.6,
                feet: 1.35,
                ..build
            },
        ),
    }
}
