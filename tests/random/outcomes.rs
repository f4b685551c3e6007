//! What a caller can rely on at the end: the same bits, the same answer in another order, an error that can be lived with.

use bespoke::control::Stage;
use bespoke::error::ErrorKind;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::options::Options;
use bespoke::session::{Budget, Session};
use glam::DVec3;
use proptest::prelude::*;

use super::{config, flawed, sound};
use testing::Random;
use testing::scene::{Recipe, Scene};

fn bits(session: &Session) -> Vec<[u64; 3]> {
    session.garment_positions().unwrap().into_iter().map(|p| p.to_array().map(f64::to_bits)).collect()
}

/// A random order of `0..count`.
fn order(random: &mut Random, count: usize) -> Vec<usize> {
    let mut order: Vec<usize> = (0..count).collect();
    for k in (1..count).rev() {
        order.swap(k, (random.unit() * (k + 1) as f64) as usize);
    }
    order
}

/// The same garment: vertex `k` is what was vertex `from[k]`, the triangles are in another order and begin elsewhere.
fn permuted(scene: &Scene, from: &[usize], random: &mut Random) -> Scene {
    let garment = &scene.garment;
    let mut to = vec![0; from.len()];
    from.iter().enumerate().for_each(|(k, &v)| to[v] = k as u32);
    let triangles = order(random, garment.triangles.len()).into_iter().map(|t| {
        let mut triangle = garment.triangles[t].map(|v| to[v as usize]);
        triangle.rotate_left((3.0 * random.unit()) as usize);
        triangle
    });
    Scene {
        garment: TriangleMesh {
            triangles: triangles.collect(),
            positions: from.iter().map(|&v| garment.positions[v]).collect(),
        },
        fit_weights: scene.fit_weights.as_ref().map(|w| from.iter().map(|&v| w[v]).collect()),
        ..scene.clone()
    }
}

proptest! {
    #![proptest_config(config(4))]

    /// The same scene twice, in one piece with one thread and in steps with two.
    #[test]
    fn the_same_seed_gives_the_same_bits(recipe in sound()) {
        let scene = Scene::new(&recipe);
        let again = Scene::new(&recipe);
        prop_assert_eq!(&scene.garment, &again.garment);
        prop_assert_eq!(&scene.avatar, &again.avatar);
        let mut first = scene.session().unwrap();
        first.run().unwrap();
        let mut second = again.session().unwrap();
        second.set_options(Options { threads: 2, ..again.options.clone() }).unwrap();
        second.prepare().unwrap();
        while second.step(Budget { iterations: 3, milliseconds: 0 }).unwrap() != Stage::Done {}
        prop_assert_eq!(bits(&first), bits(&second));
    }

    /// In another order of vertices and triangles, the first steps are the same but for rounding; what rounding does to the
    /// path after that must not be seen in the result.
    #[test]
    fn order_does_not_matter(recipe in sound()) {
        let scene = Scene::new(&recipe);
        let mut random = Random::new(recipe.seed);
        let from = order(&mut random, scene.garment.positions.len());
        let other = permuted(&scene, &from, &mut random);
        let (mut one, mut two) = (scene.session().unwrap(), other.session().unwrap());
        one.prepare().unwrap();
        two.prepare().unwrap();
        prop_assert_eq!(one.report().projected_size, two.report().projected_size);
        let apart = |one: &Session, two: &Session| {
            let (a, b) = (one.garment_positions().unwrap(), two.garment_positions().unwrap());
            let size = a.iter().map(|p| p.distance(a[0])).fold(0.0, f64::max);
            from.iter().zip(b).map(|(&v, p)| p.distance(a[v])).fold(0.0, f64::max) / size
        };
        let step = Budget { iterations: 1, milliseconds: 0 };
        for _ in 0..3 {
            prop_assert_eq!(one.step(step).unwrap(), two.step(step).unwrap());
            let (s, t) = (one.report().t, two.report().t);
            prop_assert!((s - t).abs() < 1e-6, "t {} and {}", s, t);
            prop_assert!(apart(&one, &two) < 1e-5, "{:e}", apart(&one, &two));
        }
        prop_assert_eq!(one.run().unwrap(), Stage::Done);
        prop_assert_eq!(two.run().unwrap(), Stage::Done);
        let objective = |s: &Session| s.report().terms.iter().map(|t| t.weight * t.value).sum::<f64>();
        let (a, b) = (objective(&one), objective(&two));
        prop_assert!((a - b).abs() < 0.1 * a.abs().max(b.abs()), "objective {} and {}", a, b);
        prop_assert!(apart(&one, &two) < 0.1, "{}", apart(&one, &two));
    }
}

/// The first thing that a person wants to know of an error, and the way out of it.
fn can_be_lived_with(scene: &Scene, sound: &Scene) -> Result<(), TestCaseError> {
    let mut session = match scene.session() {
        Ok(session) => session,
        Err(error) => {
            prop_assert!(!error.message.is_empty() && error.kind != ErrorKind::Internal, "{:?}", error);
            return Ok(());
        }
    };
    let Err(error) = session.run() else { return Ok(()) };
    prop_assert!(error.message.len() > 20 && error.kind != ErrorKind::Internal, "{:?}", error);
    if session.stage() == Stage::Setup {
        prop_assert_eq!(session.garment_positions().unwrap_err().kind, ErrorKind::InvalidState);
    } else {
        prop_assert_eq!(session.stage(), Stage::Failed);
        let positions = session.garment_positions().unwrap();
        prop_assert_eq!(positions.len(), scene.garment.positions.len());
        prop_assert!(positions.iter().all(|p: &DVec3| p.is_finite()));
        prop_assert!(session.avatar_positions().unwrap().iter().all(|p| p.is_finite()));
        prop_assert_eq!(session.step(Budget::default()).unwrap_err().kind, ErrorKind::InvalidState);
    }
    session.reset();
    prop_assert_eq!(session.stage(), Stage::Setup);
    // As good as new, and with no memory of what was.
    let mut fresh = sound.session().unwrap();
    session.set_options(sound.options.clone()).unwrap();
    session.set_source_coordinate_system(sound.source_coordinate_system).unwrap();
    session.set_target_coordinate_system(sound.target_coordinate_system).unwrap();
    session.set_garment(sound.garment.clone(), sound.precision).unwrap();
    session.set_source_skeleton(sound.source_skeleton.clone()).unwrap();
    session.set_target_avatar(sound.avatar.clone()).unwrap();
    session.set_target_skeleton(sound.target_skeleton.clone()).unwrap();
    session.prepare().unwrap();
    fresh.prepare().unwrap();
    let steps = Budget { iterations: 5, milliseconds: 0 };
    session.step(steps).unwrap();
    fresh.step(steps).unwrap();
    prop_assert_eq!(bits(&session), bits(&fresh));
    Ok(())
}

proptest! {
    #![proptest_config(config(24))]

    #[test]
    fn an_error_can_be_lived_with(recipe in flawed()) {
        // What is optional cannot be unset, so both go without.
        let plain = |scene| Scene { source_avatar: None, skin: None, fit_weights: None, ..scene };
        let mut scene = plain(Scene::new(&recipe));
        // So few iterations that some scenes that would end well end in the middle.
        scene.options.max_iterations = scene.options.max_iterations.min(6);
        can_be_lived_with(&scene, &plain(Scene::new(&Recipe::sound(5))))?;
    }
}

/// A body thinner than the source's, in proportion, and a garment that need not fit it: nothing to do, and the fit finds that
/// there is nothing to do.
#[test]
fn a_fit_without_cost_converges() {
    let mut scene = Scene::new(&Recipe::sound(88));
    scene.options.fit_weight = 0.0;
    let mut session = scene.session().unwrap();
    assert_eq!(session.run().unwrap(), Stage::Done);
    let report = session.report();
    assert!(report.terms.iter().all(|t| t.weight * t.value < 1e-9), "{:?}", report.terms);
    assert!(report.converged && report.fit.iterations < 50, "{} iterations", report.fit.iterations);
}
