//! Gradient and Hessian of a weighted sum of energies.
//!
//! Elements are dealt in fixed chunks to a fixed number of lanes, each with arrays of its own, which are then added
//! in order: the sums have the same bits whatever the number of threads.

use std::time::{Duration, Instant};

use glam::DVec3;
use rayon::prelude::*;

use super::Term;
use super::pattern::{PairCollector, Pattern};
use super::profile::Profile;
use crate::control::Cancel;
use crate::energy::{Configuration, Direction, Sink};
use crate::memory::bytes;

/// Elements in a chunk.
const CHUNK: usize = 256;
/// Arrays that are filled independently. More lanes help more threads and cost more additions.
const LANES: usize = 4;

/// The linear system of one Newton iteration: `[H b; b^T c] [dx; dt] = -[g; g_t]`.
#[derive(Clone, Debug, Default)]
pub struct System {
    /// Lower triangle of H, in the order of the pattern.
    pub hessian: Vec<f64>,
    /// g, three entries a vertex.
    pub gradient: Vec<f64>,
    /// b: mixed derivatives of vertices and t.
    pub border: Vec<f64>,
    /// g_t.
    pub t_gradient: f64,
    /// c.
    pub t_hessian: f64,
    lanes: Vec<Lane>,
    cancel: Cancel,
}

#[derive(Clone, Debug, Default)]
struct Lane {
    hessian: Vec<f64>,
    gradient: Vec<f64>,
    border: Vec<f64>,
    t_gradient: f64,
    t_hessian: f64,
    missing: PairCollector,
    /// Time in each term.
    times: Vec<Duration>,
}

/// A lane while it receives one term.
struct LaneSink<'a> {
    lane: &'a mut Lane,
    pattern: &'a Pattern,
    weight: f64,
}

impl Sink for LaneSink<'_> {
    fn rank_one(&mut self, a: Direction<'_>, g: f64, h: f64) {
        let (g, h) = (g * self.weight, h * self.weight);
        let lane = &mut *self.lane;
        lane.t_gradient += g * a.t;
        lane.t_hessian += h * a.t * a.t;
        for (k, (&v, &c)) in a.vertices.iter().zip(a.components).enumerate() {
            let at = 3 * v as usize;
            let ht = h * a.t;
            for r in 0..3 {
                lane.gradient[at + r] += g * c[r];
                lane.border[at + r] += ht * c[r];
            }
            if h == 0.0 {
                continue;
            }
            let hc = h * c;
            let d = self.pattern.diagonal(v);
            for col in 0..3 {
                for row in col..3 {
                    lane.hessian[d[col] + row - col] += hc[row] * c[col];
                }
            }
            for (&w, &e) in a.vertices[..k].iter().zip(a.components) {
                let (row, col, rc, cc) = if v > w { (v, w, c, e) } else { (w, v, e, c) };
                let Some(block) = self.pattern.block(row, col) else {
                    lane.missing.add(row, col);
                    continue;
                };
                for (column, &start) in block.iter().enumerate() {
                    let s = h * cc[column];
                    for r in 0..3 {
                        lane.hessian[start + r] += s * rc[r];
                    }
                }
            }
        }
    }

    fn gradient(&mut self, vertex: u32, g: DVec3) {
        let at = 3 * vertex as usize;
        for r in 0..3 {
            self.lane.gradient[at + r] += self.weight * g[r];
        }
    }

    fn block(&mut self, vertices: &[u32], block: &[f64]) {
        let stride = 3 * vertices.len();
        let lane = &mut *self.lane;
        for (k, &v) in vertices.iter().enumerate() {
            let d = self.pattern.diagonal(v);
            for col in 0..3 {
                for row in col..3 {
                    lane.hessian[d[col] + row - col] += self.weight * block[(3 * k + row) * stride + 3 * k + col];
                }
            }
            for (m, &w) in vertices[..k].iter().enumerate() {
                let (row, col, i, j) = if v > w { (v, w, k, m) } else { (w, v, m, k) };
                let Some(slots) = self.pattern.block(row, col) else {
                    lane.missing.add(row, col);
                    continue;
                };
                for (c, &start) in slots.iter().enumerate() {
                    for r in 0..3 {
                        lane.hessian[start + r] += self.weight * block[(3 * i + r) * stride + 3 * j + c];
                    }
                }
            }
        }
    }
}

impl System {
    /// From now on looks at `cancel`; once that is set, what is assembled is incomplete.
    pub fn watch(&mut self, cancel: Cancel) {
        self.cancel = cancel;
    }

    /// Evaluates all the derivatives of `terms` at `at`. Returns the pairs of vertices that the pattern lacks; where
    /// there are any, the Hessian is incomplete.
    pub fn assemble(&mut self, pattern: &Pattern, terms: &[Term<'_>], at: Configuration<'_>) -> PairCollector {
        let chunks: Vec<(usize, usize)> = (0..terms.len())
            .filter(|&term| terms[term].weight != 0.0)
            .flat_map(|term| (0..terms[term].energy.len()).step_by(CHUNK).map(move |start| (term, start)))
            .collect();
        self.lanes.resize_with(LANES, Lane::default);
        let cancel = &self.cancel;
        self.lanes.par_iter_mut().enumerate().for_each(|(index, lane)| {
            lane.clear(pattern);
            lane.times.clear();
            lane.times.resize(terms.len(), Duration::ZERO);
            let mut clock = Instant::now();
            for &(term, start) in chunks.iter().skip(index).step_by(LANES) {
                if cancel.is_requested() {
                    return;
                }
                let Term { energy, weight } = terms[term];
                let range = start..(start + CHUNK).min(energy.len());
                energy.derivatives(at, range, &mut LaneSink { lane, pattern, weight });
                let now = Instant::now();
                lane.times[term] += now - clock;
                clock = now;
            }
        });
        self.add_lanes(pattern);
        let mut missing = PairCollector::default();
        for lane in &mut self.lanes {
            missing.append(&mut lane.missing);
        }
        missing
    }

    /// Adds the times that `terms` took in the last assembly, which was of them.
    pub fn note_times(&self, terms: &[Term<'_>], profile: &mut Profile) {
        for lane in &self.lanes {
            for (term, &time) in terms.iter().zip(&lane.times).filter(|(_, time)| !time.is_zero()) {
                profile.term(term.energy.name()).derivatives += time;
            }
        }
    }

    /// Bytes that it holds.
    pub fn memory(&self) -> u64 {
        let lanes: u64 = self.lanes.iter().map(|l| bytes(&l.hessian) + bytes(&l.gradient) + bytes(&l.border)).sum();
        lanes + bytes(&self.hessian) + bytes(&self.gradient) + bytes(&self.border)
    }

    /// Bytes that it will hold for `pattern`.
    pub fn memory_for(pattern: &Pattern) -> u64 {
        ((LANES + 1) * (pattern.value_count() + 6 * pattern.vertex_count()) * size_of::<f64>()) as u64
    }

    fn add_lanes(&mut self, pattern: &Pattern) {
        let n = 3 * pattern.vertex_count();
        self.hessian.resize(pattern.value_count(), 0.0);
        self.gradient.resize(n, 0.0);
        self.border.resize(n, 0.0);
        let lanes = &self.lanes;
        let add = |out: &mut [f64], of: fn(&Lane) -> &[f64]| {
            out.par_chunks_mut(1 << 14).enumerate().for_each(|(k, out)| {
                let start = k << 14;
                out.copy_from_slice(&of(&lanes[0])[start..start + out.len()]);
                for lane in &lanes[1..] {
                    for (o, v) in out.iter_mut().zip(&of(lane)[start..]) {
                        *o += v;
                    }
                }
            });
        };
        add(&mut self.hessian, |lane| &lane.hessian);
        add(&mut self.gradient, |lane| &lane.gradient);
        add(&mut self.border, |lane| &lane.border);
        self.t_gradient = lanes.iter().map(|lane| lane.t_gradient).sum();
        self.t_hessian = lanes.iter().map(|lane| lane.t_hessian).sum();
    }
}

impl Lane {
    fn clear(&mut self, pattern: &Pattern) {
        let n = 3 * pattern.vertex_count();
        let zero = |v: &mut Vec<f64>, len: usize| {
            v.clear();
            v.resize(len, 0.0);
        };
        zero(&mut self.hessian, pattern.value_count());
        zero(&mut self.gradient, n);
        zero(&mut self.border, n);
        self.t_gradient = 0.0;
        self.t_hessian = 0.0;
    }
}

/// The value of each term, unweighted, in the order of `terms`. Their times are added to `profile`.
pub fn values(terms: &[Term<'_>], at: Configuration<'_>, profile: &mut Profile) -> Vec<f64> {
    let mut timed = |term: &Term<'_>| {
        let (value, time) = value(term, at);
        profile.term(term.energy.name()).values += time;
        value
    };
    terms.iter().map(|term| if term.weight == 0.0 { 0.0 } else { timed(term) }).collect()
}

/// The objective with these values of its terms.
pub fn weighted(terms: &[Term<'_>], values: &[f64]) -> f64 {
    terms.iter().zip(values).map(|(term, v)| if *v == 0.0 { 0.0 } else { term.weight * v }).sum()
}

fn value(term: &Term<'_>, at: Configuration<'_>) -> (f64, Duration) {
    const VALUE_CHUNK: usize = 1024;
    let count = term.energy.len();
    let parts: Vec<(f64, Duration)> = (0..count.div_ceil(VALUE_CHUNK))
        .into_par_iter()
        .map(|k| {
            let clock = Instant::now();
            let part = term.energy.value(at, k * VALUE_CHUNK..((k + 1) * VALUE_CHUNK).min(count));
            (part, clock.elapsed())
        })
        .collect();
    (parts.iter().map(|part| part.0).sum(), parts.iter().map(|part| part.1).sum())
}
