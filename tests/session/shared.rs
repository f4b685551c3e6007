//! Avatars and garments that sessions share: the results are those without, and what is shared is computed once.

use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, Barrier};
use std::thread;
use std::time::Duration;

use bespoke::control::{Cancel, Stage};
use bespoke::error::{Error, ErrorKind};
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::coordinate_system::{Axis, CoordinateSystem};
use bespoke::memo::{Memo, MeshBits};
use bespoke::session::{Options, Pin, Precision, Session, SharedAvatar, SharedGarment};
use glam::DVec3;
use testing::scene::{Recipe, Scene};

use crate::small::{arm, moved, session, thick_arm, tube};

/// Sleeves of several widths and lengths.
fn sleeves() -> Vec<TriangleMesh> {
    (0..3).map(|k| tube(-0.6 + 0.1 * f64::from(k), 0.7, |_, _| 0.3 + 0.02 * f64::from(k), 12, 16, false)).collect()
}

/// Arms of several thicknesses.
fn arms() -> Vec<TriangleMesh> {
    (0..3).map(|k| tube(-1.1, 1.15, |z, _| 0.3 + 0.04 * f64::from(k) + 0.1 * z * z, 14, 18, true)).collect()
}

fn alone(garment: &TriangleMesh, avatar: &TriangleMesh) -> Vec<DVec3> {
    let mut session = session(1.0, DVec3::ZERO);
    session.set_garment(garment.clone(), Precision::F64).unwrap();
    session.set_source_avatar(arms()[0].clone()).unwrap();
    session.set_target_avatar(avatar.clone()).unwrap();
    finished(&mut session)
}

fn finished(session: &mut Session) -> Vec<DVec3> {
    assert_eq!(session.run().unwrap(), Stage::Done);
    assert!(session.report().verification.unwrap().is_clean());
    session.garment_positions().unwrap()
}

fn same_bits(a: &[DVec3], b: &[DVec3]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(p, q)| p.to_array().map(f64::to_bits) == q.to_array().map(f64::to_bits))
}

fn shared(avatars: &[TriangleMesh], garments: &[TriangleMesh]) -> (Vec<SharedAvatar>, Vec<SharedGarment>) {
    let mut from = session(1.0, DVec3::ZERO);
    let avatars = avatars.iter().map(|avatar| {
        from.set_target_avatar(avatar.clone()).unwrap();
        from.share_avatar().unwrap()
    });
    let avatars = avatars.collect();
    from.set_source_avatar(arms()[0].clone()).unwrap();
    let garments = garments.iter().map(|garment| {
        from.set_garment(garment.clone(), Precision::F64).unwrap();
        from.share_garment().unwrap()
    });
    (avatars, garments.collect())
}

/// Every garment on every avatar, all at once, with one thread and with several, and the handles gone before the sessions end.
#[test]
fn many_threads_get_the_bits_of_single_sessions() {
    let (arms, sleeves) = (arms(), sleeves());
    let (avatars, garments) = shared(&arms, &sleeves);
    let begin = Barrier::new(2 * arms.len() * sleeves.len());
    let results = thread::scope(|scope| {
        let mut running = Vec::new();
        for (a, avatar) in avatars.into_iter().enumerate() {
            for (g, garment) in garments.iter().cloned().enumerate() {
                for threads in 1..=2 {
                    let (avatar, garment, begin) = (avatar.clone(), garment.clone(), &begin);
                    running.push(scope.spawn(move || {
                        let mut session = Session::new();
                        session.set_options(Options { threads, ..Options::default() }).unwrap();
                        session.use_avatar(&avatar).unwrap();
                        session.use_garment(&garment).unwrap();
                        drop((avatar, garment));
                        begin.wait();
                        (a, g, finished(&mut session))
                    }));
                }
            }
        }
        running.into_iter().map(|thread| thread.join().unwrap()).collect::<Vec<_>>()
    });
    for (a, avatar) in arms.iter().enumerate() {
        for (g, garment) in sleeves.iter().enumerate() {
            let expected = alone(garment, avatar);
            for (.., found) in results.iter().filter(|result| (result.0, result.1) == (a, g)) {
                assert!(same_bits(found, &expected), "garment {g} on avatar {a}");
            }
        }
    }
}

/// Of everything that a caller may hand in, sound or not.
#[test]
fn random_scenes_come_out_as_without_sharing() {
    for seed in 0..8 {
        let scene = Scene::new(&Recipe::mixed(seed));
        let (Ok(mut own), Ok(from)) = (scene.session(), scene.session()) else { continue };
        let (avatar, garment) = (from.share_avatar().unwrap(), from.share_garment().unwrap());
        for round in 0..2 {
            let mut other = Session::new();
            other.set_options(scene.options.clone()).unwrap();
            other.use_garment(&garment).unwrap();
            other.use_avatar(&avatar).unwrap();
            own.reset();
            let (expected, found) = (own.run(), other.run());
            assert_eq!(expected, found, "seed {seed}, round {round}");
            assert_eq!(own.diagnostics(), other.diagnostics(), "seed {seed}, round {round}");
            if let Ok(expected) = own.garment_positions() {
                assert!(same_bits(&expected, &other.garment_positions().unwrap()), "seed {seed}, round {round}");
            }
        }
    }
}

/// What is set afterwards wins, in that session only, whatever it is.
#[test]
fn what_is_set_afterwards_holds_for_one_session() {
    let (sleeve, arms) = (sleeves().remove(0), arms());
    let (avatars, garments) = shared(&arms[..1], std::slice::from_ref(&sleeve));
    let user = || {
        let mut session = Session::new();
        session.use_avatar(&avatars[0]).unwrap();
        session.use_garment(&garments[0]).unwrap();
        session
    };
    let plain = finished(&mut user());
    assert!(same_bits(&plain, &alone(&sleeve, &arms[0])));
    // Another body, another skeleton, another space, another garment, pins.
    let mut other = user();
    other.set_target_avatar(arms[1].clone()).unwrap();
    assert!(same_bits(&finished(&mut other), &alone(&sleeve, &arms[1])));
    let mut large = user();
    large.set_target_avatar(moved(&arms[0], 2.0, DVec3::X)).unwrap();
    large.set_target_skeleton(arm(2.0, DVec3::X)).unwrap();
    let mut expected = session(1.0, DVec3::ZERO);
    expected.set_garment(sleeve.clone(), Precision::F64).unwrap();
    expected.set_source_avatar(arms[0].clone()).unwrap();
    expected.set_target_avatar(moved(&arms[0], 2.0, DVec3::X)).unwrap();
    expected.set_target_skeleton(arm(2.0, DVec3::X)).unwrap();
    assert!(same_bits(&finished(&mut large), &finished(&mut expected)));
    let mut pinned = user();
    pinned.set_pins(vec![Pin { vertex: 3, target: Some(plain[3] + DVec3::new(0.01, 0.0, 0.0)) }]).unwrap();
    assert!(!same_bits(&finished(&mut pinned), &plain));
    let mut replaced = user();
    replaced.set_garment(sleeves().remove(1), Precision::F64).unwrap();
    assert!(same_bits(&finished(&mut replaced), &alone(&sleeves()[1], &arms[0])));
    // Nobody else notices.
    assert!(same_bits(&finished(&mut user()), &plain));
}

/// All that belongs to a side goes along, and replaces what was there.
#[test]
fn a_side_comes_with_all_that_was_set_of_it() {
    let space = CoordinateSystem { up: Axis::PositiveZ, forward: Axis::PositiveY, ..CoordinateSystem::default() };
    let mut from = session(1.0, DVec3::ZERO);
    from.add_layer(tube(-0.4, 0.4, |_, _| 0.55, 8, 16, false)).unwrap();
    from.set_target_coordinate_system(space).unwrap();
    let avatar = from.share_avatar().unwrap();
    let mut other = session(1.0, DVec3::ZERO);
    other.use_avatar(&avatar).unwrap();
    assert_eq!(other.layer_count(), 1);
    let garment = session(1.0, DVec3::ZERO).share_garment().unwrap();
    other.use_garment(&garment).unwrap();
    assert_eq!(other.garment_vertex_count(), session(1.0, DVec3::ZERO).garment_vertex_count());
    other.use_avatar(&session(1.0, DVec3::ZERO).share_avatar().unwrap()).unwrap();
    assert_eq!(other.layer_count(), 0);
    // Not while it runs, and not of nothing.
    other.prepare().unwrap();
    let refused = |outcome: Result<(), Error>| assert_eq!(outcome.unwrap_err().kind, ErrorKind::InvalidState);
    refused(other.use_avatar(&avatar));
    refused(other.use_garment(&garment));
    refused(Session::new().share_avatar().map(drop));
    refused(Session::new().share_garment().map(drop));
    // Of a session that runs, or has ended, as of another.
    other.step(bespoke::session::Budget { iterations: 1, milliseconds: 0 }).unwrap();
    assert!(other.share_avatar().is_ok() && other.share_garment().is_ok());
}

/// The distance field is built by one of them: what the others report of it is next to nothing.
#[test]
fn the_field_is_built_once() {
    let mut from = session(1.0, DVec3::ZERO);
    from.set_target_avatar(thick_arm()).unwrap();
    let avatar = from.share_avatar().unwrap();
    let mut seconds = Vec::new();
    for _ in 0..3 {
        let mut session = session(1.0, DVec3::ZERO);
        session.set_options(Options { voxel_size: 0.004, threads: 1, ..Options::default() }).unwrap();
        session.use_avatar(&avatar).unwrap();
        finished(&mut session);
        seconds.push(session.report().field_seconds);
    }
    println!("{seconds:?}");
    assert!(seconds[1..].iter().all(|&s| s < 0.1 * seconds[0]), "{seconds:?}");
}

#[test]
fn a_value_is_made_once_for_all_threads() {
    let (memo, made) = (Memo::new(4), AtomicU32::new(0));
    thread::scope(|scope| {
        for k in 0..16_u32 {
            let (memo, made) = (&memo, &made);
            scope.spawn(move || {
                let make = || {
                    thread::sleep(Duration::from_millis(20));
                    Ok(made.fetch_add(1, Ordering::Relaxed))
                };
                memo.get(k % 2, &Cancel::new(), make).unwrap();
            });
        }
    });
    assert_eq!(made.into_inner(), 2);
}

/// Whoever waits for one that fails, panics or is cancelled makes it himself, and whoever is cancelled does not wait.
#[test]
fn a_failure_stays_with_its_thread() {
    for fault in 0..3 {
        let memo = Memo::<u32, u32>::new(1);
        let (inside, may_fail) = (Barrier::new(2), Barrier::new(2));
        thread::scope(|scope| {
            let failing = scope.spawn(|| {
                memo.get(7, &Cancel::new(), || {
                    inside.wait();
                    may_fail.wait();
                    match fault {
                        0 => Err(Error::new(ErrorKind::InvalidMesh, "made by the test")),
                        1 => Err(bespoke::control::Cancelled.into()),
                        _ => panic!("made by the test"),
                    }
                })
            });
            inside.wait();
            let cancel = Cancel::new();
            cancel.request();
            assert_eq!(memo.get(7, &cancel, || Ok(0)).unwrap_err().kind, ErrorKind::Cancelled);
            let waiting = scope.spawn(|| memo.get(7, &Cancel::new(), || Ok(3)));
            thread::sleep(Duration::from_millis(20));
            may_fail.wait();
            assert_eq!(*waiting.join().unwrap().unwrap(), 3);
            assert!(failing.join().map_or(true, |outcome| outcome.is_err()));
        });
    }
}

#[test]
fn keys_are_compared_to_the_bit_and_the_oldest_goes() {
    let mesh = |x: f64| {
        let positions = vec![DVec3::new(x, 0.0, 0.0), DVec3::X, DVec3::Y];
        MeshBits(Arc::new(TriangleMesh { positions, triangles: vec![[0, 1, 2]] }))
    };
    assert!(mesh(0.0) == mesh(0.0) && mesh(0.0) != mesh(-0.0) && mesh(0.0) != mesh(1e-300));
    let (memo, made) = (Memo::new(2), AtomicU32::new(0));
    for (x, so_far) in [(0.0, 1), (1.0, 2), (0.0, 2), (2.0, 3), (1.0, 3), (0.0, 4)] {
        memo.get(mesh(x), &Cancel::new(), || Ok(made.fetch_add(1, Ordering::Relaxed))).unwrap();
        assert_eq!(made.load(Ordering::Relaxed), so_far);
    }
}
