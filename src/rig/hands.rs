//! The fingers that a garment is worn on, and the joints of both rigs that lead through them.
//!
//! Gloves have a tube for each finger, mittens one for several of them; sleeves have none, and then no finger is a bone. One finger
//! of each tube is enough to lead through it, the longest that both rigs know, and the others go along with it.

use glam::DVec3;

use super::body_part::{BodyPart, Finger, Side};
use super::places::Character;
use super::reading::Reading;
use crate::geometry::closest_point::{closest_on_segment, ray_triangle};
use crate::geometry::mesh::TriangleMesh;
use crate::geometry::section::Section;

/// All fingers, the one first that stands for several of them.
const FINGERS: [Finger; 5] = [Finger::Middle, Finger::Index, Finger::Ring, Finger::Little, Finger::Thumb];
/// The bones of a finger that are free, and its tip.
const FREE: [u8; 3] = [1, 2, 3];
const TIP: u8 = 4;
/// A tip of which nothing is known is so far beyond the last joint, in lengths of the bone before it.
const BEYOND: f64 = 0.8;
/// What is nearer to the farthest point of a finger than this, in distances of that from the last joint, belongs to its tip.
const NEAR: f64 = 0.25;

/// A finger that leads through the garment.
#[derive(Clone, Debug, PartialEq)]
pub struct WornFinger {
    /// Of which hand.
    pub side: Side,
    /// Joints of the source rig and of the target rig, from the knuckle on.
    pub joints: Vec<[u32; 2]>,
    /// Its tip in source and target.
    pub tips: [DVec3; 2],
    /// Joints of the target's other fingers in the same tube, each with the one in `joints` that it goes along with.
    pub others: Vec<(u32, usize)>,
}

/// The fingers that `garment` is worn on by the source, and whether it has tubes for fingers that the two rigs do not both know.
pub fn worn_fingers(
    garment: &TriangleMesh,
    [source, target]: [Character<'_>; 2],
    readings: &[Reading; 2],
) -> (Vec<WornFinger>, bool) {
    let (mut found, mut lost) = (Vec::new(), false);
    for side in Side::BOTH {
        let lines: Vec<Option<Line>> = FINGERS
            .iter()
            .map(|&finger| Line::new(source, &readings[0], side, finger).filter(|line| line.is_worn(garment)))
            .collect();
        let tubes = tubes(&lines, garment);
        for tube in &tubes {
            let fingers = || tube.iter().map(|&k| FINGERS[k]);
            let Some(leading) = fingers().find(|&finger| !common(readings, side, finger).is_empty()) else {
                // A single tube is a mitten, into which a hand without fingers goes as well.
                lost |= tubes.len() > 1;
                continue;
            };
            let segments = common(readings, side, leading);
            let at = |reading: &Reading, finger, segment| joint(reading, side, finger, segment);
            let joints: Vec<[u32; 2]> = segments
                .iter()
                .filter_map(|&segment| Some([at(&readings[0], leading, segment)?, at(&readings[1], leading, segment)?]))
                .collect();
            let along = |finger: Finger| {
                let of = move |segment: u8| at(&readings[1], finger, segment).map(|joint| (joint, segment));
                FREE.into_iter().filter_map(of)
            };
            let place = |segment: u8| segments.iter().rposition(|&known| known <= segment).unwrap_or(0);
            let others = fingers().filter(|&finger| finger != leading).flat_map(along);
            let others = others.map(|(joint, segment)| (joint, place(segment))).collect();
            let tip = |character, reading| Line::new(character, reading, side, leading).map(|line| line.tip());
            let (Some(from), Some(to)) = (tip(source, &readings[0]), tip(target, &readings[1])) else { continue };
            found.push(WornFinger { side, joints, tips: [from, to], others });
        }
    }
    (found, lost)
}

fn joint(reading: &Reading, side: Side, finger: Finger, segment: u8) -> Option<u32> {
    reading.joint_of(BodyPart::Finger { side, finger, segment })
}

/// The free bones of a finger that both rigs have.
fn common(readings: &[Reading; 2], side: Side, finger: Finger) -> Vec<u8> {
    let has = |segment: &u8| readings.iter().all(|reading| joint(reading, side, finger, *segment).is_some());
    FREE.into_iter().filter(has).collect()
}

/// Those of the worn fingers that are in one tube, tube by tube; the first of each leads.
fn tubes(lines: &[Option<Line>], garment: &TriangleMesh) -> Vec<Vec<usize>> {
    let mut tubes: Vec<Vec<usize>> = Vec::new();
    for (k, line) in lines.iter().enumerate() {
        let Some(line) = line else { continue };
        let is_with = |other: &usize| lines[*other].as_ref().is_some_and(|other| !line.is_apart(other, garment));
        let (with, mut apart): (Vec<_>, Vec<_>) = tubes.into_iter().partition(|tube| tube.iter().any(is_with));
        apart.push(with.into_iter().flatten().chain([k]).collect());
        tubes = apart;
    }
    tubes
}

/// A finger from the knuckle to the tip.
struct Line(Vec<DVec3>);

impl Line {
    /// None without a joint.
    fn new(character: Character<'_>, reading: &Reading, side: Side, finger: Finger) -> Option<Self> {
        let joints: Vec<u32> = FREE.iter().filter_map(|&segment| joint(reading, side, finger, segment)).collect();
        let mut line: Vec<DVec3> = joints.iter().map(|&joint| character.rig.place(joint)).collect();
        let (&last, &end) = (joints.last()?, line.last()?);
        let before = match line.len() {
            1 => reading.joint_of(BodyPart::Hand(side)).map_or(end, |hand| character.rig.place(hand)),
            count => line[count - 2],
        };
        let tip = joint(reading, side, finger, TIP).map(|joint| character.rig.place(joint));
        let tip = tip.or_else(|| end_of(character, last, end));
        line.push(tip.unwrap_or(end + BEYOND * (end - before)));
        Some(Self(line))
    }

    fn tip(&self) -> DVec3 {
        self.0[self.0.len() - 1]
    }

    fn bones(&self) -> impl Iterator<Item = [DVec3; 2]> + '_ {
        self.0.windows(2).map(|pair| [pair[0], pair[1]])
    }

    /// The middles of its bones, as far as the garment is around them.
    fn inside<'a>(&'a self, garment: &'a TriangleMesh) -> impl Iterator<Item = DVec3> + 'a {
        self.bones().filter(|&bone| is_around(garment, bone)).map(|[a, b]| a.midpoint(b))
    }

    /// Whether the garment is around its first bone.
    fn is_worn(&self, garment: &TriangleMesh) -> bool {
        self.bones().next().is_some_and(|bone| is_around(garment, bone))
    }

    /// Whether cloth is somewhere between it and another one, inside of the garment.
    fn is_apart(&self, other: &Self, garment: &TriangleMesh) -> bool {
        let is_between = |p: DVec3, q: DVec3| {
            let meets = |t: u32| ray_triangle(p, q - p, &garment.corners(t)).is_some_and(|along| along <= 1.0);
            (0..garment.triangles.len() as u32).any(meets)
        };
        let nearest = |p: DVec3| {
            let on = other.bones().map(|[a, b]| closest_on_segment(p, a, b - a));
            on.min_by(|a, b| a.distance_squared(p).total_cmp(&b.distance_squared(p)))
        };
        self.inside(garment).any(|p| nearest(p).is_some_and(|q| is_between(p, q)))
    }
}

/// Whether the garment is around the middle of a bone.
fn is_around(garment: &TriangleMesh, [a, b]: [DVec3; 2]) -> bool {
    Section::cut(garment, a.midpoint(b), b - a).encloses(a.midpoint(b))
}

/// Within the end of what a joint at `place` moves: the middle of what is near to the farthest point of it.
fn end_of(character: Character<'_>, joint: u32, place: DVec3) -> Option<DVec3> {
    let (body, skin) = (character.body?, character.skin?);
    let own = (0..body.positions.len()).filter(|&v| skin.dominant_joint(v) == Some(joint)).map(|v| body.positions[v]);
    let own: Vec<DVec3> = own.collect();
    let farthest = *own.iter().max_by(|a, b| a.distance(place).total_cmp(&b.distance(place)))?;
    let is_near = |p: &&DVec3| p.distance(farthest) <= NEAR * farthest.distance(place);
    let near: Vec<DVec3> = own.iter().filter(is_near).copied().collect();
    Some(near.iter().sum::<DVec3>() / near.len() as f64)
}
