//! Poses a body and a garment by their skin weights, and counts what passes through what.

use std::collections::HashSet;

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::skeleton::Skeleton;
use bespoke::input::skin::SkinWeights;
use bespoke::rig::weights::blend::{linear_blend, place};
use bespoke::verify::intersections;
use closet::skeleton::{ARMS, LEGS};
use glam::{DAffine3, DQuat, DVec3};

/// A joint that bends, on both sides of the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bend {
    /// Arms come down where they are spread, and are raised where they hang.
    Shoulder,
    /// Forearms come forward.
    Elbow,
    /// Thighs come forward.
    Hip,
    /// Shins go back.
    Knee,
}

/// The poses by which weights are judged.
pub const POSES: [&[Bend]; 5] = [
    &[Bend::Shoulder],
    &[Bend::Elbow],
    &[Bend::Hip],
    &[Bend::Knee],
    &[Bend::Shoulder, Bend::Elbow, Bend::Hip, Bend::Knee],
];

/// A skeleton of the samples' joints as a hierarchy from joint 0, and where its front and its top are.
pub struct Puppet {
    joints: Vec<DVec3>,
    parents: Vec<Option<u32>>,
    front: DVec3,
    up: DVec3,
}

impl Puppet {
    /// The hierarchy of a skeleton whose joints are numbered as the samples' ones.
    pub fn new(skeleton: &Skeleton, front: DVec3, up: DVec3) -> Self {
        let mut parents = vec![None; skeleton.joints.len()];
        let mut reached = vec![0];
        let mut next = 0;
        while let Some(&joint) = reached.get(next) {
            for &[a, b] in &skeleton.bones {
                for (from, to) in [(a, b), (b, a)] {
                    if from == joint && !reached.contains(&to) {
                        parents[to as usize] = Some(from);
                        reached.push(to);
                    }
                }
            }
            next += 1;
        }
        Self { joints: skeleton.joints.clone(), parents, front, up }
    }

    /// The joint that moves each joint.
    pub fn parents(&self) -> &[Option<u32>] {
        &self.parents
    }

    /// How each joint moves what it owns when these joints bend by `degrees`.
    pub fn moves(&self, bends: &[Bend], degrees: f64) -> Vec<DAffine3> {
        let mut turns = vec![DQuat::IDENTITY; self.joints.len()];
        let mut turn = |joint: usize, axis: DVec3| {
            turns[joint] = DQuat::from_axis_angle(axis.normalize(), degrees.to_radians());
        };
        for bend in bends {
            for ([shoulder, elbow, wrist], [hip, knee, _]) in ARMS.into_iter().zip(LEGS) {
                let along = |a: usize, b: usize| (self.joints[b] - self.joints[a]).normalize();
                match bend {
                    Bend::Shoulder => {
                        let arm = along(shoulder, elbow);
                        let way = if arm.dot(self.up) < -0.6 { self.up } else { -self.up };
                        turn(shoulder, arm.cross(way));
                    }
                    Bend::Elbow => turn(elbow, along(elbow, wrist).cross(self.front)),
                    Bend::Hip => turn(hip, along(hip, knee).cross(self.front)),
                    Bend::Knee => turn(knee, -along(hip, knee).cross(self.front)),
                }
            }
        }
        place(&self.joints, &self.parents, &turns)
    }
}

/// Pairs of triangles that intersect in a pose, and not in the bind pose.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Within the garment.
    pub own: u64,
    /// Of garment and body, where the body does not pass through itself.
    pub body: u64,
    /// Of garment and body, where it does.
    pub folds: u64,
}

impl std::ops::AddAssign for Counts {
    fn add_assign(&mut self, more: Self) {
        self.own += more.own;
        self.body += more.body;
        self.folds += more.folds;
    }
}

/// What passes through what when body and garment are posed by their weights.
pub fn counts(
    garment: &TriangleMesh,
    weights: &SkinWeights,
    body: &TriangleMesh,
    skin: &SkinWeights,
    moves: &[DAffine3],
) -> Counts {
    Bound::new(garment, body, skin).posed(moves).counts(&garment.positions, weights)
}

/// Garment and body in the bind pose, and what passes through what there, which is not a pose's.
pub struct Bound<'a> {
    garment: &'a TriangleMesh,
    body: &'a TriangleMesh,
    skin: &'a SkinWeights,
    own: HashSet<[u32; 2]>,
    folds: HashSet<[u32; 2]>,
    with_body: HashSet<[u32; 2]>,
}

/// The body in a pose.
pub struct Posed<'a> {
    bound: &'a Bound<'a>,
    moves: &'a [DAffine3],
    /// The body.
    pub under: TriangleMesh,
    folded: Vec<bool>,
}

impl<'a> Bound<'a> {
    /// A garment on a body that has skin weights.
    pub fn new(garment: &'a TriangleMesh, body: &'a TriangleMesh, skin: &'a SkinWeights) -> Self {
        let [own, folds, with_body] =
            [(garment, None), (body, None), (garment, Some(body))].map(|(a, b)| pairs(a, b).into_iter().collect());
        Self { garment, body, skin, own, folds, with_body }
    }

    /// The body where these motions of its joints take it.
    pub fn posed(&'a self, moves: &'a [DAffine3]) -> Posed<'a> {
        let under = TriangleMesh {
            positions: linear_blend(&self.body.positions, self.skin, moves),
            triangles: self.body.triangles.clone(),
        };
        let mut folded = vec![false; under.triangles.len()];
        let fresh = pairs(&under, None).into_iter().filter(|pair| !self.folds.contains(pair));
        fresh.flatten().for_each(|t| folded[t as usize] = true);
        Posed { bound: self, moves, under, folded }
    }
}

impl Posed<'_> {
    /// What passes through what where the garment, at `positions` in the bind pose, goes along by `weights`.
    pub fn counts(&self, positions: &[DVec3], weights: &SkinWeights) -> Counts {
        let Bound { garment, own, with_body, .. } = self.bound;
        let cloth = TriangleMesh {
            positions: linear_blend(positions, weights, self.moves),
            triangles: garment.triangles.clone(),
        };
        let fresh = pairs(&cloth, Some(&self.under)).into_iter().filter(|pair| !with_body.contains(pair));
        let (folds, others): (Vec<_>, Vec<_>) = fresh.partition(|pair| self.folded[pair[1] as usize]);
        Counts {
            own: pairs(&cloth, None).iter().filter(|pair| !own.contains(*pair)).count() as u64,
            body: others.len() as u64,
            folds: folds.len() as u64,
        }
    }
}

fn pairs(a: &TriangleMesh, b: Option<&TriangleMesh>) -> Vec<[u32; 2]> {
    intersections(a, b, usize::MAX).expect("finite coordinates").pairs
}

/// The weights of the nearest vertex of the body: what tools do that look at nothing else.
pub fn nearest_vertex(garment: &TriangleMesh, body: &TriangleMesh, skin: &SkinWeights) -> SkinWeights {
    let nearest = |p: &DVec3| {
        let weighted = (0..body.positions.len()).filter(|&v| !skin.weights(v).is_empty());
        let best = weighted
            .min_by(|&a, &b| body.positions[a].distance_squared(*p).total_cmp(&body.positions[b].distance_squared(*p)));
        best.map_or_else(Vec::new, |v| skin.weights(v).to_vec())
    };
    SkinWeights::from_rows(skin.joint_count(), garment.positions.iter().map(nearest))
}
