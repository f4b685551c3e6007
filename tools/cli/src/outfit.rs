//! The garments of an outfit.

use std::collections::HashMap;

use bespoke::control::Cancel;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::session::{Morph, RenderMesh, outfit_order};
use glam::{DMat3, DMat4, DVec3};

use crate::bodies::joined;
use crate::failure::{Failure, Result};
use crate::figure::{Figure, Part};
use crate::fit::Skinned;
use crate::parts::garments::{Piece, group};

/// A garment: some parts of the outfit's file.
#[derive(Clone, Debug)]
pub struct Garment {
    /// For people: its node, and its materials where the node has other garments.
    pub name: String,
    /// Name of its node.
    pub node: String,
    /// Indices of its parts.
    pub parts: Vec<usize>,
}

/// The garments of `outfit` that were chosen.
pub fn garments(outfit: &Figure) -> Vec<Garment> {
    let chosen: Vec<usize> = (0..outfit.parts.len()).filter(|&part| outfit.parts[part].chosen).collect();
    let pieces: Vec<Piece> = chosen
        .iter()
        .map(|&part| Piece { node: outfit.parts[part].node, positions: &outfit.parts[part].positions })
        .collect();
    let groups = group(&pieces);
    let of_node = |node: usize| groups.iter().filter(|g| pieces[g[0]].node == node).count();
    groups
        .iter()
        .map(|members| {
            let parts: Vec<usize> = members.iter().map(|&piece| chosen[piece]).collect();
            let first = &outfit.parts[parts[0]];
            let materials: Vec<&str> = parts.iter().map(|&part| outfit.parts[part].material.as_str()).collect();
            let name = match of_node(first.node) {
                1 => first.node_name.clone(),
                _ => format!("{}:{}", first.node_name, materials.join("+")),
            };
            Garment { name, node: first.node_name.clone(), parts }
        })
        .collect()
}

/// The same, where there has to be one.
///
/// # Errors
/// Where there is none; the sentence lists the parts.
pub fn need_garments(outfit: &Figure) -> Result<Vec<Garment>> {
    let garments = garments(outfit);
    if !garments.is_empty() {
        return Ok(garments);
    }
    let parts: Vec<String> =
        outfit.parts.iter().map(|part| format!("{} ({})", part.name(), part.sorted.kind)).collect();
    Err(Failure::no_result(format!(
        "{}: no part is known as a garment by its name; the parts are {}. Choose garments with --nodes",
        outfit.file.display(),
        parts.join(", ")
    )))
}

/// `garments` in the order in which they are put on: as they lie one in the other on the body that they were made for.
pub fn in_order(outfit: &Figure, garments: Vec<Garment>, body: Option<&Skinned>) -> Vec<Garment> {
    let parts = |garment: &Garment| garment.parts.iter().map(|&part| &outfit.parts[part]).collect::<Vec<_>>();
    let meshes: Vec<Skinned> =
        garments.iter().map(|garment| joined(parts(garment), outfit.rig.joints.len()).0).collect();
    let meshes: Vec<&TriangleMesh> = meshes.iter().map(|cloth| &cloth.mesh).collect();
    // Nothing cancels it, so there is an order.
    let found = outfit_order(&meshes, body.map(|body| &body.mesh), &Cancel::new());
    let mut left: Vec<Option<Garment>> = garments.into_iter().map(Some).collect();
    let order = found.map(|found| found.order).unwrap_or_default();
    let mut ordered: Vec<Garment> = order.iter().filter_map(|&garment| left[garment as usize].take()).collect();
    ordered.extend(left.into_iter().flatten());
    ordered
}

/// The morph targets of a garment, which is of one mesh: their offsets, vertex after vertex of its parts.
pub fn morphs(outfit: &Figure, parts: &[&Part]) -> Vec<Morph> {
    let Some(first) = parts.first() else { return Vec::new() };
    let targets = &outfit.instance(first.instance).geometry.morphs;
    let morph = |target: &bespoke_gltf::Morph| {
        let deltas: HashMap<u32, [f64; 3]> = target.deltas.iter().copied().collect();
        let offset = |v: &u32| deltas.get(v).copied().map_or(DVec3::ZERO, DVec3::from_array);
        Morph {
            name: target.name.clone(),
            offsets: parts.iter().flat_map(|part| part.vertices.iter().map(offset)).collect(),
        }
    };
    targets.iter().map(morph).collect()
}

/// Normals and tangents of a garment, vertex after vertex of its parts, in the space of the file, where all parts have them.
///
/// # Errors
/// Where they are wrong in the file.
pub fn drawn(outfit: &Figure, parts: &[&Part]) -> Result<RenderMesh> {
    let mut drawn = RenderMesh { triangles: None, normals: Some(Vec::new()), tangents: Some(Vec::new()) };
    for part in parts {
        let instance = outfit.instance(part.instance);
        let first = part.primitive.vertices.start as u32;
        let of_part = |name: &str| part.primitive.attributes.iter().find(|(other, _)| other == name).map(|(_, a)| *a);
        let fail =
            |e: bespoke_gltf::Error| Failure::no_result(e.in_file(outfit.file.display().to_string()).to_string());
        // Bound in several spaces, normals are in none: they are made afresh.
        let place = instance.placed.map(|matrix| DMat3::from_mat4(DMat4::from_cols_array_2d(&matrix)));
        match (of_part("NORMAL"), place, &mut drawn.normals) {
            (Some(accessor), Some(place), Some(normals)) => {
                let rows = outfit.document.rows::<3>(accessor).map_err(fail)?;
                let across = place.inverse().transpose();
                normals.extend(part.vertices.iter().map(|&v| across * DVec3::from_array(rows[(v - first) as usize])));
            }
            _ => drawn.normals = None,
        }
        match (of_part("TANGENT"), place, &mut drawn.tangents) {
            (Some(accessor), Some(place), Some(tangents)) => {
                let rows = outfit.document.rows::<4>(accessor).map_err(fail)?;
                let sign = place.determinant().signum();
                let tangent = |&v: &u32| {
                    let [x, y, z, w] = rows[(v - first) as usize];
                    (place * DVec3::new(x, y, z)).extend(sign * w)
                };
                tangents.extend(part.vertices.iter().map(tangent));
            }
            _ => drawn.tangents = None,
        }
    }
    let is_finite = drawn.normals.iter().flatten().all(|n| n.is_finite());
    if !is_finite {
        drawn.normals = None;
    }
    // Tangents without normals of the file would not be perpendicular to those that are made.
    if drawn.normals.is_none() {
        drawn.tangents = None;
    }
    Ok(drawn)
}
