//! A loft: elliptic cross-sections along a straight axis, with rounded ends.

use glam::DVec3;

use super::random::Random;

/// A cross-section of a loft. Lengths in metres.
#[derive(Clone, Copy, Debug)]
pub struct Section {
    /// Place along the axis, from 0 to 1.
    pub t: f64,
    /// Centre, away from the axis along the two lateral directions.
    pub centre: [f64; 2],
    /// Half the width along the first lateral direction.
    pub width: f64,
    /// Half the depth against the second lateral direction.
    pub front: f64,
    /// Half the depth along the second lateral direction.
    pub back: f64,
}

impl Section {
    /// A circle on the axis.
    pub fn circle(t: f64, radius: f64) -> Self {
        Self::ellipse(t, radius, radius)
    }

    /// An ellipse on the axis.
    pub fn ellipse(t: f64, width: f64, depth: f64) -> Self {
        Self { t, centre: [0.0; 2], width, front: depth, back: depth }
    }

    /// The same section, moved sideways.
    pub fn moved(mut self, first: f64, second: f64) -> Self {
        self.centre = [first, second];
        self
    }

    fn channels(&self) -> [f64; 5] {
        [self.centre[0], self.centre[1], self.width, self.front, self.back]
    }
}

/// Puffs between stitched rings.
#[derive(Clone, Debug)]
struct Quilt {
    range: [f64; 2],
    heights: Vec<f64>,
}

impl Quilt {
    /// How far the cloth stands out at `t`, in metres: a flat arch over each puff, a rounded valley at each
    /// stitched ring.
    fn height(&self, t: f64) -> f64 {
        let x = (t - self.range[0]) / (self.range[1] - self.range[0]) * self.heights.len() as f64;
        if x <= 0.0 || x >= self.heights.len() as f64 {
            return 0.0;
        }
        let arch = (std::f64::consts::PI * x.fract()).sin().powi(2);
        self.heights[x as usize] * arch * (1.4 - 0.4 * arch)
    }
}

/// A solid that is swept along an axis.
#[derive(Clone, Debug)]
pub struct Loft {
    start: DVec3,
    axis: DVec3,
    lateral: [DVec3; 2],
    length: f64,
    parameters: Vec<f64>,
    values: Vec<[f64; 5]>,
    slopes: Vec<[f64; 5]>,
    quilt: Option<Quilt>,
    cap: f64,
}

impl Loft {
    /// Sweeps `sections` (at least two, `t` rising) from `start` to `end`. `back` gives the second lateral
    /// direction (made orthogonal to the axis); the first is `axis x second`, negated where that points to -x.
    pub fn new(start: DVec3, end: DVec3, back: DVec3, sections: &[Section]) -> Self {
        let axis = (end - start).normalize();
        let second = back.reject_from_normalized(axis).normalize();
        let first = axis.cross(second);
        let first = if first.x < 0.0 { -first } else { first };
        let parameters: Vec<f64> = sections.iter().map(|section| section.t).collect();
        let values: Vec<[f64; 5]> = sections.iter().map(Section::channels).collect();
        let slopes = monotone_slopes(&parameters, &values);
        let length = start.distance(end);
        Self { start, axis, lateral: [first, second], length, parameters, values, slopes, quilt: None, cap: 1.0 }
    }

    /// Adds `count` puffs of about `height` metres between `range` (of t), each a little different.
    pub fn quilted(mut self, range: [f64; 2], count: usize, height: f64, random: &mut Random) -> Self {
        let heights = (0..count).map(|_| height * (1.0 + 0.15 * random.signed())).collect();
        self.quilt = Some(Quilt { range, heights });
        self
    }

    /// How far the rounded ends reach out, as a multiple of the section's smaller half-axis (1 to begin with).
    pub fn capped(mut self, cap: f64) -> Self {
        self.cap = cap;
        self
    }

    /// A capsule around the solid: the two ends of its axis and its radius.
    pub fn bound(&self) -> ([DVec3; 2], f64) {
        let extra = self.quilt.as_ref().map_or(0.0, |quilt| quilt.heights.iter().copied().fold(0.0, f64::max));
        let side =
            self.values.iter().fold(0.0, |side: f64, v| side.max(v[2].max(v[3]).max(v[4]) + v[0].hypot(v[1]) + extra));
        ([self.start, self.start + self.length * self.axis], side * self.cap.max(1.0))
    }

    /// Coordinates of `point`: t along the axis (not clamped) and the two lateral lengths from the axis.
    pub fn local(&self, point: DVec3) -> [f64; 3] {
        let d = point - self.start;
        [d.dot(self.axis) / self.length, d.dot(self.lateral[0]), d.dot(self.lateral[1])]
    }

    /// A first-order estimate of the signed distance, negative inside.
    pub fn distance(&self, point: DVec3) -> f64 {
        let [t, first, second] = self.local(point);
        let inner = t.clamp(0.0, 1.0);
        let [c0, c1, width, front, back] = self.section(inner);
        let puff = self.quilt.as_ref().map_or(0.0, |quilt| quilt.height(inner));
        let (x, y) = (first - c0, second - c1);
        let (width, depth) = (width + puff, if y < 0.0 { front } else { back } + puff);
        let narrow = width.min(depth);
        let (u, v) = (x / width, y / depth);
        let k0 = (u * u + v * v).sqrt();
        let k1 = ((u / width).powi(2) + (v / depth).powi(2)).sqrt();
        let radial = if k1 < 1e-9 { -narrow } else { k0 * (k0 - 1.0) / k1 };
        if t == inner {
            return radial;
        }
        // Beyond an end: half an ellipsoid, as high as the narrow half-axis times the cap.
        let height = narrow * self.cap;
        let (u, v) = ((radial + narrow) / narrow, (t - inner).abs() * self.length / height);
        let k0 = (u * u + v * v).sqrt();
        let k1 = ((u / narrow).powi(2) + (v / height).powi(2)).sqrt();
        k0 * (k0 - 1.0) / k1
    }

    fn section(&self, t: f64) -> [f64; 5] {
        let last = self.parameters.len() - 2;
        let i = self.parameters[1..=last].iter().take_while(|&&p| p < t).count();
        let h = self.parameters[i + 1] - self.parameters[i];
        let s = ((t - self.parameters[i]) / h).clamp(0.0, 1.0);
        let (s2, s3) = (s * s, s * s * s);
        let (h00, h10, h01, h11) = (2.0 * s3 - 3.0 * s2 + 1.0, s3 - 2.0 * s2 + s, 3.0 * s2 - 2.0 * s3, s3 - s2);
        let mut out = [0.0; 5];
        for (k, out) in out.iter_mut().enumerate() {
            *out = h00 * self.values[i][k]
                + h01 * self.values[i + 1][k]
                + h * (h10 * self.slopes[i][k] + h11 * self.slopes[i + 1][k]);
        }
        out
    }
}

/// Slopes for cubic Hermite pieces that do not overshoot: the harmonic mean of both sides, zero at extrema.
fn monotone_slopes(parameters: &[f64], values: &[[f64; 5]]) -> Vec<[f64; 5]> {
    let n = parameters.len();
    let secant = |i: usize, k: usize| (values[i + 1][k] - values[i][k]) / (parameters[i + 1] - parameters[i]);
    let mut slopes = vec![[0.0; 5]; n];
    for (i, slopes) in slopes.iter_mut().enumerate() {
        for (k, slope) in slopes.iter_mut().enumerate() {
            *slope = if i == 0 {
                secant(0, k)
            } else if i == n - 1 {
                secant(n - 2, k)
            } else {
                let (a, b) = (secant(i - 1, k), secant(i, k));
                if a * b <= 0.0 { 0.0 } else { 2.0 * a * b / (a + b) }
            };
        }
    }
    slopes
}
