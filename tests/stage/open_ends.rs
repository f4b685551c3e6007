//! A head without a bone of its own, above the joint from which the shoulders branch off.

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::skeleton::Skeleton;
use bespoke::stage::start::open_ends::find;
use bespoke::stage::start::owners::Owners;
use bespoke::stage::start::projection::{project, project_with};
use closet::{Kind, sample};
use glam::DVec3;

use crate::bodies;

/// A body in the normalised space, z up, with its skeleton.
fn body(kind: Kind) -> (TriangleMesh, Skeleton) {
    bodies::normalised(&sample(kind))
}

#[test]
fn skeletons_with_a_bone_in_each_end_have_none() {
    for kind in [Kind::Mannequin, Kind::Heavy, Kind::Creature] {
        let (mesh, skeleton) = body(kind);
        assert_eq!(find(&mesh, &skeleton, &Owners::find(&mesh, &skeleton, None)), [], "{kind:?}");
    }
}

#[test]
fn a_head_without_a_bone_starts_beyond_the_neck() {
    let (mesh, mut skeleton) = body(Kind::Mannequin);
    // The shoulders branch off at the neck, as in many rigs of games.
    let shoulders = skeleton.bones.iter_mut().filter(|b| **b != [1, 2] && b.contains(&1) && !b.contains(&0));
    shoulders.for_each(|b| *b = b.map(|j| if j == 1 { 2 } else { j }));
    skeleton.joints[2] -= DVec3::Z * 0.12;
    let neck = skeleton.joints[2];
    let top = mesh.positions.iter().map(|p| p.z).fold(f64::MIN, f64::max);
    let owners = Owners::find(&mesh, &skeleton, None);
    let open = find(&mesh, &skeleton, &owners);
    assert_eq!(open.len(), 1, "{open:?}");
    assert_eq!(skeleton.bones[open[0].bone as usize][open[0].end], 2);
    assert!((open[0].reach - (top - neck.z)).abs() < 0.05, "{} {}", open[0].reach, top - neck.z);

    let highest = |start: &[DVec3]| start.iter().map(|p| p.z).fold(f64::MIN, f64::max);
    let shut = project(&mesh, &skeleton, &skeleton, None);
    assert!(highest(&shut.start) < neck.z + 1e-9);
    let beyond = project_with(&mesh, &skeleton, &skeleton, &owners, &open);
    assert!(highest(&beyond.start) > neck.z + 0.9 * open[0].reach);
    // What is far below the neck starts where it did.
    for (p, (a, b)) in mesh.positions.iter().zip(shut.shrunk.iter().zip(&beyond.shrunk)) {
        assert!(p.z > neck.z - 0.2 || a == b);
    }
}
