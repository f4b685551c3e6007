//! Which triangles of the body the result covers.

use std::sync::{Arc, PoisonError};

use super::Session;
use super::snapshot::Snapshot;
use crate::control::{Cancel, Stage};
use crate::error::{Error, ErrorKind, Result};
use crate::geometry::covered::{CoveredOptions, Wearer, covered_triangles};
use crate::geometry::mesh::TriangleMesh;

/// An answer, and to what: callers ask for the number of triangles first, and for the triangles then.
pub(super) struct Covered {
    layer: Option<usize>,
    options: CoveredOptions,
    triangles: Arc<[u32]>,
}

impl Session {
    /// The triangles of a layer, or of the avatar itself, that the garment covers: nobody sees them from outside, as long as the
    /// garment is worn. Ascending, in the caller's indices. Triangles of the avatar that are ignored are none of them.
    ///
    /// # Errors
    /// `InvalidState` before the end, `InvalidArgument` where there is no such layer or the openness is no share, `Cancelled`.
    pub fn covered_triangles(&self, layer: Option<usize>, options: &CoveredOptions) -> Result<Arc<[u32]>> {
        if !(0.0..=1.0).contains(&options.openness) {
            return Err(Error::new(
                ErrorKind::InvalidArgument,
                format!("covered triangles: the openness is {}; it must be from 0 to 1", options.openness),
            ));
        }
        let (Some(snapshot), Stage::Done) = (&self.snapshot, self.stage) else {
            return Err(Error::new(
                ErrorKind::InvalidState,
                "covered triangles: there is no result yet; run the session to its end first",
            ));
        };
        if let Some(layer) = layer.filter(|&layer| layer >= self.layer_count()) {
            return Err(Error::new(
                ErrorKind::InvalidArgument,
                format!("covered triangles: there is no layer {layer}, the avatar wears {}", self.layer_count()),
            ));
        }
        let last = || self.covered.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = last().as_ref().filter(|known| known.layer == layer && known.options == *options) {
            return Ok(known.triangles.clone());
        }
        let (snapshot, options) = (snapshot.clone(), *options);
        let find = move |cancel: &Cancel| snapshot.covered_triangles(layer, &options, cancel);
        let triangles: Arc<[u32]> = self.aside(find)?.into();
        *last() = Some(Covered { layer, options, triangles: triangles.clone() });
        Ok(triangles)
    }
}

impl Snapshot {
    fn covered_triangles(&self, layer: Option<usize>, options: &CoveredOptions, cancel: &Cancel) -> Result<Vec<u32>> {
        let problem = &self.problem;
        // Caps are left out: what goes through an opening goes through them.
        let garment = TriangleMesh { positions: self.x.clone(), triangles: problem.triangles.clone() };
        let Some(asked) = self.body.triangles_of(layer) else {
            return Err(Error::new(ErrorKind::Internal, "there is no such layer"));
        };
        let wearer = Wearer { mesh: &problem.avatar, asked, is_cloth: layer.is_some() };
        let covered = covered_triangles(&wearer, &garment, options, cancel)?;
        Ok(covered.into_iter().map(|t| self.body.triangle(t).index).collect())
    }
}
