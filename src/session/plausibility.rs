//! The comparison of a verified result with its design, in the caller's indices.

use super::Session;
use super::snapshot::Snapshot;
use crate::control::Cancel;
use crate::error::{Error, ErrorKind, Result};
use crate::geometry::mesh::TriangleMesh;
use crate::input::diagnostic::{Bone, Diagnostic, LimbPlace};
use crate::stage::plausibility::{Distorted, Findings, Lifted, Misplacement, Outcome, compare};
use crate::verify::intersections_with_cancel;

impl Session {
    /// Adds to the diagnostics how the result differs from the design.
    ///
    /// # Errors
    /// `ImplausibleResult` where nobody would wear it, `Cancelled`.
    pub(super) fn compare_with_design(&mut self) -> Result<()> {
        let (snapshot, Some(pool)) = (self.readable()?.clone(), &self.pool) else { return Ok(()) };
        let (stop, control) = (Cancel::new(), &self.control);
        let cancel = stop.clone();
        let job = move || snapshot.compare_with_design(&cancel);
        let (diagnostics, is_gross) = pool.run(|| control.is_cancelled(), &stop, job)??;
        let gravest = diagnostics.iter().max_by_key(|d| d.severity()).map(Diagnostic::to_string);
        self.diagnostics.extend(diagnostics);
        match gravest {
            Some(said) if is_gross => Err(Error::new(
                ErrorKind::ImplausibleResult,
                format!("the garment is verified and can be read, but it is not worn as designed: {said}"),
            )),
            _ => Ok(()),
        }
    }
}

impl Snapshot {
    /// How the garment differs from its design, and whether nobody would wear it.
    fn compare_with_design(&self, cancel: &Cancel) -> Result<(Vec<Diagnostic>, bool)> {
        let problem = &self.problem;
        let mesh = |positions: &[_]| TriangleMesh { positions: positions.into(), triangles: problem.triangles.clone() };
        let [vertices, triangles] = self.body.avatar_size();
        let body = TriangleMesh {
            positions: problem.avatar.positions[..vertices].into(),
            triangles: problem.avatar.triangles[..triangles].into(),
        };
        let worn = TriangleMesh {
            positions: problem.avatar.positions.clone(),
            triangles: problem.avatar.triangles[triangles..].into(),
        };
        let [source, target] = &problem.skeletons;
        let (design, result) = (mesh(&problem.rest), mesh(&self.x));
        let collision_only = self.body.collision_only();
        // Nothing that did not intersect at the start does now.
        let intersecting = if self.initial_intersections().is_empty() {
            Vec::new()
        } else {
            intersections_with_cancel(&result, None, usize::MAX, cancel)?.pairs
        };
        let outcome = Outcome {
            design: &design,
            result: &result,
            source,
            target,
            body: &body,
            worn: &worn,
            collision_only,
            intersecting: &intersecting,
        };
        let findings = compare(&outcome, cancel)?;
        Ok((self.diagnostics_of(&findings), findings.is_gross()))
    }

    fn diagnostics_of(&self, findings: &Findings) -> Vec<Diagnostic> {
        let problem = &self.problem;
        let bone = |index: u32| Bone { index, joints: problem.bones[index as usize] };
        let avatar = |triangle: u32| self.body.triangle(triangle).index;
        let mut diagnostics = Vec::new();
        Diagnostic::list(&mut diagnostics, &findings.misplaced, |misplacement| {
            let (index, place) = match *misplacement {
                Misplacement::OutOfOpening { bone, vertex } => {
                    (bone, LimbPlace::OutOfOpening { vertex: problem.weld.vertex_of[vertex as usize] })
                }
                Misplacement::Inside { bone, triangle, share } => {
                    (bone, LimbPlace::Inside { triangle: avatar(triangle), share })
                }
                Misplacement::Beside { bone, triangle, share } => {
                    (bone, LimbPlace::Beside { triangle: avatar(triangle), share })
                }
                Misplacement::Swallowed { bone, triangle, times, is_gross } => {
                    (bone, LimbPlace::Swallowed { triangle: avatar(triangle), times, is_gross })
                }
                Misplacement::Under { bone, triangle, share } => {
                    (bone, LimbPlace::Under { triangle: avatar(triangle), share })
                }
            };
            Diagnostic::LimbMisplaced { bone: bone(index), place }
        });
        Diagnostic::list(&mut diagnostics, &findings.resized, |piece| Diagnostic::PieceResized {
            triangle: problem.weld.triangle_of[piece.triangle as usize],
            triangles: piece.triangles,
            scale: piece.scale,
            is_gross: piece.is_gross,
        });
        diagnostics.extend(findings.distorted.map(|Distorted { scales, triangles }| Diagnostic::ClothDistorted {
            scales,
            triangles: triangles.map(|t| problem.weld.triangle_of[t as usize]),
        }));
        diagnostics.extend(findings.lifted.map(|Lifted { triangle, times }| Diagnostic::ClothLifted {
            triangle: problem.weld.triangle_of[triangle as usize],
            times,
        }));
        diagnostics.extend(findings.crumpled.as_ref().map(|(found, is_gross)| Diagnostic::ResultCrumpled {
            pairs: found.pairs,
            first: found.first.map(|t| problem.weld.triangle_of[t as usize]),
            share: found.share,
            is_gross: *is_gross,
        }));
        diagnostics
    }
}
