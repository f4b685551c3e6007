//! The first table: garments on avatars.

use serde::Serialize;

use crate::case::Case;
use crate::child::{Setup, measure};
use crate::measurement::{Measurement, Term};
use crate::table;

/// The tolerance that stands for none at all.
const TIGHT: f64 = 1e-6;

/// One pair.
#[derive(Clone, Debug, Serialize)]
pub struct Pair {
    /// One of the real meshes, not of the closet.
    pub is_real: bool,
    #[serde(flatten)]
    pub measured: Measurement,
    /// The objective and the iterations down to a tight tolerance, where that was asked for.
    pub tight: Option<Tight>,
}

/// Where a tight tolerance leads.
#[derive(Clone, Debug, Serialize)]
pub struct Tight {
    pub objective: f64,
    pub iterations: u32,
    /// How far above that the default's objective is, in per cent.
    pub excess: f64,
    pub terms: Vec<Term>,
}

impl Pair {
    /// Measures `case`, once more with a tight tolerance where `tight`.
    pub fn measure(case: &Case, is_real: bool, setup: Setup, tight: bool) -> Result<Self, String> {
        let measured = measure(case, setup)?;
        let tight = tight.then(|| measure(case, Setup { runs: 1, tolerance: Some(TIGHT), ..setup })).transpose()?;
        let tight = tight.map(|tight| Tight {
            objective: tight.objective,
            iterations: tight.iterations.iter().sum(),
            excess: 100.0 * (measured.objective / tight.objective - 1.0),
            terms: tight.terms,
        });
        Ok(Self { is_real, measured, tight })
    }
}

/// Prints what was measured.
pub fn print(pairs: &[Pair]) {
    let rows = |cells: fn(&Measurement) -> Vec<String>| -> Vec<Vec<String>> {
        let row = |pair: &Pair| {
            let mut row = vec![pair.measured.case.clone()];
            row.extend(cells(&pair.measured));
            row
        };
        pairs.iter().map(row).collect()
    };
    table::print(
        "Whole retargets (F: seconds in units; unit: milliseconds of one factorisation)",
        1,
        &[
            "case",
            "vertices",
            "seconds",
            "unit",
            "F",
            "iterations",
            "units/iteration",
            "MB",
            "intersections",
            "distance",
        ],
        &rows(|m| {
            vec![
                m.garment_vertices.to_string(),
                format!("{:.2}", m.seconds),
                format!("{:.1}", 1e3 * m.unit),
                format!("{:.0}", m.f),
                format!("{} + {}{}", m.iterations[0], m.iterations[1], if m.converged { "" } else { " (limit)" }),
                format!("{:.2}", m.units_per_iteration),
                m.peak_memory.map_or("?".into(), |bytes| format!("{:.0}", bytes as f64 / 1e6)),
                format!("{} + {}", m.intersections[0], m.intersections[1]),
                format!("{:.1e}", m.min_distance),
            ]
        }),
    );
    table::print(
        "Seconds by stage, and to the first feasible result (t = 1)",
        1,
        &["case", "prepare", "inflate", "fit", "verify", "feasible", "share"],
        &rows(|m| {
            let stages = [m.stages.prepare, m.stages.inflate, m.stages.fit, m.stages.verify, m.feasible_seconds];
            let mut cells = stages.map(|s| format!("{s:.2}")).to_vec();
            cells.push(format!("{:.0} %", 100.0 * m.feasible_share));
            cells
        }),
    );
    table::print(
        "Milliseconds by kernel (field samples: summed over the threads, part of assembly and line search), and counts",
        1,
        &[
            "case",
            "assembly",
            "factor",
            "solve",
            "symbolic",
            "broad phase",
            "CCD",
            "line search",
            "field build",
            "field wait",
            "field samples",
            "factorisations",
            "symbolic",
        ],
        &rows(|m| {
            let k = &m.kernels;
            let times = [
                k.assembly,
                k.factorisation,
                k.solve,
                k.analysis,
                k.broad_phase,
                k.ccd,
                k.line_search,
                k.field_build,
                k.field_wait,
                k.field_samples,
            ];
            let mut cells = times.map(|t| format!("{t:.0}")).to_vec();
            cells.extend([m.factorisations.to_string(), m.symbolic_factorisations.to_string()]);
            cells
        }),
    );
    print_terms("Milliseconds by term in assembly + line search, summed over the threads", pairs, |t| {
        format!("{:.0} + {:.0}", t.derivatives, t.values)
    });
    print_terms("The objective at the end: weight * value of each term", pairs, |t| {
        format!("{:.2e}", t.weight * t.value)
    });
    print_tight(pairs);
}

fn print_terms(title: &str, pairs: &[Pair], cell: impl Fn(&Term) -> String) {
    let Some(first) = pairs.first() else { return };
    let mut head = vec!["case"];
    head.extend(first.measured.terms.iter().map(|term| term.name.as_str()));
    let row = |pair: &Pair| {
        let mut row = vec![pair.measured.case.clone()];
        row.extend(pair.measured.terms.iter().map(&cell));
        row
    };
    table::print(title, 1, &head, &pairs.iter().map(row).collect::<Vec<_>>());
}

fn print_tight(pairs: &[Pair]) {
    let row = |pair: &Pair| {
        let tight = pair.tight.as_ref()?;
        Some(vec![
            pair.measured.case.clone(),
            format!("{:.6}", pair.measured.objective),
            format!("{:.6}", tight.objective),
            format!("{:.2} %", tight.excess),
            tight.iterations.to_string(),
        ])
    };
    let rows: Vec<_> = pairs.iter().filter_map(row).collect();
    let head = ["case", "objective", "tight", "above", "iterations of tight"];
    table::print("The objective against that of a tight tolerance", 1, &head, &rows);
}
