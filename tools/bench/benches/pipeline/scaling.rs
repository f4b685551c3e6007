//! The third table: time over the number of threads.

use serde::Serialize;

use crate::case::Case;
use crate::child::{Setup, measure};
use crate::measurement::Measurement;
use crate::table;

/// One case with several numbers of threads.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Scaling {
    pub measured: Vec<Measurement>,
}

impl Scaling {
    /// Measures `case` with 1, 2, 4, 8 and 16 threads, as far as there are cores. That all give the same bits is part of it.
    pub fn measure(case: &Case, setup: Setup, failed: &mut Vec<String>) -> Self {
        let cores = std::thread::available_parallelism().map_or(1, usize::from) as u32;
        let mut measured: Vec<Measurement> = Vec::new();
        for threads in [1, 2, 4, 8, 16].into_iter().filter(|&threads| threads <= cores) {
            match measure(case, Setup { threads, ..setup }) {
                Ok(one) => measured.push(one),
                Err(message) => failed.push(message),
            }
        }
        if let [first, rest @ ..] = &measured[..]
            && let Some(other) = rest.iter().find(|m| m.hash != first.hash)
        {
            failed.push(format!("{}: {} threads give other bits than {}", first.case, other.threads, first.threads));
        }
        Self { measured }
    }

    /// F with one thread over F with `threads`: the load of others on the machine is in both the time and its unit.
    pub fn speed_up(&self, threads: usize) -> Option<f64> {
        let f = |n: usize| self.measured.iter().find(|m| m.threads == n).map(|m| m.f);
        Some(f(1)? / f(threads)?)
    }

    /// Prints it.
    pub fn print(&self) {
        let row = |m: &Measurement| {
            let k = &m.kernels;
            let mut row =
                vec![m.case.clone(), m.threads.to_string(), format!("{:.2}", m.seconds), format!("{:.0}", m.f)];
            row.push(self.speed_up(m.threads).map_or("?".into(), |s| format!("{s:.2}")));
            let linear = k.factorisation + k.solve + k.analysis;
            row.extend([k.assembly, linear, k.broad_phase, k.ccd, k.line_search].map(|t| format!("{t:.0}")));
            row
        };
        table::print(
            "Threads: speed-up of F, and milliseconds by kernel",
            1,
            &["case", "threads", "seconds", "F", "speed-up", "assembly", "linear", "broad phase", "CCD", "line search"],
            &self.measured.iter().map(row).collect::<Vec<_>>(),
        );
    }
}
