//! What of a body's file takes part: what its caller says of its triangles, and pieces that are no part of the body, such as a floor.

use crate::error::{Error, ErrorKind, Result};
use crate::geometry::mesh::TriangleMesh;
use crate::input::body::PartRole;
use crate::input::diagnostic::{Diagnostic, Subject};
use crate::input::placement::size;
use crate::input::skeleton::Skeleton;
use crate::stage::start::foreign_parts::{self, ForeignPart};

/// The triangles of a body's file.
pub(super) struct BodyParts<'a> {
    whose: Subject,
    mesh: &'a TriangleMesh,
    skeleton: &'a Skeleton,
    /// One for each triangle, as its caller has it.
    roles: Vec<PartRole>,
    /// Pieces that seem to be no part of the body.
    foreign: Vec<ForeignPart>,
}

impl<'a> BodyParts<'a> {
    /// Finds the pieces of `mesh` that are no part of the body on `skeleton`, in one space with it. Without `roles` all is automatic.
    ///
    /// # Errors
    /// `InvalidArgument` where there is not one role for each triangle.
    pub(super) fn find(
        whose: Subject,
        mesh: &'a TriangleMesh,
        skeleton: &'a Skeleton,
        roles: Option<&[PartRole]>,
    ) -> Result<Self> {
        let count = mesh.triangles.len();
        let roles = roles.map_or_else(|| vec![PartRole::Automatic; count], <[PartRole]>::to_vec);
        if roles.len() != count {
            return Err(Error::new(
                ErrorKind::InvalidArgument,
                format!("avatar parts: there are {} roles, the avatar has {count} triangles", roles.len()),
            ));
        }
        let own: Vec<u32> = (0..count as u32).filter(|&t| roles[t as usize] != PartRole::Ignored).collect();
        let part = mesh.with_triangles(own.iter().map(|&t| mesh.triangles[t as usize]));
        let is_kept = |t: u32| roles[own[t as usize] as usize] != PartRole::Automatic;
        let mut foreign = foreign_parts::find(&part, skeleton, is_kept);
        foreign.iter_mut().flat_map(|part| &mut part.triangles).for_each(|t| *t = own[*t as usize]);
        Ok(Self { whose, mesh, skeleton, roles, foreign })
    }

    /// The roles with those pieces left out.
    fn without_foreign(&self) -> Vec<PartRole> {
        let mut roles = self.roles.clone();
        self.foreign.iter().flat_map(|part| &part.triangles).for_each(|&t| roles[t as usize] = PartRole::Ignored);
        roles
    }

    /// What takes part by `roles`, with all vertices.
    fn taking_part(&self, roles: &[PartRole]) -> TriangleMesh {
        let own = self.mesh.triangles.iter().zip(roles).filter(|(_, role)| **role != PartRole::Ignored);
        self.mesh.with_triangles(own.map(|(&t, _)| t))
    }

    /// The body alone, where it is sure that the pieces are no part of it: what is left lies around its bones. Where all of a file is
    /// in another unit than its skeleton, pieces seem to be what they are not.
    fn sure_body(&self) -> Option<TriangleMesh> {
        if self.foreign.is_empty() {
            return None;
        }
        Some(self.taking_part(&self.without_foreign())).filter(|body| size::lies_around(body, self.skeleton))
    }

    /// What units, axes and sides are looked for in: a large floor or dome would speak for all.
    pub(super) fn compared(&self) -> TriangleMesh {
        self.sure_body().unwrap_or_else(|| self.taking_part(&self.roles))
    }

    /// The body alone where that is sure and none wants it `strict`, else all. Adds to `diagnostics`.
    pub(super) fn sure_body_or_all(&self, strict: bool, diagnostics: &mut Vec<Diagnostic>) -> TriangleMesh {
        let Some(body) = self.sure_body() else { return self.mesh.clone() };
        self.tell(strict, diagnostics);
        if strict { self.mesh.clone() } else { body }
    }

    /// The role of each triangle: pieces that are no part of the body are ignored, unless their caller says what they are or wants it
    /// `strict`. Adds to `diagnostics`.
    pub(super) fn resolved_roles(&self, strict: bool, diagnostics: &mut Vec<Diagnostic>) -> Vec<PartRole> {
        self.tell(strict, diagnostics);
        if strict { self.roles.clone() } else { self.without_foreign() }
    }

    fn tell(&self, strict: bool, diagnostics: &mut Vec<Diagnostic>) {
        Diagnostic::list(diagnostics, &self.foreign, |part| part.diagnostic(self.whose, !strict));
    }
}
