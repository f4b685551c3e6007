//! The objective with which the inflation begins, and what is told of a garment that touches itself or the shrunk avatar.

use super::objective::Objective;
use super::setup::contact_distances::TOUCHING;
use super::setup::problem::Problem;
use crate::contact::{Avatar, Configuration, Surface};
use crate::control::Cancel;
use crate::error::{Error, ErrorKind, Result};
use crate::input::diagnostic::{Element, Finding, FindingKind, Severity, Subject, describe};
use crate::options::Options;

impl Problem {
    /// The objective of Step 2, the avatar moving with t, settled at its beginning. Its minimum separation is lower than the
    /// option's where the garment is nearer to itself or the skeleton than that; its exempt holds the triangles that
    /// intersect or touch at the start.
    ///
    /// # Errors
    /// `NotEnclosed` where the distance to the shrunk avatar is lost in rounding; if the options are strict,
    /// `SelfIntersection` where the garment intersects or touches itself.
    pub fn inflation_objective(
        &self,
        options: &Options,
        cancel: &Cancel,
        findings: &mut Vec<Finding>,
    ) -> Result<Objective> {
        let at = Configuration { x: &self.rest, t: 0.0 };
        let motion = self.projected.start.iter().zip(&self.projected.end).map(|(&a, &b)| b - a).collect();
        let avatar = Avatar {
            surface: Surface::new(self.projected.start.len(), self.projected.triangles.clone()),
            start: self.projected.start.clone(),
            motion,
        };
        let bodies = self.bodies(avatar);
        let mut objective = Objective::new(self.shape.clone(), None, bodies, self.distances, options, cancel.clone());
        objective.contact.initialise(at, &self.initial_intersections);
        let initial_intersections = objective.contact.exempt_pairs().triangle_pairs();
        report_tangle(self, initial_intersections, options.strict, findings);
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
            let vertices: Vec<Element> = objective
                .contact
                .nearest(at)
                .into_iter()
                .flat_map(|pair| objective.contact.garment_vertices(pair))
                .map(|v| Element::vertex(Subject::Garment, self.weld.vertex_of[v as usize]))
                .collect();
            findings.push(Finding {
                distance: near.min_distance_self.min(near.min_distance_avatar),
                ..Finding::new(
                    FindingKind::NearContact,
                    Severity::Note,
                    &vertices,
                    format!(
                        "garment: at the start it is within {:.1e} of itself and {:.1e} of the shrunk avatar, so that the \
                         minimum separation begins at {:.1e} and rises as they part",
                        near.min_distance_self,
                        near.min_distance_avatar,
                        objective.contact.min_separation()
                    ),
                )
            });
        }
        Ok(objective)
    }
}

/// The garment's triangles that intersect before anything has moved.
fn report_tangle(problem: &Problem, initial_intersections: &[[u32; 2]], strict: bool, findings: &mut Vec<Finding>) {
    let finding = |pair: &[u32; 2]| {
        let how = if problem.initial_intersections.binary_search(pair).is_ok() {
            "intersect"
        } else {
            "touch within rounding"
        };
        let [s, t] = pair.map(|t| problem.weld.triangle_of[t as usize]);
        let elements = [s, t].map(|t| Element::triangle(Subject::Garment, t));
        let (severity, fate) = match strict {
            true => (Severity::Error, "which the option strict refuses"),
            false => {
                (Severity::Warning, "so they are let off until they come apart, and may still do so in the result")
            }
        };
        let sentence = format!("garment: triangles {s} and {t} {how} before anything has moved, {fate}");
        Finding::new(FindingKind::SelfIntersection, severity, &elements, sentence)
    };
    describe(
        findings,
        initial_intersections,
        finding,
        "pairs of garment triangles intersect before anything has moved",
    );
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
