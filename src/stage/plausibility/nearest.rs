//! Which triangles of a mesh are nearest to which bone.

use rayon::prelude::*;

use crate::geometry::mesh::TriangleMesh;
use crate::input::skeleton::{BoneGraph, Skeleton};

/// A triangle at a bone.
pub(super) struct Part {
    pub(super) triangle: u32,
    pub(super) area: f64,
    /// Where along the bone its middle is: beyond a leaf joint, too.
    pub(super) parameter: f64,
    /// How far that is from the bone.
    pub(super) distance: f64,
}

/// For each bone of `skeleton`, the triangles of `mesh` that are nearest to it.
pub(super) fn parts_of_bones(mesh: &TriangleMesh, skeleton: &Skeleton, graph: &BoneGraph) -> Vec<Vec<Part>> {
    let nearest = |t: u32| {
        let middle = mesh.centre(t);
        let at = |bone: u32| {
            let parameter = graph.project(skeleton, bone, middle);
            (middle.distance_squared(skeleton.point_at(bone, parameter)), bone, parameter)
        };
        (0..skeleton.bones.len() as u32).map(at).min_by(|a, b| a.0.total_cmp(&b.0))
    };
    let located: Vec<_> = (0..mesh.triangles.len() as u32).into_par_iter().map(nearest).collect();
    let mut parts: Vec<Vec<Part>> = skeleton.bones.iter().map(|_| Vec::new()).collect();
    for ((triangle, area), at) in (0u32..).zip(mesh.areas()).zip(located) {
        if let Some((squared, bone, parameter)) = at {
            parts[bone as usize].push(Part { triangle, area, parameter, distance: squared.sqrt() });
        }
    }
    parts
}
