//! Parts of the avatar: what takes part, what only collides, what is left out.

use bespoke::control::Stage;
use bespoke::error::ErrorKind;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::diagnostic::{DiagnosticKind, Element, Subject};
use bespoke::input::skeleton::Skeleton;
use bespoke::input::skin::SkinWeights;
use bespoke::options::Options;
use bespoke::session::{PartRole, Precision, Session};
use bespoke::verify::intersections;
use closet::avatars::{Avatar, avatar};
use closet::garments::{Garment, garment};
use closet::skeleton::BONES;
use closet::{Kind, Sample, sample};
use glam::DVec3;

use crate::small::{session, sleeve, thick_arm, tube};

/// The thick arm, and `more` as further triangles of the same mesh; and how many are the arm's.
fn with(more: &TriangleMesh) -> (TriangleMesh, usize) {
    let mut mesh = thick_arm();
    let (first, own) = (mesh.positions.len() as u32, mesh.triangles.len());
    mesh.positions.extend(&more.positions);
    mesh.triangles.extend(more.triangles.iter().map(|t| t.map(|v| first + v)));
    (mesh, own)
}

/// A floor below the arm's lower end.
fn floor() -> TriangleMesh {
    let corner = |x: f64, y: f64| DVec3::new(x, y, -1.15);
    let positions = vec![corner(-4.0, -4.0), corner(4.0, -4.0), corner(4.0, 4.0), corner(-4.0, 4.0)];
    TriangleMesh { positions, triangles: vec![[0, 1, 2], [0, 2, 3]] }
}

fn kinds(session: &Session) -> Vec<DiagnosticKind> {
    session.diagnostics().iter().map(|d| d.kind()).collect()
}

fn run(mut session: Session) -> (Vec<DVec3>, Session) {
    assert_eq!(session.run().unwrap(), Stage::Done);
    assert!(session.verify(Precision::F32).unwrap().is_clean());
    (session.garment_positions().unwrap(), session)
}

#[test]
fn a_floor_is_left_out_and_the_result_is_the_one_without_it() {
    let (alone, _) = run(session(1.0, DVec3::ZERO));
    let (both, own) = with(&floor());
    let mut there = session(1.0, DVec3::ZERO);
    there.set_target_avatar(both.clone()).unwrap();
    let (found, there) = run(there);
    assert!(found == alone);
    let part = there.diagnostics().iter().find(|d| d.kind() == DiagnosticKind::ForeignPart).unwrap();
    let triangle = |t: usize| Element::triangle(Subject::TargetAvatar, t as u32);
    assert_eq!(part.elements(), [triangle(own), triangle(own + 1)]);
    assert_eq!(there.avatar_positions().unwrap(), both.positions);
    assert_eq!(there.report().avatar_size, [both.positions.len(), own]);

    // Said by the caller, it is no finding.
    let mut told = session(1.0, DVec3::ZERO);
    told.set_target_avatar(both.clone()).unwrap();
    let mut roles = vec![PartRole::Automatic; own];
    roles.extend([PartRole::Ignored; 2]);
    told.set_avatar_parts(roles.clone()).unwrap();
    let (found, told) = run(told);
    assert!(found == alone && !kinds(&told).contains(&DiagnosticKind::ForeignPart));

    // The caller's word counts, and strict leaves nothing out.
    let mut body = session(1.0, DVec3::ZERO);
    body.set_target_avatar(both.clone()).unwrap();
    body.set_avatar_parts(vec![PartRole::Body; own + 2]).unwrap();
    body.prepare().unwrap();
    assert!(!kinds(&body).contains(&DiagnosticKind::ForeignPart));
    assert_eq!(body.report().avatar_size[1], own + 2);
    body.reset();
    body.clear_avatar_parts().unwrap();
    body.set_options(Options { strict: true, ..Options::default() }).unwrap();
    body.prepare().unwrap();
    assert!(kinds(&body).contains(&DiagnosticKind::ForeignPart));
    assert_eq!(body.report().avatar_size[1], own + 2);
}

/// What stands around a character in a file: a dome with more triangles than it has, and a floor.
fn stage(body: &TriangleMesh) -> [TriangleMesh; 2] {
    let (low, high) = body.positions.iter().fold((DVec3::MAX, DVec3::MIN), |(l, h), &p| (l.min(p), h.max(p)));
    let (size, middle) = ((high - low).max_element(), 0.5 * (low + high));
    let sphere = tube(-1.0, 1.0, |z, _| (1.0 - z * z).max(1e-4).sqrt(), 80, 80, true);
    let out = |p: DVec3| middle + 3.0 * size * (p - DVec3::new(0.2 * p.z.max(0.0), 0.0, 0.0));
    let dome = TriangleMesh { positions: sphere.positions.into_iter().map(out).collect(), triangles: sphere.triangles };
    let corner = |x: f64, y: f64| DVec3::new(middle.x + x * size, middle.y + y * size, low.z - 0.01 * size);
    let floor = vec![corner(-4.0, -4.0), corner(4.0, -4.0), corner(4.0, 4.0), corner(-4.0, 4.0)];
    [dome, TriangleMesh { positions: floor, triangles: vec![[0, 1, 2], [0, 2, 3]] }]
}

#[test]
fn what_stands_around_either_body_speaks_for_no_unit_and_changes_nothing() {
    let (cloth, mannequin, body) = (garment(Garment::Sweater), sample(Kind::Mannequin), avatar(Avatar::Slim));
    let mesh = |s: &Sample| TriangleMesh { positions: s.mesh.positions.clone(), triangles: s.mesh.triangles.clone() };
    let skeleton = |s: &Sample| Skeleton { joints: s.skeleton.joints.to_vec(), bones: BONES.to_vec() };
    let dressed = |target: TriangleMesh, source: TriangleMesh| {
        let mut session = Session::new();
        session.set_garment(mesh(&cloth), Precision::F32).unwrap();
        session.set_source_skeleton(skeleton(&cloth)).unwrap();
        session.set_target_avatar(target).unwrap();
        session.set_target_skeleton(skeleton(&body)).unwrap();
        session.set_source_avatar(source).unwrap();
        run(session)
    };
    let (alone, _) = dressed(mesh(&body), mesh(&mannequin));
    let joined = |mut mesh: TriangleMesh, more: &TriangleMesh| {
        let first = mesh.positions.len() as u32;
        mesh.positions.extend(&more.positions);
        mesh.triangles.extend(more.triangles.iter().map(|t| t.map(|v| first + v)));
        mesh
    };
    let foreign = |session: &Session| -> Vec<Subject> {
        let all = session.diagnostics().iter().filter(|d| d.kind() == DiagnosticKind::ForeignPart);
        all.map(|d| d.elements()[0].subject).collect()
    };
    for more in stage(&mesh(&body)) {
        let (found, session) = dressed(joined(mesh(&body), &more), mesh(&mannequin));
        assert!(found == alone);
        assert_eq!(foreign(&session), [Subject::TargetAvatar]);
    }
    for more in stage(&mesh(&mannequin)) {
        let (found, session) = dressed(mesh(&body), joined(mesh(&mannequin), &more));
        assert!(found == alone);
        assert_eq!(foreign(&session), [Subject::SourceAvatar]);
    }
}

#[test]
fn collision_only_keeps_the_garment_out_but_does_not_draw_it() {
    // A second skin around the arm's upper half, well away from it.
    let shell = tube(0.1, 1.3, |_, _| 0.62, 12, 18, true);
    let (both, own) = with(&shell);
    let radius = |x: &[DVec3]| {
        let far = |p: &DVec3| (p - DVec3::new(0.2 * p.z.max(0.0), 0.0, p.z)).length();
        x.iter().filter(|p| p.z < -0.1).map(far).fold(0.0, f64::max)
    };
    let mut found = Vec::new();
    for role in [PartRole::Body, PartRole::Collision, PartRole::Ignored] {
        let mut session = session(1.0, DVec3::ZERO);
        session.set_target_avatar(both.clone()).unwrap();
        let mut roles = vec![PartRole::Body; own];
        roles.resize(both.triangles.len(), role);
        session.set_avatar_parts(roles).unwrap();
        let (x, session) = run(session);
        let garment = TriangleMesh { positions: x.clone(), triangles: sleeve().triangles };
        let hits = intersections(&garment, Some(&shell), 0).unwrap().count;
        assert_eq!(hits > 0, role == PartRole::Ignored, "{role:?}: {hits}");
        found.push((x, session.report().avatar_size[1]));
    }
    assert_eq!([found[0].1, found[1].1, found[2].1], [both.triangles.len(), both.triangles.len(), own]);
    assert!(found[0].0 != found[1].0);
    // Below the shell it lies on the arm in any case.
    assert!(radius(&found[1].0) < 0.7);
    let (alone, _) = run(session(1.0, DVec3::ZERO));
    assert!(found[2].0 == alone);
}

#[test]
fn roles_are_checked() {
    let mut session = session(1.0, DVec3::ZERO);
    session.set_avatar_parts(vec![PartRole::Body; 3]).unwrap();
    let error = session.prepare().unwrap_err();
    assert_eq!(error.kind, ErrorKind::InvalidArgument);
    assert!(error.message.contains("there are 3 roles"), "{}", error.message);
    let count = thick_arm().triangles.len();
    for role in [PartRole::Ignored, PartRole::Collision] {
        session.set_avatar_parts(vec![role; count]).unwrap();
        assert_eq!(session.prepare().unwrap_err().kind, ErrorKind::InvalidMesh);
    }
    session.clear_avatar_parts().unwrap();
    session.prepare().unwrap();
    assert_eq!(session.set_avatar_parts(Vec::new()).unwrap_err().kind, ErrorKind::InvalidState);
}

#[test]
fn weights_of_the_far_end_give_way_to_the_nearest_bone() {
    // All on the joint at the lower end: the upper bone is far from it.
    let body = tube(-1.1, 1.15, |_, _| 0.1, 14, 18, true);
    let count = body.positions.len();
    let skin = SkinWeights::from_sparse(&vec![0; count], &vec![1.0; count], 1, 3, count, "skin").unwrap();
    let mut told = session(1.0, DVec3::ZERO);
    told.set_target_avatar(body.clone()).unwrap();
    told.set_target_skin(skin).unwrap();
    let (found, told) = run(told);
    assert!(kinds(&told).contains(&DiagnosticKind::WeightsContradict), "{:?}", told.diagnostics());
    let mut alone = session(1.0, DVec3::ZERO);
    alone.set_target_avatar(body).unwrap();
    let (alone, _) = run(alone);
    assert!(found == alone);
}
