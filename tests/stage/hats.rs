//! Hats on the end of a bone that passes through them: brims surround no bone in the planes across it, and a head may have its
//! end far beyond the crown. Both are dressed.

use std::f64::consts::TAU;

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::diagnostic::Diagnostic;
use bespoke::stage::start::enclosure::enclosed_share;
use glam::DVec3;

use crate::repair::{Case, chain, edge_crossings, tube};

/// Sides of a hat.
const SIDES: u32 = 24;

/// Height of a crown.
const HEIGHT: f64 = 0.34;

/// Height of the filling of a crown.
const FILLING: f64 = 0.1;

/// A round crown of radius 0.25 above `z`, closed above, and a brim; all of it slanted by `slant`.
fn hat(z: f64, slant: f64) -> TriangleMesh {
    let brim = [0.7, 0.55, 0.4, 0.25].map(|radius| (radius, 0.0));
    let crown = [(0.25, 0.1), (0.24, 0.2), (0.2, 0.27), (0.12, 0.32), (0.0, HEIGHT)];
    revolved(&[&brim[..], &crown].concat(), z, slant)
}

/// Such a crown as a solid body, which a head can go into as far as its filling.
fn filled_hat(z: f64) -> TriangleMesh {
    let filling = [(0.0, FILLING), (0.1, FILLING), (0.2, FILLING), (0.21, 0.0), (0.25, 0.0)];
    let crown = [(0.25, 0.1), (0.24, 0.2), (0.2, 0.27), (0.12, 0.32), (0.0, HEIGHT)];
    revolved(&[&filling[..], &crown].concat(), z, 0.0)
}

/// The surface through rings of these radii and heights above `z`.
fn revolved(rings: &[(f64, f64)], z: f64, slant: f64) -> TriangleMesh {
    let mut mesh = TriangleMesh::default();
    for &(radius, height) in rings {
        for s in 0..SIDES {
            let angle = TAU * f64::from(s) / f64::from(SIDES);
            let [x, y] = [radius * angle.cos(), radius * angle.sin()];
            mesh.positions.push(DVec3::new(x, y, z + height + slant * x));
        }
    }
    // A ring without a radius is one vertex.
    let at = |r: usize, s: u32| r as u32 * SIDES + if rings[r].0 > 0.0 { s % SIDES } else { 0 };
    for r in 0..rings.len() - 1 {
        for s in 0..SIDES {
            if rings[r].0 > 0.0 {
                mesh.triangles.push([at(r, s), at(r, s + 1), at(r + 1, s)]);
            }
            if rings[r + 1].0 > 0.0 {
                mesh.triangles.push([at(r, s + 1), at(r + 1, s + 1), at(r + 1, s)]);
            }
        }
    }
    mesh
}

fn head(garment: TriangleMesh) -> Case {
    let body = chain(&[[0.0, 0.0, -1.0], [0.0, 0.0, 0.0], [0.0, 0.0, 1.0]]);
    let avatar = tube([-1.1, 1.02], |z| DVec3::new(0.0, 0.0, z), |_| 0.2, [24, 14], [true; 2]);
    Case { garment, source: body.clone(), avatar, target: body }
}

/// Whether all of the start above the hat's opening lies in the crown, below `end`, and there is some of it.
fn is_in_the_crown(case: &Case, z: f64, slant: f64, end: f64) -> bool {
    let problem = case.problem(&mut Vec::new()).unwrap();
    let above = problem.projected.start.iter().map(|p| (p.x.hypot(p.y), p.z - z - slant * p.x)).filter(|p| p.1 > 0.0);
    let inside: Vec<bool> = above.map(|(radius, height)| radius < 0.25 && height < end).collect();
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
    assert!(is_in_the_crown(&case, z, slant, HEIGHT));
}

#[test]
fn a_head_that_ends_far_above_its_hat_is_pulled_back_into_it() {
    let case = head(hat(0.5, 0.0));
    case.is_repaired();
    assert!(is_in_the_crown(&case, 0.5, 0.0, HEIGHT));
}

/// Its end lies within the crown, between the filling and the top, and is enclosed there as nothing else is.
#[test]
fn a_head_that_ends_in_the_filling_of_its_hat_is_pulled_back_below_it() {
    for z in [0.7, 0.75, 0.85] {
        let case = head(filled_hat(z));
        assert!(case.shrunk_penetrates(), "{z}");
        let mut diagnostics = Vec::new();
        let problem = case.problem(&mut diagnostics).unwrap();
        let crossings =
            edge_crossings(&problem.rest, &problem.triangles, &problem.projected.start, &problem.projected.triangles);
        assert_eq!(crossings, 0, "{z}");
        assert!(is_in_the_crown(&case, z, 0.0, FILLING), "{z}");
        let pulled_back = |d: &Diagnostic| matches!(d, Diagnostic::BoneMoved { between, .. } if *between > 0.0);
        assert!(diagnostics.iter().any(pulled_back), "{z}: {diagnostics:?}");
    }
}
