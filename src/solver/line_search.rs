//! Backtracking line search with quadratic interpolation.

use glam::DVec3;

use super::profile::Profile;
use super::{Term, assembly};
use crate::control::{Cancel, Cancelled};
use crate::energy::Configuration;

/// Sufficient decrease (Armijo): `E(a) <= E(0) + SUFFICIENT_DECREASE a E'(0)`.
const SUFFICIENT_DECREASE: f64 = 1e-4;
/// Most backtracks; each multiplies the step by 0.4 to 0.6, and 2^-40 of a step is no progress.
const MAX_BACKTRACKS: usize = 40;

/// A point of sufficient decrease.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// The fraction of the step.
    pub fraction: f64,
    /// The objective there.
    pub objective: f64,
    /// The value of each term there, unweighted.
    pub values: Vec<f64>,
}

/// Finds a fraction of the step from `at` along (`dx`, `dt`), at most `longest`, of sufficient decrease. `value` is the
/// objective and `slope` its directional derivative at 0. `trial` is scratch and holds the accepted vertices on
/// success. The terms' times are added to `profile`. `None` where no fraction was found.
///
/// # Errors
/// [`Cancelled`]; `cancel` is checked before each trial.
#[allow(clippy::too_many_arguments)]
pub fn backtrack(
    terms: &[Term<'_>],
    at: Configuration<'_>,
    dx: &[DVec3],
    dt: f64,
    slope: f64,
    value: f64,
    longest: f64,
    trial: &mut Vec<DVec3>,
    cancel: &Cancel,
    profile: &mut Profile,
) -> Result<Option<Found>, Cancelled> {
    let mut fraction = longest;
    for _ in 0..MAX_BACKTRACKS {
        cancel.check()?;
        trial.clear();
        trial.extend(at.x.iter().zip(dx).map(|(&x, &d)| x + fraction * d));
        let values = assembly::values(terms, Configuration { x: trial, t: at.t + fraction * dt }, profile);
        let there = assembly::weighted(terms, &values);
        if there <= value + SUFFICIENT_DECREASE * fraction * slope {
            return Ok(Some(Found { fraction, objective: there, values }));
        }
        // The minimum of the parabola through value, slope and this trial, safeguarded: 0.4 to 0.6 of the step.
        let curvature = 2.0 * (there - value - slope * fraction);
        let parabola = if there.is_finite() && curvature > 0.0 { -slope * fraction / curvature } else { 0.5 };
        fraction *= parabola.clamp(0.4, 0.6);
    }
    Ok(None)
}
