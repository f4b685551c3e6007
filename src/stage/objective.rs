//! The objective of Steps 2 and 3 (Eqs. 6 and 7) and the contact that bounds every step on it.

use std::sync::Arc;

use crate::contact::{Bodies, BroadPhase, Configuration, Step, ccd};
use crate::energy::attachment::Attachment;
use crate::energy::barrier::{Activity, Barrier, BarrierSettings};
use crate::energy::curve::{Curvature, Torsion};
use crate::energy::fit::Fit;
use crate::energy::inflation::Inflation;
use crate::energy::position::Position;
use crate::energy::surface::Surface;
use crate::options::Options;
use crate::solver::Term;
use crate::solver::newton::Model;
use glam::DVec3;

/// The shape terms, which both steps share.
pub struct Shape {
    /// Surface shape (Eq. 2).
    pub surface: Surface,
    /// Loose pieces on the piece beside them.
    pub attachment: Attachment,
    /// Curvature of the boundary curves (Eq. 5).
    pub curvature: Curvature,
    /// Torsion of the boundary curves.
    pub torsion: Torsion,
    /// Position of the boundary curves along their bones (Eq. 3).
    pub position: Position,
}

/// Energies with their weights, and contact.
pub struct Objective {
    shape: Arc<Shape>,
    fit: Option<Fit>,
    inflation: Option<Inflation>,
    barrier: Barrier,
    bodies: Arc<Bodies>,
    broad_phase: BroadPhase,
    weights: Options,
}

impl Objective {
    /// The objective without (Step 2) or with (Step 3) the fit term. `dhat_avatar` is where the barrier towards the
    /// avatar begins.
    pub fn new(shape: Arc<Shape>, fit: Option<Fit>, bodies: Arc<Bodies>, dhat_avatar: f64, weights: &Options) -> Self {
        let settings = BarrierSettings {
            dhat_self: weights.dhat,
            dhat_avatar,
            floor: weights.separation_floor,
            ..BarrierSettings::default()
        };
        let barrier = Barrier::new(bodies.clone(), settings);
        Self {
            shape,
            fit,
            inflation: None,
            broad_phase: BroadPhase::new(&bodies),
            barrier,
            bodies,
            weights: weights.clone(),
        }
    }

    /// Finds the pairs that are near at `at`, where nothing moves.
    pub fn settle(&mut self, at: Configuration<'_>) {
        self.find_pairs(at, None);
    }

    /// Changes where the barrier towards the avatar begins, and the weight of the barrier as a whole. The pairs must be
    /// found again by [`Self::settle`].
    pub fn set_contact(&mut self, dhat_avatar: f64, weight: f64) {
        self.barrier.set_settings(BarrierSettings { dhat_avatar, ..*self.barrier.settings() });
        self.weights.barrier_weight = weight;
    }

    /// The drive on t, where there is one.
    pub fn inflation(&self) -> Option<&Inflation> {
        self.inflation.as_ref()
    }

    /// Sets or removes the drive on t.
    pub fn set_inflation(&mut self, drive: Option<Inflation>) {
        self.inflation = drive;
    }

    /// The largest fraction of the avatar's motion by `dt` that a resting garment allows.
    pub fn admit_inflation(&mut self, at: Configuration<'_>, dt: f64) -> f64 {
        let still = vec![DVec3::ZERO; at.x.len()];
        self.admit(at, &still, dt, 1.0)
    }

    /// What is in contact at `at`, which must lie within the last step that was admitted.
    pub fn activity(&self, at: Configuration<'_>) -> Activity {
        self.barrier.activity(at)
    }

    fn find_pairs(&mut self, at: Configuration<'_>, step: Option<&Step<'_>>) {
        let BarrierSettings { dhat_self, dhat_avatar, .. } = *self.barrier.settings();
        self.broad_phase.candidates(&self.bodies, at, step, dhat_self, dhat_avatar, self.barrier.candidates_mut());
    }
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
            Term { energy: &shape.position, weight: w.position_weight },
            Term { energy: &self.barrier, weight: w.barrier_weight },
        ];
        if let Some(drive) = &self.inflation {
            terms.push(Term { energy: drive, weight: 1.0 });
        }
        if let Some(fit) = &self.fit {
            terms.push(Term { energy: fit, weight: w.fit_weight });
        }
        terms
    }

    fn admit(&mut self, at: Configuration<'_>, dx: &[DVec3], dt: f64, longest: f64) -> f64 {
        let step = Step { dx, dt };
        self.find_pairs(at, Some(&step));
        let floor = self.barrier.settings().floor;
        ccd::max_step(&self.bodies, self.barrier.candidates(), at, &step, floor, longest)
    }
}
