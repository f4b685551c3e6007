//! Skin weights of the layers that an avatar wears: those of the avatar beneath.

use std::borrow::Cow;

use glam::DVec3;
use rayon::prelude::*;

use crate::geometry::closest_point::{ClosestPoint, barycentric};
use crate::geometry::mesh::TriangleMesh;
use crate::input::body::Body;
use crate::input::skin::SkinWeights;

/// `skin`, that of the avatar of `body`, with weights for the vertices of all layers as well: each has those of the nearest
/// point of the avatar.
pub fn skin_with_layers<'a>(skin: &'a SkinWeights, body: &Body) -> Cow<'a, SkinWeights> {
    if body.layer_positions().is_empty() {
        return Cow::Borrowed(skin);
    }
    Cow::Owned(skin.extended(&places_beneath(&body.avatar(), body.layer_positions())))
}

/// The triangle of `body` nearest to each point, and the barycentric coordinates of the nearest point in it; none on a body
/// without triangles.
pub fn places_beneath(body: &TriangleMesh, points: &[DVec3]) -> Vec<Option<([u32; 3], [f64; 3])>> {
    let tree = ClosestPoint::new(body);
    let beneath = |&p| {
        let closest = tree.closest(p)?;
        let triangle = body.triangles[closest.triangle as usize];
        Some((triangle, barycentric(closest.point, triangle.map(|v| body.positions[v as usize]))))
    };
    points.par_iter().map(beneath).collect()
}
