//! Progress and cancel: the one part of a session that any thread may touch at any time.
//!
//! The session writes a [`Progress`] after each iteration; readers take a copy that belongs to one moment. Nobody
//! waits for a lock: the record is a sequence lock made of atomics only, so a reader that overlaps a write just
//! reads again, and the writer is never held up.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering, fence};

/// Where a session is on its way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u32)]
pub enum Stage {
    /// Takes inputs; nothing is computed yet.
    #[default]
    Setup = 0,
    /// Step 1 is done: the avatar is projected onto the source skeleton.
    Prepared = 1,
    /// Step 2: the avatar grows to its full size inside the garment.
    Inflate = 2,
    /// Step 3: the garment settles onto the avatar.
    Fit = 3,
    /// The exact verifier looks at the result.
    Verify = 4,
    /// The result is final and verified.
    Done = 5,
    /// A call failed for good; what the garment looked like last can still be read.
    Failed = 6,
    /// The caller asked to stop; what the garment looked like last can still be read.
    Cancelled = 7,
}

impl Stage {
    /// The stage with number `code`, if there is one.
    pub fn from_code(code: u64) -> Option<Self> {
        use Stage::*;
        [Setup, Prepared, Inflate, Fit, Verify, Done, Failed, Cancelled].into_iter().find(|stage| *stage as u64 == code)
    }
}

/// How many energy terms a [`Progress`] can hold.
pub const MAX_TERMS: usize = 12;

/// A session at one moment. Lengths are in the normalised space.
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
    /// Smallest distance of a contact pair; infinite where no pair is near.
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

/// Cancel flag and progress record of one session; shared with every thread that watches it.
#[derive(Debug)]
pub struct Control {
    cancel: AtomicBool,
    /// Odd while a write is under way.
    sequence: AtomicU64,
    words: [AtomicU64; WORDS],
}

impl Default for Control {
    fn default() -> Self {
        let words = Progress::default().to_words();
        Self { cancel: AtomicBool::new(false), sequence: AtomicU64::new(0), words: words.map(AtomicU64::new) }
    }
}

impl Control {
    /// No cancel asked for, progress at [`Stage::Setup`].
    pub fn new() -> Self {
        Self::default()
    }

    /// Asks the session to stop at its next checkpoint. One atomic store: a signal handler may call it.
    #[inline]
    pub fn cancel(&self) {
        self.cancel.store(true, Ordering::Release);
    }

    /// Whether somebody asked to stop since the last [`Control::clear_cancel`].
    #[inline]
    pub fn is_cancelled(&self) -> bool {
        self.cancel.load(Ordering::Acquire)
    }

    /// Forgets a request to stop.
    pub fn clear_cancel(&self) {
        self.cancel.store(false, Ordering::Release);
    }

    /// Replaces the progress record. For the session's own thread; a second writer waits for the first.
    pub fn publish(&self, progress: &Progress) {
        let mut even = self.sequence.load(Ordering::Relaxed) & !1;
        while let Err(now) = self.sequence.compare_exchange_weak(even, even + 1, Ordering::Acquire, Ordering::Relaxed) {
            std::hint::spin_loop();
            even = now & !1;
        }
        // The words may not be seen changed before the odd number is.
        fence(Ordering::Release);
        for (slot, word) in self.words.iter().zip(progress.to_words()) {
            slot.store(word, Ordering::Relaxed);
        }
        self.sequence.store(even + 2, Ordering::Release);
    }

    /// A copy of the progress record that was written in one piece.
    pub fn progress(&self) -> Progress {
        loop {
            let before = self.sequence.load(Ordering::Acquire);
            if before & 1 == 0 {
                let words = std::array::from_fn(|k| self.words[k].load(Ordering::Relaxed));
                fence(Ordering::Acquire);
                if self.sequence.load(Ordering::Relaxed) == before {
                    return Progress::from_words(&words);
                }
            }
            // The writer may have lost its processor in the middle of a write.
            std::thread::yield_now();
        }
    }
}
