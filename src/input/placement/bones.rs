//! Distances of many points from the bones of a skeleton.
//!
//! Units and axes are found by trying hundreds of readings of a mesh, each of which asks for the distance of each of some hundred
//! points. So bones are kept four at a time, in the order in which a processor takes them, with all that is the same for
//! each point.

use glam::DVec3;

/// Bones that are looked at together.
const LANES: usize = 4;

/// Four bones, a coordinate of all of them after another.
#[derive(Clone, Copy, Debug)]
struct Lanes {
    start: [[f64; LANES]; 3],
    edge: [[f64; LANES]; 3],
    /// One over the squared length, 0 for a bone without length.
    inverse: [f64; LANES],
}

impl Lanes {
    /// Fewer than four are filled up with the first.
    fn new(bones: &[[DVec3; 2]]) -> Self {
        let at = |k: usize| bones.get(k).unwrap_or(&bones[0]);
        let edge = |k: usize| at(k)[1] - at(k)[0];
        let square = |k: usize| edge(k).length_squared();
        Self {
            start: std::array::from_fn(|axis| std::array::from_fn(|k| at(k)[0][axis])),
            edge: std::array::from_fn(|axis| std::array::from_fn(|k| edge(k)[axis])),
            inverse: std::array::from_fn(|k| if square(k) > 0.0 { square(k).recip() } else { 0.0 }),
        }
    }

    /// Makes each of `least` the squared distance of `p` from its bone where that is less.
    #[inline(always)]
    fn lower(&self, p: DVec3, least: &mut [f64; LANES]) {
        let ([x, y, z], [ex, ey, ez]) = (self.start, self.edge);
        for k in 0..LANES {
            let (x, y, z) = (p.x - x[k], p.y - y[k], p.z - z[k]);
            let t = ((x * ex[k] + y * ey[k] + z * ez[k]) * self.inverse[k]).clamp(0.0, 1.0);
            let (x, y, z) = (x - t * ex[k], y - t * ey[k], z - t * ez[k]);
            let square = x * x + y * y + z * z;
            least[k] = if square < least[k] { square } else { least[k] };
        }
    }
}

/// The bones of a skeleton, or some of many, and those at each joint.
#[derive(Clone, Debug)]
pub struct Bones {
    segments: Vec<[DVec3; 2]>,
    all: Vec<Lanes>,
    /// Empty where nobody asks by joint.
    at_joint: Vec<Vec<Lanes>>,
}

impl Bones {
    /// Of each of `bones` its ends and its joints. By joint they are only kept for `by_joint`.
    pub fn new(bones: &[([DVec3; 2], [u32; 2])], by_joint: bool) -> Self {
        let lanes = |segments: &[[DVec3; 2]]| segments.chunks(LANES).map(Lanes::new).collect::<Vec<_>>();
        let segments: Vec<[DVec3; 2]> = bones.iter().map(|&(ends, _)| ends).collect();
        let mut own: Vec<Vec<[DVec3; 2]>> = Vec::new();
        for &(ends, joints) in bones.iter().filter(|_| by_joint) {
            for joint in joints.map(|j| j as usize) {
                own.resize_with(own.len().max(joint + 1), Vec::new);
                own[joint].push(ends);
            }
        }
        Self { all: lanes(&segments), at_joint: own.iter().map(|own| lanes(own)).collect(), segments }
    }

    /// Their ends.
    pub fn segments(&self) -> &[[DVec3; 2]] {
        &self.segments
    }

    /// The distance of a place from them, or from those at a joint; infinite where there are none.
    pub fn distance(&self, p: DVec3, joint: Option<u32>) -> f64 {
        let own = joint.map(|j| self.at_joint.get(j as usize).map_or(&[][..], Vec::as_slice));
        let mut least = [f64::INFINITY; LANES];
        own.unwrap_or(&self.all).iter().for_each(|lanes| lanes.lower(p, &mut least));
        least.into_iter().fold(f64::INFINITY, f64::min).sqrt()
    }
}
