//! The body to dress with its layers, as one mesh, and the map back to the caller's indices.

use std::sync::Arc;

use glam::DVec3;

use super::diagnostic::{Element, Subject};
use crate::error::{Error, ErrorKind, Result};
use crate::geometry::mesh::TriangleMesh;

/// An avatar with its layers: garments that it wears already, and that count as a part of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Body {
    /// The avatar's vertices and triangles, then those of each layer.
    pub mesh: Arc<TriangleMesh>,
    avatar_vertices: usize,
    /// Where the triangles of the avatar end, then those of each layer.
    ends: Vec<u32>,
}

impl From<TriangleMesh> for Body {
    /// An avatar without layers.
    fn from(avatar: TriangleMesh) -> Self {
        let (vertices, triangles) = (avatar.positions.len(), avatar.triangles.len());
        Self { mesh: avatar.into(), avatar_vertices: vertices, ends: vec![triangles as u32] }
    }
}

impl Body {
    /// `avatar` in `layers`, all of which have passed [`TriangleMesh::check`] and share a coordinate system.
    ///
    /// # Errors
    /// `InvalidMesh` where there are more vertices or triangles together than indices.
    pub fn new(avatar: &Arc<TriangleMesh>, layers: &[Arc<TriangleMesh>]) -> Result<Self> {
        let meshes = || std::iter::once(avatar).chain(layers);
        let vertices: usize = meshes().map(|m| m.positions.len()).sum();
        let triangles: usize = meshes().map(|m| m.triangles.len()).sum();
        if vertices.max(triangles) > u32::MAX as usize {
            return Err(Error::new(
                ErrorKind::InvalidMesh,
                format!(
                    "target avatar: with its layers it has {vertices} vertices and {triangles} triangles, at most {} can be \
                     used; use coarser layers",
                    u32::MAX
                ),
            ));
        }
        let avatar_vertices = avatar.positions.len();
        let ends = meshes().scan(0, |end, mesh| {
            *end += mesh.triangles.len() as u32;
            Some(*end)
        });
        let ends = ends.collect();
        if layers.is_empty() {
            return Ok(Self { mesh: avatar.clone(), avatar_vertices, ends });
        }
        let mut joined =
            TriangleMesh { positions: Vec::with_capacity(vertices), triangles: Vec::with_capacity(triangles) };
        for mesh in meshes() {
            let first = joined.positions.len() as u32;
            joined.positions.extend(&mesh.positions);
            joined.triangles.extend(mesh.triangles.iter().map(|t| t.map(|v| first + v)));
        }
        Ok(Self { mesh: joined.into(), avatar_vertices, ends })
    }

    /// The same triangles with other positions, as in another coordinate system.
    pub fn with_mesh(&self, mesh: TriangleMesh) -> Self {
        Self { mesh: mesh.into(), avatar_vertices: self.avatar_vertices, ends: self.ends.clone() }
    }

    /// Vertices and triangles of the avatar alone.
    pub fn avatar_size(&self) -> [usize; 2] {
        [self.avatar_vertices, self.ends.first().map_or(0, |&end| end as usize)]
    }

    /// Vertices of the avatar alone.
    pub fn avatar_positions(&self) -> &[DVec3] {
        &self.mesh.positions[..self.avatar_vertices]
    }

    /// Vertices of all layers.
    pub fn layer_positions(&self) -> &[DVec3] {
        &self.mesh.positions[self.avatar_vertices..]
    }

    /// A triangle of the mesh as the avatar's or a layer's.
    pub fn triangle(&self, triangle: u32) -> Element {
        match self.ends.partition_point(|&end| end <= triangle) {
            0 => Element::triangle(Subject::TargetAvatar, triangle),
            k => Element::triangle(Subject::Layer(k as u32 - 1), triangle - self.ends[k - 1]),
        }
    }
}
