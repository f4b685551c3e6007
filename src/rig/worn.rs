//! What a garment says of the skeleton that it needs: whether it is worn on the feet.

use glam::DVec3;

use super::body_part::Side;
use super::landmark::Landmark;
use super::places::index;
use crate::geometry::mesh::TriangleMesh;
use crate::geometry::section::Section;
use crate::input::skin::SkinWeights;

/// A garment of which so large a share belongs to the feet, by its skin weights, is for them...
const OF_FEET: f64 = 0.5;
/// ... and so large a share to this foot.
const OF_FOOT: f64 = 0.1;
/// Where on the way from ankle to toes a shoe encloses the foot.
const INSTEPS: [f64; 2] = [0.6, 0.9];

/// A garment on the character for which it was made.
#[derive(Clone, Copy)]
pub struct Worn<'a> {
    /// In the space of the rig.
    pub mesh: &'a TriangleMesh,
    /// Which of the rig's joints move each of its vertices, where that is known.
    pub skin: Option<&'a SkinWeights>,
}

impl Worn<'_> {
    /// The feet that it is worn on, as their toes: those that it encloses, as a boot or a sock does, or all that it belongs to by
    /// its weights, as sandals do. `owners` has the landmark of each joint of the rig, `places` where the landmarks are.
    pub fn feet(&self, owners: &[Option<Landmark>], places: &[Option<DVec3>; Landmark::COUNT]) -> Vec<Landmark> {
        let share = |foot: Landmark| {
            let count = self.mesh.positions.len();
            let belongs = |v: &usize| {
                let joint = self.skin.and_then(|skin| skin.dominant_joint(*v));
                joint.is_some_and(|joint| owners[joint as usize] == Some(foot))
            };
            (0..count).filter(belongs).count() as f64 / count.max(1) as f64
        };
        let feet = [Landmark::Toes(Side::Left), Landmark::Toes(Side::Right)];
        let shares = feet.map(share);
        let is_for_feet = shares.iter().sum::<f64>() >= OF_FEET;
        let is_worn = |(foot, share): &(Landmark, f64)| {
            (is_for_feet && *share >= OF_FOOT) || self.encloses(*foot, places).unwrap_or(false)
        };
        feet.into_iter().zip(shares).filter(is_worn).map(|(foot, _)| foot).collect()
    }

    /// Whether all of the foot is within it.
    fn encloses(&self, foot: Landmark, places: &[Option<DVec3>; Landmark::COUNT]) -> Option<bool> {
        let (ankle, toes) = (places[index(foot.parent()?)]?, places[index(foot)]?);
        let inside = |share: f64| {
            let at = ankle.lerp(toes, share);
            Section::cut(self.mesh, at, toes - ankle).encloses(at)
        };
        Some(INSTEPS.into_iter().all(inside))
    }
}
