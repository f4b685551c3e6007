//! Real garments moved and turned against their skeletons: the bones penetrate them, and the result is clean all the same.

use bespoke::control::Stage;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::session::{Precision, Session};
use bespoke::stage::setup::normalization::{Normalization, SIDE};
use glam::{DQuat, DVec3};

use testing::obj::{assets, read_mesh, read_skeleton, read_skin};

/// How the garment is moved: by a share of the skeleton's size, then turned about its middle, in degrees about an axis.
fn dress(garment: &str, avatar: &str, shift: DVec3, axis: DVec3, degrees: f64) {
    let Some(folder) = assets() else { return };
    let (garment, avatar) = (folder.join("garments").join(garment), folder.join("avatars").join(avatar));
    let source = read_skeleton(&garment.join("skeleton.obj"));
    let frame = Normalization::of(&source, "source skeleton").unwrap();
    let turn = DQuat::from_axis_angle(axis, degrees.to_radians());
    let cloth = read_mesh(&garment.join("garment.obj"));
    let place = |&p: &DVec3| frame.restore(turn * frame.normalise(p) + SIDE * shift);
    let moved = TriangleMesh { positions: cloth.positions.iter().map(place).collect(), ..cloth };
    let body = read_mesh(&avatar.join("avatar.obj"));
    let target = read_skeleton(&avatar.join("skeleton.obj"));
    let mut session = Session::new();
    if let Some(skin) = read_skin(&avatar.join("skin.txt"), target.joints.len(), body.positions.len()) {
        session.set_target_skin(skin).unwrap();
    }
    session.set_garment(moved, Precision::F32).unwrap();
    session.set_source_skeleton(source).unwrap();
    session.set_target_avatar(body).unwrap();
    session.set_target_skeleton(target).unwrap();
    assert_eq!(session.run().unwrap(), Stage::Done);
    let report = session.report();
    assert!(report.verification.unwrap().is_clean());
    assert!(session.verify(Precision::F64).unwrap().is_clean());
    let surface = report.terms.iter().find(|t| t.name == "surface").unwrap().value;
    // The bound that the same garments keep where they are on their skeleton.
    assert!(surface < 0.15, "surface {surface}");
}

#[test]
fn a_coat_pushed_aside_on_the_child() {
    dress("Puffer_dense", "child", DVec3::new(0.07, 0.0, 0.0), DVec3::Z, 0.0);
}

#[test]
fn a_jumpsuit_turned_on_the_slim_adult() {
    dress("jumpsuit_dense", "slim_adult", DVec3::ZERO, DVec3::Y, 5.0);
}
