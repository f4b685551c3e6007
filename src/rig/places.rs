//! Where the landmarks of a person are: at the joints of the rig, and for what rigs have no joint for, in the body.

use glam::DVec3;

use super::body_part::{BodyPart, Side};
use super::landmark::Landmark;
use super::reading::Reading;
use crate::geometry::mesh::TriangleMesh;
use crate::input::rig::Rig;
use crate::input::skin::SkinWeights;

/// Where the waist is between pelvis and neck.
const WAIST: f64 = 0.3;
/// A neck without a joint is so far from the shoulders to where the head begins.
const NECK: f64 = 0.7;
/// The top of the head is so far up the head: inside.
const HEAD_TOP: f64 = 0.96;
/// A head of which nothing is known is so long in lengths of the trunk; mean of 12 bodies.
const HEAD: f64 = 0.45;
/// How far from elbow to fingertips a wrist is, and from knee to sole an ankle.
const WRIST: f64 = 0.6;
const ANKLE: f64 = 0.86;
/// What is nearer to the tip of a foot than this, in lengths of the foot, belongs to the toes.
const TOES: f64 = 0.25;
/// A joint of the hips that is farther from the middle between the legs than this, in lengths of the trunk, stands elsewhere, such as
/// on the floor.
const STRAY_HIPS: f64 = 0.6;
/// And one that is farther below it than this.
const LOW_HIPS: f64 = 0.04;

/// A rig with the body that it moves, as far as that is known.
#[derive(Clone, Copy)]
pub struct Character<'a> {
    /// The rig.
    pub rig: &'a Rig,
    /// The body.
    pub body: Option<&'a TriangleMesh>,
    /// Which of the rig's joints move each of its vertices.
    pub skin: Option<&'a SkinWeights>,
}

/// The landmark that each joint of a rig belongs to: its own, or that of the first joint above that has one.
pub fn owners(rig: &Rig, reading: &Reading, order: &[u32]) -> Vec<Option<Landmark>> {
    let mut owners = vec![None; rig.joints.len()];
    for &joint in order {
        let above = rig.joints[joint as usize].parent.and_then(|parent| owners[parent as usize]);
        owners[joint as usize] = reading.part(joint).map(Landmark::of).or(above);
    }
    owners
}

/// The places of the landmarks of `character`, in the order of [`Landmark::ALL`].
pub fn places(character: Character<'_>, reading: &Reading, order: &[u32]) -> [Option<DVec3>; Landmark::COUNT] {
    let at = |part: BodyPart| reading.joint_of(part).map(|joint| character.rig.place(joint));
    let middle = |part: fn(Side) -> BodyPart| Some(0.5 * (at(part(Side::Left))? + at(part(Side::Right))?));
    let (hips, shoulders) = (middle(BodyPart::UpperLeg), middle(BodyPart::UpperArm));
    let neck = neck(character.rig, reading, shoulders);
    let pelvis = match (at(BodyPart::Hips), hips) {
        (Some(joint), Some(hips)) if neck.is_some_and(|neck| is_stray(joint, hips, neck)) => Some(hips),
        (joint, hips) => joint.or(hips),
    };
    let mut places = Landmark::ALL.map(|landmark| landmark.part().and_then(at));
    let set =
        |places: &mut [Option<DVec3>; Landmark::COUNT], landmark: Landmark, place| places[index(landmark)] = place;
    set(&mut places, Landmark::Pelvis, pelvis);
    set(&mut places, Landmark::Neck, neck);
    if let (Some(pelvis), Some(neck)) = (pelvis, neck) {
        let spine = reading.joints_of(BodyPart::Spine).map(|joint| character.rig.place(joint));
        set(&mut places, Landmark::Waist, Some(waist(pelvis, neck, spine.collect())));
    }
    let flesh = Flesh { character, owners: owners(character.rig, reading, order), reading };
    if places[index(Landmark::HeadTop)].is_none()
        && let (Some(pelvis), Some(neck)) = (pelvis, neck)
    {
        set(&mut places, Landmark::HeadTop, Some(flesh.head_top(pelvis, neck)));
    }
    for landmark in Landmark::ALL {
        let share = match landmark {
            Landmark::Wrist(_) => WRIST,
            Landmark::Ankle(_) => ANKLE,
            _ => continue,
        };
        if places[index(landmark)].is_none()
            && let Some(before) = landmark.parent()
            && let Some(from) = places[index(before)]
        {
            set(&mut places, landmark, flesh.end(before, from, share));
        }
    }
    for side in [Side::Left, Side::Right] {
        if let Some(ankle) = places[index(Landmark::Ankle(side))] {
            let joint = at(BodyPart::ToeTip(side)).or_else(|| at(BodyPart::Toes(side)));
            set(&mut places, Landmark::Toes(side), flesh.toes(side, ankle).or(joint));
        }
    }
    places
}

/// Whether the joint of the hips is no place for the pelvis: below the legs' joints, between the legs, or far away, as on the
/// floor.
fn is_stray(joint: DVec3, hips: DVec3, neck: DVec3) -> bool {
    let trunk = neck - hips;
    joint.distance(hips) > STRAY_HIPS * trunk.length() || (joint - hips).dot(trunk) < -LOW_HIPS * trunk.length_squared()
}

/// The place of a landmark in [`Landmark::ALL`].
pub fn index(landmark: Landmark) -> usize {
    Landmark::ALL.iter().position(|&other| other == landmark).unwrap_or_default()
}

/// Where the trunk ends: at the joint of the neck, the first of several, or between shoulders and head.
fn neck(rig: &Rig, reading: &Reading, shoulders: Option<DVec3>) -> Option<DVec3> {
    let at = |part: BodyPart| reading.joint_of(part).map(|joint| rig.place(joint));
    let head = at(BodyPart::Head);
    let from_head = |p: &DVec3| head.map_or(0.0, |head| p.distance(head));
    let necks = reading.joints_of(BodyPart::Neck).map(|joint| rig.place(joint));
    let lowest = necks.max_by(|a, b| from_head(a).total_cmp(&from_head(b)));
    lowest.or_else(|| match (shoulders, head) {
        (Some(shoulders), Some(head)) => Some(shoulders.lerp(head, NECK)),
        (shoulders, head) => shoulders.or(head),
    })
}

/// The point on the way from pelvis to neck, along the joints of the spine, that is the waist.
fn waist(pelvis: DVec3, neck: DVec3, mut spine: Vec<DVec3>) -> DVec3 {
    let along = neck - pelvis;
    let height = |p: &DVec3| (*p - pelvis).dot(along);
    spine.retain(|p| height(p) > 0.0 && height(p) < along.length_squared());
    spine.sort_by(|a, b| height(a).total_cmp(&height(b)));
    let way: Vec<DVec3> = std::iter::once(pelvis).chain(spine).chain([neck]).collect();
    let total: f64 = way.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
    let mut left = WAIST * total;
    for pair in way.windows(2) {
        let length = pair[0].distance(pair[1]);
        if length >= left && length > 0.0 {
            return pair[0].lerp(pair[1], left / length);
        }
        left -= length;
    }
    pelvis
}

/// The vertices of a body by the landmarks that they belong to.
struct Flesh<'a> {
    character: Character<'a>,
    owners: Vec<Option<Landmark>>,
    reading: &'a Reading,
}

impl Flesh<'_> {
    /// The vertices that triangles use, each with the joint that moves it most.
    fn vertices(&self) -> impl Iterator<Item = (DVec3, Option<u32>)> + '_ {
        let skin = self.character.skin;
        self.character.body.into_iter().flat_map(move |body| {
            let used = body.used_vertices();
            let joint = move |vertex: usize| skin.and_then(|skin| skin.dominant_joint(vertex));
            body.positions.iter().enumerate().filter(move |(vertex, _)| used[*vertex]).map(move |(v, &p)| (p, joint(v)))
        })
    }

    /// The area around each of these vertices.
    fn areas(&self) -> Vec<f64> {
        let Some(body) = self.character.body else { return Vec::new() };
        let used = body.used_vertices();
        body.vertex_areas().into_iter().zip(used).filter(|(_, used)| *used).map(|(area, _)| area).collect()
    }

    /// The top of the head, along the way from the neck to the middle of the surface that belongs to it: of the vertices most may be
    /// in the face.
    fn head_top(&self, pelvis: DVec3, neck: DVec3) -> DVec3 {
        let trunk = neck - pelvis;
        let up = trunk.normalize_or_zero();
        let is_head = |p: DVec3, joint: Option<u32>| match joint {
            Some(joint) => {
                self.owners[joint as usize] == Some(Landmark::HeadTop)
                    && self.reading.part(joint) != Some(BodyPart::Neck)
            }
            // Without weights: above the neck, and not far beside it.
            None => {
                let from = p - neck;
                let height = from.dot(up);
                height > 0.0 && (from - height * up).length() < 0.5 * trunk.length()
            }
        };
        let mut areas = self.areas().into_iter();
        let of_head: Vec<(DVec3, f64)> = self
            .vertices()
            .map(|(p, joint)| (p, joint, areas.next().unwrap_or_default()))
            .filter(|&(p, joint, _)| is_head(p, joint))
            .map(|(p, _, area)| (p, area))
            .collect();
        let head = self.reading.joint_of(BodyPart::Head).map(|joint| self.character.rig.place(joint));
        let direction = if of_head.is_empty() {
            head.map_or(up, |head| (head - neck).normalize_or(up))
        } else {
            let total = of_head.iter().map(|(_, area)| area).sum::<f64>().max(f64::MIN_POSITIVE);
            let middle = of_head.iter().map(|&(p, area)| area * p).sum::<DVec3>() / total;
            (middle - neck).normalize_or(up)
        };
        let reach = of_head.iter().map(|&(p, _)| (p - neck).dot(direction)).fold(0.0, f64::max);
        let reach = if reach > 0.0 { HEAD_TOP * reach } else { HEAD * trunk.length() };
        neck + reach * direction
    }

    /// A joint that the rig does not have, `share` of the way from the joint before it to where its limb ends.
    fn end(&self, before: Landmark, from: DVec3, share: f64) -> Option<DVec3> {
        let belongs = |joint: Option<u32>| joint.is_some_and(|joint| self.owners[joint as usize] == Some(before));
        let own: Vec<DVec3> = self.vertices().filter(|&(_, joint)| belongs(joint)).map(|(p, _)| p).collect();
        let middle = own.iter().sum::<DVec3>() / own.len().max(1) as f64;
        let direction = (middle - from).try_normalize().filter(|_| !own.is_empty())?;
        let reach = own.iter().map(|&p| (p - from).dot(direction)).fold(0.0, f64::max);
        (reach > 0.0).then(|| from + share * reach * direction)
    }

    /// Within the toes: the middle of what is near to the farthest point of the foot from `ankle`.
    fn toes(&self, side: Side, ankle: DVec3) -> Option<DVec3> {
        let belongs = |joint: Option<u32>| joint.is_some_and(|j| self.owners[j as usize] == Some(Landmark::Toes(side)));
        let foot: Vec<DVec3> = self.vertices().filter(|&(_, joint)| belongs(joint)).map(|(p, _)| p).collect();
        let farther = |a: &&DVec3, b: &&DVec3| a.distance(ankle).total_cmp(&b.distance(ankle));
        let tip = *foot.iter().max_by(farther)?;
        let near: Vec<DVec3> = foot.into_iter().filter(|p| p.distance(tip) <= TOES * tip.distance(ankle)).collect();
        Some(near.iter().sum::<DVec3>() / near.len() as f64)
    }
}
