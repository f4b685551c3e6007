//! Contact distances: minimum separation and d-hat, wide enough for the quantisation of the result.
//!
//! Rounding the result to the coordinates in which it is read moves each vertex by at most a quantisation error. Two
//! primitives that are more than two such errors apart are then apart after rounding as well: along the segments from their
//! vertices to the rounded ones, their distance falls by two errors at most. So a minimum separation above two errors keeps
//! the result free of intersections.

use crate::error::{Error, ErrorKind, Result};
use crate::geometry::median::median;
use crate::geometry::mesh::TriangleMesh;
use crate::options::Options;

/// The minimum separation in quantisation errors: the two that are needed, and half as much again.
const SEPARATION_IN_ERRORS: f64 = 3.0;
/// The minimum separation as a share of d-hat, at most: the barrier needs a range above it.
const SEPARATION_IN_DHAT: f64 = 0.25;
/// d-hat of the garment towards itself as a share of its median edge, at most: neighbours are not to repel each other.
const DHAT_SELF_IN_EDGES: f64 = 0.25;
/// A quantisation error above this, in a space in which the skeleton is 2 long, is too coarse for any fit.
const MAX_QUANTISATION_ERROR: f64 = 0.01;

/// A distance below this is lost in the rounding of coordinates of order 1: it counts as touching.
pub const TOUCHING: f64 = 1e-12;

/// The distances that contact keeps, in the normalised space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactDistances {
    /// Where the barrier of the garment towards itself begins.
    pub dhat_self: f64,
    /// Where that towards the avatar begins.
    pub dhat: f64,
    /// The same while the avatar grows.
    pub inflation_dhat: f64,
    /// What no distance falls below.
    pub min_separation: f64,
}

impl ContactDistances {
    /// The distances that `options` ask for.
    pub fn of(options: &Options) -> Self {
        let Options { dhat, inflation_dhat, min_separation, .. } = *options;
        Self { dhat_self: dhat, dhat, inflation_dhat, min_separation }
    }

    /// Distances that are wide enough for a rounding which moves no coordinate by more than `error`; the same where they are
    /// already. `garment` is the garment at rest. Where it is so fine that its neighbouring parts would repel each other, the
    /// minimum separation to itself stays below that, and only the verifier can decide.
    ///
    /// # Errors
    /// `InvalidMesh` where the coordinates are too coarse for any fit.
    pub fn widened(self, error: f64, garment: &TriangleMesh) -> Result<Self> {
        let quantisation = error * 3.0_f64.sqrt();
        let min_separation = SEPARATION_IN_ERRORS * quantisation;
        if min_separation <= self.min_separation {
            return Ok(self);
        }
        if quantisation > MAX_QUANTISATION_ERROR {
            return Err(Error::new(
                ErrorKind::InvalidMesh,
                format!(
                    "target avatar: it is so far from the origin that the coordinates in which the garment is read move a \
                     vertex by up to {quantisation:.1e}, in units in which the skeleton is 2 long; move it nearer to the origin, or \
                     set the garment in 64 bits"
                ),
            ));
        }
        let dhat = self.dhat.max(min_separation / SEPARATION_IN_DHAT);
        let dhat_self = self.dhat_self.max(dhat.min(DHAT_SELF_IN_EDGES * median_edge(garment)));
        Ok(Self {
            dhat_self,
            dhat,
            inflation_dhat: self.inflation_dhat.max(dhat),
            min_separation: self.min_separation.max(min_separation.min(SEPARATION_IN_DHAT * dhat_self)),
        })
    }

    /// All distances twice as wide.
    pub fn doubled(self) -> Self {
        Self {
            dhat_self: 2.0 * self.dhat_self,
            dhat: 2.0 * self.dhat,
            inflation_dhat: 2.0 * self.inflation_dhat,
            min_separation: 2.0 * self.min_separation,
        }
    }
}

fn median_edge(mesh: &TriangleMesh) -> f64 {
    let side = |t: &[u32; 3], k: usize| mesh.positions[t[k] as usize].distance(mesh.positions[t[(k + 1) % 3] as usize]);
    median(mesh.triangles.iter().flat_map(|t| (0..3).map(move |k| side(t, k))).collect()).unwrap_or(0.0)
}
