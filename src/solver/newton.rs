//! Newton steps on the objective, with t as a border of the system.
//!
//! One factorisation answers for both right-hand sides of
//!
//! ```text
//! dx = p0 + dt p1,    H p0 = -g,    H p1 = -b
//! ```
//!
//! so that a caller may choose how far t goes: from the bordered system, or along a path.

use std::time::Instant;

use glam::DVec3;

use super::Term;
use super::assembly::{self, System};
use super::cholesky::Factor;
use super::line_search::backtrack;
use super::pattern::{PairCollector, Pattern};
use super::profile::Profile;
use crate::control::{Cancel, Cancelled};
use crate::energy::Configuration;
use crate::error::{Error, ErrorKind, Result};
use crate::memory::{MemoryLimit, bytes};

/// The unknowns.
#[derive(Clone, Debug, Default)]
pub struct State {
    /// Garment vertices.
    pub x: Vec<DVec3>,
    /// Inflation parameter.
    pub t: f64,
}

impl State {
    /// The unknowns as energies see them.
    pub fn configuration(&self) -> Configuration<'_> {
        Configuration { x: &self.x, t: self.t }
    }
}

/// What is minimised, and how far one may go.
pub trait Model {
    /// The weighted energies.
    fn terms(&self) -> Vec<Term<'_>>;

    /// Makes the energies valid along the whole step (`dx`, `dt`) from `at`, and returns the largest fraction of it, at
    /// most `longest`, along which nothing intersects. `None` where the memory for that ran out: nothing is known of the
    /// step, and the energies are not valid.
    ///
    /// # Errors
    /// [`Cancelled`].
    fn max_feasible_step(
        &mut self,
        at: Configuration<'_>,
        dx: &[DVec3],
        dt: f64,
        longest: f64,
    ) -> Result<Option<f64>, Cancelled>;
}

/// What the solver has done, for reports.
#[derive(Clone, Debug, Default)]
pub struct Counters {
    /// Linear systems assembled.
    pub assemblies: u32,
    /// Numeric factorisations.
    pub factorisations: u32,
    /// Symbolic factorisations.
    pub analyses: u32,
    /// Time of all that but for the model's part, [`Model::max_feasible_step`].
    pub profile: Profile,
}

/// The result of one accepted step.
#[derive(Clone, Copy, Debug)]
pub struct Accepted {
    /// The objective before the step.
    pub before: f64,
    /// The objective after the step.
    pub after: f64,
    /// Squared Newton decrement `-g^T dx`: twice the decrease that the quadratic model promises.
    pub decrement: f64,
    /// Largest displacement of a vertex.
    pub displacement: f64,
    /// Whether the step was damped, so that the decrement promises too little.
    pub damped: bool,
}

/// The largest coordinate of a vertex's displacement in one step. Swept volumes, and with them the candidate pairs,
/// grow quickly beyond it.
const MAX_DISPLACEMENT: f64 = 0.1;
/// Multiple of the mean diagonal that is always added to the Hessian: surface and contact terms are blind to
/// similarities of a garment that nothing holds.
const MIN_DAMPING: f64 = 1e-7;
/// A step that keeps less than this fraction is short_steps: it slides along contact nearer than the step is long. After so
/// many of them, one after the other, the shift grows by [`DAMPING_FACTOR`] at every further one, up to a limit, and falls
/// again with steps that are free: then stiff directions, along which contact opens, come before soft ones.
const SHORT_STEP: f64 = 0.05;
const MAX_SHORT_STEPS: u32 = 3;
const LONG_STEP: f64 = 0.5;
const DAMPING_FACTOR: f64 = 100.0;
const MAX_DAMPING: f64 = 0.1;
/// Shift at which a matrix is given up.
const MAX_DIAGONAL_SHIFT: f64 = 1e4;

/// A Newton solver for one pattern that grows as contacts come.
pub struct Newton {
    pattern: Pattern,
    factor: Factor,
    system: System,
    /// Two columns: p0 and p1.
    response: Vec<f64>,
    dx: Vec<DVec3>,
    trial: Vec<DVec3>,
    /// The value of each term at the present state, where it is known.
    values: Option<Vec<f64>>,
    /// The present shift.
    damping: f64,
    /// Cramped steps one after the other.
    short_steps: u32,
    cancel: Cancel,
    limit: MemoryLimit,
    /// What has been done so far.
    pub counters: Counters,
}

impl Newton {
    /// A solver whose pattern holds the stencils of `terms`, which never takes more memory than `limit` and ends at its
    /// next checkpoint once somebody asks to stop.
    ///
    /// # Errors
    /// `Internal` where memory runs out, `MemoryLimit`, `Cancelled`.
    pub fn new(vertex_count: usize, terms: &[Term<'_>], limit: MemoryLimit, cancel: Cancel) -> Result<Self> {
        let clock = Instant::now();
        let mut pairs = PairCollector::default();
        for term in terms {
            term.energy.stencils(&mut |vertices| pairs.add_clique(vertices));
        }
        let pattern = Pattern::new(vertex_count, pairs);
        let mut factor = Factor::new(cancel.clone());
        factor.analyse(limit.reserving(System::memory_for(&pattern)), &pattern)?;
        let profile = Profile { analysis: clock.elapsed(), ..Profile::default() };
        Ok(Self {
            factor,
            limit,
            pattern,
            system: System::new(cancel.clone()),
            response: Vec::new(),
            dx: Vec::new(),
            trial: Vec::new(),
            values: None,
            damping: MIN_DAMPING,
            short_steps: 0,
            cancel,
            counters: Counters { analyses: 1, profile, ..Counters::default() },
        })
    }

    /// Bytes that it holds.
    pub fn memory(&self) -> u64 {
        self.pattern.memory()
            + self.factor.memory()
            + self.system.memory()
            + bytes(&self.response)
            + bytes(&self.dx)
            + bytes(&self.trial)
    }

    /// Assembles and factorises the system at `at`, and solves for the response of the vertices; with `border`, for that
    /// to a change of t, or of the parameter whose border the energies hand on, as well.
    ///
    /// # Errors
    /// `Internal` where the Hessian cannot be made positive definite or memory runs out, `MemoryLimit`, `Cancelled`.
    pub fn linearise(&mut self, terms: &[Term<'_>], at: Configuration<'_>, border: bool) -> Result<()> {
        let missing = self.assemble(terms, at)?;
        if !missing.is_empty() {
            let clock = Instant::now();
            self.pattern = self.pattern.extended(missing);
            let held = System::memory_for(&self.pattern);
            self.factor.analyse(self.limit.reserving(held), &self.pattern)?;
            self.counters.analyses += 1;
            self.counters.profile.analysis += clock.elapsed();
            self.assemble(terms, at)?;
        }

        let clock = Instant::now();
        self.factorise()?;
        self.counters.profile.factorisation += clock.elapsed();
        let clock = Instant::now();
        self.response.clear();
        self.response.extend(self.system.gradient.iter().map(|g| -g));
        if border {
            self.response.extend(self.system.border.iter().map(|b| -b));
        }
        self.factor.solve(&mut self.response, if border { 2 } else { 1 });
        self.counters.profile.solve += clock.elapsed();
        if self.response.iter().any(|v| !v.is_finite()) {
            return Err(Error::new(ErrorKind::Internal, "the linear solve gave a value that is not finite"));
        }
        Ok(())
    }

    fn assemble(&mut self, terms: &[Term<'_>], at: Configuration<'_>) -> Result<PairCollector, Cancelled> {
        let clock = Instant::now();
        let missing = self.system.assemble(&self.pattern, terms, at)?;
        self.counters.assemblies += 1;
        self.counters.profile.assembly += clock.elapsed();
        self.system.note_times(terms, &mut self.counters.profile);
        Ok(missing)
    }

    fn factorise(&mut self) -> Result<()> {
        let n = self.pattern.vertex_count();
        let mean = (0..n as u32)
            .flat_map(|j| self.pattern.diagonal(j))
            .map(|d| self.system.hessian[d])
            .sum::<f64>()
            .max(f64::MIN_POSITIVE)
            / (3 * n) as f64;
        let mut shift = self.damping * mean;
        let mut added = 0.0;
        while shift <= MAX_DIAGONAL_SHIFT * mean {
            for j in 0..n as u32 {
                for d in self.pattern.diagonal(j) {
                    self.system.hessian[d] += shift - added;
                }
            }
            added = shift;
            self.counters.factorisations += 1;
            if self.factor.factorise(&self.pattern, &self.system.hessian)? {
                return Ok(());
            }
            shift *= 100.0;
        }
        Err(Error::new(ErrorKind::Internal, "the Hessian could not be made positive definite"))
    }

    /// Derivative of the objective with respect to t at the last linearisation.
    pub fn t_gradient(&self) -> f64 {
        self.system.t_gradient
    }

    /// The change of t that the bordered system asks for.
    pub fn newton_dt(&self) -> f64 {
        let n = self.system.gradient.len();
        let (p0, p1) = self.response.split_at(n);
        let along = |p: &[f64]| self.system.border.iter().zip(p).map(|(b, p)| b * p).sum::<f64>();
        let stiffness = self.system.t_hessian + along(p1);
        let force = -(self.system.t_gradient + along(p0));
        if stiffness > 0.0 { force / stiffness } else { 0.0 }
    }

    /// Sets the direction to `p0 + dt p1`, cut to the step limit. Returns the fraction that is left of it.
    pub fn set_direction(&mut self, dt: f64) -> f64 {
        let n = self.system.gradient.len();
        let (p0, p1) = self.response.split_at(n);
        self.dx.clear();
        self.dx.extend((0..n / 3).map(|v| {
            let p = DVec3::from_slice(&p0[3 * v..]);
            if dt == 0.0 { p } else { p + dt * DVec3::from_slice(&p1[3 * v..]) }
        }));
        let largest = self.dx.iter().fold(0.0_f64, |m, d| m.max(d.abs().max_element()));
        let kept = if largest > MAX_DISPLACEMENT { MAX_DISPLACEMENT / largest } else { 1.0 };
        if kept < 1.0 {
            for d in &mut self.dx {
                *d *= kept;
            }
        }
        kept
    }

    /// The direction that [`Self::set_direction`] set.
    pub fn direction(&self) -> &[DVec3] {
        &self.dx
    }

    /// Directional derivative of the objective along the direction with `dt`.
    fn slope(&self, dt: f64) -> f64 {
        let g = &self.system.gradient;
        let x: f64 = self.dx.iter().enumerate().map(|(v, d)| DVec3::from_slice(&g[3 * v..]).dot(*d)).sum();
        x + dt * self.system.t_gradient
    }

    /// The value of each term at `at`, the present state, unweighted.
    pub fn values(&mut self, terms: &[Term<'_>], at: Configuration<'_>) -> &[f64] {
        self.values.get_or_insert_with(|| assembly::values(terms, at, &mut self.counters.profile))
    }

    /// To be called where the state or the energies were changed by others since the last step: what is remembered of
    /// their values is forgotten.
    pub fn forget_values(&mut self) {
        self.values = None;
    }

    /// Norm of the gradient with respect to the vertices.
    pub fn gradient_norm(&self) -> f64 {
        self.system.gradient.iter().map(|g| g * g).sum::<f64>().sqrt()
    }

    /// Damps the next steps where `fraction`, what was kept of the last one, is small again and again.
    fn update_damping(&mut self, fraction: f64) {
        if fraction < SHORT_STEP {
            self.short_steps += 1;
            if self.short_steps >= MAX_SHORT_STEPS {
                self.damping = (DAMPING_FACTOR * self.damping).min(MAX_DAMPING);
            }
        } else {
            self.short_steps = 0;
            if fraction >= LONG_STEP {
                // Rounding must not leave a trace of damping.
                let less = self.damping / DAMPING_FACTOR;
                self.damping = if less < 2.0 * MIN_DAMPING { MIN_DAMPING } else { less };
            }
        }
    }

    /// One step along the path: the response to an advance of t by `dt`, as far as the model allows it. There is no test
    /// on the objective, which must be free to rise with t. Returns the fraction of `dt` that was taken.
    ///
    /// # Errors
    /// As [`Self::linearise`].
    pub fn continue_t(&mut self, model: &mut dyn Model, state: &mut State, dt: f64) -> Result<f64> {
        let taken = self.continuation_step(model, state, dt, true)?;
        state.t += taken * dt;
        Ok(taken)
    }

    /// The same along another path, in a parameter s of the energies by which they hand on the border: the response to an
    /// advance of s by `ds` at fixed t. It is the caller who then moves the energies on by the fraction returned.
    ///
    /// # Errors
    /// As [`Self::linearise`].
    pub fn continue_barrier(&mut self, model: &mut dyn Model, state: &mut State, ds: f64) -> Result<f64> {
        self.continuation_step(model, state, ds, false)
    }

    /// The fraction of the direction with `dt` that the model allows.
    fn feasible(&self, model: &mut dyn Model, state: &State, dt: f64) -> Result<f64, Cancelled> {
        // Without the memory to tell there is no step. It is the model's owner who looks whether that ends the run.
        Ok(model.max_feasible_step(state.configuration(), &self.dx, dt, 1.0)?.unwrap_or(0.0))
    }

    fn continuation_step(
        &mut self,
        model: &mut dyn Model,
        state: &mut State,
        advance: f64,
        moves_t: bool,
    ) -> Result<f64> {
        self.linearise(&model.terms(), state.configuration(), true)?;
        let kept = self.set_direction(advance);
        let dt = if moves_t { kept * advance } else { 0.0 };
        let fraction = self.feasible(model, state, dt)?;
        for (x, d) in state.x.iter_mut().zip(&self.dx) {
            *x += fraction * *d;
        }
        self.values = None;
        self.update_damping(fraction);
        Ok(fraction * kept)
    }

    /// One step of Newton's method, at fixed t or, with `free_t`, on the garment and t together (t never leaves [0, 1]):
    /// linearise, bound, search. `None` where no fraction of the step decreases the objective: the state is as good as
    /// rounding allows, or contact leaves no way.
    ///
    /// # Errors
    /// As [`Self::linearise`].
    pub fn newton_step(&mut self, model: &mut dyn Model, state: &mut State, free_t: bool) -> Result<Option<Accepted>> {
        self.linearise(&model.terms(), state.configuration(), free_t)?;
        let wanted = if free_t { self.newton_dt().clamp(-state.t, 1.0 - state.t) } else { 0.0 };
        let kept = self.set_direction(wanted);
        let dt = kept * wanted;
        let slope = self.slope(dt);

        let longest = self.feasible(model, state, dt)?;

        let clock = Instant::now();
        let terms = model.terms();
        let start = state.configuration();
        let profile = &mut self.counters.profile;
        let before = self.values.take().unwrap_or_else(|| assembly::values(&terms, start, profile));
        let before = assembly::weighted(&terms, &before);
        let found =
            backtrack(&terms, start, &self.dx, dt, slope, before, longest, &mut self.trial, &self.cancel, profile)?;
        profile.line_search += clock.elapsed();
        let damped = self.damping > MIN_DAMPING;
        self.update_damping(longest);
        Ok(found.map(|found| {
            std::mem::swap(&mut state.x, &mut self.trial);
            state.t += found.fraction * dt;
            self.values = Some(found.values);
            Accepted {
                before,
                after: found.objective,
                decrement: -slope / kept,
                damped,
                displacement: found.fraction * self.dx.iter().fold(0.0_f64, |m, d| m.max(d.length())),
            }
        }))
    }
}
