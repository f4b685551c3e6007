//! The second table: time over the garment's vertices.

use serde::Serialize;

use crate::case::Case;
use crate::child::{Setup, measure};
use crate::measurement::Measurement;
use crate::table;

/// One garment at several densities on one body.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Growth {
    /// Of the whole time: seconds ~ vertices^exponent.
    pub exponent: f64,
    /// Of the time of one iteration.
    pub exponent_of_iteration: f64,
    pub measured: Vec<Measurement>,
}

impl Growth {
    /// Measures `cases`. Those that fail are left out and told to `failed`.
    pub fn measure(cases: &[Case], setup: Setup, failed: &mut Vec<String>) -> Self {
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
        Self { exponent: exponent(|m| m.seconds), exponent_of_iteration: exponent(per_iteration), measured }
    }

    /// Prints it.
    pub fn print(&self) {
        let row = |m: &Measurement| {
            vec![
                m.case.clone(),
                m.garment_vertices.to_string(),
                format!("{:.2}", m.seconds),
                format!("{} + {}", m.iterations[0], m.iterations[1]),
                format!("{:.0}", 1e3 * per_iteration(m)),
                format!("{:.1}", 1e3 * m.unit),
                format!("{:.0}", m.f),
                m.peak_memory.map_or("?".into(), |bytes| format!("{:.0}", bytes as f64 / 1e6)),
                format!("{} + {}", m.intersections[0], m.intersections[1]),
            ]
        };
        let title = format!(
            "Growth: seconds ~ vertices^{:.2}, milliseconds of an iteration ~ vertices^{:.2}",
            self.exponent, self.exponent_of_iteration
        );
        let head = ["case", "vertices", "seconds", "iterations", "ms/iteration", "unit", "F", "MB", "intersections"];
        table::print(&title, 1, &head, &self.measured.iter().map(row).collect::<Vec<_>>());
    }
}

/// Seconds of an iteration.
fn per_iteration(m: &Measurement) -> f64 {
    m.units_per_iteration * m.unit
}

/// Slope of the line through the points (least squares); not a number where there are less than two.
fn slope(points: &[[f64; 2]]) -> f64 {
    let mean = |axis: usize| points.iter().map(|p| p[axis]).sum::<f64>() / points.len() as f64;
    let [x, y] = [mean(0), mean(1)];
    let product: f64 = points.iter().map(|p| (p[0] - x) * (p[1] - y)).sum();
    product / points.iter().map(|p| (p[0] - x).powi(2)).sum::<f64>()
}
