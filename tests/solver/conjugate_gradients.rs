//! Conjugate gradients with a factor in 32 bits beside the direct solution in 64.
// Index loops follow the formulas.
#![allow(clippy::needless_range_loop)]

use bespoke::control::{Cancel, Cancelled};
use bespoke::memory::MemoryLimit;
use bespoke::solver::cholesky::Factor;
use bespoke::solver::conjugate_gradients::ConjugateGradients;
use bespoke::solver::pattern::{PairCollector, Pattern};

use testing::Random;

/// A matrix like that of a garment in contact: soft springs along the edges of a grid, so weak against most of its diagonal that
/// the grid as a whole hardly resists, and stiff normals `k n n^T` over the corners of some of its cells.
struct Sheet {
    pattern: Pattern,
    values: Vec<f64>,
}

impl Sheet {
    fn new(width: u32, height: u32, stiffness: f64, random: &mut Random) -> Self {
        let at = |x: u32, y: u32| y * width + x;
        let cells: Vec<[u32; 4]> = (0..height - 1)
            .flat_map(|y| (0..width - 1).map(move |x| [at(x, y), at(x + 1, y), at(x, y + 1), at(x + 1, y + 1)]))
            .collect();
        let mut pairs = PairCollector::default();
        cells.iter().for_each(|cell| pairs.add_clique(cell));
        let pattern = Pattern::new((width * height) as usize, pairs);
        let mut values = vec![0.0; pattern.value_count()];
        for v in 0..width * height {
            pattern.diagonal(v).into_iter().for_each(|d| values[d] += 1e-4);
        }
        let mut sheet = Self { pattern, values };
        for cell in &cells {
            for (k, l) in [(0, 1), (0, 2), (1, 3), (2, 3), (0, 3)] {
                for axis in 0..3 {
                    let mut unit = [0.0; 3];
                    unit[axis] = 1.0;
                    sheet.add_rank_one(1.0, &[(cell[k], unit), (cell[l], unit.map(|u| -u))]);
                }
            }
            if random.unit() < 0.1 {
                let n = [random.signed(), random.signed(), 1.0];
                let shares = [0.4, 0.3, 0.2, 0.1];
                let direction: Vec<_> = cell.iter().zip(shares).map(|(&v, share)| (v, n.map(|n| share * n))).collect();
                sheet.add_rank_one(stiffness, &direction);
            }
        }
        sheet
    }

    /// Adds `h a a^T`.
    fn add_rank_one(&mut self, h: f64, a: &[(u32, [f64; 3])]) {
        for &(j, column) in a {
            let start = self.pattern.diagonal(j);
            for &(i, row) in a.iter().filter(|(i, _)| *i >= j) {
                for c in 0..3 {
                    if i == j {
                        (c..3).for_each(|r| self.values[start[c] + r - c] += h * column[c] * row[r]);
                    } else {
                        let block = self.pattern.column(j as usize).iter().position(|&other| other == i).unwrap();
                        (0..3).for_each(|r| self.values[start[c] + 3 - c + 3 * block + r] += h * column[c] * row[r]);
                    }
                }
            }
        }
    }

    fn multiply(&self, x: &[f64]) -> Vec<f64> {
        let rows = self.pattern.row_idx();
        let mut out = vec![0.0; x.len()];
        for j in 0..x.len() {
            for p in self.pattern.col_ptr()[j] as usize..self.pattern.col_ptr()[j + 1] as usize {
                let i = rows[p] as usize;
                out[i] += self.values[p] * x[j];
                if i != j {
                    out[j] += self.values[p] * x[i];
                }
            }
        }
        out
    }

    /// Squared norm that the matrix gives.
    fn energy(&self, x: &[f64]) -> f64 {
        self.multiply(x).iter().zip(x).map(|(a, b)| a * b).sum()
    }

    fn factor(&self, single_from: usize) -> Factor {
        let mut factor = Factor::default().in_single_from(single_from);
        factor.analyse(MemoryLimit::NONE, &self.pattern).unwrap();
        assert!(factor.factorise(&self.pattern, &self.values).unwrap());
        factor
    }

    fn solve(&self, factor: &mut Factor, rhs: &mut [f64], columns: usize) -> Option<usize> {
        let mut gradients = ConjugateGradients::default();
        gradients.set_pattern(&self.pattern);
        gradients.solve(&self.pattern, &self.values, factor, rhs, columns, &Cancel::new()).unwrap()
    }
}

fn random_vector(n: usize, random: &mut Random) -> Vec<f64> {
    (0..n).map(|_| random.signed()).collect()
}

#[test]
fn the_solution_is_the_direct_one_in_the_norm_of_the_matrix() {
    let mut random = Random::new(31);
    for (width, height, stiffness) in [(2, 2, 1e3), (12, 9, 1e2), (30, 40, 1e5), (60, 50, 1e7)] {
        let sheet = Sheet::new(width, height, stiffness, &mut random);
        let n = 3 * sheet.pattern.vertex_count();
        for columns in [1, 2] {
            let rhs = random_vector(columns * n, &mut random);
            let (mut wanted, mut found) = (rhs.clone(), rhs.clone());
            sheet.factor(usize::MAX).solve(&mut wanted, columns);
            let steps = sheet.solve(&mut sheet.factor(0), &mut found, columns).expect("it converges");
            assert!(steps <= 4, "{steps} steps at stiffness {stiffness}");
            for (found, wanted) in found.chunks_exact(n).zip(wanted.chunks_exact(n)) {
                let difference: Vec<f64> = found.iter().zip(wanted).map(|(a, b)| a - b).collect();
                let error = (sheet.energy(&difference) / sheet.energy(wanted)).sqrt();
                assert!(error < 2e-3, "{error} at stiffness {stiffness}");
            }
        }
    }
}

#[test]
fn one_step_solves_with_the_exact_factor() {
    let mut random = Random::new(32);
    let sheet = Sheet::new(20, 15, 1e4, &mut random);
    let rhs = random_vector(3 * sheet.pattern.vertex_count(), &mut random);
    let mut found = rhs.clone();
    assert_eq!(sheet.solve(&mut sheet.factor(usize::MAX), &mut found, 1), Some(1));
    for (found, wanted) in sheet.multiply(&found).iter().zip(&rhs) {
        assert!((found - wanted).abs() < 1e-8, "{found} and {wanted}");
    }
}

#[test]
fn the_factor_of_another_matrix_is_given_up_and_the_right_hand_side_is_kept() {
    let mut random = Random::new(33);
    let sheet = Sheet::new(40, 30, 1e6, &mut random);
    // Of its diagonal alone.
    let mut other = Sheet { pattern: sheet.pattern.clone(), values: vec![0.0; sheet.values.len()] };
    for d in (0..sheet.pattern.vertex_count() as u32).flat_map(|v| sheet.pattern.diagonal(v)) {
        other.values[d] = sheet.values[d];
    }
    let rhs = random_vector(3 * sheet.pattern.vertex_count(), &mut random);
    let mut found = rhs.clone();
    assert_eq!(sheet.solve(&mut other.factor(0), &mut found, 1), None);
    assert_eq!(found, rhs);
    // Nor is what is not positive definite solved for.
    let mut indefinite = Sheet::new(40, 30, 1e6, &mut random);
    let mut factor = indefinite.factor(0);
    indefinite.values.iter_mut().for_each(|value| *value = -*value);
    assert_eq!(indefinite.solve(&mut factor, &mut found, 1), None);
    assert_eq!(found, rhs);
}

#[test]
fn a_right_hand_side_of_zero_has_the_solution_zero() {
    let mut random = Random::new(34);
    let sheet = Sheet::new(10, 10, 1e3, &mut random);
    let n = 3 * sheet.pattern.vertex_count();
    let mut rhs = vec![0.0; 2 * n];
    rhs[n..].copy_from_slice(&random_vector(n, &mut random));
    assert!(sheet.solve(&mut sheet.factor(0), &mut rhs, 2).is_some());
    assert!(rhs[..n].iter().all(|&x| x == 0.0) && rhs[n..].iter().all(|&x| x != 0.0));
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let mut random = Random::new(35);
    let sheet = Sheet::new(80, 70, 1e5, &mut random);
    let rhs = random_vector(6 * sheet.pattern.vertex_count(), &mut random);
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut found = rhs.clone();
            assert!(sheet.solve(&mut sheet.factor(0), &mut found, 2).is_some());
            found.into_iter().map(f64::to_bits).collect::<Vec<_>>()
        })
    };
    let first = run(1);
    for threads in [2, 5, 16] {
        assert!(first == run(threads), "other bits with {threads} threads");
    }
}

#[test]
fn a_request_to_stop_ends_it() {
    let mut random = Random::new(36);
    let sheet = Sheet::new(10, 10, 1e3, &mut random);
    let mut rhs = random_vector(3 * sheet.pattern.vertex_count(), &mut random);
    let mut gradients = ConjugateGradients::default();
    gradients.set_pattern(&sheet.pattern);
    let cancel = Cancel::new();
    cancel.request();
    let mut factor = sheet.factor(0);
    let outcome = gradients.solve(&sheet.pattern, &sheet.values, &mut factor, &mut rhs, 1, &cancel);
    assert_eq!(outcome, Err(Cancelled));
}
