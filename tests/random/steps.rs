//! After every single step, nothing intersects that did not at the start.

use std::collections::BTreeSet;

use bespoke::control::Stage;
use bespoke::error::ErrorKind;
use bespoke::options::Options;
use bespoke::session::{Budget, Pin, Session};
use glam::DVec3;
use proptest::prelude::*;

use super::{config, flawed, sound};
use crate::step_verifier::StepVerifier;
use testing::Random;
use testing::scene::{Recipe, Scene};

/// Steps of a scene of any kind that are verified: most scenes need fewer.
const MOST: u32 = 150;

/// Steps one iteration at a time, each verified, to the end or to `most` of them; the session as it is then.
fn step_by_step(scene: &Scene, most: u32) -> Result<(Session, Option<ErrorKind>), String> {
    walk(scene, scene.session().map_err(|e| e.message)?, most)
}

/// The same for a session with all inputs of `scene`, and perhaps more.
fn walk(scene: &Scene, mut session: Session, most: u32) -> Result<(Session, Option<ErrorKind>), String> {
    if let Err(error) = session.prepare() {
        return Ok((session, Some(error.kind)));
    }
    let verifier =
        StepVerifier::new(scene).map_err(|e| format!("the session prepares what the problem refuses: {e}"))?;
    verifier.verify_step(&session)?;
    for _ in 0..most {
        let reached = session.step(Budget { iterations: 1, milliseconds: 0 });
        verifier.verify_step(&session)?;
        match reached {
            Ok(Stage::Done) => {
                verifier.verify_result(&session)?;
                return Ok((session, None));
            }
            Ok(_) => {}
            Err(error) => return Ok((session, Some(error.kind))),
        }
    }
    Ok((session, None))
}

/// Asks for pins that pull this way and that, for rigid patches and for an offset.
fn control(session: &mut Session, scene: &Scene, random: &mut Random) -> bespoke::error::Result<()> {
    let size = scene.target_skeleton.longest_side("target skeleton")?;
    let mut pick = |count: usize| (random.unit() * count as f64) as usize;
    let (vertices, triangles) = (scene.garment.positions.len(), &scene.garment.triangles);
    let pinned: BTreeSet<u32> = (0..1 + pick(6)).map(|_| pick(vertices) as u32).collect();
    let mut patches: Vec<Vec<u32>> = Vec::new();
    for _ in 0..1 + pick(3) {
        let mut patch = BTreeSet::from(triangles[pick(triangles.len())]);
        for _ in 0..pick(3) {
            let rim: Vec<u32> =
                triangles.iter().filter(|t| t.iter().any(|v| patch.contains(v))).flatten().copied().collect();
            patch.extend(rim);
        }
        patch.retain(|v| patches.iter().all(|earlier| !earlier.contains(v)));
        if !patch.is_empty() {
            patches.push(patch.into_iter().collect());
        }
    }
    let mut place = || scene.avatar.positions[(random.unit() * scene.avatar.positions.len() as f64) as usize];
    let places: Vec<DVec3> = pinned.iter().map(|_| place()).collect();
    let pin = |(&vertex, &p): (&u32, &DVec3)| {
        let target = (random.unit() < 0.7).then(|| p + 0.1 * size * random.vector());
        Pin { vertex, target }
    };
    session.set_pins(pinned.iter().zip(&places).map(pin).collect())?;
    patches.into_iter().try_for_each(|patch| session.add_rigid_group(patch))?;
    session.set_options(Options { offset: 0.02 * size * random.unit(), ..scene.options.clone() })
}

proptest! {
    #![proptest_config(config(14))]

    /// A sound scene comes out, and every step on its way is clean.
    #[test]
    fn of_a_sound_scene(recipe in sound()) {
        let (session, error) = step_by_step(&Scene::new(&recipe), u32::MAX).map_err(TestCaseError::fail)?;
        prop_assert_eq!(error, None);
        prop_assert_eq!(session.stage(), Stage::Done);
    }

    /// Pins wherever they pull and plates wherever they lie: no step is less clean for them.
    #[test]
    fn of_a_scene_with_pins_and_plates(recipe in sound()) {
        let scene = Scene::new(&recipe);
        let mut session = scene.session().unwrap();
        control(&mut session, &scene, &mut Random::new(recipe.seed)).unwrap();
        let (_, error) = walk(&scene, session, MOST).map_err(TestCaseError::fail)?;
        // Pins that pull the garment into the body may make the inflation stall, those that pull it away may draw cloth off its
        // limbs; they are allowed nothing worse.
        let allowed = matches!(error, None | Some(ErrorKind::InflationStalled | ErrorKind::ImplausibleResult));
        prop_assert!(allowed, "{:?}", error);
    }

    /// Whatever is wrong with a scene: no step makes it worse, and what stops it is not this library.
    #[test]
    fn of_a_flawed_scene(recipe in flawed()) {
        let (_, error) = step_by_step(&Scene::new(&recipe), MOST).map_err(TestCaseError::fail)?;
        prop_assert_ne!(error, Some(ErrorKind::Internal));
    }
}

/// The step verifier itself: it must find what a step must not do.
#[test]
fn a_garment_through_itself_and_through_the_body_is_found() {
    let scene = Scene::new(&Recipe::sound(1));
    let mut session = scene.session().unwrap();
    session.prepare().unwrap();
    assert_eq!(StepVerifier::new(&scene).unwrap().verify_step(&session), Ok(()));
    // Two vertices have changed their numbers, which makes a clean garment, but not with the positions of the first.
    let mut other = scene.clone();
    let last = other.garment.positions.len() as u32 - 1;
    other.garment.positions.swap(0, last as usize);
    let swapped = |v: u32| {
        if v == 0 {
            last
        } else if v == last {
            0
        } else {
            v
        }
    };
    other.garment.triangles.iter_mut().for_each(|t| *t = t.map(swapped));
    let message = StepVerifier::new(&other).unwrap().verify_step(&session).unwrap_err();
    assert!(message.contains("garment triangles"), "{message}");
    // The result, and a blade through its middle.
    session.run().unwrap();
    let mut other = scene.clone();
    let result = session.garment_positions().unwrap();
    let middle = result.iter().sum::<DVec3>() / result.len() as f64;
    let reach = 2.0 * result.iter().map(|p| p.distance(middle)).fold(0.0, f64::max);
    let first = other.avatar.positions.len() as u32;
    other.avatar.positions.extend([DVec3::ONE, DVec3::new(-1.0, 1.0, -1.0), -DVec3::ONE].map(|d| middle + reach * d));
    other.avatar.triangles.push([first, first + 1, first + 2]);
    let verifier = StepVerifier { scene: &other, ..StepVerifier::new(&scene).unwrap() };
    let message = verifier.verify_step(&session).unwrap_err();
    assert!(message.contains("garment and avatar triangles"), "{message}");
}
