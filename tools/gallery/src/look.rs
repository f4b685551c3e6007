//! How bodies, garments and skeletons look in all the pictures.

use glam::DVec3;

use crate::sheet::{Layer, Role, Scale, Sheet};
use closet::Sample;
use closet::garments::Garment;
use closet::skeleton::BONES;

/// The colour of a body to dress.
pub const BODY: &str = "#c0b7ab";
/// The colour of the body that garments are designed on.
pub const MANNEQUIN: &str = "#d9d3ca";
const BONE: &str = "#c2452d";
/// What differs by less than this from its design looks undistorted, and by more than that all the same.
const DISTORTION: [f64; 2] = [1e-4, 1e-1];

/// One colour a garment.
pub fn colour(garment: Garment) -> &'static str {
    match garment {
        Garment::Jumpsuit => "#2f6d73",
        Garment::Coat => "#d59a33",
        Garment::Skirt => "#b04a3a",
        Garment::Sweater => "#73905f",
        Garment::Vest => "#3f5490",
        Garment::Trousers => "#775072",
    }
}

/// How the distortion of triangles becomes a colour.
pub fn distortion_scale() -> Scale {
    Scale {
        label: "distortion".into(),
        minimum: DISTORTION[0],
        maximum: DISTORTION[1],
        logarithmic: true,
        map: "heat".into(),
    }
}

/// A mesh of `sheet`. Cloth is smooth, bodies have sharp edges.
pub fn surface(role: Role, mesh: usize, colour: &str) -> Layer {
    let colour = colour.to_string();
    let crease = if role == Role::Body { 50.0 } else { 110.0 };
    Layer::Surface { role, shown: true, mesh, colour, opacity: 1.0, wireframe: false, crease, values: None }
}

/// The body, as a mesh of `sheet`.
pub fn body(sheet: &mut Sheet, body: &Sample, colour: &str) -> Layer {
    let mesh = sheet.add_mesh(&positions(&body.mesh.positions), &body.mesh.triangles);
    surface(Role::Body, mesh, colour)
}

/// The skeleton of a body, seen through it.
pub fn skeleton(sheet: &mut Sheet, body: &Sample, shown: bool) -> Layer {
    let joints: Vec<f32> = body.skeleton.joints.iter().flat_map(|p| p.as_vec3().to_array()).collect();
    Layer::Lines {
        role: Role::Skeleton,
        shown,
        points: sheet.add_floats(&joints),
        segments: sheet.add_indices(BONES.as_flattened()),
        colour: BONE.into(),
        radius: 0.006,
        balls: true,
        over: true,
    }
}

/// A garment, as a mesh of `sheet`, in its colour.
pub fn garment(sheet: &mut Sheet, points: &[DVec3], triangles: &[[u32; 3]], kind: Garment) -> Layer {
    let mesh = sheet.add_mesh(&positions(points), triangles);
    surface(Role::Garment, mesh, colour(kind))
}

/// Positions as a sheet stores them.
pub fn positions(points: &[DVec3]) -> Vec<[f32; 3]> {
    points.iter().map(|p| p.as_vec3().to_array()).collect()
}
