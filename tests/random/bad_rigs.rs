//! Rigs that are none: a status and a sentence, never a panic, and never a long run.

use bespoke::error::ErrorKind;
use bespoke::input::rig::{Rig, RigJoint};
use bespoke::input::skin::SkinWeights;
use bespoke::options::Options;
use glam::{DMat4, DVec3, DVec4};
use proptest::prelude::*;

use super::config;
use testing::scene::{Recipe, Scene};

const NAMES: [&str; 14] = [
    "",
    "Hips",
    "Spine",
    "Spine1",
    "Neck",
    "Head",
    "LeftUpLeg",
    "LeftLeg",
    "LeftFoot",
    "RightUpLeg",
    "RightLeg",
    "RightFoot",
    "LeftArm",
    "ik_target",
];

/// What a joint is made of: place, scale, name, and a number from which its parent follows.
type Parts = ([f64; 3], f64, usize, u16);

fn parts() -> impl Strategy<Value = Parts> {
    let number = prop_oneof![8 => -2.0..2.0, 2 => Just(0.25), 1 => prop::sample::select(vec![1e-300, 1e9, 1e30])];
    let scale = prop::sample::select(vec![1.0, 1.0, 100.0, -1.0, 0.0, 1e-12]);
    ([number.clone(), number.clone(), number].boxed(), scale, 0..NAMES.len(), any::<u16>())
}

/// What is wrong with a rig.
#[derive(Clone, Debug)]
enum Wrong {
    Nothing,
    /// A number of the transform of a joint.
    Number(usize, usize, f64),
    /// Parents are any joints, and some that are none.
    Parents,
    /// All joints are in one place.
    OnePlace,
    /// All joints are roots.
    Roots,
}

fn wrong() -> impl Strategy<Value = Wrong> {
    let number = prop::sample::select(vec![f64::NAN, f64::INFINITY, f64::MAX, 0.5, -1e31]);
    prop_oneof![
        4 => Just(Wrong::Nothing),
        1 => (0..24usize, 0..16usize, number).prop_map(|(joint, at, number)| Wrong::Number(joint, at, number)),
        1 => Just(Wrong::Parents),
        1 => Just(Wrong::OnePlace),
        1 => Just(Wrong::Roots),
    ]
}

fn rig() -> impl Strategy<Value = Rig> {
    (prop::collection::vec(parts(), 0..24), wrong()).prop_map(|(parts, wrong)| {
        let count = parts.len();
        let joint = |(index, (place, scale, name, parent)): (usize, Parts)| {
            let parent = usize::from(parent);
            let parent = match wrong {
                Wrong::Parents => Some((parent % (count + 2)) as u32),
                Wrong::Roots => None,
                // One in eight is a root.
                _ if index == 0 || parent.is_multiple_of(8) => None,
                _ => Some((parent % index) as u32),
            };
            let place = if matches!(wrong, Wrong::OnePlace) { DVec3::ONE } else { DVec3::from_array(place) };
            let mut bind =
                DMat4::from_cols(DVec4::X * scale, DVec4::Y * scale, DVec4::Z * scale.abs(), place.extend(1.0));
            if let Wrong::Number(joint, at, number) = wrong
                && joint == index
            {
                let mut numbers = bind.to_cols_array();
                numbers[at] = number;
                bind = DMat4::from_cols_array(&numbers);
            }
            RigJoint { name: NAMES[name].to_owned(), parent, bind }
        };
        Rig { joints: parts.into_iter().enumerate().map(joint).collect() }
    })
}

/// Which sides get a rig; the others keep their skeletons.
fn sides() -> impl Strategy<Value = [bool; 2]> {
    prop::sample::select(vec![[true, true], [true, true], [true, false], [false, true]])
}

/// Weights of one joint each, on the rig or, now and then, on another one.
fn skin(rig: &Rig, vertices: usize, off: bool) -> SkinWeights {
    let count = (rig.joints.len() + usize::from(off)).max(1);
    SkinWeights::from_rows(count, (0..vertices).map(|v| vec![((v * 7 % count) as u32, 1.0)]))
}

proptest! {
    #![proptest_config(config(150))]

    #[test]
    fn bad_rigs_are_reported(
        seed in 0u64..8,
        rigs in [rig(), rig()],
        sides in sides(),
        skinned in any::<bool>(),
        off in prop::bool::weighted(0.1),
        pairs in prop::collection::vec((0u32..24, prop::option::of(0u32..24)), 0..3),
    ) {
        let mut scene = Scene::new(&Recipe::sound(seed));
        scene.options = Options { threads: 1, voxel_size: 0.04, max_iterations: 6, ..Options::default() };
        (scene.skin, scene.fit_weights) = (None, None);
        let mut session = scene.session().expect("the scene is sound");
        let run = || {
            let [source, target] = rigs;
            if skinned && sides[1] && !target.joints.is_empty() {
                session.set_target_skin(skin(&target, scene.avatar.positions.len(), off))?;
            }
            if skinned && sides[0] && !source.joints.is_empty() {
                session.set_garment_skin(skin(&source, scene.garment.positions.len(), off))?;
            }
            if sides[0] {
                session.set_source_rig(source)?;
            }
            if sides[1] {
                session.set_target_rig(target)?;
            }
            session.set_joint_pairs(pairs)?;
            let map = session.joint_map()?;
            assert!(map.joints.iter().all(|joint| (0.0..=1.0).contains(&joint.confidence)));
            session.run()
        };
        if let Err(error) = run() {
            prop_assert!(error.kind != ErrorKind::Internal && error.message.len() > 20, "{:?}", error);
        }
    }
}
