//! The source skeleton as a wire: bent where its bones would pass through the garment.

use glam::DVec3;

use super::projection::{ProjectedAvatar, subdivide};
use crate::geometry::mesh::TriangleMesh;
use crate::input::skeleton::{BoneGraph, Location, Skeleton};

/// A place on a bone, as in [`Skeleton::point_at`], that the wire holds at a point of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Knot {
    /// Where along the bone; not 0 or 1, which are joints.
    pub parameter: f64,
    /// Where it is held.
    pub position: DVec3,
}

/// The wire is a skeleton in itself: the source's joints, which may have moved, then the knots; and each bone in as many
/// parts as its knots leave.
pub struct Wire {
    /// The wire.
    pub skeleton: Skeleton,
    /// The bone of the source that each part belongs to.
    owners: Vec<u32>,
    /// First part of each bone of the source.
    first: Vec<u32>,
    /// The parameters at which the parts of each bone begin and end; none where the bone is cut.
    breaks: Vec<Vec<f64>>,
    bones: Vec<[u32; 2]>,
}

impl Wire {
    /// The wire with the source's joints at `joints` and with `knots` on each bone. A bone that is `cut` is left out: what
    /// is on it belongs to the nearer of its joints.
    pub fn new(source: &Skeleton, joints: &[DVec3], knots: &[Vec<Knot>], cut: &[bool]) -> Self {
        let mut wire = Self {
            skeleton: Skeleton { joints: joints.to_vec(), bones: Vec::new() },
            owners: Vec::new(),
            first: Vec::new(),
            breaks: Vec::new(),
            bones: source.bones.clone(),
        };
        for (bone, &[a, b]) in source.bones.iter().enumerate() {
            wire.first.push(wire.owners.len() as u32);
            let mut stops = Vec::new();
            if !cut[bone] {
                stops.extend([(0.0, a), (1.0, b)]);
                for knot in &knots[bone] {
                    stops.push((knot.parameter, wire.skeleton.joints.len() as u32));
                    wire.skeleton.joints.push(knot.position);
                }
                stops.sort_by(|p, q| p.0.total_cmp(&q.0));
            }
            for part in stops.windows(2) {
                wire.skeleton.bones.push([part[0].1, part[1].1]);
                wire.owners.push(bone as u32);
            }
            wire.breaks.push(stops.iter().map(|s| s.0).collect());
        }
        wire
    }

    /// Where a place on the source skeleton is on the wire.
    fn locate(&self, place: Location) -> Location {
        let Location::Bone { bone, parameter } = place else { return place };
        let breaks = &self.breaks[bone as usize];
        if breaks.is_empty() {
            return Location::Joint(self.bones[bone as usize][usize::from(parameter > 0.5)]);
        }
        let part = breaks.partition_point(|&s| s <= parameter).clamp(1, breaks.len() - 1) - 1;
        let (low, high) = (breaks[part], breaks[part + 1]);
        // The last part of a bone whose leaf has no knots beyond it goes on without end, as the bone did.
        Location::Bone { bone: self.first[bone as usize] + part as u32, parameter: (parameter - low) / (high - low) }
    }

    /// The straight parts of the wire; those without knots, as far as `extents`, the least and the largest parameter on each
    /// bone of the source, 0 and 1 included.
    pub fn lines(&self, extents: &[[f64; 2]]) -> Vec<[DVec3; 2]> {
        let line = |(part, &bone): (usize, &u32)| {
            let [low, high] = if self.breaks[bone as usize].len() > 2 { [0.0, 1.0] } else { extents[bone as usize] };
            [low, high].map(|s| self.skeleton.point_at(part as u32, s))
        };
        self.owners.iter().enumerate().map(line).collect()
    }

    /// `projected` with its start on the wire.
    pub fn carry(&self, avatar: &TriangleMesh, projected: &ProjectedAvatar) -> ProjectedAvatar {
        let places = projected.places.iter().map(|&place| self.locate(place)).collect();
        let graph = BoneGraph::new(&self.skeleton);
        let mut carried = subdivide(avatar, places, &self.skeleton, &graph);
        carried.places.clone_from(&projected.places);
        for bone in carried.bones.iter_mut().flatten() {
            *bone = self.owners[*bone as usize];
        }
        carried
    }
}
