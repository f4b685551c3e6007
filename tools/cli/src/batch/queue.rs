//! Which pair comes next.
//!
//! - Each avatar is dressed once before one is dressed again: that shows how long it takes, and early what is wrong with its file.
//! - Then the one that will take longest, so that all processes end at about the same time. Who is at it stays, for it is prepared,
//!   until it wears all outfits that a process keeps in mind; these are then put on the others.
//! - The last pairs get the cores that have nothing else to do.

use std::collections::HashMap;
use std::sync::{Mutex, MutexGuard, PoisonError};

use super::manifest::Pair;
use crate::known_outfits::MOST;

/// The pairs that nobody has begun yet.
pub struct Queue<'a> {
    jobs: usize,
    state: Mutex<State<'a>>,
}

struct State<'a> {
    left: Vec<&'a Pair>,
    avatars: HashMap<&'a str, Avatar>,
}

/// What is known of an avatar.
#[derive(Default)]
struct Avatar {
    /// Processes that are at it.
    at: usize,
    is_begun: bool,
    /// Pairs that have ended, and the seconds that they took.
    ended: usize,
    seconds: f64,
}

/// What a process has at hand.
#[derive(Default)]
pub struct AtHand<'a> {
    avatar: Option<&'a str>,
    /// It has only looked at that avatar, and may go to another one.
    has_only_looked: bool,
    outfits: Vec<&'a str>,
}

/// A pair to be dressed.
pub struct Task<'a> {
    /// Which.
    pub pair: &'a Pair,
    /// With so many threads.
    pub threads: usize,
}

impl<'a> Queue<'a> {
    /// All of `pairs`, for so many processes.
    pub fn new(pairs: &[&'a Pair], jobs: usize) -> Self {
        let mut avatars: HashMap<&str, Avatar> = HashMap::new();
        for pair in pairs {
            avatars.entry(&pair.avatar).or_default();
        }
        Self { jobs, state: Mutex::new(State { left: pairs.to_vec(), avatars }) }
    }

    /// A pair has ended, now or in a run before, and took so long.
    pub fn ended(&self, pair: &Pair, seconds: f64) {
        if let Some(avatar) = self.lock().avatars.get_mut(pair.avatar.as_str()) {
            avatar.is_begun = true;
            avatar.ended += 1;
            avatar.seconds += seconds;
        }
    }

    /// The next pair for one who has this `at_hand`.
    pub fn next(&self, at_hand: &mut AtHand<'a>) -> Option<Task<'a>> {
        let mut state = self.lock();
        let State { left, avatars } = &mut *state;
        if let Some(avatar) = at_hand.avatar.and_then(|avatar| avatars.get_mut(avatar)) {
            avatar.at -= 1;
        }
        let long = seconds_left(left, avatars);
        let stage = |pair: &Pair| {
            let is_new = self.jobs > 1 && !avatars[pair.avatar.as_str()].is_begun;
            let is_here = at_hand.avatar == Some(&pair.avatar) && !at_hand.has_only_looked;
            let is_known = at_hand.outfits.len() < MOST || at_hand.outfits.contains(&pair.outfit.as_str());
            match (is_new, is_known, is_here) {
                (true, ..) => Stage::New,
                (_, true, true) => Stage::Here,
                (_, true, false) => Stage::ElsewhereKnown,
                (_, false, true) => Stage::NextOutfits,
                (_, false, false) => Stage::NextOutfitsElsewhere,
            }
        };
        let at = |pair: &Pair| avatars[pair.avatar.as_str()].at;
        let long = |pair: &Pair| long[pair.avatar.as_str()];
        let order = |a: &Pair, b: &Pair| {
            stage(a).cmp(&stage(b)).then(at(a).cmp(&at(b))).then_with(|| long(b).total_cmp(&long(a)))
        };
        let Some(place) = (0..left.len()).min_by(|&j, &k| order(left[j], left[k])) else {
            at_hand.avatar = None;
            return None;
        };
        let stage = stage(left[place]);
        let pair = left.remove(place);
        if stage >= Stage::NextOutfits {
            at_hand.outfits.clear();
        }
        if !at_hand.outfits.contains(&pair.outfit.as_str()) {
            at_hand.outfits.push(&pair.outfit);
        }
        (at_hand.avatar, at_hand.has_only_looked) = (Some(pair.avatar.as_str()), stage == Stage::New);
        let avatar = avatars.entry(&pair.avatar).or_default();
        avatar.at += 1;
        avatar.is_begun = true;
        Some(Task { pair, threads: (self.jobs / (left.len() + 1)).max(1) })
    }

    fn lock(&self) -> MutexGuard<'_, State<'a>> {
        // It is whole at any time.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Where a pair is from a process, the best first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Stage {
    /// On an avatar that nobody has dressed.
    New,
    /// On the avatar at hand.
    Here,
    /// Of an outfit at hand.
    ElsewhereKnown,
    /// On the avatar at hand, with which other outfits are begun.
    NextOutfits,
    NextOutfitsElsewhere,
}

/// How long what is left on each avatar will take. One of which nothing is known is like the others.
fn seconds_left<'a>(left: &[&'a Pair], avatars: &HashMap<&'a str, Avatar>) -> HashMap<&'a str, f64> {
    // Added up in an order that is always the same.
    let mut known: Vec<(&str, &Avatar)> = avatars.iter().map(|(name, avatar)| (*name, avatar)).collect();
    known.sort_by_key(|(name, _)| *name);
    let mean = |seconds: f64, ended: usize| if ended > 0 { Some(seconds / ended as f64) } else { None };
    let seconds = known.iter().map(|(_, avatar)| avatar.seconds).sum();
    let all = mean(seconds, known.iter().map(|(_, avatar)| avatar.ended).sum()).unwrap_or(1.0);
    let mut long: HashMap<&str, f64> = HashMap::new();
    for pair in left {
        let avatar = &avatars[pair.avatar.as_str()];
        *long.entry(&pair.avatar).or_default() += mean(avatar.seconds, avatar.ended).unwrap_or(all);
    }
    long
}
