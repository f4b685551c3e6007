//! What is tried where the inflation has stalled: other settings of the contact, one after the other, from the beginning.
//!
//! A garment that stalls is rarely as tight as that. Mostly one or two pairs of primitives have come near the minimum
//! separation, where any step that slides or turns them brings them below it: d-hat and the barrier's weight were so that
//! nothing kept them farther apart. The next steps are cut to nothing, and t creeps, while the barrier as a whole costs
//! almost nothing. With a narrow and stiff barrier, or a soft one, the garment goes another way, on which they do not meet.
//! Which of them helps cannot be seen beforehand; the order was found by measuring.

use super::setup::contact_distances::ContactDistances;
use crate::input::diagnostic::Diagnostic;
use crate::options::Options;

/// Settings of the contact while the avatar grows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Distance to the avatar at which the barrier begins.
    pub inflation_dhat: f64,
    /// Weight of the barrier.
    pub inflation_barrier_weight: f64,
    /// The garment begins as designed, and not pulled apart where it passes through itself.
    pub as_designed: bool,
}

/// Factors on d-hat and weight of the first attempt, in the order in which they are tried.
const FACTORS: [[f64; 2]; 4] = [[0.2, 1e4], [1.0, 0.1], [1.0, 100.0], [2.0, 1.0]];
/// No other attempt begins after so many iterations in all.
const MOST_ITERATIONS: u32 = 1000;

/// The ranges of the two options.
const DHAT: [f64; 2] = [1e-5, 0.1];
const WEIGHT: [f64; 2] = [1.0, 1e14];

/// The attempts of one inflation beside the first.
#[derive(Debug, Default)]
pub struct Attempts {
    begun: usize,
    /// Where the first one stalled.
    first_t: f64,
    /// The settings of the last one that was begun.
    settings: Option<Settings>,
}

impl Attempts {
    /// The settings of the attempt under way; none where that is the first, with the caller's.
    pub fn settings(&self) -> Option<Settings> {
        self.settings
    }

    /// The settings of the next attempt, after one that stalled at `t`, with so many iterations in all. `options` and
    /// `distances` are those of the first; `untangled` where the garment was pulled apart for it. None where all were tried.
    pub fn next(
        &mut self,
        options: &Options,
        distances: &ContactDistances,
        t: f64,
        iterations: u32,
        untangled: bool,
    ) -> Option<Settings> {
        // What was pulled apart begins as designed after one other attempt: it may be in the way of itself.
        let (as_designed, [dhat, weight]) = match (untangled, self.begun) {
            (true, 1) => (true, [1.0, 1.0]),
            (true, k) if k > 1 => (true, *FACTORS.get(k - 2)?),
            (_, k) => (false, *FACTORS.get(k)?),
        };
        if iterations >= MOST_ITERATIONS {
            return None;
        }
        if self.begun == 0 {
            self.first_t = t;
        }
        self.begun += 1;
        // Never narrower than in the result, unless the caller's is.
        let narrowest = distances.inflation_dhat.min(distances.dhat);
        self.settings = Some(Settings {
            inflation_dhat: (dhat * distances.inflation_dhat).max(narrowest).clamp(DHAT[0], DHAT[1]),
            inflation_barrier_weight: (weight * options.inflation_barrier_weight).clamp(WEIGHT[0], WEIGHT[1]),
            as_designed,
        });
        self.settings
    }

    /// What is said of a result, where it was found with other settings than the caller's.
    pub fn adjustment(&self) -> Option<Diagnostic> {
        let settings = self.settings?;
        // The second attempt on a garment that was pulled apart is with the caller's, on the garment as designed.
        (!settings.as_designed || self.begun > 2).then_some(Diagnostic::SettingsAdjusted {
            stalled_at: self.first_t,
            attempts: self.begun + 1,
            inflation_dhat: settings.inflation_dhat,
            inflation_barrier_weight: settings.inflation_barrier_weight,
        })
    }
}
