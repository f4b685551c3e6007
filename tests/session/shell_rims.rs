//! A sleeve of which both sides are modelled ends where it was designed to.

use bespoke::control::Stage;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::diagnostic::DiagnosticKind;
use bespoke::input::skeleton::Skeleton;
use bespoke::options::Options;
use bespoke::session::{Precision, Session};
use glam::DVec3;

use crate::small::{arm, tube};

const SIDES: u32 = 20;

/// A sleeve whose two sides are so far apart, joined by strips.
fn sleeve(thickness: f64) -> TriangleMesh {
    let face = |off: f64| tube(-0.5, 0.75, |_, _| 0.25 - off, 16, SIDES, false);
    let (outer, inner) = (face(0.0), face(thickness));
    let count = outer.positions.len() as u32;
    let mut mesh = outer;
    mesh.positions.extend(inner.positions);
    mesh.triangles.extend(inner.triangles.iter().map(|&[a, b, c]| [a + count, c + count, b + count]));
    for side in 0..SIDES {
        let next = (side + 1) % SIDES;
        mesh.triangles.extend([[next, side, side + count], [next, side + count, next + count]]);
        let [a, b] = [side, next].map(|s| count - SIDES + s);
        mesh.triangles.extend([[a, b, b + count], [a, b + count, a + count]]);
    }
    mesh
}

/// The arm with a forearm so much longer.
fn longer(by: f64) -> Skeleton {
    let mut skeleton = arm(1.0, DVec3::ZERO);
    skeleton.joints[2] *= by;
    skeleton
}

/// An arm around [`longer`].
fn body(by: f64) -> TriangleMesh {
    let mut mesh = tube(-1.1, 1.15, |_, _| 0.3, 14, 18, true);
    mesh.positions
        .iter_mut()
        .filter(|p| p.z > 0.0)
        .for_each(|p| *p = *p * DVec3::new(1.0, 1.0, by) + DVec3::X * (0.2 * (by - 1.0) * p.z));
    mesh
}

/// The places of both ends along their bones, 0 at the elbow.
fn ends(x: &[DVec3], skeleton: &Skeleton) -> [f64; 2] {
    let outer = x.len() / 2;
    [(0..SIDES as usize, 0), (outer - SIDES as usize..outer, 2)].map(|(vertices, joint)| {
        let along = skeleton.joints[joint];
        let count = vertices.len() as f64;
        vertices.map(|v| x[v].dot(along) / along.length_squared()).sum::<f64>() / count
    })
}

fn dressed(garment: &TriangleMesh, by: f64, options: Options) -> (Vec<DVec3>, Session) {
    let mut session = Session::new();
    session.set_options(options).unwrap();
    session.set_garment(garment.clone(), Precision::F64).unwrap();
    session.set_source_skeleton(arm(1.0, DVec3::ZERO)).unwrap();
    session.set_target_avatar(body(by)).unwrap();
    session.set_target_skeleton(longer(by)).unwrap();
    assert_eq!(session.run().unwrap(), Stage::Done);
    assert!(session.verify(Precision::F64).unwrap().is_clean());
    (session.garment_positions().unwrap(), session)
}

#[test]
fn its_ends_keep_their_places_along_the_bones() {
    let by = 1.8;
    let garment = sleeve(0.01);
    let designed = ends(&garment.positions, &arm(1.0, DVec3::ZERO));
    let (x, session) = dressed(&garment, by, Options::default());
    let found = ends(&x, &longer(by));
    for (was, is) in designed.iter().zip(found) {
        assert!((was - is).abs() < 0.05, "{designed:?} {found:?}");
    }
    assert!(session.diagnostics().iter().all(|d| d.kind() != DiagnosticKind::RimsNotFound));
    // Without the term the cuff is left behind.
    let free = Options { position_weight: 0.0, ..Options::default() };
    let free = ends(&dressed(&garment, by, free).0, &longer(by));
    assert!((designed[1] - free[1]).abs() > 0.1, "{designed:?} {free:?}");
}

#[test]
fn where_it_is_too_thick_for_cloth_that_is_said() {
    let (_, session) = dressed(&sleeve(0.1), 1.2, Options::default());
    let found: Vec<String> = session
        .diagnostics()
        .iter()
        .filter(|diagnostic| diagnostic.kind() == DiagnosticKind::RimsNotFound)
        .map(ToString::to_string)
        .collect();
    assert!(found.len() == 1 && found[0].contains("no cuff, hem or collar of it was found"), "{found:?}");
}
