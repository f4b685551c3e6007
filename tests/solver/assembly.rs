//! Pattern, assembly and factorisation against dense matrices.

use std::ops::Range;

use bespoke::energy::{Configuration, Direction, Energy, Sink};
use bespoke::solver::Term;
use bespoke::solver::assembly::System;
use bespoke::solver::cholesky::Factor;
use bespoke::solver::pattern::{PairCollector, Pattern};
use glam::DVec3;

use super::support::Random;

/// Vertices, their components, the component along t, g and h.
type Piece = (Vec<u32>, Vec<DVec3>, f64, f64, f64);

/// Rank-one pieces and blocks over random vertices: an energy in form only.
pub struct Pieces {
    pub elements: Vec<Piece>,
}

impl Pieces {
    pub fn random(vertex_count: u32, count: usize, random: &mut Random) -> Self {
        let elements = (0..count)
            .map(|_| {
                let mut vertices: Vec<u32> = Vec::new();
                while vertices.len() < 1 + (random.unit() * 4.0) as usize {
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

impl Energy for Pieces {
    fn name(&self) -> &'static str {
        "pieces"
    }

    fn len(&self) -> usize {
        self.elements.len()
    }

    fn value(&self, _: Configuration<'_>, _: Range<usize>) -> f64 {
        0.0
    }

    fn derivatives(&self, _: Configuration<'_>, range: Range<usize>, sink: &mut dyn Sink) {
        for (k, (vertices, components, t, g, h)) in self.elements[range].iter().enumerate() {
            if k % 2 == 0 {
                sink.rank_one(Direction { vertices, components, t: *t }, *g, *h);
            } else {
                let a: Vec<f64> = components.iter().flat_map(|c| c.to_array()).collect();
                let block: Vec<f64> = a.iter().flat_map(|x| a.iter().map(move |y| h * x * y)).collect();
                sink.block(vertices, &block);
                sink.gradient(vertices[0], components[0]);
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

/// Dense twin of the assembly, straight from the definition.
fn dense(n: usize, energies: &[(&Pieces, f64)]) -> (Vec<f64>, Vec<Vec<f64>>, Vec<f64>, f64, f64) {
    let mut g = vec![0.0; 3 * n];
    let mut b = vec![0.0; 3 * n];
    let mut h = vec![vec![0.0; 3 * n]; 3 * n];
    let (mut gt, mut ht) = (0.0, 0.0);
    for (energy, w) in energies {
        // Chunks begin at even elements, so an element's parity within its chunk is its own.
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
            if k % 2 == 0 {
                for i in 0..3 * n {
                    g[i] += w * gk * a[i];
                    b[i] += w * hk * t * a[i];
                }
                gt += w * gk * t;
                ht += w * hk * t * t;
            } else {
                for r in 0..3 {
                    g[3 * vertices[0] as usize + r] += w * components[0][r];
                }
            }
        }
    }
    (g, h, b, gt, ht)
}

#[test]
fn assembly_agrees_with_dense_sums_and_ignores_the_thread_count() {
    let mut random = Random::new(1);
    let n = 12;
    let first = Pieces::random(n as u32, 700, &mut random);
    let second = Pieces::random(n as u32, 40, &mut random);
    let terms = [Term { energy: &first, weight: 0.7 }, Term { energy: &second, weight: 3.0 }];
    let pattern = pattern_of(n, &first);
    let x = vec![DVec3::ZERO; n];
    let at = Configuration { x: &x, t: 0.0 };
    let run = |threads| {
        let mut system = System::default();
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let missing = pool.install(|| system.assemble(&pattern, &terms, at));
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
    for (j, range) in pattern.col_ptr().windows(2).enumerate() {
        for p in range[0] as usize..range[1] as usize {
            let i = pattern.row_idx()[p] as usize;
            assert!(i >= j);
            close(system.hessian[p], h[i][j]);
        }
    }
    // Nothing of the dense matrix lies outside of the pattern.
    let stored: f64 = system.hessian.iter().map(|v| v.abs()).sum();
    let lower: f64 = (0..3 * n).map(|i| h[i][..=i].iter().map(|v| v.abs()).sum::<f64>()).sum();
    close(stored, lower);
}

#[test]
fn a_pair_outside_of_the_pattern_is_reported_and_the_pattern_grows() {
    let mut random = Random::new(2);
    let known = Pieces::random(20, 30, &mut random);
    let news = Pieces::random(20, 60, &mut random);
    let pattern = pattern_of(20, &known);
    let x = vec![DVec3::ZERO; 20];
    let at = Configuration { x: &x, t: 0.0 };
    let terms = [Term { energy: &known, weight: 1.0 }, Term { energy: &news, weight: 1.0 }];
    let missing = System::default().assemble(&pattern, &terms, at);
    assert!(!missing.is_empty());
    let grown = pattern.extended(missing);
    assert!(System::default().assemble(&grown, &terms, at).is_empty());
    assert!(grown.value_count() > pattern.value_count());
}

#[test]
fn the_factor_solves_the_system() {
    let mut random = Random::new(3);
    let n = 40;
    let pieces = Pieces::random(n as u32, 900, &mut random);
    let pattern = pattern_of(n, &pieces);
    let x = vec![DVec3::ZERO; n];
    let mut system = System::default();
    system.assemble(&pattern, &[Term { energy: &pieces, weight: 1.0 }], Configuration { x: &x, t: 0.0 });
    for j in 0..n as u32 {
        for d in pattern.diagonal(j) {
            system.hessian[d] += 0.1;
        }
    }
    let multiply = |v: &[f64]| {
        let mut out = vec![0.0; 3 * n];
        for j in 0..3 * n {
            for p in pattern.col_ptr()[j] as usize..pattern.col_ptr()[j + 1] as usize {
                let i = pattern.row_idx()[p] as usize;
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
    let mut factor = Factor::analyse(&pattern).unwrap();
    assert!(factor.factorise(&pattern, &system.hessian));
    factor.solve(&mut rhs, 2);
    for (a, b) in rhs.iter().zip(&want) {
        assert!((a - b).abs() < 1e-8, "{a} {b}");
    }
    for j in 0..n as u32 {
        system.hessian[pattern.diagonal(j)[0]] = -1.0;
    }
    assert!(!factor.factorise(&pattern, &system.hessian));
}
