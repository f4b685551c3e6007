//! Errors: a kind for programs and a message for people.

use std::fmt;

/// The class of a failure. Each has one status code in the C API.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ErrorKind {
    /// An argument is null, out of range or of the wrong size.
    InvalidArgument,
    /// The call does not fit the state of the session.
    InvalidState,
    /// A mesh cannot be used: no vertices, an index out of range, a coordinate that is not finite.
    InvalidMesh,
    /// A skeleton cannot be used, or the two skeletons do not share a topology.
    InvalidSkeleton,
    /// Skin or fit weights have the wrong shape or hold bad values.
    InvalidWeights,
    /// The garment intersects itself at the start, and the option `strict` is set.
    SelfIntersection,
    /// The garment does not enclose the skeleton: the avatar, shrunk onto its bones, penetrates it.
    NotEnclosed,
    /// The avatar could not be inflated to its full size without an intersection.
    InflationStalled,
    /// The exact verifier found an intersection in the result as the caller would read it.
    NotVerified,
    /// The result is verified, but limbs or pieces of it are elsewhere or of another size than in the design.
    ImplausibleResult,
    /// Cancelled by the caller.
    Cancelled,
    /// The session would take more memory than its limit.
    MemoryLimit,
    /// The session could not start even one thread: the process, its user or the machine has as many as it may have.
    NoThread,
    /// A numerical or internal failure: a defect of this library.
    Internal,
}

/// A failure: its class, and one sentence that says what, where, which element, and what to do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    /// The class of the failure.
    pub kind: ErrorKind,
    /// One sentence for a person.
    pub message: String,
}

impl Error {
    /// A failure of `kind`, described by `message`.
    pub fn new(kind: ErrorKind, message: impl Into<String>) -> Self {
        Self { kind, message: message.into() }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Error {}

/// A value, or why there is none.
pub type Result<T, E = Error> = std::result::Result<T, E>;
