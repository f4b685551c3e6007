//! The fit term, Eq. 4 of the paper: `L_fit = integral over G_fit of r(D(p))^2 dp`.
//!
//! D is the signed distance to the target avatar. What is farther away than the largest target clearance, or nearer than the
//! smallest, costs:
//!
//! ```text
//! r(D) = D - most where D > most,   D - least where D < least,   else 0.
//! ```
//!
//! A tight fit as in the paper has most = 0 and no least: the barrier keeps the garment off the avatar. The
//! integral is a sum over faces f and quadrature points q, with weights omega that sum to 1 and the caller's density w:
//!
//! ```text
//! sum_f area_f sum_q omega_q w_q r(D(x_q))^2,    x_q = sum_i b_qi x_i
//! ```
//!
//! The Hessian is Gauss-Newton's, `2 grad D grad D^T`: positive semidefinite.
//!
//! Samples that a value was computed from are kept with their gradients, for the derivatives at the same place.

use std::ops::Range;
use std::sync::Arc;

use glam::DVec3;

use super::kept_samples::{FieldSample, KeptSamples};
use super::{Configuration, Energy, Row, Sink};
use crate::error::{Error, ErrorKind, Result};
use crate::memory::bytes;
use crate::sdf::Field;

/// A quadrature node: barycentric coordinates and weight.
type Node = ([f64; 3], f64);

/// Exact for polynomials of degree 2: three points (Strang and Fix 1973).
const DEGREE_2: [Node; 3] = {
    const A: f64 = 1.0 / 6.0;
    const B: f64 = 2.0 / 3.0;
    const W: f64 = 1.0 / 3.0;
    [([B, A, A], W), ([A, B, A], W), ([A, A, B], W)]
};

/// Exact for polynomials of degree 4: six points (Dunavant 1985, table of degree 4).
const DEGREE_4: [Node; 6] = {
    const A: f64 = 0.445_948_490_915_964_9;
    const B: f64 = 1.0 - 2.0 * A;
    const V: f64 = 0.223_381_589_678_011_47;
    const C: f64 = 0.091_576_213_509_770_74;
    const D: f64 = 1.0 - 2.0 * C;
    const W: f64 = 0.109_951_743_655_321_87;
    [([B, A, A], V), ([A, B, A], V), ([A, A, B], V), ([D, C, C], W), ([C, D, C], W), ([C, C, D], W)]
};

/// A garment face with a fit weight.
#[derive(Clone, Copy, Debug)]
struct Element {
    vertices: [u32; 3],
    /// Its first sample.
    first: u32,
    rule: &'static [Node],
}

/// A quadrature point: its precomputed weight and clearance.
#[derive(Clone, Copy, Debug)]
struct Sample {
    /// `area_f omega_q w_q`.
    weight: f64,
    clearance: Clearance,
}

/// The distances from the avatar that cost nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clearance {
    /// Farther than this is too loose.
    pub most: f64,
    /// Nearer than this is too tight; minus infinity where nothing is too tight.
    pub least: f64,
}

impl Clearance {
    /// Eq. 4 as printed: nothing is too tight.
    pub const NONE: Self = Self { most: 0.0, least: f64::NEG_INFINITY };

    /// r.
    #[inline]
    fn residual(&self, distance: f64) -> f64 {
        if distance > self.most {
            distance - self.most
        } else if distance < self.least {
            distance - self.least
        } else {
            0.0
        }
    }
}

/// The fit term over the faces of a garment.
#[derive(Debug)]
pub struct Fit {
    field: Arc<Field>,
    elements: Vec<Element>,
    samples: Vec<Sample>,
    kept: KeptSamples,
}

impl Fit {
    /// The term for the garment's `triangles` with the given `areas` (one a triangle, rest or current) and
    /// `weights` (one a vertex, at least 0, interpolated linearly). A face with three zero weights is left
    /// out. All clearances are [`Clearance::NONE`].
    ///
    /// Six samples a face; three where its area is below four square voxels, so that samples are about a voxel apart
    /// and the field has hardly any detail between them.
    pub fn new(field: Arc<Field>, triangles: &[[u32; 3]], areas: &[f64], weights: &[f64]) -> Self {
        let small = 4.0 * field.voxel() * field.voxel();
        let mut elements = Vec::new();
        let mut samples = Vec::new();
        for (&vertices, &area) in triangles.iter().zip(areas) {
            let corners = vertices.map(|v| weights[v as usize]);
            if corners == [0.0; 3] {
                continue;
            }
            let rule: &'static [Node] = if area < small { &DEGREE_2 } else { &DEGREE_4 };
            elements.push(Element { vertices, first: samples.len() as u32, rule });
            samples.extend(rule.iter().map(|&(b, omega)| {
                let density = b[0] * corners[0] + b[1] * corners[1] + b[2] * corners[2];
                Sample { weight: area * omega * density, clearance: Clearance::NONE }
            }));
        }
        let kept = KeptSamples::new(elements.iter().map(|element| element.rule.len()));
        Self { field, elements, samples, kept }
    }

    /// Positions of the samples for the garment vertices `x`: to measure, on the source body, the designed clearance of
    /// each.
    pub fn sample_points(&self, x: &[DVec3]) -> Vec<DVec3> {
        self.elements.iter().flat_map(|e| e.rule.iter().map(|(b, _)| interpolate(e.corners(x), b))).collect()
    }

    /// Sets the target clearance of each sample, in the order of [`Self::sample_points`]: `most` a number from 0 on, `least`
    /// not above it.
    ///
    /// # Errors
    /// `InvalidArgument`.
    pub fn set_clearances(&mut self, wanted: &[Clearance]) -> Result<()> {
        if wanted.len() != self.samples.len() {
            return Err(Error::new(
                ErrorKind::InvalidArgument,
                format!("fit: {} clearances for {} samples", wanted.len(), self.samples.len()),
            ));
        }
        let is_good = |c: &Clearance| c.most >= 0.0 && c.most.is_finite() && c.least <= c.most;
        if let Some(i) = wanted.iter().position(|c| !is_good(c)) {
            let Clearance { most, least } = wanted[i];
            return Err(Error::new(
                ErrorKind::InvalidArgument,
                format!("fit: clearance {i} is from {least} to {most}, which is no range that ends at 0 or above"),
            ));
        }
        for (sample, &clearance) in self.samples.iter_mut().zip(wanted) {
            sample.clearance = clearance;
        }
        Ok(())
    }

    fn samples_of(&self, element: &Element) -> &[Sample] {
        &self.samples[element.own()]
    }

    /// Distances and gradients at the samples of an element, whose corners are `corners`.
    #[inline]
    fn sample(&self, element: &Element, corners: [DVec3; 3], out: &mut [FieldSample]) {
        let mut points = [DVec3::ZERO; MAX_SAMPLES];
        for (point, (b, _)) in points.iter_mut().zip(element.rule) {
            *point = interpolate(corners, b);
        }
        self.field.values_gradients(&points[..element.rule.len()], &mut out[..element.rule.len()]);
    }
}

/// Samples of a face, at most.
const MAX_SAMPLES: usize = DEGREE_4.len();

impl Element {
    /// Its samples among those of all elements.
    #[inline]
    fn own(&self) -> Range<usize> {
        self.first as usize..self.first as usize + self.rule.len()
    }

    #[inline]
    fn corners(&self, x: &[DVec3]) -> [DVec3; 3] {
        self.vertices.map(|v| x[v as usize])
    }
}

#[inline]
fn interpolate(corners: [DVec3; 3], b: &[f64; 3]) -> DVec3 {
    b[0] * corners[0] + b[1] * corners[1] + b[2] * corners[2]
}

impl Energy for Fit {
    fn name(&self) -> &'static str {
        "fit"
    }

    fn len(&self) -> usize {
        self.elements.len()
    }

    fn memory(&self) -> u64 {
        bytes(&self.elements) + bytes(&self.samples) + self.kept.memory()
    }

    fn value(&self, at: Configuration<'_>, range: Range<usize>) -> f64 {
        let mut total = 0.0;
        for (block, part, first) in KeptSamples::parts(range) {
            let mut kept = self.kept.write(block);
            for (k, element) in self.elements[part.clone()].iter().enumerate() {
                let corners = element.corners(at.x);
                let mut own = [(0.0, DVec3::ZERO); MAX_SAMPLES];
                let found = match &mut kept {
                    Some(kept) => kept.replace(part.start - first + k, corners, element.own()),
                    None => &mut own[..element.rule.len()],
                };
                self.sample(element, corners, found);
                let one = |(sample, (distance, _)): (&Sample, &FieldSample)| {
                    let residual = sample.clearance.residual(*distance);
                    sample.weight * residual * residual
                };
                total += self.samples_of(element).iter().zip(&*found).map(one).sum::<f64>();
            }
        }
        total
    }

    fn derivatives(&self, at: Configuration<'_>, range: Range<usize>, sink: &mut dyn Sink) {
        for (block, part, first) in KeptSamples::parts(range) {
            let kept = self.kept.read(block);
            for (k, element) in self.elements[part.clone()].iter().enumerate() {
                let corners = element.corners(at.x);
                let mut own = [(0.0, DVec3::ZERO); MAX_SAMPLES];
                let found = kept.as_ref().and_then(|kept| kept.get(part.start - first + k, corners, element.own()));
                let found = match found {
                    Some(found) => found,
                    None => {
                        self.sample(element, corners, &mut own);
                        &own
                    }
                };
                let mut rows = [Row::default(); MAX_SAMPLES];
                let mut count = 0;
                for (((b, _), sample), &(distance, slope)) in
                    element.rule.iter().zip(self.samples_of(element)).zip(found)
                {
                    let residual = sample.clearance.residual(distance);
                    if residual != 0.0 {
                        let components = [b[0] * slope, b[1] * slope, b[2] * slope, DVec3::ZERO];
                        let h = 2.0 * sample.weight;
                        rows[count] = Row { components, t: 0.0, g: h * residual, h };
                        count += 1;
                    }
                }
                if count > 0 {
                    sink.low_rank(&element.vertices, &rows[..count]);
                }
            }
        }
    }

    fn stencils(&self, visit: &mut dyn FnMut(&[u32])) {
        for element in &self.elements {
            visit(&element.vertices);
        }
    }
}
