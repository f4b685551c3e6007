//! The body to dress with its layers, as one mesh, and the map back to the caller's indices.

use std::ops::Range;
use std::sync::Arc;

use glam::DVec3;

use super::diagnostic::{Element, Subject};
use crate::error::{Error, ErrorKind, Result};
use crate::geometry::mesh::TriangleMesh;

/// What a triangle of the avatar is to the garment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PartRole {
    /// Body, unless its piece is recognised as no part of the body.
    #[default]
    Automatic,
    /// The garment is fitted to it and does not pass through it.
    Body,
    /// The garment does not pass through it, but is not fitted to it.
    Collision,
    /// It takes no part in anything.
    Ignored,
}

/// An avatar with its layers: garments that it wears already, and that count as a part of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Body {
    /// The avatar's vertices and triangles, then those of each layer.
    pub mesh: Arc<TriangleMesh>,
    avatar_vertices: usize,
    /// Where the triangles of the avatar end, then those of each layer.
    ends: Vec<u32>,
    /// The avatar's triangles that take part, by the caller's index; none where all do.
    kept: Option<Arc<[u32]>>,
    /// Triangles of the mesh that the garment is not fitted to, ascending.
    collision_only: Arc<[u32]>,
}

impl From<TriangleMesh> for Body {
    /// An avatar without layers.
    fn from(avatar: TriangleMesh) -> Self {
        let (vertices, triangles) = (avatar.positions.len(), avatar.triangles.len());
        Self { mesh: avatar.into(), avatar_vertices: vertices, ends: vec![triangles as u32], ..Self::default() }
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
            return Ok(Self { mesh: avatar.clone(), avatar_vertices, ends, ..Self::default() });
        }
        let mut joined =
            TriangleMesh { positions: Vec::with_capacity(vertices), triangles: Vec::with_capacity(triangles) };
        for mesh in meshes() {
            let first = joined.positions.len() as u32;
            joined.positions.extend(&mesh.positions);
            joined.triangles.extend(mesh.triangles.iter().map(|t| t.map(|v| first + v)));
        }
        Ok(Self { mesh: joined.into(), avatar_vertices, ends, ..Self::default() })
    }

    /// `avatar` in `layers`, of whose triangles each has its role; those that are ignored are left out. The vertices stay.
    ///
    /// # Errors
    /// Those of [`Self::new`], and `InvalidMesh` where no triangle is left that the garment can be fitted to.
    pub fn with_roles(avatar: &Arc<TriangleMesh>, layers: &[Arc<TriangleMesh>], roles: &[PartRole]) -> Result<Self> {
        if roles.iter().all(|role| matches!(role, PartRole::Automatic | PartRole::Body)) {
            return Self::new(avatar, layers);
        }
        let kept: Vec<u32> = (0u32..).zip(roles).filter(|(_, r)| **r != PartRole::Ignored).map(|(t, _)| t).collect();
        let is_collision_only = |k: &u32| roles[kept[*k as usize] as usize] == PartRole::Collision;
        let collision_only: Vec<u32> = (0..kept.len() as u32).filter(is_collision_only).collect();
        if collision_only.len() == kept.len() {
            return Err(Error::new(
                ErrorKind::InvalidMesh,
                "target avatar: the roles of its parts leave no triangle to fit the garment to; give the body the role body",
            ));
        }
        let part = avatar.with_triangles(kept.iter().map(|&t| avatar.triangles[t as usize]));
        Ok(Self {
            kept: Some(kept.into()),
            collision_only: collision_only.into(),
            ..Self::new(&Arc::new(part), layers)?
        })
    }

    /// Triangles of the mesh that the garment is not fitted to, ascending.
    pub fn collision_only(&self) -> &[u32] {
        &self.collision_only
    }

    /// The mesh without the triangles that the garment is not fitted to; none where there are no such triangles.
    pub fn fitted(&self) -> Option<TriangleMesh> {
        if self.collision_only.is_empty() {
            return None;
        }
        let is_fitted = |(t, _): &(u32, &[u32; 3])| self.collision_only.binary_search(t).is_err();
        let fitted = (0u32..).zip(&self.mesh.triangles).filter(is_fitted);
        Some(self.mesh.with_triangles(fitted.map(|(_, &triangle)| triangle)))
    }

    /// The avatar without its layers.
    pub fn avatar(&self) -> TriangleMesh {
        let [_, triangles] = self.avatar_size();
        TriangleMesh {
            positions: self.avatar_positions().to_vec(),
            triangles: self.mesh.triangles[..triangles].to_vec(),
        }
    }

    /// The same triangles with other positions, as in another coordinate system.
    pub fn with_mesh(&self, mesh: TriangleMesh) -> Self {
        Self { mesh: mesh.into(), ..self.clone() }
    }

    /// Vertices and triangles of the avatar alone, without triangles that are ignored.
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

    /// The triangles of the mesh that are a layer's, or those of the avatar; none where there is no such layer.
    pub fn triangles_of(&self, layer: Option<usize>) -> Option<Range<u32>> {
        let part = layer.map_or(0, |layer| layer.saturating_add(1));
        let start = if part == 0 { Some(&0) } else { self.ends.get(part - 1) };
        Some(*start?..*self.ends.get(part)?)
    }

    /// A triangle of the mesh as the avatar's or a layer's.
    pub fn triangle(&self, triangle: u32) -> Element {
        match self.ends.partition_point(|&end| end <= triangle) {
            0 => {
                let caller = self.kept.as_ref().map_or(triangle, |kept| kept[triangle as usize]);
                Element::triangle(Subject::TargetAvatar, caller)
            }
            k => Element::triangle(Subject::Layer(k as u32 - 1), triangle - self.ends[k - 1]),
        }
    }
}
