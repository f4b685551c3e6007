//! Cloth that is thinner than the barrier is wide keeps its thickness, and on the body it was designed on nothing moves.

use bespoke::control::Stage;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::session::{Precision, Session};
use glam::DVec3;

use crate::small::{arm, tube};

/// Below the 0.002 at which the barrier begins.
const THICKNESS: f64 = 0.0012;

fn arm_body() -> TriangleMesh {
    tube(-1.1, 1.15, |_, _| 0.25, 14, 18, true)
}

/// A sleeve with two faces, closed at its rims.
fn shell() -> TriangleMesh {
    let radius = |z: f64| 0.3 + 0.01 * (12.0 * z).sin();
    let (inner, outer) = (face(&radius, 0.0), face(&radius, THICKNESS));
    let (count, sides) = (inner.positions.len() as u32, 20);
    let mut mesh = TriangleMesh { positions: inner.positions, triangles: Vec::new() };
    mesh.positions.extend(outer.positions);
    mesh.triangles.extend(inner.triangles.iter().map(|&[a, b, c]| [a, c, b]));
    mesh.triangles.extend(outer.triangles.iter().map(|t| t.map(|v| v + count)));
    for side in 0..sides {
        let next = (side + 1) % sides;
        let top = count - sides;
        mesh.triangles.extend([[side, next, next + count], [side, next + count, side + count]]);
        let [a, b] = [top + side, top + next];
        mesh.triangles.extend([[b, a, a + count], [b, a + count, b + count]]);
    }
    mesh
}

fn face(radius: &dyn Fn(f64) -> f64, off: f64) -> TriangleMesh {
    tube(-0.6, 0.7, |z, _| radius(z) + off, 16, 20, false)
}

/// The shell on the arm, moved there and back.
fn dressed(body: TriangleMesh, with_source: bool) -> Vec<DVec3> {
    let mut session = Session::new();
    session.set_garment(shell(), Precision::F64).unwrap();
    session.set_source_skeleton(arm(1.0, DVec3::ZERO)).unwrap();
    session.set_target_avatar(body).unwrap();
    session.set_target_skeleton(arm(1.0, DVec3::ZERO)).unwrap();
    if with_source {
        session.set_source_avatar(arm_body()).unwrap();
    }
    assert_eq!(session.run().unwrap(), Stage::Done);
    assert!(session.verify(Precision::F64).unwrap().is_clean());
    session.garment_positions().unwrap()
}

/// The distances of the two faces, vertex by vertex.
fn thicknesses(x: &[DVec3]) -> impl Iterator<Item = f64> {
    let (inner, outer) = x.split_at(x.len() / 2);
    inner.iter().zip(outer).map(|(p, q)| p.distance(*q))
}

#[test]
fn on_its_own_body_nothing_moves() {
    let (before, after) = (shell().positions, dressed(arm_body(), true));
    let moved = before.iter().zip(&after).map(|(p, q)| p.distance(*q)).fold(0.0, f64::max);
    // The skeleton is 2 long.
    assert!(moved < 1e-3, "{moved}");
    for thickness in thicknesses(&after) {
        assert!((thickness / THICKNESS - 1.0).abs() < 0.02, "{thickness}");
    }
}

/// Pressed against the body, as where the fit draws it tight.
#[test]
fn it_is_as_thin_where_it_is_drawn_to_the_body() {
    let after = dressed(arm_body(), false);
    let mean = thicknesses(&after).sum::<f64>() / (after.len() / 2) as f64;
    assert!((mean / THICKNESS - 1.0).abs() < 0.1, "{mean}");
    assert!(thicknesses(&after).all(|thickness| thickness > 0.7 * THICKNESS));
}
