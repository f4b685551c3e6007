//! Names and numbers as messages of diagnostics have them.

use super::coordinate_system::{AxisTurn, CoordinateSystem};
use super::diagnostic::{AvatarPart, Bone, Element, Subject};
use super::placement::size::RATIOS;

use crate::maths;

/// What helps where a part of the body has to go through cloth.
pub const NO_OPENING: &str =
    "where the garment has no opening for that part, as for a tail or horn, leave it and its bone out, or cut one";

/// The place of a bone with these joints; none is between bones that form a cycle.
pub fn at_bone(joints: Option<[u32; 2]>) -> String {
    match joints {
        Some([a, b]) => format!("at the bone between joints {a} and {b}"),
        None => "between bones that form a cycle".to_string(),
    }
}

/// A bone of a part of the avatar: "bone 3 (joints 3-4)".
pub(super) fn bone_name(bone: Option<Bone>) -> String {
    match bone {
        Some(Bone { index, joints: [a, b] }) => format!("bone {index} (joints {a}-{b})"),
        None => "bones that form a cycle".to_string(),
    }
}

/// A part of the avatar: "the part around bone 3 (joints 3-4)", "the loose piece of 20 triangles around bone 3 (joints 3-4)".
pub(super) fn part_name(part: AvatarPart) -> String {
    match part.loose {
        Some(triangles) => format!("the loose piece of {triangles} triangles around {}", bone_name(part.bone)),
        None => format!("the part around {}", bone_name(part.bone)),
    }
}

/// A triangle of the avatar or of a layer: "avatar triangle 5", "triangle 7 of layer 0".
pub fn avatar_triangle(triangle: Element) -> String {
    match triangle {
        Element { subject: Subject::Layer(layer), index, .. } => format!("triangle {index} of layer {layer}"),
        Element { index, .. } => format!("avatar triangle {index}"),
    }
}

/// An input by its name.
pub(super) fn input(subject: Subject) -> &'static str {
    match subject {
        Subject::Garment => "garment",
        Subject::TargetAvatar => "target avatar",
        Subject::SourceAvatar => "source avatar",
        Subject::SourceSkeleton => "source skeleton",
        Subject::TargetSkeleton => "target skeleton",
        Subject::Layer(_) => "layer",
        Subject::Follower(_) => "follower",
    }
}

/// A name in brackets; nothing where there is none.
pub(super) fn quoted(name: &str) -> String {
    if name.is_empty() { String::new() } else { format!(" (\"{name}\")") }
}

/// A number with four digits and no zeros at its end: "39.37", "100", "0.01".
pub(super) fn short(number: f64) -> String {
    let places = (3 - maths::log10(number.abs()).floor() as i32).max(0) as usize;
    let text = format!("{number:.places$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_string() } else { text }
}

/// A place with four digits in its largest coordinate: "(0.25, -1.75, 0)".
pub(super) fn point(place: [f64; 3]) -> String {
    let largest = place.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
    let places = if largest > 0.0 { (3 - maths::log10(largest).floor() as i32).clamp(0, 12) as usize } else { 0 };
    let [x, y, z] = place.map(|x| {
        let text = format!("{x:.places$}");
        let short = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
        if short == "-0" { "0".to_string() } else { short.to_string() }
    });
    format!("({x}, {y}, {z})")
}

/// Which units have this ratio.
pub(super) fn units(ratio: f64) -> String {
    let names = [
        "an inch is in centimetres",
        "a metre is in feet",
        "a decimetre is in centimetres",
        "a foot is in inches",
        "an inch is in millimetres",
        "a foot is in centimetres",
        "a metre is in inches",
        "a metre is in centimetres",
        "a metre is in millimetres",
    ];
    let known = RATIOS.iter().position(|r| (ratio / r - 1.0).abs() < 1e-6);
    known.map_or(String::new(), |k| format!(" (as where {})", names[k]))
}

/// "180 degrees about y", "90 degrees about -x", "120 degrees about (1, 1, 1)".
pub(super) fn turned(turn: AxisTurn) -> String {
    let axis = match turn.axis() {
        [1, 0, 0] => "x".to_string(),
        [0, 1, 0] => "y".to_string(),
        [0, 0, 1] => "z".to_string(),
        [-1, 0, 0] => "-x".to_string(),
        [0, -1, 0] => "-y".to_string(),
        [0, 0, -1] => "-z".to_string(),
        [x, y, z] => format!("({x}, {y}, {z})"),
    };
    format!("{} degrees about {axis}", turn.degrees())
}

/// The axes of a coordinate system, in words.
pub(super) fn axes(system: &CoordinateSystem) -> String {
    format!("right {}, up {}, forward {}", system.right.name(), system.up.name(), system.forward.name())
}

/// Characters for the triangles of a cap, enough for those of most; a diagnostic's message has room for so many.
const RANGES: usize = 120;

/// Indices, ascending: "0-57, 110-131, 140".
pub(super) fn ranges(indices: &[u32]) -> String {
    let mut text = String::new();
    for run in indices.chunk_by(|a, b| *b == a + 1) {
        let more = match run {
            [first, .., last] => format!("{first}-{last}"),
            [only] => only.to_string(),
            [] => continue,
        };
        if text.len() + more.len() > RANGES {
            return text + ", ...";
        }
        text += if text.is_empty() { "" } else { ", " };
        text += &more;
    }
    text
}

/// "a", "a and b", "a, b and c".
pub(super) fn listed(words: &[&str]) -> String {
    match words {
        [] => String::new(),
        [one] => (*one).to_string(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

/// The bone between two joints, or the joint that both are.
pub(super) fn part([a, b]: [u32; 2]) -> String {
    if a == b { format!("joint {a}") } else { format!("the bone between joints {a} and {b}") }
}
