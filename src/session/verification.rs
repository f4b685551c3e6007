//! The result of the exact verifier for a garment as its caller would read it, compared with the start.

use std::sync::Arc;

use crate::control::Cancel;
use crate::error::Result;
use crate::geometry::mesh::TriangleMesh;
use crate::input::body::Body;
use crate::input::diagnostic::Diagnostic;
use crate::input::weld::Weld;
use crate::report::Verification;
use crate::verify::intersections_with_cancel;

/// Counts, and the pairs of triangles that must not intersect, in the caller's indices.
pub(super) struct Verdict {
    pub(super) counted: Verification,
    /// Pairs of garment triangles that did not intersect at the start.
    own: Vec<[u32; 2]>,
    /// Pairs of a garment triangle and one of `body`.
    avatar: Vec<[u32; 2]>,
    body: Arc<Body>,
}

impl Verdict {
    /// Verifies the welded `garment`, of which the pairs of triangles in `initial_intersections`, in ascending order,
    /// intersected at the start.
    ///
    /// # Errors
    /// `InvalidMesh` where a coordinate is not finite, `Cancelled`.
    pub(super) fn new(
        garment: &TriangleMesh,
        weld: &Weld,
        body: &Arc<Body>,
        initial_intersections: &[[u32; 2]],
        cancel: &Cancel,
    ) -> Result<Self> {
        let own = intersections_with_cancel(garment, None, usize::MAX, cancel)?;
        let avatar = intersections_with_cancel(garment, Some(&body.mesh), usize::MAX, cancel)?;
        let callers = |t: u32| weld.triangle_of[t as usize];
        let new = own.pairs.iter().filter(|pair| initial_intersections.binary_search(pair).is_err());
        let new: Vec<[u32; 2]> = new.map(|pair| pair.map(callers)).collect();
        Ok(Self {
            counted: Verification {
                garment_garment: own.count,
                initial: own.count - new.len() as u64,
                garment_avatar: avatar.count,
            },
            own: new,
            avatar: avatar.pairs.into_iter().map(|[s, t]| [callers(s), t]).collect(),
            body: body.clone(),
        })
    }

    /// The pairs that must not intersect.
    pub(super) fn diagnostics(&self) -> Vec<Diagnostic> {
        let mut diagnostics = Vec::new();
        Diagnostic::list(&mut diagnostics, &self.own, |&triangles| Diagnostic::ResultSelfIntersection { triangles });
        Diagnostic::list(&mut diagnostics, &self.avatar, |&[garment, t]| Diagnostic::ResultIntersection {
            garment,
            avatar: self.body.triangle(t),
        });
        diagnostics
    }
}
