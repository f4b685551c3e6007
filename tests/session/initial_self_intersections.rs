//! Garments as artists leave them: through themselves, split along seams, with buttons; and coordinates that are coarse.

use std::collections::BTreeSet;

use bespoke::contact::Configuration;
use bespoke::control::{Cancel, Stage};
use bespoke::error::ErrorKind;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::diagnostic::{Diagnostic, DiagnosticKind, ElementKind, Severity, Subject};
use bespoke::input::skeleton::Skeleton;
use bespoke::options::Options;
use bespoke::session::{Budget, Precision};
use bespoke::solver::newton::Model;
use bespoke::verify::intersections;
use glam::DVec3;

use crate::small::{arm, moved, problem, session, sleeve, thick_arm, tube};

fn pairs(positions: Vec<DVec3>, triangles: &[[u32; 3]]) -> BTreeSet<[u32; 2]> {
    let mesh = TriangleMesh { positions, triangles: triangles.to_vec() };
    intersections(&mesh, None, usize::MAX).unwrap().pairs.into_iter().collect()
}

/// The pairs of garment triangles that diagnostics of a kind name.
fn named(diagnostics: &[Diagnostic], kind: DiagnosticKind) -> BTreeSet<[u32; 2]> {
    let of_kind = diagnostics.iter().filter(|f| f.kind() == kind);
    let pair = |diagnostic: &Diagnostic| {
        assert!(diagnostic.elements().iter().all(|e| (e.subject, e.kind) == (Subject::Garment, ElementKind::Triangle)));
        let [s, t] = diagnostic.elements()[..] else { panic!("two triangles: {diagnostic:?}") };
        assert!(
            diagnostic.to_string().contains(&s.index.to_string())
                && diagnostic.to_string().contains(&t.index.to_string())
        );
        [s.index.min(t.index), s.index.max(t.index)]
    };
    of_kind.map(pair).collect()
}

/// A sleeve with a wavy lining that passes through it again and again.
fn lined() -> TriangleMesh {
    let mut garment = sleeve();
    let first = garment.positions.len() as u32;
    let lining = tube(
        -0.55,
        0.65,
        |z, angle| 0.3 + 0.03 * (12.0 * z).sin() + 0.01 * (3.0 * angle + 5.0 * z).sin(),
        17,
        22,
        false,
    );
    garment.positions.extend(lining.positions);
    garment.triangles.extend(lining.triangles.iter().map(|t| t.map(|v| v + first)));
    garment
}

/// A sleeve with a panel halfway through it.
fn with_panel() -> TriangleMesh {
    let mut garment = sleeve();
    let first = garment.positions.len() as u32;
    let (count, size) = (5, 0.05);
    for i in 0..count {
        for j in 0..count {
            let (u, v) = (f64::from(i) - 2.0, f64::from(j) - 2.0);
            garment.positions.push(DVec3::new(0.31 + 0.3 * size * u, size * v + 0.003, size * u - 0.3));
        }
    }
    for i in 0..count - 1 {
        for j in 0..count - 1 {
            let a = first + i * count + j;
            garment.triangles.extend([[a, a + 1, a + count], [a + 1, a + count + 1, a + count]]);
        }
    }
    garment
}

/// Every pair that intersects at the start is reported and exempt; no other ever joins them, step by step, and the number of
/// exempt pairs never rises.
#[test]
fn what_intersects_from_the_start_never_gets_more() {
    for garment in [lined(), with_panel()] {
        let start = pairs(garment.positions.clone(), &garment.triangles);
        assert!(start.len() > 3);
        let mut session = session(1.0, DVec3::ZERO);
        session.set_garment(garment.clone(), Precision::F64).unwrap();
        session.prepare().unwrap();
        assert_eq!(named(session.diagnostics(), DiagnosticKind::SelfIntersection), start);
        assert_eq!(session.report().initial_self_intersections, start.len());
        let mut last = start.clone();
        while session.step(Budget { iterations: 1, milliseconds: 0 }).unwrap() != Stage::Done {
            let now = pairs(session.garment_positions().unwrap(), &garment.triangles);
            assert!(now.is_subset(&last), "{:?} joined", now.difference(&last));
            last = now;
        }
        let report = session.report();
        let counted = report.verification.unwrap();
        assert_eq!((counted.garment_garment, counted.initial), (last.len() as u64, last.len() as u64));
        assert!(counted.is_clean() && report.converged, "{:?}", report.fit);
    }
}

/// A sleeve with a tent of so many triangles beside it, whose tip has gone through one triangle of the sleeve; the tip and the
/// direction out of the sleeve.
fn with_tent(count: u32) -> (TriangleMesh, usize, DVec3) {
    let mut garment = sleeve();
    let tip = garment.positions.len();
    // A tent beside the sleeve whose tip has gone through one triangle of it.
    let [a, b, c] = garment.triangles[300].map(|v| garment.positions[v as usize]);
    let (middle, normal) = ((a + b + c) / 3.0, (b - a).cross(c - a).normalize());
    let out = normal * normal.dot(DVec3::new(middle.x, middle.y, 0.0)).signum();
    let (side, up) = ((b - a).normalize(), out.cross(b - a).normalize());
    garment.positions.push(middle - 0.002 * out);
    for k in 0..count {
        let (s, c) = (std::f64::consts::TAU * f64::from(k) / f64::from(count)).sin_cos();
        garment.positions.push(middle + 0.12 * out + 0.1 * (c * side + s * up));
    }
    let corner = |k: u32| tip as u32 + 1 + k % count;
    garment.triangles.extend((0..count).map(|k| [tip as u32, corner(k), corner(k + 1)]));
    (garment, tip, out)
}

/// What intersects at the start depends on how an attempt begins: pulled apart, or as designed.
#[test]
fn every_attempt_is_compared_with_its_own_start() {
    let (garment, tip, _) = with_tent(9);
    let mut session = session(1.0, DVec3::ZERO);
    session.set_garment(garment, Precision::F64).unwrap();
    // All of it is rigid: an arm twice as thick cannot outgrow it, whatever is tried.
    let mut thick = thick_arm();
    thick.positions.iter_mut().for_each(|p| *p *= DVec3::new(2.0, 2.0, 1.0));
    session.set_target_avatar(thick).unwrap();
    session.add_rigid_group((0..tip as u32).collect()).unwrap();
    session.prepare().unwrap();
    let mut most = 0;
    while session.step(Budget { iterations: 1, milliseconds: 0 }).is_ok_and(|stage| stage == Stage::Inflate) {
        let counted = session.verify(Precision::F64).unwrap();
        assert_eq!(counted.garment_garment, counted.initial);
        most = most.max(counted.initial);
    }
    assert!(most > 0, "no attempt began as designed");
}

/// What has separated is active at once: it may not go back.
#[test]
fn what_has_come_apart_stays_apart() {
    let count = 9;
    let (garment, tip, out) = with_tent(count);
    let mut problem = problem(&garment);
    assert!(problem.untangled.take().is_some(), "it begins pulled apart, and here as designed");
    let options = Options::default();
    let mut objective = problem.inflation_objective(&options, &Cancel::new(), &mut Vec::new()).unwrap();
    assert_eq!(
        objective.contact.exempt_pairs().triangle_pairs().len(),
        count as usize,
        "all triangles at the tip pass through one"
    );
    let inward = |x: &[DVec3], depth: f64| {
        let mut dx = vec![DVec3::ZERO; x.len()];
        dx[tip] = -depth * out;
        dx
    };
    // While it is through, the tip may go to and fro.
    let mut x = problem.rest.clone();
    assert_eq!(
        objective.max_feasible_step(Configuration { x: &x, t: 0.0 }, &inward(&x, 0.001), 0.0, 1.0),
        Ok(Some(1.0))
    );
    assert_eq!(
        objective.max_feasible_step(Configuration { x: &x, t: 0.0 }, &inward(&x, -0.003), 0.0, 1.0),
        Ok(Some(1.0))
    );
    x[tip] += 0.003 * out;
    assert!(objective.contact.update_exemptions(Configuration { x: &x, t: 0.0 }).unwrap(), "the barrier has changed");
    assert!(objective.contact.exempt_pairs().is_empty());
    let kept =
        objective.max_feasible_step(Configuration { x: &x, t: 0.0 }, &inward(&x, 0.003), 0.0, 1.0).unwrap().unwrap();
    assert!(kept > 0.1 && kept < 1.0 / 3.0, "the tip stops before the wall, a thousandth away: {kept}");
    assert!(!objective.contact.update_exemptions(Configuration { x: &x, t: 0.0 }).unwrap(), "nothing is new");
}

#[test]
fn strict_refuses_what_intersects_itself() {
    let garment = lined();
    let start = pairs(garment.positions.clone(), &garment.triangles);
    let mut session = session(1.0, DVec3::ZERO);
    session.set_garment(garment, Precision::F64).unwrap();
    session.set_options(Options { strict: true, ..Options::default() }).unwrap();
    let error = session.prepare().unwrap_err();
    assert_eq!(error.kind, ErrorKind::SelfIntersection);
    let [s, t] = start.first().unwrap();
    assert!(error.message.contains(&format!("{} pairs", start.len())), "{error}");
    assert!(error.message.contains(&format!("{s} and {t}")) && error.message.contains("strict"), "{error}");
    session.set_garment(sleeve(), Precision::F64).unwrap();
    assert_eq!(session.run().unwrap(), Stage::Done, "a clean garment passes");
}

/// Split along seams, as a renderer stores it: the same result, and copies have the same bits.
#[test]
fn split_vertices_come_back_together() {
    let whole = sleeve();
    let mut split = TriangleMesh::default();
    let mut source: Vec<u32> = Vec::new();
    for t in &whole.triangles {
        split.triangles.push([0, 1, 2].map(|k| split.positions.len() as u32 + k));
        split.positions.extend(t.map(|v| whole.positions[v as usize]));
        source.extend(t);
    }
    let run = |garment: &TriangleMesh| {
        let mut session = session(1.0, DVec3::ZERO);
        session.set_garment(garment.clone(), Precision::F32).unwrap();
        assert_eq!(session.run().unwrap(), Stage::Done);
        session
    };
    let (one, many) = (run(&whole), run(&split));
    assert_eq!(many.report().garment_size, one.report().garment_size);
    let note = many
        .diagnostics()
        .iter()
        .find(|f| f.kind() == DiagnosticKind::SplitVertices)
        .expect("a note on split vertices");
    assert_eq!(note.severity(), Severity::Note);
    let (one, many) = (one.garment_positions().unwrap(), many.garment_positions().unwrap());
    let (mut place, mut worst) = (vec![None; one.len()], 0.0_f64);
    for (&v, &p) in source.iter().zip(&many) {
        assert_eq!(*place[v as usize].get_or_insert(p), p, "copies of vertex {v} have come apart");
        worst = worst.max(p.distance(one[v as usize]));
    }
    // The numbering differs, and with it the order of sums.
    assert!(worst < 1e-3, "{worst}");
}

/// As far away as a scene may be: what is read in 32 bits is clean, because the garment keeps the distance that rounding
/// takes; or it is refused.
#[test]
fn the_promise_survives_rounding() {
    let far = |factor: f64| DVec3::new(factor, -0.7 * factor, 0.4 * factor);
    let (mut wide, mut refused) = (0, 0);
    for (scale, away) in
        [(1.0, 100.0), (100.0, 20_000.0), (1.0, 4000.0), (1.0, 20_000.0), (1.0, 200_000.0), (1e-3, 1.0), (0.03, 0.0)]
    {
        let mut session = session(1.0, DVec3::ZERO);
        let skeleton = arm(scale, far(away));
        let avatar = moved(&thick_arm(), scale, far(away));
        let stored = |p: DVec3| p.as_vec3().as_dvec3();
        let avatar = TriangleMesh { positions: avatar.positions.into_iter().map(stored).collect(), ..avatar };
        session
            .set_target_skeleton(Skeleton { joints: skeleton.joints.into_iter().map(stored).collect(), ..skeleton })
            .unwrap();
        session.set_target_avatar(avatar.clone()).unwrap();
        session.set_garment(sleeve(), Precision::F32).unwrap();
        match session.run() {
            Ok(stage) => {
                assert_eq!(stage, Stage::Done);
                let read: Vec<DVec3> = session.garment_positions().unwrap().into_iter().map(stored).collect();
                let garment = TriangleMesh { positions: read, triangles: sleeve().triangles };
                assert_eq!(intersections(&garment, None, 0).unwrap().count, 0, "{scale} at {away}");
                assert_eq!(intersections(&garment, Some(&avatar), 0).unwrap().count, 0, "{scale} at {away}");
                wide +=
                    usize::from(session.diagnostics().iter().any(|f| f.kind() == DiagnosticKind::CoarseCoordinates));
            }
            Err(error) => {
                assert!(matches!(error.kind, ErrorKind::InvalidMesh | ErrorKind::NotVerified), "{error}");
                assert!(error.message.contains("nearer to the origin"), "{error}");
                refused += 1;
            }
        }
    }
    assert!(wide >= 2 && (1..=2).contains(&refused), "{wide} with a wider gap, {refused} refused");
}

/// The same far scene in 64 bits needs no wider gap; its 32-bit reading is refused or clean.
#[test]
fn another_precision_is_not_handed_out_unless_it_is_good() {
    let away = DVec3::new(3e5, 0.0, -2e5);
    let mut session = session(1.0, DVec3::ZERO);
    session.set_target_skeleton(arm(1.0, away)).unwrap();
    session.set_target_avatar(moved(&thick_arm(), 1.0, away)).unwrap();
    session.set_garment(sleeve(), Precision::F64).unwrap();
    assert_eq!(session.run().unwrap(), Stage::Done);
    assert!(session.garment_as_read(Precision::F64).is_ok());
    assert!(!session.verify(Precision::F32).unwrap().is_clean());
    let error = session.garment_as_read(Precision::F32).unwrap_err();
    assert_eq!(error.kind, ErrorKind::NotVerified);
    session.reset();
    assert_eq!(session.stage(), Stage::Setup);
    assert!(session.diagnostics().is_empty());
}
