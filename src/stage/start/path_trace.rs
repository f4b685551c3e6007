//! The bent skeleton that a path search has chosen: its choices of least cost, followed outwards from the root.

use glam::DVec3;

use super::bent_skeleton::{BentSkeleton, ControlPoint};
use super::path_search::{Candidates, Chain, PathSearch, RETRACTED, SearchSettings, SkeletonPath};

/// What is chosen at a joint or station.
#[derive(Clone, Copy)]
enum Choice {
    /// A candidate of its own.
    Candidate(usize),
    /// The point that it is retracted to.
    Retracted(DVec3),
}

/// A chain with the points that are chosen for it.
struct Polyline {
    bone: usize,
    /// Whether it ends at a joint.
    inner: bool,
    /// Parameters and points.
    points: Vec<(f64, DVec3)>,
}

/// The choices of least cost, followed from the root.
struct Trace {
    /// Positions of the joints.
    positions: Vec<DVec3>,
    /// Length of each joint's offset.
    moved: Vec<f64>,
    /// The largest offset on each bone, its joints apart.
    displacements: Vec<f64>,
    /// As in [`SkeletonPath`].
    retracted: Vec<[f64; 2]>,
    polylines: Vec<Polyline>,
}

impl PathSearch<'_> {
    /// The bent skeleton of least cost, from the root's candidate `first`.
    pub(super) fn trace(
        &self,
        root: u32,
        first: usize,
        chains: &[Vec<Chain>],
        joints: &[Candidates],
        cut: &[bool],
        settings: &SearchSettings,
    ) -> SkeletonPath {
        let Trace { positions, moved, mut displacements, retracted, polylines } =
            self.follow(root, first, chains, joints);
        for (bone, ends) in self.source.bones.iter().enumerate() {
            displacements[bone] = ends.iter().map(|&j| moved[j as usize]).fold(displacements[bone], f64::max);
        }
        let mut control_points = vec![Vec::new(); self.source.bones.len()];
        for Polyline { bone, inner, points } in polylines {
            if displacements[bone] > 0.0 || retracted[bone] != [0.0; 2] {
                control_points[bone].extend(self.control_points(&points, inner, settings));
            }
        }
        let bent = BentSkeleton::new(self.source, &positions, &control_points, cut);
        SkeletonPath { bent, displacements, retracted }
    }

    /// Follows the successors of least cost outwards from the root's candidate `first`.
    fn follow(&self, root: u32, first: usize, chains: &[Vec<Chain>], joints: &[Candidates]) -> Trace {
        let bones = self.source.bones.len();
        let mut trace = Trace {
            positions: self.source.joints.clone(),
            moved: vec![0.0; self.source.joints.len()],
            displacements: vec![0.0; bones],
            retracted: vec![[0.0; 2]; bones],
            polylines: Vec::new(),
        };
        let mut stack = vec![(root, Choice::Candidate(first))];
        while let Some((joint, choice)) = stack.pop() {
            let j = joint as usize;
            trace.positions[j] = match choice {
                Choice::Candidate(k) => {
                    trace.moved[j] = joints[j].offsets[k].length();
                    joints[j].point(k)
                }
                Choice::Retracted(point) => point,
            };
            for chain in &chains[j] {
                let last = self.follow_chain(chain, choice, joints, trace.positions[j], &mut trace);
                stack.extend(chain.end.map(|end| (end, last)));
            }
        }
        trace
    }

    /// Follows one chain from `choice`, at the point `start`, and returns the choice at its end.
    fn follow_chain(
        &self,
        chain: &Chain,
        mut choice: Choice,
        joints: &[Candidates],
        start: DVec3,
        trace: &mut Trace,
    ) -> Choice {
        let bone = chain.bone as usize;
        let mut points = vec![(self.parameter(chain, 0), start)];
        for (k, &parameter) in chain.parameters.iter().enumerate() {
            let (before, before_point) = points[k];
            if let Choice::Candidate(candidate) = choice {
                choice = match chain.next[k][candidate] {
                    RETRACTED => Choice::Retracted(before_point),
                    next => Choice::Candidate(next as usize),
                };
            }
            let (point, displacement) = match choice {
                Choice::Candidate(c) => {
                    let joint = chain.end.filter(|_| k + 1 == chain.parameters.len());
                    let candidates = joint.map_or_else(|| &chain.candidates[k], |j| &joints[j as usize]);
                    (candidates.point(c), candidates.offsets[c].length())
                }
                Choice::Retracted(point) => {
                    let part = self.length(bone) * (parameter - before).abs();
                    trace.retracted[bone][usize::from(chain.end.is_none())] += part;
                    (point, 0.0)
                }
            };
            trace.displacements[bone] = trace.displacements[bone].max(displacement);
            points.push((parameter, point));
        }
        trace.polylines.push(Polyline { bone, inner: chain.end.is_some(), points });
        choice
    }

    /// As few control points as keep a polyline clear of the garment and near to what it was; `inner` where it ends at a joint.
    fn control_points(&self, points: &[(f64, DVec3)], inner: bool, settings: &SearchSettings) -> Vec<ControlPoint> {
        let mut control_points = Vec::new();
        let last = points.len() - 1;
        let mut from = 0;
        while from < last {
            let straight = |to: usize| {
                let ((s, a), (t, b)) = (points[from], points[to]);
                let near = points[from..to]
                    .iter()
                    .all(|&(r, p)| p.distance(a.lerp(b, (r - s) / (t - s))) <= 0.5 * settings.spacing);
                near && self.is_clear([a, b], [a, b].map(|p| self.tree.distance(p)), settings.clearance)
            };
            let to = (from + 2..=last).rev().find(|&to| straight(to)).unwrap_or(from + 1);
            if to < last || !inner {
                control_points.push(ControlPoint { parameter: points[to].0, position: points[to].1 });
            }
            from = to;
        }
        control_points
    }
}
