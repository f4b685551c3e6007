//! Small closed meshes in rings: horns, claws, locks of hair, lips, eyelids, eyeballs.

use std::f64::consts::PI;

use glam::DVec3;

use super::super::mesh::Mesh;

/// A cross-section of a sweep.
#[derive(Clone, Copy, Debug)]
pub struct Ring {
    /// Its centre, in metres.
    pub centre: DVec3,
    /// Half the width, across the sweep's `up`.
    pub width: f64,
    /// Half the height, along the sweep's `up`.
    pub height: f64,
}

/// Makes a ring.
pub fn ring(centre: DVec3, width: f64, height: f64) -> Ring {
    Ring { centre, width, height }
}

/// A solid along a smooth curve through the centres of `rings` (at least two), in `along` rings of `around` vertices
/// and a tip at each end; `up`, which the curve never follows, orients the cross-sections.
pub fn sweep(rings: &[Ring], up: DVec3, around: usize, along: usize) -> Mesh {
    let mut mesh = Mesh::default();
    let last = rings.len() - 1;
    let centre = |t: f64| spline(t, last, |i| rings[i].centre);
    mesh.positions.push(rings[0].centre);
    for k in 0..along {
        let t = (k as f64 + 0.5) / along as f64 * last as f64;
        let i = (t as usize).min(last - 1);
        let between = |a: f64, b: f64| a + (b - a) * (t - i as f64);
        let (width, height) =
            (between(rings[i].width, rings[i + 1].width), between(rings[i].height, rings[i + 1].height));
        let tangent = (centre(t + 1e-4) - centre(t - 1e-4)).normalize();
        let second = up.reject_from_normalized(tangent).normalize();
        let first = second.cross(tangent);
        let middle = centre(t);
        for n in 0..around {
            let (sin, cos) = (2.0 * PI * n as f64 / around as f64).sin_cos();
            mesh.positions.push(middle + width * cos * first + height * sin * second);
        }
    }
    mesh.positions.push(rings[last].centre);
    join(&mut mesh, around, along);
    mesh
}

/// An ellipsoid with poles at both ends of its y axis; `axes` are its half-axes.
pub fn ellipsoid(centre: DVec3, axes: [DVec3; 3], around: usize, along: usize) -> Mesh {
    let mut mesh = Mesh::default();
    mesh.positions.push(centre - axes[1]);
    for k in 1..=along {
        let (sin, cos) = (PI * k as f64 / (along + 1) as f64).sin_cos();
        for n in 0..around {
            let (s, c) = (2.0 * PI * n as f64 / around as f64).sin_cos();
            // Seen along y, x turns to the right of z: the same sense as in a sweep along y.
            mesh.positions.push(centre - cos * axes[1] + sin * (c * axes[0] - s * axes[2]));
        }
    }
    mesh.positions.push(centre + axes[1]);
    join(&mut mesh, around, along);
    mesh
}

/// Joins a tip, rings that turn left around the way from it, and another tip.
fn join(mesh: &mut Mesh, around: usize, along: usize) {
    let vertex = |k: usize, n: usize| (1 + k * around + n % around) as u32;
    let end = (1 + along * around) as u32;
    for n in 0..around {
        mesh.triangles.push([0, vertex(0, n + 1), vertex(0, n)]);
        for k in 1..along {
            let [a, b] = [vertex(k - 1, n), vertex(k - 1, n + 1)];
            let [c, d] = [vertex(k, n), vertex(k, n + 1)];
            mesh.triangles.extend([[a, b, d], [a, d, c]]);
        }
        mesh.triangles.push([end, vertex(along - 1, n), vertex(along - 1, n + 1)]);
    }
}

/// A smooth curve through `points(0)` to `points(last)`, at `t` of the same scale; straight on beyond both ends.
pub fn spline(t: f64, last: usize, points: impl Fn(usize) -> DVec3) -> DVec3 {
    let i = (t.max(0.0) as usize).min(last - 1);
    let slope = |j: usize| match j {
        0 => points(1) - points(0),
        j if j == last => points(last) - points(last - 1),
        j => 0.5 * (points(j + 1) - points(j - 1)),
    };
    let s = t - i as f64;
    if s < 0.0 {
        return points(0) + s * slope(0);
    }
    if s > 1.0 {
        return points(last) + (s - 1.0) * slope(last);
    }
    let (s2, s3) = (s * s, s * s * s);
    points(i) * (2.0 * s3 - 3.0 * s2 + 1.0)
        + slope(i) * (s3 - 2.0 * s2 + s)
        + points(i + 1) * (3.0 * s2 - 2.0 * s3)
        + slope(i + 1) * (s3 - s2)
}
