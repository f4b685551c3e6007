//! What is reached of what was set out for.

use serde::Serialize;

use crate::growth::Growth;
use crate::measurement::Measurement;
use crate::pairs::Pair;
use crate::scaling::Scaling;
use crate::table;

/// The pair that the published implementation is compared on.
const REFERENCE_PAIR: &str = "jumpsuit_dense Goblin";

/// A figure, what it has to be, and what it had better be.
#[derive(Clone, Debug, Serialize)]
pub struct Goal {
    pub what: String,
    pub value: f64,
    pub bar: f64,
    pub moonshot: f64,
    /// A larger value is better.
    pub is_more_better: bool,
}

impl Goal {
    fn meets(&self, bound: f64) -> bool {
        if self.is_more_better { self.value >= bound } else { self.value <= bound }
    }
}

/// The goals of what was measured; of the closet's pairs where there are no real ones.
pub fn goals(pairs: &[Pair], growth: &[Growth], scaling: Option<&Scaling>) -> Vec<Goal> {
    let real = pairs.iter().any(|pair| pair.is_real);
    let counted: Vec<&Pair> = pairs.iter().filter(|pair| pair.is_real == real).collect();
    let which = format!("{} {} pairs", counted.len(), if real { "real" } else { "closet" });
    let mut goals = Vec::new();
    let mut add = |what: String, value: Option<f64>, bar: f64, moonshot: f64, is_more_better: bool| {
        goals.extend(value.map(|value| Goal { what, value, bar, moonshot, is_more_better }));
    };
    let all = |of: fn(&Measurement) -> f64| counted.iter().map(move |pair| of(&pair.measured));
    let worst = |of: fn(&Measurement) -> f64| all(of).reduce(f64::max);
    let logarithms = |of: fn(&Measurement) -> f64| all(of).map(f64::ln).sum::<f64>() / counted.len() as f64;
    let mean = |of: fn(&Measurement) -> f64| (!counted.is_empty()).then(|| logarithms(of).exp());
    add(format!("F, geometric mean of {which}"), mean(|m| m.f), 400.0, 150.0, false);
    add("F, worst".into(), worst(|m| m.f), 1000.0, 400.0, false);
    add(
        "first feasible result, per cent of the time, mean".into(),
        mean(|m| 100.0 * m.feasible_share),
        35.0,
        20.0,
        false,
    );
    add("the same, worst".into(), worst(|m| 100.0 * m.feasible_share), 35.0, 20.0, false);
    add("units per iteration, mean".into(), mean(|m| m.units_per_iteration), 3.0, 1.8, false);
    add("units per iteration, worst".into(), worst(|m| m.units_per_iteration), 3.0, 1.8, false);
    let reference = pairs.iter().find(|pair| pair.measured.case == REFERENCE_PAIR);
    let iterations = reference.map(|pair| f64::from(pair.measured.iterations.iter().sum::<u32>()));
    add(format!("iterations, {REFERENCE_PAIR}"), iterations, 100.0, 40.0, false);
    let memory = counted.iter().filter_map(|pair| pair.measured.peak_memory).max();
    add("peak memory of the process, MB, worst".into(), memory.map(|bytes| bytes as f64 / 1e6), 400.0, 150.0, false);
    let excess = counted.iter().filter_map(|pair| pair.tight.as_ref()).map(|tight| tight.excess).reduce(f64::max);
    add("objective above a tight tolerance's, per cent, worst".into(), excess, 1.0, 1.0, false);
    for growth in growth.iter().filter(|growth| growth.measured.len() > 1) {
        let what = format!("growth of time with the vertices of the {}, exponent", growth.garment);
        add(what, Some(growth.exponent), 1.25, 1.1, false);
    }
    for (threads, bar, moonshot) in [(2, 1.5, 1.8), (16, 4.0, 8.0)] {
        let speed_up = scaling.and_then(|scaling| scaling.speed_up(threads));
        add(format!("speed-up with {threads} threads"), speed_up, bar, moonshot, true);
    }
    goals
}

/// Prints them.
pub fn print(goals: &[Goal]) {
    let row = |goal: &Goal| {
        let met = match (goal.meets(goal.bar), goal.meets(goal.moonshot)) {
            (_, true) => "moonshot",
            (true, _) => "bar",
            _ => "missed",
        };
        let bound = |bound: f64| format!("{} {bound}", if goal.is_more_better { ">=" } else { "<=" });
        vec![goal.what.clone(), format!("{:.2}", goal.value), bound(goal.bar), bound(goal.moonshot), met.into()]
    };
    let rows: Vec<_> = goals.iter().map(row).collect();
    table::print("What is reached", 1, &["what", "here", "bar", "moonshot", "met"], &rows);
}
