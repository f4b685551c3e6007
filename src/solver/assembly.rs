//! Gradient and Hessian of a weighted sum of energies.
//!
//! A term's elements are evaluated in fixed chunks in parallel; then blocks of columns sum the contributions to their
//! vertices. Both in a fixed order: the sums have the same bits with any number of threads.

use std::time::{Duration, Instant};

use rayon::prelude::*;

use super::Term;
use super::element_buffer::{ColumnBlock, ELEMENT_BYTES, ElementBuffer, Scratch, VertexElements};
use super::pattern::{PairCollector, Pattern};
use super::profile::Profile;
use crate::control::{Cancel, Cancelled};
use crate::energy::Configuration;
use crate::memory::bytes;

/// Elements in a chunk.
const CHUNK: usize = 32;
/// Chunks that are evaluated before they are summed: it bounds the memory of their derivatives.
const BATCH: usize = 64;
/// Column blocks, about this many: units of parallel summation.
const COLUMN_BLOCKS: usize = 64;

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
    buffers: Vec<ElementBuffer>,
    vertex_elements: VertexElements,
    /// Time in each term, over all threads.
    times: Vec<Duration>,
    cancel: Cancel,
}

impl System {
    /// An empty system. `cancel` is checked in assembly.
    pub fn new(cancel: Cancel) -> Self {
        Self { cancel, ..Self::default() }
    }

    /// Assembles the derivatives of `terms` at `at`. Returns the pairs of vertices that are missing in the pattern;
    /// where there are any, the Hessian is incomplete.
    ///
    /// # Errors
    /// [`Cancelled`]; the token is checked in each chunk of elements.
    pub fn assemble(
        &mut self,
        pattern: &Pattern,
        terms: &[Term<'_>],
        at: Configuration<'_>,
    ) -> Result<PairCollector, Cancelled> {
        self.clear(pattern);
        self.times.clear();
        let mut missing = PairCollector::default();
        for term in terms {
            let mut time = Duration::ZERO;
            let count = if term.weight == 0.0 { 0 } else { term.energy.len() };
            for first in (0..count).step_by(CHUNK * BATCH) {
                let last = count.min(first + CHUNK * BATCH);
                time += self.evaluate(term, first, last, at)?;
                time += self.sum(pattern, &mut missing);
            }
            self.times.push(time);
        }
        self.cancel.check()?;
        Ok(missing)
    }

    /// Adds to `profile` the times of `terms` in the last assembly, which must have been of the same terms.
    pub fn note_times(&self, terms: &[Term<'_>], profile: &mut Profile) {
        for (term, &time) in terms.iter().zip(&self.times).filter(|(_, time)| !time.is_zero()) {
            profile.term(term.energy.name()).derivatives += time;
        }
    }

    /// Bytes held.
    pub fn memory(&self) -> u64 {
        let buffers: u64 = self.buffers.iter().map(ElementBuffer::memory).sum();
        buffers + self.vertex_elements.memory() + bytes(&self.hessian) + bytes(&self.gradient) + bytes(&self.border)
    }

    /// Estimate of the bytes held after an assembly with `pattern`.
    pub fn memory_for(pattern: &Pattern) -> u64 {
        let n = pattern.vertex_count();
        // A surface has twice as many triangles as vertices, and three times as many edges.
        let elements = (3 * n).min(CHUNK * BATCH);
        ((pattern.value_count() + 6 * n) * size_of::<f64>() + elements * ELEMENT_BYTES) as u64
    }

    /// Resizes to `pattern` and sets everything to zero.
    fn clear(&mut self, pattern: &Pattern) {
        let n = 3 * pattern.vertex_count();
        for (array, len) in [(&mut self.hessian, pattern.value_count()), (&mut self.gradient, n), (&mut self.border, n)]
        {
            array.resize(len, 0.0);
            array.par_chunks_mut(1 << 14).for_each(|part| part.fill(0.0));
        }
        (self.t_gradient, self.t_hessian) = (0.0, 0.0);
    }

    /// Evaluates the derivatives of elements `first..last` into the buffers. Returns the time, over all threads.
    fn evaluate(
        &mut self,
        term: &Term<'_>,
        first: usize,
        last: usize,
        at: Configuration<'_>,
    ) -> Result<Duration, Cancelled> {
        self.buffers.resize_with((last - first).div_ceil(CHUNK), ElementBuffer::default);
        let cancel = &self.cancel;
        let work = |(k, buffer): (usize, &mut ElementBuffer)| {
            let clock = Instant::now();
            buffer.clear(term.weight);
            let start = first + k * CHUNK;
            if !cancel.is_requested() {
                term.energy.derivatives(at, start..last.min(start + CHUNK), buffer);
            }
            clock.elapsed()
        };
        let time = self.buffers.par_iter_mut().enumerate().map(work).sum();
        // Chunks were skipped if it was set.
        self.cancel.check()?;
        Ok(time)
    }

    /// Adds the buffers to the system, and pairs that are missing in `pattern` to `missing`. Returns the time, over all
    /// threads.
    fn sum(&mut self, pattern: &Pattern, missing: &mut PairCollector) -> Duration {
        let clock = Instant::now();
        for buffer in &self.buffers {
            self.t_gradient += buffer.t_gradient;
            self.t_hessian += buffer.t_hessian;
        }
        let n = pattern.vertex_count();
        self.vertex_elements.find(n, &self.buffers);
        let serial = clock.elapsed();
        let (buffers, vertex_elements) = (&self.buffers, &self.vertex_elements);
        let mut blocks = blocks(pattern, vertex_elements, &mut self.hessian, &mut self.gradient, &mut self.border);
        let work = |scratch: &mut Scratch, block: &mut ColumnBlock<'_>| {
            let clock = Instant::now();
            block.add(pattern, buffers, vertex_elements, scratch);
            clock.elapsed()
        };
        let parallel: Duration = blocks.par_iter_mut().map_init(|| Scratch::new(pattern), work).sum();
        blocks.iter_mut().for_each(|block| missing.append(&mut block.missing));
        serial + parallel
    }
}

/// Partitions the vertices, and their columns, into consecutive blocks with about the same number of elements each.
fn blocks<'a>(
    pattern: &Pattern,
    vertex_elements: &VertexElements,
    mut hessian: &'a mut [f64],
    mut gradient: &'a mut [f64],
    mut border: &'a mut [f64],
) -> Vec<ColumnBlock<'a>> {
    let n = pattern.vertex_count();
    let share = (vertex_elements.entries_below(n) as usize).div_ceil(COLUMN_BLOCKS).max(1);
    let mut blocks = Vec::with_capacity(COLUMN_BLOCKS + 1);
    let mut first = 0;
    while first < n {
        let wanted = vertex_elements.entries_below(first) as usize + share;
        let mut next = first + 1;
        while next < n && (vertex_elements.entries_below(next) as usize) < wanted {
            next += 1;
        }
        let values = pattern.col_ptr()[3 * next] - pattern.col_ptr()[3 * first];
        blocks.push(ColumnBlock {
            first,
            hessian: hessian.split_off_mut(..values as usize).unwrap_or_default(),
            gradient: gradient.split_off_mut(..3 * (next - first)).unwrap_or_default(),
            border: border.split_off_mut(..3 * (next - first)).unwrap_or_default(),
            missing: PairCollector::default(),
        });
        first = next;
    }
    blocks
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
