//! Skin weights of the layers that an avatar wears: those of the avatar beneath.
//!
//! Where two parts of a body nearly touch, the nearest point may be on the other one: that to the inner side of a shoe on the other
//! foot. Between the two the body would be stretched through both legs, and take along what is worn there. So where the
//! weights of neighbours on a layer are for joints far apart, the larger part of that piece of the layer decides.

use std::borrow::Cow;

use glam::DVec3;
use rayon::prelude::*;

use crate::geometry::closest_point::{ClosestPoint, barycentric};
use crate::geometry::mesh::{TriangleMesh, label_pieces, triangle_area};
use crate::input::body::Body;
use crate::input::skeleton::{BoneGraph, Skeleton};
use crate::input::skin::SkinWeights;
use crate::input::weld::weld_vertices;

/// `skin`, that of the avatar of `body`, with weights for the vertices of all layers as well: each has those of the nearest
/// point of the avatar.
pub fn skin_with_layers<'a>(skin: &'a SkinWeights, body: &Body) -> Cow<'a, SkinWeights> {
    if body.layer_positions().is_empty() {
        return Cow::Borrowed(skin);
    }
    Cow::Owned(skin.extended(&places_beneath(&body.avatar(), body.layer_positions())))
}

/// The same on a skeleton: what the nearest point has of another limb is mended.
pub fn skin_on_skeleton<'a>(skin: &'a SkinWeights, body: &Body, skeleton: &Skeleton) -> Cow<'a, SkinWeights> {
    if body.layer_positions().is_empty() {
        return Cow::Borrowed(skin);
    }
    let mut places = places_beneath(&body.avatar(), body.layer_positions());
    mend(&mut places, skin, body, &BoneGraph::new(skeleton));
    Cow::Owned(skin.extended(&places))
}

/// Joints with so many bones between them are parts of the body that no surface joins but through these.
const FAR_APART: usize = 3;

/// Gives what of a piece of a layer is beside the wrong part of the body the place of the nearest vertex of the rest of it.
fn mend(places: &mut [Place], skin: &SkinWeights, body: &Body, graph: &BoneGraph) {
    let first = body.avatar_size()[0] as u32;
    let layers = TriangleMesh {
        positions: body.layer_positions().to_vec(),
        triangles: body.mesh.triangles[body.avatar_size()[1]..].iter().map(|t| t.map(|v| v - first)).collect(),
    };
    let beneath = skin.at(places);
    let joints: Vec<Option<u32>> = (0..places.len()).map(|v| beneath.dominant_joint(v)).collect();
    let (welded, _) = weld_vertices(&layers);
    let edges = || layers.triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let is_far = |[v, w]: [u32; 2]| {
        let pair = joints[v as usize].zip(joints[w as usize]);
        pair.is_some_and(|(a, b)| graph.joint_distance(a, b) >= FAR_APART)
    };
    if !edges().any(is_far) {
        return;
    }
    let seams = || (0u32..).zip(&welded).map(|(v, &w)| [v, w]);
    // Welded vertices have numbers of their own, so they follow after the others.
    let count = places.len() as u32;
    let total = places.len() + welded.iter().max().map_or(0, |&w| w as usize + 1);
    let joined = |links: &mut dyn Iterator<Item = [u32; 2]>| {
        label_pieces(total, links.chain(seams().map(|[v, w]| [v, count + w])))
    };
    let (pieces, piece_count) = joined(&mut edges());
    let (parts, part_count) = joined(&mut edges().filter(|&edge| !is_far(edge)));
    let mut areas = vec![0.0; part_count];
    for &t in &layers.triangles {
        let area = triangle_area(t.map(|v| layers.positions[v as usize])) / 3.0;
        t.iter().for_each(|&v| areas[parts[v as usize] as usize] += area);
    }
    let mut main: Vec<Option<u32>> = vec![None; piece_count];
    for (&piece, &part) in pieces.iter().zip(&parts).take(places.len()) {
        let most = &mut main[piece as usize];
        if most.is_none_or(|most| areas[part as usize] > areas[most as usize]) {
            *most = Some(part);
        }
    }
    let is_main = |v: usize| main[pieces[v] as usize] == Some(parts[v]);
    let given = places.to_vec();
    let nearest = |v: usize| {
        let own = (0..given.len()).filter(|&w| pieces[w] == pieces[v] && is_main(w));
        let from = |w: &usize| layers.positions[*w].distance_squared(layers.positions[v]);
        own.min_by(|a, b| from(a).total_cmp(&from(b)))
    };
    for v in (0..given.len()).filter(|&v| !is_main(v)) {
        if let Some(from) = nearest(v) {
            places[v] = given[from];
        }
    }
}

/// A triangle, and barycentric coordinates in it.
type Place = Option<([u32; 3], [f64; 3])>;

/// The triangle of `body` nearest to each point, and the barycentric coordinates of the nearest point in it; none on a body
/// without triangles.
pub fn places_beneath(body: &TriangleMesh, points: &[DVec3]) -> Vec<Place> {
    let tree = ClosestPoint::new(body);
    let beneath = |&p| {
        let closest = tree.closest(p)?;
        let triangle = body.triangles[closest.triangle as usize];
        Some((triangle, barycentric(closest.point, triangle.map(|v| body.positions[v as usize]))))
    };
    points.par_iter().map(beneath).collect()
}
