//! The table of a soak.

use std::collections::BTreeMap;

use crate::outcome::Outcome;

/// Prints it. True where nothing intersects and nothing crashed.
pub fn print(outcomes: &[Outcome]) -> bool {
    let mut kinds: BTreeMap<String, [usize; 2]> = BTreeMap::new();
    for o in outcomes {
        let kind = o.error.as_ref().map_or("Done".to_string(), |e| format!("{:?}", e.kind));
        kinds.entry(kind).or_default()[usize::from(!o.recipe.flaws.is_empty())] += 1;
    }
    println!("| outcome | sound scenes | flawed scenes |\n| --- | --- | --- |");
    for (kind, [sound, flawed]) in &kinds {
        println!("| {kind} | {sound} | {flawed} |");
    }
    let intersections: u64 = outcomes.iter().map(|o| o.intersections).sum();
    let crashes = outcomes.iter().filter(|o| o.is_crash()).count();
    let done: Vec<&Outcome> = outcomes.iter().filter(|o| o.error.is_none()).collect();
    println!("\n| {} retargets | |\n| --- | --- |", outcomes.len());
    println!("| intersections | {intersections} |\n| crashes | {crashes} |");
    println!("| results in spite of flaws | {} |", done.iter().filter(|o| !o.recipe.flaws.is_empty()).count());
    println!("| fits that ended short of their tolerance | {} |", done.iter().filter(|o| !o.converged).count());
    let [median, worst] = median_and_worst(done.iter().map(|o| o.seconds));
    println!("| seconds, median and worst | {median:.2} and {worst:.2} |");
    let [median, worst] = median_and_worst(done.iter().map(|o| f64::from(o.iterations)));
    println!("| iterations, median and worst | {median} and {worst} |\n");
    let refused = |o: &&Outcome| o.recipe.flaws.is_empty() && o.error.is_some();
    list("intersections", outcomes.iter().filter(|o| o.intersections > 0));
    list("crashed", outcomes.iter().filter(|o| o.is_crash()));
    list("sound, but without a result", outcomes.iter().filter(refused));
    list("did not converge", done.iter().copied().filter(|o| !o.converged && o.recipe.flaws.is_empty()));
    let mut slow: Vec<&Outcome> = outcomes.iter().filter(|o| o.seconds > 10.0).collect();
    slow.sort_by(|a, b| b.seconds.total_cmp(&a.seconds));
    list("over 10 seconds", slow.into_iter());
    intersections == 0 && crashes == 0
}

fn median_and_worst(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    [values.get(values.len() / 2), values.last()].map(|v| v.copied().unwrap_or(f64::NAN))
}

fn list<'a>(what: &str, outcomes: impl Iterator<Item = &'a Outcome>) {
    for o in outcomes {
        println!("{what}: make soak {}", o.line());
    }
}
