//! A body posed like another, and back.

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::rig::{Rig, RigJoint};
use bespoke::input::skin::SkinWeights;
use bespoke::rig::body_part::Side;
use bespoke::rig::clothed::clothed;
use bespoke::rig::landmark::Landmark;
use bespoke::rig::places::{Character, index, places};
use bespoke::rig::posing::{LIMBS, Posing};
use bespoke::rig::reading::Reading;
use glam::{DMat4, DVec3};

use super::limbs::tube;

/// A garment on all limbs.
const EVERYWHERE: [bool; LIMBS.len()] = [true; LIMBS.len()];

/// A person whose arms are turned down from the horizontal by so many degrees.
fn person(degrees: f64) -> Rig {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let mut joints = Vec::new();
    let mut add = |name: &str, parent: Option<u32>, place: DVec3| {
        joints.push(RigJoint { name: name.into(), parent, bind: DMat4::from_translation(place) });
        joints.len() as u32 - 1
    };
    let hips = add("Hips", None, DVec3::new(0.0, 1.0, 0.0));
    let spine = add("Spine", Some(hips), DVec3::new(0.0, 1.2, 0.0));
    let neck = add("Neck", Some(spine), DVec3::new(0.0, 1.5, 0.0));
    add("Head", Some(neck), DVec3::new(0.0, 1.6, 0.0));
    for (side, x) in [("Left", 1.0), ("Right", -1.0)] {
        let from = DVec3::new(0.2 * x, 1.4, 0.0);
        let along = DVec3::new(cos * x, -sin, 0.0);
        let arm = add(&format!("{side}Arm"), Some(spine), from);
        let fore = add(&format!("{side}ForeArm"), Some(arm), from + 0.3 * along);
        add(&format!("{side}Hand"), Some(fore), from + 0.6 * along);
        let leg = add(&format!("{side}UpLeg"), Some(hips), DVec3::new(0.1 * x, 0.95, 0.0));
        let shin = add(&format!("{side}Leg"), Some(leg), DVec3::new(0.1 * x, 0.5, 0.0));
        add(&format!("{side}Foot"), Some(shin), DVec3::new(0.1 * x, 0.1, 0.0));
    }
    Rig { joints }
}

/// A vertex at each joint, which moves it alone.
fn body(rig: &Rig) -> (TriangleMesh, SkinWeights) {
    let count = rig.joints.len() as u32;
    let positions = (0..count).map(|joint| rig.place(joint)).collect();
    let triangles = (0..count - 2).map(|v| [v, v + 1, v + 2]).collect();
    let skin = SkinWeights::from_rows(count as usize, (0..count).map(|joint| vec![(joint, 1.0)]));
    (TriangleMesh { positions, triangles }, skin)
}

fn posing(own: &Rig, other: &Rig) -> Option<(Posing, [Option<DVec3>; Landmark::COUNT])> {
    let (mesh, skin) = body(own);
    let character = Character { rig: own, body: Some(&mesh), skin: Some(&skin) };
    let reading = Reading::new(own, Some(&skin));
    let order = own.parents_first("rig").expect("a tree");
    let here = places(character, &reading, &order);
    let (mesh, skin) = body(other);
    let character = Character { rig: other, body: Some(&mesh), skin: Some(&skin) };
    let reading_of_other = Reading::new(other, Some(&skin));
    let there = places(character, &reading_of_other, &other.parents_first("rig").expect("a tree"));
    let (mesh, skin) = body(own);
    let character = Character { rig: own, body: Some(&mesh), skin: Some(&skin) };
    Posing::new(character, &reading, &order, &here, &there).map(|posing| (posing, there))
}

#[test]
fn limbs_take_the_directions_of_the_others() {
    let (own, other) = (person(80.0), person(0.0));
    let (posing, there) = posing(&own, &other).expect("80 degrees are far");
    let (mesh, skin) = body(&own);
    let moved = posing.moved(&posing.motions(1.0), &skin, &mesh.positions);
    for side in Side::BOTH {
        let wrist = there[index(Landmark::Wrist(side))].expect("a wrist");
        let nearest = moved.iter().map(|p| p.distance(wrist)).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-12, "{side:?} wrist is off by {nearest}");
    }
    assert!((posing.largest_turn().to_degrees() - 80.0).abs() < 1e-9);
}

#[test]
fn the_own_pose_is_the_end_of_the_way() {
    let own = person(80.0);
    let (posing, _) = posing(&own, &person(0.0)).expect("80 degrees are far");
    let (mesh, skin) = body(&own);
    let moved = posing.moved(&posing.motions(0.0), &skin, &mesh.positions);
    assert!(moved.iter().zip(&mesh.positions).all(|(p, q)| p.distance(*q) < 1e-15));
    // Half-way, lengths are kept: every motion is rigid.
    for motion in posing.motions(0.5) {
        assert!((motion.matrix3.determinant() - 1.0).abs() < 1e-12);
    }
}

#[test]
fn small_differences_are_known_and_are_no_large_ones() {
    for (own, other) in [(45.0, 0.0), (45.0, 80.0), (25.0, 0.0)] {
        let (posing, _) = posing(&person(own), &person(other)).expect("there is a way");
        assert!((posing.difference() - f64::abs(own - other)).abs() < 1e-9 && !posing.is_large(|| EVERYWHERE));
    }
    assert!(posing(&person(80.0), &person(0.0)).expect("80 degrees are far").0.is_large(|| EVERYWHERE));
    assert!(posing(&person(15.0), &person(0.0)).is_none());
}

/// A tube around the vertical through `x` and `z`.
fn upright([x, z]: [f64; 2], radius: f64, [low, high]: [f64; 2]) -> TriangleMesh {
    let mut mesh = tube(low, high, radius, 8, 16);
    mesh.positions.iter_mut().for_each(|p| *p = DVec3::new(x + p.y, p.x, z + p.z));
    mesh
}

#[test]
fn only_limbs_under_the_garment_make_the_difference_large() {
    // Arms that hang beside trousers turn by 80 degrees.
    let (own, others) = (person(80.0), person(0.0));
    let (way, there) = posing(&own, &others).expect("80 degrees are far");
    let (back, here) = posing(&others, &own).expect("80 degrees are far");
    let on_both_legs = upright([0.0, 0.0], 0.2, [0.2, 1.05]);
    let [upper, lower] = [0, 1].map(|k| LIMBS.iter().position(|limb| limb[k] == Landmark::Elbow(Side::Left)).unwrap());
    for places in [&there, &here] {
        let legs = clothed(&on_both_legs, places);
        assert_eq!(
            legs,
            LIMBS.map(|[from, _]| matches!(from, Landmark::Hip(_) | Landmark::Knee(_))),
            "arms: {places:?}"
        );
        assert!(!way.is_large(|| legs) && !back.is_large(|| legs));
    }
    // A bracelet near the wrist of a hanging arm is on all of that arm, and on nothing else.
    let wrist = here[index(Landmark::Wrist(Side::Left))].expect("a wrist");
    let bracelet = clothed(&upright([wrist.x, wrist.z], 0.05, [wrist.y - 0.06, wrist.y + 0.06]), &here);
    let arm = [upper, lower];
    assert_eq!(
        bracelet.iter().enumerate().filter(|(_, on)| **on).map(|(k, _)| k).collect::<Vec<_>>(),
        [arm[1], arm[0]]
    );
    assert!(back.is_large(|| bracelet));
    // Where a limb is not known, nobody can say.
    assert_eq!(clothed(&on_both_legs, &[None; Landmark::COUNT]), EVERYWHERE);
}

#[test]
fn where_a_body_faces_does_not_matter() {
    let own = person(80.0).mapped(DMat4::from_rotation_y(2.0));
    let (posing, _) = posing(&own, &person(0.0)).expect("80 degrees are far");
    assert!((posing.largest_turn().to_degrees() - 80.0).abs() < 1e-9);
}
