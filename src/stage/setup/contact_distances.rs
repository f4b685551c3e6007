//! The gap that survives the rounding of the result to the coordinates in which it is read.
//!
//! Rounding moves each vertex by at most a `shift`. Two primitives that are more than two shifts apart are then apart
//! after rounding as well: along the straight way of their vertices to the rounded places, their distance falls by two
//! shifts at most. So a separation floor above two shifts makes the promise survive.

use crate::error::{Error, ErrorKind, Result};
use crate::geometry::mesh::TriangleMesh;
use crate::options::Options;

/// The floor in shifts: the two that are needed, and half as much again.
const FLOOR_IN_SHIFTS: f64 = 3.0;
/// The floor as a part of d-hat, at most: the barrier needs room above it.
const FLOOR_IN_DHAT: f64 = 0.25;
/// The garment's distance to itself as a part of its median edge, at most: neighbours are not to repel each other.
const OWN_DHAT_IN_EDGES: f64 = 0.25;
/// A shift above this, in a space in which the skeleton is 2 long, leaves no room for a fit.
const LARGEST_SHIFT: f64 = 0.01;

/// A distance below this is lost in the rounding of coordinates of order 1: it counts as touching.
pub const NO_DISTANCE: f64 = 1e-12;

/// The distances that contact keeps, in the normalised space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gaps {
    /// Where the barrier of the garment towards itself begins.
    pub own_dhat: f64,
    /// Where that towards the avatar begins.
    pub dhat: f64,
    /// The same while the avatar grows.
    pub inflation_dhat: f64,
    /// What no distance falls below.
    pub floor: f64,
}

impl Gaps {
    /// The gaps that `options` ask for.
    pub fn of(options: &Options) -> Self {
        let Options { dhat, inflation_dhat, separation_floor: floor, .. } = *options;
        Self { own_dhat: dhat, dhat, inflation_dhat, floor }
    }

    /// Gaps that survive a rounding which moves no coordinate by more than `error`; the same where they are wide enough.
    /// `garment` is the garment at rest. Where it is so fine that its neighbouring parts would repel each other, its gap to
    /// itself stays narrower than that, and only the verifier can tell.
    ///
    /// # Errors
    /// `InvalidMesh` where the coordinates are too coarse for any fit.
    pub fn widened(self, error: f64, garment: &TriangleMesh) -> Result<Self> {
        let shift = error * 3.0_f64.sqrt();
        let floor = FLOOR_IN_SHIFTS * shift;
        if floor <= self.floor {
            return Ok(self);
        }
        if shift > LARGEST_SHIFT {
            return Err(Error::new(
                ErrorKind::InvalidMesh,
                format!(
                    "target avatar: it is so far from the origin that the coordinates in which the garment is read move a \
                     vertex by up to {shift:.1e}, in units in which the skeleton is 2 long; move it nearer to the origin, or \
                     set the garment in 64 bits"
                ),
            ));
        }
        let dhat = self.dhat.max(floor / FLOOR_IN_DHAT);
        let own_dhat = self.own_dhat.max(dhat.min(OWN_DHAT_IN_EDGES * median_edge(garment)));
        Ok(Self {
            own_dhat,
            dhat,
            inflation_dhat: self.inflation_dhat.max(dhat),
            floor: self.floor.max(floor.min(FLOOR_IN_DHAT * own_dhat)),
        })
    }

    /// All gaps twice as wide.
    pub fn doubled(self) -> Self {
        Self {
            own_dhat: 2.0 * self.own_dhat,
            dhat: 2.0 * self.dhat,
            inflation_dhat: 2.0 * self.inflation_dhat,
            floor: 2.0 * self.floor,
        }
    }
}

fn median_edge(mesh: &TriangleMesh) -> f64 {
    let side = |t: &[u32; 3], k: usize| mesh.positions[t[k] as usize].distance(mesh.positions[t[(k + 1) % 3] as usize]);
    let mut lengths: Vec<f64> = mesh.triangles.iter().flat_map(|t| (0..3).map(move |k| side(t, k))).collect();
    let middle = lengths.len() / 2;
    if lengths.is_empty() {
        return 0.0;
    }
    *lengths.select_nth_unstable_by(middle, f64::total_cmp).1
}
