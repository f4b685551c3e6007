//! What joints are, by their names.

mod adversarial;
mod blender;
mod changes;
mod characters;
mod engines;
mod lists;
mod packs;
mod plain;
mod tools;

use bespoke::rig::body_part::{BodyPart, Side};
use bespoke::rig::names::{Named, Naming, read};
use lists::{Joint, List};
use testing::Random;

/// What is less sure than this may be wrong.
const SURE: f64 = 0.6;

fn all() -> impl Iterator<Item = &'static (&'static str, List)> {
    [engines::ALL, blender::ALL, tools::ALL, packs::ALL].into_iter().flatten()
}

fn reading(joints: &[Joint]) -> Naming {
    let names: Vec<&str> = joints.iter().map(|joint| joint.name.as_str()).collect();
    let parents: Vec<Option<u32>> = joints.iter().map(|joint| joint.parent.map(|parent| parent as u32)).collect();
    let naming = read(&names, &parents);
    check(&naming, names.len());
    naming
}

/// What holds whatever the names are.
fn check(naming: &Naming, count: usize) {
    assert_eq!((naming.joints.len(), naming.confidence.len()), (count, count));
    let mut parts: Vec<BodyPart> = Vec::new();
    for (named, &sure) in naming.joints.iter().zip(&naming.confidence) {
        assert!((0.0..=1.0).contains(&sure) && (sure == 0.0) == (*named == Named::Unknown), "{named:?} {sure}");
        if let Named::Part(part) = *named {
            assert!(part.is_repeated() || !parts.contains(&part), "{part:?} twice");
            assert!(!matches!(part, BodyPart::Finger { segment: 5.., .. }), "{part:?}");
            parts.push(part);
        }
    }
}

/// What was read otherwise than it is and taken for sure, one line a joint.
fn wrong(joints: &[Joint], naming: &Naming) -> Vec<String> {
    let found = naming.joints.iter().zip(&naming.confidence);
    joints
        .iter()
        .zip(found)
        .filter(|(joint, (named, sure))| joint.named != **named && **sure >= SURE)
        .map(|(joint, (named, sure))| format!("{}: {named:?} {sure:.2}, not {:?}", joint.name, joint.named))
        .collect()
}

/// Parts that were not found for sure.
fn unsure(joints: &[Joint], naming: &Naming) -> Vec<String> {
    let found = naming.joints.iter().zip(&naming.confidence);
    joints
        .iter()
        .zip(found)
        .filter(|(joint, (named, sure))| {
            matches!(joint.named, Named::Part(_)) && (joint.named != **named || **sure < SURE)
        })
        .map(|(joint, (named, sure))| format!("{}: {named:?} {sure:.2}", joint.name))
        .collect()
}

/// What was tried and what came of it.
#[derive(Default)]
struct Report {
    lines: Vec<String>,
}

impl Report {
    /// Nothing may be wrong, nor any part unsure.
    fn right(&mut self, what: &str, joints: &[Joint]) -> Naming {
        let naming = reading(joints);
        let mut lines = wrong(joints, &naming);
        lines.extend(unsure(joints, &naming).into_iter().map(|line| format!("unsure: {line}")));
        self.add(what, &naming, lines);
        naming
    }

    /// Nothing may be wrong; so many parts may be unsure.
    fn not_wrong(&mut self, what: &str, joints: &[Joint], unsure_at_most: usize) {
        let naming = reading(joints);
        let mut lines = wrong(joints, &naming);
        let unsure = unsure(joints, &naming);
        if unsure.len() > unsure_at_most {
            lines.extend(unsure.into_iter().map(|line| format!("unsure: {line}")));
        }
        self.add(what, &naming, lines);
    }

    fn add(&mut self, what: &str, naming: &Naming, lines: Vec<String>) {
        if !lines.is_empty() {
            self.lines.push(format!("{what} ({:?}):\n    {}", naming.profile, lines.join("\n    ")));
        }
    }

    fn end(self) {
        assert!(self.lines.is_empty(), "{} of the cases:\n{}", self.lines.len(), self.lines.join("\n"));
    }
}

#[test]
fn public_lists() {
    let mut report = Report::default();
    for (name, list) in all() {
        let joints = list.joints();
        let naming = report.right(name, &joints);
        // All that is no part of the body is known too.
        let others = joints.iter().zip(&naming.joints).filter(|(joint, named)| joint.named != **named);
        report.lines.extend(others.map(|(joint, named)| format!("{name}: {} is {named:?}", joint.name)));
        if !naming.profile.is_some_and(|profile| list.profiles.contains(&profile)) {
            report.lines.push(format!("{name}: profile {:?}, not one of {:?}", naming.profile, list.profiles));
        }
    }
    report.end();
}

#[test]
fn in_any_order() {
    let mut report = Report::default();
    let mut random = Random::new(7);
    for (name, list) in all() {
        let joints = list.joints();
        report.right(&format!("{name}, backwards"), &changes::backwards(&joints));
        for _ in 0..3 {
            report.right(&format!("{name}, shuffled"), &changes::shuffled(&joints, &mut random));
        }
    }
    report.end();
}

#[test]
fn with_doubles() {
    let mut report = Report::default();
    let mut random = Random::new(11);
    for (name, list) in all() {
        // A foot that hangs on the root is no better than its double.
        let joints = list.joints();
        if joints.iter().any(|joint| joint.name == "PoleTarget.L") {
            continue;
        }
        let doubled = changes::shuffled(&changes::doubled(&joints), &mut random);
        report.right(&format!("{name}, doubled"), &doubled);
    }
    report.end();
}

#[test]
fn with_prefixes_and_suffixes() {
    let mut report = Report::default();
    let affixes = [
        ("Armature|", ""),
        ("scene:hero:", "_01"),
        ("Hero_", ""),
        ("char01_", ".001"),
        ("SK_Knight_", "_jnt"),
        ("npc.", "_JNT_001"),
        ("Bow_", ""),
        ("", "_skin"),
        ("", ".001"),
    ];
    for (name, list) in all() {
        let joints = list.joints();
        for (before, behind) in affixes {
            let changed = changes::renamed(&joints, |_, name| format!("{before}{name}{behind}"));
            report.right(&format!("{name}, {before}*{behind}"), &changed);
        }
        // As viewers write them, who number all nodes.
        let changed = changes::renamed(&joints, |index, name| format!("{name}_{index:02}"));
        report.right(&format!("{name}, numbered"), &changed);
    }
    report.end();
}

#[test]
fn with_sides_in_another_form() {
    let mut report = Report::default();
    for (name, list) in all().filter(|(_, list)| list.sides[0].is_ascii()) {
        // A small letter behind a small letter is no word of its own.
        let is_glued = list.text.as_bytes().windows(2).any(|pair| pair[0].is_ascii_lowercase() && pair[1] == b'*');
        for sides in [["L", "R"], ["l", "r"], ["Left", "Right"], ["left", "right"]] {
            if is_glued && sides[0].starts_with('l') {
                continue;
            }
            let other = List { sides, profiles: list.profiles, text: list.text };
            report.right(&format!("{name}, {sides:?}"), &other.joints());
        }
    }
    report.end();
}

#[test]
fn with_other_separators() {
    let mut report = Report::default();
    for (name, list) in all() {
        let joints = list.joints();
        for (separator, place) in [("_", "."), (".", "_"), (" ", "_"), ("_", " "), ("_", "-")] {
            let changed = changes::renamed(&joints, |_, name| name.replace(separator, place));
            report.right(&format!("{name}, '{separator}' as '{place}'"), &changed);
        }
        // Where case alone tells words apart, much is lost.
        let changed = changes::renamed(&joints, |_, name| name.to_lowercase());
        report.not_wrong(&format!("{name}, in lower case"), &changed, joints.len());
    }
    report.end();
}

#[test]
fn with_fewer_joints() {
    use BodyPart::{Clavicle, Finger, Foot, Hand, Head, HeadTop, Hips, Neck, Spine, ToeTip, Toes};
    type Leaves = fn(BodyPart) -> bool;
    let cases: [(&str, Leaves); 10] = [
        ("fingers", |part| matches!(part, Finger { .. })),
        (
            "three fingers",
            |part| matches!(part, Finger { finger, .. } if finger > bespoke::rig::body_part::Finger::Index),
        ),
        ("fingertips", |part| matches!(part, Finger { segment: 3.., .. })),
        ("collar bones", |part| matches!(part, Clavicle(_))),
        ("necks", |part| part == Neck),
        ("ends", |part| matches!(part, HeadTop | ToeTip(_) | Finger { segment: 4, .. })),
        ("toes", |part| matches!(part, Toes(_) | ToeTip(_))),
        ("hands", |part| matches!(part, Hand(_) | Finger { .. })),
        ("feet", |part| matches!(part, Foot(_) | Toes(_) | ToeTip(_))),
        ("head and spine", |part| matches!(part, Head | HeadTop | Neck | Spine | Hips)),
    ];
    let mut report = Report::default();
    for (name, list) in all() {
        let joints = list.joints();
        for (what, leaves) in cases {
            let fewer = changes::without(&joints, |_, joint| matches!(joint.named, Named::Part(part) if leaves(part)));
            report.not_wrong(&format!("{name}, without {what}"), &fewer, 4);
        }
        let helpers = changes::without(&joints, |_, joint| !matches!(joint.named, Named::Part(_)));
        report.right(&format!("{name}, without helpers"), &helpers);
        let left = changes::without(
            &joints,
            |_, joint| matches!(joint.named, Named::Part(part) if part.side() == Some(Side::Right)),
        );
        report.not_wrong(&format!("{name}, without the right side"), &left, 2);
    }
    report.end();
}

#[test]
fn with_one_to_six_spines() {
    let mut report = Report::default();
    let mut more = 0;
    for (name, list) in all() {
        let joints = list.joints();
        for count in 1..=6 {
            let Some(changed) = changes::with_spines(&joints, count) else { continue };
            more += usize::from(changed.len() > joints.len());
            report.right(&format!("{name}, {count} spines"), &changed);
        }
    }
    assert!(more > 30, "only {more} cases with more joints in the spine");
    report.end();
}
