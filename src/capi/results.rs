//! Results of a session: vertices, distortion, report.

use std::ffi::c_char;
use std::mem::{offset_of, size_of};

use glam::DVec3;

use crate::capi::session::{BespokeSession, call};
use crate::capi::sized::{self, Sized32};
use crate::capi::status::BespokeStatus;
use crate::capi::view::{self, BespokeBuffer, invalid};
use crate::error::Result;
use crate::input::buffer::{self, Component, PositionsViewMut};
use crate::session::{Precision, StageReport};

const GARMENT_VERTICES: &str = "garment vertices";
const AVATAR_VERTICES: &str = "avatar vertices";
const DISTORTION: &str = "distortion";

/// # Safety
/// `count` is null or points to a number.
unsafe fn write_count(count: *mut usize, elements: usize) {
    if !count.is_null() {
        // SAFETY: not null, and the caller vouches for a number.
        unsafe { count.write(elements) };
    }
}

/// # Safety
/// `out` is a valid view.
unsafe fn write_points(positions: &[DVec3], out: &PositionsViewMut, name: &str) -> Result<()> {
    if out.capacity == 0 && out.data.is_null() {
        return Ok(());
    }
    // SAFETY: passed on from the caller.
    unsafe { buffer::write_positions(out, positions, name) }
}

/// Writes the garment's current vertices, in the order in which they were set, in the target's coordinate system.
///
/// `points`: where to, F32 or F64. With null data and capacity 0 nothing is written. `*count`, unless null: vertices of
/// the garment, also where they do not fit. State: PREPARED or later. With DONE it is verified in this precision;
/// otherwise it is a preview. Errors: INVALID_ARGUMENT (a capacity that is too small as well; nothing is written then),
/// INVALID_STATE, NOT_VERIFIED (DONE, but clean only in the precision in which the garment was set; nothing is
/// written), BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_read_garment_vertices(
    session: *const BespokeSession,
    points: *const BespokeBuffer,
    count: *mut usize,
) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe {
        call(session, |session| {
            write_count(count, session.garment_positions()?.len());
            let out = view::points_out(points, GARMENT_VERTICES)?;
            let precision = match out.component {
                Component::F32 => Precision::F32,
                Component::F64 => Precision::F64,
            };
            write_points(&session.garment_as_read(precision)?, &out, GARMENT_VERTICES)
        })
    }
}

/// Writes the target avatar's current vertices, without its layers: shrunk onto the source skeleton at first, as they
/// were set at the end.
///
/// `points`, `count`, state, errors, threads: as for bespoke_session_read_garment_vertices.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_read_avatar_vertices(
    session: *const BespokeSession,
    points: *const BespokeBuffer,
    count: *mut usize,
) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe {
        call(session, |session| {
            let positions = session.avatar_positions()?;
            write_count(count, positions.len());
            write_points(&positions, &view::points_out(points, AVATAR_VERTICES)?, AVATAR_VERTICES)
        })
    }
}

/// Writes how much each garment triangle is distorted now, in the order in which the triangles were set: how
/// differently it and its neighbours deform (Eq. 2 of the paper, in the similarity-invariant form, the mean over its
/// edges with a neighbour), over the ratio of the garment's area to that of the design. A number without unit, 0 or
/// above; 0 for any similarity of the garment as a whole, and for triangles without area or neighbours.
///
/// `values`: where to, one number for each triangle (not three), F32 or F64. With null data and capacity 0 nothing is
/// written. `*count`, unless null: triangles of the garment, also where they do not fit. State: PREPARED or later; until DONE
/// it is that of a preview. Errors: INVALID_ARGUMENT (a capacity that is too small as well; nothing is written then),
/// INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_read_distortion(
    session: *const BespokeSession,
    values: *const BespokeBuffer,
    count: *mut usize,
) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe {
        call(session, |session| {
            let distortion = session.distortion()?;
            write_count(count, distortion.len());
            let out = view::points_out(values, DISTORTION)?;
            if out.capacity == 0 && out.data.is_null() {
                return Ok(());
            }
            buffer::write_scalars(&out, &distortion, DISTORTION)
        })
    }
}

/// The cost of one stage.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BespokeStageReport {
    /// Wall-clock seconds.
    pub seconds: f64,
    /// Newton iterations.
    pub iterations: u32,
    /// Numeric factorisations.
    pub factorisations: u32,
    /// Symbolic factorisations.
    pub symbolic_factorisations: u32,
    /// 0.
    pub reserved: u32,
}

impl From<&StageReport> for BespokeStageReport {
    fn from(stage: &StageReport) -> Self {
        Self {
            seconds: stage.seconds,
            iterations: stage.iterations,
            factorisations: stage.factorisations,
            symbolic_factorisations: stage.analyses,
            reserved: 0,
        }
    }
}

/// Measurements of a session so far. Lengths are in the normalised space, in which the longest side of the skeleton's
/// bounding box is 2.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BespokeReport {
    /// sizeof(BespokeReport).
    pub struct_size: u32,
    /// Threads that the session works with: as many as were asked for, but not more than there are cores for the process,
    /// nor than could be started.
    pub threads: u32,
    /// Cost of prepare.
    pub prepare: BespokeStageReport,
    /// Cost of inflate.
    pub inflate: BespokeStageReport,
    /// Cost of fit.
    pub fit: BespokeStageReport,
    /// Wall-clock seconds of the exact verifier.
    pub verify_seconds: f64,
    /// Seconds until the distance field was built, in parallel with inflate.
    pub field_seconds: f64,
    /// Inflation: 0 is the avatar shrunk onto the source skeleton, 1 the target avatar.
    pub t: f64,
    /// Euclidean norm of the objective's gradient.
    pub gradient_norm: f64,
    /// Smallest distance of the garment to itself; infinite where no pair is near.
    pub garment_distance: f64,
    /// Smallest distance of the garment to the avatar and its layers; infinite where no pair is near.
    pub avatar_distance: f64,
    /// Contact pairs closer than dhat.
    pub active_contacts: u64,
    /// Intersecting pairs within the garment that the verifier found.
    pub garment_intersections: u64,
    /// Intersecting pairs of garment and avatar, its layers included, that the verifier found.
    pub avatar_intersections: u64,
    /// Vertices of the garment.
    pub garment_vertices: u64,
    /// Triangles of the garment.
    pub garment_triangles: u64,
    /// Vertices of the target avatar, here and below without its layers.
    pub avatar_vertices: u64,
    /// Triangles of the target avatar.
    pub avatar_triangles: u64,
    /// Vertices of the target avatar once its triangles over several bones are split.
    pub subdivided_avatar_vertices: u64,
    /// Triangles of the target avatar once those over several bones are split.
    pub subdivided_avatar_triangles: u64,
    /// The minimum separation in force: the option's; less while something is nearer than that, more where the
    /// coordinates of the result are coarse.
    pub min_separation: f64,
    /// 1 where the verifier has checked the result, else 0.
    pub is_verified: u32,
    /// 1 where the fit ended by its tolerance, 0 where by the limit of iterations, where no step made it better, or not at all.
    pub is_converged: u32,
    /// Number of energy terms; see bespoke_session_read_energy.
    pub energy_count: u32,
    /// Always 0.
    pub reserved: u32,
    /// Bytes that the session's arrays take, without what the threads and the allocator add.
    pub memory_bytes: u64,
    /// Intersecting or touching pairs within the garment at the start, which are exempted from contact until they
    /// separate.
    pub initial_self_intersections: u64,
    /// Cost of repose, where the target is brought back from the pose of the design to its own; its seconds have those in which
    /// the body there was prepared.
    pub repose: BespokeStageReport,
    /// Wall-clock seconds in which two rigs were read and matched, and the target was posed; they are part of prepare's.
    pub rig_seconds: f64,
}

// SAFETY: repr(C) of u32 pairs and 64-bit numbers, without padding.
unsafe impl Sized32 for BespokeReport {
    const FIRST_SIZE: usize = offset_of!(BespokeReport, memory_bytes);
}

/// Fills a struct with the session's measurements so far. The caller sets `struct_size` first.
///
/// State: any. Errors: INVALID_ARGUMENT (null or struct_size), BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_read_report(
    session: *const BespokeSession,
    report: *mut BespokeReport,
) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe {
        call(session, |session| {
            let own = session.report();
            let intersections = own.verification.unwrap_or_default();
            let filled = BespokeReport {
                struct_size: size_of::<BespokeReport>() as u32,
                threads: own.threads as u32,
                prepare: (&own.prepare).into(),
                inflate: (&own.inflate).into(),
                fit: (&own.fit).into(),
                verify_seconds: own.verify_seconds,
                field_seconds: own.field_seconds,
                t: own.t,
                gradient_norm: own.gradient_norm,
                garment_distance: own.min_distance_self,
                avatar_distance: own.min_distance_avatar,
                active_contacts: own.active_contacts as u64,
                garment_intersections: intersections.garment_garment,
                avatar_intersections: intersections.garment_avatar,
                garment_vertices: own.garment_size[0] as u64,
                garment_triangles: own.garment_size[1] as u64,
                avatar_vertices: own.avatar_size[0] as u64,
                avatar_triangles: own.avatar_size[1] as u64,
                subdivided_avatar_vertices: own.projected_size[0] as u64,
                subdivided_avatar_triangles: own.projected_size[1] as u64,
                min_separation: own.min_separation,
                is_verified: u32::from(own.verification.is_some()),
                is_converged: u32::from(own.converged),
                energy_count: own.terms.len() as u32,
                reserved: 0,
                memory_bytes: own.memory,
                initial_self_intersections: own.initial_self_intersections as u64,
                repose: (&own.repose).into(),
                rig_seconds: own.rig_seconds,
            };
            sized::write(filled, report, "report")
        })
    }
}

/// Bytes of the name in BespokeEnergy, its zero byte included.
pub const BESPOKE_ENERGY_NAME_SIZE: usize = 32;

/// One term of the objective.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BespokeEnergy {
    /// sizeof(BespokeEnergy).
    pub struct_size: u32,
    /// Always 0.
    pub reserved: u32,
    /// Name, such as "surface"; ends with a zero byte.
    pub name: [c_char; BESPOKE_ENERGY_NAME_SIZE],
    /// Value without its weight.
    pub value: f64,
    /// Weight; the term adds weight * value to the objective.
    pub weight: f64,
}

// SAFETY: repr(C) of two u32, bytes and 64-bit numbers, without padding.
unsafe impl Sized32 for BespokeEnergy {}

/// Fills a struct with term `index` of the objective, counted from 0 up to the report's `energy_count`. The caller sets
/// `struct_size` first.
///
/// State: any. Errors: INVALID_ARGUMENT (null, struct_size, or no such term), BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_read_energy(
    session: *const BespokeSession,
    index: u32,
    energy: *mut BespokeEnergy,
) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe {
        call(session, |session| {
            if energy.is_null() {
                return invalid("energy: the pointer is null".into());
            }
            let terms = session.report().terms;
            let Some(term) = terms.get(index as usize) else {
                return invalid(format!("energy: there is no term {index}, the objective has {}", terms.len()));
            };
            let mut name = [0; BESPOKE_ENERGY_NAME_SIZE];
            for (to, from) in name[..BESPOKE_ENERGY_NAME_SIZE - 1].iter_mut().zip(term.name.bytes()) {
                *to = from as c_char;
            }
            let struct_size = size_of::<BespokeEnergy>() as u32;
            let filled = BespokeEnergy { struct_size, reserved: 0, name, value: term.value, weight: term.weight };
            sized::write(filled, energy, "energy")
        })
    }
}
