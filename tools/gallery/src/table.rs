//! The figures of all pairs, for people and for programs.

use std::fmt::Write as _;
use std::io;

use serde::Serialize;

use crate::pair::Outcome;

/// What is said of all pairs together.
#[derive(Clone, Debug, Serialize)]
pub struct Summary {
    /// How many there are.
    pub pairs: usize,
    /// How many came out without an intersection.
    pub verified: usize,
    /// Wall seconds, with the modelling.
    pub seconds: f64,
}

impl Summary {
    /// Of `outcomes`, which took so many seconds.
    pub fn of(outcomes: &[Outcome], seconds: f64) -> Self {
        Self { pairs: outcomes.len(), verified: outcomes.iter().filter(|o| o.is_verified()).count(), seconds }
    }

    /// A sentence.
    pub fn sentence(&self) -> String {
        let (minutes, seconds) = (self.seconds as u64 / 60, self.seconds as u64 % 60);
        format!("{} of {} pairs without intersections, in {minutes} min {seconds} s", self.verified, self.pairs)
    }
}

/// A table with a row a pair, and a sentence about all.
pub fn markdown(outcomes: &[Outcome], summary: &Summary) -> String {
    let names: Vec<String> = outcomes.first().map_or(Vec::new(), figures).into_iter().map(|[name, _]| name).collect();
    let mut text = format!("{}.\n\n| garment | avatar | {} |\n|", summary.sentence(), names.join(" | "));
    text += &" --- |".repeat(names.len() + 2);
    text.push('\n');
    for outcome in outcomes {
        let values: Vec<String> = figures(outcome).into_iter().map(|[_, value]| value).collect();
        let _ = writeln!(text, "| {} | {} | {} |", outcome.garment, outcome.avatar, values.join(" | "));
    }
    text += "\nIntersections are pairs of triangles: of the garment, and of garment and avatar. Gaps are smallest distances, \
             where a skeleton is 2 long; beyond d-hat they are not measured. Distortion has no unit, and is 0 for a design \
             that is only moved, turned and scaled. Asymmetry is the mean distance of mirrored vertices from the surface. \
             Openings: the growth of a boundary loop for that of the triangles that touch it.\n";
    for outcome in outcomes {
        if let Some(error) = &outcome.error {
            let _ = writeln!(text, "\n{} on {}: {error}", outcome.garment, outcome.avatar);
        }
    }
    text
}

/// The same for programs, as JSON.
pub fn json(outcomes: &[Outcome], summary: &Summary) -> io::Result<String> {
    #[derive(Serialize)]
    struct Table<'a> {
        #[serde(flatten)]
        summary: &'a Summary,
        rows: &'a [Outcome],
    }
    Ok(serde_json::to_string_pretty(&Table { summary, rows: outcomes })?)
}

/// One pair in a line.
pub fn line(outcome: &Outcome) -> String {
    let [inflate, fit] = outcome.iterations;
    let ended = outcome.error.clone().unwrap_or_else(|| format!("{} intersections", intersections(outcome)));
    let (garment, avatar) = (outcome.garment, outcome.avatar);
    format!("{garment} on {avatar}: {:.1} s, {inflate} + {fit} iterations, {ended}", outcome.seconds)
}

/// Names and values of what was measured, as text; the names are the same for all outcomes of a run.
pub fn figures(outcome: &Outcome) -> Vec<[String; 2]> {
    let [inflate, fit] = outcome.iterations;
    let gap = |distance: Option<f64>| match distance {
        Some(distance) => format!("{distance:.5}"),
        None if outcome.error.is_some() => "-".to_string(),
        None => "beyond d-hat".to_string(),
    };
    let ended = match (&outcome.error, outcome.converged) {
        (Some(_), _) => "no result",
        (None, true) => "converged",
        (None, false) => "short of its tolerance",
    };
    [
        ("intersections", intersections(outcome)),
        ("seconds", format!("{:.1}", outcome.seconds)),
        ("iterations (inflate + fit)", format!("{inflate} + {fit}")),
        ("gap to itself", gap(outcome.distances[0])),
        ("gap to the avatar", gap(outcome.distances[1])),
        (
            "distortion (mean, max)",
            outcome.distortion.map_or("-".into(), |[mean, most]| format!("{mean:.1e}, {most:.1e}")),
        ),
        (
            "asymmetry in mm (garment, avatar)",
            outcome.asymmetry.map_or("-".into(), |[garment, avatar]| format!("{garment:.1}, {avatar:.1}")),
        ),
        (
            "openings against the cloth (least, most)",
            outcome.opening_growth.map_or("-".into(), |[least, most]| format!("{least:.2}, {most:.2}")),
        ),
        ("ended", ended.to_string()),
    ]
    .map(|(name, value)| [name.to_string(), value])
    .to_vec()
}

fn intersections(outcome: &Outcome) -> String {
    outcome.intersections.map_or("-".to_string(), |[itself, avatar]| format!("{itself} + {avatar}"))
}
