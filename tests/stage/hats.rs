//! Hats on the end of a bone that passes through them: brims surround no bone in the planes across it, and a head may have its
//! end far beyond the crown. Both are dressed.

use std::f64::consts::TAU;

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::stage::start::enclosure::enclosed_share;
use glam::DVec3;

use crate::repair::{Case, chain, tube};

/// Sides of a hat.
const SIDES: u32 = 24;

/// Height of a crown.
const HEIGHT: f64 = 0.34;

/// A round crown of radius 0.25 above `z`, closed above, and a brim; all of it slanted by `slant`.
fn hat(z: f64, slant: f64) -> TriangleMesh {
    let brim = [0.7, 0.55, 0.4, 0.25].map(|radius| (radius, 0.0));
    let crown = [(0.25, 0.1), (0.24, 0.2), (0.2, 0.27), (0.12, 0.32), (0.0, HEIGHT)];
    let rings = [&brim[..], &crown].concat();
    let mut mesh = TriangleMesh::default();
    for &(radius, height) in &rings {
        for s in 0..SIDES {
            let angle = TAU * f64::from(s) / f64::from(SIDES);
            let [x, y] = [radius * angle.cos(), radius * angle.sin()];
            mesh.positions.push(DVec3::new(x, y, z + height + slant * x));
        }
    }
    let tip = SIDES * (rings.len() as u32 - 1);
    for r in 0..rings.len() as u32 - 1 {
        for s in 0..SIDES {
            let at = |r: u32, s: u32| (r * SIDES + s % SIDES).min(tip);
            mesh.triangles.push([at(r, s), at(r, s + 1), at(r + 1, s)]);
            if at(r + 1, 0) < tip {
                mesh.triangles.push([at(r, s + 1), at(r + 1, s + 1), at(r + 1, s)]);
            }
        }
    }
    mesh.positions.truncate(tip as usize + 1);
    mesh
}

fn head(garment: TriangleMesh) -> Case {
    let body = chain(&[[0.0, 0.0, -1.0], [0.0, 0.0, 0.0], [0.0, 0.0, 1.0]]);
    let avatar = tube([-1.1, 1.02], |z| DVec3::new(0.0, 0.0, z), |_| 0.2, [24, 14], [true; 2]);
    Case { garment, source: body.clone(), avatar, target: body }
}

/// Whether all of the start above the hat's opening lies in the crown, and there is some of it.
fn is_in_the_crown(case: &Case, z: f64, slant: f64) -> bool {
    let problem = case.problem(&mut Vec::new()).unwrap();
    let above = problem.projected.start.iter().map(|p| (p.x.hypot(p.y), p.z - z - slant * p.x)).filter(|p| p.1 > 0.0);
    let inside: Vec<bool> = above.map(|(radius, height)| radius < 0.25 && height < HEIGHT).collect();
    !inside.is_empty() && !inside.contains(&false)
}

#[test]
fn a_slanted_brim_need_not_be_around_the_bent_bone() {
    let (z, slant) = (0.64, 0.3);
    let case = head(hat(z, slant));
    let straight = [[-1.0, 0.0], [0.0, 1.0]].map(|ends| ends.map(|z| DVec3::new(0.0, 0.0, z)));
    let share = enclosed_share(&case.garment, &straight);
    assert!(share < 0.85, "{share}");
    case.is_repaired();
    assert!(is_in_the_crown(&case, z, slant));
}

#[test]
fn a_head_that_ends_far_above_its_hat_is_pulled_back_into_it() {
    let case = head(hat(0.5, 0.0));
    case.is_repaired();
    assert!(is_in_the_crown(&case, 0.5, 0.0));
}
