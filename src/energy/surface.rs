//! Surface shape, Eq. 2 of the paper: it penalises neighbouring triangles that deform differently.
//!
//! For a hinge `t1 = (v1, v2, v3)`, `t2 = (v2, v1, v4)` and `x = (v4 - v3) / |v4 - v3|` at rest,
//!
//! ```text
//! L = sum w |tau1 x - tau2 x|^2,   w = area(t1) + area(t2) at rest,
//! tau1 x = c1 e1 + c2 e2 + c3 N(e1 x e2),   e1 = v2 - v1,  e2 = v3 - v1,
//! tau2 x = d1 f1 + d2 f2 + d3 N(f1 x f2),   f1 = v1 - v2,  f2 = v4 - v2,
//! ```
//!
//! with the coefficients that reproduce x at rest. As printed, N(n) = n, which grows with the square of a
//! scale. N(n) = n / sqrt(|n|) grows like an edge, so that every similarity of the rest shape costs nothing.
//!
//! Across a hinge tau changes by an amount of order h, the distance of v3 and v4 along the surface, so that the sum as printed
//! falls with h^2 where a mesh is refined, and a fine garment is softer than a coarse one. With a length h0 given
//!
//! ```text
//! w = (area(t1) + area(t2)) f,   f = h0^2 / h^2,   1 <= f <= 2 h0^2 / (area(t1) + area(t2)),
//! ```
//!
//! which is the integral of |grad tau|^2 times h0^2 at any resolution, and as printed where h is h0. The upper bound is for
//! needles, the lower one for garments of so few triangles that they have no shape but that of their hinges.
//!
//! The residual has the scale of the garment: growing an imperfect fit by s multiplies its value by s^2.

use std::ops::Range;

use glam::{DMat3, DVec3};

pub use super::triangle_frame::SurfaceForm;
use super::triangle_frame::{Normal, coefficients, least_squares, outer, scaled_cross};
use super::{Configuration, Energy, Sink};
use crate::geometry::mesh::{Hinge, has_area};
use crate::memory::bytes;

/// The area of a hinge in squares of its length across, at most. It is 0.29 where the triangles are equilateral, and grows beyond
/// all bounds where they are needles along their edge.
const MAX_SHARE: f64 = 2.0;
/// What a large hinge weighs beside its area, at least.
const LEAST_FACTOR: f64 = 1.0;

/// One hinge: its vertices and the coefficients of the rest shape.
#[derive(Clone, Copy, Debug)]
struct Element {
    vertices: [u32; 4],
    /// Factor of the shared edge `e1`: `c1 + d1`, as `f1 = -e1`.
    shared: f64,
    /// Factors of `e2` and of the first normal.
    first: [f64; 2],
    /// Factors of `f2` and of the second normal.
    second: [f64; 2],
    weight: f64,
}

/// Surface shape term; an element is a hinge.
#[derive(Clone, Debug)]
pub struct Surface {
    elements: Vec<Element>,
    form: SurfaceForm,
}

/// The three edges of a hinge that its residual uses, and its two normals.
struct Shape {
    e1: DVec3,
    e2: DVec3,
    f2: DVec3,
    n1: Normal,
    n2: Normal,
}

impl Shape {
    #[inline]
    fn new(x: &[DVec3], v: [u32; 4], form: SurfaceForm) -> Self {
        let p = v.map(|i| x[i as usize]);
        let (e1, e2, f2) = (p[1] - p[0], p[2] - p[0], p[3] - p[1]);
        // f1 x f2 = -e1 x f2 = f2 x e1
        Self { e1, e2, f2, n1: Normal::new(e1.cross(e2), form), n2: Normal::new(f2.cross(e1), form) }
    }

    #[inline]
    fn residual(&self, k: &Element) -> DVec3 {
        self.e1 * k.shared + self.e2 * k.first[0] - self.f2 * k.second[0] + self.n1.value * k.first[1]
            - self.n2.value * k.second[1]
    }

    /// Derivatives of the residual by `v1`, `v2`, `v3`, `v4`.
    #[inline]
    fn jacobian(&self, k: &Element) -> [DMat3; 4] {
        let (n1, n2) = (&self.n1, &self.n2);
        let (c3, d3) = (k.first[1], k.second[1]);
        let by_e1 = scaled_cross(k.shared, self.e2 * (-c3 * n1.scale) - self.f2 * (d3 * n2.scale))
            - outer(n1.n * (c3 * n1.radial), self.e2.cross(n1.n))
            + outer(n2.n * (d3 * n2.radial), n2.n.cross(self.f2));
        let by_e2 =
            scaled_cross(k.first[0], self.e1 * (c3 * n1.scale)) - outer(n1.n * (c3 * n1.radial), n1.n.cross(self.e1));
        let by_f2 =
            scaled_cross(-k.second[0], self.e1 * (d3 * n2.scale)) + outer(n2.n * (d3 * n2.radial), self.e1.cross(n2.n));
        [-(by_e1 + by_e2), by_e1 - by_f2, by_e2, by_f2]
    }
}

impl Surface {
    /// The term as printed for a garment with vertices `rest` and `hinges` between its triangles.
    ///
    /// A hinge with a rest triangle without area, or with both opposite corners at one point, gets no element. So hinges
    /// must come from triangles without caps (see [`crate::geometry::sliver_caps`]), else no energy connects the
    /// surface there.
    pub fn new(rest: &[DVec3], hinges: &[Hinge], form: SurfaceForm) -> Self {
        Self { elements: hinges.iter().filter_map(|hinge| Element::new(rest, hinge, form)).collect(), form }
    }

    /// The term that is the same at every resolution of the garment: a hinge whose opposite corners are `length` apart along the
    /// surface at `rest` weighs its area, one of half the size as much as that.
    pub fn at_any_resolution(rest: &[DVec3], hinges: &[Hinge], form: SurfaceForm, length: f64) -> Self {
        let mut term = Self::new(rest, hinges, form);
        for element in &mut term.elements {
            let across = squared_length_across(element.vertices.map(|v| rest[v as usize]));
            let area = element.weight;
            element.weight = (length * length * (area / across).min(MAX_SHARE)).max(LEAST_FACTOR * area);
        }
        term
    }

    /// Weighs the hinges at the marked vertices by `factor` of what they did.
    pub fn soften(&mut self, marked: impl Fn(u32) -> bool, factor: f64) {
        let soft = self.elements.iter_mut().filter(|element| element.vertices.into_iter().any(&marked));
        soft.for_each(|element| element.weight *= factor);
    }
}

/// The squared distance of v3 and v4 once the hinge has been laid flat.
fn squared_length_across([p1, p2, p3, p4]: [DVec3; 4]) -> f64 {
    let edge = p2 - p1;
    let length = edge.length();
    let along = (p4 - p3).dot(edge) / length;
    let heights = ((p3 - p1).cross(edge).length() + (p4 - p1).cross(edge).length()) / length;
    along * along + heights * heights
}

impl Element {
    fn new(rest: &[DVec3], hinge: &Hinge, form: SurfaceForm) -> Option<Self> {
        let v = hinge.vertices;
        let shape = Shape::new(rest, v, form);
        let across = rest[v[3] as usize] - rest[v[2] as usize];
        let f1 = -shape.e1;
        let [p1, p2, p3, p4] = v.map(|i| rest[i as usize]);
        if !(has_area([p1, p2, p3]) && has_area([p2, p1, p4]) && across.length_squared() > 0.0) {
            return None;
        }
        let areas = [shape.n1.n, shape.n2.n].map(DVec3::length);
        let x = across.normalize_or_zero();
        let [c1, c2, c3] = coefficients(x, shape.e1, shape.e2, &shape.n1)?;
        let [d1, d2, d3] = coefficients(x, f1, shape.f2, &shape.n2)?;
        Some(Self {
            vertices: v,
            shared: c1 + d1,
            first: [c2, c3],
            second: [d2, d3],
            weight: 0.5 * (areas[0] + areas[1]),
        })
    }
}

/// `|tau1 x - tau2 x|^2` of one hinge, without its weight, in the similarity form; none for a degenerate hinge.
pub(super) fn l_surf(rest: &[DVec3], x: &[DVec3], hinge: &Hinge) -> Option<f64> {
    let form = SurfaceForm::Similarity;
    let element = Element::new(rest, hinge, form)?;
    Some(Shape::new(x, element.vertices, form).residual(&element).length_squared())
}

impl Energy for Surface {
    fn name(&self) -> &'static str {
        "surface"
    }

    fn len(&self) -> usize {
        self.elements.len()
    }

    fn memory(&self) -> u64 {
        bytes(&self.elements)
    }

    fn value(&self, at: Configuration<'_>, range: Range<usize>) -> f64 {
        let cost = |k: &Element| k.weight * Shape::new(at.x, k.vertices, self.form).residual(k).length_squared();
        self.elements[range].iter().map(cost).sum()
    }

    fn derivatives(&self, at: Configuration<'_>, range: Range<usize>, sink: &mut dyn Sink) {
        for k in &self.elements[range] {
            let shape = Shape::new(at.x, k.vertices, self.form);
            least_squares(sink, &k.vertices, &shape.jacobian(k), shape.residual(k), k.weight);
        }
    }

    fn stencils(&self, visit: &mut dyn FnMut(&[u32])) {
        self.elements.iter().for_each(|k| visit(&k.vertices));
    }
}
