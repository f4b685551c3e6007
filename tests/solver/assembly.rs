//! Pattern, assembly and factorisation compared with dense matrices.
// Index loops follow the formulas.
#![allow(clippy::needless_range_loop)]

use std::ops::Range;

use bespoke::energy::{Configuration, Direction, Energy, Row, Sink};
use bespoke::memory::MemoryLimit;
use bespoke::solver::Term;
use bespoke::solver::assembly::System;
use bespoke::solver::cholesky::Factor;
use bespoke::solver::pattern::{PairCollector, Pattern};
use glam::DVec3;

use testing::Random;

/// Vertices, their components, the component along t, g and h.
type RankOneUpdate = (Vec<u32>, Vec<DVec3>, f64, f64, f64);

/// Random rank-one updates, some of them with several rows: an energy with derivatives but no value.
pub struct RankOneUpdates {
    pub elements: Vec<RankOneUpdate>,
}

impl RankOneUpdates {
    pub fn random(vertex_count: u32, count: usize, random: &mut Random) -> Self {
        let elements = (0..count)
            .map(|k| {
                let mut vertices: Vec<u32> = Vec::new();
                // Those that come alone have up to eight vertices.
                let most = if k % 2 == 0 { 8.0 } else { 4.0 };
                while vertices.len() < 1 + (random.unit() * most) as usize {
                    let v = (random.unit() * f64::from(vertex_count)) as u32;
                    if !vertices.contains(&v) {
                        vertices.push(v);
                    }
                }
                let components = vertices.iter().map(|_| random.vector()).collect();
                (vertices, components, random.signed(), random.signed(), random.unit())
            })
            .collect();
        Self { elements }
    }
}

/// Rows whose sum without t is `h a a^T` and `g a`: up to nine, more than a stored element has, some without a Hessian.
fn rows(k: usize, components: &[DVec3], t: f64, g: f64, h: f64) -> Vec<Row> {
    let mut all = [DVec3::ZERO; 4];
    all[..components.len()].copy_from_slice(components);
    let count = 1 + k % 9;
    let part = |i: usize| Row {
        components: all,
        t: if i == 0 { 0.0 } else { t },
        g: if i == 0 { g } else { 0.0 },
        h: if i + 1 == count { h } else { 0.0 },
    };
    (0..count).map(part).collect()
}

impl Energy for RankOneUpdates {
    fn name(&self) -> &'static str {
        "rank-one updates"
    }

    fn len(&self) -> usize {
        self.elements.len()
    }

    fn value(&self, _: Configuration<'_>, _: Range<usize>) -> f64 {
        0.0
    }

    fn derivatives(&self, _: Configuration<'_>, range: Range<usize>, sink: &mut dyn Sink) {
        for k in range {
            let (vertices, components, t, g, h) = &self.elements[k];
            if k % 2 == 0 {
                sink.rank_one(Direction { vertices, components, t: *t }, *g, *h);
            } else {
                sink.low_rank(vertices, &rows(k, components, *t, *g, *h));
            }
        }
    }

    fn stencils(&self, visit: &mut dyn FnMut(&[u32])) {
        for (vertices, ..) in &self.elements {
            visit(vertices);
        }
    }
}

fn pattern_of(vertex_count: usize, energy: &dyn Energy) -> Pattern {
    let mut pairs = PairCollector::default();
    energy.stencils(&mut |v| pairs.add_clique(v));
    Pattern::new(vertex_count, pairs)
}

/// Dense reference for the assembly, directly from the definition.
fn dense(n: usize, energies: &[(&RankOneUpdates, f64)]) -> (Vec<f64>, Vec<Vec<f64>>, Vec<f64>, f64, f64) {
    let mut g = vec![0.0; 3 * n];
    let mut b = vec![0.0; 3 * n];
    let mut h = vec![vec![0.0; 3 * n]; 3 * n];
    let (mut gt, mut ht) = (0.0, 0.0);
    for (energy, w) in energies {
        for (k, (vertices, components, t, gk, hk)) in energy.elements.iter().enumerate() {
            let mut a = vec![0.0; 3 * n];
            for (&v, c) in vertices.iter().zip(components) {
                for r in 0..3 {
                    a[3 * v as usize + r] = c[r];
                }
            }
            for i in 0..3 * n {
                for j in 0..3 * n {
                    h[i][j] += w * hk * a[i] * a[j];
                }
            }
            // The first of several rows has the gradient, the last one the Hessian, and the first one has no t.
            let first = k % 2 == 1;
            let only = first && k % 9 == 0;
            let (g_t, h_t) = (if first { 0.0 } else { *t }, if only { 0.0 } else { *t });
            for i in 0..3 * n {
                g[i] += w * gk * a[i];
                b[i] += w * hk * h_t * a[i];
            }
            gt += w * gk * g_t;
            ht += w * hk * h_t * h_t;
        }
    }
    (g, h, b, gt, ht)
}

#[test]
fn assembly_agrees_with_dense_sums_and_ignores_the_thread_count() {
    let mut random = Random::new(1);
    let n = 12;
    // More elements than one batch.
    let first = RankOneUpdates::random(n as u32, 9000, &mut random);
    let second = RankOneUpdates::random(n as u32, 40, &mut random);
    let terms = [Term { energy: &first, weight: 0.7 }, Term { energy: &second, weight: 3.0 }];
    let pattern = pattern_of(n, &first);
    let x = vec![DVec3::ZERO; n];
    let at = Configuration { x: &x, t: 0.0 };
    let run = |threads| {
        let mut system = System::default();
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let missing = pool.install(|| system.assemble(&pattern, &terms, at)).unwrap();
        assert!(missing.is_empty());
        system
    };
    let system = run(1);
    let other = run(3);
    assert_eq!(system.hessian, other.hessian);
    assert_eq!(system.gradient, other.gradient);
    let (g, h, b, gt, ht) = dense(n, &[(&first, 0.7), (&second, 3.0)]);
    let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-10 * (1.0 + b.abs()), "{a} {b}");
    for i in 0..3 * n {
        close(system.gradient[i], g[i]);
        close(system.border[i], b[i]);
    }
    close(system.t_gradient, gt);
    close(system.t_hessian, ht);
    let rows = pattern.row_idx();
    for (j, range) in pattern.col_ptr().windows(2).enumerate() {
        for p in range[0] as usize..range[1] as usize {
            let i = rows[p] as usize;
            assert!(i >= j);
            close(system.hessian[p], h[i][j]);
        }
    }
    // The dense matrix has no non-zero outside of the pattern.
    let stored: f64 = system.hessian.iter().map(|v| v.abs()).sum();
    let lower: f64 = (0..3 * n).map(|i| h[i][..=i].iter().map(|v| v.abs()).sum::<f64>()).sum();
    close(stored, lower);
}

#[test]
fn a_pair_outside_of_the_pattern_is_reported_and_the_pattern_grows() {
    let mut random = Random::new(2);
    let known = RankOneUpdates::random(20, 30, &mut random);
    let new = RankOneUpdates::random(20, 60, &mut random);
    let pattern = pattern_of(20, &known);
    let x = vec![DVec3::ZERO; 20];
    let at = Configuration { x: &x, t: 0.0 };
    let terms = [Term { energy: &known, weight: 1.0 }, Term { energy: &new, weight: 1.0 }];
    let missing = System::default().assemble(&pattern, &terms, at).unwrap();
    assert!(!missing.is_empty());
    let grown = pattern.extended(missing);
    assert!(System::default().assemble(&grown, &terms, at).unwrap().is_empty());
    assert!(grown.value_count() > pattern.value_count());
}

#[test]
fn the_factor_solves_the_system() {
    let mut random = Random::new(3);
    let n = 40;
    let energy = RankOneUpdates::random(n as u32, 900, &mut random);
    let pattern = pattern_of(n, &energy);
    let x = vec![DVec3::ZERO; n];
    let mut system = System::default();
    system.assemble(&pattern, &[Term { energy: &energy, weight: 1.0 }], Configuration { x: &x, t: 0.0 }).unwrap();
    for j in 0..n as u32 {
        for d in pattern.diagonal(j) {
            system.hessian[d] += 0.1;
        }
    }
    let rows = pattern.row_idx();
    let multiply = |v: &[f64]| {
        let mut out = vec![0.0; 3 * n];
        for j in 0..3 * n {
            for p in pattern.col_ptr()[j] as usize..pattern.col_ptr()[j + 1] as usize {
                let i = rows[p] as usize;
                out[i] += system.hessian[p] * v[j];
                if i != j {
                    out[j] += system.hessian[p] * v[i];
                }
            }
        }
        out
    };
    let want: Vec<f64> = (0..6 * n).map(|_| random.signed()).collect();
    let mut rhs = multiply(&want[..3 * n]);
    rhs.extend(multiply(&want[3 * n..]));
    let mut factor = Factor::default();
    factor.analyse(MemoryLimit::NONE, &pattern).unwrap();
    assert!(factor.factorise(&pattern, &system.hessian).unwrap());
    factor.solve(&mut rhs, 2);
    for (a, b) in rhs.iter().zip(&want) {
        assert!((a - b).abs() < 1e-8, "{a} {b}");
    }
    for j in 0..n as u32 {
        system.hessian[pattern.diagonal(j)[0]] = -1.0;
    }
    assert!(!factor.factorise(&pattern, &system.hessian).unwrap());
}
