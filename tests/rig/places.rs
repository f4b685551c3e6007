//! Where landmarks are that a rig has no joint for.

use std::f64::consts::{PI, TAU};

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::rig::{Rig, RigJoint};
use bespoke::input::skin::SkinWeights;
use bespoke::rig::landmark::Landmark;
use bespoke::rig::places::{Character, index, places};
use bespoke::rig::reading::Reading;
use glam::{DMat4, DVec3};

const HEAD: u32 = 3;
const MIDDLE: DVec3 = DVec3::new(0.0, 1.72, 0.0);
const RADIUS: f64 = 0.12;

fn rig() -> Rig {
    let joint = |(name, parent, place): (&str, Option<u32>, [f64; 3])| RigJoint {
        name: name.into(),
        parent,
        bind: DMat4::from_translation(DVec3::from(place)),
    };
    let mut joints: Vec<RigJoint> = [
        ("Hips", None, [0.0, 1.0, 0.0]),
        ("Spine", Some(0), [0.0, 1.2, 0.0]),
        ("Neck", Some(1), [0.0, 1.5, 0.0]),
        ("Head", Some(2), [0.0, 1.6, 0.0]),
    ]
    .map(joint)
    .into();
    for (side, x) in [("Left", 1.0), ("Right", -1.0)] {
        let first = joints.len() as u32;
        let limbs = [
            (format!("{side}Arm"), 1, [0.2 * x, 1.45, 0.0]),
            (format!("{side}ForeArm"), first, [0.5 * x, 1.45, 0.0]),
            (format!("{side}Hand"), first + 1, [0.75 * x, 1.45, 0.0]),
            (format!("{side}UpLeg"), 0, [0.1 * x, 0.95, 0.0]),
            (format!("{side}Leg"), first + 3, [0.1 * x, 0.5, 0.0]),
            (format!("{side}Foot"), first + 4, [0.1 * x, 0.1, 0.0]),
        ];
        joints.extend(limbs.iter().map(|(name, parent, place)| joint((name, Some(*parent), *place))));
    }
    Rig { joints }
}

/// A round head with so many columns of vertices in front and behind.
fn head(front: u32, behind: u32) -> TriangleMesh {
    const RINGS: u32 = 12;
    let columns: Vec<f64> = (0..front)
        .map(|k| PI * f64::from(k) / f64::from(front))
        .chain((0..behind).map(|k| PI + PI * f64::from(k) / f64::from(behind)))
        .collect();
    let mut mesh = TriangleMesh::default();
    for r in 0..=RINGS {
        let (sin, cos) = (TAU / 2.0 * f64::from(r) / f64::from(RINGS)).sin_cos();
        for angle in &columns {
            let direction = DVec3::new(sin * angle.cos(), cos, sin * angle.sin());
            mesh.positions.push(MIDDLE + RADIUS * direction);
        }
    }
    let count = columns.len() as u32;
    for r in 0..RINGS {
        for s in 0..count {
            let [a, b] = [r * count + s, r * count + (s + 1) % count];
            mesh.triangles.extend([[a, b, a + count], [b, b + count, a + count]]);
        }
    }
    mesh
}

/// A face has more vertices than the back of a head, and the head does not lean forward for that.
#[test]
fn the_top_of_the_head_is_above_the_middle_of_its_surface() {
    let rig = rig();
    for (front, behind) in [(12, 12), (60, 6), (6, 60)] {
        let body = head(front, behind);
        let skin = SkinWeights::from_rows(rig.joints.len(), body.positions.iter().map(|_| vec![(HEAD, 1.0)]));
        let reading = Reading::new(&rig, Some(&skin));
        let character = Character { rig: &rig, body: Some(&body), skin: Some(&skin) };
        let order = rig.parents_first("rig").expect("a tree");
        let places = places(character, &reading, &order);
        let [neck, top] = [Landmark::Neck, Landmark::HeadTop].map(|landmark| places[index(landmark)].expect("a place"));
        let lean = (top - neck).angle_between(DVec3::Y).to_degrees();
        println!("{front} {behind}: {lean} degrees, {top}");
        assert!(lean < 3.0, "with {front} columns in front and {behind} behind it leans by {lean} degrees");
        assert!((top.y - MIDDLE.y - RADIUS).abs() < 0.2 * RADIUS, "{top}");
    }
}
