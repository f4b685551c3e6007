//! Running a session, from the inputs to a verified result.

use crate::capi::options::BespokeOptions;
use crate::capi::session::{BespokeSession, call};
use crate::capi::sized;
use crate::capi::status::BespokeStatus;
use crate::capi::view::{self, invalid};
use crate::error::{Error, ErrorKind};
use crate::session::{Budget, Stage};

/// The stage of a session.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BespokeStage {
    /// Takes inputs; nothing is computed yet.
    Setup = 0,
    /// Prepare is done: the inputs are checked, and the avatar is shrunk onto the source skeleton.
    Prepared = 1,
    /// The avatar grows to its full size inside the garment, which gives way.
    Inflate = 2,
    /// The garment is fitted to the avatar at its full size.
    Fit = 3,
    /// The exact verifier checks the result.
    Verify = 4,
    /// The result is final and verified.
    Done = 5,
    /// A call failed for good. The last garment can be read.
    Failed = 6,
    /// Cancelled by the caller. The last garment can be read.
    Cancelled = 7,
    /// Between INFLATE and FIT, where a target rig stands in another pose than the source: the avatar goes from the source's
    /// pose to its own, and takes the garment along.
    Repose = 8,
}

impl From<Stage> for BespokeStage {
    fn from(stage: Stage) -> Self {
        match stage {
            Stage::Setup => Self::Setup,
            Stage::Prepared => Self::Prepared,
            Stage::Inflate => Self::Inflate,
            Stage::Fit => Self::Fit,
            Stage::Verify => Self::Verify,
            Stage::Done => Self::Done,
            Stage::Failed => Self::Failed,
            Stage::Cancelled => Self::Cancelled,
            Stage::Repose => Self::Repose,
        }
    }
}

/// Checks the inputs against each other and shrinks the avatar onto the source skeleton. SETUP becomes PREPARED; where
/// it fails or is cancelled, the session stays in SETUP and keeps its inputs. Diagnostics about the inputs can be read
/// with bespoke_session_read_diagnostics, also where it fails.
///
/// State: SETUP, with garment, both skeletons and target avatar set. Errors: INVALID_STATE, INVALID_ARGUMENT (a voxel too
/// small for the avatar), INVALID_MESH (also: too far from the origin for its precision), INVALID_SKELETON (another
/// topology), INVALID_WEIGHTS (a wrong size), SELF_INTERSECTION (with the option strict), NOT_ENCLOSED, MEMORY_LIMIT,
/// NO_THREAD, CANCELLED, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_prepare(session: *mut BespokeSession) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe { call(session, |session| session.prepare()) }
}

/// Continues the run until it ends or the budget is spent, whichever is first.
///
/// `max_iterations`, `max_milliseconds`: the budget, 0 = no limit. It is checked after each iteration, so a step does
/// at least one and may take somewhat longer. `*stage`, unless null: the stage afterwards, one of BespokeStage, also
/// where the step failed (but not with BUSY or a null session). With OK and DONE the result is verified; until then
/// what can be read is a preview. With IMPLAUSIBLE_RESULT the stage is DONE, too: the result is verified, but no longer
/// as designed. State: PREPARED, INFLATE or FIT. Errors: INVALID_STATE (a session that has ended
/// continues only after bespoke_session_reset), INFLATION_STALLED, NOT_VERIFIED, IMPLAUSIBLE_RESULT, MEMORY_LIMIT,
/// CANCELLED, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_step(
    session: *mut BespokeSession,
    max_iterations: u32,
    max_milliseconds: u32,
    stage: *mut u32,
) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe {
        call(session, |session| {
            let outcome = session.step(Budget { iterations: max_iterations, milliseconds: max_milliseconds });
            if !stage.is_null() {
                stage.write(BespokeStage::from(session.stage()) as u32);
            }
            outcome.map(drop)
        })
    }
}

/// Fits a result again: with other options, and with the fit weights, pins and target morph weights that were set since. bespoke_session_step or
/// bespoke_session_run then go on from the result, to another one with the same guarantee, in a small part of the time where
/// little has changed. It is the minimum near to the result that was there; for that from the beginning, call
/// bespoke_session_reset and run.
///
/// `options`: all of them, as in bespoke_session_set_options. Those that are used before the fit have to stay as they were:
/// threads, weld_distance, memory_limit, strict, keep_caps, curve_chord, dhat, inflation_dhat, inflation_barrier_weight,
/// voxel_size, min_separation, surface_form, surface_length. Pieces that the body carries keep their places. DONE becomes
/// FIT; it may be called again before that has ended. What was read of the result (normals, weights, morphs, followers) has
/// to be read again. State: DONE, or FIT after it. Errors: INVALID_ARGUMENT (null, struct_size, an option out of its range or
/// one that has to stay, a pin of a vertex that the garment does not have), INVALID_WEIGHTS (a wrong size), INVALID_STATE
/// (also: the result is in the pose of the design), INFLATION_STALLED (the garment does not let the avatar take the shape that its morph
/// weights ask for), after all of which the result stays; MEMORY_LIMIT, CANCELLED, BUSY,
/// INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_refit(
    session: *mut BespokeSession,
    options: *const BespokeOptions,
) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe { call(session, |session| session.refit(sized::read(options, "options")?.to_options()?)) }
}

/// Runs a session to its end: prepares where needed, then steps. OK means DONE: the result is verified.
/// IMPLAUSIBLE_RESULT means DONE, too, see bespoke_session_step.
///
/// State: as for bespoke_session_prepare or bespoke_session_step. Errors: all of both. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_run(session: *mut BespokeSession) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe {
        call(session, |session| match session.run()? {
            Stage::Done => Ok(()),
            stage => Err(Error::new(ErrorKind::Internal, format!("the run ended in stage {stage:?}"))),
        })
    }
}

/// Pairs of triangles that touch or cross each other.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BespokeIntersections {
    /// Of the garment with itself.
    pub garment_garment: u64,
    /// Those of them that intersected or touched at the start, too: a garment with initial self-intersections may keep
    /// some of them.
    pub initial: u64,
    /// Of the garment with the avatar or its layers.
    pub garment_avatar: u64,
}

/// Counts the intersections of the vertices as they would be read now, with exact predicates.
///
/// `component`: the precision of reading, BESPOKE_COMPONENT_F32 or BESPOKE_COMPONENT_F64. A session that is DONE has,
/// in the precision of its garment, no others than initial self-intersections. State: PREPARED or later. Errors:
/// INVALID_ARGUMENT, INVALID_STATE, CANCELLED (by a request that no call has answered yet; the stage does not change),
/// BUSY, INTERNAL; `*intersections` is written with OK only. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_verify(
    session: *const BespokeSession,
    component: u32,
    intersections: *mut BespokeIntersections,
) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe {
        call(session, |session| {
            if intersections.is_null() {
                return invalid("intersections: the pointer is null".into());
            }
            let counts = session.verify(view::precision(component, "intersections")?)?;
            intersections.write(BespokeIntersections {
                garment_garment: counts.garment_garment,
                initial: counts.initial,
                garment_avatar: counts.garment_avatar,
            });
            Ok(())
        })
    }
}
