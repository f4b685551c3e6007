//! Timings of a stage by kernel.

use std::ops::AddAssign;
use std::time::Duration;

/// Wall time by kernel, and thread time by term. For reports only: no result depends on it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Profile {
    /// Assembly of linear systems.
    pub assembly: Duration,
    /// Symbolic factorisations, with building their patterns.
    pub analysis: Duration,
    /// Numeric factorisations.
    pub factorisation: Duration,
    /// Solves with the factor.
    pub solve: Duration,
    /// Broad phase: searches for pairs that are near, or may come near in a step.
    pub broad_phase: Duration,
    /// Continuous collision detection.
    pub ccd: Duration,
    /// Line searches.
    pub line_search: Duration,
    /// The terms of the objective, in order of first use.
    pub terms: Vec<TermTime>,
}

/// Time in one term, summed over the threads.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TermTime {
    /// Name of the term.
    pub name: &'static str,
    /// Evaluating its derivatives and summing them, in assembly.
    pub derivatives: Duration,
    /// Evaluating its values, mostly in line searches.
    pub values: Duration,
}

impl Profile {
    /// The entry of the term `name`, added if missing.
    pub fn term(&mut self, name: &'static str) -> &mut TermTime {
        let at = self.terms.iter().position(|term| term.name == name).unwrap_or_else(|| {
            self.terms.push(TermTime { name, ..TermTime::default() });
            self.terms.len() - 1
        });
        &mut self.terms[at]
    }
}

impl AddAssign<&Profile> for Profile {
    fn add_assign(&mut self, other: &Profile) {
        self.assembly += other.assembly;
        self.analysis += other.analysis;
        self.factorisation += other.factorisation;
        self.solve += other.solve;
        self.broad_phase += other.broad_phase;
        self.ccd += other.ccd;
        self.line_search += other.line_search;
        for term in &other.terms {
            let sum = self.term(term.name);
            sum.derivatives += term.derivatives;
            sum.values += term.values;
        }
    }
}
