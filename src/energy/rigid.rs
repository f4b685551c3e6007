//! Rigid groups: buttons, buckles and armour plates keep their shape and their size.
//!
//! Three anchors (a, b, c) of a group, far apart, keep their rest distances, and every other vertex v is bound to their
//! frame:
//!
//! ```text
//! L = sum_v |r_v|^2 / s^2 + m sum_e (|e|^2 - l_e^2)^2 / (2 l_e^2)^2,
//! r_v = v - a - c1 e1 - c2 e2 - c3 N(e1 x e2),   e in {b - a, c - a, c - b},
//! ```
//!
//! with the coefficients that reproduce v at rest, `l_e` the rest length of e, s the longest of these, and m the number of
//! vertices in the group. L is zero for the rigid motions of the group alone. A group on a line has two anchors and
//! `r_v = v - a - c1 e1`. [`Rigid::placed`] removes the remaining deviation of a stiff term: it gives the rigid motion
//! nearest to a group's positions.

use std::ops::Range;

use glam::{DMat3, DVec3};

use super::triangle_frame::{BoundVertex, least_squares};
use super::{Configuration, Energy, Row, Sink};
use crate::geometry::turn;
use crate::memory::bytes;

/// A group whose third anchor is nearer than this share of its length to the line of the first two is collinear.
const MIN_WIDTH: f64 = 1e-3;

/// One summand of the energy of a group.
#[derive(Clone, Copy, Debug)]
enum Element {
    /// Two anchors, their squared distance at rest, and m.
    Distance { vertices: [u32; 2], square: f64, weight: f64 },
    /// A vertex in the frame of three anchors, with 1 / s^2.
    InFrame { bound: BoundVertex, weight: f64 },
    /// `[a, b, v]` on one line, the coordinate of v along it, with 1 / s^2.
    OnLine { vertices: [u32; 3], along: f64, weight: f64 },
}

/// Vertices that move as one rigid body, and their rest positions.
#[derive(Clone, Debug)]
struct Group {
    vertices: Vec<u32>,
    rest: Vec<DVec3>,
    /// Indices into these: one for a group at one point, two for a collinear group, else three.
    anchors: Vec<usize>,
}

/// Rigid group term; an element is a vertex or a pair of anchors.
#[derive(Clone, Debug, Default)]
pub struct Rigid {
    elements: Vec<Element>,
    groups: Vec<Group>,
}

impl Rigid {
    /// The term for a garment with vertices `rest`. `groups` are lists of its vertices, each vertex in one list at most.
    pub fn new(rest: &[DVec3], groups: &[Vec<u32>]) -> Self {
        let groups: Vec<Group> = groups.iter().filter(|g| !g.is_empty()).map(|g| Group::new(rest, g)).collect();
        let elements = groups.iter().flat_map(|group| group.elements(rest)).collect();
        Self { elements, groups }
    }

    /// For each group the rigid motion of its rest shape that is nearest to its positions in `x`: the position of each
    /// vertex.
    pub fn placed(&self, x: &[DVec3]) -> impl Iterator<Item = Vec<(u32, DVec3)>> {
        self.groups.iter().map(|group| {
            let now: Vec<DVec3> = group.vertices.iter().map(|&v| x[v as usize]).collect();
            let turn = group.frame(&now) * group.frame(&group.rest).transpose();
            let [from, to] = [&group.rest, &now].map(|p| p.iter().sum::<DVec3>() / p.len() as f64);
            group.vertices.iter().zip(&group.rest).map(|(&v, &p)| (v, to + turn * (p - from))).collect()
        })
    }
}

impl Group {
    fn new(all: &[DVec3], vertices: &[u32]) -> Self {
        let rest: Vec<DVec3> = vertices.iter().map(|&v| all[v as usize]).collect();
        let centre = rest.iter().sum::<DVec3>() / rest.len() as f64;
        let farthest = |distance: &dyn Fn(DVec3) -> f64| {
            // The first of equals, so that the order of the caller decides and not that of the search.
            (0..rest.len()).rev().max_by(|&i, &j| distance(rest[i]).total_cmp(&distance(rest[j]))).unwrap_or(0)
        };
        let a = farthest(&|p| p.distance(centre));
        let b = farthest(&|p| p.distance(rest[a]));
        let span = rest[b] - rest[a];
        let mut anchors = vec![a];
        if span.length_squared() > 0.0 {
            anchors.push(b);
            let away = |p: DVec3| (p - rest[a]).reject_from(span).length();
            let c = farthest(&away);
            if away(rest[c]) > MIN_WIDTH * span.length() {
                anchors.push(c);
            }
        }
        Self { vertices: vertices.to_vec(), rest, anchors }
    }

    fn elements(&self, rest: &[DVec3]) -> Vec<Element> {
        let anchors: Vec<u32> = self.anchors.iter().map(|&k| self.vertices[k]).collect();
        let square = |[v, w]: [u32; 2]| rest[v as usize].distance_squared(rest[w as usize]);
        let others = || self.vertices.iter().copied().filter(|v| !anchors.contains(v));
        let fixed_length = |vertices: [u32; 2]| Element::Distance {
            vertices,
            square: square(vertices),
            weight: self.vertices.len() as f64,
        };
        match anchors[..] {
            [a, b, c] => {
                let edges = [[a, b], [a, c], [b, c]];
                let weight = 1.0 / edges.map(square).into_iter().fold(0.0, f64::max);
                let bound = others().filter_map(|v| BoundVertex::new(rest, [a, b, c, v]));
                let framed = bound.map(|bound| Element::InFrame { bound, weight });
                edges.map(fixed_length).into_iter().chain(framed).collect()
            }
            [a, b] => {
                let span = rest[b as usize] - rest[a as usize];
                let along = |v: u32| (rest[v as usize] - rest[a as usize]).dot(span) / span.length_squared();
                let weight = 1.0 / span.length_squared();
                let lined = others().map(|v| Element::OnLine { vertices: [a, b, v], along: along(v), weight });
                [fixed_length([a, b])].into_iter().chain(lined).collect()
            }
            _ => Vec::new(),
        }
    }

    /// The orthonormal frame of the anchors where the group's vertices are `points`.
    fn frame(&self, points: &[DVec3]) -> DMat3 {
        let arm = |k: usize| points[self.anchors[k]] - points[self.anchors[0]];
        let Some(first) = (self.anchors.len() > 1).then(|| arm(1)).and_then(DVec3::try_normalize) else {
            return DMat3::IDENTITY;
        };
        match (self.anchors.len() > 2).then(|| arm(2).reject_from_normalized(first)).and_then(DVec3::try_normalize) {
            Some(second) => DMat3::from_cols(first, second, first.cross(second)),
            // About a line any rotation will do: the smallest from the rest direction.
            None => DMat3::from_quat(turn::arc(self.line(), first)),
        }
    }

    /// The rest direction of a collinear group.
    fn line(&self) -> DVec3 {
        (self.rest[self.anchors[1]] - self.rest[self.anchors[0]]).normalize_or(DVec3::X)
    }
}

impl Element {
    fn value(&self, x: &[DVec3]) -> f64 {
        match self {
            Self::Distance { vertices: [v, w], square, weight } => {
                let strain = (x[*v as usize].distance_squared(x[*w as usize]) - square) / (2.0 * square);
                weight * strain * strain
            }
            Self::InFrame { bound, weight } => weight * bound.at(x).residual().length_squared(),
            Self::OnLine { vertices, along, weight } => weight * on_line(x, *vertices, *along).length_squared(),
        }
    }

    fn derivatives(&self, x: &[DVec3], sink: &mut dyn Sink) {
        match self {
            Self::Distance { vertices: [v, w], square, weight } => {
                let edge = x[*v as usize] - x[*w as usize];
                let strain = (edge.length_squared() - square) / (2.0 * square);
                let slope = edge / *square;
                let components = [slope, -slope, DVec3::ZERO, DVec3::ZERO];
                let row = Row { components, t: 0.0, g: 2.0 * weight * strain, h: 2.0 * weight };
                sink.low_rank(&[*v, *w], &[row]);
            }
            Self::InFrame { bound, weight } => {
                let now = bound.at(x);
                least_squares(sink, &bound.vertices, &now.jacobian(), now.residual(), *weight);
            }
            Self::OnLine { vertices, along, weight } => {
                let residual = on_line(x, *vertices, *along);
                let row = |k: usize| {
                    let e = DVec3::AXES[k];
                    let components = [e * (along - 1.0), e * -along, e, DVec3::ZERO];
                    Row { components, t: 0.0, g: 2.0 * weight * residual[k], h: 2.0 * weight }
                };
                sink.low_rank(vertices, &[row(0), row(1), row(2)]);
            }
        }
    }
}

/// `v - a - along (b - a)`.
fn on_line(x: &[DVec3], vertices: [u32; 3], along: f64) -> DVec3 {
    let [a, b, v] = vertices.map(|i| x[i as usize]);
    v - a - along * (b - a)
}

impl Energy for Rigid {
    fn name(&self) -> &'static str {
        "rigid"
    }

    fn len(&self) -> usize {
        self.elements.len()
    }

    fn memory(&self) -> u64 {
        let groups = self.groups.iter().map(|g| bytes(&g.vertices) + bytes(&g.rest) + bytes(&g.anchors)).sum::<u64>();
        bytes(&self.elements) + bytes(&self.groups) + groups
    }

    fn value(&self, at: Configuration<'_>, range: Range<usize>) -> f64 {
        self.elements[range].iter().map(|element| element.value(at.x)).sum()
    }

    fn derivatives(&self, at: Configuration<'_>, range: Range<usize>, sink: &mut dyn Sink) {
        self.elements[range].iter().for_each(|element| element.derivatives(at.x, sink));
    }

    fn stencils(&self, visit: &mut dyn FnMut(&[u32])) {
        for element in &self.elements {
            match element {
                Element::Distance { vertices, .. } => visit(vertices),
                Element::InFrame { bound, .. } => visit(&bound.vertices),
                Element::OnLine { vertices, .. } => visit(vertices),
            }
        }
    }
}
