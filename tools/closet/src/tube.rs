//! Tubes along curves and turned pieces: wires, ribs, teeth, bones, axles.

use glam::DVec3;

use super::mesh::Mesh;

/// Points along a smooth curve through `knots` (at least two), `pieces` between each pair.
pub fn curve(knots: &[DVec3], pieces: usize) -> Vec<DVec3> {
    let last = knots.len() - 1;
    let slope = |i: usize| {
        let (before, after) = (i.saturating_sub(1), (i + 1).min(last));
        (knots[after] - knots[before]) / (after - before) as f64
    };
    let mut points = vec![knots[0]];
    for i in 0..last {
        for piece in 1..=pieces {
            let t = piece as f64 / pieces as f64;
            let (t2, t3) = (t * t, t * t * t);
            points.push(
                (2.0 * t3 - 3.0 * t2 + 1.0) * knots[i]
                    + (t3 - 2.0 * t2 + t) * slope(i)
                    + (3.0 * t2 - 2.0 * t3) * knots[i + 1]
                    + (t3 - t2) * slope(i + 1),
            );
        }
    }
    points
}

/// A closed tube along `points`. `radii` gives the half-axes in metres at each place (0 to 1): along `first`, made
/// orthogonal to the curve, and across it. The ends stand out by `cap` times the first radius (0: flat).
pub fn tube(points: &[DVec3], first: DVec3, sides: usize, cap: f64, radii: impl Fn(f64) -> [f64; 2]) -> Mesh {
    let last = points.len() - 1;
    let tangent = |i: usize| (points[(i + 1).min(last)] - points[i.saturating_sub(1)]).normalize();
    let mut lateral = first;
    let mut rings = Vec::with_capacity(points.len());
    for (i, &centre) in points.iter().enumerate() {
        // Carried along without a twist.
        lateral = lateral.reject_from_normalized(tangent(i)).normalize();
        let [u, v] = radii(i as f64 / last as f64);
        rings.push((centre, u * lateral, v * tangent(i).cross(lateral)));
    }
    let poles = [points[0] - cap * radii(0.0)[0] * tangent(0), points[last] + cap * radii(1.0)[0] * tangent(last)];
    close(&rings, poles, sides)
}

/// A straight tube with elliptic rings: `profile` holds places (0 to 1 from `start` to `end`, rising or equal) and
/// both half-axes in metres, the first of them along `first`. The ends are flat.
pub fn column(start: DVec3, end: DVec3, first: DVec3, sides: usize, profile: &[[f64; 3]]) -> Mesh {
    let along = (end - start).normalize();
    let lateral = first.reject_from_normalized(along).normalize();
    let across = along.cross(lateral);
    let ring = |&[t, u, v]: &[f64; 3]| (start.lerp(end, t), u * lateral, v * across);
    let rings: Vec<_> = profile.iter().map(ring).collect();
    close(&rings, [rings[0].0, rings[rings.len() - 1].0], sides)
}

/// A turned piece: `profile` holds places (0 to 1 from `start` to `end`, rising or equal) and radii in metres.
pub fn lathe(start: DVec3, end: DVec3, sides: usize, profile: &[[f64; 2]]) -> Mesh {
    let profile: Vec<_> = profile.iter().map(|&[t, radius]| [t, radius, radius]).collect();
    column(start, end, (end - start).any_orthogonal_vector(), sides, &profile)
}

/// A ball of `rings` rings.
pub fn ball(centre: DVec3, radius: f64, sides: usize, rings: usize) -> Mesh {
    let angle = |i: usize| std::f64::consts::PI * (i as f64 + 1.0) / (rings as f64 + 1.0);
    let ring = |i: usize| (centre - radius * angle(i).cos() * DVec3::Z, radius * angle(i).sin());
    let rings: Vec<_> =
        (0..rings).map(ring).map(|(middle, width)| (middle, width * DVec3::X, width * DVec3::Y)).collect();
    close(&rings, [centre - radius * DVec3::Z, centre + radius * DVec3::Z], sides)
}

/// Joins rings (centre and two half-axes, counter-clockwise around the way onwards) and closes both ends.
fn close(rings: &[(DVec3, DVec3, DVec3)], poles: [DVec3; 2], sides: usize) -> Mesh {
    let mut mesh = Mesh::default();
    for &(centre, u, v) in rings {
        mesh.positions.extend((0..sides).map(|side| {
            let (sin, cos) = (std::f64::consts::TAU * side as f64 / sides as f64).sin_cos();
            centre + cos * u + sin * v
        }));
    }
    let [start, end] = [mesh.positions.len() as u32, mesh.positions.len() as u32 + 1];
    mesh.positions.extend(poles);
    let at = |ring: usize, side: usize| (ring * sides + side % sides) as u32;
    let last = rings.len() - 1;
    for side in 0..sides {
        mesh.triangles.push([start, at(0, side + 1), at(0, side)]);
        mesh.triangles.push([end, at(last, side), at(last, side + 1)]);
    }
    for ring in 0..last {
        for side in 0..sides {
            let [a, b] = [at(ring, side), at(ring, side + 1)];
            let [c, d] = [at(ring + 1, side), at(ring + 1, side + 1)];
            mesh.triangles.extend([[a, b, c], [b, d, c]]);
        }
    }
    mesh
}
