//! Names and trees that are no rig of a person.

use bespoke::rig::names::{Named, read};
use testing::Random;

use super::check;

fn pick<'a>(random: &mut Random, from: &[&'a str]) -> &'a str {
    from[(random.unit() * from.len() as f64) as usize % from.len()]
}

/// A parent in or out of range, the joint itself, or none.
fn parents(random: &mut Random, count: usize) -> Vec<Option<u32>> {
    let one = |_| (random.unit() < 0.9).then(|| (random.unit() * (count as f64 * 1.05 + 1.0)) as u32);
    (0..count).map(one).collect()
}

const WORDS: &[&str] = &[
    "left",
    "Right",
    "L",
    "r",
    "upper",
    "Arm",
    "arm",
    "leg",
    "UpLeg",
    "hand",
    "wrist",
    "Finger",
    "thumb",
    "index",
    "ring",
    "0",
    "1",
    "02",
    "spine",
    "Spine",
    "chest",
    "hips",
    "pelvis",
    "root",
    "head",
    "Neck",
    "eye",
    "jaw",
    "toe",
    "ball",
    "foot",
    "ankle",
    "knee",
    "hip",
    "shoulder",
    "collar",
    "clavicle",
    "twist",
    "ik",
    "DEF",
    "ORG",
    "end",
    "metacarpal",
    "左",
    "腕",
    "足",
    "ＩＫ",
    "Bip01",
    "CC_Base",
    "mixamorig:",
    "|",
    ":",
    "#",
    "*",
    "ǁ",
    "palm",
    "proximal",
    "tail",
    "hair",
];

#[test]
fn words_in_any_order() {
    let mut random = Random::new(3);
    for round in 0..300 {
        let count = (random.unit() * 120.0) as usize;
        let mut name = |_| {
            let length = 1 + (random.unit() * 4.0) as usize;
            let separator = pick(&mut random, &["_", ".", "", " "]);
            let words: Vec<&str> = (0..length).map(|_| pick(&mut random, WORDS)).collect();
            words.join(separator)
        };
        let names: Vec<String> = (0..count).map(&mut name).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let mut parents = parents(&mut random, count);
        if round % 7 == 0 {
            parents.truncate(count / 2);
        }
        check(&read(&names, &parents), count);
    }
}

#[test]
fn letters_in_any_order() {
    let mut random = Random::new(5);
    for _ in 0..200 {
        let count = (random.unit() * 60.0) as usize;
        let mut letter = || char::from_u32((random.unit() * if random.unit() < 0.7 { 128.0 } else { 66_000.0 }) as u32);
        let names: Vec<String> = (0..count).map(|k| (0..k % 17).filter_map(|_| letter()).collect()).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        check(&read(&names, &parents(&mut random, count)), count);
    }
}

#[test]
fn nonsense_is_unknown() {
    let names =
        ["", "qwerty", "foo", "Bone", "Bone.001", "node_17", "xyzzy", "a", "42", "Cube", "_", "::", "Zaphod", "blarg"];
    let parents: Vec<Option<u32>> = (0..names.len() as u32).map(|k| k.checked_sub(1)).collect();
    let naming = read(&names, &parents);
    assert_eq!(naming.profile, None);
    for (name, named) in names.iter().zip(&naming.joints) {
        assert_eq!(*named, Named::Unknown, "{name}");
    }
    assert!(read(&[], &[]).joints.is_empty());
}

#[test]
fn strands_stay_what_they_are() {
    let names: Vec<String> = (0..12).map(|k| format!("Hair_{k:02}")).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let parents: Vec<Option<u32>> = (0..12u32).map(|k| k.checked_sub(1)).collect();
    assert!(read(&names, &parents).joints.iter().all(|named| *named == Named::Secondary));
}

/// Ten thousand joints in one chain, all with the same name, and all with different ones.
#[test]
fn many_joints() {
    let parents: Vec<Option<u32>> = (0..10_000u32).map(|k| k.checked_sub(1)).collect();
    let same = vec!["LeftArm"; parents.len()];
    check(&read(&same, &parents), same.len());
    let different: Vec<String> =
        (0..parents.len()).map(|k| format!("hair_{}_strand_{k}", WORDS[k % WORDS.len()])).collect();
    let different: Vec<&str> = different.iter().map(String::as_str).collect();
    check(&read(&different, &parents), different.len());
}
