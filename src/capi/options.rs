//! Options and spaces as C structs in which zero means the default.

use std::mem::{offset_of, size_of};

use crate::capi::session::{BespokeSession, call};
use crate::capi::sized::{self, Sized32};
use crate::capi::status::BespokeStatus;
use crate::error::{Error, ErrorKind, Result};
use crate::options::{Options, SurfaceForm};

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

/// What may be tuned. Zero in a field means its default. Lengths are in the normalised space, in which the longest
/// side of the skeleton's bounding box is 2, where not said otherwise. Weights are finite and not negative, or
/// BESPOKE_WEIGHT_OFF where that is said; other ranges are in brackets. Fields marked "Expert." tune
/// the solver.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BespokeOptions {
    /// sizeof(BespokeOptions).
    pub struct_size: u32,
    /// Threads of this session [1, 1024]. Default: as many as the machine has cores.
    pub threads: u32,
    /// Weight of the fit term, higher is tighter. Default 2. BESPOKE_WEIGHT_OFF: no fit.
    pub fit_weight: f64,
    /// Where a source avatar is given: the clearance that the fit aims at, as a fraction of the one that each point of
    /// the garment had on it [up to 2]. Default 1, as designed. BESPOKE_WEIGHT_OFF: tight, as without a source avatar.
    pub designed_clearance: f64,
    /// Expert. Weight of the surface term, which keeps the design's shape. Default 1.
    pub surface_weight: f64,
    /// Expert. Weight of the curvature of boundary curves. Default 1. BESPOKE_WEIGHT_OFF possible.
    pub curvature_weight: f64,
    /// Expert. Weight of the torsion of boundary curves. Default 1. BESPOKE_WEIGHT_OFF possible.
    pub torsion_weight: f64,
    /// Expert. Weight of the place of cuffs, hems and collars along their bones. Default 10. BESPOKE_WEIGHT_OFF
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
    pub voxel: f64,
    /// Expert. Distance that nothing ever falls below [1e-8, 0.01], less than half of `dhat` and of `inflation_dhat`.
    /// Default 1e-5.
    pub separation_floor: f64,
    /// Expert. The fit ends where the relative Newton decrement falls below this [1e-12, 1]. Default 1e-3.
    pub tolerance: f64,
    /// Expert. Largest number of Newton iterations of each stage. Default 500.
    pub max_iterations: u32,
    /// Expert. One of BespokeSurfaceForm. Default BESPOKE_SURFACE_FORM_SIMILARITY.
    pub surface_form: u32,
    /// Bytes that the session may take at most. Default: no limit. What a session needs is estimated from the sizes of its
    /// meshes before it begins, and looked at again as it goes on.
    pub memory_limit: u64,
    /// 1: a garment that intersects itself at the start is refused. Default 0: the triangles that do so are let off and
    /// named by bespoke_session_read_diagnostics, and no others ever join them.
    pub strict: u32,
    /// 0.
    pub reserved: u32,
    /// Clearance to aim at everywhere, beside the designed one, in the unit of the target space, from 0 to half the size of
    /// the target skeleton. What is nearer is pushed away, what is farther is drawn in. Default 0.
    pub offset: f64,
    /// Where a source avatar is given and no fit weights: what was designed farther away from it than this fits less, and not
    /// at all from twice this distance on. Default 0.1. BESPOKE_WEIGHT_OFF: the garment fits as a whole.
    pub fit_distance: f64,
    /// Weight of pins (bespoke_session_set_pinned_vertices), which are springs. Default 1000.
    pub pin_weight: f64,
}

// SAFETY: repr(C) of u32 pairs and 64-bit numbers without padding.
unsafe impl Sized32 for BespokeOptions {
    const FIRST_SIZE: usize = offset_of!(BespokeOptions, memory_limit);
}

/// `given`, or `default` where it is zero.
fn or_default(given: f64, default: f64) -> f64 {
    if given == 0.0 { default } else { given }
}

/// A weight, or 0 where it is switched off.
fn weight(given: f64, default: f64) -> f64 {
    if given == BESPOKE_WEIGHT_OFF { 0.0 } else { or_default(given, default) }
}

impl BespokeOptions {
    fn to_options(self) -> Result<Options> {
        let default = Options::default();
        let surface_form = match self.surface_form {
            0 => SurfaceForm::Similarity,
            1 => SurfaceForm::Printed,
            other => {
                let message = format!("option surface_form is {other}; it must be one of BespokeSurfaceForm");
                return Err(Error::new(ErrorKind::InvalidArgument, message));
            }
        };
        Ok(Options {
            threads: self.threads,
            fit_weight: weight(self.fit_weight, default.fit_weight),
            designed_clearance: weight(self.designed_clearance, default.designed_clearance),
            offset: self.offset,
            fit_distance: match self.fit_distance {
                BESPOKE_WEIGHT_OFF => f64::INFINITY,
                given => or_default(given, default.fit_distance),
            },
            pin_weight: or_default(self.pin_weight, default.pin_weight),
            surface_weight: weight(self.surface_weight, default.surface_weight),
            curvature_weight: weight(self.curvature_weight, default.curvature_weight),
            torsion_weight: weight(self.torsion_weight, default.torsion_weight),
            position_weight: weight(self.position_weight, default.position_weight),
            barrier_weight: or_default(self.barrier_weight, default.barrier_weight),
            dhat: or_default(self.dhat, default.dhat),
            inflation_dhat: or_default(self.inflation_dhat, default.inflation_dhat),
            inflation_barrier_weight: or_default(self.inflation_barrier_weight, default.inflation_barrier_weight),
            voxel: or_default(self.voxel, default.voxel),
            separation_floor: or_default(self.separation_floor, default.separation_floor),
            tolerance: or_default(self.tolerance, default.tolerance),
            max_iterations: if self.max_iterations == 0 { default.max_iterations } else { self.max_iterations },
            surface_form,
            memory_limit: self.memory_limit,
            strict: match self.strict {
                0 => false,
                1 => true,
                other => {
                    let message = format!("option strict is {other}; it must be 0 or 1");
                    return Err(Error::new(ErrorKind::InvalidArgument, message));
                }
            },
        })
    }
}

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
    let default = Options::default();
    let filled = BespokeOptions {
        struct_size: size_of::<BespokeOptions>() as u32,
        threads: default.threads,
        fit_weight: default.fit_weight,
        designed_clearance: default.designed_clearance,
        surface_weight: default.surface_weight,
        curvature_weight: default.curvature_weight,
        torsion_weight: default.torsion_weight,
        position_weight: default.position_weight,
        barrier_weight: default.barrier_weight,
        dhat: default.dhat,
        inflation_dhat: default.inflation_dhat,
        inflation_barrier_weight: default.inflation_barrier_weight,
        voxel: default.voxel,
        separation_floor: default.separation_floor,
        tolerance: default.tolerance,
        max_iterations: default.max_iterations,
        surface_form: match default.surface_form {
            SurfaceForm::Similarity => BespokeSurfaceForm::Similarity,
            SurfaceForm::Printed => BespokeSurfaceForm::Printed,
        } as u32,
        memory_limit: default.memory_limit,
        strict: u32::from(default.strict),
        reserved: 0,
        offset: default.offset,
        fit_distance: default.fit_distance,
        pin_weight: default.pin_weight,
    };
    // SAFETY: passed on from the caller.
    match unsafe { sized::write(filled, options, "options") } {
        Ok(()) => BespokeStatus::Ok,
        Err(error) => error.kind.into(),
    }
}
