//! One morph of the avatar: the body goes from its own shape to the morph's with the machine of REPOSE, takes the garment
//! along, and the garment is fitted there.
//!
//! Every vertex of the body moves straight, so the whole way is one piece for the collision test.

use std::sync::{Arc, Mutex, PoisonError};

use glam::DVec3;

use super::shared::Shared;
use super::snapshot::Snapshot;
use super::verification::Verdict;
use crate::contact::{Avatar, Configuration, Surface};
use crate::control::{Cancel, Progress, Stage};
use crate::error::{Error, ErrorKind, Result};
use crate::geometry::mesh::TriangleMesh;
use crate::input::body::Body;
use crate::input::diagnostic::Element;
use crate::input::precision::Precision;
use crate::memory::{MemoryLimit, Part};
use crate::options::Options;
use crate::sdf::{Field, FieldOptions};
use crate::solver::newton::{Model, Newton, State};
use crate::stage::finish;
use crate::stage::fit::FitStage;
use crate::stage::objective::Objective;
use crate::stage::repose::Repose;
use crate::stage::setup::contact_distances::ContactDistances;
use crate::stage::setup::layer_skin::places_beneath;
use crate::stage::setup::problem::collapse_unused;

/// How often the fit goes on with wider contact distances where rounding has made its result intersect.
const MAX_DISTANCE_DOUBLINGS: u32 = 2;

/// No vertex of the body goes farther, in the normalised space: five times the skeleton's size is a morph in another unit.
const FARTHEST: f64 = 10.0;

/// All that it takes, apart from the session.
pub(super) struct MorphSolve {
    pub(super) snapshot: Snapshot,
    pub(super) options: Options,
    /// As the result keeps them.
    pub(super) distances: ContactDistances,
    /// Pairs of garment triangles that are exempt from contact in the result.
    pub(super) exempt: Vec<[u32; 2]>,
    /// That of the garment.
    pub(super) precision: Precision,
    pub(super) threads: usize,
    /// Bytes that the session holds.
    pub(super) held: u64,
    pub(super) cancel: Cancel,
    /// What is known from other sessions.
    pub(super) shared: Shared,
    /// What is to be published.
    pub(super) progress: Arc<Mutex<Progress>>,
}

/// The avatar in another shape.
pub(super) struct Reshaped {
    /// In the normalised space.
    pub(super) avatar: TriangleMesh,
    /// What of it the garment is fitted to.
    pub(super) fitted: Arc<TriangleMesh>,
}

/// What came of it.
pub(super) enum Outcome {
    /// Offsets of the caller's garment vertices; and where the garment meets itself or the body halfway, how many pairs of
    /// triangles do, and the first.
    Solved { offsets: Vec<DVec3>, between: Option<(usize, Vec<Element>)> },
    /// The garment gives way up to this weight only.
    Stalled { weight: f64 },
}

impl MorphSolve {
    /// The answer to `offsets` of the avatar's vertices, in its coordinate system.
    ///
    /// # Errors
    /// `InvalidArgument` for a morph that goes too far, `Cancelled`, `MemoryLimit`, `Internal`.
    pub(super) fn run(self, offsets: &[DVec3]) -> Result<Outcome> {
        let problem = self.snapshot.problem.clone();
        if offsets.iter().all(|&offset| offset == DVec3::ZERO) {
            return Ok(Outcome::Solved { offsets: vec![DVec3::ZERO; problem.weld.to_welded.len()], between: None });
        }
        let body = Arc::new(self.body(offsets, 1.0));
        let Reshaped { avatar, fitted } = self.reshaped(&body)?;
        let (mut state, mut objective) = match self.carry(&avatar)? {
            Ok(arrived) => arrived,
            Err(weight) => return Ok(Outcome::Stalled { weight }),
        };
        self.cancel.check()?;
        let options = FieldOptions { voxel: self.options.voxel_size, threads: self.threads as u32 };
        let field = self.shared.field(&fitted, options, &self.cancel)?;
        let mut fit = problem.fit_objective_on(&avatar, field, &state.x, &self.options, &self.cancel)?;
        fit.release_carried();
        fit.contact.inherit_state(&objective.contact);
        objective = fit;
        for doubling in 0..=MAX_DISTANCE_DOUBLINGS {
            if doubling > 0 {
                objective.contact.double_distances();
            }
            self.fit(&mut objective, &mut state)?;
            let answer = self.offsets(&state.x);
            if self.verify(&answer, 1.0, &body)?.counted.is_clean() {
                let halfway = self.verify(&answer, 0.5, &Arc::new(self.body(offsets, 0.5)))?;
                let pairs = halfway.counted.new_garment_garment() + halfway.counted.garment_avatar;
                let first = halfway.diagnostics().first().map_or_else(Vec::new, |found| found.elements());
                let offsets = problem.weld.scatter(&answer);
                return Ok(Outcome::Solved { offsets, between: (pairs > 0).then_some((pairs as usize, first)) });
            }
        }
        Ok(Outcome::Stalled { weight: 1.0 })
    }

    /// The avatar as `body` has it.
    ///
    /// # Errors
    /// As [`Self::run`].
    pub(super) fn reshaped(&self, body: &Body) -> Result<Reshaped> {
        let avatar = self.normalised(body);
        self.check(&avatar)?;
        let fitted = match body.with_mesh(avatar.clone()).fitted() {
            None => avatar.clone(),
            Some(mut fitted) => {
                collapse_unused(&mut fitted);
                fitted
            }
        };
        Ok(Reshaped { avatar, fitted: Arc::new(fitted) })
    }

    /// Takes the body to `avatar`, and the garment along: where it is then, with the contacts in which it is; or how far the
    /// garment lets the body go, as a share of the way.
    ///
    /// # Errors
    /// As [`Self::run`].
    pub(super) fn carry(&self, avatar: &TriangleMesh) -> Result<std::result::Result<(State, Objective), f64>> {
        let mut state = State { x: self.snapshot.x.clone(), t: 0.0 };
        let (objective, arrived) = self.go(avatar, &mut state)?;
        Ok(if arrived { Ok((state, objective)) } else { Err(state.t) })
    }

    /// The body with this much of the morph, in its caller's coordinates. Layers go along with the body beneath.
    fn body(&self, offsets: &[DVec3], weight: f64) -> Body {
        shaped(&self.snapshot.body, offsets, weight)
    }

    /// Refuses what is far too large, and what there is no memory for.
    fn check(&self, end: &TriangleMesh) -> Result<()> {
        let start = &self.snapshot.problem.avatar.positions;
        let farthest = start
            .iter()
            .zip(&end.positions)
            .map(|(a, b)| a.distance(*b))
            .fold(0.0, |m: f64, d| if d > m || d.is_nan() { d } else { m });
        if farthest.is_nan() || farthest > FARTHEST {
            return Err(Error::new(
                ErrorKind::InvalidArgument,
                format!(
                    "it moves a vertex by {:.3e} times the size of the target skeleton; offsets are in the unit of the target",
                    0.5 * farthest
                ),
            ));
        }
        let bytes = Field::estimate(end, self.options.voxel_size)?;
        let limit = MemoryLimit::new(self.options.memory_limit).reserving(self.held);
        limit.check(&[Part { name: "the distance field of the avatar with its morph", bytes }])
    }

    fn normalised(&self, body: &Body) -> TriangleMesh {
        let problem = &self.snapshot.problem;
        let system = self.snapshot.coordinate_system();
        let point = |&p: &DVec3| problem.target_normalization.normalise(system.position_to_internal(p));
        let mut mesh = TriangleMesh {
            positions: body.mesh.positions.iter().map(point).collect(),
            triangles: problem.avatar.triangles.clone(),
        };
        collapse_unused(&mut mesh);
        mesh
    }

    /// Takes the body to `end`, and the garment with it. False where the garment does not let it, at the weight in `state`.
    fn go(&self, end: &TriangleMesh, state: &mut State) -> Result<(Objective, bool)> {
        let problem = &self.snapshot.problem;
        let start = problem.avatar.positions.clone();
        let motion: Vec<DVec3> = start.iter().zip(&end.positions).map(|(&a, &b)| b - a).collect();
        let places = places_beneath(&problem.avatar, &state.x);
        let along = places.iter().map(|place| at(&motion, place)).collect();
        let surface = Surface::new(start.len(), problem.avatar.triangles.clone());
        let bodies = problem.bodies(Avatar { surface, start, motion });
        let mut objective =
            Objective::new(problem.shape.clone(), None, bodies, self.distances, &self.options, self.cancel.clone());
        objective.release_carried();
        objective.contact.set_intersecting_at_rest(&problem.designed_intersections);
        objective.set_contact(self.distances.inflation_dhat, self.options.inflation_barrier_weight);
        objective.contact.initialise(Configuration { x: &state.x, t: 0.0 }, &self.exempt);
        let mut newton = self.newton(&objective, state)?;
        let mut step = Repose::new(along);
        for iteration in 1..=self.options.max_iterations {
            self.say(Stage::Repose, state.t, iteration);
            match step.iterate(&mut objective, &mut newton, state) {
                Ok(false) => {}
                Ok(true) => return Ok((objective, true)),
                Err(error) if error.kind == ErrorKind::InflationStalled => break,
                Err(error) => return Err(error),
            }
            if objective.contact.update_exemptions(state.configuration())? {
                newton.forget_values();
            }
            self.check_contacts(&objective)?;
        }
        let arrived = state.t >= 1.0;
        Ok((objective, arrived))
    }

    fn fit(&self, objective: &mut Objective, state: &mut State) -> Result<()> {
        let mut newton = self.newton(objective, state)?;
        let mut fit = FitStage::begin(objective, state, &self.options);
        loop {
            self.say(Stage::Fit, 1.0, fit.iterations);
            let end = fit.iterate(objective, &mut newton, state, &self.options)?;
            let ended = end.is_some() || fit.iterations >= self.options.max_iterations;
            if ended {
                finish::finish(&self.snapshot.problem, objective, state)?;
            }
            if objective.contact.update_exemptions(state.configuration())? {
                newton.forget_values();
            }
            self.check_contacts(objective)?;
            if ended {
                return Ok(());
            }
        }
    }

    /// Refuses to go on where contacts were left out for want of memory.
    pub(super) fn check_contacts(&self, objective: &Objective) -> Result<()> {
        if objective.contact.exceeds_pair_budget() {
            let limit = MemoryLimit::new(self.options.memory_limit).reserving(self.held);
            return Err(limit.exceeded_error("contacts of the garment, more pairs than there is budget for"));
        }
        Ok(())
    }

    pub(super) fn newton(&self, objective: &Objective, state: &State) -> Result<Newton> {
        let limit = MemoryLimit::new(self.options.memory_limit).reserving(self.held + objective.memory());
        Newton::new(state.x.len(), &objective.terms(), limit, self.cancel.clone())
    }

    pub(super) fn say(&self, stage: Stage, t: f64, iteration: u32) {
        let mut progress = self.progress.lock().unwrap_or_else(PoisonError::into_inner);
        (progress.stage, progress.t, progress.iteration) = (stage, t, iteration);
    }

    /// A welded vertex of the result as it is read, caps left out.
    pub(super) fn read(&self, x: DVec3) -> DVec3 {
        self.precision.round(self.snapshot.restored(x))
    }

    /// From the result to `x`, for each welded vertex, rounded as it is read.
    fn offsets(&self, x: &[DVec3]) -> Vec<DVec3> {
        let with_caps = self.snapshot.with_caps(x);
        let before = self.snapshot.x_with_caps();
        with_caps
            .iter()
            .zip(&before)
            .map(|(&to, &from)| self.precision.round(self.read(to) - self.read(from)))
            .collect()
    }

    /// The exact verifier, on the garment as a host has it with this much of the answer.
    fn verify(&self, offsets: &[DVec3], weight: f64, body: &Arc<Body>) -> Result<Verdict> {
        let problem = &self.snapshot.problem;
        let moved = |(&x, &offset): (&DVec3, &DVec3)| self.precision.round(self.read(x) + weight * offset);
        let garment = TriangleMesh {
            positions: self.snapshot.x.iter().zip(offsets).map(moved).collect(),
            triangles: problem.triangles.clone(),
        };
        Verdict::new(&garment, &problem.weld, body, self.snapshot.initial_intersections(), &self.cancel)
    }
}

/// `body` with so much of `offsets` of its vertices, in its caller's coordinates. Layers go along with the body beneath.
pub(super) fn shaped(body: &Body, offsets: &[DVec3], weight: f64) -> Body {
    let mut mesh = TriangleMesh::clone(&body.mesh);
    let beneath = places_beneath(&body.avatar(), body.layer_positions());
    let (own, layers) = mesh.positions.split_at_mut(offsets.len());
    own.iter_mut().zip(offsets).for_each(|(p, &offset)| *p += weight * offset);
    for (p, place) in layers.iter_mut().zip(&beneath) {
        *p += weight * at(offsets, place);
    }
    body.with_mesh(mesh)
}

/// The mean of `values` at a place of a triangle; 0 at no place.
fn at(values: &[DVec3], place: &Option<([u32; 3], [f64; 3])>) -> DVec3 {
    let corners = place.iter().flat_map(|(corners, shares)| corners.iter().zip(shares));
    corners.map(|(&v, &share)| share * values[v as usize]).sum()
}
