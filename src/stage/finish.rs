//! The end of the fit: projects rigid groups onto their best rigid motion, and reports unmet constraints.
//!
//! The stiff term leaves a group bent by some ten-thousandths of its size. The projection moves the group's vertices to the
//! rigid motion of its rest shape that is nearest to them; it is limited by CCD like any other step.

use glam::DVec3;

use super::objective::Objective;
use super::setup::problem::Problem;
use crate::control::Cancelled;
use crate::input::diagnostic::Diagnostic;
use crate::solver::newton::{Model, State};

/// A rigid group that ends farther than this from a rigid motion is reported as bent.
const MAX_BEND: f64 = 1e-6;

/// A pin that ends farther than this many d-hat from its target is reported as not reached.
const MAX_PIN_DISTANCE: f64 = 2.0;

/// Vertices of a rigid group and their positions in its rigid motion.
type Group = Vec<(u32, DVec3)>;

/// Projects the rigid groups as far as CCD allows. Returns the constraints that the garment in `state` does not meet.
///
/// # Errors
/// [`Cancelled`].
pub fn finish(problem: &Problem, objective: &mut Objective, state: &mut State) -> Result<Vec<Diagnostic>, Cancelled> {
    let groups: Vec<Group> = objective.rigid().placed(&state.x).collect();
    project_rigid_groups(objective, state, &groups)?;
    let mut diagnostics = Vec::new();
    report_bent_groups(problem, &groups, &state.x, &mut diagnostics);
    report_missed_pins(problem, objective, &state.x, &mut diagnostics);
    Ok(diagnostics)
}

fn project_rigid_groups(objective: &mut Objective, state: &mut State, groups: &[Group]) -> Result<(), Cancelled> {
    if groups.is_empty() || move_to(objective, state, groups, true)? {
        return Ok(());
    }
    // Something stands in the way of at least one of them: retry each group separately.
    for group in groups {
        move_to(objective, state, std::slice::from_ref(group), false)?;
    }
    Ok(())
}

/// Moves vertices towards their positions in `groups` as far as that is feasible; with `whole`, all the way or not at all.
/// True where it was all the way.
fn move_to(objective: &mut Objective, state: &mut State, groups: &[Group], whole: bool) -> Result<bool, Cancelled> {
    let mut dx = vec![DVec3::ZERO; state.x.len()];
    for &(v, target) in groups.iter().flatten() {
        dx[v as usize] = target - state.x[v as usize];
    }
    // Without the memory to find what is in the way, nothing moves.
    let feasible = objective.max_feasible_step(state.configuration(), &dx, 0.0, 1.0)?.unwrap_or(0.0);
    if feasible == 1.0 {
        // The target itself, to the last bit.
        groups.iter().flatten().for_each(|&(v, target)| state.x[v as usize] = target);
    } else if !whole {
        state.x.iter_mut().zip(&dx).for_each(|(x, d)| *x += feasible * *d);
    }
    Ok(feasible == 1.0)
}

fn report_bent_groups(problem: &Problem, groups: &[Group], x: &[DVec3], diagnostics: &mut Vec<Diagnostic>) {
    let worst = |group: &Group| {
        let distances = group.iter().map(|&(v, target)| (v, x[v as usize].distance(target)));
        distances.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0, 0.0))
    };
    let bent: Vec<(usize, (u32, f64))> = groups
        .iter()
        .take(problem.callers_groups.len())
        .map(worst)
        .enumerate()
        .filter(|(_, (_, distance))| *distance > MAX_BEND)
        .collect();
    Diagnostic::list(diagnostics, &bent, |&(group, (v, distance))| Diagnostic::RigidGroupBent {
        group,
        vertex: problem.weld.vertex_of[v as usize],
        distance,
    });
}

fn report_missed_pins(problem: &Problem, objective: &Objective, x: &[DVec3], diagnostics: &mut Vec<Diagnostic>) {
    let away = MAX_PIN_DISTANCE * objective.contact.distances().dhat;
    let distances = objective.pins().pins().iter().map(|pin| (pin.vertex, x[pin.vertex as usize].distance(pin.end)));
    let missed: Vec<(u32, f64)> = distances.filter(|(_, distance)| *distance > away).collect();
    Diagnostic::list(diagnostics, &missed, |&(v, distance)| Diagnostic::PinNotReached {
        vertex: problem.weld.vertex_of[v as usize],
        distance,
    });
}
