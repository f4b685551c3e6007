//! Newton's method on problems with known solutions.

use std::ops::Range;

use bespoke::control::{Cancel, Cancelled};
use bespoke::energy::{Configuration, Direction, Energy, Sink};
use bespoke::memory::MemoryLimit;
use bespoke::solver::Term;
use bespoke::solver::newton::{Model, Newton, State};
use glam::DVec3;

/// Springs of rest length 1 to the origin and to the next vertex, and `(x_0 - t e_x)^2`.
struct Springs {
    count: u32,
}

impl Springs {
    fn residual(&self, at: Configuration<'_>, k: usize) -> (Vec<u32>, Vec<DVec3>, f64, f64) {
        let n = self.count as usize;
        if k == 0 {
            return (vec![0], vec![DVec3::X], -1.0, at.x[0].x - at.t);
        }
        let (i, j) = ((k - 1) % n, k % n);
        let d = if k <= n { at.x[i] } else { at.x[i] - at.x[j] };
        let u = d.normalize_or_zero();
        if k <= n {
            (vec![i as u32], vec![u], 0.0, d.length() - 1.0)
        } else {
            (vec![i as u32, j as u32], vec![u, -u], 0.0, d.length() - 1.0)
        }
    }
}

impl Energy for Springs {
    fn name(&self) -> &'static str {
        "springs"
    }

    fn len(&self) -> usize {
        2 * self.count as usize
    }

    fn value(&self, at: Configuration<'_>, range: Range<usize>) -> f64 {
        range.map(|k| self.residual(at, k).3.powi(2)).sum()
    }

    fn derivatives(&self, at: Configuration<'_>, range: Range<usize>, sink: &mut dyn Sink) {
        for k in range {
            let (vertices, components, t, r) = self.residual(at, k);
            sink.rank_one(Direction { vertices: &vertices, components: &components, t }, 2.0 * r, 2.0);
        }
    }

    fn stencils(&self, visit: &mut dyn FnMut(&[u32])) {
        for k in 0..self.count {
            visit(&[k, (k + 1) % self.count]);
        }
    }
}

/// Springs, and the largest feasible fraction of a step.
struct Problem(Springs, f64);

impl Model for Problem {
    fn terms(&self) -> Vec<Term<'_>> {
        vec![Term { energy: &self.0, weight: 2.0 }]
    }

    fn max_feasible_step(
        &mut self,
        _: Configuration<'_>,
        _: &[DVec3],
        _: f64,
        longest: f64,
    ) -> Result<Option<f64>, Cancelled> {
        Ok(Some(longest.min(self.1)))
    }
}

fn start() -> State {
    let x = (0..5).map(|k| DVec3::new(1.0 + 0.1 * f64::from(k), f64::from(k) - 2.0, 0.3)).collect();
    State { x, t: 0.5 }
}

#[test]
fn descent_reaches_a_minimum_and_never_rises() {
    let mut model = Problem(Springs { count: 5 }, 1.0);
    let mut state = start();
    let mut newton = Newton::new(5, &model.terms(), MemoryLimit::NONE, Cancel::new()).unwrap();
    let mut last = f64::INFINITY;
    for _ in 0..200 {
        let Some(step) = newton.newton_step(&mut model, &mut state, false).unwrap() else { break };
        assert!(step.after <= step.before && step.before <= last * (1.0 + 1e-12));
        assert!(step.displacement <= 0.1 * 3.0_f64.sqrt() + 1e-12);
        last = step.after;
    }
    newton.linearise(&model.terms(), state.configuration(), false).unwrap();
    assert!(newton.gradient_norm() < 1e-5, "{}", newton.gradient_norm());
}

#[test]
fn a_step_never_goes_beyond_the_feasible_fraction() {
    let mut model = Problem(Springs { count: 5 }, 0.25);
    let mut state = start();
    let mut newton = Newton::new(5, &model.terms(), MemoryLimit::NONE, Cancel::new()).unwrap();
    for _ in 0..5 {
        let before = state.x.clone();
        newton.newton_step(&mut model, &mut state, false).unwrap().unwrap();
        let moved = before.iter().zip(&state.x).fold(0.0_f64, |m, (a, b)| m.max((*a - *b).abs().max_element()));
        assert!(moved <= 0.25 * 0.1 + 1e-12, "{moved}");
    }
}

#[test]
fn short_steps_are_damped_until_steps_are_long_again() {
    let mut model = Problem(Springs { count: 5 }, 0.01);
    let mut state = start();
    let mut newton = Newton::new(5, &model.terms(), MemoryLimit::NONE, Cancel::new()).unwrap();
    let mut damped = |feasible: f64, steps: usize| -> Vec<bool> {
        model.1 = feasible;
        (0..steps).map(|_| newton.newton_step(&mut model, &mut state, false).unwrap().unwrap().damped).collect()
    };
    assert_eq!(damped(0.01, 5), [false, false, false, true, true]);
    let long = damped(1.0, 5);
    assert!(long[0] && !long[4], "{long:?}");
}

/// The bordered system, solved as a dense one by Gaussian elimination, gives the same dt and dx.
#[test]
fn the_border_agrees_with_a_dense_solve() {
    let model = Problem(Springs { count: 5 }, 1.0);
    let state = start();
    let mut newton = Newton::new(5, &model.terms(), MemoryLimit::NONE, Cancel::new()).unwrap();
    newton.linearise(&model.terms(), state.configuration(), true).unwrap();
    let dt = newton.newton_dt();
    // The bordered system as a dense one: 15 coordinates, then t, then the right-hand side.
    let kept = newton.set_direction(dt);
    let dx: Vec<DVec3> = newton.direction().iter().map(|d| *d / kept).collect();
    let mut rows = vec![vec![0.0; 17]; 16];
    let springs = &model.0;
    for k in 0..springs.len() {
        let (vertices, components, t, r) = springs.residual(state.configuration(), k);
        let mut a = [0.0; 16];
        for (&v, c) in vertices.iter().zip(&components) {
            for i in 0..3 {
                a[3 * v as usize + i] = c[i];
            }
        }
        a[15] = t;
        for i in 0..16 {
            for j in 0..16 {
                rows[i][j] += 4.0 * a[i] * a[j];
            }
            rows[i][16] -= 4.0 * r * a[i];
        }
    }
    let mean = (0..15).map(|i| rows[i][i]).sum::<f64>() / 15.0;
    for (i, row) in rows.iter_mut().enumerate().take(15) {
        row[i] += 1e-7 * mean;
    }
    for i in 0..16 {
        let pivot = (i..16).max_by(|&a, &b| rows[a][i].abs().total_cmp(&rows[b][i].abs())).unwrap();
        rows.swap(i, pivot);
        let row = rows[i].clone();
        for (_, other) in rows.iter_mut().enumerate().filter(|(k, _)| *k != i) {
            let f = other[i] / row[i];
            other.iter_mut().zip(&row).skip(i).for_each(|(a, b)| *a -= f * b);
        }
    }
    let answer = |i: usize| rows[i][16] / rows[i][i];
    assert!((answer(15) - dt).abs() < 1e-6 * (1.0 + dt.abs()), "{} {dt}", answer(15));
    for (v, d) in dx.iter().enumerate() {
        for (i, &x) in d.to_array().iter().enumerate() {
            assert!((answer(3 * v + i) - x).abs() < 1e-5, "{} {x}", answer(3 * v + i));
        }
    }
}

/// Springs of no length between the vertices k and k + 2, each as soon as t is above k, as contacts come.
struct Passing {
    count: usize,
    are_told: bool,
}

impl Energy for Passing {
    fn name(&self) -> &'static str {
        "passing"
    }

    fn len(&self) -> usize {
        self.count
    }

    fn value(&self, at: Configuration<'_>, range: Range<usize>) -> f64 {
        range.filter(|&k| at.t > k as f64).map(|k| (at.x[k] - at.x[k + 2]).length_squared()).sum()
    }

    fn derivatives(&self, at: Configuration<'_>, range: Range<usize>, sink: &mut dyn Sink) {
        for k in range.filter(|&k| at.t > k as f64) {
            let d = at.x[k] - at.x[k + 2];
            for (axis, distance) in [(DVec3::X, d.x), (DVec3::Y, d.y), (DVec3::Z, d.z)] {
                let a = Direction { vertices: &[k as u32, k as u32 + 2], components: &[axis, -axis], t: 0.0 };
                sink.rank_one(a, 2.0 * distance, 2.0);
            }
        }
    }

    fn stencils(&self, _: &mut dyn FnMut(&[u32])) {}

    fn passing_stencils(&self, visit: &mut dyn FnMut(&[u32])) {
        if self.are_told {
            (0..self.count as u32).for_each(|k| visit(&[k, k + 2]));
        }
    }
}

#[test]
fn the_pattern_grows_once_by_all_that_is_told_to_come() {
    let springs = Springs { count: 8 };
    let mut state = start();
    let x = |k: u32| DVec3::new(f64::from(k).sin(), f64::from(k * k).cos(), 0.3 * f64::from(k));
    state.x = (0..8).map(x).collect();
    let mut analyses = [0, 0];
    let [told, untold] = [true, false].map(|are_told| Passing { count: 4, are_told });
    let directions = [&told, &untold].map(|passing| {
        let terms = [Term { energy: &springs, weight: 1.0 }, Term { energy: passing, weight: 1.0 }];
        let mut newton = Newton::new(8, &terms, MemoryLimit::NONE, Cancel::new()).unwrap();
        let mut directions = Vec::new();
        for k in 0..4 {
            state.t = f64::from(k) + 0.5;
            newton.linearise(&terms, state.configuration(), true).unwrap();
            newton.set_direction(0.0);
            directions.push(newton.direction().to_vec());
        }
        analyses[usize::from(!passing.are_told)] = newton.counters.analyses;
        directions
    });
    assert_eq!(analyses, [2, 5]);
    for (told, untold) in directions[0].iter().zip(&directions[1]).flat_map(|(told, untold)| told.iter().zip(untold)) {
        assert!(told.distance(*untold) < 1e-6 * (1.0 + untold.length()), "{told} {untold}");
    }
}
