//! The bent skeleton: the source skeleton as polylines that avoid the garment where its bones would pass through it.

use glam::DVec3;

use super::projection::{ProjectedAvatar, subdivide};
use crate::geometry::mesh::TriangleMesh;
use crate::input::skeleton::{BoneGraph, Location, Skeleton};

/// A control point of a bent skeleton: a parameter on a bone, as in [`Skeleton::point_at`], and the point where it is held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ControlPoint {
    /// Where along the bone; not 0 or 1, which are joints.
    pub parameter: f64,
    /// The point.
    pub position: DVec3,
}

/// A skeleton in itself: the source's joints, which may have moved, then the control points; and each bone as a polyline of
/// straight parts between its control points.
pub struct BentSkeleton {
    /// Joints and control points; the parts are its bones.
    pub skeleton: Skeleton,
    /// The bone of the source that each part belongs to.
    source_bones: Vec<u32>,
    /// First part of each bone of the source.
    first: Vec<u32>,
    /// The parameters at which the parts of each bone begin and end; none where the bone is cut.
    breaks: Vec<Vec<f64>>,
    bones: Vec<[u32; 2]>,
}

impl BentSkeleton {
    /// The skeleton with the source's joints at `joints` and with `control_points` on each bone. A bone that is `cut` is left
    /// out: what is on it belongs to the nearer of its joints.
    pub fn new(source: &Skeleton, joints: &[DVec3], control_points: &[Vec<ControlPoint>], cut: &[bool]) -> Self {
        let mut bent = Self {
            skeleton: Skeleton { joints: joints.to_vec(), bones: Vec::new() },
            source_bones: Vec::new(),
            first: Vec::new(),
            breaks: Vec::new(),
            bones: source.bones.clone(),
        };
        for (bone, &[a, b]) in source.bones.iter().enumerate() {
            bent.first.push(bent.source_bones.len() as u32);
            let mut stops = Vec::new();
            if !cut[bone] {
                stops.extend([(0.0, a), (1.0, b)]);
                for control_point in &control_points[bone] {
                    stops.push((control_point.parameter, bent.skeleton.joints.len() as u32));
                    bent.skeleton.joints.push(control_point.position);
                }
                stops.sort_by(|p, q| p.0.total_cmp(&q.0));
            }
            for part in stops.windows(2) {
                bent.skeleton.bones.push([part[0].1, part[1].1]);
                bent.source_bones.push(bone as u32);
            }
            bent.breaks.push(stops.iter().map(|s| s.0).collect());
        }
        bent
    }

    /// Where a location on the source skeleton is on this one.
    fn locate(&self, location: Location) -> Location {
        let Location::Bone { bone, parameter } = location else { return location };
        let breaks = &self.breaks[bone as usize];
        if breaks.is_empty() {
            return Location::Joint(self.bones[bone as usize][usize::from(parameter > 0.5)]);
        }
        let part = breaks.partition_point(|&s| s <= parameter).clamp(1, breaks.len() - 1) - 1;
        let (low, high) = (breaks[part], breaks[part + 1]);
        // The last part of a bone whose leaf has no control points beyond it goes on without end, as the bone did.
        Location::Bone { bone: self.first[bone as usize] + part as u32, parameter: (parameter - low) / (high - low) }
    }

    /// The bone of the source that a straight part belongs to.
    pub fn bone_of(&self, part: u32) -> u32 {
        self.source_bones[part as usize]
    }

    /// The straight parts as segments. A bone without control points reaches as far as its `extents`, the least and the largest
    /// parameter on each bone of the source, 0 and 1 included.
    pub fn segments(&self, extents: &[[f64; 2]]) -> Vec<[DVec3; 2]> {
        let segment = |(part, &bone): (usize, &u32)| {
            let [low, high] = if self.breaks[bone as usize].len() > 2 { [0.0, 1.0] } else { extents[bone as usize] };
            [low, high].map(|s| self.skeleton.point_at(part as u32, s))
        };
        self.source_bones.iter().enumerate().map(segment).collect()
    }

    /// `projected` with its start on the bent skeleton.
    pub fn reproject(&self, avatar: &TriangleMesh, projected: &ProjectedAvatar) -> ProjectedAvatar {
        let locations = projected.locations.iter().map(|&location| self.locate(location)).collect();
        let graph = BoneGraph::new(&self.skeleton);
        let mut moved = subdivide(avatar, locations, &self.skeleton, &graph);
        moved.locations.clone_from(&projected.locations);
        for bone in moved.bones.iter_mut().flatten() {
            *bone = self.source_bones[*bone as usize];
        }
        moved
    }
}
