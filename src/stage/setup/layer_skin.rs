//! Skin weights of the layers that an avatar wears: those of the avatar beneath.

use std::borrow::Cow;

use rayon::prelude::*;

use crate::geometry::closest_point::{ClosestPoint, barycentric};
use crate::input::body::Body;
use crate::input::skin::SkinWeights;

/// `skin`, that of the avatar of `body`, with weights for the vertices of all layers as well: each has those of the nearest
/// point of the avatar.
pub fn skin_with_layers<'a>(skin: &'a SkinWeights, body: &Body) -> Cow<'a, SkinWeights> {
    if body.layer_positions().is_empty() {
        return Cow::Borrowed(skin);
    }
    let avatar = body.avatar();
    let tree = ClosestPoint::new(&avatar);
    let beneath = |&p| {
        let closest = tree.closest(p)?;
        let triangle = avatar.triangles[closest.triangle as usize];
        Some((triangle, barycentric(closest.point, triangle.map(|v| avatar.positions[v as usize]))))
    };
    let points: Vec<_> = body.layer_positions().par_iter().map(beneath).collect();
    Cow::Owned(skin.extended(&points))
}
