//! Finite differences against the derivatives of an energy.

use bespoke::energy::{Configuration, Direction, Energy, Sink};
use glam::DVec3;

/// Gradient and Hessian as dense arrays over `3n + 1` unknowns, the last one t.
pub struct Dense {
    pub gradient: Vec<f64>,
    pub hessian: Vec<Vec<f64>>,
}

impl Dense {
    fn new(n: usize) -> Self {
        let m = 3 * n + 1;
        Self { gradient: vec![0.0; m], hessian: vec![vec![0.0; m]; m] }
    }

    /// Quadratic form of the Hessian.
    pub fn quadratic(&self, v: &[f64]) -> f64 {
        self.hessian.iter().zip(v).map(|(row, a)| a * row.iter().zip(v).map(|(h, b)| h * b).sum::<f64>()).sum()
    }
}

impl Sink for Dense {
    fn rank_one(&mut self, a: Direction<'_>, g: f64, h: f64) {
        assert!(h >= 0.0, "a negative rank-one weight: {h}");
        let m = self.gradient.len();
        let mut full = vec![0.0; m];
        for (&v, c) in a.vertices.iter().zip(a.components) {
            for k in 0..3 {
                full[3 * v as usize + k] += c[k];
            }
        }
        full[m - 1] += a.t;
        for i in 0..m {
            self.gradient[i] += g * full[i];
            for j in 0..m {
                self.hessian[i][j] += h * full[i] * full[j];
            }
        }
    }
}

/// All the derivatives of `energy` as dense arrays.
pub fn dense(energy: &dyn Energy, x: &[DVec3], t: f64) -> Dense {
    let mut out = Dense::new(x.len());
    energy.derivatives(Configuration { x, t }, 0..energy.len(), &mut out);
    out
}

fn value_at(energy: &dyn Energy, u: &[f64]) -> f64 {
    let (x, t) = unpack(u);
    energy.value(Configuration { x: &x, t }, 0..energy.len())
}

/// Unknowns as one array, t last.
pub fn pack(x: &[DVec3], t: f64) -> Vec<f64> {
    x.iter().flat_map(|p| p.to_array()).chain([t]).collect()
}

/// The inverse of [`pack`].
pub fn unpack(u: &[f64]) -> (Vec<DVec3>, f64) {
    let n = u.len() / 3;
    ((0..n).map(|i| DVec3::from_slice(&u[3 * i..3 * i + 3])).collect(), u[3 * n])
}

/// Fourth-order central differences of the value.
pub fn numeric_gradient(energy: &dyn Energy, x: &[DVec3], t: f64, step: f64) -> Vec<f64> {
    let mut u = pack(x, t);
    (0..u.len())
        .map(|i| {
            let keep = u[i];
            let mut at = |s: f64| {
                u[i] = keep + s * step;
                value_at(energy, &u)
            };
            let d = (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * step);
            u[i] = keep;
            d
        })
        .collect()
}

/// Asserts that the gradient agrees with finite differences to `tolerance`, relative to its largest entry.
pub fn check_gradient(energy: &dyn Energy, x: &[DVec3], t: f64, step: f64, tolerance: f64) {
    let analytic = dense(energy, x, t).gradient;
    let numeric = numeric_gradient(energy, x, t, step);
    let scale = numeric.iter().fold(1e-12_f64, |m, v| m.max(v.abs()));
    for (i, (a, n)) in analytic.iter().zip(&numeric).enumerate() {
        assert!(
            (a - n).abs() <= tolerance * scale,
            "{}: unknown {i}: analytic {a:e}, numeric {n:e}, scale {scale:e}",
            energy.name()
        );
    }
}

/// The exact Hessian, by central differences of the analytic gradient.
pub fn numeric_hessian(energy: &dyn Energy, x: &[DVec3], t: f64, step: f64) -> Vec<Vec<f64>> {
    let mut u = pack(x, t);
    let mut gradient_at = |i: usize, s: f64| {
        let keep = u[i];
        u[i] = keep + s * step;
        let (x, t) = unpack(&u);
        u[i] = keep;
        dense(energy, &x, t).gradient
    };
    let m = 3 * x.len() + 1;
    (0..m)
        .map(|i| {
            let (p1, m1) = (gradient_at(i, 1.0), gradient_at(i, -1.0));
            let (p2, m2) = (gradient_at(i, 2.0), gradient_at(i, -2.0));
            (0..m).map(|j| (8.0 * (p1[j] - m1[j]) - (p2[j] - m2[j])) / (12.0 * step)).collect()
        })
        .collect()
}

/// Asserts that the Hessian agrees with finite differences of the gradient: for configurations where the
/// positive semidefinite Hessian is the exact one (zero residuals).
pub fn check_hessian(energy: &dyn Energy, x: &[DVec3], t: f64, step: f64, tolerance: f64) {
    let analytic = dense(energy, x, t).hessian;
    let numeric = numeric_hessian(energy, x, t, step);
    let scale = numeric.iter().flatten().fold(1e-12_f64, |m, v| m.max(v.abs()));
    for i in 0..analytic.len() {
        for j in 0..analytic.len() {
            let (a, n) = (analytic[i][j], numeric[i][j]);
            assert!(
                (a - n).abs() <= tolerance * scale,
                "{}: entry ({i}, {j}): analytic {a:e}, numeric {n:e}, scale {scale:e}",
                energy.name()
            );
        }
    }
}

/// Asserts `v^T H v >= 0` for random directions, and that H is symmetric.
pub fn check_semidefinite(energy: &dyn Energy, x: &[DVec3], t: f64, random: &mut dyn FnMut() -> f64) {
    let d = dense(energy, x, t);
    let scale = d.hessian.iter().flatten().fold(0.0_f64, |m, v| m.max(v.abs()));
    for (i, row) in d.hessian.iter().enumerate() {
        for (j, value) in row.iter().enumerate().take(i) {
            assert!((value - d.hessian[j][i]).abs() <= 1e-12 * scale, "{}: not symmetric", energy.name());
        }
    }
    for _ in 0..50 {
        let v: Vec<f64> = (0..d.gradient.len()).map(|_| random()).collect();
        let norm: f64 = v.iter().map(|a| a * a).sum();
        assert!(d.quadratic(&v) >= -1e-12 * scale * norm, "{}: not semidefinite", energy.name());
    }
}
