//! Skin weights that contradict the positions.

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::skeleton::Skeleton;
use bespoke::input::skin::SkinWeights;
use bespoke::stage::start::weight_check::contradictions;
use closet::{Kind, sample};
use glam::DVec3;

use crate::bodies;

/// A body in the normalised space, its skeleton, and the joint of each vertex.
struct Scene {
    mesh: TriangleMesh,
    skeleton: Skeleton,
    joints: Vec<u32>,
}

fn body(kind: Kind) -> Scene {
    let body = sample(kind);
    let (mesh, skeleton) = bodies::normalised(&body);
    let largest = |v: usize| (0..body.skin.len()).max_by(|&a, &b| body.skin[a][v].total_cmp(&body.skin[b][v])).unwrap();
    let joints = (0..body.mesh.positions.len()).map(|v| largest(v) as u32).collect();
    Scene { mesh, skeleton, joints }
}

impl Scene {
    /// The vertices found where each is bound to `joint(v)` alone.
    fn found(&self, joint: impl Fn(usize) -> u32) -> Vec<u32> {
        let joints: Vec<u32> = (0..self.mesh.positions.len()).map(joint).collect();
        let count = joints.len();
        let skin =
            SkinWeights::from_sparse(&joints, &vec![1.0; count], 1, self.skeleton.joints.len(), count, "skin").unwrap();
        let found = contradictions(&self.mesh, &self.skeleton, &skin);
        assert_eq!(found.weighted, count);
        assert_eq!(found.vertices.is_empty(), found.first.is_empty());
        for v in &found.first {
            assert!(found.vertices.contains(v));
        }
        let cleaned = skin.without(&found.vertices);
        for (v, &joint) in joints.iter().enumerate().take(count) {
            let is_found = found.vertices.binary_search(&(v as u32)).is_ok();
            assert_eq!(cleaned.dominant_joint(v), (!is_found).then_some(joint));
        }
        found.vertices
    }

    /// Adds a sheet of 20 by 20 vertices, bound to `joint`.
    fn add_sheet(&mut self, joint: u32, at: impl Fn(f64, f64) -> DVec3) {
        let first = self.mesh.positions.len() as u32;
        for k in 0..400u32 {
            self.mesh.positions.push(at(f64::from(k % 20) / 19.0, f64::from(k / 20) / 19.0));
            self.joints.push(joint);
            if k % 20 < 19 && k / 20 < 19 {
                let v = first + k;
                self.mesh.triangles.extend([[v, v + 1, v + 20], [v + 1, v + 21, v + 20]]);
            }
        }
    }
}

#[test]
fn right_weights_are_believed_on_bodies_of_all_shapes() {
    for kind in [Kind::Mannequin, Kind::Heavy, Kind::Creature] {
        let body = body(kind);
        assert_eq!(body.found(|v| body.joints[v]), [0u32; 0], "{kind:?}");
    }
}

#[test]
fn all_on_one_joint_or_in_another_order_is_believed_nowhere() {
    let body = body(Kind::Mannequin);
    let all: Vec<u32> = (0..body.joints.len() as u32).collect();
    let count = body.skeleton.joints.len() as u32;
    for joint in [0, 2, 11] {
        assert!(body.found(|_| joint) == all, "joint {joint}");
    }
    assert!(body.found(|v| count - 1 - body.joints[v]) == all);
}

#[test]
fn a_limb_that_is_bound_to_the_trunk_is_found_and_nothing_else() {
    let body = body(Kind::Mannequin);
    let limb = |v: usize| matches!(body.joints[v], 4 | 5);
    let found = body.found(|v| if limb(v) { 0 } else { body.joints[v] });
    let inside = found.iter().filter(|&&v| limb(v as usize)).count();
    let all = (0..body.joints.len()).filter(|&v| limb(v)).count();
    assert!(inside == found.len() && inside * 10 > all * 9, "{inside} of {all}, {} in all", found.len());
}

#[test]
fn single_vertices_bound_across_the_body_are_found() {
    let body = body(Kind::Mannequin);
    // Of a hand, bound to a foot.
    let hand: Vec<usize> = (0..body.joints.len()).filter(|&v| body.joints[v] == 5).step_by(37).collect();
    let found = body.found(|v| if hand.contains(&v) { 14 } else { body.joints[v] });
    assert!(!hand.is_empty() && found.iter().all(|&v| hand.contains(&(v as usize))));
    assert_eq!(found.len(), hand.len());
}

#[test]
fn long_hair_a_skirt_and_a_cape_belong_where_they_are_bound() {
    let mut body = body(Kind::Mannequin);
    let joints = body.skeleton.joints.clone();
    // z is up, and the body looks along -y.
    let (neck, root) = (joints[2], joints[0]);
    let round = |radius: f64, turn: f64| radius * DVec3::new(turn.cos(), turn.sin(), 0.0);
    body.add_sheet(2, |s, t| neck + round(0.12, std::f64::consts::PI * s) + DVec3::Z * (0.1 - 0.9 * t));
    body.add_sheet(0, |s, t| root + round(0.2 + 0.2 * t, std::f64::consts::TAU * s) - DVec3::Z * 1.1 * t);
    body.add_sheet(1, |s, t| neck + round(0.2 + 0.1 * t, std::f64::consts::PI * s) - DVec3::Z * 1.6 * t);
    assert_eq!(body.found(|v| body.joints[v]), [0u32; 0]);
}
