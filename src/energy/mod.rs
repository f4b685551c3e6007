//! The terms of the objective (section 3.4 of the paper), one file each, under one small trait.
//!
//! Every term is a sum over *elements* that touch at most four garment vertices and, perhaps, the inflation
//! parameter t. An element hands its derivatives to a [`Sink`] as rank-one updates
//! `gradient += g a`, `hessian += h a a^T` with `h >= 0`. A Hessian made of such updates is positive semidefinite by
//! construction, so that no eigenvalue has to be computed or clamped: Gauss-Newton's for the terms of squared residuals.

pub mod attachment;
pub mod barrier;
pub mod curve;
mod curve_window;
pub mod distortion;
pub mod fit;
pub mod inflation;
mod kept_samples;
pub mod pin;
pub mod position;
pub mod rigid;
pub mod surface;
mod triangle_frame;

use std::ops::Range;

use glam::DVec3;

pub use crate::contact::Configuration;

/// A direction in the space of the unknowns with at most eight garment vertices: `a = (a_i, a_t)`.
#[derive(Clone, Copy, Debug)]
pub struct Direction<'a> {
    /// The garment vertices that take part (each once).
    pub vertices: &'a [u32],
    /// The component of the direction at each of them.
    pub components: &'a [DVec3],
    /// The component along t.
    pub t: f64,
}

/// One of several rank-one updates over the same vertices, a row of the Jacobian of a residual: `gradient += g a`,
/// `hessian += h a a^T`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Row {
    /// The component of the direction a at each vertex; those beyond the vertices are ignored.
    pub components: [DVec3; 4],
    /// The component along t.
    pub t: f64,
    /// Derivative along a.
    pub g: f64,
    /// Second derivative along a, not negative.
    pub h: f64,
}

/// A visitor that accumulates low-rank updates of gradient and Hessian, element by element.
pub trait Sink {
    /// Adds `g a` to the gradient and `h a a^T` to the Hessian. `h` must not be negative.
    fn rank_one(&mut self, a: Direction<'_>, g: f64, h: f64);

    /// Adds several such updates over the same vertices (each once, at most four): faster than one by one.
    fn low_rank(&mut self, vertices: &[u32], rows: &[Row]) {
        for row in rows {
            let components = &row.components[..vertices.len()];
            self.rank_one(Direction { vertices, components, t: row.t }, row.g, row.h);
        }
    }
}

/// One term of the objective.
///
/// Values are unweighted by the term's overall weight (`w_surf`, `w_pos`, ...); the solver multiplies.
/// Elements are numbered `0..len()`, so that the solver can distribute them over threads in fixed ranges:
/// the result must not depend on how.
pub trait Energy: Sync {
    /// Name of the term in reports.
    fn name(&self) -> &'static str;

    /// Number of elements.
    fn len(&self) -> usize;

    /// True without any element.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Bytes of the arrays that it holds; 0 where it has none.
    fn memory(&self) -> u64 {
        0
    }

    /// The sum of the elements in `range`.
    fn value(&self, at: Configuration<'_>, range: Range<usize>) -> f64;

    /// Hands the derivatives of the elements in `range` to `sink`.
    fn derivatives(&self, at: Configuration<'_>, range: Range<usize>, sink: &mut dyn Sink);

    /// Calls `visit` with the garment vertices of every element that may have a Hessian: the sparsity
    /// pattern is the union of their cliques.
    fn stencils(&self, visit: &mut dyn FnMut(&[u32]));

    /// Calls `visit` with the garment vertices of elements beyond [`Self::stencils`] that have a Hessian now or may have one soon:
    /// where the pattern has to grow, it grows by all of these.
    fn passing_stencils(&self, _visit: &mut dyn FnMut(&[u32])) {}
}
