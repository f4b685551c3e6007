//! Characters by rig alone: whatever their joints are called, whichever they have, and whatever pose they stand in.

use std::sync::LazyLock;

use bespoke::control::Stage;
use bespoke::error::ErrorKind;
use bespoke::geometry::closest_point::ClosestPoint;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::diagnostic::DiagnosticKind;
use bespoke::input::rig::RigJoint;
use bespoke::input::skeleton::Skeleton;
use bespoke::input::skin::SkinWeights;
use bespoke::options::Options;
use bespoke::rig::joint_map::{JointMap, Reason};
use bespoke::session::{Budget, Precision, Session};
use closet::avatars::Avatar;
use closet::mesh::Mesh;
use closet::rigs::{Body, Character, Naming, Pose, Role, SIDES, character, y_up};
use closet::{Sample, garments};
use glam::{DAffine3, DMat4, DVec3};
use testing::character::{self as dressing, rig};

static MANNEQUIN: LazyLock<Sample> = LazyLock::new(|| Body::Mannequin.model());
static SLIM: LazyLock<Sample> = LazyLock::new(|| Body::Avatar(Avatar::Slim).model());
static VEST: LazyLock<Sample> = LazyLock::new(|| garments::vest(2.5));

fn mannequin(naming: Naming) -> Character {
    character(&MANNEQUIN, naming).placed(y_up())
}

fn slim(naming: Naming) -> Character {
    character(&SLIM, naming).placed(y_up())
}

/// A garment of the closet on the mannequin, on its rig.
fn worn(source: &Character, mesh: &Mesh) -> Character {
    let frame = y_up();
    let mut mesh = mesh.clone();
    mesh.positions.iter_mut().for_each(|p| *p = frame.transform_point3(*p));
    source.wears(&mesh)
}

/// The vest, which has no sleeves.
fn vest(source: &Character) -> Character {
    worn(source, &VEST.mesh)
}

fn sweater(source: &Character) -> Character {
    worn(source, &garments::garment(garments::Garment::Sweater).mesh)
}

/// A garment that the source wears on its way to the target, both by their rigs.
fn session(garment: &Character, source: &Character, target: &Character) -> Session {
    dressing::session(garment, source, target, Options { threads: 2, voxel_size: 0.04, ..Options::default() }).unwrap()
}

/// The map from one to the other, by their rigs alone.
fn map(source: &Character, target: &Character) -> JointMap {
    let mut session = Session::new();
    session.set_source_rig(rig(source)).unwrap();
    session.set_target_rig(rig(target)).unwrap();
    session.joint_map().unwrap()
}

#[track_caller]
fn dressed(session: &mut Session, what: &str) {
    let outcome = session.run();
    assert!(matches!(outcome, Ok(Stage::Done)), "{what}: {outcome:?}");
    for precision in [Precision::F32, Precision::F64] {
        assert!(session.verify(precision).unwrap().is_clean(), "{what}");
    }
}

/// What limbs and head are made of.
fn limbs() -> Vec<Role> {
    let limb =
        |side| [Role::UpperArm(side), Role::LowerArm(side), Role::Thigh(side), Role::Calf(side), Role::Foot(side)];
    SIDES.into_iter().flat_map(limb).chain([Role::Head]).collect()
}

#[test]
fn limbs_correspond_whatever_they_are_called_and_controls_to_nothing() {
    let source = mannequin(Naming::Mixamo);
    for naming in Naming::ALL {
        for (pose, directions) in [("bind", Pose::BIND), ("arms-down", Pose::ARMS_DOWN)] {
            let target = slim(naming).posed(&directions);
            let map = map(&source, &target);
            let what = format!("{} in {pose}", naming.word());
            for (joint, mapped) in source.joints.iter().zip(&map.joints) {
                let to = mapped.target.map(|joint| target.joints[joint as usize].role);
                if limbs().contains(&joint.role) {
                    assert_eq!(to, Some(joint.role), "{what}: {}", joint.name);
                    if naming == Naming::Unnamed {
                        assert!(mapped.confidence < 0.75, "{what}: told as a guess: {mapped:?}");
                    }
                    assert!(mapped.confidence > 0.3 && mapped.part.is_some(), "{what}: {mapped:?}");
                }
                assert!(!to.is_some_and(Role::is_control), "{what}: {} to {to:?}", joint.name);
            }
        }
    }
}

#[test]
fn a_vest_by_rig_alone_on_other_namings() {
    let source = mannequin(Naming::Mixamo);
    let garment = vest(&source);
    for naming in [Naming::Unreal, Naming::Unnamed] {
        dressed(&mut session(&garment, &source, &slim(naming)), naming.word());
    }
}

#[test]
fn a_rig_beside_a_skeleton() {
    let source = mannequin(Naming::Rigify);
    let garment = vest(&source);
    let mut session = session(&garment, &source, &slim(Naming::Vrm));
    let frame = y_up();
    let joints = MANNEQUIN.skeleton.joints.iter().map(|&p| frame.transform_point3(p)).collect();
    session.set_source_skeleton(Skeleton { joints, bones: closet::skeleton::BONES.to_vec() }).unwrap();
    dressed(&mut session, "a skeleton beside a rig");
}

#[test]
fn pairs_of_the_caller_win() {
    let (source, target) = (mannequin(Naming::Mixamo), slim(Naming::Vrm));
    let at = |character: &Character, role| {
        character.joints.iter().position(|joint| joint.role == role).expect("it has one") as u32
    };
    let mut session = Session::new();
    session.set_source_rig(rig(&source)).unwrap();
    session.set_target_rig(rig(&target)).unwrap();
    let [left, right] = SIDES.map(Role::Foot);
    let pairs = vec![(at(&source, left), Some(at(&target, right))), (at(&source, right), None)];
    session.set_joint_pairs(pairs).unwrap();
    let map = session.joint_map().unwrap();
    let [first, second] = [left, right].map(|role| map.joints[at(&source, role) as usize]);
    assert_eq!((first.target, first.reason), (Some(at(&target, right)), Reason::Caller));
    assert_eq!((second.target, second.reason), (None, Reason::Caller));
}

#[test]
fn every_pose_ends_in_the_targets_own() {
    let (body, other) = (mannequin(Naming::Mixamo), slim(Naming::Unreal));
    // Whose sleeves have to turn needs the way: small turns need nothing, nor do arms beside a vest.
    for (worn, source_pose, target_pose, needs_way) in [
        (vest(&body), Pose::A, Pose::T, false),
        (sweater(&body), Pose::T, Pose::ARMS_DOWN, true),
        (vest(&body), Pose::ARMS_DOWN, Pose::T, false),
    ] {
        let motions = body.motions(&source_pose);
        let (source, garment) = (body.moved(&motions), worn.moved(&motions));
        let target = other.posed(&target_pose);
        let mut session = session(&garment, &source, &target);
        session.prepare().unwrap();
        let mut was_reposed = false;
        loop {
            let stage = session.step(Budget { iterations: 4, ..Budget::default() }).unwrap();
            was_reposed |= stage == Stage::Repose;
            if stage == Stage::Done {
                break;
            }
        }
        assert_eq!(was_reposed, needs_way);
        assert!(session.verify(Precision::F32).unwrap().is_clean());
        let apart = session
            .avatar_positions()
            .unwrap()
            .iter()
            .zip(&target.mesh.positions)
            .map(|(p, q)| p.distance(*q))
            .fold(0.0, f64::max);
        assert!(apart < 1e-5, "the avatar ends {apart} from where it was given");
    }
}

/// The mean distance of a garment's surface from a body.
fn mean_distance(positions: Vec<DVec3>, garment: &Character, body: &Character) -> f64 {
    let worn = TriangleMesh { positions, triangles: garment.mesh.triangles.clone() };
    let (skin, areas) = (ClosestPoint::new(&dressing::mesh(body)), worn.areas());
    let sum: f64 = (0..).zip(&areas).map(|(t, area)| area * skin.distance(worn.centre(t))).sum();
    sum / areas.iter().sum::<f64>()
}

/// `figures poses` has all nine combinations, with sleeves.
#[test]
fn the_fit_is_the_same_whichever_pose_a_garment_is_given_in() {
    let body = mannequin(Naming::Mixamo);
    let trousers = garments::garment(garments::Garment::Trousers).mesh;
    let (worn, target) = (worn(&body, &trousers), slim(Naming::Unreal).posed(&Pose::T));
    let distances = [Pose::T, Pose::ARMS_DOWN].map(|pose| {
        let motions = body.motions(&pose);
        let (source, garment) = (body.moved(&motions), worn.moved(&motions));
        let mut session = session(&garment, &source, &target);
        session.set_source_avatar(dressing::mesh(&source)).unwrap();
        dressed(&mut session, "trousers in another pose");
        assert_eq!(session.report().repose.iterations, 0, "arms beside trousers need no way");
        mean_distance(session.garment_positions().unwrap(), &garment, &target)
    });
    let mean = 0.5 * (distances[0] + distances[1]);
    assert!(distances.iter().all(|distance| (distance / mean - 1.0).abs() < 0.01), "{distances:?}");
}

#[test]
fn a_cancel_on_the_way_to_the_targets_pose() {
    let body = mannequin(Naming::Mixamo);
    let motions = body.motions(&Pose::T);
    let (source, garment) = (body.moved(&motions), sweater(&body).moved(&motions));
    let mut session = session(&garment, &source, &slim(Naming::Vrm).posed(&Pose::ARMS_DOWN));
    session.prepare().unwrap();
    while session.step(Budget { iterations: 1, ..Budget::default() }).unwrap() != Stage::Repose {
        assert_ne!(session.stage(), Stage::Done, "it went without");
    }
    session.control().cancel();
    let error = session.run().unwrap_err();
    assert_eq!((error.kind, session.stage()), (ErrorKind::Cancelled, Stage::Cancelled));
    assert!(session.garment_positions().unwrap().iter().all(|p| p.is_finite()));
    session.reset();
    dressed(&mut session, "after the cancel");
}

#[test]
fn the_result_moves_with_the_target_rig() {
    let (source, target) = (mannequin(Naming::Mixamo), slim(Naming::Unreal));
    let garment = vest(&source);
    let mut session = session(&garment, &source, &target);
    assert_eq!(session.garment_skin(4).unwrap_err().kind, ErrorKind::InvalidState);
    // Half of what moves the vest's hem hangs on a joint of its own.
    let mut own = rig(&source);
    let hips = source.joints.iter().position(|joint| joint.role == Role::Hips).expect("hips") as u32;
    let place = own.place(hips);
    own.joints.push(RigJoint {
        name: "bell".into(),
        parent: Some(hips),
        bind: DMat4::from_translation(place + DVec3::new(0.0, 0.0, 0.1)),
    });
    let bell = own.joints.len() as u32 - 1;
    let lowest = garment.mesh.positions.iter().map(|p| p.y).fold(f64::INFINITY, f64::min);
    let rows = garment.mesh.positions.iter().map(|p| match p.y - lowest < 0.05 {
        true => vec![(bell, 0.5), (hips, 0.5)],
        false => vec![(hips, 1.0)],
    });
    session.set_garment_skin(SkinWeights::from_rows(own.joints.len(), rows)).unwrap();
    session.set_source_rig(own).unwrap();
    dressed(&mut session, "a vest with a bell");

    let added = session.added_joints().unwrap();
    assert_eq!(added.iter().map(|joint| joint.source).collect::<Vec<_>>(), [bell]);
    let target_hips = target.joints.iter().position(|joint| joint.role == Role::Hips).expect("hips") as u32;
    assert_eq!(added[0].parent, Some(target_hips));
    let skin = session.garment_skin(4).unwrap();
    assert_eq!((skin.vertex_count(), skin.joint_count()), (garment.mesh.positions.len(), target.joints.len() + 1));
    let number = target.joints.len() as u32;
    for (vertex, p) in garment.mesh.positions.iter().enumerate() {
        let weights = skin.weights(vertex);
        assert!(weights.len() <= 4 && weights.iter().all(|&(_, weight)| weight > 0.0));
        assert!((weights.iter().map(|&(_, weight)| weight).sum::<f64>() - 1.0).abs() < 1e-9);
        let rings = weights.iter().any(|&(joint, _)| joint == number);
        assert_eq!(rings, p.y - lowest < 0.05, "vertex {vertex}");
    }
    assert!(session.pose_transforms().is_none());
    assert!(session.garment_skin(0).is_err());
}

/// Runs to the end or to an error; true where the inflation began again with the body in the pose of the design.
fn watched(session: &mut Session) -> (Result<Stage, bespoke::error::Error>, bool) {
    session.prepare().unwrap();
    let (mut farthest, mut again, mut posed) = (0.0_f64, false, false);
    loop {
        let stage = session.step(Budget { iterations: 1, ..Budget::default() });
        match stage {
            Ok(Stage::Inflate) => again |= session.report().t < farthest,
            Ok(Stage::Repose) => posed |= again,
            Ok(Stage::Fit | Stage::Verify | Stage::Prepared) => {}
            ended => return (ended, posed),
        }
        farthest = farthest.max(session.report().t);
    }
}

#[test]
fn where_the_own_pose_is_wedged_that_of_the_design_is_tried() {
    let source = mannequin(Naming::Mixamo);
    // The arms hang so near to the trunk that its sides pass through them.
    let arms = [DVec3::new(0.05, 0.0, -1.0), DVec3::new(0.1, -0.1, -1.0)];
    let target = slim(Naming::Unreal).posed(&Pose { arms: Some(arms), ..Pose::BIND });
    let run = || {
        let mut session = session(&vest(&source), &source, &target);
        let (ended, posed) = watched(&mut session);
        let error = ended.unwrap_err();
        assert_eq!((error.kind, session.stage()), (ErrorKind::ImplausibleResult, Stage::Done), "{}", error.message);
        assert!(posed, "the inflation was not wedged, or the poses differ too much");
        let kinds: Vec<_> = session.diagnostics().iter().map(|diagnostic| diagnostic.kind()).collect();
        assert_eq!(kinds, [DiagnosticKind::PoseBlocked]);
        assert!(error.message.contains("elbow"), "{}", error.message);
        assert!(session.verify(Precision::F32).unwrap().is_clean() && session.pose_transforms().is_some());
        session.garment_positions().unwrap()
    };
    assert_eq!(run(), run());
}

/// The arms of a heavy body lie in its flesh where they hang, and leave no room for sleeves; it stands with arms held out.
#[test]
fn where_the_pose_of_the_design_is_wedged_the_own_pose_is_tried() {
    let mannequin = mannequin(Naming::Mixamo);
    let source = mannequin.posed(&Pose::ARMS_DOWN);
    let target = character(&Body::Avatar(Avatar::Heavy).model(), Naming::Unreal).placed(y_up()).posed(&Pose::T);
    let design = sweater(&mannequin);
    let mut given = session(&design, &mannequin, &source);
    dressed(&mut given, "the mannequin with arms down");
    let mut garment = source.clone();
    garment.mesh = Mesh { positions: given.garment_positions().unwrap(), triangles: design.mesh.triangles };
    let mut session = session(&garment, &source, &target);
    session.set_source_avatar(dressing::mesh(&source)).unwrap();
    dressed(&mut session, "the heavy body");
    assert_eq!(session.report().repose.iterations, 0);
    let distance = mean_distance(session.garment_positions().unwrap(), &garment, &target);
    assert!(distance < 0.05, "{distance} m from the body");
    let is_posed = |kind| matches!(kind, DiagnosticKind::PoseBlocked | DiagnosticKind::SolvedPosed);
    assert!(!session.diagnostics().iter().any(|diagnostic| is_posed(diagnostic.kind())));
}

/// What lies so far outside of a part of a body: of triangles all of whose corners are in it.
fn patch(body: &Character, offset: f64, is_in: impl Fn(usize) -> bool) -> Character {
    let mut mesh = body.mesh.clone();
    let normals = mesh.normals();
    mesh.positions.iter_mut().zip(normals).for_each(|(p, normal)| *p += offset * normal);
    mesh.retain(|t| t.iter().all(|&v| is_in(v as usize)));
    body.wears(&mesh)
}

fn place(character: &Character, role: Role) -> DVec3 {
    character.joints.iter().find(|joint| joint.role == role).expect("it has one").bind.translation
}

/// A cap on a head that looks to a side.
#[test]
fn a_hat_turns_with_a_body_that_faces_sideways() {
    let (source, target) = (mannequin(Naming::Mixamo), slim(Naming::Unreal));
    let brow = place(&source, Role::Head).y + 0.115;
    let cap = patch(&source, 0.006, |v| source.mesh.positions[v].y > brow);
    let mut plain = session(&cap, &source, &target);
    dressed(&mut plain, "as it is");
    let expected = plain.garment_positions().unwrap();
    for degrees in [90.0_f64, -90.0] {
        let turn = DAffine3::from_rotation_y(degrees.to_radians());
        let mut aside = session(&cap, &source, &target.clone().placed(turn));
        dressed(&mut aside, "turned");
        assert!(aside.diagnostics().iter().all(|found| found.kind() != DiagnosticKind::FacingMismatch));
        let off = aside.garment_positions().unwrap().into_iter().zip(&expected);
        let off = off.map(|(p, &q)| p.distance(turn.transform_point3(q))).fold(0.0, f64::max);
        assert!(off < 2e-4, "{degrees} degrees: {off}");
    }
}

/// The mannequin's mitten on a hand that is as large as its forearm, which goes far beyond the end of that bone.
#[test]
fn a_mitten_is_on_a_much_larger_hand() {
    let (source, target) = (mannequin(Naming::Mixamo), character(&Body::BigHead.model(), Naming::Vrm).placed(y_up()));
    let left = SIDES[0];
    let (elbow, wrist) = (place(&source, Role::LowerArm(left)), place(&source, Role::Wrist(left)));
    let is_of_it = |joint: usize| {
        let role = source.joints[joint].role;
        role == Role::LowerArm(left)
            || role == Role::Wrist(left)
            || matches!(role, Role::Finger(side, ..) if side == left)
    };
    let mitten = patch(&source, 0.004, |v| {
        let share: f64 =
            source.influences[v].iter().filter(|(joint, _)| is_of_it(*joint)).map(|(_, weight)| weight).sum();
        let along = (source.mesh.positions[v] - elbow).dot(wrist - elbow) / (wrist - elbow).length_squared();
        share > 0.6 && along > 0.6
    });
    let mut session =
        dressing::session(&mitten, &source, &target, Options { threads: 2, ..Options::default() }).unwrap();
    session.set_source_avatar(dressing::mesh(&source)).unwrap();
    session.set_source_skin(dressing::skin(&source)).unwrap();
    dressed(&mut session, "a mitten");
    assert!(session.diagnostics().iter().all(|found| found.kind() != DiagnosticKind::JointsUnsure));
    // The tip of the mitten is at the tip of the hand, and its cuff on the forearm.
    let fitted = session.garment_positions().unwrap();
    let [elbow, wrist] = [Role::LowerArm(left), Role::Wrist(left)].map(|role| place(&target, role));
    let along = |p: &DVec3| (*p - elbow).dot(wrist - elbow) / (wrist - elbow).length_squared();
    let reach = |points: &mut dyn Iterator<Item = DVec3>| points.map(|p| along(&p)).fold(0.0, f64::max);
    let is_hand = |v: &usize| {
        let (joint, _) = target.influences[*v].iter().copied().max_by(|a, b| a.1.total_cmp(&b.1)).expect("weights");
        matches!(target.joints[joint].role, Role::Wrist(side) | Role::Finger(side, ..) if side == left)
    };
    let hand = (0..target.mesh.positions.len()).filter(is_hand);
    let tips = [reach(&mut fitted.iter().copied()), reach(&mut hand.map(|v| target.mesh.positions[v]))];
    let cuff = fitted.iter().map(along).fold(f64::INFINITY, f64::min);
    assert!(cuff > 0.3 && cuff < 0.9, "{cuff}");
    assert!((tips[0] - tips[1]).abs() < 0.15, "{tips:?}");
}
