//! Which pair comes next: one of the avatar that is prepared, as long as there is one.

use std::collections::HashMap;
use std::sync::{Mutex, PoisonError};

use super::manifest::Pair;

/// The pairs that nobody has begun yet.
pub struct Queue<'a>(Mutex<State<'a>>);

struct State<'a> {
    left: Vec<&'a Pair>,
    /// How many are at each avatar.
    at: HashMap<&'a str, usize>,
}

impl<'a> Queue<'a> {
    /// All of `pairs`.
    pub fn new(pairs: &[&'a Pair]) -> Self {
        Self(Mutex::new(State { left: pairs.to_vec(), at: HashMap::new() }))
    }

    /// The next pair for one who has dressed `last`. It is on the same avatar if there is one left; else on the avatar at which
    /// the fewest are, and of these the one with the most pairs left, so that all end at about the same time.
    pub fn next(&self, last: Option<&'a Pair>) -> Option<&'a Pair> {
        let mut state = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let State { left, at } = &mut *state;
        let same = last.and_then(|last| left.iter().position(|pair| pair.avatar == last.avatar));
        let place = same.or_else(|| {
            let left_on = |avatar: &str| left.iter().filter(|pair| pair.avatar == avatar).count();
            let rank =
                |pair: &Pair| (at.get(pair.avatar.as_str()).copied().unwrap_or(0), usize::MAX - left_on(&pair.avatar));
            (0..left.len()).min_by_key(|&k| rank(left[k]))
        });
        if let Some(at) = last.and_then(|last| at.get_mut(last.avatar.as_str())) {
            *at -= 1;
        }
        let pair = left.remove(place?);
        *at.entry(&pair.avatar).or_default() += 1;
        Some(pair)
    }
}
