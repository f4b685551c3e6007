//! Joints and bones, and shortest paths along them.

use std::collections::VecDeque;

use glam::DVec3;

use super::{MAX_COORDINATE, bad_coordinate};
use crate::error::{Error, ErrorKind, Result};
use crate::geometry::closest_point::closest_on_segment;

/// The largest number of joints accepted: the table of paths between joints grows with its square.
pub const MAX_JOINTS: usize = 4096;

/// Joints, and bones between pairs of them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Skeleton {
    /// Position of each joint.
    pub joints: Vec<DVec3>,
    /// The two joints of each bone.
    pub bones: Vec<[u32; 2]>,
}

fn fail<T>(message: String) -> Result<T> {
    Err(Error::new(ErrorKind::InvalidSkeleton, message))
}

/// The joints of a bone, lower first: the same for both directions.
fn undirected([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

impl Skeleton {
    /// The bones, those at a leaf joint longer there by `reach` times their length: hands, feet and the head have no bones in
    /// many skeletons.
    pub fn lengthened(&self, reach: f64) -> Vec<[DVec3; 2]> {
        let mut degree = vec![0u32; self.joints.len()];
        self.bones.iter().flatten().for_each(|&joint| degree[joint as usize] += 1);
        let beyond = |joint: u32| if degree[joint as usize] == 1 { reach } else { 0.0 };
        let lengthened = |&[j, k]: &[u32; 2]| {
            let (a, b) = (self.joints[j as usize], self.joints[k as usize]);
            [a - beyond(j) * (b - a), b + beyond(k) * (b - a)]
        };
        self.bones.iter().map(lengthened).collect()
    }

    /// Refuses a skeleton that cannot be used; `name` names it in error messages ("target skeleton").
    ///
    /// A bone of zero length is accepted and acts as a point.
    ///
    /// # Errors
    /// [`ErrorKind::InvalidSkeleton`]: no joints, no bones, too many joints, a coordinate that is not finite or
    /// beyond [`MAX_COORDINATE`], a bone with an index out of range or from a joint to itself, a bone given twice,
    /// a joint that is not connected with the others.
    pub fn check(&self, name: &str) -> Result<()> {
        let count = self.joints.len();
        if count == 0 {
            return fail(format!("{name}: there are no joints"));
        }
        if count > MAX_JOINTS {
            return fail(format!("{name}: there are {count} joints, at most {MAX_JOINTS} can be used"));
        }
        if self.bones.is_empty() {
            return fail(format!("{name}: there are {count} joints but no bones"));
        }
        if let Some((joint, value)) = bad_coordinate(&self.joints) {
            return fail(format!(
                "{name}: joint {joint} has {value}, a coordinate must be finite and at most {MAX_COORDINATE:e} in size"
            ));
        }
        for (bone, &[a, b]) in self.bones.iter().enumerate() {
            if let Some(index) = [a, b].into_iter().find(|&j| j as usize >= count) {
                return fail(format!("{name}: bone {bone} has joint {index}, the skeleton has {count} joints"));
            }
            if a == b {
                return fail(format!("{name}: bone {bone} joins joint {a} to itself"));
            }
        }
        let mut sorted: Vec<([u32; 2], usize)> = self.bones.iter().map(|&b| undirected(b)).zip(0usize..).collect();
        sorted.sort_unstable();
        if let Some(pair) = sorted.windows(2).find(|w| w[0].0 == w[1].0) {
            let ([a, b], first) = pair[0];
            return fail(format!("{name}: bones {first} and {} both join joints {a} and {b}", pair[1].1));
        }
        let reached = JointAdjacency::new(count, &self.bones).distances_from(0);
        if let Some(joint) = reached.iter().position(|d| d.hops == UNREACHED) {
            return fail(format!("{name}: joint {joint} is not connected to joint 0 by bones"));
        }
        Ok(())
    }

    /// This skeleton with its bones in the order and direction of `source`'s, so that bone i of one corresponds
    /// to bone i of the other. Both must have passed [`check`](Self::check).
    ///
    /// # Errors
    /// [`ErrorKind::InvalidSkeleton`] where the two do not have the same joints and bones; names the first
    /// difference. `self` is called the target skeleton there.
    pub fn aligned_to(&self, source: &Skeleton) -> Result<Skeleton> {
        if self.joints.len() != source.joints.len() {
            return fail(format!(
                "target skeleton: has {} joints, the source skeleton has {}; they must correspond one to one",
                self.joints.len(),
                source.joints.len()
            ));
        }
        let sorted = |bones: &[[u32; 2]]| {
            let mut list: Vec<_> = bones.iter().map(|&b| undirected(b)).collect();
            list.sort_unstable();
            list
        };
        let (own, others) = (sorted(&self.bones), sorted(&source.bones));
        if let Some([a, b]) = source.bones.iter().find(|&&bone| own.binary_search(&undirected(bone)).is_err()) {
            return fail(format!(
                "target skeleton: has no bone between joints {a} and {b}, which the source skeleton has"
            ));
        }
        if let Some([a, b]) = self.bones.iter().find(|&&bone| others.binary_search(&undirected(bone)).is_err()) {
            return fail(format!(
                "target skeleton: has a bone between joints {a} and {b}, which the source skeleton does not have"
            ));
        }
        Ok(Skeleton { joints: self.joints.clone(), bones: source.bones.clone() })
    }

    /// The longest side of the joints' bounding box; `name` names the skeleton in error messages.
    ///
    /// # Errors
    /// [`ErrorKind::InvalidSkeleton`] where all joints are at one position, so that the skeleton has no size.
    pub fn longest_side(&self, name: &str) -> Result<f64> {
        let low = self.joints.iter().copied().reduce(DVec3::min).unwrap_or_default();
        let high = self.joints.iter().copied().reduce(DVec3::max).unwrap_or_default();
        let side = (high - low).max_element();
        if side * MAX_COORDINATE < 1.0 {
            return fail(format!("{name}: all joints are in one place, the skeleton has no size"));
        }
        Ok(side)
    }

    /// The mean of the joints.
    pub fn mean_joint(&self) -> DVec3 {
        self.joints.iter().copied().sum::<DVec3>() / self.joints.len().max(1) as f64
    }

    /// The point at `parameter` along a bone: 0 is its first joint, 1 its second, beyond them its straight line.
    #[inline]
    pub fn point_at(&self, bone: u32, parameter: f64) -> DVec3 {
        let [a, b] = self.bones[bone as usize].map(|j| self.joints[j as usize]);
        // Exact at both joints, so that locations on different bones that are one joint coincide.
        if parameter == 1.0 { b } else { a + parameter * (b - a) }
    }

    /// The bone nearest to a point, and its distance; none without bones.
    pub fn nearest_bone(&self, p: DVec3) -> Option<(u32, f64)> {
        let distance = |ends: &[u32; 2]| {
            let [a, b] = ends.map(|joint| self.joints[joint as usize]);
            closest_on_segment(p, a, b - a).distance(p)
        };
        (0u32..).zip(self.bones.iter().map(distance)).min_by(|a, b| a.1.total_cmp(&b.1))
    }
}

/// A location on a skeleton.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Location {
    /// On a bone, as in [`Skeleton::point_at`]. With `parameter` exactly 0 or 1 it is the joint there.
    Bone {
        /// The bone.
        bone: u32,
        /// Where along it.
        parameter: f64,
    },
    /// At a joint.
    Joint(u32),
}

/// The connectivity of a skeleton: leaves, and the shortest path along bones between any two locations (section 3.3).
///
/// It depends on the bones only, so one graph serves a source skeleton and the target skeleton aligned to it.
///
/// Every bone counts one, so a breadth-first search from each joint gives the table that Floyd-Warshall gives.
#[derive(Clone, Debug)]
pub struct BoneGraph {
    bones: Vec<[u32; 2]>,
    neighbours: JointAdjacency,
    /// Row a, column b: the number of bones between joints a and b, and the next joint from b towards a.
    ways: Vec<Hop>,
}

const UNREACHED: u16 = u16::MAX;

#[derive(Clone, Copy, Debug)]
struct Hop {
    hops: u16,
    towards: u16,
}

/// The bones at each joint, and the joint at the other end of each.
#[derive(Clone, Debug)]
struct JointAdjacency {
    first: Vec<u32>,
    bones: Vec<u32>,
    joints: Vec<u32>,
}

impl JointAdjacency {
    fn new(joint_count: usize, bones: &[[u32; 2]]) -> Self {
        let mut ends: Vec<(u32, u32, u32)> =
            bones.iter().zip(0..).flat_map(|(&[a, b], bone)| [(a, bone, b), (b, bone, a)]).collect();
        ends.sort_unstable();
        let first = (0..=joint_count as u32).map(|j| ends.partition_point(|e| e.0 < j) as u32).collect();
        Self { first, bones: ends.iter().map(|e| e.1).collect(), joints: ends.iter().map(|e| e.2).collect() }
    }

    fn range(&self, joint: u32) -> std::ops::Range<usize> {
        self.first[joint as usize] as usize..self.first[joint as usize + 1] as usize
    }

    /// Number of bones to each joint from `start`, and the joint before it on that path.
    fn distances_from(&self, start: u32) -> Vec<Hop> {
        let mut row = vec![Hop { hops: UNREACHED, towards: 0 }; self.first.len() - 1];
        row[start as usize] = Hop { hops: 0, towards: start as u16 };
        let mut queue = VecDeque::from([start]);
        while let Some(j) = queue.pop_front() {
            for &k in &self.joints[self.range(j)] {
                if row[k as usize].hops == UNREACHED {
                    row[k as usize] = Hop { hops: row[j as usize].hops + 1, towards: j as u16 };
                    queue.push_back(k);
                }
            }
        }
        row
    }
}

impl BoneGraph {
    /// The graph of a skeleton that has passed [`Skeleton::check`].
    pub fn new(skeleton: &Skeleton) -> Self {
        let count = skeleton.joints.len();
        let neighbours = JointAdjacency::new(count, &skeleton.bones);
        let ways = (0..count as u32).flat_map(|j| neighbours.distances_from(j)).collect();
        Self { bones: skeleton.bones.clone(), neighbours, ways }
    }

    /// Number of bones at a joint.
    #[inline]
    pub fn degree(&self, joint: u32) -> usize {
        self.neighbours.range(joint).len()
    }

    /// True for a joint with a single bone: a hand, a foot, the head.
    #[inline]
    pub fn is_leaf(&self, joint: u32) -> bool {
        self.degree(joint) == 1
    }

    /// The bones at a joint, ascending.
    #[inline]
    pub fn bones_at(&self, joint: u32) -> &[u32] {
        &self.neighbours.bones[self.neighbours.range(joint)]
    }

    /// Number of bones on the shortest path between two joints.
    #[inline]
    pub fn joint_distance(&self, a: u32, b: u32) -> usize {
        usize::from(self.way(a, b).hops)
    }

    /// The joints strictly between two locations, in order from `a` to `b`: with them put in between, consecutive
    /// locations share a bone. Empty where `a` and `b` share a bone. Replaces the contents of `path`.
    pub fn joints_between(&self, a: Location, b: Location, path: &mut Vec<u32>) {
        path.clear();
        let Some(way) = self.shortest(a, b) else { return };
        let mut joint = way.first;
        for _ in 0..way.count {
            path.push(joint);
            joint = u32::from(self.way(way.last, joint).towards);
        }
    }

    /// The bone on which all locations lie, if there is one; the lowest where there are several.
    pub fn common_bone(&self, locations: &[Location]) -> Option<u32> {
        let lies_on = |location: &Location, bone: u32| match self.resolve(*location) {
            Location::Bone { bone: own, .. } => own == bone,
            Location::Joint(joint) => self.bones[bone as usize].contains(&joint),
        };
        match self.resolve(*locations.first()?) {
            Location::Bone { bone, .. } => locations.iter().all(|p| lies_on(p, bone)).then_some(bone),
            Location::Joint(joint) => {
                self.bones_at(joint).iter().copied().find(|&bone| locations.iter().all(|p| lies_on(p, bone)))
            }
        }
    }

    /// Parameter of the point of a bone closest to `p`: clamped at a joint where other bones go on, not clamped
    /// at a leaf, where the body goes on beyond the bone. `skeleton` has this graph's bones.
    ///
    /// A bone of zero length is a point: 0.
    #[inline]
    pub fn project(&self, skeleton: &Skeleton, bone: u32, p: DVec3) -> f64 {
        let [j, k] = skeleton.bones[bone as usize];
        let (a, b) = (skeleton.joints[j as usize], skeleton.joints[k as usize]);
        let (direction, offset) = (b - a, p - a);
        let square = direction.length_squared();
        // Also a point where the length is lost in rounding against the distance to p.
        if square <= 1e-24 * offset.length_squared() || square == 0.0 {
            return 0.0;
        }
        let parameter = offset.dot(direction) / square;
        let low = if self.is_leaf(j) { f64::NEG_INFINITY } else { 0.0 };
        let high = if self.is_leaf(k) { f64::INFINITY } else { 1.0 };
        parameter.clamp(low, high)
    }

    #[inline]
    fn way(&self, a: u32, b: u32) -> Hop {
        self.ways[a as usize * (self.neighbours.first.len() - 1) + b as usize]
    }

    /// A location at the end of a bone is the joint there.
    fn resolve(&self, location: Location) -> Location {
        match location {
            Location::Bone { bone, parameter: 0.0 } => Location::Joint(self.bones[bone as usize][0]),
            Location::Bone { bone, parameter: 1.0 } => Location::Joint(self.bones[bone as usize][1]),
            other => other,
        }
    }

    /// The path between two locations, or `None` where they share a bone.
    fn shortest(&self, a: Location, b: Location) -> Option<Way> {
        let (a, b) = (self.resolve(a), self.resolve(b));
        if self.common_bone(&[a, b]).is_some() {
            return None;
        }
        // A location inside a bone leaves it by one of its joints; a joint is itself and is not put in again.
        let exits = |location| match location {
            Location::Bone { bone, .. } => (self.bones[bone as usize], 0),
            Location::Joint(joint) => ([joint, joint], 1),
        };
        let ((from, skip_first), (to, skip_last)) = (exits(a), exits(b));
        let mut best: Option<(usize, u32, u32)> = None;
        for j in from {
            for k in to {
                let hops = self.joint_distance(j, k);
                if best.is_none_or(|(least, ..)| hops < least) {
                    best = Some((hops, j, k));
                }
            }
        }
        let (hops, j, last) = best?;
        let first = if skip_first == 1 { u32::from(self.way(last, j).towards) } else { j };
        Some(Way { first, last, count: hops + 1 - skip_first - skip_last })
    }
}

/// `count` joints from `first` on, towards `last`.
struct Way {
    first: u32,
    last: u32,
    count: usize,
}
