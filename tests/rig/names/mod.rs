//! What joints are, by their names.

mod blender;
mod engines;
mod lists;
mod packs;
mod tools;

use bespoke::rig::names::{Named, Naming, read};
use lists::{Joint, List};

fn all() -> impl Iterator<Item = &'static (&'static str, List)> {
    [engines::ALL, blender::ALL, tools::ALL, packs::ALL].into_iter().flatten()
}

fn reading(joints: &[Joint]) -> Naming {
    let names: Vec<&str> = joints.iter().map(|joint| joint.name.as_str()).collect();
    let parents: Vec<Option<u32>> = joints.iter().map(|joint| joint.parent.map(|parent| parent as u32)).collect();
    read(&names, &parents)
}

/// What was read otherwise than it is, one line a joint.
fn wrong(joints: &[Joint], naming: &Naming) -> Vec<String> {
    let found = naming.joints.iter().zip(&naming.confidence);
    joints
        .iter()
        .zip(found)
        .filter(|(joint, (named, _))| joint.named != **named)
        .map(|(joint, (named, sure))| format!("{}: {named:?} {sure:.2}, not {:?}", joint.name, joint.named))
        .collect()
}

#[test]
fn every_public_list_is_read() {
    let mut report = Vec::new();
    for (name, list) in all() {
        let joints = list.joints();
        let naming = reading(&joints);
        let wrong = wrong(&joints, &naming);
        if !wrong.is_empty() {
            report.push(format!("{name} ({:?}):\n    {}", naming.profile, wrong.join("\n    ")));
        }
        if !naming.profile.is_some_and(|profile| list.profiles.contains(&profile)) {
            report.push(format!("{name}: profile {:?}, not one of {:?}", naming.profile, list.profiles));
        }
        for (joint, sure) in joints.iter().zip(&naming.confidence) {
            if matches!(joint.named, Named::Part(_)) && *sure < 0.6 {
                report.push(format!("{name}: {} is unsure, {sure}", joint.name));
            }
        }
    }
    assert!(report.is_empty(), "{}", report.join("\n"));
}
