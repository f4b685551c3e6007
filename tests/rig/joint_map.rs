//! The map between two rigs: pairs of a caller win, structure where names say nothing, and a reason for each joint.

use bespoke::input::rig::{Rig, RigJoint};
use bespoke::rig::body_part::{BodyPart, Side};
use bespoke::rig::joint_map::{JointMap, Reason};
use bespoke::rig::reading::Reading;
use glam::{DMat4, DVec3};

/// A person of 17 joints with a root on the floor; `name` makes each joint's name from that of its part.
fn person(name: impl Fn(&str) -> String, scale: f64) -> Rig {
    let mut joints: Vec<RigJoint> = Vec::new();
    let mut add = |part: &str, parent: Option<u32>, place: [f64; 3]| {
        let place = scale * DVec3::from(place);
        joints.push(RigJoint { name: name(part), parent, bind: DMat4::from_translation(place) });
        joints.len() as u32 - 1
    };
    let root = add("root", None, [0.0; 3]);
    let hips = add("pelvis", Some(root), [0.0, 1.0, 0.0]);
    let spine = add("spine_01", Some(hips), [0.0, 1.2, 0.0]);
    let chest = add("spine_02", Some(spine), [0.0, 1.35, 0.0]);
    let neck = add("neck_01", Some(chest), [0.0, 1.5, 0.0]);
    add("head", Some(neck), [0.0, 1.6, 0.0]);
    for (side, x) in [("l", 1.0), ("r", -1.0)] {
        let arm = add(&format!("upperarm_{side}"), Some(chest), [0.2 * x, 1.42, 0.0]);
        let fore = add(&format!("lowerarm_{side}"), Some(arm), [0.5 * x, 1.42, 0.0]);
        add(&format!("hand_{side}"), Some(fore), [0.78 * x, 1.42, 0.0]);
        let leg = add(&format!("thigh_{side}"), Some(hips), [0.1 * x, 0.95, 0.0]);
        let shin = add(&format!("calf_{side}"), Some(leg), [0.1 * x, 0.5, 0.0]);
        let foot = add(&format!("foot_{side}"), Some(shin), [0.1 * x, 0.1, 0.0]);
        add(&format!("ball_{side}"), Some(foot), [0.1 * x, 0.02, 0.15]);
    }
    Rig { joints }
}

fn map(source: &Rig, target: &Rig, pairs: &[(u32, Option<u32>)]) -> JointMap {
    let readings = [Reading::new(source, None), Reading::new(target, None)];
    JointMap::new(source, target, readings, pairs).expect("pairs that suit")
}

#[test]
fn a_rig_without_names_is_read_by_its_structure() {
    let (named, silent) = (person(str::to_string, 1.0), person(|_| String::new(), 100.0));
    let map = map(&named, &silent, &[]);
    for (joint, mapped) in map.joints.iter().enumerate() {
        let name = &named.joints[joint].name;
        if ["upperarm", "lowerarm", "hand", "thigh", "calf", "foot"].iter().any(|part| name.starts_with(part)) {
            assert_eq!((mapped.target, mapped.reason), (Some(joint as u32), Reason::Structure), "{name}");
        }
    }
    assert_eq!(map.joints[0].target, None, "a root on the floor is a control");
}

#[test]
fn a_collar_bone_in_line_with_the_arm_is_none_of_its_two_bones() {
    let silent = |places: &[([f64; 3], Option<u32>)]| Rig {
        joints: places
            .iter()
            .map(|&(place, parent)| RigJoint {
                name: String::new(),
                parent,
                bind: DMat4::from_translation(DVec3::from(place)),
            })
            .collect(),
    };
    // Collar bone and upper arm together are as long as the forearm, so that these two would do for an arm.
    let mut places = vec![
        ([0.0, 1.0, 0.0], None),
        ([0.0, 1.3, 0.0], Some(0)),
        ([0.0, 1.5, 0.0], Some(1)),
        ([0.0, 1.65, 0.0], Some(2)),
    ];
    for x in [1.0, -1.0] {
        let first = places.len() as u32;
        let arm = [0.085, 0.14, 0.36, 0.64, 0.72].map(|along| [x * along, 1.42, 0.0]);
        let leg = [[0.11, 0.95, 0.0], [0.11, 0.5, 0.0], [0.11, 0.08, 0.0], [0.11, 0.02, 0.15]];
        for (k, place) in (0u32..).zip(arm) {
            places.push((place, Some(if k == 0 { 1 } else { first + k - 1 })));
        }
        for (k, [aside, y, z]) in (0u32..).zip(leg) {
            places.push(([x * aside, y, z], Some(if k == 0 { 0 } else { first + 4 + k })));
        }
    }
    let reading = Reading::new(&silent(&places), None);
    for (side, first) in [(Side::Left, 4), (Side::Right, 13)] {
        let parts =
            [BodyPart::Clavicle(side), BodyPart::UpperArm(side), BodyPart::LowerArm(side), BodyPart::Hand(side)];
        for (joint, part) in (first..).zip(parts) {
            assert_eq!(reading.part(joint), Some(part), "joint {joint}");
        }
    }
}

#[test]
fn a_rig_that_stands_otherwise_is_read_alike() {
    let named = person(str::to_string, 1.0);
    for turn in [DMat4::from_rotation_x(1.5), DMat4::from_rotation_y(2.5), DMat4::from_rotation_z(-1.0)] {
        let silent = person(|_| String::new(), 1.0).mapped(turn);
        let map = map(&named, &silent, &[]);
        for (joint, mapped) in
            map.joints.iter().enumerate().filter(|(_, mapped)| mapped.part.is_some_and(|part| part.side().is_some()))
        {
            assert_eq!(mapped.target, Some(joint as u32), "{}", named.joints[joint].name);
        }
    }
}

#[test]
fn pairs_of_the_caller_win() {
    let rig = person(str::to_string, 1.0);
    let at = |name: &str| rig.joints.iter().position(|joint| joint.name == name).expect("a joint") as u32;
    let (left, right) = (at("hand_l"), at("hand_r"));
    let map = map(&rig, &rig, &[(left, Some(right)), (right, Some(left)), (at("head"), None)]);
    assert_eq!(map.joints[left as usize].target, Some(right));
    assert_eq!(map.joints[left as usize].reason, Reason::Caller);
    assert_eq!(map.joints[right as usize].target, Some(left));
    assert_eq!(map.joints[at("head") as usize].target, None);
    assert_eq!(map.joints[at("upperarm_l") as usize].part, Some(BodyPart::UpperArm(Side::Left)));
}

#[test]
fn pairs_that_suit_no_rig_are_refused() {
    let rig = person(str::to_string, 1.0);
    let refused = |pairs: &[(u32, Option<u32>)]| {
        let readings = [Reading::new(&rig, None), Reading::new(&rig, None)];
        JointMap::new(&rig, &rig, readings, pairs).expect_err("refused").message
    };
    assert!(refused(&[(99, Some(0))]).contains("joint 99 of the source rig"));
    assert!(refused(&[(0, Some(99))]).contains("joint 99 of the target rig"));
    assert!(refused(&[(0, Some(1)), (0, Some(2))]).contains("in pair 0 and in pair 1"));
}
