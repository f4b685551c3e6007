//! Curves of a garment that its caller names: a neckline that keeps its shape, a seam line, the rim of a shell.

use std::collections::HashSet;

use super::weld::Weld;
use crate::error::{Error, ErrorKind, Result};

/// The largest weight of a curve.
const MAX_WEIGHT: f64 = 1e6;

/// A curve along edges of the garment, with weights of its own: factors on those of the options.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Garment vertices in the order of the curve, each once; neighbours are joined by an edge.
    pub vertices: Vec<u32>,
    /// The last vertex is joined to the first.
    pub closed: bool,
    /// Factor on the weights of curvature and torsion: 1 as for a boundary curve, 0 for none.
    pub curve_weight: f64,
    /// Factor on the weight of the position along the bones: 1 as for a boundary curve, 0 for none.
    pub position_weight: f64,
}

/// A named curve on the welded garment.
#[derive(Clone, Debug, PartialEq)]
pub struct WeldedCurve {
    /// The curve, of welded vertices.
    pub curve: Curve,
    /// The caller's vertex for each of them.
    pub callers: Vec<u32>,
}

impl Curve {
    /// The fewest vertices that make such a curve.
    fn fewest(&self) -> usize {
        if self.closed { 3 } else { 2 }
    }

    /// Refuses what cannot be a curve of any garment; `name` is its number.
    ///
    /// # Errors
    /// `InvalidArgument`: too few vertices, one of them listed twice, a weight that is not in its range.
    pub fn check(&self, name: usize) -> Result<()> {
        if self.vertices.len() < self.fewest() {
            return too_few(name, self, self.vertices.len());
        }
        let mut seen = HashSet::new();
        if let Some(v) = self.vertices.iter().find(|v| !seen.insert(**v)) {
            return invalid(format!("curve {name}: vertex {v} is listed twice"));
        }
        for (what, weight) in [("curve", self.curve_weight), ("position", self.position_weight)] {
            if !(0.0..=MAX_WEIGHT).contains(&weight) {
                return invalid(format!(
                    "curve {name}: its {what} weight is {weight}; it must be from 0, for none, to {MAX_WEIGHT:e}"
                ));
            }
        }
        Ok(())
    }

    /// The curve on the welded garment; copies of one vertex in a row are one.
    ///
    /// # Errors
    /// `InvalidArgument`: a vertex that the garment does not have, one place passed twice, or too few places.
    pub fn welded(&self, name: usize, weld: &Weld) -> Result<WeldedCurve> {
        let count = weld.to_welded.len();
        let (mut vertices, mut callers) = (Vec::new(), Vec::new());
        for &v in &self.vertices {
            let Some(&welded) = weld.to_welded.get(v as usize) else {
                return invalid(format!("curve {name}: lists vertex {v}, the garment has {count} vertices"));
            };
            if vertices.last() != Some(&welded) {
                vertices.push(welded);
                callers.push(v);
            }
        }
        if self.closed && vertices.len() > 1 && vertices.first() == vertices.last() {
            vertices.pop();
            callers.pop();
        }
        if vertices.len() < self.fewest() {
            return too_few(name, self, vertices.len());
        }
        let mut sorted: Vec<(u32, u32)> = vertices.iter().copied().zip(callers.iter().copied()).collect();
        sorted.sort_unstable();
        if let Some(pair) = sorted.windows(2).find(|pair| pair[0].0 == pair[1].0) {
            return invalid(format!(
                "curve {name}: vertices {} and {} share their place in the garment, and it passes there twice",
                pair[0].1, pair[1].1
            ));
        }
        Ok(WeldedCurve { curve: Self { vertices, ..self.clone() }, callers })
    }

    /// Whether another curve runs through the same vertices in the same order, either way around.
    pub fn coincides(&self, closed: bool, vertices: &[u32]) -> bool {
        let n = vertices.len();
        if closed != self.closed || n != self.vertices.len() {
            return false;
        }
        if !closed {
            return self.vertices.iter().eq(vertices) || self.vertices.iter().rev().eq(vertices);
        }
        let Some(first) = self.vertices.first().and_then(|v| vertices.iter().position(|w| w == v)) else {
            return n == 0;
        };
        let forwards = |k: usize| vertices[(first + k) % n];
        let backwards = |k: usize| vertices[(first + n - k) % n];
        (0..n).all(|k| self.vertices[k] == forwards(k)) || (0..n).all(|k| self.vertices[k] == backwards(k))
    }
}

impl WeldedCurve {
    /// Refuses a curve of which two vertices in a row are joined by none of `edges`, each with the lower index first and in
    /// ascending order.
    ///
    /// # Errors
    /// `InvalidArgument`.
    pub fn check_edges(&self, name: usize, edges: &[[u32; 2]]) -> Result<()> {
        let vertices = &self.curve.vertices;
        let steps = if self.curve.closed { vertices.len() } else { vertices.len() - 1 };
        for k in 0..steps {
            let next = (k + 1) % vertices.len();
            let [v, w] = [vertices[k], vertices[next]];
            if edges.binary_search(&[v.min(w), v.max(w)]).is_err() {
                return invalid(format!(
                    "curve {name}: no edge of the garment joins vertices {} and {}, which follow each other",
                    self.callers[k], self.callers[next]
                ));
            }
        }
        Ok(())
    }
}

fn too_few<T>(name: usize, curve: &Curve, count: usize) -> Result<T> {
    let kind = if curve.closed { "a closed one" } else { "an open one" };
    invalid(format!("curve {name}: has {count} places; {kind} has {} or more", curve.fewest()))
}

fn invalid<T>(message: String) -> Result<T> {
    Err(Error::new(ErrorKind::InvalidArgument, message))
}
