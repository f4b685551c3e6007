//! The common skeleton has the ends of the feet for what is worn on them, and fingers for gloves, and neither for anything else.

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::rig::{Rig, RigJoint};
use bespoke::input::skin::SkinWeights;
use bespoke::rig::body_part::Side;
use bespoke::rig::common_skeleton::{CommonJoint, CommonSkeleton};
use bespoke::rig::joint_map::JointMap;
use bespoke::rig::landmark::Landmark;
use bespoke::rig::places::{Character, index};
use bespoke::rig::reading::Reading;
use bespoke::rig::worn::Worn;
use glam::{DMat4, DVec3};

/// A person who looks along z; with or without joints in the toes.
fn person(toes: bool) -> Rig {
    let mut joints = Vec::new();
    let mut add = |name: &str, parent: Option<u32>, place: [f64; 3]| {
        joints.push(RigJoint { name: name.into(), parent, bind: DMat4::from_translation(DVec3::from(place)) });
        joints.len() as u32 - 1
    };
    let hips = add("Hips", None, [0.0, 1.0, 0.0]);
    let spine = add("Spine", Some(hips), [0.0, 1.2, 0.0]);
    let neck = add("Neck", Some(spine), [0.0, 1.5, 0.0]);
    add("Head", Some(neck), [0.0, 1.6, 0.0]);
    for (side, x) in [("Left", 0.1), ("Right", -0.1)] {
        let leg = add(&format!("{side}UpLeg"), Some(hips), [x, 0.95, 0.0]);
        let shin = add(&format!("{side}Leg"), Some(leg), [x, 0.5, 0.0]);
        let foot = add(&format!("{side}Foot"), Some(shin), [x, 0.1, 0.0]);
        if toes {
            add(&format!("{side}ToeBase"), Some(foot), [x, 0.03, 0.15]);
        }
    }
    Rig { joints }
}

/// That person with arms along x, and these fingers of the left hand, each with where it lies beside the middle of the hand.
fn with_hands(fingers: &[(&str, f64)]) -> Rig {
    let mut joints = person(true).joints;
    let mut add = |name: String, parent: u32, place: [f64; 3]| {
        joints.push(RigJoint { name, parent: Some(parent), bind: DMat4::from_translation(DVec3::from(place)) });
        joints.len() as u32 - 1
    };
    for (side, sign) in [("Left", 1.0), ("Right", -1.0)] {
        let arm = add(format!("{side}Arm"), 1, [0.2 * sign, 1.45, 0.0]);
        let forearm = add(format!("{side}ForeArm"), arm, [0.45 * sign, 1.45, 0.0]);
        let hand = add(format!("{side}Hand"), forearm, [0.7 * sign, 1.45, 0.0]);
        for &(finger, z) in fingers.iter().filter(|_| side == "Left") {
            (0..3).fold(hand, |parent, k| {
                add(format!("LeftHand{finger}{}", k + 1), parent, [KNUCKLE + 0.04 * f64::from(k), 1.45, z])
            });
        }
    }
    Rig { joints }
}

const KNUCKLE: f64 = 0.78;
const FINGERS: [(&str, f64); 5] =
    [("Thumb", 0.07), ("Index", 0.03), ("Middle", 0.01), ("Ring", -0.01), ("Pinky", -0.03)];

/// A tube along x around the height of the arms.
fn tube(x: [f64; 2], z: [f64; 2]) -> TriangleMesh {
    let corner = |k: usize| DVec3::new(x[k >> 2], 1.45 + [-0.012, 0.012][k & 1], z[(k >> 1) & 1]);
    let quads = [[0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    TriangleMesh { positions: (0..8).map(corner).collect(), triangles }
}

/// A palm with a tube for each of these stretches beside the middle of the hand.
fn glove(tubes: &[[f64; 2]]) -> TriangleMesh {
    let tubes = tubes.iter().map(|&z| tube([KNUCKLE - 0.02, 0.92], z));
    join(&[tube([0.6, KNUCKLE - 0.02], [-0.05, 0.09])].into_iter().chain(tubes).collect::<Vec<_>>())
}

/// The joints beyond the left wrist, by their names in the source, and which of them the target's joint `others` goes with.
fn fingers(rigs: [&Rig; 2], mesh: &TriangleMesh, others: &str) -> (Vec<String>, Option<String>, bool) {
    let [source, target] = rigs;
    let map = JointMap::new(source, target, rigs.map(|rig| Reading::new(rig, None)), &[]).expect("a map");
    let [from, to] = rigs.map(|rig| Character { rig, body: None, skin: None });
    let common = CommonSkeleton::new(from, to, &map, Some(Worn { mesh, skin: None })).expect("they correspond");
    assert_eq!(common.source.bones, common.target.bones);
    let of_hand = |joint: &CommonJoint| match joint {
        CommonJoint::Pair(joint, _) => Some(source.joints[*joint as usize].name.replace("LeftHand", "")),
        CommonJoint::Tip(joint, _) => Some(source.joints[*joint as usize].name.replace("LeftHand", "") + " tip"),
        CommonJoint::Landmark(_) => None,
    };
    let other = target.joints.iter().position(|joint| joint.name == others);
    let with = other.and_then(|joint| of_hand(&common.joints[common.owner[joint]? as usize]));
    (common.joints.iter().filter_map(of_hand).collect(), with, common.unsure(&map).is_some())
}

#[test]
fn gloves_have_bones_in_their_fingers_and_mittens_one_of_them() {
    let (known, without) = (with_hands(&FINGERS), with_hands(&[]));
    let chain = |finger: &str| [1, 2, 3].map(|k| format!("{finger}{k}")).into_iter().chain([format!("{finger}3 tip")]);
    let sorted = |names: &[&str]| {
        let mut all: Vec<String> = names.iter().flat_map(|name| chain(name)).collect();
        all.sort();
        all
    };
    let found = |rigs: [&Rig; 2], mesh: &TriangleMesh| {
        let (mut names, with, unsure) = fingers(rigs, mesh, "LeftHandIndex2");
        names.sort();
        (names, with, unsure)
    };
    let own = FINGERS.map(|(_, z)| [z - 0.008, z + 0.008]);
    let all = ["Thumb", "Index", "Middle", "Ring", "Pinky"];
    let index = Some("Index2".to_string());
    assert_eq!(found([&known; 2], &glove(&own)), (sorted(&all), index, false));
    // One tube for four fingers: the middle one leads, and the others go along with it.
    let mitten = glove(&[[-0.045, 0.045], own[0]]);
    let middle = Some("Middle2".to_string());
    assert_eq!(found([&known; 2], &mitten), (sorted(&["Thumb", "Middle"]), middle.clone(), false));
    let bag = glove(&[[-0.045, 0.085]]);
    assert_eq!(found([&known; 2], &bag), (sorted(&["Middle"]), middle, false));
    // A cuff ends before the fingers.
    let (names, ..) = found([&known; 2], &tube([0.5, KNUCKLE - 0.02], [-0.05, 0.09]));
    assert_eq!(names, [""; 0]);
    // What only one side knows leads nowhere, which is told where fingers of the garment would stay empty.
    for rigs in [[&known, &without], [&known, &with_hands(&FINGERS[3..])]] {
        let (names, _, unsure) = found(rigs, &glove(&own));
        assert!(unsure && names.len() == 4 * rigs[1].joints.iter().filter(|joint| joint.name.ends_with("1")).count());
    }
    assert_eq!(found([&known, &without], &bag), (Vec::new(), None, false));
    assert_eq!(found([&without, &known], &bag).0, [""; 0]);
}

/// A box around `x` without its lid: from the heel to before the toes, or a tube where it has no bottom either.
fn open_box(x: f64, y: [f64; 2], z: [f64; 2], bottom: bool) -> TriangleMesh {
    let corner = |a: usize, b: usize, c: usize| DVec3::new(x + [-0.05, 0.05][a], y[b], z[c]);
    let positions = (0..8).map(|k| corner(k & 1, (k >> 1) & 1, k >> 2)).collect();
    let quads: &[[u32; 4]] = &[[0, 1, 3, 2], [5, 4, 6, 7], [4, 0, 2, 6], [1, 5, 7, 3], [4, 5, 1, 0]];
    let sides = quads[..if bottom { 5 } else { 4 }].iter();
    TriangleMesh { positions, triangles: sides.flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect() }
}

fn join(meshes: &[TriangleMesh]) -> TriangleMesh {
    let mut joined = TriangleMesh { positions: Vec::new(), triangles: Vec::new() };
    for mesh in meshes {
        let first = joined.positions.len() as u32;
        joined.positions.extend(&mesh.positions);
        joined.triangles.extend(mesh.triangles.iter().map(|t| t.map(|v| v + first)));
    }
    joined
}

/// The sides whose toes the common skeleton has.
fn toes(rigs: [&Rig; 2], mesh: &TriangleMesh, joint: Option<&str>) -> Vec<Side> {
    let [source, target] = rigs;
    let rows = |joint: u32| (0..mesh.positions.len()).map(move |_| vec![(joint, 1.0)]);
    let joint = joint.map(|name| source.joints.iter().position(|j| j.name == name).expect("the joint") as u32);
    let skin = joint.map(|joint| SkinWeights::from_rows(source.joints.len(), rows(joint)));
    let map = JointMap::new(source, target, [source, target].map(|rig| Reading::new(rig, None)), &[]).expect("a map");
    let [from, to] = [source, target].map(|rig| Character { rig, body: None, skin: None });
    let garment = Worn { mesh, skin: skin.as_ref() };
    let common = CommonSkeleton::new(from, to, &map, Some(garment)).expect("they correspond");
    assert_eq!(common.source.bones, common.target.bones);
    let sides = Side::BOTH.into_iter();
    sides.filter(|&side| common.joints.contains(&CommonJoint::Landmark(Landmark::Toes(side)))).collect()
}

#[test]
fn shoes_boots_and_sandals_are_and_trousers_are_not() {
    let (person, without) = (person(true), person(false));
    let shoe = |x| open_box(x, [0.0, 0.09], [-0.05, 0.2], true);
    let shoes = join(&[shoe(0.1), shoe(-0.1)]);
    let boots = join(&[shoes.clone(), open_box(0.1, [0.09, 0.4], [-0.05, 0.05], false)]);
    let trousers = join(&[0.1, -0.1].map(|x| open_box(x, [0.05, 0.95], [-0.06, 0.06], false)));
    // Soles alone: only weights say what they are for.
    let soles = join(&[0.1, -0.1].map(|x| open_box(x, [-0.01, 0.0], [-0.05, 0.2], true)));
    let both = Side::BOTH.to_vec();
    assert_eq!(toes([&person; 2], &shoes, None), both);
    assert_eq!(toes([&person; 2], &boots, Some("LeftLeg")), both);
    assert_eq!(toes([&person; 2], &shoe(0.1), None), [Side::Left]);
    assert_eq!(toes([&person; 2], &trousers, Some("LeftLeg")), []);
    assert_eq!(toes([&person; 2], &trousers, None), []);
    assert_eq!(toes([&person; 2], &soles, None), []);
    assert_eq!(toes([&person; 2], &soles, Some("RightFoot")), [Side::Right]);
    // A foot of which one side knows no end has none.
    assert_eq!(toes([&person, &without], &shoes, None), []);
    assert_eq!(toes([&without, &person], &shoes, None), []);
}

/// The end of a foot is looked for in the body that the rig moves; the farthest of it, not its middle.
#[test]
fn toes_are_within_the_end_of_the_foot() {
    let rig = person(false);
    let foot = rig.joints.iter().position(|joint| joint.name == "LeftFoot").expect("a foot") as u32;
    let mut mesh = open_box(0.1, [0.0, 0.08], [-0.05, 0.2], true);
    // A body has the feet among others.
    let own = mesh.positions.len();
    mesh = join(&[mesh, open_box(0.1, [0.1, 0.9], [-0.05, 0.05], false)]);
    let rows = (0..mesh.positions.len()).map(|v| vec![(if v < own { foot } else { foot - 1 }, 1.0)]);
    let skin = SkinWeights::from_rows(rig.joints.len(), rows);
    let character = Character { rig: &rig, body: Some(&mesh), skin: Some(&skin) };
    let reading = Reading::new(&rig, Some(&skin));
    let order = rig.parents_first("rig").expect("a tree");
    let places = bespoke::rig::places::places(character, &reading, &order);
    let toes = places[index(Landmark::Toes(Side::Left))].expect("toes");
    assert!(toes.z > 0.15 && toes.y > -1e-9 && toes.y < 0.08 && (toes.x - 0.1).abs() < 0.06, "{toes}");
}
