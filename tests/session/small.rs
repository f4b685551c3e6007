//! A sleeve on an arm: small enough to verify every step.

use std::sync::Arc;

use bespoke::control::{Cancel, Stage};
use bespoke::error::ErrorKind;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::skeleton::Skeleton;
use bespoke::input::weld::Weld;
use bespoke::memory::MemoryLimit;
use bespoke::options::Options;
use bespoke::session::{Budget, Precision, Session};
use bespoke::solver::newton::{Model, Newton, State};
use bespoke::stage::inflate::Inflation;
use bespoke::stage::setup::problem::{Inputs, Problem};
use bespoke::verify::intersections;
use glam::DVec3;

/// An arm of two bones with a slight bend.
pub fn arm(scale: f64, away: DVec3) -> Skeleton {
    let joints = [DVec3::new(0.0, 0.0, -1.0), DVec3::ZERO, DVec3::new(0.2, 0.0, 1.0)];
    Skeleton { joints: joints.iter().map(|&p| away + scale * p).collect(), bones: vec![[0, 1], [1, 2]] }
}

/// A tube about the arm from `z` = `low` to `high`, open or with its ends closed by fans.
pub fn tube(
    low: f64,
    high: f64,
    radius: impl Fn(f64, f64) -> f64,
    rings: u32,
    sides: u32,
    closed: bool,
) -> TriangleMesh {
    let mut mesh = TriangleMesh::default();
    let centre = |z: f64| DVec3::new(0.2 * z.max(0.0), 0.0, z);
    for r in 0..=rings {
        let z = low + (high - low) * f64::from(r) / f64::from(rings);
        for s in 0..sides {
            let angle = std::f64::consts::TAU * (f64::from(s) + 0.5 * f64::from(r % 2)) / f64::from(sides);
            mesh.positions.push(centre(z) + radius(z, angle) * DVec3::new(angle.cos(), angle.sin(), 0.0));
        }
    }
    for r in 0..rings {
        for s in 0..sides {
            let at = |r: u32, s: u32| r * sides + s % sides;
            let shift = r % 2;
            let (a, b) = (at(r, s), at(r, s + 1));
            let (c, d) = (at(r + 1, s + sides - 1 + shift), at(r + 1, s + shift));
            mesh.triangles.push([a, d, c]);
            mesh.triangles.push([a, b, d]);
        }
    }
    if closed {
        for (ring, z) in [(0, low), (rings, high)] {
            let tip = mesh.positions.len() as u32;
            mesh.positions.push(centre(z));
            for s in 0..sides {
                mesh.triangles.push([ring * sides + s, ring * sides + (s + 1) % sides, tip]);
            }
        }
    }
    mesh
}

pub fn sleeve() -> TriangleMesh {
    tube(-0.6, 0.7, |z, _| 0.3 + 0.03 * (12.0 * z).sin(), 16, 20, false)
}

/// Thicker than the sleeve, and not round.
pub fn thick_arm() -> TriangleMesh {
    tube(-1.1, 1.15, |z, a| 0.36 + 0.1 * z * z + 0.05 * (3.0 * a).cos(), 14, 18, true)
}

pub fn moved(mesh: &TriangleMesh, scale: f64, away: DVec3) -> TriangleMesh {
    TriangleMesh {
        positions: mesh.positions.iter().map(|&p| away + scale * p).collect(),
        triangles: mesh.triangles.clone(),
    }
}

/// A session with the sleeve on the way to the thick arm, which is scaled and away from the origin.
pub fn session(scale: f64, away: DVec3) -> Session {
    let mut session = Session::new();
    session.set_garment(sleeve(), Precision::F32).unwrap();
    session.set_source_skeleton(arm(1.0, DVec3::ZERO)).unwrap();
    session.set_target_avatar(moved(&thick_arm(), scale, away)).unwrap();
    session.set_target_skeleton(arm(scale, away)).unwrap();
    session
}

#[test]
fn the_sleeve_grows_with_the_arm_and_comes_out_in_the_arms_space() {
    let away = DVec3::new(3.0, -2.0, 7.0);
    let mut session = session(0.05, away);
    assert_eq!(session.run().unwrap(), Stage::Done);
    assert!(session.verify(Precision::F32).unwrap().is_clean());
    assert!(session.verify(Precision::F64).unwrap().is_clean());
    let result = session.garment_positions().unwrap();
    let rest = sleeve();
    assert_eq!(result.len(), rest.positions.len());
    // It is around the arm: each ring's mean stays near the bone, its radius above the arm's own 0.36.
    for (ring, rest) in result.chunks(20).zip(rest.positions.chunks(20)) {
        let mean = ring.iter().sum::<DVec3>() / 20.0;
        let was = away + 0.05 * rest.iter().sum::<DVec3>() / 20.0;
        let radius = ring.iter().map(|p| p.distance(mean)).sum::<f64>() / 20.0 / 0.05;
        assert!(mean.distance(was) < 0.05 * 0.2, "{mean} {was}");
        assert!((0.3..0.6).contains(&radius), "{radius}");
    }
    let report = session.report();
    assert_eq!(report.t, 1.0);
    assert!(report.min_distance_avatar > 1e-5 && report.terms.iter().all(|t| t.value.is_finite()));
}

/// The problem of dressing the thick arm in `garment`.
pub fn problem(garment: &TriangleMesh) -> Problem {
    let (weld, _) = Weld::new(garment);
    let (avatar, skeleton) = (thick_arm(), arm(1.0, DVec3::ZERO));
    let inputs = Inputs {
        garment: &weld.mesh,
        weld: Arc::new(weld.clone()),
        source_skeleton: &skeleton,
        avatar: &avatar.into(),
        target_skeleton: &skeleton,
        skin: None,
        ends: [None, None],
        source_avatar: None,
        fit_weights: None,
        pins: &[],
        rigid_groups: &[],
        curves: &[],
        offset: 0.0,
        coordinate_error: 0.0,
        turns: true,
        known: Arc::default(),
    };
    Problem::new(&inputs, &Options::default(), &Cancel::new(), &mut Vec::new()).unwrap()
}

/// The guarantee of the inflation, checked by the verifier after every step: garment and avatar at t, and the garment itself.
#[test]
fn no_iterate_of_the_inflation_intersects() {
    let (garment, options, mut diagnostics) = (sleeve(), Options::default(), Vec::new());
    let problem = problem(&garment);
    let mut objective = problem.inflation_objective(&options, &Cancel::new(), &mut diagnostics).unwrap();
    assert!(diagnostics.is_empty() && objective.contact.min_separation() == options.min_separation, "{diagnostics:?}");
    let mut state = State { x: problem.rest.clone(), t: 0.0 };
    let mut newton = Newton::new(state.x.len(), &objective.terms(), MemoryLimit::NONE, Cancel::new()).unwrap();
    let mut inflation = Inflation::default();
    let mut last = 0.0;
    for _ in 0..200 {
        let ended = inflation.iterate(&mut objective, &mut newton, &mut state).unwrap();
        let now = TriangleMesh { positions: state.x.clone(), triangles: garment.triangles.clone() };
        let ends = problem.projected.start.iter().zip(&problem.projected.end);
        let body = TriangleMesh {
            positions: ends.map(|(a, b)| a.lerp(*b, state.t)).collect(),
            triangles: problem.projected.triangles.clone(),
        };
        assert_eq!(intersections(&now, None, 4).unwrap().pairs, Vec::<[u32; 2]>::new());
        assert_eq!(intersections(&now, Some(&body), 4).unwrap().pairs, Vec::<[u32; 2]>::new());
        assert!(state.t >= last, "t went back from {last} to {}", state.t);
        last = state.t;
        if ended {
            return;
        }
    }
    panic!("t only reached {last}");
}

#[test]
fn stepping_gives_the_same_bits_as_running_with_any_number_of_threads() {
    let result = |threads: u32, budget: Option<u32>| {
        let mut session = session(1.0, DVec3::ZERO);
        session.set_options(Options { threads, ..Options::default() }).unwrap();
        match budget {
            None => assert_eq!(session.run().unwrap(), Stage::Done),
            Some(iterations) => {
                session.prepare().unwrap();
                while session.step(Budget { iterations, milliseconds: 0 }).unwrap() != Stage::Done {}
            }
        }
        let bits = |p: DVec3| p.to_array().map(f64::to_bits);
        session.garment_positions().unwrap().into_iter().map(bits).collect::<Vec<_>>()
    };
    let first = result(1, None);
    assert_eq!(first, result(2, Some(1)));
    assert_eq!(first, result(5, Some(3)));
}

/// The bones leave it through its side and come back in: they are led back into it.
#[test]
fn a_sleeve_half_beside_its_arm_comes_out_right() {
    let mut session = session(1.0, DVec3::ZERO);
    session.set_garment(moved(&sleeve(), 1.0, DVec3::new(0.3, 0.0, 0.0)), Precision::F64).unwrap();
    assert_eq!(session.run().unwrap(), Stage::Done);
    assert!(session.verify(Precision::F64).unwrap().is_clean());
}

#[test]
fn a_garment_that_shuts_the_arm_in_is_refused_with_the_place() {
    let mut session = session(1.0, DVec3::ZERO);
    session.set_options(Options { keep_caps: true, ..Options::default() }).unwrap();
    let bag = tube(-0.6, 0.7, |z, _| 0.3 + 0.03 * (12.0 * z).sin(), 16, 20, true);
    session.set_garment(bag, Precision::F64).unwrap();
    let error = session.prepare().unwrap_err();
    assert_eq!(error.kind, ErrorKind::NotEnclosed);
    assert!(error.message.contains("garment triangles") && error.message.contains("between joints"), "{error}");
    assert_eq!(session.stage(), Stage::Setup);
    session.set_garment(sleeve(), Precision::F64).unwrap();
    assert_eq!(session.run().unwrap(), Stage::Done, "the session is as good as new");
}

#[test]
fn a_garment_far_beside_its_skeleton_is_refused() {
    for away in [DVec3::new(1.5, 0.0, 0.0), DVec3::new(0.0, -3.0, 0.5), DVec3::new(0.8, 0.8, 0.0)] {
        let mut session = session(1.0, DVec3::ZERO);
        session.set_garment(moved(&sleeve(), 1.0, away), Precision::F64).unwrap();
        let error = session.prepare().unwrap_err();
        assert_eq!(error.kind, ErrorKind::NotEnclosed);
        assert!(error.message.contains("does not enclose the source skeleton"), "{error}");
    }
}

/// Two layers nearer than the minimum separation: that becomes smaller, and the guarantee holds.
#[test]
fn layers_nearer_than_the_minimum_separation_stay_apart() {
    let mut garment = sleeve();
    let count = garment.positions.len() as u32;
    let outer = tube(-0.6, 0.7, |z, _| 0.300004 + 0.03 * (12.0 * z).sin(), 16, 20, false);
    garment.positions.extend(outer.positions);
    garment.triangles.extend(outer.triangles.iter().map(|t| t.map(|v| v + count)));
    let mut session = session(1.0, DVec3::ZERO);
    session.set_garment(garment, Precision::F64).unwrap();
    assert_eq!(session.run().unwrap(), Stage::Done);
    assert!(session.verify(Precision::F64).unwrap().is_clean());
}

/// Vertices that no triangle uses are no part of the body, wherever they are.
#[test]
fn stray_vertices_of_the_avatar_do_no_harm() {
    let mut session = session(1.0, DVec3::ZERO);
    let mut body = thick_arm();
    body.positions.extend([DVec3::new(1e7, 0.0, 0.0), DVec3::new(0.0, 0.0, 1e6)]);
    session.set_target_avatar(body).unwrap();
    assert_eq!(session.run().unwrap(), Stage::Done);
}

/// The middle bone holds no vertex of the body, only triangles that pass it: a sheet across it is found all the same.
#[test]
fn a_bone_that_only_triangles_pass_must_be_enclosed_too() {
    let skeleton = Skeleton {
        joints: [-1.0, -0.3, 0.3, 1.0].map(|z| DVec3::new(0.0, 0.0, z)).to_vec(),
        bones: vec![[0, 1], [1, 2], [2, 3]],
    };
    let body = tube(-1.0, 1.0, |_, _| 0.1, 1, 6, true);
    let sheet = TriangleMesh {
        positions: vec![DVec3::new(-1.0, -1.0, 0.0), DVec3::new(1.0, -1.0, 0.01), DVec3::new(0.0, 1.5, -0.01)],
        triangles: vec![[0, 1, 2]],
    };
    let mut session = Session::new();
    session.set_garment(sheet, Precision::F64).unwrap();
    session.set_source_skeleton(skeleton.clone()).unwrap();
    session.set_target_avatar(body).unwrap();
    session.set_target_skeleton(skeleton).unwrap();
    let error = session.prepare().unwrap_err();
    assert_eq!(error.kind, ErrorKind::NotEnclosed);
    assert!(error.message.contains("between joints 1 and 2"), "{error}");
}

#[test]
fn a_cancel_stops_it_and_a_reset_brings_it_back() {
    let mut session = session(1.0, DVec3::ZERO);
    session.prepare().unwrap();
    session.step(Budget { iterations: 3, milliseconds: 0 }).unwrap();
    session.control().cancel();
    assert_eq!(session.step(Budget::default()).unwrap_err().kind, ErrorKind::Cancelled);
    assert_eq!(session.stage(), Stage::Cancelled);
    assert_eq!(session.garment_positions().unwrap().len(), sleeve().positions.len());
    assert_eq!(session.step(Budget::default()).unwrap_err().kind, ErrorKind::InvalidState);
    session.reset();
    assert_eq!(session.run().unwrap(), Stage::Done);
}

#[test]
fn calls_out_of_order_are_named() {
    let mut session = Session::new();
    assert_eq!(session.step(Budget::default()).unwrap_err().kind, ErrorKind::InvalidState);
    let error = session.prepare().unwrap_err();
    assert!(error.message.contains("the garment is missing"), "{error}");
    let mut session = self::session(1.0, DVec3::ZERO);
    session.set_vertex_fit_weights(vec![1.0; 3]).unwrap();
    assert_eq!(session.prepare().unwrap_err().kind, ErrorKind::InvalidWeights);
    session.set_vertex_fit_weights(vec![1.0; sleeve().positions.len()]).unwrap();
    session.prepare().unwrap();
    assert_eq!(session.set_garment(sleeve(), Precision::F32).unwrap_err().kind, ErrorKind::InvalidState);
    assert_eq!(session.prepare().unwrap_err().kind, ErrorKind::InvalidState);
}

/// Designed clearance: with the source body given, the sleeve stays as loose as it was; without, it closes in.
#[test]
fn the_source_body_keeps_the_designed_clearance() {
    let body = tube(-1.1, 1.1, |_, _| 0.15, 14, 18, true);
    let mean_clearance = |with_source: bool| {
        let mut session = Session::new();
        session.set_garment(sleeve(), Precision::F64).unwrap();
        session.set_source_skeleton(arm(1.0, DVec3::ZERO)).unwrap();
        session.set_target_avatar(body.clone()).unwrap();
        session.set_target_skeleton(arm(1.0, DVec3::ZERO)).unwrap();
        session.set_options(Options { fit_weight: 20.0, ..Options::default() }).unwrap();
        if with_source {
            session.set_source_avatar(body.clone()).unwrap();
        }
        assert_eq!(session.run().unwrap(), Stage::Done);
        let tree = bespoke::geometry::closest_point::ClosestPoint::new(&body);
        let positions = session.garment_positions().unwrap();
        positions.iter().map(|&p| tree.distance(p)).sum::<f64>() / positions.len() as f64
    };
    let tree = bespoke::geometry::closest_point::ClosestPoint::new(&body);
    let designed = sleeve().positions.iter().map(|&p| tree.distance(p)).sum::<f64>() / sleeve().positions.len() as f64;
    assert!((mean_clearance(true) - designed).abs() < 0.02 * designed);
    assert!(mean_clearance(false) < 0.7 * designed);
}

/// A button shares no vertex with the sleeve, and nothing of the sleeve's shape tells where it belongs.
#[test]
fn a_button_keeps_its_place_and_its_size() {
    let mut garment = sleeve();
    let count = garment.positions.len();
    // On the crest of a wave of the sleeve, a little off it.
    let (z, size) = (std::f64::consts::FRAC_PI_2 / 12.0, 0.05);
    let middle = DVec3::new(0.2 * z + 0.35, 0.0, z);
    garment.positions.push(middle);
    garment.positions.extend((0..8).map(|k| {
        let angle = f64::from(k) * std::f64::consts::TAU / 8.0;
        middle + size * DVec3::new(0.0, angle.cos(), angle.sin())
    }));
    let first = count as u32;
    garment.triangles.extend((0..8).map(|k| [first, first + 1 + k, first + 1 + (k + 1) % 8]));

    let mut session = session(1.0, DVec3::ZERO);
    session.set_garment(garment.clone(), Precision::F64).unwrap();
    assert_eq!(session.run().unwrap(), Stage::Done);
    let end = session.garment_positions().unwrap();

    // The vertices of the sleeve around it tell where it belongs and how much the sleeve has grown there.
    let around: Vec<usize> = (0..count).filter(|&v| garment.positions[v].distance(middle) < 0.2).collect();
    assert!(around.len() > 8);
    let seen = |x: &[DVec3]| {
        let centre = around.iter().map(|&v| x[v]).sum::<DVec3>() / around.len() as f64;
        let spread = around.iter().map(|&v| x[v].distance(centre)).sum::<f64>() / around.len() as f64;
        let rim = x[count + 1..].iter().map(|p| p.distance(x[count])).sum::<f64>() / 8.0;
        (x[count].distance(centre) / spread, rim / spread)
    };
    let (before, after) = (seen(&garment.positions), seen(&end));
    println!("{before:?} {after:?}");
    assert!((after.0 - before.0).abs() < 0.1, "it has drifted: {before:?} {after:?}");
    assert!((after.1 / before.1 - 1.0).abs() < 0.2, "its size: {before:?} {after:?}");
}
