//! Damped Newton steps with line search, and continuation steps, for a bordered system: t is an unknown beside the
//! vertices.
//!
//! The bordered system `[H b; b^T c] [dx; dt] = -[g; g_t]` is solved by block elimination: one factorisation of H
//! serves both right-hand sides of
//!
//! ```text
//! dx = p0 + dt p1,    H p0 = -g,    H p1 = -b
//! ```
//!
//! and dt follows from the Schur complement on t, `c + b^T p1`. A caller may also choose dt: then `dx` is the predictor
//! of a continuation in t, with the Newton corrector `p0` in the same step (E. L. Allgower, K. Georg: Numerical
//! Continuation Methods, 1990).
//!
//! The length of each step is limited by continuous collision detection ([`Model::max_feasible_step`]). Steps that
//! contact makes short again and again are damped as by K. Levenberg (1944) and D. W. Marquardt (1963): a multiple of
//! the mean diagonal is added to H.

use std::time::Instant;

use glam::DVec3;

use super::Term;
use super::assembly::{self, System};
use super::cholesky::{Factor, Precision};
use super::conjugate_gradients::ConjugateGradients;
use super::line_search::backtrack;
use super::pattern::{PairCollector, Pattern};
use super::profile::Profile;
use crate::control::{Cancel, Cancelled};
use crate::energy::Configuration;
use crate::error::{Error, ErrorKind, Result};
use crate::memory::{MemoryLimit, Part, bytes};

/// The unknowns.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct State {
    /// Garment vertices.
    pub x: Vec<DVec3>,
    /// Inflation parameter.
    pub t: f64,
}

impl State {
    /// The unknowns as the energies take them.
    pub fn configuration(&self) -> Configuration<'_> {
        Configuration { x: &self.x, t: self.t }
    }
}

/// The objective, and the feasible length of a step.
pub trait Model {
    /// The weighted energies.
    fn terms(&self) -> Vec<Term<'_>>;

    /// The CCD-filtered step length: makes the energies valid along the whole step (`dx`, `dt`) from `at`, and returns
    /// the largest fraction of it, at most `longest`, along which nothing intersects. `None` where the memory for that
    /// ran out: then the fraction is unknown, and the energies are not valid.
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

/// Counts of the solver's work, for reports.
#[derive(Clone, Debug, Default)]
pub struct Counters {
    /// Linear systems assembled.
    pub assemblies: u32,
    /// Numeric factorisations.
    pub factorisations: u32,
    /// Symbolic factorisations.
    pub analyses: u32,
    /// Time of that work, without the model's part, [`Model::max_feasible_step`].
    pub profile: Profile,
}

/// The result of one accepted step.
#[derive(Clone, Copy, Debug)]
pub struct Accepted {
    /// The objective before the step.
    pub before: f64,
    /// The objective after the step.
    pub after: f64,
    /// Squared Newton decrement `-g^T dx` of the whole step: twice the decrease that the quadratic model predicts.
    pub decrement: f64,
    /// The fraction of Newton's direction that was taken.
    pub fraction: f64,
    /// Largest displacement of a vertex.
    pub displacement: f64,
    /// Whether the step was damped: then the decrement underestimates the possible decrease.
    pub damped: bool,
}

/// The largest coordinate of a vertex's displacement in one step: beyond it swept volumes, and with them the candidate
/// pairs, grow quickly.
const MAX_DISPLACEMENT: f64 = 0.1;
/// Smallest damping, as a multiple of the mean diagonal that is always added to the Hessian: the surface and contact
/// terms of an unconstrained garment are invariant to similarity transformations, so that H is singular.
const MIN_DAMPING: f64 = 1e-7;
/// A step whose feasible fraction is below this counts as short: contact is nearer than the step is long. From the
/// [`MAX_SHORT_STEPS`]-th consecutive short step on, each multiplies the damping by [`DAMPING_FACTOR`], up to
/// [`MAX_DAMPING`]; each step of at least [`LONG_STEP`] divides it again. Damping shortens steps in soft directions
/// more than in stiff ones, along which contact opens.
pub(crate) const SHORT_STEP: f64 = 0.05;
const MAX_SHORT_STEPS: u32 = 3;
const LONG_STEP: f64 = 0.5;
const DAMPING_FACTOR: f64 = 100.0;
const MAX_DAMPING: f64 = 0.1;
/// Largest diagonal shift that is tried, as a multiple of the mean diagonal, for a Hessian that is not positive
/// definite.
const MAX_DIAGONAL_SHIFT: f64 = 1e4;

/// A factor with so many scalars (some 8000 vertices) is one in 32 bits. Smaller ones take too little of an iteration for
/// the two solves in place of one.
const SINGLE_FROM: usize = 4_000_000;

/// A Newton solver. Its sparsity pattern grows as contacts add pairs of vertices.
pub struct Newton {
    pattern: Pattern,
    factor: Factor,
    /// For a factor in 32 bits.
    gradients: ConjugateGradients,
    system: System,
    /// Two columns: p0 and p1.
    response: Vec<f64>,
    dx: Vec<DVec3>,
    trial: Vec<DVec3>,
    /// The value of each term at the current state, where it is known.
    values: Option<Vec<f64>>,
    /// The current damping, a multiple of the mean diagonal.
    damping: f64,
    /// Consecutive short steps.
    short_steps: u32,
    cancel: Cancel,
    limit: MemoryLimit,
    /// Counts so far.
    pub counters: Counters,
}

impl Newton {
    /// A solver whose pattern holds the stencils of `terms`. It never takes more memory than `limit`, and checks
    /// `cancel` in assembly, factorisation and line search.
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
        let mut newton = Self {
            factor: Factor::new(cancel.clone()).in_single_from(SINGLE_FROM),
            gradients: ConjugateGradients::default(),
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
            counters: Counters::default(),
        };
        newton.analyse()?;
        newton.counters.profile.analysis = clock.elapsed();
        Ok(newton)
    }

    /// Symbolic factorisation of the pattern.
    fn analyse(&mut self) -> Result<()> {
        self.gradients.clear();
        let held = System::memory_for(&self.pattern);
        self.factor.analyse(self.limit.reserving(held), &self.pattern)?;
        if self.factor.precision() == Precision::Single {
            self.gradients.set_pattern(&self.pattern);
            let bytes = self.gradients.memory();
            let limit = self.limit.reserving(held + self.factor.memory());
            limit.check(&[Part { name: "solving the garment's linear system", bytes }])?;
        }
        self.counters.analyses += 1;
        Ok(())
    }

    /// Frees what the linear system takes. Only another solver may follow: there is no step from here.
    pub fn release(&mut self) {
        self.factor = Factor::default();
        self.gradients.clear();
        self.system = System::new(self.cancel.clone());
    }

    /// Bytes held.
    pub fn memory(&self) -> u64 {
        self.pattern.memory()
            + self.factor.memory()
            + self.gradients.memory()
            + self.system.memory()
            + bytes(&self.response)
            + bytes(&self.dx)
            + bytes(&self.trial)
    }

    /// Assembles and factorises the system at `at`, and solves for the Newton direction p0 of the vertices. With
    /// `border` also for p1, their response to a change of t, or of the barrier parameter s where the energies' border
    /// is that of s.
    ///
    /// # Errors
    /// `Internal` where the Hessian cannot be made positive definite or memory runs out, `MemoryLimit`, `Cancelled`.
    pub fn linearise(&mut self, terms: &[Term<'_>], at: Configuration<'_>, border: bool) -> Result<()> {
        let mut missing = self.assemble(terms, at)?;
        if !missing.is_empty() {
            // Not by these alone: each growth costs an analysis and a second assembly.
            let clock = Instant::now();
            for term in terms.iter().filter(|term| term.weight != 0.0) {
                term.energy.passing_stencils(&mut |vertices| missing.add_clique(vertices));
            }
            self.pattern = self.pattern.extended(missing);
            self.analyse()?;
            self.counters.profile.analysis += clock.elapsed();
            self.assemble(terms, at)?;
        }

        self.response.clear();
        self.response.extend(self.system.gradient.iter().map(|g| -g));
        if border {
            self.response.extend(self.system.border.iter().map(|b| -b));
        }
        let columns = if border { 2 } else { 1 };
        if self.factor.precision() == Precision::Single && !self.solve_in_single(columns)? {
            self.gradients.clear();
            let held = self.system.memory() + self.pattern.memory();
            self.factor.widen(self.limit.reserving(held), &self.pattern)?;
        }
        if self.factor.precision() == Precision::Double {
            let clock = Instant::now();
            self.factorise()?;
            self.counters.profile.factorisation += clock.elapsed();
            let clock = Instant::now();
            self.factor.solve(&mut self.response, columns);
            self.counters.profile.solve += clock.elapsed();
        }
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

    /// Solves with a factor in 32 bits. False where that is too coarse for the Hessian.
    fn solve_in_single(&mut self, columns: usize) -> Result<bool> {
        let clock = Instant::now();
        let shift = self.damping * self.mean_diagonal();
        self.shift_diagonal(shift);
        self.counters.factorisations += 1;
        let is_factorised = self.factor.factorise(&self.pattern, &self.system.hessian)?;
        self.counters.profile.factorisation += clock.elapsed();
        let clock = Instant::now();
        let Self { pattern, system, factor, gradients, response, cancel, .. } = self;
        let is_solved =
            is_factorised && gradients.solve(pattern, &system.hessian, factor, response, columns, cancel)?.is_some();
        self.counters.profile.solve += clock.elapsed();
        if !is_solved {
            self.shift_diagonal(-shift);
        }
        Ok(is_solved)
    }

    fn mean_diagonal(&self) -> f64 {
        let n = self.pattern.vertex_count();
        (0..n as u32)
            .flat_map(|j| self.pattern.diagonal(j))
            .map(|d| self.system.hessian[d])
            .sum::<f64>()
            .max(f64::MIN_POSITIVE)
            / (3 * n) as f64
    }

    fn shift_diagonal(&mut self, shift: f64) {
        for j in 0..self.pattern.vertex_count() as u32 {
            for d in self.pattern.diagonal(j) {
                self.system.hessian[d] += shift;
            }
        }
    }

    fn factorise(&mut self) -> Result<()> {
        let mean = self.mean_diagonal();
        let mut shift = self.damping * mean;
        let mut added = 0.0;
        while shift <= MAX_DIAGONAL_SHIFT * mean {
            self.shift_diagonal(shift - added);
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

    /// The Newton step of t in the bordered system, from the Schur complement on t; 0 where that is not positive.
    pub fn newton_dt(&self) -> f64 {
        let n = self.system.gradient.len();
        let (p0, p1) = self.response.split_at(n);
        let along = |p: &[f64]| self.system.border.iter().zip(p).map(|(b, p)| b * p).sum::<f64>();
        let stiffness = self.system.t_hessian + along(p1);
        let force = -(self.system.t_gradient + along(p0));
        if stiffness > 0.0 { force / stiffness } else { 0.0 }
    }

    /// Sets the direction to `p0 + dt p1`, scaled down to `MAX_DISPLACEMENT`. Returns the scale, at most 1.
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

    /// The value of each term at `at`, the current state, unweighted.
    pub fn values(&mut self, terms: &[Term<'_>], at: Configuration<'_>) -> &[f64] {
        self.values.get_or_insert_with(|| assembly::values(terms, at, &mut self.counters.profile))
    }

    /// Discards the cached values of the terms. To be called after the state or the energies were changed from outside.
    pub fn forget_values(&mut self) {
        self.values = None;
    }

    /// Squared Newton decrement `-g^T p0` at the last linearisation, also where no step was taken from it.
    pub fn decrement(&self) -> f64 {
        self.system.gradient.iter().zip(&self.response).map(|(g, p)| -g * p).sum()
    }

    /// Whether the last step was damped, or the next will be: then the decrement underestimates the possible decrease.
    pub fn is_damped(&self) -> bool {
        self.damping > MIN_DAMPING
    }

    /// Norm of the gradient with respect to the vertices.
    pub fn gradient_norm(&self) -> f64 {
        self.system.gradient.iter().map(|g| g * g).sum::<f64>().sqrt()
    }

    /// Updates the Levenberg-Marquardt damping by `fraction`, the feasible fraction of the last step.
    fn update_damping(&mut self, fraction: f64) {
        if fraction < SHORT_STEP {
            self.short_steps += 1;
            if self.short_steps >= MAX_SHORT_STEPS {
                self.damping = (DAMPING_FACTOR * self.damping).min(MAX_DAMPING);
            }
        } else {
            self.short_steps = 0;
            if fraction >= LONG_STEP {
                // Snaps to the minimum, so that rounding leaves no residual damping.
                let less = self.damping / DAMPING_FACTOR;
                self.damping = if less < 2.0 * MIN_DAMPING { MIN_DAMPING } else { less };
            }
        }
    }

    /// One continuation step in t: predictor for an advance by `dt` and Newton corrector in one, up to the model's
    /// feasible step length. There is no line search, since the objective may rise with t. Returns the fraction of `dt`
    /// that was taken.
    ///
    /// # Errors
    /// As [`Self::linearise`].
    pub fn continue_t(&mut self, model: &mut dyn Model, state: &mut State, dt: f64) -> Result<f64> {
        let taken = self.continuation_step(model, state, dt, true)?;
        state.t += taken * dt;
        Ok(taken)
    }

    /// One continuation step in the barrier parameter s at fixed t, where the energies' border is their mixed
    /// derivative by s: predictor for an advance by `ds`. The caller then advances s in the energies by the returned
    /// fraction of `ds`.
    ///
    /// # Errors
    /// As [`Self::linearise`].
    pub fn continue_barrier(&mut self, model: &mut dyn Model, state: &mut State, ds: f64) -> Result<f64> {
        self.continuation_step(model, state, ds, false)
    }

    /// The feasible fraction of the direction with `dt`.
    fn feasible(&self, model: &mut dyn Model, state: &State, dt: f64) -> Result<f64, Cancelled> {
        // Where memory ran out the step is zero; the model's owner decides whether that ends the run.
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

    /// One step of Newton's method, at fixed t or, with `free_t`, on the garment and t together (t never leaves \[0,
    /// 1\]): linearise, limit the step length, line search. `None` where no fraction of the step decreases the
    /// objective: the state has converged up to rounding, or contact blocks the step.
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
                fraction: found.fraction * kept,
                displacement: found.fraction * self.dx.iter().fold(0.0_f64, |m, d| m.max(d.length())),
            }
        }))
    }
}
