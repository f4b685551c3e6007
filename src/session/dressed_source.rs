//! A garment through which the source avatar passes, as a head through its hat, and which is refused: the source avatar with the
//! garment on takes its place, and it is tried again.
//!
//! A body that passes through its garment is no measure for how far the one lies from the other: where it does, the garment itself is
//! the outermost of both. What is refused for another reason is not tried again, and of two refusals the first one is told. Most garments
//! are as far from that body as before, so that the second try goes the way of the first: it is over once that is seen.

use std::sync::Arc;

use super::Session;
use super::inputs::Inputs;
use super::run::Run;
use super::snapshot::Snapshot;
use crate::control::{Cancel, Stage};
use crate::error::{Error, ErrorKind, Result};
use crate::geometry::mesh::TriangleMesh;
use crate::input::diagnostic::{Diagnostic, DiagnosticKind, Severity};
use crate::input::skin::SkinWeights;
use crate::report::Report;
use crate::solver::newton::State;
use crate::verify::intersections_with_cancel;

/// What came of a garment with the source avatar as it is.
pub(super) struct FirstTry {
    error: Error,
    diagnostics: Vec<Diagnostic>,
    said_of_inputs: usize,
    /// None where it was refused before it began.
    snapshot: Option<Snapshot>,
    report: Report,
    /// The first steps of its inflation.
    opening: Option<Box<State>>,
}

/// Inputs whose source avatar has the garment on, and how they are told.
type Dressed = (Inputs, Diagnostic);

impl Session {
    /// After `refused`, which `prepare` ended with: the run with the source avatar dressed.
    pub(super) fn prepare_dressed(&mut self, refused: Error) -> Result<Box<Run>> {
        let Some((inputs, diagnostic)) = self.dressed(&refused)? else { return Err(refused) };
        self.keep(refused, None);
        self.prepare_again(inputs, diagnostic)
    }

    /// After `refused`, which a step ended with: goes on from the beginning with the source avatar dressed.
    pub(super) fn begin_dressed(&mut self, refused: Error) -> Result<Stage> {
        let has_tried = self.first_try.is_some() || self.run.as_ref().is_none_or(|run| run.is_limited || run.is_left);
        let dressed = if has_tried { None } else { self.dressed(&refused)? };
        let Some((inputs, diagnostic)) = dressed else { return Err(refused) };
        let (begun, opening) = self.run.take().map(|run| (run.begun, run.opening)).unzip();
        self.keep(refused, opening.flatten());
        let mut run = self.prepare_again(inputs, diagnostic)?;
        run.follow(&self.report, begun);
        self.said_of_inputs = self.diagnostics.len();
        self.report = run.report.clone();
        self.snapshot = Some(Snapshot::of(&run));
        self.run = Some(run);
        Ok(Stage::Inflate)
    }

    /// Whether this is a second try that goes the way of the first.
    pub(super) fn repeats_first(&self) -> bool {
        let before = self.first_try.as_ref().and_then(|first| first.opening.as_ref());
        let now = self.run.as_ref().and_then(|run| run.opening.as_ref());
        before.is_some() && before == now
    }

    /// Of a second try that failed with `error`: what the first one said, and where it came.
    pub(super) fn told_of_first(&mut self, error: Error) -> Error {
        if matches!(error.kind, ErrorKind::Cancelled | ErrorKind::ImplausibleResult) {
            return error;
        }
        let Some(first) = self.first_try.take() else { return error };
        let FirstTry { error, diagnostics, said_of_inputs, snapshot, report, .. } = *first;
        (self.diagnostics, self.said_of_inputs) = (diagnostics, said_of_inputs);
        if let Some(snapshot) = snapshot {
            (self.snapshot, self.report) = (Some(snapshot), report);
        }
        error
    }

    fn keep(&mut self, error: Error, opening: Option<Box<State>>) {
        self.first_try = Some(Box::new(FirstTry {
            error,
            diagnostics: std::mem::take(&mut self.diagnostics),
            said_of_inputs: self.said_of_inputs,
            snapshot: self.snapshot.clone(),
            report: self.report.clone(),
            opening,
        }));
    }

    fn prepare_again(&mut self, inputs: Inputs, diagnostic: Diagnostic) -> Result<Box<Run>> {
        let run = self.prepare_run(inputs).map_err(|error| self.told_of_first(error))?;
        self.diagnostics.push(diagnostic);
        Ok(run)
    }

    /// The inputs with the source avatar dressed; none where that is no help.
    fn dressed(&self, refused: &Error) -> Result<Option<Dressed>> {
        let may_help = matches!(refused.kind, ErrorKind::NotEnclosed | ErrorKind::InflationStalled)
            && !self.inputs.options.strict
            && !self.diagnostics.iter().any(is_of_place);
        if !may_help || self.inputs.source_avatar.is_none() {
            return Ok(None);
        }
        let inputs = self.inputs.clone();
        let has_begun = refused.kind == ErrorKind::InflationStalled;
        self.aside(move |cancel: &Cancel| inputs.dressed(has_begun, cancel))
    }
}

/// Whether a garment that this is said of is in another place or unit than its body, which no other body mends.
fn is_of_place(diagnostic: &Diagnostic) -> bool {
    let of_place = matches!(
        diagnostic.kind(),
        DiagnosticKind::UnitMismatch | DiagnosticKind::FacingMismatch | DiagnosticKind::SidesSwapped
    );
    of_place && diagnostic.severity() == Severity::Error
}

impl Inputs {
    /// These with the garment on the source avatar, whose weights go on with the garment's; none where the two do not pass through
    /// each other. `has_begun`: the inflation stalled.
    fn dressed(&self, has_begun: bool, cancel: &Cancel) -> Result<Option<Dressed>> {
        let (Some((garment, _)), Some(body)) = (&self.garment, &self.source_avatar) else { return Ok(None) };
        let passing = intersections_with_cancel(garment, Some(body), 1, cancel)?;
        let Some(&triangles) = passing.pairs.first() else { return Ok(None) };
        let rigs = &self.rigs;
        let source_skin = joined([(&rigs.source_skin, body), (&rigs.garment_skin, garment)]);
        let inputs = Self {
            source_avatar: Some(Arc::new(together(body, garment))),
            rigs: super::rig_inputs::Rigs { source_skin, ..rigs.clone() },
            ..self.clone()
        };
        Ok(Some((inputs, Diagnostic::SourceDressed { pairs: passing.count, triangles, has_begun })))
    }
}

/// Two meshes as one.
fn together(a: &TriangleMesh, b: &TriangleMesh) -> TriangleMesh {
    let first = a.positions.len() as u32;
    let moved = b.triangles.iter().map(|t| t.map(|v| v + first));
    TriangleMesh {
        positions: [&a.positions[..], &b.positions[..]].concat(),
        triangles: a.triangles.iter().copied().chain(moved).collect(),
    }
}

/// The weights of meshes as those of one; vertices of a mesh without any have none. None where no mesh has some.
fn joined(parts: [(&Option<Arc<SkinWeights>>, &Arc<TriangleMesh>); 2]) -> Option<Arc<SkinWeights>> {
    let joints = parts.iter().filter_map(|(skin, _)| skin.as_ref()).map(|skin| skin.joint_count()).max()?;
    let rows = parts.into_iter().flat_map(|(skin, mesh)| {
        let row = move |v: usize| skin.as_ref().map_or_else(Vec::new, |skin| skin.weights(v).to_vec());
        (0..mesh.positions.len()).map(row)
    });
    Some(Arc::new(SkinWeights::from_rows(joints, rows)))
}
