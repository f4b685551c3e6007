//! The second table: time over the garment's vertices, with one thread.

use serde::Serialize;

use crate::case::Case;
use crate::child::{Setup, measure};
use crate::measurement::Measurement;
use crate::table;

/// One garment at several densities on one body. Times are those in user mode where they are known: with one thread they are
/// nearly the same on a busy machine.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Growth {
    pub garment: String,
    /// Of the whole time: seconds ~ vertices^exponent, through all densities.
    pub exponent: f64,
    /// Of the time of one iteration.
    pub exponent_of_iteration: f64,
    pub measured: Vec<Measurement>,
}

impl Growth {
    /// Measures `cases`. Those that fail are left out and told to `failed`.
    pub fn measure(garment: &str, cases: &[Case], setup: Setup, failed: &mut Vec<String>) -> Self {
        let setup = Setup { threads: 1, ..setup };
        let mut measured = Vec::new();
        for case in cases {
            match measure(case, setup) {
                Ok(one) => measured.push(one),
                Err(message) => failed.push(message),
            }
        }
        let exponent = |of: fn(&Measurement) -> f64| {
            slope(&measured.iter().map(|m| [(m.garment_vertices as f64).ln(), of(m).ln()]).collect::<Vec<_>>())
        };
        let garment = garment.into();
        Self { garment, exponent: exponent(seconds), exponent_of_iteration: exponent(per_iteration), measured }
    }

    /// Prints it.
    pub fn print(&self) {
        let first = self.measured.first().map_or(1.0, seconds);
        let row = |m: &Measurement| {
            vec![
                m.case.clone(),
                m.garment_vertices.to_string(),
                format!("{:.2}", seconds(m)),
                format!("{:.1}", seconds(m) / first),
                format!("{} + {}", m.iterations[0], m.iterations[1]),
                m.factorisations.to_string(),
                m.symbolic_factorisations.to_string(),
                format!("{:.0}", 1e3 * per_iteration(m)),
                format!("{:.1}", 1e3 * m.unit),
                format!("{:.0}", m.f),
                m.peak_memory.map_or("?".into(), |bytes| format!("{:.0}", bytes as f64 / 1e6)),
                format!("{} + {}", m.intersections[0], m.intersections[1]),
            ]
        };
        let title = format!(
            "Growth of the {}: seconds ~ vertices^{:.2}, milliseconds of an iteration ~ vertices^{:.2}",
            self.garment, self.exponent, self.exponent_of_iteration
        );
        let head = [
            "case",
            "vertices",
            "CPU s",
            "times",
            "iterations",
            "factorisations",
            "symbolic",
            "ms/iteration",
            "unit",
            "F",
            "MB",
            "intersections",
        ];
        table::print(&title, 1, &head, &self.measured.iter().map(row).collect::<Vec<_>>());
        self.print_kernels();
    }

    /// Where the time of each goes.
    fn print_kernels(&self) {
        let row = |m: &Measurement| {
            let k = &m.kernels;
            // By the share of the wall time, which is that of the time in user mode.
            let to_cpu = 1e-3 * seconds(m) / m.seconds;
            let times = [k.assembly, k.factorisation, k.solve, k.analysis, k.broad_phase, k.ccd, k.line_search]
                .map(|t| to_cpu * t);
            let stages = [m.stages.prepare, m.stages.inflate, m.stages.fit].map(|t| 1e3 * to_cpu * t);
            let cells = stages.into_iter().chain(times).map(|t| format!("{t:.2}"));
            std::iter::once(m.garment_vertices.to_string()).chain(cells).collect()
        };
        let title = format!("CPU seconds of the {} by stage and kernel", self.garment);
        let head = [
            "vertices",
            "prepare",
            "inflate",
            "fit",
            "assembly",
            "factor",
            "solve",
            "symbolic",
            "broad phase",
            "CCD",
            "line search",
        ];
        table::print(&title, 0, &head, &self.measured.iter().map(row).collect::<Vec<Vec<String>>>());
    }
}

/// Seconds in user mode where they are known, or else on the clock.
fn seconds(m: &Measurement) -> f64 {
    m.cpu_seconds.unwrap_or(m.seconds)
}

/// Seconds of an iteration.
fn per_iteration(m: &Measurement) -> f64 {
    m.units_per_iteration * m.unit * seconds(m) / m.seconds
}

/// Slope of the line through the points (least squares); not a number where there are less than two.
fn slope(points: &[[f64; 2]]) -> f64 {
    let mean = |axis: usize| points.iter().map(|p| p[axis]).sum::<f64>() / points.len() as f64;
    let [x, y] = [mean(0), mean(1)];
    let product: f64 = points.iter().map(|p| (p[0] - x) * (p[1] - y)).sum();
    product / points.iter().map(|p| (p[0] - x).powi(2)).sum::<f64>()
}
