//! The objective with which the inflation begins, and diagnostics of a garment that touches itself or the shrunk avatar.

use super::attempts::Settings;
use super::objective::Objective;
use super::setup::contact_distances::TOUCHING;
use super::setup::problem::Problem;
use crate::contact::{Avatar, Configuration, Surface};
use crate::control::Cancel;
use crate::error::{Error, ErrorKind, Result};
use crate::input::diagnostic::Diagnostic;
use crate::options::Options;
use crate::solver::newton::State;

impl Problem {
    /// The objective of the inflation, the avatar moving with t, with the contacts at t = 0. Its minimum separation is lower
    /// than the option's where the garment is nearer to itself or the skeleton than that; its exempt pairs are the triangles
    /// that intersect or touch at the start.
    ///
    /// # Errors
    /// `NotEnclosed` where the distance to the shrunk avatar is lost in rounding; if the options are strict,
    /// `SelfIntersection` where the garment intersects or touches itself.
    pub fn inflation_objective(
        &self,
        options: &Options,
        cancel: &Cancel,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Result<Objective> {
        let (x, intersections) = self.initial_state(false);
        let at = Configuration { x, t: 0.0 };
        let mut objective = self.growing(options, cancel);
        objective.contact.initialise(at, intersections);
        let initial_intersections = objective.contact.exempt_pairs().triangle_pairs();
        let mut designed = self.designed_intersections.clone();
        designed.extend(initial_intersections);
        designed.sort_unstable();
        designed.dedup();
        if !options.strict {
            // T-junctions have a diagnostic of their own.
            designed.retain(|pair| self.joined.binary_search(pair).is_err());
        }
        report_initial_intersections(self, &designed, options.strict, diagnostics);
        if options.strict && !initial_intersections.is_empty() {
            return Err(intersects_itself(self, initial_intersections));
        }
        let near = objective.contact.activity(at);
        if near.min_distance_avatar < TOUCHING {
            return Err(Error::new(
                ErrorKind::NotEnclosed,
                format!(
                    "garment: at the start it is within {:e} of the shrunk avatar, in units in which the skeleton is 2 long; \
                     that is as good as touching. Move garment or skeleton by at least {TOUCHING:e}",
                    near.min_distance_avatar
                ),
            ));
        }
        if objective.contact.min_separation() < self.distances.min_separation {
            let vertices = objective
                .contact
                .nearest(at)
                .into_iter()
                .flat_map(|pair| objective.contact.garment_vertices(pair))
                .map(|v| self.weld.vertex_of[v as usize])
                .collect();
            diagnostics.push(Diagnostic::NearContact {
                vertices,
                to_itself: near.min_distance_self,
                to_avatar: near.min_distance_avatar,
                min_separation: objective.contact.min_separation(),
            });
        }
        Ok(objective)
    }

    /// The objective with the avatar moving with t, whose contacts are still to be found.
    fn growing(&self, options: &Options, cancel: &Cancel) -> Objective {
        let motion = self.projected.start.iter().zip(&self.projected.end).map(|(&a, &b)| b - a).collect();
        let avatar = Avatar {
            surface: Surface::new(self.projected.start.len(), self.projected.triangles.clone()),
            start: self.projected.start.clone(),
            motion,
        };
        let bodies = self.bodies(avatar);
        let mut objective = Objective::new(self.shape.clone(), None, bodies, self.distances, options, cancel.clone());
        objective.contact.set_intersecting_at_rest(&self.designed_intersections);
        objective
    }

    /// The objective of another attempt, with other settings of the contact.
    pub fn another_inflation(&self, settings: &Settings, options: &Options, cancel: &Cancel) -> Objective {
        let mut objective = self.growing(options, cancel);
        objective.contact.set_inflation_dhat(settings.inflation_dhat);
        objective.set_contact(settings.inflation_dhat, settings.inflation_barrier_weight);
        let (x, intersections) = self.initial_state(settings.as_designed);
        objective.contact.initialise(Configuration { x, t: 0.0 }, intersections);
        objective
    }

    /// The objective at the end of the inflation, at `state`, whose contacts are still to be found.
    pub fn another_inflation_at(&self, state: &State, options: &Options, cancel: &Cancel) -> Objective {
        let mut objective = self.growing(options, cancel);
        objective.contact.rebuild_candidates(state.configuration());
        objective
    }

    /// What a result says that began pulled apart.
    pub fn untangling(&self) -> Option<Diagnostic> {
        let left = &self.untangled.as_ref()?.remaining;
        let mut apart = self.designed_intersections.iter().filter(|pair| left.binary_search(pair).is_err());
        let first = apart.next()?.map(|t| self.weld.triangle_of[t as usize]);
        Some(Diagnostic::Untangled { pairs: 1 + apart.count(), remaining: left.len(), first })
    }
}

/// Reports the garment's triangles that intersect before anything has moved.
fn report_initial_intersections(
    problem: &Problem,
    initial_intersections: &[[u32; 2]],
    strict: bool,
    diagnostics: &mut Vec<Diagnostic>,
) {
    Diagnostic::list(diagnostics, initial_intersections, |pair| Diagnostic::SelfIntersection {
        triangles: pair.map(|t| problem.weld.triangle_of[t as usize]),
        touches: problem.designed_intersections.binary_search(pair).is_err(),
        strict,
    });
}

fn intersects_itself(problem: &Problem, pairs: &[[u32; 2]]) -> Error {
    let named = |pair: &[u32; 2]| {
        let [a, b] = pair.map(|t| problem.weld.triangle_of[t as usize]);
        format!("{a} and {b}")
    };
    let named: Vec<String> = pairs.iter().take(4).map(named).collect();
    Error::new(
        ErrorKind::SelfIntersection,
        format!(
            "garment: {} pairs of triangles intersect or touch before anything has moved (triangles {}{}); move them \
             apart, or switch strict off",
            pairs.len(),
            named.join(", "),
            if pairs.len() > named.len() { ", ..." } else { "" },
        ),
    )
}
