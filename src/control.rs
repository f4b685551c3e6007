//! Progress and cancellation: the one part of a session that any thread may use at any time.
//!
//! A request to stop travels one way. Long work is given a cancellation token, [`Cancel`]: long-lived objects when they
//! are made, functions as an argument, before those that they write to. It checks the token and returns [`Cancelled`],
//! an error that its callers pass on with `?`.
//!
//! The session writes a [`Progress`] after each iteration; readers take a consistent copy. No thread waits for another:
//! the writer fills the oldest slot of a ring and then publishes it as the latest (a sequence lock for each slot), so
//! that a preempted writer blocks no reader, and readers never block the writer.

use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering, fence};

use crate::error::{Error, ErrorKind};

/// The stage of a session.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u32)]
pub enum Stage {
    /// SETUP: takes inputs; nothing is computed yet.
    #[default]
    Setup = 0,
    /// PREPARE is done: the avatar is projected onto the source skeleton.
    Prepared = 1,
    /// INFLATE: the avatar grows to its full size inside the garment.
    Inflate = 2,
    /// FIT: the garment is fitted to the full-size avatar.
    Fit = 3,
    /// VERIFY: the exact verifier checks the result.
    Verify = 4,
    /// DONE: the result is final and verified.
    Done = 5,
    /// FAILED: a call failed for good; the last state of the garment can still be read.
    Failed = 6,
    /// CANCELLED: the caller asked to stop; the last state of the garment can still be read.
    Cancelled = 7,
    /// REPOSE: the avatar goes from the pose of the design to its own, between INFLATE and FIT.
    Repose = 8,
}

impl Stage {
    /// The stage with number `code`, if there is one.
    pub fn from_code(code: u64) -> Option<Self> {
        use Stage::*;
        [Setup, Prepared, Inflate, Fit, Verify, Done, Failed, Cancelled, Repose]
            .into_iter()
            .find(|stage| *stage as u64 == code)
    }
}

/// How many energy terms a [`Progress`] can hold.
pub const MAX_TERMS: usize = 12;

/// The progress of a session. Lengths are in normalised coordinates.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Progress {
    /// The stage that is running, or that ended the run.
    pub stage: Stage,
    /// Inflation parameter: 0 is the avatar shrunk onto the source skeleton, 1 the target avatar.
    pub t: f64,
    /// Iterations of the current stage so far.
    pub iteration: u32,
    /// The objective, all its terms weighted.
    pub energy: f64,
    /// Euclidean norm of the objective's gradient.
    pub gradient_norm: f64,
    /// Smallest distance of a contact pair; infinite where there is none.
    pub min_distance: f64,
    /// Contact pairs closer than d-hat.
    pub active_contacts: u64,
    /// Seconds spent so far in prepare, inflate, fit and verify.
    pub seconds: [f64; 4],
    /// How many of `energies` are in use.
    pub energy_count: u32,
    /// Weighted value of each term, in the order of the session's report.
    pub energies: [f64; MAX_TERMS],
}

/// 64-bit words that a [`Progress`] takes: eight single values, four times, the terms.
const WORDS: usize = 12 + MAX_TERMS;

impl Progress {
    fn to_words(self) -> [u64; WORDS] {
        let mut words = [0; WORDS];
        words[0] = self.stage as u64;
        words[1] = self.t.to_bits();
        words[2] = u64::from(self.iteration);
        words[3] = self.energy.to_bits();
        words[4] = self.gradient_norm.to_bits();
        words[5] = self.min_distance.to_bits();
        words[6] = self.active_contacts;
        words[7] = u64::from(self.energy_count);
        for (word, value) in words[8..].iter_mut().zip(self.seconds.iter().chain(&self.energies)) {
            *word = value.to_bits();
        }
        words
    }

    fn from_words(words: &[u64; WORDS]) -> Self {
        Self {
            stage: Stage::from_code(words[0]).unwrap_or_default(),
            t: f64::from_bits(words[1]),
            iteration: words[2] as u32,
            energy: f64::from_bits(words[3]),
            gradient_norm: f64::from_bits(words[4]),
            min_distance: f64::from_bits(words[5]),
            active_contacts: words[6],
            energy_count: words[7] as u32,
            seconds: std::array::from_fn(|k| f64::from_bits(words[8 + k])),
            energies: std::array::from_fn(|k| f64::from_bits(words[12 + k])),
        }
    }
}

/// The error of work that was stopped on request. Its outputs are unusable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cancelled;

impl fmt::Display for Cancelled {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("cancelled on request")
    }
}

impl std::error::Error for Cancelled {}

impl From<Cancelled> for Error {
    fn from(cancelled: Cancelled) -> Self {
        Self::new(ErrorKind::Cancelled, cancelled.to_string())
    }
}

/// The cancellation token: long work checks it between its kernels, and in the loops of long kernels. Clones share one
/// flag; once set, it stays set.
#[derive(Clone, Debug, Default)]
pub struct Cancel(Arc<AtomicBool>);

impl Cancel {
    /// A token that is not set.
    pub fn new() -> Self {
        Self::default()
    }

    /// Requests all work with this token to stop.
    pub fn request(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether a stop was requested.
    #[inline]
    pub fn is_requested(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// A checkpoint.
    ///
    /// # Errors
    /// [`Cancelled`] where a stop was requested.
    #[inline]
    pub fn check(&self) -> Result<(), Cancelled> {
        if self.is_requested() { Err(Cancelled) } else { Ok(()) }
    }
}

/// Slots of the ring. A reader has to retry only where the writer went around the ring while it read.
const SLOTS: usize = 4;
/// The stamp of a slot that is being written.
const UNFINISHED: u64 = u64::MAX;

/// A slot: a progress record and its number.
#[derive(Debug)]
struct Slot {
    stamp: AtomicU64,
    words: [AtomicU64; WORDS],
}

/// Requests to cancel and the progress record of one session; shared with every thread that watches it.
#[derive(Debug)]
pub struct Control {
    /// Requests to stop since the last [`Control::clear_cancel`].
    requests: AtomicU64,
    /// Number of the last complete record, which is in slot `latest % SLOTS`.
    latest: AtomicU64,
    slots: [Slot; SLOTS],
}

impl Default for Control {
    fn default() -> Self {
        let words = Progress::default().to_words();
        let slots = std::array::from_fn(|_| Slot { stamp: AtomicU64::new(0), words: words.map(AtomicU64::new) });
        Self { requests: AtomicU64::new(0), latest: AtomicU64::new(0), slots }
    }
}

impl Control {
    /// No stop requested, progress at [`Stage::Setup`].
    pub fn new() -> Self {
        Self::default()
    }

    /// Asks the session to stop. One atomic addition: a signal handler may call it.
    #[inline]
    pub fn cancel(&self) {
        self.requests.fetch_add(1, Ordering::Release);
    }

    /// Number of requests to stop since the last [`Control::clear_cancel`].
    #[inline]
    pub fn requests(&self) -> u64 {
        self.requests.load(Ordering::Acquire)
    }

    /// Whether a stop was requested since the last [`Control::clear_cancel`].
    #[inline]
    pub fn is_cancelled(&self) -> bool {
        self.requests() > 0
    }

    /// Clears all requests to stop.
    pub fn clear_cancel(&self) {
        self.requests.store(0, Ordering::Release);
    }

    /// Publishes a progress record. For one thread at a time, the one that works in the session.
    pub fn publish(&self, progress: &Progress) {
        let number = self.latest.load(Ordering::Relaxed) + 1;
        let slot = &self.slots[number as usize % SLOTS];
        slot.stamp.store(UNFINISHED, Ordering::Relaxed);
        // No reader may see changed words before the changed stamp.
        fence(Ordering::Release);
        for (slot, word) in slot.words.iter().zip(progress.to_words()) {
            slot.store(word, Ordering::Relaxed);
        }
        slot.stamp.store(number, Ordering::Release);
        self.latest.store(number, Ordering::Release);
    }

    /// A copy of the last complete progress record.
    pub fn progress(&self) -> Progress {
        loop {
            let number = self.latest.load(Ordering::Acquire);
            let slot = &self.slots[number as usize % SLOTS];
            if slot.stamp.load(Ordering::Acquire) == number {
                let words = std::array::from_fn(|k| slot.words[k].load(Ordering::Relaxed));
                fence(Ordering::Acquire);
                if slot.stamp.load(Ordering::Relaxed) == number {
                    return Progress::from_words(&words);
                }
            }
            // The writer has reused this slot meanwhile, so newer complete records exist: retry.
        }
    }
}
