//! Inpainting: the weights of vertices that are not sure, from those that are.
//!
//! Minimises, for the weights `w` of each joint,
//!
//! ```text
//! w^T L M^-1 L w  +  sum over vertices of  m pull (w - w_closest)^2
//! ```
//!
//! with the weights held where the pull is infinite. L is the cotangent Laplacian, M the diagonal matrix of the masses m of the
//! vertices. The first part is the bilaplacian energy; the second one smooths what is sure over a length in proportion to
//! its distance from the body. A constant costs nothing, so that the weights of all joints sum to 1 as those of the closest
//! points do. They may come out below 0 or above 1, and are clamped then.

use faer::Mat;

use super::factor::{self, Columns};
use super::laplacian::{Laplacian, Rule};
use super::sure::Sure;
use crate::control::Cancel;
use crate::error::Result;
use crate::geometry::mesh::TriangleMesh;
use crate::input::skin::SkinWeights;

/// How the Laplacian is had, one after the other until the system can be solved.
const RULES: [Rule; 3] = [Rule::Mollified(1e-5), Rule::Mollified(1e-2), Rule::Equilateral];

/// How far the weights of a vertex may sum to something else than 1 where the system counts as solved.
const WELL_SOLVED: f64 = 1e-4;

/// A weight below this is none.
const NO_WEIGHT: f64 = 1e-6;

/// The weights of all vertices, of sum 1. Those that are held, and those of vertices without a triangle, are as they were.
///
/// # Errors
/// [`ErrorKind::Internal`] where memory runs out, [`ErrorKind::Cancelled`].
pub fn inpaint(garment: &TriangleMesh, sure: &Sure, cancel: &Cancel) -> Result<SkinWeights> {
    // In the unit of the pulls, so that nothing overflows whatever the caller's unit is.
    let positions: Vec<_> = garment.positions.iter().map(|&p| p / sure.size).collect();
    for rule in RULES {
        cancel.check()?;
        let laplacian = Laplacian::new(&positions, &garment.triangles, rule);
        let system = System::new(&laplacian, sure);
        if system.unknown.is_empty() {
            break;
        }
        if let Some(solved) = system.solve(cancel)? {
            return Ok(system.assemble(&solved));
        }
    }
    // All are held; or coordinates so extreme that not even the graph's system can be solved.
    Ok(sure.weights.clone())
}

/// The linear system: one unknown for each vertex that is not held, one right-hand side for each joint.
struct System<'a> {
    laplacian: &'a Laplacian,
    sure: &'a Sure,
    /// The vertices that are not held, ascending.
    unknown: Vec<u32>,
    /// The joints that occur, ascending.
    joints: Vec<u32>,
}

impl<'a> System<'a> {
    fn new(laplacian: &'a Laplacian, sure: &'a Sure) -> Self {
        let count = sure.pulls.len();
        let is_unknown = |v: &u32| sure.pulls[*v as usize].is_finite() && laplacian.mass[*v as usize] > 0.0;
        let unknown = (0..count as u32).filter(is_unknown).collect();
        let mut occurs = vec![false; sure.weights.joint_count()];
        for v in (0..count).filter(|&v| sure.pulls[v] > 0.0) {
            sure.weights.weights(v).iter().for_each(|&(joint, _)| occurs[joint as usize] = true);
        }
        let joints = (0..occurs.len() as u32).filter(|&joint| occurs[joint as usize]).collect();
        Self { laplacian, sure, unknown, joints }
    }

    /// One row for each unknown vertex and one column for each joint; none where the system is not well conditioned enough.
    fn solve(&self, cancel: &Cancel) -> Result<Option<Mat<f64>>> {
        let (n, columns) = (self.unknown.len(), self.joints.len());
        let Some(x) = factor::solve(&self.matrix(), &self.right_hand_sides(), cancel)? else { return Ok(None) };
        let error = |i: usize| ((0..columns).map(|k| x[(i, k)]).sum::<f64>() - 1.0).abs();
        // Not at all where one is not a number.
        Ok((0..n).all(|i| error(i) <= WELL_SOLVED).then_some(x))
    }

    /// The part of `L M^-1 L` that belongs to the unknown vertices, with the pulls on its diagonal.
    fn matrix(&self) -> Columns {
        let Self { laplacian, sure, unknown, .. } = self;
        let mut number = vec![u32::MAX; sure.pulls.len()];
        unknown.iter().zip(0..).for_each(|(&v, k)| number[v as usize] = k);
        let mut matrix = Columns { start: vec![0], rows: Vec::new(), values: Vec::new() };
        let mut sums = vec![0.0; unknown.len()];
        let mut last_column = vec![u32::MAX; unknown.len()];
        for (&v, column) in unknown.iter().zip(0..) {
            let first = matrix.rows.len();
            for &(k, a) in laplacian.row(v as usize) {
                let a = a / laplacian.mass[k as usize];
                for &(w, b) in laplacian.row(k as usize) {
                    let row = number[w as usize];
                    if row == u32::MAX || row < column {
                        continue;
                    }
                    if last_column[row as usize] != column {
                        last_column[row as usize] = column;
                        sums[row as usize] = 0.0;
                        matrix.rows.push(row);
                    }
                    sums[row as usize] += a * b;
                }
            }
            sums[column as usize] += sure.pulls[v as usize] * laplacian.mass[v as usize];
            matrix.rows[first..].sort_unstable();
            matrix.values.extend(matrix.rows[first..].iter().map(|&row| sums[row as usize]));
            matrix.start.push(matrix.rows.len() as u32);
        }
        matrix
    }

    /// What the closest points' weights of each joint ask of the unknown ones.
    fn right_hand_sides(&self) -> Mat<f64> {
        let Self { laplacian, sure, unknown, joints } = self;
        let count = sure.pulls.len();
        let apply = |row: &[(u32, f64)], w: &[f64]| row.iter().map(|&(j, a)| a * w[j as usize]).sum::<f64>();
        let mut sides = Mat::zeros(unknown.len(), joints.len());
        let (mut held, mut bent) = (vec![0.0; count], vec![0.0; count]);
        for (column, &joint) in joints.iter().enumerate() {
            let closest = |v: usize| {
                let own = sure.weights.weights(v);
                own.binary_search_by_key(&joint, |w| w.0).map_or(0.0, |at| own[at].1)
            };
            for (v, (held, pull)) in held.iter_mut().zip(&sure.pulls).enumerate() {
                *held = if pull.is_infinite() { closest(v) } else { 0.0 };
            }
            // A vertex without mass is in no row.
            for v in (0..count).filter(|&v| laplacian.mass[v] > 0.0) {
                bent[v] = apply(laplacian.row(v), &held) / laplacian.mass[v];
            }
            for (i, &v) in unknown.iter().enumerate() {
                let v = v as usize;
                let drawn = if sure.pulls[v] > 0.0 { sure.pulls[v] * laplacian.mass[v] * closest(v) } else { 0.0 };
                sides[(i, column)] = drawn - apply(laplacian.row(v), &bent);
            }
        }
        sides
    }

    /// All weights, the unknown ones clamped and of sum 1.
    fn assemble(&self, solved: &Mat<f64>) -> SkinWeights {
        let Self { sure, unknown, joints, .. } = self;
        let mut next = 0;
        let rows = (0..sure.pulls.len()).map(|v| {
            if unknown.get(next) != Some(&(v as u32)) {
                return sure.weights.weights(v).to_vec();
            }
            let all = joints.iter().enumerate().map(|(k, &joint)| (joint, solved[(next, k)]));
            let mut row: Vec<(u32, f64)> = all.filter(|&(_, weight)| weight > NO_WEIGHT).collect();
            next += 1;
            let sum: f64 = row.iter().map(|&(_, weight)| weight).sum();
            row.iter_mut().for_each(|(_, weight)| *weight /= sum);
            row
        });
        SkinWeights::from_rows(sure.weights.joint_count(), rows)
    }
}
