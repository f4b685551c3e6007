//! What a caller may tune, with the paper's defaults.

pub use crate::energy::surface::SurfaceForm;
use crate::error::{Error, ErrorKind, Result};

/// Weights, distances and limits. Lengths are in the normalised space, in which the longest side of the skeleton's
/// bounding box is 2.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Threads of this session; 0 takes as many as the machine has cores.
    pub threads: u32,
    /// Weight of the fit term (Eq. 4): higher is tighter.
    pub fit_weight: f64,
    /// Where a source avatar is given: the clearance that the fit aims at, as a fraction of the one that each point had on
    /// it. 1 is as designed; 0 is tight, as without a source avatar.
    pub designed_clearance: f64,
    /// Clearance to aim at everywhere, beside the designed one, in the unit of the target space.
    pub offset: f64,
    /// Where a source avatar is given and no fit weights: what was designed farther from it than this fits less, and not at
    /// all from twice this distance on; infinite for a garment that fits as a whole.
    pub fit_distance: f64,
    /// Weight of the pins that hold vertices in given places.
    pub pin_weight: f64,
    /// Weight of the surface term (Eq. 2).
    pub surface_weight: f64,
    /// Weight of the curvature of boundary curves (Eq. 5).
    pub curvature_weight: f64,
    /// Weight of the torsion of boundary curves (section 3.4.5).
    pub torsion_weight: f64,
    /// Weight of the position of boundaries along their bones (Eq. 3).
    pub position_weight: f64,
    /// Weight of the contact barrier (Eq. 1, on squared distances).
    pub barrier_weight: f64,
    /// Distance at which the barrier begins.
    pub dhat: f64,
    /// While the avatar grows: distance to it at which the barrier begins. Wider than `dhat`, so that the garment sees
    /// the body coming before the step is cut.
    pub inflation_dhat: f64,
    /// While the avatar grows: weight of the barrier.
    pub inflation_barrier_weight: f64,
    /// Distance that no pair of primitives ever falls below; a garment that is nearer than four times this to itself or the
    /// skeleton at the start gets a lower one.
    pub separation_floor: f64,
    /// Edge of a voxel of the distance field.
    pub voxel: f64,
    /// The fit ends where the squared Newton decrement falls below this fraction of the objective.
    pub tolerance: f64,
    /// Largest number of Newton iterations of each stage.
    pub max_iterations: u32,
    /// Which form of the surface term.
    pub surface_form: SurfaceForm,
    /// Bytes that the session may take at most; 0 is no limit.
    pub memory_limit: u64,
    /// Refuse a garment that intersects itself at the start, instead of letting those triangles off.
    pub strict: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            threads: 0,
            fit_weight: 2.0,
            designed_clearance: 1.0,
            offset: 0.0,
            fit_distance: 0.1,
            pin_weight: 1000.0,
            surface_weight: 1.0,
            curvature_weight: 1.0,
            torsion_weight: 1.0,
            position_weight: 10.0,
            barrier_weight: 1e8,
            dhat: 0.002,
            inflation_dhat: 0.01,
            inflation_barrier_weight: 1e4,
            separation_floor: 1e-5,
            voxel: 0.01,
            tolerance: 1e-3,
            max_iterations: 500,
            surface_form: SurfaceForm::Similarity,
            memory_limit: 0,
            strict: false,
        }
    }
}

impl Options {
    /// Checks every value.
    ///
    /// # Errors
    /// `InvalidArgument`, naming the option, its value and its range.
    pub fn check(&self) -> Result<()> {
        let refuse = |name: &str, value: f64, range: &str| {
            Err(Error::new(ErrorKind::InvalidArgument, format!("option {name} is {value}; it must be {range}")))
        };
        for (name, value) in [
            ("fit_weight", self.fit_weight),
            ("surface_weight", self.surface_weight),
            ("curvature_weight", self.curvature_weight),
            ("torsion_weight", self.torsion_weight),
            ("position_weight", self.position_weight),
            ("offset", self.offset),
            ("pin_weight", self.pin_weight),
        ] {
            if !(value.is_finite() && value >= 0.0) {
                return refuse(name, value, "a finite number, 0 or above");
            }
        }
        for (name, value, low, high) in [
            ("barrier_weight", self.barrier_weight, 1.0, 1e14),
            ("inflation_barrier_weight", self.inflation_barrier_weight, 1.0, 1e14),
            ("dhat", self.dhat, 1e-5, 0.1),
            ("inflation_dhat", self.inflation_dhat, 1e-5, 0.1),
            ("separation_floor", self.separation_floor, 1e-8, 0.01),
            ("voxel", self.voxel, 1e-3, 0.2),
            ("tolerance", self.tolerance, 1e-12, 1.0),
            ("designed_clearance", self.designed_clearance, 0.0, 2.0),
        ] {
            if !(value >= low && value <= high) {
                return refuse(name, value, &format!("between {low} and {high}"));
            }
        }
        if self.fit_distance.is_nan() || self.fit_distance <= 0.0 {
            return refuse("fit_distance", self.fit_distance, "above 0");
        }
        let narrowest = self.dhat.min(self.inflation_dhat);
        if self.separation_floor >= 0.5 * narrowest {
            let range = format!("below half of dhat and of inflation_dhat, which is {}", 0.5 * narrowest);
            return refuse("separation_floor", self.separation_floor, &range);
        }
        if self.surface_weight == 0.0 {
            return refuse("surface_weight", 0.0, "above 0: nothing else holds the garment together");
        }
        if self.max_iterations == 0 {
            return refuse("max_iterations", 0.0, "at least 1");
        }
        if self.threads > 1024 {
            return refuse("threads", f64::from(self.threads), "at most 1024 (0 takes all cores)");
        }
        Ok(())
    }
}
