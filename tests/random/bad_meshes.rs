//! Meshes and skeletons that are none: a status and a sentence, never a panic.

use bespoke::error::{ErrorKind, Result};
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::skeleton::Skeleton;
use bespoke::options::Options;
use bespoke::session::Precision;
use glam::DVec3;
use proptest::prelude::*;

use super::config;
use testing::scene::{Recipe, Scene};

/// A coordinate of any size, some of them no numbers.
fn coordinate() -> BoxedStrategy<f64> {
    prop_oneof![
        20 => -2.0..2.0,
        4 => (-2i32..3).prop_map(f64::from),
        1 => prop::sample::select(vec![f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MAX, 1e31]),
        1 => prop::sample::select(vec![0.0, -0.0, f64::MIN_POSITIVE, 5e-324, 1e-30, 1e-12]),
        1 => prop::sample::select(vec![1e30, -1e30, 1e20, 1e9, -1e5]),
    ]
    .boxed()
}

/// Coordinates that are accepted, so that they get farther into the library.
fn number() -> BoxedStrategy<f64> {
    prop_oneof![
        30 => -2.0..2.0,
        5 => (-2i32..3).prop_map(f64::from),
        1 => prop::sample::select(vec![1e-300, 1e-12, 1e3, 1e9, 1e30]),
    ]
    .boxed()
}

fn points(of: BoxedStrategy<f64>, most: usize) -> impl Strategy<Value = Vec<DVec3>> {
    let point = [of.clone(), of.clone(), of].prop_map(DVec3::from_array);
    prop::collection::vec(point, 0..most)
}

/// How a mesh is pressed together before use.
#[derive(Clone, Copy, Debug)]
enum Press {
    No,
    Plane,
    Line,
    Point,
}

fn press() -> impl Strategy<Value = Press> {
    prop_oneof![3 => Just(Press::No), 1 => Just(Press::Plane), 1 => Just(Press::Line), 1 => Just(Press::Point)]
}

fn pressed(mut points: Vec<DVec3>, press: Press) -> Vec<DVec3> {
    for p in &mut points {
        *p = match press {
            Press::No => *p,
            Press::Plane => DVec3::new(p.x, p.y, 0.5),
            Press::Line => DVec3::new(p.x, 0.25, 0.5),
            Press::Point => DVec3::new(0.125, 0.25, 0.5),
        };
    }
    points
}

/// A soup of triangles; `wild` with any coordinates and indices.
fn soup(wild: bool) -> BoxedStrategy<TriangleMesh> {
    let points = points(if wild { coordinate() } else { number() }, 24);
    (points, press(), prop::collection::vec(any::<[u16; 3]>(), 0..40))
        .prop_map(move |(points, press, indices)| {
            // One more than there are, where it is wild.
            let range = (points.len() as u32 + u32::from(wild)).max(1);
            let triangles = indices.into_iter().map(|t| t.map(|v| u32::from(v) % range)).collect();
            TriangleMesh { positions: pressed(points, press), triangles }
        })
        .boxed()
}

fn skeleton(wild: bool) -> BoxedStrategy<Skeleton> {
    let joints = points(if wild { coordinate() } else { number() }, 8);
    (joints, press(), prop::collection::vec(any::<[u16; 2]>(), 0..8), any::<bool>())
        .prop_map(move |(joints, press, pairs, chain)| {
            let count = joints.len() as u32;
            let range = (count + u32::from(wild)).max(1);
            let mut bones: Vec<[u32; 2]> = pairs.into_iter().map(|p| p.map(|j| u32::from(j) % range)).collect();
            if chain {
                bones = (1..count).map(|j| [j - 1, j]).chain(bones.into_iter().take(1)).collect();
            }
            Skeleton { joints: pressed(joints, press), bones }
        })
        .boxed()
}

/// What replaces an input of a sound scene.
#[derive(Clone, Debug)]
enum Bad {
    Garment(TriangleMesh),
    Avatar(TriangleMesh),
    SourceAvatar(TriangleMesh),
    Skeletons(Skeleton, Skeleton),
    Both(TriangleMesh, TriangleMesh),
}

fn bad() -> impl Strategy<Value = Bad> {
    let any_soup = || prop_oneof![soup(false), soup(true)];
    let any_skeleton = || prop_oneof![3 => skeleton(false), 1 => skeleton(true)];
    prop_oneof![
        any_soup().prop_map(Bad::Garment),
        any_soup().prop_map(Bad::Avatar),
        any_soup().prop_map(Bad::SourceAvatar),
        (any_skeleton(), any_skeleton(), any::<bool>()).prop_map(|(source, mut target, same)| {
            if same {
                target = Skeleton { joints: target.joints, bones: source.bones.clone() };
                target.joints.resize(source.joints.len(), DVec3::ONE);
            }
            Bad::Skeletons(source, target)
        }),
        (soup(false), soup(false)).prop_map(|(garment, avatar)| Bad::Both(garment, avatar)),
    ]
}

fn run(scene: &Scene) -> Result<()> {
    let mut session = scene.session()?;
    let outcome = session.run();
    if session.stage() != bespoke::control::Stage::Setup {
        assert!(session.garment_positions()?.iter().all(|p| p.is_finite()), "what is read is a number");
    }
    outcome.map(|_| ())
}

proptest! {
    #![proptest_config(config(200))]

    #[test]
    fn bad_meshes_are_reported(seed in 0u64..8, bad in bad(), precise in any::<bool>()) {
        let mut scene = Scene::new(&Recipe::sound(seed));
        scene.options = Options { threads: 1, voxel_size: 0.04, max_iterations: 8, ..Options::default() };
        scene.precision = if precise { Precision::F64 } else { Precision::F32 };
        (scene.skin, scene.fit_weights) = (None, None);
        match bad {
            Bad::Garment(mesh) => scene.garment = mesh,
            Bad::Avatar(mesh) => scene.avatar = mesh,
            Bad::SourceAvatar(mesh) => scene.source_avatar = Some(mesh),
            Bad::Skeletons(source, target) => (scene.source_skeleton, scene.target_skeleton) = (source, target),
            Bad::Both(garment, avatar) => (scene.garment, scene.avatar) = (garment, avatar),
        }
        if let Err(error) = run(&scene) {
            prop_assert!(error.kind != ErrorKind::Internal && error.message.len() > 20, "{:?}", error);
        }
    }
}
