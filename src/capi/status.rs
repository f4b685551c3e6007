//! Status codes, and how the library's errors map to them.

use std::ffi::c_char;

use crate::error::ErrorKind;

/// The outcome of a call.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BespokeStatus {
    /// The call succeeded.
    Ok = 0,
    /// An argument is null, out of range or of the wrong size.
    InvalidArgument = 1,
    /// The call does not fit the state of the session.
    InvalidState = 2,
    /// A mesh cannot be used: no vertices, an index out of range, a coordinate that is not finite.
    InvalidMesh = 3,
    /// A skeleton cannot be used, or the two skeletons do not share a topology.
    InvalidSkeleton = 4,
    /// Skin or fit weights have the wrong shape or hold bad values.
    InvalidWeights = 5,
    /// The garment intersects itself at the start, and the option `strict` is set.
    SelfIntersection = 6,
    /// The garment does not enclose its skeleton, and no path for it inside the garment was found.
    NotEnclosed = 7,
    /// The avatar could not be inflated to its full size without an intersection.
    InflationStalled = 8,
    /// The exact verifier found an intersection in the result.
    NotVerified = 9,
    /// Cancelled by the caller.
    Cancelled = 10,
    /// Another thread is inside a call with the same session. Nothing was done, and the message did not change.
    Busy = 11,
    /// A defect of this library. The session refuses all further calls and can only be destroyed; other sessions are
    /// not affected.
    Internal = 12,
    /// The session would take more memory than the option `memory_limit` allows.
    MemoryLimit = 13,
    /// The session could not start even one thread: the process, its user or the machine has as many as it may have. The
    /// call can be made again.
    NoThread = 14,
    /// There is a result, DONE and verified, but it is not as designed: a limb is shut up in the garment or beside it,
    /// or a piece has lost its size. It can be read like any other; the diagnostics name limbs and pieces.
    ImplausibleResult = 15,
}

impl From<ErrorKind> for BespokeStatus {
    fn from(kind: ErrorKind) -> Self {
        match kind {
            ErrorKind::InvalidArgument => Self::InvalidArgument,
            ErrorKind::InvalidState => Self::InvalidState,
            ErrorKind::InvalidMesh => Self::InvalidMesh,
            ErrorKind::InvalidSkeleton => Self::InvalidSkeleton,
            ErrorKind::InvalidWeights => Self::InvalidWeights,
            ErrorKind::SelfIntersection => Self::SelfIntersection,
            ErrorKind::NotEnclosed => Self::NotEnclosed,
            ErrorKind::InflationStalled => Self::InflationStalled,
            ErrorKind::NotVerified => Self::NotVerified,
            ErrorKind::ImplausibleResult => Self::ImplausibleResult,
            ErrorKind::Cancelled => Self::Cancelled,
            ErrorKind::MemoryLimit => Self::MemoryLimit,
            ErrorKind::NoThread => Self::NoThread,
            ErrorKind::Internal => Self::Internal,
        }
    }
}

/// The name of a status, such as "BESPOKE_STATUS_BUSY"; "BESPOKE_STATUS_UNKNOWN" for any other number.
///
/// `status`: one of BespokeStatus. Ownership: the text is part of the library, never freed. Threads: any, at any time.
#[unsafe(no_mangle)]
pub extern "C" fn bespoke_status_name(status: u32) -> *const c_char {
    let name = match status {
        0 => c"BESPOKE_STATUS_OK",
        1 => c"BESPOKE_STATUS_INVALID_ARGUMENT",
        2 => c"BESPOKE_STATUS_INVALID_STATE",
        3 => c"BESPOKE_STATUS_INVALID_MESH",
        4 => c"BESPOKE_STATUS_INVALID_SKELETON",
        5 => c"BESPOKE_STATUS_INVALID_WEIGHTS",
        6 => c"BESPOKE_STATUS_SELF_INTERSECTION",
        7 => c"BESPOKE_STATUS_NOT_ENCLOSED",
        8 => c"BESPOKE_STATUS_INFLATION_STALLED",
        9 => c"BESPOKE_STATUS_NOT_VERIFIED",
        10 => c"BESPOKE_STATUS_CANCELLED",
        11 => c"BESPOKE_STATUS_BUSY",
        12 => c"BESPOKE_STATUS_INTERNAL",
        13 => c"BESPOKE_STATUS_MEMORY_LIMIT",
        14 => c"BESPOKE_STATUS_NO_THREAD",
        15 => c"BESPOKE_STATUS_IMPLAUSIBLE_RESULT",
        _ => c"BESPOKE_STATUS_UNKNOWN",
    };
    name.as_ptr()
}
