//! The last touch of the fit: rigid groups become as rigid as numbers can be, and what was asked for but not reached is told.
//!
//! The stiff term leaves a group bent by some ten-thousandths of its size. That rest is taken away by moving the group's
//! vertices to the rigid motion of its rest shape beside them, which contact must admit like any other step.

use glam::DVec3;

use super::objective::Objective;
use super::setup::problem::Problem;
use crate::control::Cancelled;
use crate::input::diagnostic::Diagnostic;
use crate::solver::newton::{Model, State};

/// A rigid group that ends farther than this from a rigid motion is told, as bent.
const BENT: f64 = 1e-6;

/// A pin that ends farther than this many d-hat from its place is told, as not reached.
const AWAY: f64 = 2.0;

/// Vertices and the places where they are to be.
type Group = Vec<(u32, DVec3)>;

/// Straightens the rigid groups as far as contact admits. Returns what the garment in `state` falls short of.
///
/// # Errors
/// [`Cancelled`].
pub fn close(problem: &Problem, objective: &mut Objective, state: &mut State) -> Result<Vec<Diagnostic>, Cancelled> {
    let groups: Vec<Group> = objective.rigid().placed(&state.x).collect();
    straighten(objective, state, &groups)?;
    let mut diagnostics = Vec::new();
    report_bent(problem, &groups, &state.x, &mut diagnostics);
    report_missed(problem, objective, &state.x, &mut diagnostics);
    Ok(diagnostics)
}

fn straighten(objective: &mut Objective, state: &mut State, groups: &[Group]) -> Result<(), Cancelled> {
    if groups.is_empty() || advance(objective, state, groups, true)? {
        return Ok(());
    }
    // Something stands in the way of one of them: the others need not suffer.
    for group in groups {
        advance(objective, state, std::slice::from_ref(group), false)?;
    }
    Ok(())
}

/// Moves vertices towards their places as far as that is free; with `whole`, all the way or not at all. Whether it was all
/// the way.
fn advance(objective: &mut Objective, state: &mut State, groups: &[Group], whole: bool) -> Result<bool, Cancelled> {
    let mut dx = vec![DVec3::ZERO; state.x.len()];
    for &(v, place) in groups.iter().flatten() {
        dx[v as usize] = place - state.x[v as usize];
    }
    // Without the memory to tell what is in the way, nothing moves.
    let part = objective.max_feasible_step(state.configuration(), &dx, 0.0, 1.0)?.unwrap_or(0.0);
    if part == 1.0 {
        // The place itself, to the last bit.
        groups.iter().flatten().for_each(|&(v, place)| state.x[v as usize] = place);
    } else if !whole {
        state.x.iter_mut().zip(&dx).for_each(|(x, d)| *x += part * *d);
    }
    Ok(part == 1.0)
}

fn report_bent(problem: &Problem, groups: &[Group], x: &[DVec3], diagnostics: &mut Vec<Diagnostic>) {
    let worst = |group: &Group| {
        let distances = group.iter().map(|&(v, place)| (v, x[v as usize].distance(place)));
        distances.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0, 0.0))
    };
    let bent: Vec<(usize, (u32, f64))> =
        groups.iter().map(worst).enumerate().filter(|(_, (_, distance))| *distance > BENT).collect();
    Diagnostic::list(diagnostics, &bent, |&(group, (v, distance))| Diagnostic::RigidGroupBent {
        group,
        vertex: problem.weld.vertex_of[v as usize],
        distance,
    });
}

fn report_missed(problem: &Problem, objective: &Objective, x: &[DVec3], diagnostics: &mut Vec<Diagnostic>) {
    let away = AWAY * objective.contact.distances().dhat;
    let distances = objective.pins().pins().iter().map(|pin| (pin.vertex, x[pin.vertex as usize].distance(pin.end)));
    let missed: Vec<(u32, f64)> = distances.filter(|(_, distance)| *distance > away).collect();
    Diagnostic::list(diagnostics, &missed, |&(v, distance)| Diagnostic::PinNotReached {
        vertex: problem.weld.vertex_of[v as usize],
        distance,
    });
}
