//! Words that most names of a rig have in front or behind, such as the character's name or a running number.

use std::collections::{HashMap, HashSet};

use super::tokens::{Words, is_number};
use super::vocabulary::Vocabulary;

/// A word is shared where at least this part of the names has it.
const SHARED: f64 = 0.6;
/// The same for a number, which also tells one joint of a chain from the next, and for a word with a meaning.
const SHARED_NUMBER: f64 = 0.9;
/// Fewer names share nothing.
const LEAST: usize = 4;
/// So many words are taken off at most.
const MOST: usize = 5;

/// The names of a rig's joints, each with fewer of the words that it shares with the others.
pub struct Levels {
    /// The words of all names, for each way to leave words off; the first leaves off none.
    pub words: Vec<Vec<Vec<String>>>,
    /// The words of all names without anything that they share.
    pub bare: Vec<Vec<String>>,
}

impl Levels {
    /// All ways to read `names`.
    pub fn new(names: &[Words], vocabulary: &Vocabulary) -> Self {
        let full: Vec<Vec<String>> = names.iter().map(|name| name.words.clone()).collect();
        let mut front = vec![full];
        while front.len() <= MOST
            && let Some(fewer) = without_first(&front[front.len() - 1], vocabulary)
        {
            front.push(fewer);
        }
        let mut levels = Vec::new();
        let mut bare = Vec::new();
        for words in front {
            let mut at = words;
            for _ in 0..MOST {
                levels.push(at.clone());
                let Some(fewer) = without_last(&at, vocabulary) else { break };
                at = fewer;
            }
            bare = at;
        }
        Self { words: levels, bare }
    }
}

/// The word that most of `words` are, if it may be left off.
fn shared<'a>(words: impl Iterator<Item = Option<&'a String>>, vocabulary: &Vocabulary) -> Option<String> {
    let (mut counts, mut total) = (HashMap::new(), 0usize);
    for word in words.flatten() {
        *counts.entry(word).or_insert(0usize) += 1;
        total += 1;
    }
    let (word, count) = counts.into_iter().max_by_key(|&(word, count)| (count, word))?;
    // What means a part stays: most joints of a hand have `hand` in their names. What means something else is a name where
    // nearly all have it, such as that of an archer.
    let least = match vocabulary.is_known(word) {
        true if vocabulary.is_body(word) => return None,
        true => SHARED_NUMBER,
        false if is_number(word) => SHARED_NUMBER,
        false => SHARED,
    };
    (count >= LEAST && count as f64 >= least * total as f64).then(|| word.clone())
}

fn without_first(names: &[Vec<String>], vocabulary: &Vocabulary) -> Option<Vec<Vec<String>>> {
    // A name that is nothing else keeps it: the root of a biped.
    let word = shared(names.iter().map(|words| words.first()), vocabulary)?;
    let fewer = |words: &Vec<String>| match words.split_first() {
        Some((first, rest)) if *first == word && !rest.is_empty() => rest.to_vec(),
        _ => words.clone(),
    };
    let fewer: Vec<Vec<String>> = names.iter().map(fewer).collect();
    // Where numbers are all that is left, the word was all that they said.
    let say = fewer.iter().filter(|words| words.iter().any(|word| !is_number(word))).count();
    (fewer != names && 2 * say > fewer.len()).then_some(fewer)
}

fn without_last(names: &[Vec<String>], vocabulary: &Vocabulary) -> Option<Vec<Vec<String>>> {
    let word = shared(names.iter().map(|words| words.last()), vocabulary);
    let are_running = are_running(names);
    let fewer = |words: &Vec<String>| match words.split_last() {
        Some((last, rest)) if !rest.is_empty() && (Some(last) == word.as_ref() || (are_running && is_number(last))) => {
            rest.to_vec()
        }
        _ => words.clone(),
    };
    let fewer: Vec<Vec<String>> = names.iter().map(fewer).collect();
    (fewer != names).then_some(fewer)
}

/// Whether nearly all names end in a number that no other name has, as those do that a viewer has numbered.
fn are_running(names: &[Vec<String>]) -> bool {
    let numbers: Vec<&String> = names.iter().filter_map(|words| words.last()).filter(|word| is_number(word)).collect();
    let different: HashSet<&String> = numbers.iter().copied().collect();
    numbers.len() >= 2 * LEAST
        && numbers.len() as f64 >= SHARED_NUMBER * names.len() as f64
        && different.len() as f64 >= 0.95 * numbers.len() as f64
}
