//! What a session says of the distortion of its garment.

use bespoke::control::Stage;
use bespoke::energy::distortion::distortion;
use bespoke::error::ErrorKind;
use bespoke::session::{Budget, Precision, Session};
use glam::DVec3;

use crate::small::{session, sleeve};

/// The session's own garment with what games leave in meshes: a triangle twice, one that is a line, a split vertex.
fn with_leftovers(session: &mut Session) -> [usize; 3] {
    let mut garment = sleeve();
    let first = garment.triangles.len();
    let [a, b, c] = garment.triangles[40];
    garment.triangles.push([b, c, a]);
    garment.triangles.push([a, a, b]);
    // The same triangle with a corner of its own in the same place.
    garment.positions.push(garment.positions[b as usize]);
    garment.triangles.push([a, garment.positions.len() as u32 - 1, c]);
    session.set_garment(garment, Precision::F64).unwrap();
    [first, first + 1, first + 2]
}

#[test]
fn it_is_read_in_the_callers_order_from_prepare_on() {
    let mut session = session(0.05, DVec3::new(3.0, -2.0, 7.0));
    assert_eq!(session.distortion().unwrap_err().kind, ErrorKind::InvalidState);
    let [duplicate, collapsed, split] = with_leftovers(&mut session);
    session.prepare().unwrap();
    let at_first = session.distortion().unwrap();
    assert_eq!(at_first.len(), split + 1);
    assert!(at_first.iter().all(|d| (0.0..1e-20).contains(d)), "the garment is as it was designed");
    while session.step(Budget { iterations: 1, milliseconds: 0 }).unwrap() == Stage::Inflate {}
    let preview = session.distortion().unwrap();
    assert!(preview.iter().any(|&d| d > 1e-6));
    assert_eq!(session.run().unwrap(), Stage::Done);
    let at_last = session.distortion().unwrap();
    assert_eq!(at_last[duplicate].to_bits(), at_last[40].to_bits());
    assert_eq!(at_last[split].to_bits(), at_last[40].to_bits());
    assert_eq!(at_last[collapsed], 0.0);

    // From what is read, in the space and unit of the target, without the leftovers.
    let (rest, result) = (sleeve(), session.garment_positions().unwrap());
    let expected = distortion(&rest.positions, &result, &rest.triangles);
    assert_eq!(expected.len(), duplicate);
    for (t, (found, expected)) in at_last.iter().zip(&expected).enumerate() {
        assert!(*found > 0.0 && (found - expected).abs() <= 1e-6 * expected + 1e-9, "{t}: {found} {expected}");
    }
    session.reset();
    assert_eq!(session.distortion().unwrap_err().kind, ErrorKind::InvalidState);
}
