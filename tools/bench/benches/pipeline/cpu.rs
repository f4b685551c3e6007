//! CPU seconds of Linux processes: wall time says little on a machine with other work.

use std::{fs, io};

/// Where the times are in /proc/self/stat, counted from behind the program's name: of this process, and of those that it waited for.
const OWN: usize = 11;
const CHILDREN: usize = 13;
/// Of a second, in which Linux counts.
const TICKS: f64 = 100.0;

/// User seconds of this process so far.
pub fn own_seconds() -> io::Result<f64> {
    seconds(OWN)
}

/// User seconds of the processes that have ended so far, and of theirs.
pub fn children_seconds() -> io::Result<f64> {
    seconds(CHILDREN)
}

fn seconds(place: usize) -> io::Result<f64> {
    let stat = fs::read_to_string("/proc/self/stat")?;
    // The name is in parentheses, with whatever in it.
    let behind = stat.rsplit(')').next().unwrap_or_default();
    let ticks = behind.split_whitespace().nth(place).and_then(|ticks| ticks.parse::<f64>().ok());
    ticks.map(|ticks| ticks / TICKS).ok_or_else(|| io::Error::other("/proc/self/stat has no user time"))
}
