//! Panics on purpose, for tests. The C API has no way to ask for one.
//!
//! Not behind a feature: `make` without it and the tests with it would build two libraries under one name, for the file of
//! a cdylib has no hash in its name. Cargo takes either for fresh, so that `make` could ship the tests' library. A folder
//! of its own for the tests' library would cost building it and everything below it once more.

use rayon::prelude::*;

use super::Session;

/// Where a panic is to happen.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// In the job of `prepare`.
    Prepare,
    /// In the job of an iteration.
    Iteration,
    /// In a parallel loop of an iteration, in whichever thread of the pool.
    Worker,
    /// In the thread that builds the distance field.
    Field,
    /// In the job of the exact verifier.
    Verify,
}

impl Fault {
    /// Panics where `wanted` is this place.
    pub(super) fn at(self, wanted: Option<Fault>) {
        if wanted != Some(self) {
            return;
        }
        if self == Self::Worker {
            (0..256).into_par_iter().for_each(|k| assert!(k != 200, "a fault on purpose: {self:?}"));
        }
        panic!("a fault on purpose: {self:?}");
    }
}

impl Session {
    /// Makes the session panic when it gets there.
    #[doc(hidden)]
    pub fn inject_fault(&mut self, fault: Fault) {
        self.fault = Some(fault);
    }
}
