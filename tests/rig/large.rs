//! Rigs with thousands of joints, of any form: read and mapped in no time.

use std::time::{Duration, Instant};

use bespoke::error::ErrorKind;
use bespoke::input::rig::{Rig, RigJoint};
use bespoke::input::skin::SkinWeights;
use bespoke::rig::common_skeleton::CommonSkeleton;
use bespoke::rig::joint_map::JointMap;
use bespoke::rig::places::Character;
use bespoke::rig::reading::Reading;
use glam::{DMat4, DVec3};

const COUNT: u32 = 10_000;
/// As many as are read by their structure.
const READ: u32 = 4096;
/// What takes a time in proportion to the square of the joints, for each of them, takes minutes.
const LONGEST: Duration = Duration::from_secs(10);

fn rig(count: u32, name: impl Fn(u32) -> String, parent: impl Fn(u32) -> u32, place: impl Fn(u32) -> DVec3) -> Rig {
    let joint = |j: u32| RigJoint {
        name: name(j),
        parent: (j > 0).then(|| parent(j)),
        bind: DMat4::from_translation(place(j)),
    };
    Rig { joints: (0..count).map(joint).collect() }
}

fn spiral(j: u32) -> DVec3 {
    let angle = f64::from(j);
    DVec3::new(angle.cos(), 1e-3 * f64::from(j), angle.sin())
}

/// The common skeleton of a rig with itself, or the error's kind.
#[track_caller]
fn mapped(what: &str, rig: &Rig) -> Result<usize, ErrorKind> {
    let clock = Instant::now();
    rig.check("source rig").expect("it can be used");
    let skin = SkinWeights::from_rows(rig.joints.len(), (0..rig.joints.len() as u32).map(|j| vec![(j, 1.0)]));
    let readings = [Reading::new(rig, None), Reading::new(rig, Some(&skin))];
    let map = JointMap::new(rig, rig, readings, &[]).expect("a map");
    assert_eq!(map.joints.len(), rig.joints.len());
    let character = Character { rig, body: None, skin: None };
    let common = CommonSkeleton::new(character, character, &map, None);
    let took = clock.elapsed();
    println!("{what}: {took:?}");
    assert!(took < LONGEST, "{what} takes {took:?}");
    common.map(|common| common.joints.len()).map_err(|error| {
        assert!(error.message.len() > 20, "{error}");
        error.kind
    })
}

#[test]
fn rigs_of_any_form_are_mapped_in_no_time() {
    let unnamed = |_: u32| String::new();
    type Form = (&'static str, fn(u32) -> u32);
    let forms: [Form; 5] = [
        ("a star", |_| 0),
        ("a chain", |j| j - 1),
        ("a comb", |j| if j % 3 == 0 { j - 3 } else { j / 3 * 3 }),
        ("a tree of two", |j| (j - 1) / 2),
        ("two stars", |j| if j < 3000 { 0 } else { 1 }),
    ];
    for (form, parent) in forms {
        for count in [READ, COUNT] {
            let _ = mapped(&format!("{form} of {count}"), &rig(count, unnamed, parent, spiral));
            let _ = mapped(&format!("{form} of {count} in one place"), &rig(count, unnamed, parent, |_| DVec3::ONE));
        }
        for word in ["Spine", "Neck", "LeftArm", "LeftHandIndex1", "ik_target", "x"] {
            let _ = mapped(&format!("{form} of {word}"), &rig(COUNT, |_| word.to_owned(), parent, spiral));
        }
    }
}

#[test]
fn too_many_joints_that_correspond_are_told() {
    let named = |count: u32| rig(count, |j| format!("thing_{}", letters(j)), |j| j - 1, spiral);
    assert_eq!(mapped("names of their own", &named(COUNT)), Err(ErrorKind::InvalidSkeleton));
    assert_eq!(mapped("fewer names of their own", &named(300)), Ok(300));
}

/// A word for each number, without digits.
fn letters(mut j: u32) -> String {
    let mut word = String::new();
    for _ in 0..4 {
        word.push(char::from(b'q' + (j % 10) as u8));
        j /= 10;
    }
    word
}
