//! The joints of public rigs, and what each is.
//!
//! A line is a joint or, with `>`, a chain of them; it hangs on the last joint of the line above that is indented less. After
//! `=` stands what the joint is. A line with `*` and all below it stand for both sides. Where each list is from is said in the
//! table of its profile, in `src/rig/names/profiles/`.

use bespoke::rig::body_part::{BodyPart, Finger, Side};
use bespoke::rig::names::Named;

/// A public rig.
pub struct List {
    /// The profile that is to be recognised; several where tables have the same names.
    pub profiles: &'static [&'static str],
    /// How the two sides are written.
    pub sides: [&'static str; 2],
    /// Its joints.
    pub text: &'static str,
}

/// A joint of a rig that is tried.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Joint {
    pub name: String,
    pub parent: Option<usize>,
    /// What it is.
    pub named: Named,
}

impl List {
    /// All joints, parents first.
    pub fn joints(&self) -> Vec<Joint> {
        let lines: Vec<(usize, &str)> = (self.text.lines())
            .filter(|line| !line.trim().is_empty())
            .map(|line| (line.len() - line.trim_start().len(), line.trim()))
            .collect();
        let mut joints = Vec::new();
        // The last joint of each line above, with its indent.
        let mut open: Vec<(usize, usize)> = Vec::new();
        let mut at = 0;
        while at < lines.len() {
            let (indent, text) = lines[at];
            let end = if text.contains('*') {
                (at + 1..lines.len()).find(|&k| lines[k].0 <= indent).unwrap_or(lines.len())
            } else {
                at + 1
            };
            let sides: &[Option<usize>] = if text.contains('*') { &[Some(0), Some(1)] } else { &[None] };
            open.retain(|&(other, _)| other < indent);
            for &side in sides {
                let mut open = open.clone();
                for &(indent, text) in &lines[at..end] {
                    open.retain(|&(other, _)| other < indent);
                    self.add(text, side, open.last().map(|&(_, joint)| joint), &mut joints);
                    open.push((indent, joints.len() - 1));
                }
            }
            open.push((indent, joints.len() - 1));
            at = end;
        }
        joints
    }

    fn add(&self, line: &str, side: Option<usize>, mut parent: Option<usize>, joints: &mut Vec<Joint>) {
        for joint in line.split(" > ") {
            let (name, code) = joint.rsplit_once('=').unwrap_or_else(|| panic!("no = in {line}"));
            let name = side.map_or(name.to_owned(), |side| name.replace('*', self.sides[side]));
            let side = side.map(|side| Side::BOTH[side]);
            joints.push(Joint { name, parent, named: named(code, side) });
            parent = Some(joints.len() - 1);
        }
    }
}

fn named(code: &str, side: Option<Side>) -> Named {
    let sided = || side.unwrap_or_else(|| panic!("{code} without a side"));
    let fingers = [
        ("thumb", Finger::Thumb),
        ("index", Finger::Index),
        ("middle", Finger::Middle),
        ("ring", Finger::Ring),
        ("little", Finger::Little),
    ];
    for (word, finger) in fingers {
        if let Some(segment) = code.strip_prefix(word) {
            let segment = segment.parse().expect("a segment");
            return Named::Part(BodyPart::Finger { side: sided(), finger, segment });
        }
    }
    Named::Part(match code {
        "hips" => BodyPart::Hips,
        "spine" => BodyPart::Spine,
        "neck" => BodyPart::Neck,
        "head" => BodyPart::Head,
        "headtop" => BodyPart::HeadTop,
        "jaw" => BodyPart::Jaw,
        "eye" => BodyPart::Eye(sided()),
        "collar" => BodyPart::Clavicle(sided()),
        "arm" => BodyPart::UpperArm(sided()),
        "elbow" => BodyPart::LowerArm(sided()),
        "hand" => BodyPart::Hand(sided()),
        "leg" => BodyPart::UpperLeg(sided()),
        "knee" => BodyPart::LowerLeg(sided()),
        "foot" => BodyPart::Foot(sided()),
        "toes" => BodyPart::Toes(sided()),
        "toetip" => BodyPart::ToeTip(sided()),
        "twist" => return Named::Twist,
        "control" => return Named::Control,
        "prop" => return Named::Prop,
        "secondary" => return Named::Secondary,
        "unknown" => return Named::Unknown,
        other => panic!("no part of a body: {other}"),
    })
}
