//! Whether the inflation has come to its end where the garment is held, and the next attempt there: with other settings, from the
//! beginning.

use super::run::{Run, Step};
use crate::error::Result;
use crate::input::diagnostic::{Element, Subject};
use crate::solver::newton::{Model, Newton, State};
use crate::stage::attempts::Stall;
use crate::stage::blockage;
use crate::stage::inflate::Inflation;

impl Run {
    /// Where parts of the avatar that touch each other at full size hold the garment most, a triangle of each.
    fn shut(&mut self) -> Option<[Element; 2]> {
        blockage::shut(&self.problem, &self.body, &mut self.objective, self.state.configuration())
    }

    /// Whether the garment is held for good, where t comes to a stand: as [`Inflation::is_wedged`] says it.
    pub(super) fn is_held(&mut self, [wedged, wedged_by_dispensable]: [bool; 2]) -> bool {
        let by_dispensable = wedged_by_dispensable && self.dispensable.is_some();
        let shut = if wedged || by_dispensable { self.shut() } else { None };
        shut.is_some_and(|parts| wedged || by_dispensable && parts.iter().any(|part| self.is_dispensable(*part)))
    }

    fn is_dispensable(&self, element: Element) -> bool {
        let known = self.dispensable.as_ref().filter(|_| element.subject == Subject::TargetAvatar);
        known.is_some_and(|known| known.get(element.index as usize).is_some_and(|&is| is))
    }

    /// Where the inflation has stalled, begins another attempt with other settings. False where all were tried, or the caller will try
    /// without what holds the garment.
    pub(super) fn try_again(&mut self) -> Result<bool> {
        let (t, iterations) = (self.state.t, self.iterations());
        let untangled = self.problem.untangled.is_some();
        let shut = self.shut();
        self.is_left = shut.iter().flatten().any(|element| self.is_dispensable(*element));
        if self.is_left {
            // That is what is to be told.
            self.farthest = None;
            return Ok(false);
        }
        let stall = Stall { t, iterations, is_shut: shut.is_some() };
        let Some(settings) = self.attempts.next(&self.options, &self.problem.distances, stall, untangled) else {
            return Ok(false);
        };
        let (places, may_linger) = (self.attempts.places(), self.attempts.may_linger());
        self.step = Step::Inflate(Inflation::another(iterations, places, may_linger));
        let stop = &self.context.stop;
        let objective = self.problem.another_inflation(&settings, &self.options, stop);
        stop.check()?;
        self.initial_intersections = objective.contact.exempt_pairs().triangle_pairs().into();
        let state = State { x: self.problem.initial_state(settings.as_designed).0.to_vec(), t: 0.0 };
        let budget = self.remaining_budget().reserving(objective.memory());
        self.newton = Newton::new(state.x.len(), &objective.terms(), budget, stop.clone())?;
        let stalled = (std::mem::replace(&mut self.objective, objective), std::mem::replace(&mut self.state, state));
        // Kept to say what holds the garment; where memory is short, the last attempt has to do.
        if self.options.memory_limit == 0 && self.farthest.as_ref().is_none_or(|farthest| farthest.1.t < t) {
            self.farthest = Some(Box::new(stalled));
        }
        Ok(true)
    }
}
