//! What is tried where the inflation has stalled: other settings of the contact, one after the other, from the beginning.
//!
//! A garment that stalls is rarely as tight as that. Mostly one or two pairs of primitives have come near the minimum
//! separation, where any step that slides or turns them brings them below it: d-hat and the barrier's weight were so that
//! nothing kept them farther apart. The next steps are cut to nothing, and t creeps, while the barrier as a whole costs
//! almost nothing. With a narrow and stiff barrier, or a soft one, the garment goes another way, on which they do not meet.
//! Which of them helps cannot be seen beforehand; the order was found by measuring.
//!
//! A garment that is as tight as that stalls at one share of the avatar's size whatever is tried: where two parts of the avatar come
//! together that have it between them. Only a wide barrier leads out of such a place: it pushes the cloth out before that closes. So
//! where the first attempt has stalled at one, and that with a wide barrier at one again, the others would as well. Elsewhere a place
//! at which an attempt has stalled tells of the next, which is over once it lingers there.

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

/// Factors on d-hat and weight of the first attempt, in the order in which they are tried, and where the first stalls at a place that
/// is shut.
const FACTORS: [[f64; 2]; 4] = [[0.2, 1e4], [1.0, 0.1], [1.0, 100.0], WIDE];
const FACTORS_SHUT: [[f64; 2]; 4] = [WIDE, [0.2, 1e4], [1.0, 100.0], [1.0, 0.1]];
const WIDE: [f64; 2] = [2.0, 1.0];
const AS_GIVEN: [f64; 2] = [1.0, 1.0];
/// No other attempt begins after so many iterations in all.
const MOST_ITERATIONS: u32 = 1000;
/// Two attempts stalled at one place where t differs by less than this share of what is missing to 1.
const SAME_PLACE: f64 = 0.02;
/// So many attempts that stalled at one place are enough: where that is shut, and where not.
const ENOUGH_SHUT: usize = 3;
const ENOUGH: usize = 4;

/// The ranges of the two options.
const DHAT: [f64; 2] = [1e-5, 0.1];
const WEIGHT: [f64; 2] = [1.0, 1e14];

/// Where an attempt stalled.
#[derive(Clone, Copy, Debug)]
pub struct Stall {
    /// How far the avatar grew.
    pub t: f64,
    /// Iterations so far, of all attempts.
    pub iterations: u32,
    /// What holds the garment there most are two parts of the avatar that touch each other at full size.
    pub is_shut: bool,
}

/// The attempts of one inflation beside the first.
#[derive(Debug, Default)]
pub struct Attempts {
    begun: usize,
    /// Where each of them stalled, the first included.
    places: Vec<f64>,
    /// The first of all stalled at a place that is shut.
    is_shut: bool,
    /// The factors of the last one that was begun.
    factors: [f64; 2],
    /// Its settings.
    settings: Option<Settings>,
}

impl Attempts {
    /// The settings of the attempt under way; none where that is the first, with the caller's.
    pub fn settings(&self) -> Option<Settings> {
        self.settings
    }

    /// Where attempts have stalled before.
    pub fn places(&self) -> &[f64] {
        &self.places
    }

    /// Whether the attempt under way may linger at such a place: with a wide barrier the cloth may come out of it in the end.
    pub fn may_linger(&self) -> bool {
        self.factors == WIDE
    }

    /// The settings of the next attempt, after one that ended with `stall`. `options` and `distances` are those of the first;
    /// `untangled` where the garment was pulled apart for it. None where all were tried, or the others would stall there as well.
    pub fn next(
        &mut self,
        options: &Options,
        distances: &ContactDistances,
        stall: Stall,
        untangled: bool,
    ) -> Option<Settings> {
        self.places.push(stall.t);
        let here = self.places.iter().filter(|&&place| (place - stall.t).abs() <= SAME_PLACE * (1.0 - stall.t)).count();
        if here >= if stall.is_shut { ENOUGH_SHUT } else { ENOUGH } {
            return None;
        }
        match self.begun {
            0 => self.is_shut = stall.is_shut,
            1 if self.is_shut && stall.is_shut => return None,
            _ => {}
        }
        // What was pulled apart begins as designed after one other attempt: it may be in the way of itself. Where the place is shut
        // it does so at once.
        let (as_designed, factors) = match (self.is_shut, untangled, self.begun) {
            (true, _, k) => (untangled, *FACTORS_SHUT.get(k)?),
            (false, true, 0) => (false, FACTORS[0]),
            (false, true, 1) => (true, AS_GIVEN),
            (false, true, k) => (true, *FACTORS.get(k - 2)?),
            (false, false, k) => (false, *FACTORS.get(k)?),
        };
        let [dhat, weight] = factors;
        if stall.iterations >= MOST_ITERATIONS {
            return None;
        }
        self.begun += 1;
        self.factors = factors;
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
        (self.factors != AS_GIVEN).then_some(Diagnostic::SettingsAdjusted {
            stalled_at: *self.places.first()?,
            attempts: self.begun + 1,
            inflation_dhat: settings.inflation_dhat,
            inflation_barrier_weight: settings.inflation_barrier_weight,
        })
    }
}
