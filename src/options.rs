//! The options of a session, with the paper's defaults.

pub use crate::energy::surface::SurfaceForm;
use crate::error::{Error, ErrorKind, Result};

/// Every option in one place: its type, its default, `in` the range that is checked, and what it is where the C API
/// switches it `off`. Options, their defaults and their check come from it here, and what takes them from and to C in
/// capi/options.rs, whose struct has a field of the same name.
macro_rules! option_table {
    ($make:ident) => {
        $make! {
            /// Threads of this session, at most as many as the process may use cores; 0 takes all of these.
            threads: u32 = 0, in AtMost(1024, "0 takes all cores");
            /// Weight of the fit term (Eq. 4): higher is tighter.
            fit_weight: f64 = 2.0, in NotNegative, off = 0.0;
            /// Where a source avatar is given: the clearance that the fit aims at, as a fraction of the one that each
            /// point had on it, in proportion to the limb there. 1 is as designed; 0 is tight, as without a source avatar.
            designed_clearance: f64 = 1.0, in Between(0.0, 2.0), off = 0.0;
            /// Clearance to aim at everywhere, in addition to the designed one, in the target's unit.
            offset: f64 = 0.0, in NotNegative;
            /// Where a source avatar is given and no fit weights: what was designed farther from it than this fits
            /// less, and not at all from twice this distance on; infinite for a garment that fits as a whole.
            fit_distance: f64 = 0.1, in Positive, off = f64::INFINITY;
            /// Weight of the pins that hold vertices at their targets.
            pin_weight: f64 = 1000.0, in NotNegative;
            /// Open seams whose sides are nearer than this share of the garment's mean edge are closed; 0 welds vertices at
            /// equal positions only.
            weld_distance: f64 = 0.01, in Between(0.0, 0.25), off = 0.0;
            /// Bytes that the session may take at most; 0 is no limit.
            memory_limit: u64 = 0;
            /// Refuse a garment that intersects itself at the start, instead of exempting those triangles from contact; and
            /// take skin weights and the avatar's pieces as they are, instead of mending what contradicts the rest; and
            /// refuse a target that faces another way than the source, instead of turning it.
            strict: bool = false;
            /// Refuse a garment that is closed by caps where bones leave it, instead of leaving the caps out while it is
            /// fitted.
            keep_caps: bool = false;
            /// Weight of the surface term (Eq. 2).
            surface_weight: f64 = 1.0, in NotNegative, off = 0.0;
            /// Weight of the curvature of boundary curves (Eq. 5).
            curvature_weight: f64 = 2.5, in NotNegative, off = 0.0;
            /// Weight of the torsion of boundary curves (section 3.4.5).
            torsion_weight: f64 = 2.5, in NotNegative, off = 0.0;
            /// Distance along a boundary curve at which its bends are seen, so that the curve terms are the same at every
            /// resolution; 0 sees them at its vertices, as printed in the paper.
            curve_chord: f64 = 0.08, in Between(0.0, 1.0), off = 0.0;
            /// Weight of the positions of boundaries along their bones (Eq. 3).
            position_weight: f64 = 10.0, in NotNegative, off = 0.0;
            /// Weight of the contact barrier (Eq. 1, on squared distances).
            barrier_weight: f64 = 1e8, in Between(1.0, 1e14);
            /// Distance at which the barrier begins.
            dhat: f64 = 0.002, in Between(1e-5, 0.1);
            /// While the avatar grows: distance to it at which the barrier begins. Wider than `dhat`, so that the
            /// barrier acts before CCD shortens the step.
            inflation_dhat: f64 = 0.01, in Between(1e-5, 0.1);
            /// While the avatar grows: weight of the barrier.
            inflation_barrier_weight: f64 = 1e4, in Between(1.0, 1e14);
            /// Edge of a voxel of the distance field.
            voxel_size: f64 = 0.01, in Between(1e-3, 0.2);
            /// Distance that no pair of primitives ever falls below; a garment that is nearer than four times this to
            /// itself or the skeleton at the start gets a lower one.
            min_separation: f64 = 1e-5, in Between(1e-8, 0.01);
            /// The fit ends where the squared Newton decrement falls below this fraction of the objective.
            tolerance: f64 = 1e-3, in Between(1e-12, 1.0);
            /// Largest number of Newton iterations of each stage.
            max_iterations: u32 = 500, in AtLeast(1);
            /// Which form of the surface term.
            surface_form: SurfaceForm = SurfaceForm::Similarity;
            /// Distance across two triangles at which they weigh their area in the surface term. Smaller ones weigh more, so
            /// that the fit is the same at every resolution; 0 weighs all by their area, as printed.
            surface_length: f64 = 0.048, in Between(0.0, 1.0), off = 0.0;
        }
    };
}
#[cfg(feature = "capi")]
pub(crate) use option_table;

macro_rules! define {
    ($(
        $(#[$doc:meta])*
        $name:ident: $kind:ty = $default:expr $(, in $range:expr)? $(, off = $off:expr)?;
    )*) => {
        /// Weights, distances and limits. Lengths are in the normalised space, in which the longest side of the skeleton's
        /// bounding box is 2.
        #[derive(Clone, Debug, PartialEq)]
        pub struct Options {
            $($(#[$doc])* pub $name: $kind,)*
        }

        impl Default for Options {
            fn default() -> Self {
                Self { $($name: $default,)* }
            }
        }

        impl Options {
            /// Each value for itself.
            fn check_ranges(&self) -> Result<()> {
                use Range::*;
                $($(check(stringify!($name), self.$name.into(), $range)?;)?)*
                Ok(())
            }
        }
    };
}
option_table!(define);

impl Options {
    /// The first option that differs in `other` and is used before the fit, so that a result cannot be fitted again with it.
    pub fn set_before_the_fit(&self, other: &Self) -> Option<&'static str> {
        // Named one by one, so that nobody adds an option without a thought for this.
        let &Self {
            threads,
            fit_weight: _,
            designed_clearance: _,
            offset: _,
            fit_distance: _,
            pin_weight: _,
            weld_distance,
            memory_limit,
            strict,
            keep_caps,
            surface_weight: _,
            curvature_weight: _,
            torsion_weight: _,
            curve_chord,
            position_weight: _,
            barrier_weight: _,
            dhat,
            inflation_dhat,
            inflation_barrier_weight,
            voxel_size,
            min_separation,
            tolerance: _,
            max_iterations: _,
            surface_form,
            surface_length,
        } = self;
        let differs = [
            ("threads", threads != other.threads),
            ("weld_distance", weld_distance != other.weld_distance),
            ("memory_limit", memory_limit != other.memory_limit),
            ("strict", strict != other.strict),
            ("keep_caps", keep_caps != other.keep_caps),
            ("curve_chord", curve_chord != other.curve_chord),
            ("dhat", dhat != other.dhat),
            ("inflation_dhat", inflation_dhat != other.inflation_dhat),
            ("inflation_barrier_weight", inflation_barrier_weight != other.inflation_barrier_weight),
            ("voxel_size", voxel_size != other.voxel_size),
            ("min_separation", min_separation != other.min_separation),
            ("surface_form", surface_form != other.surface_form),
            ("surface_length", surface_length != other.surface_length),
        ];
        differs.into_iter().find(|(_, differs)| *differs).map(|(name, _)| name)
    }
}

/// Which values an option may have.
enum Range {
    /// Finite, 0 or above.
    NotNegative,
    /// Above 0, infinity included.
    Positive,
    /// From the first to the second.
    Between(f64, f64),
    /// This or more.
    AtLeast(u32),
    /// This or less; and what 0 means.
    AtMost(u32, &'static str),
}

fn refuse(name: &str, value: f64, range: &str) -> Result<()> {
    Err(Error::new(ErrorKind::InvalidArgument, format!("option {name} is {value}; it must be {range}")))
}

fn check(name: &str, value: f64, range: Range) -> Result<()> {
    let (is_within, text) = match range {
        Range::NotNegative => (value.is_finite() && value >= 0.0, "a finite number, 0 or above".to_string()),
        Range::Positive => (value > 0.0, "above 0".to_string()),
        Range::Between(low, high) => (value >= low && value <= high, format!("between {low} and {high}")),
        Range::AtLeast(low) => (value >= f64::from(low), format!("at least {low}")),
        Range::AtMost(high, zero) => (value <= f64::from(high), format!("at most {high} ({zero})")),
    };
    if is_within { Ok(()) } else { refuse(name, value, &text) }
}

impl Options {
    /// Checks every value.
    ///
    /// # Errors
    /// `InvalidArgument`, naming the option, its value and its range.
    pub fn check(&self) -> Result<()> {
        self.check_ranges()?;
        let narrowest = self.dhat.min(self.inflation_dhat);
        if self.min_separation >= 0.5 * narrowest {
            let range = format!("below half of dhat and of inflation_dhat, which is {}", 0.5 * narrowest);
            return refuse("min_separation", self.min_separation, &range);
        }
        if self.surface_weight == 0.0 {
            return refuse("surface_weight", 0.0, "above 0: nothing else holds the garment together");
        }
        Ok(())
    }
}
