//! Validation of meshes.

use super::{MAX_COORDINATE, bad_coordinate};
use crate::error::{Error, ErrorKind, Result};
use crate::geometry::mesh::TriangleMesh;

impl TriangleMesh {
    /// Refuses a mesh that cannot be used; `name` names it in error messages ("garment").
    ///
    /// A triangle that repeats an index or has no area is no error: real meshes have them.
    ///
    /// # Errors
    /// [`ErrorKind::InvalidMesh`]: no vertices, no triangles, an index out of range, a coordinate that is not
    /// finite or beyond [`MAX_COORDINATE`].
    pub fn check(&self, name: &str) -> Result<()> {
        let fail = |message: String| Err(Error::new(ErrorKind::InvalidMesh, message));
        let count = self.positions.len();
        if count == 0 {
            return fail(format!("{name}: the mesh has no vertices"));
        }
        if count > u32::MAX as usize || self.triangles.len() > u32::MAX as usize {
            return fail(format!(
                "{name}: the mesh has {count} vertices and {} triangles, at most {} of each can be used",
                self.triangles.len(),
                u32::MAX
            ));
        }
        if self.triangles.is_empty() {
            return fail(format!("{name}: the mesh has {count} vertices but no triangles"));
        }
        if let Some((vertex, value)) = bad_coordinate(&self.positions) {
            return fail(format!(
                "{name}: vertex {vertex} has {value}, a coordinate must be finite and at most {MAX_COORDINATE:e} in size"
            ));
        }
        for (t, corners) in self.triangles.iter().enumerate() {
            if let Some(index) = corners.iter().find(|&&v| v as usize >= count) {
                return fail(format!("{name}: triangle {t} has index {index}, the mesh has {count} vertices"));
            }
        }
        Ok(())
    }
}
