//! The sparse factorisation compared with a dense one and with faer's.
// Index loops follow the formulas.
#![allow(clippy::needless_range_loop)]

use bespoke::control::{Cancel, Cancelled};
use bespoke::error::ErrorKind;
use bespoke::memory::MemoryLimit;
use bespoke::solver::cholesky::{Factor, Precision};
use bespoke::solver::pattern::{PairCollector, Pattern};
use faer::prelude::Solve;
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{MatMut, Side};

use testing::Random;

fn pattern(vertex_count: usize, pairs: impl IntoIterator<Item = (u32, u32)>) -> Pattern {
    let mut collected = PairCollector::default();
    for (a, b) in pairs {
        collected.add(a, b);
    }
    Pattern::new(vertex_count, collected)
}

/// Random values off the diagonal, and a diagonal that makes the matrix diagonally dominant by `margin`.
fn values(pattern: &Pattern, margin: f64, random: &mut Random) -> Vec<f64> {
    let n = 3 * pattern.vertex_count();
    let mut sums = vec![0.0_f64; n];
    let mut out: Vec<f64> = (0..pattern.value_count()).map(|_| random.signed()).collect();
    let entries = |j: usize| pattern.col_ptr()[j] as usize + 1..pattern.col_ptr()[j + 1] as usize;
    let rows = pattern.row_idx();
    for j in 0..n {
        for p in entries(j) {
            sums[j] += out[p].abs();
            sums[rows[p] as usize] += out[p].abs();
        }
    }
    for (j, sum) in sums.iter().enumerate() {
        out[pattern.col_ptr()[j] as usize] = sum + margin * (1.0 + random.unit());
    }
    out
}

/// The full symmetric matrix, by rows.
fn dense(pattern: &Pattern, values: &[f64]) -> Vec<Vec<f64>> {
    let n = 3 * pattern.vertex_count();
    let mut out = vec![vec![0.0; n]; n];
    let rows = pattern.row_idx();
    for j in 0..n {
        for p in pattern.col_ptr()[j] as usize..pattern.col_ptr()[j + 1] as usize {
            let i = rows[p] as usize;
            out[i][j] = values[p];
            out[j][i] = values[p];
        }
    }
    out
}

/// Textbook dense Cholesky factorisation and solve.
fn dense_solve(mut a: Vec<Vec<f64>>, b: &mut [f64]) {
    let n = b.len();
    for j in 0..n {
        for k in 0..j {
            for i in j..n {
                a[i][j] -= a[i][k] * a[j][k];
            }
        }
        assert!(a[j][j] > 0.0);
        a[j][j] = a[j][j].sqrt();
        for i in j + 1..n {
            a[i][j] /= a[j][j];
        }
    }
    for i in 0..n {
        for k in 0..i {
            b[i] -= a[i][k] * b[k];
        }
        b[i] /= a[i][i];
    }
    for i in (0..n).rev() {
        for k in i + 1..n {
            b[i] -= a[k][i] * b[k];
        }
        b[i] /= a[i][i];
    }
}

fn close(found: &[f64], wanted: &[f64], tolerance: f64) {
    let scale = wanted.iter().fold(1e-300_f64, |m, x| m.max(x.abs()));
    for (k, (a, b)) in found.iter().zip(wanted).enumerate() {
        assert!((a - b).abs() <= tolerance * scale, "row {k}: {a} and {b}");
    }
}

fn analysed(pattern: &Pattern) -> Factor {
    let mut factor = Factor::default();
    factor.analyse(MemoryLimit::NONE, pattern).unwrap();
    factor
}

/// The same in 32 bits.
fn analysed_in_single(pattern: &Pattern) -> Factor {
    let mut factor = Factor::default().in_single_from(0);
    factor.analyse(MemoryLimit::NONE, pattern).unwrap();
    factor
}

fn agrees_with_dense(pattern: &Pattern, random: &mut Random) {
    let n = 3 * pattern.vertex_count();
    let matrix = values(pattern, 0.1, random);
    let mut factor = analysed(pattern);
    assert!(factor.factorise(pattern, &matrix).unwrap());
    for columns in 1..=3 {
        let mut found: Vec<f64> = (0..columns * n).map(|_| random.signed()).collect();
        let mut wanted = found.clone();
        factor.solve(&mut found, columns);
        for column in wanted.chunks_mut(n.max(1)) {
            dense_solve(dense(pattern, &matrix), column);
        }
        close(&found, &wanted, 1e-11);
    }
}

#[test]
fn random_systems_agree_with_dense_algebra() {
    let mut random = Random::new(11);
    for round in 0..60 {
        let n = 1 + (random.unit() * 50.0) as usize;
        let count = (random.unit() * random.unit() * 5.0 * n as f64) as usize;
        let mut vertex = || (random.unit() * n as f64) as u32;
        let pairs: Vec<(u32, u32)> = (0..count).map(|_| (vertex(), vertex())).collect();
        let mut random = Random::new(100 + round);
        agrees_with_dense(&pattern(n, pairs), &mut random);
    }
}

#[test]
fn extreme_trees_agree_with_dense_algebra() {
    let mut random = Random::new(12);
    let n = 40_u32;
    let all = |a: u32| (0..a).map(move |b| (a, b));
    agrees_with_dense(&pattern(0, []), &mut random);
    agrees_with_dense(&pattern(1, []), &mut random);
    agrees_with_dense(&pattern(n as usize, []), &mut random);
    agrees_with_dense(&pattern(n as usize, (1..n).map(|a| (a - 1, a))), &mut random);
    agrees_with_dense(&pattern(n as usize, (1..n).map(|a| (0, a))), &mut random);
    agrees_with_dense(&pattern(n as usize, (1..n).map(|a| (n - 1, a - 1))), &mut random);
    agrees_with_dense(&pattern(n as usize, (1..n).map(|a| ((a - 1) / 2, a))), &mut random);
    agrees_with_dense(&pattern(n as usize, (0..n).flat_map(all)), &mut random);
    // Two disconnected parts, one of them dense.
    agrees_with_dense(&pattern(n as usize, (0..n / 2).flat_map(all).chain([(n - 1, n - 2)])), &mut random);
}

/// A grid of `width` by `height` vertices with a stencil like that of a bending term, and random edges like those of
/// contacts.
fn sheet(width: u32, height: u32, chords: usize, random: &mut Random) -> Pattern {
    let mut pairs = Vec::new();
    for y in 0..height {
        for x in 0..width {
            for (dx, dy) in [(1, 0), (0, 1), (1, 1), (2, 1), (1, 2), (2, 0), (0, 2)] {
                if x + dx < width && y + dy < height {
                    pairs.push((y * width + x, (y + dy) * width + x + dx));
                }
            }
        }
    }
    for _ in 0..chords {
        let mut vertex = || (random.unit() * f64::from(width * height)) as u32;
        pairs.push((vertex(), vertex()));
    }
    pattern((width * height) as usize, pairs)
}

fn agrees_with_faer(pattern: &Pattern, random: &mut Random) {
    let n = 3 * pattern.vertex_count();
    let matrix = values(pattern, 1e-3, random);
    let mut found: Vec<f64> = (0..2 * n).map(|_| random.signed()).collect();
    let mut wanted = found.clone();
    let mut factor = analysed(pattern);
    assert!(factor.factorise(pattern, &matrix).unwrap());
    factor.solve(&mut found, 2);
    let rows = pattern.row_idx();
    let symbolic = SymbolicSparseColMatRef::new_checked(n, n, pattern.col_ptr(), None, &rows);
    let other = SparseColMatRef::new(symbolic, &matrix).sp_cholesky(Side::Lower).unwrap();
    other.solve_in_place(MatMut::from_column_major_slice_mut(&mut wanted, n, 2));
    close(&found, &wanted, 1e-9);
}

#[test]
fn garments_of_real_size_agree_with_faer() {
    // Elimination trees of many shapes, with different parallel split points.
    let mut random = Random::new(13);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build().unwrap();
    pool.install(|| {
        for _ in 0..16 {
            let mut size = || 10 + (random.unit() * 65.0) as u32;
            let (width, height) = (size(), size());
            let chords = (random.unit() * random.unit() * 100.0) as usize;
            let pattern = sheet(width, height, chords, &mut random);
            agrees_with_faer(&pattern, &mut random);
        }
        // Disconnected parts.
        let edges = (0..12).flat_map(|k| {
            let (first, width) = (1000 * k, 10 + k);
            (0..1000).flat_map(move |v| [1, width, width + 1].map(move |step| (first + v, first + v + step)))
        });
        let within = edges.filter(|(a, b)| a / 1000 == b / 1000);
        agrees_with_faer(&pattern(12_000, within), &mut random);
    });
}

#[test]
fn large_garments_agree_with_faer_in_another_order() {
    // On both sides of the size from which the order is by nested dissection; in two separate parts, in none that hang together, and
    // around one vertex.
    let mut random = Random::new(17);
    for (width, height) in [(141, 141), (142, 142), (40, 600)] {
        agrees_with_faer(&sheet(width, height, 50, &mut random), &mut random);
    }
    let one = |from: u32| (0..11_000_u32).map(move |v| (from + v, from + v + 1));
    agrees_with_faer(&pattern(22_002, one(0).chain(one(11_001))), &mut random);
    agrees_with_faer(&pattern(20_001, []), &mut random);
    agrees_with_faer(&pattern(20_001, (1..20_001).map(|v| (0, v))), &mut random);
}

#[test]
fn fill_grows_hardly_faster_than_n_log_n_into_nested_dissection() {
    // By rows it would grow as n^1.5: 1.75 in place of 1.14 here.
    let mut random = Random::new(19);
    let mut fill = |width: u32| {
        let pattern = sheet(width, width, 0, &mut random);
        analysed(&pattern).value_count() as f64 / pattern.vertex_count() as f64 / f64::from(width).ln()
    };
    let (by_minimum_degree, by_dissection) = (fill(141), fill(282));
    assert!(by_dissection < 1.2 * by_minimum_degree, "{by_minimum_degree} and {by_dissection} scalars");
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let mut random = Random::new(14);
    // Large enough for parallel subtrees and for fronts that several threads share.
    let pattern = sheet(90, 70, 60, &mut random);
    let matrix = values(&pattern, 1e-3, &mut random);
    let rhs: Vec<f64> = (0..6 * pattern.vertex_count()).map(|_| random.signed()).collect();
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut factor = analysed(&pattern);
            let mut out = Vec::new();
            // The second time in used work space.
            for _ in 0..2 {
                assert!(factor.factorise(&pattern, &matrix).unwrap());
                let mut x = rhs.clone();
                factor.solve(&mut x, 2);
                out.extend(x.into_iter().map(f64::to_bits));
            }
            out
        })
    };
    let first = run(1);
    let (once, again) = first.split_at(rhs.len());
    assert!(once == again);
    for threads in [2, 5, 16] {
        assert!(first == run(threads), "other bits with {threads} threads");
    }
}

#[test]
fn a_matrix_that_is_not_positive_definite_is_refused_and_the_next_one_is_not() {
    let mut random = Random::new(15);
    let pattern = sheet(30, 20, 10, &mut random);
    let n = 3 * pattern.vertex_count();
    let good = values(&pattern, 0.1, &mut random);
    let mut factor = analysed(&pattern);
    for bad in [-1.0, 0.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for j in [0, n / 2, n - 1] {
            let mut matrix = good.clone();
            matrix[pattern.col_ptr()[j] as usize] = bad;
            assert!(!factor.factorise(&pattern, &matrix).unwrap(), "{bad} in column {j}");
        }
    }
    assert!(factor.factorise(&pattern, &good).unwrap());
    let mut found: Vec<f64> = (0..n).map(|_| random.signed()).collect();
    let mut wanted = found.clone();
    factor.solve(&mut found, 1);
    let mut fresh = analysed(&pattern);
    assert!(fresh.factorise(&pattern, &good).unwrap());
    fresh.solve(&mut wanted, 1);
    assert_eq!(found, wanted);
}

#[test]
fn a_limit_is_kept_to_the_byte() {
    let pattern = sheet(30, 20, 10, &mut Random::new(16));
    let held = analysed(&pattern).memory();
    assert!(Factor::default().analyse(MemoryLimit::new(held), &pattern).is_ok());
    let error = Factor::default().analyse(MemoryLimit::new(held - 1), &pattern).unwrap_err();
    assert_eq!(error.kind, ErrorKind::MemoryLimit);
}

#[test]
fn another_pattern_is_analysed_in_the_memory_of_the_one_before() {
    let mut random = Random::new(17);
    let mut factor = Factor::default();
    assert!(!factor.factorise(&pattern(0, []), &[]).unwrap());
    for (width, chords) in [(12, 0), (20, 30), (9, 2)] {
        let pattern = sheet(width, 15, chords, &mut random);
        let matrix = values(&pattern, 0.1, &mut random);
        factor.analyse(MemoryLimit::NONE, &pattern).unwrap();
        let fresh = analysed(&pattern);
        assert!(factor.memory() >= fresh.memory() && factor.value_count() == fresh.value_count());
        assert!(factor.factorise(&pattern, &matrix).unwrap());
        let mut found: Vec<f64> = (0..3 * pattern.vertex_count()).map(|_| random.signed()).collect();
        let mut wanted = found.clone();
        factor.solve(&mut found, 1);
        dense_solve(dense(&pattern, &matrix), &mut wanted);
        close(&found, &wanted, 1e-11);
    }
    let larger = sheet(40, 40, 0, &mut random);
    let limit = MemoryLimit::new(factor.memory());
    assert_eq!(factor.analyse(limit, &larger).unwrap_err().kind, ErrorKind::MemoryLimit);
    assert!(!factor.factorise(&larger, &values(&larger, 0.1, &mut random)).unwrap());
}

#[test]
fn a_request_to_stop_ends_it() {
    let mut random = Random::new(18);
    let pattern = sheet(20, 20, 0, &mut random);
    let matrix = values(&pattern, 0.1, &mut random);
    let cancel = Cancel::new();
    let mut factor = Factor::new(cancel.clone());
    factor.analyse(MemoryLimit::NONE, &pattern).unwrap();
    assert!(factor.factorise(&pattern, &matrix).unwrap());
    cancel.request();
    assert_eq!(factor.factorise(&pattern, &matrix), Err(Cancelled));
    assert_eq!(factor.analyse(MemoryLimit::NONE, &pattern).unwrap_err().kind, ErrorKind::Cancelled);
}

/// Multiplies rows and columns by powers of ten, up to 10^8 from the smallest to the largest.
fn scaled_badly(pattern: &Pattern, mut values: Vec<f64>, random: &mut Random) -> Vec<f64> {
    let scale: Vec<f64> =
        (0..3 * pattern.vertex_count()).map(|_| 10f64.powi((random.unit() * 9.0) as i32 - 4)).collect();
    let rows = pattern.row_idx();
    for j in 0..scale.len() {
        for p in pattern.col_ptr()[j] as usize..pattern.col_ptr()[j + 1] as usize {
            values[p] *= scale[j] * scale[rows[p] as usize];
        }
    }
    values
}

#[test]
fn a_factor_in_32_bits_is_one_but_for_its_rounding() {
    let mut random = Random::new(19);
    for (width, height, chords) in [(1, 1, 0), (3, 2, 0), (30, 20, 12), (70, 60, 40)] {
        let pattern = sheet(width, height, chords, &mut random);
        let n = 3 * pattern.vertex_count();
        let plain = values(&pattern, 0.05, &mut random);
        let matrix = scaled_badly(&pattern, plain, &mut random);
        let (mut double, mut single) = (analysed(&pattern), analysed_in_single(&pattern));
        assert_eq!((double.precision(), single.precision()), (Precision::Double, Precision::Single));
        assert_eq!(double.value_count(), single.value_count());
        assert!(double.factorise(&pattern, &matrix).unwrap() && single.factorise(&pattern, &matrix).unwrap());
        for columns in 1..=3 {
            let mut wanted: Vec<f64> = (0..columns * n).map(|_| random.signed()).collect();
            let mut found = wanted.clone();
            double.solve(&mut wanted, columns);
            single.solve(&mut found, columns);
            // In the variables in which the matrix has a unit diagonal.
            let root = |k: usize| matrix[pattern.col_ptr()[k % n] as usize].sqrt();
            let in_these = |x: &[f64]| x.iter().enumerate().map(|(k, x)| x * root(k)).collect::<Vec<_>>();
            close(&in_these(&found), &in_these(&wanted), 1e-4);
            assert_ne!(found, wanted, "the same bits in 32 and 64");
        }
    }
}

#[test]
fn a_factor_in_32_bits_has_the_same_bits_for_any_number_of_threads() {
    let mut random = Random::new(20);
    let pattern = sheet(90, 70, 60, &mut random);
    let matrix = values(&pattern, 1e-2, &mut random);
    let rhs: Vec<f64> = (0..6 * pattern.vertex_count()).map(|_| random.signed()).collect();
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut factor = analysed_in_single(&pattern);
            assert!(factor.factorise(&pattern, &matrix).unwrap());
            let mut x = rhs.clone();
            factor.solve(&mut x, 2);
            x.into_iter().map(f64::to_bits).collect::<Vec<_>>()
        })
    };
    let first = run(1);
    for threads in [2, 5, 16] {
        assert!(first == run(threads), "other bits with {threads} threads");
    }
}

#[test]
fn a_factor_in_32_bits_takes_half_the_memory_and_can_become_one_in_64() {
    let mut random = Random::new(21);
    let pattern = sheet(60, 50, 30, &mut random);
    let matrix = values(&pattern, 0.1, &mut random);
    let double = analysed(&pattern).memory();
    let mut factor = analysed_in_single(&pattern);
    assert!(factor.factorise(&pattern, &matrix).unwrap());
    assert!((factor.memory() as f64) < 0.7 * double as f64, "{} of {double}", factor.memory());
    assert_eq!(factor.widen(MemoryLimit::new(double - 1), &pattern).unwrap_err().kind, ErrorKind::MemoryLimit);

    let mut factor = analysed_in_single(&pattern);
    factor.widen(MemoryLimit::new(double), &pattern).unwrap();
    assert_eq!((factor.precision(), factor.memory()), (Precision::Double, double));
    assert!(factor.factorise(&pattern, &matrix).unwrap());
    let mut fresh = analysed(&pattern);
    assert!(fresh.factorise(&pattern, &matrix).unwrap());
    let mut found: Vec<f64> = (0..3 * pattern.vertex_count()).map(|_| random.signed()).collect();
    let mut wanted = found.clone();
    factor.solve(&mut found, 1);
    fresh.solve(&mut wanted, 1);
    assert_eq!(found, wanted);
}

#[test]
fn a_matrix_that_is_not_positive_definite_is_refused_in_32_bits() {
    let mut random = Random::new(22);
    let pattern = sheet(20, 20, 5, &mut random);
    let good = values(&pattern, 0.1, &mut random);
    let mut factor = analysed_in_single(&pattern);
    for bad in [-1.0, 0.0, f64::NAN, f64::INFINITY] {
        let mut matrix = good.clone();
        matrix[pattern.col_ptr()[600] as usize] = bad;
        assert!(!factor.factorise(&pattern, &matrix).unwrap(), "{bad}");
    }
    assert!(factor.factorise(&pattern, &good).unwrap());
}
