//! The objective of inflation and fit (Eqs. 6 and 7): the terms with their weights. Contact, which bounds every step on it,
//! is beside it in [`ContactGuard`].

use std::sync::Arc;

use glam::DVec3;

use super::contact_guard::ContactGuard;
use super::setup::contact_distances::ContactDistances;
use super::setup::shape::Shape;
use crate::contact::{Bodies, Configuration};
use crate::control::{Cancel, Cancelled};
use crate::energy::Energy as _;
use crate::energy::fit::Fit;
use crate::energy::inflation::Inflation;
use crate::energy::pin::Pins;
use crate::energy::rigid::Rigid;
use crate::memory::MemoryLimit;
use crate::options::Options;
use crate::solver::Term;
use crate::solver::newton::Model;

/// Weight of the rigid groups' term: stiff beside the surface term's 1, and yet soft enough to turn by some degrees in a step.
const RIGIDITY: f64 = 10.0;

/// The area at a garment's vertices from which on contacts are as stiff as the barrier's weight says, in the space in which the
/// skeleton is 2 long. What presses a garment against a body goes by area. Pairs of finer garments carry less each, and with as much
/// stiffness they would carry it in the last hundredth of d-hat, where every step loses them and finds them again by running
/// into them.
const CONTACT_AREA: f64 = 5e-4;
/// The share of that stiffness that the finest have.
const SMALLEST_SHARE: f64 = 1e-3;

/// Energies with their weights, and contact.
pub struct Objective {
    shape: Arc<Shape>,
    fit: Option<Fit>,
    inflation: Option<Inflation>,
    /// The barrier, its candidate pairs and CCD.
    pub contact: ContactGuard,
    weights: Options,
    barrier_weight: f64,
    /// The barrier's weight is multiplied by this.
    contact_share: f64,
    /// Nothing of the garment is held to a place.
    roams: bool,
    /// Carried pieces are not held to their places.
    carried_roam: bool,
    /// Where all of the garment is held to, in a key pose.
    hold: Option<Pins>,
}

impl Objective {
    /// The objective without (inflation) or with the fit term; the barrier is that of the inflation.
    pub fn new(
        shape: Arc<Shape>,
        fit: Option<Fit>,
        bodies: Arc<Bodies>,
        distances: ContactDistances,
        weights: &Options,
        cancel: Cancel,
    ) -> Self {
        Self {
            shape,
            fit,
            inflation: None,
            contact_share: contact_share(&bodies),
            contact: ContactGuard::new(bodies, distances, MemoryLimit::new(weights.memory_limit), cancel),
            weights: weights.clone(),
            barrier_weight: weights.inflation_barrier_weight,
            roams: false,
            carried_roam: false,
            hold: None,
        }
    }

    /// Leaves out what holds the garment to places of the target: curves along bones, pins, carried pieces. They are those of
    /// its own pose, and the body is on the way there.
    pub fn release_places(&mut self) {
        self.roams = true;
    }

    /// Leaves out the places of carried pieces, which are those on the avatar's own shape.
    pub fn release_carried(&mut self) {
        self.carried_roam = true;
    }

    /// Holds the garment to places that move with t.
    pub fn hold(&mut self, hold: Pins) {
        self.hold = Some(hold);
    }

    /// Bytes that it holds.
    pub fn memory(&self) -> u64 {
        self.terms().iter().map(|term| term.energy.memory()).sum::<u64>() + self.contact.memory()
    }

    /// Sets where the barrier towards the avatar begins, and the weight of the barrier as a whole. The pairs must be found
    /// again by [`ContactGuard::rebuild_candidates`].
    pub fn set_contact(&mut self, dhat_avatar: f64, weight: f64) {
        self.contact.set_dhat_avatar(dhat_avatar);
        self.barrier_weight = weight;
    }

    /// The rigid groups.
    pub fn rigid(&self) -> &Rigid {
        &self.shape.rigid
    }

    /// The pins.
    pub fn pins(&self) -> &Pins {
        &self.shape.pins
    }

    /// The multiplier and penalty of t, while the augmented Lagrangian runs.
    pub fn inflation(&self) -> Option<&Inflation> {
        self.inflation.as_ref()
    }

    /// Sets or removes the multiplier and penalty of t.
    pub fn set_inflation(&mut self, inflation: Option<Inflation>) {
        self.inflation = inflation;
    }

    /// The largest fraction of the avatar's motion by `dt` that a resting garment allows, by
    /// [`ContactGuard::max_feasible_step`].
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn max_feasible_inflation(&mut self, at: Configuration<'_>, dt: f64) -> Result<Option<f64>, Cancelled> {
        let still = vec![DVec3::ZERO; at.x.len()];
        self.max_feasible_step(at, &still, dt, 1.0)
    }
}

/// How stiff contacts of the garment are, as a share of what the barrier's weight says.
fn contact_share(bodies: &Bodies) -> f64 {
    let triangles = &bodies.garment.surface.triangles;
    let area = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|v| bodies.rest(v));
        0.5 * (b - a).cross(c - a).length()
    };
    // A surface has twice as many triangles as vertices.
    let at_a_vertex = 2.0 * triangles.iter().map(area).sum::<f64>() / triangles.len().max(1) as f64;
    (at_a_vertex / CONTACT_AREA).clamp(SMALLEST_SHARE, 1.0)
}

impl Model for Objective {
    fn terms(&self) -> Vec<Term<'_>> {
        let shape = &*self.shape;
        let w = &self.weights;
        let mut terms: Vec<Term<'_>> = vec![
            Term { energy: &shape.surface, weight: w.surface_weight },
            Term { energy: &shape.attachment, weight: w.surface_weight },
            Term { energy: &shape.curvature, weight: w.curvature_weight },
            Term { energy: &shape.torsion, weight: w.torsion_weight },
            Term { energy: self.contact.barrier(), weight: self.contact_share * self.barrier_weight },
        ];
        // Terms that a garment does not have are not asked for their derivatives in every iteration.
        if !self.roams {
            terms.insert(4, Term { energy: &shape.position, weight: w.position_weight });
        }
        if !shape.pins.is_empty() && !self.roams {
            terms.push(Term { energy: &shape.pins, weight: w.pin_weight });
        }
        if !shape.borders.is_empty() {
            terms.push(Term { energy: &shape.borders, weight: w.surface_weight });
        }
        if !shape.carry.is_empty() && !self.roams && !self.carried_roam {
            terms.push(Term { energy: &shape.carry, weight: w.surface_weight });
        }
        if !shape.rigid.is_empty() {
            terms.push(Term { energy: &shape.rigid, weight: RIGIDITY });
        }
        if let Some(hold) = &self.hold {
            terms.push(Term { energy: hold, weight: 1.0 });
        }
        if let Some(inflation) = &self.inflation {
            terms.push(Term { energy: inflation, weight: 1.0 });
        }
        if let Some(fit) = &self.fit {
            terms.push(Term { energy: fit, weight: w.fit_weight });
        }
        terms
    }

    fn max_feasible_step(
        &mut self,
        at: Configuration<'_>,
        dx: &[DVec3],
        dt: f64,
        longest: f64,
    ) -> Result<Option<f64>, Cancelled> {
        self.contact.max_feasible_step(at, dx, dt, longest)
    }
}
