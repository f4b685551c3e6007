//! Position along the skeleton, Eq. 3 of the paper: cuffs and hems keep their coordinate along their bones.
//!
//! ```text
//! L = sum l_v (w(x_v, t) - w_v)^2,   w(x, t) = (x - A) . (B - A) / |B - A|^2
//! ```
//!
//! A and B are the ends of the vertex's [`MovingAxis`] at t, `w_v` is the coordinate of the rest vertex on the axis
//! at t = 0, and `l_v` the mean rest length of the edges at v. The axis moves with t, so w depends on t too.

use std::ops::Range;

use glam::DVec3;

use super::{Configuration, Direction, Energy, Sink};
use crate::memory::bytes;

/// An axis between two points that move with the inflation parameter t.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MovingAxis {
    /// Both ends at t = 0, from the source skeleton.
    pub start: [DVec3; 2],
    /// Both ends at t = 1, from the target skeleton.
    pub end: [DVec3; 2],
}

/// An axis whose squared length falls below this has no direction and is ignored.
const MIN_SQUARED_LENGTH: f64 = 1e-24;

#[derive(Clone, Copy, Debug)]
struct Constraint {
    vertex: u32,
    /// Index of its axis.
    axis: u32,
    coordinate: f64,
    weight: f64,
}

/// A [`MovingAxis`] at one t: its first end, the vector to the other, and how fast both move with t.
#[derive(Clone, Copy)]
struct Axis {
    origin: DVec3,
    span: DVec3,
    squared: f64,
    origin_rate: DVec3,
    span_rate: DVec3,
}

impl Axis {
    #[inline]
    fn new(moving: &MovingAxis, t: f64) -> Option<Self> {
        let [a, b] = [0, 1].map(|k| moving.start[k].lerp(moving.end[k], t));
        let [a_rate, b_rate] = [0, 1].map(|k| moving.end[k] - moving.start[k]);
        let span = b - a;
        let squared = span.length_squared();
        (squared > MIN_SQUARED_LENGTH).then_some(Self {
            origin: a,
            span,
            squared,
            origin_rate: a_rate,
            span_rate: b_rate - a_rate,
        })
    }

    #[inline]
    fn coordinate(&self, x: DVec3) -> f64 {
        (x - self.origin).dot(self.span) / self.squared
    }

    /// The derivative by t of the coordinate `w` of `x`: the quotient rule.
    #[inline]
    fn rate(&self, x: DVec3, w: f64) -> f64 {
        let dividend_rate = (x - self.origin).dot(self.span_rate) - self.origin_rate.dot(self.span);
        (dividend_rate - 2.0 * w * self.span.dot(self.span_rate)) / self.squared
    }
}

/// Position term; an element is a vertex on its axis.
#[derive(Clone, Debug)]
pub struct Position {
    constraints: Vec<Constraint>,
    axes: Vec<MovingAxis>,
}

impl Position {
    /// The term for a garment with vertices `rest`.
    ///
    /// `constraints` are pairs of a vertex and an index into `axes`; `weights` holds one value for each
    /// vertex of the garment, the mean rest length of its edges. An axis without length at t = 0 constrains nothing.
    pub fn new(rest: &[DVec3], constraints: &[(u32, u32)], axes: Vec<MovingAxis>, weights: &[f64]) -> Self {
        let constraints: Vec<(u32, u32, f64)> = constraints.iter().map(|&(v, axis)| (v, axis, 1.0)).collect();
        Self::weighted(rest, &constraints, axes, weights)
    }

    /// The same with a factor on the weight of each constraint.
    pub fn weighted(rest: &[DVec3], constraints: &[(u32, u32, f64)], axes: Vec<MovingAxis>, weights: &[f64]) -> Self {
        let constraints = constraints
            .iter()
            .filter_map(|&(vertex, index, factor)| {
                let axis = Axis::new(&axes[index as usize], 0.0)?;
                let coordinate = axis.coordinate(rest[vertex as usize]);
                Some(Constraint { vertex, axis: index, coordinate, weight: factor * weights[vertex as usize] })
            })
            .collect();
        Self { constraints, axes }
    }

    #[inline]
    fn axis(&self, k: &Constraint, t: f64) -> Option<Axis> {
        Axis::new(&self.axes[k.axis as usize], t)
    }
}

impl Energy for Position {
    fn name(&self) -> &'static str {
        "position"
    }

    fn len(&self) -> usize {
        self.constraints.len()
    }

    fn memory(&self) -> u64 {
        bytes(&self.constraints) + bytes(&self.axes)
    }

    fn value(&self, at: Configuration<'_>, range: Range<usize>) -> f64 {
        let cost = |k: &Constraint| {
            self.axis(k, at.t).map_or(0.0, |axis| {
                let residual = axis.coordinate(at.x[k.vertex as usize]) - k.coordinate;
                k.weight * residual * residual
            })
        };
        self.constraints[range].iter().map(cost).sum()
    }

    fn derivatives(&self, at: Configuration<'_>, range: Range<usize>, sink: &mut dyn Sink) {
        for k in &self.constraints[range] {
            let Some(axis) = self.axis(k, at.t) else { continue };
            let x = at.x[k.vertex as usize];
            let w = axis.coordinate(x);
            let components = [axis.span / axis.squared];
            let direction = Direction { vertices: &[k.vertex], components: &components, t: axis.rate(x, w) };
            sink.rank_one(direction, 2.0 * k.weight * (w - k.coordinate), 2.0 * k.weight);
        }
    }

    fn stencils(&self, visit: &mut dyn FnMut(&[u32])) {
        self.constraints.iter().for_each(|k| visit(&[k.vertex]));
    }
}
