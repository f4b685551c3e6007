//! Options as a C struct in which zero means the default.

use std::mem::{offset_of, size_of};

use crate::capi::session::{BespokeSession, call};
use crate::capi::sized::{self, Sized32};
use crate::capi::status::BespokeStatus;
use crate::error::{Error, ErrorKind, Result};
use crate::options::{Options, SurfaceForm, option_table};

/// The value of a weight in BespokeOptions that switches its term off; 0 means the default.
pub const BESPOKE_WEIGHT_OFF: f64 = -1.0;

/// Form of the surface term (Eq. 2 of the paper).
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BespokeSurfaceForm {
    /// Free for every similarity: scaling the garment as a whole costs nothing.
    Similarity = 0,
    /// As printed in the paper.
    Printed = 1,
}

/// The options of a session. Zero in a field means its default. Unless noted otherwise, lengths are in the normalised
/// space, in which the longest side of the skeleton's bounding box is 2. Weights are finite and not negative, or
/// BESPOKE_WEIGHT_OFF where that is said; other ranges are in brackets. Artists' options come first; from
/// surface_weight on ("Expert."), the fields tune the solver.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BespokeOptions {
    /// sizeof(BespokeOptions).
    pub struct_size: u32,
    /// Threads of this session [1, 1024], of which at most as many are started as the process may use cores (its affinity
    /// and its container decide). Default: all of these. BespokeReport.threads says how many work.
    pub threads: u32,
    /// Weight of the fit term, higher is tighter. Default 2. BESPOKE_WEIGHT_OFF: no fit.
    pub fit_weight: f64,
    /// Where a source avatar is given: the clearance that the fit aims at, as a fraction of the one that each point of
    /// the garment had on it, in proportion to the limb there [up to 2]. Default 1, as designed. BESPOKE_WEIGHT_OFF:
    /// tight, as without a source avatar.
    pub designed_clearance: f64,
    /// Clearance to aim at everywhere, in addition to the designed one, in the target's unit, from 0 to half the size
    /// of the target skeleton. What is nearer is pushed away, what is farther is drawn in. Default 0.
    pub offset: f64,
    /// Where a source avatar is given and no fit weights: what was designed farther away from it than this fits less, and not
    /// at all from twice this distance on. Default 0.1. BESPOKE_WEIGHT_OFF: the garment fits as a whole.
    pub fit_distance: f64,
    /// Weight of pins (bespoke_session_set_pinned_vertices), which are springs. Default 1000.
    pub pin_weight: f64,
    /// Weld distance: open seams of the garment whose sides are nearer than this share of its mean edge are closed [up to
    /// 0.25]. Default 0.01. BESPOKE_WEIGHT_OFF: only vertices at equal positions are welded.
    pub weld_distance: f64,
    /// Bytes that the session may take at most. Default: no limit. What a session needs is estimated from the sizes of
    /// its meshes before it begins, and checked again during the run.
    pub memory_limit: u64,
    /// 1: a garment that intersects itself at the start is refused. Default 0: the triangles that do so are exempted
    /// from contact until they separate and named by bespoke_session_read_diagnostics; none are added later. So is a target
    /// that faces another way than the source, which is turned by default.
    pub strict: u32,
    /// 1: triangles that close an opening where a bone leaves the garment, as at neck, waist, cuffs and hems, stay, and the
    /// garment is refused for them. Default 0: they are left out while it is fitted, go with their rim, and are named by
    /// bespoke_session_read_diagnostics. They are not verified: the body passes through them.
    pub keep_caps: u32,
    /// Expert. Weight of the surface term, which keeps the design's shape. Default 1.
    pub surface_weight: f64,
    /// Expert. Weight of the curvature of boundary curves. Default 2.5. BESPOKE_WEIGHT_OFF possible.
    pub curvature_weight: f64,
    /// Expert. Weight of the torsion of boundary curves. Default 2.5. BESPOKE_WEIGHT_OFF possible.
    pub torsion_weight: f64,
    /// Expert. Weight of the positions of cuffs, hems and collars along their bones. Default 10. BESPOKE_WEIGHT_OFF
    /// possible.
    pub position_weight: f64,
    /// Expert. Weight of the contact barrier, on squared distances [1, 1e14]. Default 1e8.
    pub barrier_weight: f64,
    /// Expert. Distance at which the barrier begins [1e-5, 0.1]. Default 0.002.
    pub dhat: f64,
    /// Expert. While the avatar grows: distance to it at which the barrier begins [1e-5, 0.1]. Default 0.01.
    pub inflation_dhat: f64,
    /// Expert. While the avatar grows: weight of the contact barrier [1, 1e14]. Default 1e4.
    pub inflation_barrier_weight: f64,
    /// Expert. Edge of a voxel of the distance field [1e-3, 0.2]. Default 0.01.
    pub voxel_size: f64,
    /// Expert. Minimum separation: distance that no contact pair ever falls below [1e-8, 0.01], less than half of
    /// `dhat` and of `inflation_dhat`. Default 1e-5.
    pub min_separation: f64,
    /// Expert. The fit ends where two Newton steps in turn have a squared Newton decrement, twice what the step promises to
    /// gain, below this share of the objective [1e-12, 1]. Default 1e-3.
    pub tolerance: f64,
    /// Expert. Largest number of Newton iterations of each stage. Default 500.
    pub max_iterations: u32,
    /// Expert. One of BespokeSurfaceForm. Default BESPOKE_SURFACE_FORM_SIMILARITY.
    pub surface_form: u32,
    /// Expert. Distance across two triangles at which they weigh their area in the surface term [up to 1]. Smaller ones weigh
    /// more, so that the fit is the same at every resolution of the garment. Default 0.048. BESPOKE_WEIGHT_OFF: all weigh
    /// their area, as printed in the paper.
    pub surface_length: f64,
    /// Expert. Distance along a boundary curve between the points from which the curvature and torsion terms read its bends
    /// [up to 1], a share of its length at most. So a V stays a V at every resolution of the garment. Default 0.08.
    /// BESPOKE_WEIGHT_OFF: from its vertices, as printed in the paper.
    pub curve_chord: f64,
}

// SAFETY: repr(C) of u32 pairs and 64-bit numbers without padding.
unsafe impl Sized32 for BespokeOptions {
    // The artist's part is enough: a caller that knows no other leaves the solver at its defaults.
    const FIRST_SIZE: usize = offset_of!(BespokeOptions, surface_weight);
}

/// An option: as it crosses, and as the library holds it.
trait Crossing: Sized {
    /// Its type in C.
    type C;

    /// The value for `given`: `default` for zero, and `off`, where there is one, for BESPOKE_WEIGHT_OFF.
    ///
    /// # Errors
    /// `InvalidArgument` with the `name`, where `given` is not a value of the option.
    fn read(given: Self::C, default: Self, off: Option<Self>, name: &str) -> Result<Self>;

    /// The same value in C.
    fn write(self) -> Self::C;
}

impl Crossing for f64 {
    type C = f64;

    fn read(given: f64, default: f64, off: Option<f64>, _: &str) -> Result<f64> {
        match off {
            Some(off) if given == BESPOKE_WEIGHT_OFF => Ok(off),
            _ => Ok(if given == 0.0 { default } else { given }),
        }
    }

    fn write(self) -> f64 {
        self
    }
}

impl Crossing for u32 {
    type C = u32;

    fn read(given: u32, default: u32, _: Option<u32>, _: &str) -> Result<u32> {
        Ok(if given == 0 { default } else { given })
    }

    fn write(self) -> u32 {
        self
    }
}

impl Crossing for u64 {
    type C = u64;

    fn read(given: u64, default: u64, _: Option<u64>, _: &str) -> Result<u64> {
        Ok(if given == 0 { default } else { given })
    }

    fn write(self) -> u64 {
        self
    }
}

fn refuse<T>(name: &str, given: u32, range: &str) -> Result<T> {
    Err(Error::new(ErrorKind::InvalidArgument, format!("option {name} is {given}; it must be {range}")))
}

/// False is the default of every flag.
impl Crossing for bool {
    type C = u32;

    fn read(given: u32, _: bool, _: Option<bool>, name: &str) -> Result<bool> {
        match given {
            0 => Ok(false),
            1 => Ok(true),
            _ => refuse(name, given, "0 or 1"),
        }
    }

    fn write(self) -> u32 {
        self.into()
    }
}

impl Crossing for SurfaceForm {
    type C = u32;

    fn read(given: u32, _: SurfaceForm, _: Option<SurfaceForm>, name: &str) -> Result<SurfaceForm> {
        match given {
            0 => Ok(SurfaceForm::Similarity),
            1 => Ok(SurfaceForm::Printed),
            _ => refuse(name, given, "one of BespokeSurfaceForm"),
        }
    }

    fn write(self) -> u32 {
        match self {
            SurfaceForm::Similarity => BespokeSurfaceForm::Similarity as u32,
            SurfaceForm::Printed => BespokeSurfaceForm::Printed as u32,
        }
    }
}

macro_rules! cross {
    ($(
        $(#[$doc:meta])*
        $name:ident: $kind:ty = $default:expr $(, in $range:expr)? $(, off = $off:expr)?;
    )*) => {
        impl BespokeOptions {
            pub(super) fn to_options(self) -> Result<Options> {
                let default = Options::default();
                let options = Options {
                    $($name: {
                        let switched_off = None::<$kind>$(.or(Some($off)))?;
                        Crossing::read(self.$name, default.$name, switched_off, stringify!($name))?
                    },)*
                };
                Ok(options)
            }

            fn from_options(options: Options) -> Self {
                Self {
                    struct_size: size_of::<Self>() as u32,
                    $($name: options.$name.write(),)*
                }
            }
        }
    };
}
option_table!(cross);

/// Replaces all options by these.
///
/// State: SETUP. Errors: INVALID_ARGUMENT (null, struct_size, or an option out of its range, which the message names),
/// INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_set_options(
    session: *mut BespokeSession,
    options: *const BespokeOptions,
) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe { call(session, |session| session.set_options(sized::read(options, "options")?.to_options()?)) }
}

/// Fills a struct of options with the defaults written out. The caller sets `struct_size` first.
///
/// Errors: INVALID_ARGUMENT (null or struct_size). Threads: any, at any time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_options_read_defaults(options: *mut BespokeOptions) -> BespokeStatus {
    let filled = BespokeOptions::from_options(Options::default());
    // SAFETY: passed on from the caller.
    match unsafe { sized::write(filled, options, "options") } {
        Ok(()) => BespokeStatus::Ok,
        Err(error) => error.kind.into(),
    }
}
