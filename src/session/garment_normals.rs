//! Normals and tangents of the garment as it is now, for the vertices with which it is drawn.

use glam::{DAffine3, DVec3, DVec4};

use super::Session;
use super::inputs::Inputs;
use super::snapshot::Snapshot;
use crate::error::{Error, ErrorKind, Result};
use crate::follow::normals::RenderVertices;
use crate::follow::surface::MovedSurface;

/// The garment as it is drawn: with vertices split where normals or texture coordinates jump. In the garment's own coordinate
/// system, as it was designed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RenderMesh {
    /// The garment's triangles in their order, by vertices of this mesh; none: the garment's vertices are those that are drawn.
    pub triangles: Option<Vec<[u32; 3]>>,
    /// A normal for each vertex, of any length; none: they follow from the triangles.
    pub normals: Option<Vec<DVec3>>,
    /// A tangent for each vertex, with the handedness of the bitangent in `w`; none: there are none.
    pub tangents: Option<Vec<DVec4>>,
}

impl RenderMesh {
    /// How many vertices it has, for a garment with so many.
    ///
    /// # Errors
    /// `InvalidArgument` where its arrays differ, or a number is not finite.
    fn vertex_count(&self, garment: usize) -> Result<usize> {
        let fail = |message: String| Err(Error::new(ErrorKind::InvalidArgument, message));
        let named = self.triangles.as_ref().map(|all| all.iter().flatten().max().map_or(0, |&v| v as usize + 1));
        let normals = self.normals.as_ref().map(Vec::len);
        let tangents = self.tangents.as_ref().map(Vec::len);
        let count = match &self.triangles {
            None => garment,
            Some(_) => normals.or(tangents).or(named).unwrap_or(0),
        };
        // Else one wild number would be an array of gigabytes.
        if let (Some(all), None, None) = (&self.triangles, normals, tangents)
            && count > garment + 3 * all.len()
        {
            return fail(format!(
                "triangles of the render vertices: they name vertex {}, with {} triangles; give the normals, of which there is one \
                 for each vertex",
                count - 1,
                all.len()
            ));
        }
        for (what, given) in [("normals", normals), ("tangents", tangents)] {
            if let Some(given) = given
                && given != count
            {
                let of = if self.triangles.is_none() { "the garment has" } else { "of normals there are" };
                return fail(format!("garment {what}: there are {given}, {of} {count}; one for each vertex is needed"));
            }
        }
        if let Some(v) = self.normals.iter().flatten().position(|n| !n.is_finite()) {
            return fail(format!("garment normals: that of vertex {v} is not finite"));
        }
        if let Some(v) = self.tangents.iter().flatten().position(|t| !t.is_finite()) {
            return fail(format!("garment tangents: that of vertex {v} is not finite"));
        }
        Ok(count)
    }
}

impl Session {
    /// Unit normals, and tangents where some are given, of the garment as it is now, in the target coordinate system: those of the
    /// design, turned as the surface around their vertex has turned. Vertices in one place whose normals agree in the design get
    /// the mean over the triangles of all of them: what was smooth stays smooth, what was hard hard. A rigid motion turns each
    /// normal exactly. Without normals, those of the design are the mean over the triangles at a vertex, and vertices in one
    /// place are smooth where they differ by 60 degrees at most. Tangents come out perpendicular to the normals; their `w`
    /// changes its sign where one coordinate system is the mirror image of the other. What is 0, or of a vertex without triangles
    /// and normal, is 0.
    ///
    /// # Errors
    /// `InvalidState` before `prepare`, `InvalidArgument` where the mesh is not the garment's or a number is not finite.
    pub fn garment_normals(&self, mesh: &RenderMesh) -> Result<(Vec<DVec3>, Vec<DVec4>)> {
        let snapshot = self.readable()?;
        let surface = snapshot.surface_before_turn(&self.inputs)?;
        let garment = snapshot.problem.weld.to_welded.len();
        let count = mesh.vertex_count(garment)?;
        let own;
        let triangles = match &mesh.triangles {
            Some(triangles) => triangles,
            None => {
                own = self.inputs.garment.as_ref().map_or_else(Vec::new, |garment| garment.0.triangles.clone());
                &own
            }
        };
        let source = &self.inputs.source_coordinate_system;
        // Seen from the same side in both.
        let triangles: Vec<[u32; 3]> = triangles.iter().map(|&t| source.triangle(t)).collect();
        let vertices = RenderVertices::new(&surface, &triangles, count)?;
        let (forth, back) = (source.affine_to_internal(), snapshot.coordinate_system().affine_to_internal());
        let inward = |v: DVec3| direction(&forth, v);
        let outward = |v: DVec3| direction(&back.inverse(), v);
        let designed = match &mesh.normals {
            Some(normals) => normals.iter().map(|&n| inward(n)).collect(),
            None => vertices.designed_normals(&surface),
        };
        let normals = vertices.normals(&surface, &designed);
        let mut tangents = Vec::new();
        if let Some(given) = &mesh.tangents {
            let given: Vec<DVec4> = given.iter().map(|t| inward(t.truncate()).extend(t.w)).collect();
            tangents = vertices.tangents(&surface, &designed, &given, &normals);
            let mirrored = forth.matrix3.determinant() * back.matrix3.determinant() < 0.0;
            let sign = if mirrored { -1.0 } else { 1.0 };
            tangents.iter_mut().for_each(|t| *t = outward(t.truncate()).extend(sign * t.w));
        }
        Ok((normals.into_iter().map(outward).collect(), tangents))
    }
}

/// A direction in another coordinate system, of unit length; 0 stays 0.
fn direction(map: &DAffine3, v: DVec3) -> DVec3 {
    map.transform_vector3(v.normalize_or_zero()).normalize_or_zero()
}

impl Snapshot {
    /// The garment's triangles as the caller has them, over the welded vertices, as designed and now, in the normalised space.
    pub(super) fn moved_surface(&self, inputs: &Inputs) -> Result<MovedSurface> {
        let Some((garment, _)) = &inputs.garment else {
            return Err(Error::new(ErrorKind::Internal, "there is no garment in a prepared session"));
        };
        let problem = &self.problem;
        let welded =
            |t: &[u32; 3]| inputs.source_coordinate_system.triangle(t.map(|v| problem.weld.to_welded[v as usize]));
        let triangles = garment.triangles.iter().map(welded).collect();
        Ok(MovedSurface::new(problem.rest.clone(), self.x_with_caps(), triangles))
    }

    /// The same before the turn of that space: for directions that go to the caller.
    pub(super) fn surface_before_turn(&self, inputs: &Inputs) -> Result<MovedSurface> {
        let MovedSurface { rest, now, triangles, .. } = self.moved_surface(inputs)?;
        let now = now.iter().map(|&p| self.problem.target_normalization.turned_back(p)).collect();
        Ok(MovedSurface::new(rest, now, triangles))
    }
}
