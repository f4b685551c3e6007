//! The two bodies in contact, and where their vertices are: garment vertices are free, avatar vertices are
//! linear in the inflation parameter t.

use glam::DVec3;

use super::surface::Surface;
use crate::memory::bytes;

/// Where the objective is evaluated: the garment's vertices and the inflation parameter.
#[derive(Clone, Copy, Debug)]
pub struct Configuration<'a> {
    /// Garment vertices in the normalised space.
    pub x: &'a [DVec3],
    /// Inflation parameter: 0 is the avatar shrunk onto the source skeleton, 1 the target avatar.
    pub t: f64,
}

/// A straight motion away from a [`Configuration`].
#[derive(Clone, Copy, Debug)]
pub struct Step<'a> {
    /// Displacement of each garment vertex.
    pub dx: &'a [DVec3],
    /// Change of the inflation parameter.
    pub dt: f64,
}

/// The surface that moves freely.
#[derive(Clone, Debug)]
pub struct Garment {
    /// Its connectivity.
    pub surface: Surface,
    /// The source garment: the vertices before anything moved, one for each vertex of the surface.
    pub rest: Vec<DVec3>,
}

/// The surface that follows t.
#[derive(Clone, Debug)]
pub struct Avatar {
    /// Its connectivity.
    pub surface: Surface,
    /// Position of each vertex at t = 0.
    pub start: Vec<DVec3>,
    /// Displacement of each vertex from t = 0 to t = 1.
    pub motion: Vec<DVec3>,
}

impl Avatar {
    /// Position of vertex `i` at `t`.
    #[inline]
    pub fn position(&self, i: usize, t: f64) -> DVec3 {
        self.start[i] + t * self.motion[i]
    }
}

/// Garment and avatar with one numbering of vertices: the garment's `0..n`, then the avatar's.
#[derive(Clone, Debug)]
pub struct Bodies {
    /// The free surface.
    pub garment: Garment,
    /// The surface driven by t.
    pub avatar: Avatar,
}

impl Bodies {
    /// Number of garment vertices: the first avatar vertex in the combined numbering.
    #[inline]
    pub fn garment_count(&self) -> usize {
        self.garment.surface.vertex_count
    }

    /// Bytes that they hold.
    pub fn memory(&self) -> u64 {
        let Self { garment, avatar } = self;
        let points = [&garment.rest, &avatar.start, &avatar.motion].into_iter().map(bytes).sum::<u64>();
        points + garment.surface.memory() + avatar.surface.memory()
    }

    /// Position of vertex `i`.
    #[inline]
    pub fn position(&self, i: u32, at: Configuration<'_>) -> DVec3 {
        let (i, n) = (i as usize, self.garment_count());
        if i < n { at.x[i] } else { self.avatar.position(i - n, at.t) }
    }

    /// Rest position of vertex `i`: on the source garment, or on the fully inflated avatar.
    #[inline]
    pub fn rest(&self, i: u32) -> DVec3 {
        let (i, n) = (i as usize, self.garment_count());
        if i < n { self.garment.rest[i] } else { self.avatar.position(i - n, 1.0) }
    }

    /// Positions of the four vertices of a pair.
    #[inline]
    pub fn positions(&self, pair: [u32; 4], at: Configuration<'_>) -> [DVec3; 4] {
        let [a, b, c, d] = pair;
        [self.position(a, at), self.position(b, at), self.position(c, at), self.position(d, at)]
    }
}

/// The motion of all vertices of both bodies along a step, in the combined numbering of [`Bodies`].
#[derive(Clone, Debug, Default)]
pub struct Motion {
    start: Vec<DVec3>,
    displacement: Vec<DVec3>,
    t: f64,
    dt: f64,
}

impl Motion {
    /// The motion along `step` from `at`; nothing moves without one.
    pub fn new(bodies: &Bodies, at: Configuration<'_>, step: Option<&Step<'_>>) -> Self {
        let mut motion = Self::default();
        motion.set(bodies, at, step);
        motion
    }

    /// As [`Self::new`], reusing the memory.
    pub fn set(&mut self, bodies: &Bodies, at: Configuration<'_>, step: Option<&Step<'_>>) {
        let (count, avatar) = (bodies.garment_count(), &bodies.avatar);
        self.t = at.t;
        self.start.clear();
        self.start.extend_from_slice(&at.x[..count]);
        self.start.extend((0..avatar.start.len()).map(|i| avatar.position(i, at.t)));
        self.dt = step.map_or(0.0, |s| s.dt);
        self.displacement.clear();
        match step {
            Some(step) => self.displacement.extend_from_slice(&step.dx[..count]),
            None => self.displacement.resize(count, DVec3::ZERO),
        }
        let dt = self.dt;
        self.displacement.extend(avatar.motion.iter().map(|&m| dt * m));
    }

    /// Bytes that it holds.
    pub fn memory(&self) -> u64 {
        bytes(&self.start) + bytes(&self.displacement)
    }

    /// The inflation parameter at the beginning, and its change over the whole step.
    #[inline]
    pub fn inflation(&self) -> [f64; 2] {
        [self.t, self.dt]
    }

    /// Position of vertex `i` after this fraction of the step.
    #[inline]
    pub fn position(&self, i: u32, part: f64) -> DVec3 {
        self.start[i as usize] + part * self.displacement[i as usize]
    }

    /// Positions of the vertices of a pair at the beginning.
    #[inline]
    pub fn positions(&self, pair: [u32; 4]) -> [DVec3; 4] {
        let [a, b, c, d] = pair;
        let of = |i: u32| self.start[i as usize];
        [of(a), of(b), of(c), of(d)]
    }

    /// Displacements of the vertices of a pair in the whole of the step.
    #[inline]
    pub fn displacements(&self, pair: [u32; 4]) -> [DVec3; 4] {
        let [a, b, c, d] = pair;
        let of = |i: u32| self.displacement[i as usize];
        [of(a), of(b), of(c), of(d)]
    }
}
