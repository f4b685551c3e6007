//! Pieces of the avatar's mesh that are no part of the body.

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::diagnostic::Foreignness;
use bespoke::input::skeleton::Skeleton;
use bespoke::stage::start::foreign_parts::find;
use closet::{Kind, sample};
use glam::DVec3;

use crate::bodies;

/// A body and what is put into its file besides. z is up.
struct Scene {
    mesh: TriangleMesh,
    skeleton: Skeleton,
    /// Triangles of the body alone.
    own: usize,
}

fn body(kind: Kind) -> Scene {
    let body = sample(kind);
    let mesh = bodies::mesh(&body);
    Scene { own: mesh.triangles.len(), mesh, skeleton: bodies::skeleton(&body) }
}

impl Scene {
    fn with(mut self, positions: &[DVec3], triangles: &[[u32; 3]]) -> Self {
        let first = self.mesh.positions.len() as u32;
        self.mesh.positions.extend(positions);
        self.mesh.triangles.extend(triangles.iter().map(|t| t.map(|v| first + v)));
        self
    }

    /// A rectangle from `corner` along two edges.
    fn with_sheet(self, corner: DVec3, [a, b]: [DVec3; 2]) -> Self {
        self.with(&[corner, corner + a, corner + a + b, corner + b], &[[0, 1, 2], [0, 2, 3]])
    }

    fn with_box(self, low: DVec3, high: DVec3) -> Self {
        let corner = |k: usize| DVec3::from_array(std::array::from_fn(|axis| [low, high][k >> axis & 1][axis]));
        let sides = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
        let triangles: Vec<[u32; 3]> = sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        self.with(&std::array::from_fn::<DVec3, 8, _>(corner), &triangles)
    }

    /// What is found, which has to be all that was added.
    fn reasons(&self) -> Vec<Foreignness> {
        let found = find(&self.mesh, &self.skeleton, |_| false);
        let mut triangles: Vec<u32> = found.iter().flat_map(|part| part.triangles.clone()).collect();
        triangles.sort_unstable();
        let added: Vec<u32> = (self.own as u32..self.mesh.triangles.len() as u32).collect();
        assert_eq!(triangles, if found.is_empty() { Vec::new() } else { added });
        found.iter().map(|part| part.reason).collect()
    }
}

fn ground(scene: Scene, half: f64, height: f64) -> Scene {
    scene.with_sheet(DVec3::new(-half, -half, height), [DVec3::X * 2.0 * half, DVec3::Y * 2.0 * half])
}

#[test]
fn floors_domes_boxes_and_what_stands_beside_are_foreign() {
    let low = body(Kind::Mannequin).mesh.positions.iter().copied().reduce(DVec3::min).unwrap();
    let high = body(Kind::Mannequin).mesh.positions.iter().copied().reduce(DVec3::max).unwrap();
    for (half, height) in [(0.6, low.z), (5.0, low.z - 0.01), (50.0, low.z + 0.02)] {
        assert_eq!(ground(body(Kind::Mannequin), half, height).reasons(), [Foreignness::Ground], "{half}");
    }
    for around in [0.02, 3.0] {
        let scene = body(Kind::Mannequin).with_box(low - around, high + around);
        assert_eq!(scene.reasons(), [Foreignness::Surrounds], "{around}");
    }
    let away = DVec3::X * 1.2;
    assert_eq!(body(Kind::Mannequin).with_box(away, away + 0.3).reasons(), [Foreignness::Detached]);
    let wall = body(Kind::Mannequin).with_sheet(DVec3::new(-9.0, 0.3, low.z), [DVec3::X * 18.0, DVec3::Z * 9.0]);
    assert_eq!(wall.reasons(), [Foreignness::Huge]);
    let both = ground(body(Kind::Mannequin).with_box(low - 9.0, high + 9.0), 4.0, low.z);
    assert_eq!(both.reasons(), [Foreignness::Surrounds, Foreignness::Ground]);
    // As a second figure.
    let other = body(Kind::Mannequin);
    let positions: Vec<DVec3> = other.mesh.positions.iter().map(|&p| p + 2.0 * DVec3::X).collect();
    let reasons = body(Kind::Mannequin).with(&positions, &other.mesh.triangles).reasons();
    assert!(!reasons.is_empty() && reasons.iter().all(|&reason| reason == Foreignness::Detached));
}

#[test]
fn pieces_of_the_body_and_what_is_attached_to_it_stay() {
    for kind in [Kind::Mannequin, Kind::Heavy, Kind::Creature] {
        let scene = body(kind);
        assert_eq!(scene.reasons(), []);
        let (root, neck, hand) = (scene.skeleton.joints[0], scene.skeleton.joints[2], scene.skeleton.joints[5]);
        // A cape, wings wider than the body is tall, a halo, a stick in the hand that is longer than an arm.
        let cape = neck + DVec3::new(-0.3, 0.15, -1.2);
        let wing = |side: f64| neck + DVec3::new(side * 1.2, 0.3, 0.4);
        let scene = scene
            .with_sheet(cape, [DVec3::X * 0.6, DVec3::Z * 1.1])
            .with(&[neck + DVec3::Y * 0.1, wing(1.0), wing(1.0) - DVec3::Z], &[[0, 1, 2]])
            .with(&[neck + DVec3::Y * 0.1, wing(-1.0), wing(-1.0) - DVec3::Z], &[[0, 1, 2]])
            .with_box(neck + DVec3::new(-0.1, -0.1, 0.45), neck + DVec3::new(0.1, 0.1, 0.47))
            .with_box(hand - DVec3::new(0.02, 0.7, 0.02), hand + DVec3::new(0.02, 0.7, 0.02))
            .with_sheet(root - DVec3::new(0.1, 0.2, 0.0), [DVec3::X * 0.2, DVec3::Y * 0.1]);
        assert_eq!(find(&scene.mesh, &scene.skeleton, |_| false), [], "{kind:?}");
    }
}

#[test]
fn what_a_caller_calls_body_stays_and_never_is_all_left_out() {
    let scene = ground(body(Kind::Mannequin), 4.0, -0.01);
    let own = scene.own as u32;
    assert_eq!(find(&scene.mesh, &scene.skeleton, |t| t >= own), []);
    let alone = TriangleMesh { triangles: scene.mesh.triangles[scene.own..].to_vec(), ..scene.mesh };
    assert_eq!(find(&alone, &scene.skeleton, |_| false), []);
}
