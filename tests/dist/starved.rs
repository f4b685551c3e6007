//! A host that can start no more threads: the library works with those that it gets, or says that it got none.

use std::ffi::OsStr;
use std::path::Path;

use bespoke::capi::status::BespokeStatus;

use crate::programs::{hash, run_host, run_host_with, starve};
use crate::shipped::libraries;

/// What came out where threads failed.
struct Outcome {
    /// Threads that were asked for meanwhile.
    asked: usize,
    status: u32,
    message: String,
    /// Threads of the process once all sessions had ended.
    left: usize,
    /// Of the result with all threads, made in the same process after it.
    hash: String,
}

/// A session of so many threads while those from `first` to `last` fail, counted from 1 on from when the library is loaded,
/// or once it is.
fn dress(library: &Path, threads: usize, when: &str, first: usize, last: usize) -> Outcome {
    let number = |n: usize| n.to_string();
    let (threads, first, last) = (number(threads), number(first), number(last));
    let words = ["starve".as_ref(), library.as_os_str(), threads.as_ref(), OsStr::new(when)];
    let preload = ("LD_PRELOAD", starve().as_os_str());
    let printed = run_host_with(&words, &[preload, ("STARVE_FIRST", first.as_ref()), ("STARVE_LAST", last.as_ref())]);
    let line = |name: &str| printed.lines().find_map(|line| line.strip_prefix(name)).expect("the host says it");
    let count = |name: &str| line(name).parse().expect("a number");
    let (status, message) = line("status ").split_once(' ').expect("a status and a message");
    Outcome {
        asked: count("asked "),
        status: status.parse().expect("a status"),
        message: message.to_owned(),
        left: count("left "),
        hash: hash(&printed).to_owned(),
    }
}

/// From when on threads may fail. Debian's OpenVDB brings a logger that starts threads while it is loaded, and ends the
/// process where it cannot: what happens before there is a library is not the library's.
fn moments(library: &Path) -> Vec<&'static str> {
    let while_loading = dress(library, 1, "load", 0, 0).asked - dress(library, 1, "work", 0, 0).asked;
    if while_loading > 0 {
        println!("SKIPPED: {} starts {while_loading} threads while it is loaded", library.display());
        return vec!["work"];
    }
    vec!["load", "work"]
}

#[test]
fn whichever_thread_fails_the_host_lives_and_goes_on() {
    const MOST: usize = 50;
    for (name, library) in libraries() {
        let expected = hash(&run_host(&["plain".as_ref(), library.as_os_str()])).to_owned();
        for when in moments(&library) {
            for threads in [1, 3] {
                // One alone, and all from one on.
                for all in [false, true] {
                    let mut first = 1;
                    loop {
                        let last = if all { usize::MAX >> 33 } else { first };
                        let outcome = dress(&library, threads, when, first, last);
                        let about = format!("{name}, {threads} threads, {when}, {first} to {last}");
                        assert_eq!(outcome.hash, expected, "{about}");
                        if first == 1 {
                            // Without its first thread a session has none.
                            assert_eq!(outcome.status, BespokeStatus::NoThread as u32, "{about}: {}", outcome.message);
                            for word in ["thread", "limit", "prepare again"] {
                                assert!(outcome.message.contains(word), "{about}: {}", outcome.message);
                            }
                        } else {
                            assert_eq!(outcome.status, 0, "{about}: {}", outcome.message);
                        }
                        if outcome.asked < first {
                            break;
                        }
                        first += 1;
                        assert!(first < MOST, "{about}: it goes on asking for threads");
                    }
                    assert!(first > 1, "no thread of the {name} library was asked for: starve.c is not heard");
                }
            }
        }
    }
}

#[test]
fn a_session_of_one_thread_starts_no_other_and_none_stays() {
    for (name, library) in libraries() {
        let while_loading = dress(&library, 1, "load", 0, 0).asked - dress(&library, 1, "work", 0, 0).asked;
        for threads in [1, 2] {
            let outcome = dress(&library, threads, "work", 0, 0);
            assert!(threads > 1 || outcome.asked == 1, "{name}: {} threads for a session of one", outcome.asked);
            // The pool, the distance field, and who helps with it.
            assert!(outcome.asked <= 2 * threads, "{name}: {} threads for {threads}", outcome.asked);
            assert_eq!(outcome.left, 1 + while_loading, "{name}: threads are left of a session of {threads}");
        }
    }
}
