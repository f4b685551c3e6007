//! A garment that passes through itself all over, beside where it is: what is left of a design that noise has crumpled.
//!
//! Layers that pass through each other, lashes and patches are far apart along the surface, and no fault of the result.

use super::Outcome;
use crate::geometry::crumpled::{Crumpled, crumpled};

/// It is told where so much of its area takes part, and is gross where it is more than the other.
const TOLD: f64 = 0.05;
const GROSS: f64 = 0.15;

/// What is crumpled in the result, and whether nobody would wear it; none where it is little.
pub(super) fn left(outcome: &Outcome<'_>) -> Option<(Crumpled, bool)> {
    let found = crumpled(outcome.result, outcome.intersecting).filter(|found| found.share > TOLD)?;
    let is_gross = found.share > GROSS;
    Some((found, is_gross))
}
