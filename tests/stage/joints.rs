//! Joints that the bodies contradict: found, with a better place near the right one; right skeletons have none.

use std::sync::LazyLock;

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::diagnostic::{JointFault, Subject};
use bespoke::input::skeleton::Skeleton;
use bespoke::stage::start::joints::{Figure, Flesh, Misplaced, find, mend};
use closet::{Kind, sample};
use glam::DVec3;

use crate::bodies;

const KINDS: [Kind; 3] = [Kind::Mannequin, Kind::Heavy, Kind::Creature];

/// A body in metres, z up, with its skeleton.
fn body(kind: Kind) -> (TriangleMesh, Skeleton) {
    static MADE: LazyLock<[(TriangleMesh, Skeleton); 3]> = LazyLock::new(|| {
        KINDS.map(|kind| {
            let sample = sample(kind);
            (bodies::mesh(&sample), bodies::skeleton(&sample))
        })
    });
    let index = KINDS.iter().position(|&k| k == kind).unwrap();
    MADE[index].clone()
}

/// What is found in a target and a source, each with its body where that is given.
fn found(target: (&Skeleton, &TriangleMesh), source: (&Skeleton, Option<&TriangleMesh>)) -> Vec<Misplaced> {
    let target = Figure::new(Subject::TargetSkeleton, target.0, Some(target.1)).unwrap();
    let source = Figure::new(Subject::SourceSkeleton, source.0, source.1).unwrap();
    find(target, source, &jacket())
}

/// A jacket on the mannequin.
fn jacket() -> TriangleMesh {
    static MADE: LazyLock<TriangleMesh> = LazyLock::new(|| bodies::mesh(&sample(Kind::Jacket)));
    MADE.clone()
}

fn mended(skeleton: &Skeleton, subject: Subject, found: &[Misplaced]) -> Skeleton {
    let mut mended = skeleton.clone();
    mend(&mut mended, subject, found);
    mended
}

/// A box.
fn boxed(low: DVec3, high: DVec3) -> TriangleMesh {
    let corner = |k: usize| DVec3::new([low.x, high.x][k & 1], [low.y, high.y][k >> 1 & 1], [low.z, high.z][k >> 2]);
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let halves = faces.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
    TriangleMesh::from_corners(halves.map(|t| t.map(corner)))
}

/// With a root on the floor, from which a bone leads to the first joint.
fn with_root(mesh: &TriangleMesh, skeleton: &Skeleton) -> Skeleton {
    let floor = mesh.positions.iter().map(|p| p.z).fold(f64::MAX, f64::min);
    let mut skeleton = skeleton.clone();
    skeleton.bones.insert(0, [skeleton.joints.len() as u32, 0]);
    skeleton.joints.push(skeleton.joints[0].with_z(floor));
    skeleton
}

#[test]
fn right_skeletons_have_none() {
    for (target, source) in KINDS.into_iter().zip(KINDS.into_iter().cycle().skip(1)) {
        let ((mesh, skeleton), (worn_by, designed_on)) = (body(target), body(source));
        assert_eq!(found((&skeleton, &mesh), (&designed_on, None)), [], "{target:?}");
        assert_eq!(found((&skeleton, &mesh), (&designed_on, Some(&worn_by))), [], "{target:?}, {source:?}");
    }
}

#[test]
fn a_body_with_two_sides_is_no_mistake() {
    let (mut mesh, mut skeleton) = with_arms_at_the_neck(Kind::Heavy);
    let back: Vec<[u32; 3]> = mesh.triangles.iter().map(|&[a, b, c]| [a, c, b]).collect();
    mesh.triangles.extend(back);
    // A head, whose bone is the only last one at a fork.
    let neck = skeleton.joints[2];
    let top = mesh.positions.iter().map(|p| p.z).fold(f64::MIN, f64::max);
    skeleton.bones.push([2, skeleton.joints.len() as u32]);
    skeleton.joints.push(neck.with_z(top - 0.05));
    assert_eq!(found((&skeleton, &mesh), (&skeleton, None)), []);
}

#[test]
fn a_body_with_a_cap_turned_over_is_no_mistake() {
    // A box around the middle of a bone that is much longer, one of its ends facing inwards.
    let mut mesh = boxed(DVec3::new(-0.2, -0.2, -0.4), DVec3::new(0.2, 0.2, 0.4));
    let is_end = |t: &[u32; 3]| t.iter().all(|&v| mesh.positions[v as usize].z < 0.0);
    let turned = mesh.triangles.iter().map(|t| if is_end(t) { [t[0], t[2], t[1]] } else { *t }).collect();
    mesh.triangles = turned;
    let joints = vec![-0.95 * DVec3::Z, DVec3::ZERO, DVec3::Z];
    let skeleton = Skeleton { joints, bones: vec![[0, 1], [1, 2]] };
    assert!(Flesh::new(mesh.clone()).winding(-0.48 * DVec3::Z) > 0.5);
    assert_eq!(found((&skeleton, &mesh), (&skeleton, None)), []);
}

#[test]
fn a_root_on_the_floor_goes_to_where_its_bone_begins_in_both_skeletons() {
    let ((mesh, plain), (worn_by, designed_on)) = (body(Kind::Heavy), body(Kind::Mannequin));
    let (target, source) = (with_root(&mesh, &plain), with_root(&worn_by, &designed_on));
    for worn_by in [None, Some(&worn_by)] {
        let found = found((&target, &mesh), (&source, worn_by));
        let faults: Vec<_> = found.iter().map(|m| (m.skeleton, m.joint(), m.bone.index, m.fault)).collect();
        let stray = |subject| (subject, 15, 0, JointFault::Stray);
        assert_eq!(faults, [stray(Subject::TargetSkeleton), stray(Subject::SourceSkeleton)]);
        // From the crotch to the floor.
        let length = (target.joints[0] - target.joints[15]).z;
        assert!((found[0].length - found[0].share * length).abs() < 1e-9);
        assert!((0.7..0.95).contains(&found[0].share), "{found:?}");
        for (skeleton, subject) in [(&target, Subject::TargetSkeleton), (&source, Subject::SourceSkeleton)] {
            let mended = mended(skeleton, subject, &found);
            assert!(mended.joints[15].distance(skeleton.joints[0]) < 1e-9);
            assert_eq!(mended.joints[..15], skeleton.joints[..15]);
        }
    }
}

#[test]
fn a_tail_that_the_source_has_stays() {
    // The bone runs through a tail of the source, and the target goes without.
    let ((mesh, plain), (mut worn_by, designed_on)) = (body(Kind::Heavy), body(Kind::Mannequin));
    let (target, source) = (with_root(&mesh, &plain), with_root(&worn_by, &designed_on));
    let ([foot, top], first) = ([source.joints[15], source.joints[0]], worn_by.positions.len() as u32);
    for z in [foot.z - 0.02, top.z] {
        worn_by
            .positions
            .extend([(0.03, 0.0), (-0.02, 0.03), (-0.02, -0.03)].map(|(x, y)| DVec3::new(x, y + foot.y, z)));
    }
    let sides = [[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4], [2, 0, 3], [2, 3, 5], [0, 2, 1], [3, 4, 5]];
    worn_by.triangles.extend(sides.map(|t| t.map(|v: u32| first + v)));
    assert_eq!(found((&target, &mesh), (&source, Some(&worn_by))), []);
}

#[test]
fn a_hand_beyond_its_tip_goes_back_into_it() {
    let (mesh, right) = body(Kind::Mannequin);
    let mut skeleton = right.clone();
    let (elbow, hand) = (right.joints[4], right.joints[5]);
    let along = (hand - elbow).normalize();
    let arm = |p: &&DVec3| (**p - elbow).reject_from(along).length() < 0.1 && (**p - elbow).dot(along) > 0.0;
    let tip = mesh.positions.iter().filter(arm).map(|p| (*p - elbow).dot(along)).fold(0.0, f64::max);
    skeleton.joints[5] = elbow + (tip + 0.15) * along;
    // Many rigs end beyond the tips of their limbs: only where the source has it inside this one is wrong.
    assert_eq!(found((&skeleton, &mesh), (&right, None)), []);
    assert_eq!(found((&skeleton, &mesh), (&skeleton, Some(&mesh))), []);
    let found = found((&skeleton, &mesh), (&right, Some(&mesh)));
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!((found[0].joint(), found[0].fault), (5, JointFault::Outside));
    let reached = (mended(&skeleton, Subject::TargetSkeleton, &found).joints[5] - elbow).dot(along);
    assert!(reached < tip && reached > tip - 0.05, "{reached} of {tip}");
}

#[test]
fn an_elbow_above_the_arm_goes_into_it() {
    for (subject, source_is_wrong) in [(Subject::TargetSkeleton, false), (Subject::SourceSkeleton, true)] {
        let (mesh, right) = body(Kind::Mannequin);
        let mut skeleton = right.clone();
        skeleton.joints[4] += DVec3::new(0.0, 0.0, 0.25);
        let found = match source_is_wrong {
            false => found((&skeleton, &mesh), (&right, Some(&mesh))),
            true => found((&right, &mesh), (&skeleton, Some(&mesh))),
        };
        assert_eq!(found.len(), 1, "{found:?}");
        assert_eq!((found[0].skeleton, found[0].joint(), found[0].fault), (subject, 4, JointFault::Outside));
        let mended = mended(&skeleton, subject, &found);
        let flesh = Flesh::new(mesh);
        let upper = right.joints[4] - right.joints[3];
        let aside = (mended.joints[4] - right.joints[3]).reject_from(upper).length();
        assert!(flesh.contains(mended.joints[4]) && aside < 0.03, "{aside}");
    }
}

#[test]
fn legs_that_the_body_goes_without_are_none_of_a_mistake() {
    let (mut mesh, skeleton) = body(Kind::Mannequin);
    let knee = skeleton.joints[10].z;
    mesh.triangles.retain(|t| t.iter().any(|&v| mesh.positions[v as usize].z > knee));
    assert_eq!(found((&skeleton, &mesh), (&skeleton, None)), []);
}

#[test]
fn a_bone_that_cuts_a_corner_outside_of_the_body_is_found_and_stays() {
    // Without its elbow, an arm that is bent at a right angle.
    let (r, far) = (0.1, 1.0);
    let mut mesh = boxed(DVec3::splat(-r), DVec3::new(far, r, r));
    let other = boxed(DVec3::splat(-r), DVec3::new(r, far, r));
    mesh.triangles.extend(other.triangles.iter().map(|t| t.map(|v| v + mesh.positions.len() as u32)));
    mesh.positions.extend(other.positions);
    let skeleton = Skeleton { joints: vec![DVec3::X * 0.9, DVec3::Y * 0.9], bones: vec![[0, 1]] };
    let found = found((&skeleton, &mesh), (&skeleton, None));
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!((found[0].fault, found[0].place), (JointFault::BoneOutside, None));
    assert!((found[0].length - 0.35).abs() < 0.01, "{found:?}");
}

/// A body whose arms branch off at the neck, as in many rigs of games.
fn with_arms_at_the_neck(kind: Kind) -> (TriangleMesh, Skeleton) {
    let (mesh, mut skeleton) = body(kind);
    for bone in &mut skeleton.bones {
        if [[1, 3], [1, 6]].contains(bone) {
            bone[0] = 2;
        }
    }
    (mesh, skeleton)
}

#[test]
fn arms_that_branch_off_at_the_neck_are_no_mistake() {
    for (target, source) in KINDS.into_iter().zip(KINDS.into_iter().cycle().skip(1)) {
        let (target, source) = (with_arms_at_the_neck(target), with_arms_at_the_neck(source));
        assert_eq!(found((&target.1, &target.0), (&source.1, None)), []);
        assert_eq!(found((&target.1, &target.0), (&source.1, Some(&source.0))), []);
    }
}

#[test]
fn a_neck_between_the_arms_goes_above_them() {
    let ((mesh, right), (worn_by, designed_on)) =
        (with_arms_at_the_neck(Kind::Mannequin), with_arms_at_the_neck(Kind::Mannequin));
    let mut low = right.clone();
    low.joints[2] = right.joints[2].lerp(right.joints[1], 0.5);
    let check = |found: Vec<Misplaced>, subject| {
        assert_eq!(found.len(), 1, "{found:?}");
        assert_eq!((found[0].skeleton, found[0].joint(), found[0].fault), (subject, 2, JointFault::Low));
        let (is, was) = (mended(&low, subject, &found).joints[2], right.joints[2]);
        assert!(is.distance(was) < 0.4 * low.joints[2].distance(was), "{is} for {was} from {}", low.joints[2]);
    };
    check(found((&low, &mesh), (&designed_on, None)), Subject::TargetSkeleton);
    check(found((&low, &mesh), (&designed_on, Some(&worn_by))), Subject::TargetSkeleton);
    check(found((&right, &mesh), (&low, Some(&worn_by))), Subject::SourceSkeleton);
    // The same on both sides says the same twice.
    assert_eq!(found((&low, &mesh), (&low, Some(&worn_by))), []);
}

/// The skeleton with the last joint of a limb at its tip.
fn at_the_tip(mesh: &TriangleMesh, right: &Skeleton, [from, joint]: [usize; 2]) -> Skeleton {
    let (start, end) = (right.joints[from], right.joints[joint]);
    let along = (end - start).normalize();
    let limb = |p: &&DVec3| (**p - start).reject_from(along).length() < 0.1 && (**p - start).dot(along) > 0.0;
    let tip = mesh.positions.iter().filter(limb).map(|p| (*p - start).dot(along)).fold(0.0, f64::max);
    let mut skeleton = right.clone();
    skeleton.joints[joint] = start + tip * along;
    skeleton
}

#[test]
fn a_last_joint_at_the_tip_of_its_limb_goes_where_the_other_skeleton_has_it() {
    let ((mesh, right), (worn_by, designed_on)) = (body(Kind::Heavy), body(Kind::Mannequin));
    for [from, joint] in [[4, 5], [10, 11]] {
        let target = at_the_tip(&mesh, &right, [from, joint]);
        let check = |found: Vec<Misplaced>, subject, right: &Skeleton, wrong: &Skeleton| {
            assert_eq!(found.len(), 1, "{found:?}");
            assert_eq!((found[0].skeleton, found[0].fault), (subject, JointFault::AtTip));
            let (is, was) = (mended(wrong, subject, &found).joints[joint], right.joints[joint]);
            assert!(is.distance(was) < 0.35 * wrong.joints[joint].distance(was), "{joint}: {is} for {was}");
        };
        check(found((&target, &mesh), (&designed_on, Some(&worn_by))), Subject::TargetSkeleton, &right, &target);
        // Without a source avatar, or where both are alike, nothing says which is right.
        assert_eq!(found((&target, &mesh), (&designed_on, None)), []);
        let source = at_the_tip(&worn_by, &designed_on, [from, joint]);
        assert_eq!(found((&target, &mesh), (&source, Some(&worn_by))), []);
        check(found((&right, &mesh), (&source, Some(&worn_by))), Subject::SourceSkeleton, &designed_on, &source);
    }
}

#[test]
fn a_wrist_where_the_body_ends_without_a_hand_stays() {
    let ((mut mesh, skeleton), (worn_by, designed_on)) = (body(Kind::Mannequin), body(Kind::Mannequin));
    let (elbow, wrist) = (skeleton.joints[4], skeleton.joints[5]);
    let (along, length) = ((wrist - elbow).normalize(), wrist.distance(elbow));
    let is_hand = |p: DVec3| {
        let offset = p - elbow;
        offset.dot(along) > length && offset.reject_from(along).length() < 0.15
    };
    mesh.triangles.retain(|t| !t.iter().all(|&v| is_hand(mesh.positions[v as usize])));
    let found = found((&skeleton, &mesh), (&designed_on, Some(&worn_by)));
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!((found[0].joint(), found[0].fault, found[0].is_sure), (5, JointFault::AtTip, false));
    assert_eq!(mended(&skeleton, Subject::TargetSkeleton, &found), skeleton);
}

#[test]
fn points_are_inside_where_all_directions_meet_the_surface() {
    // A brute-force twin of the winding number: the share of directions that leave through the surface.
    let (mesh, skeleton) = body(Kind::Creature);
    let flesh = Flesh::new(mesh.clone());
    let tree = bespoke::geometry::closest_point::ClosestPoint::new(&mesh);
    for &joint in &skeleton.joints {
        for p in [joint, joint + DVec3::new(0.0, 1.5, 0.0)] {
            let all = bespoke::stage::plausibility::cover(&tree, p) > 0.999;
            assert_eq!(flesh.contains(p), all, "{p} {}", flesh.winding(p));
            assert_eq!(flesh.excludes(p), !all);
        }
    }
}
