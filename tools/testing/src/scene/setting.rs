//! All around the meshes: axes, unit, winding, place and precision of both sides, optional inputs, options.

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::coordinate_system::{Axis, CoordinateSystem, Winding};
use bespoke::input::skeleton::Skeleton;
use bespoke::input::skin::SkinWeights;
use bespoke::options::{Options, SurfaceForm};
use bespoke::session::Precision;
use glam::DVec3;

use super::body::{Bodies, size};
use super::{Flaw, Recipe, Scene, below, between, chance, direction};
use crate::Random;

pub fn choose(random: &mut Random, scene: &mut Scene, bodies: &Bodies, recipe: &Recipe) {
    scene.options = options(random, recipe.has(Flaw::HardOptions));
    if chance(random, 0.25) {
        scene.source_avatar = Some(bodies.on_source.clone());
    }
    if chance(random, 0.25) && scene.avatar.positions.len() == bodies.joints.len() {
        let (weights, joints) = (vec![1.0; bodies.joints.len()], scene.target_skeleton.joints.len());
        let skin = SkinWeights::from_sparse(&bodies.joints, &weights, 1, joints, bodies.joints.len(), "skin");
        scene.skin = Some(skin.expect("the weights fit the body"));
    }
    if chance(random, 0.25) {
        scene.fit_weights = Some(scene.garment.positions.iter().map(|_| 2.0 * random.unit()).collect());
    }
    scene.source_coordinate_system = space(random);
    scene.target_coordinate_system = space(random);
    scene.precision = if recipe.has(Flaw::FarAway) || chance(random, 0.6) { Precision::F32 } else { Precision::F64 };
    // How many times its own size a scene is away from the origin: as far as its precision has digits for.
    let away = |random: &mut Random| match scene.precision {
        _ if recipe.has(Flaw::FarAway) => direction(random) * 10f64.powf(between(random, 1.5, 5.0)),
        _ if chance(random, 0.5) => DVec3::ZERO,
        Precision::F32 => direction(random) * between(random, 0.5, 4.0),
        Precision::F64 => direction(random) * 10f64.powf(between(random, 0.0, 4.0)),
    };
    let place = |random: &mut Random, skeleton: &Skeleton| {
        let scale = 10f64.powf(between(random, -1.5, 1.5));
        (scale, away(random) * scale * size(skeleton))
    };
    let (at_source, at_target) = (place(random, &scene.source_skeleton), place(random, &scene.target_skeleton));
    let precision = scene.precision;
    let put = |space: &CoordinateSystem, (scale, away): (f64, DVec3), points: &mut Vec<DVec3>| {
        points.iter_mut().for_each(|p| *p = precision.round(space.position_from_internal(*p * scale + away)));
    };
    let wind = |space: &CoordinateSystem, mesh: &mut TriangleMesh| {
        mesh.triangles.iter_mut().for_each(|t| *t = space.triangle(*t));
    };
    put(&scene.source_coordinate_system, at_source, &mut scene.garment.positions);
    put(&scene.source_coordinate_system, at_source, &mut scene.source_skeleton.joints);
    wind(&scene.source_coordinate_system, &mut scene.garment);
    if let Some(body) = &mut scene.source_avatar {
        put(&scene.source_coordinate_system, at_source, &mut body.positions);
        wind(&scene.source_coordinate_system, body);
    }
    put(&scene.target_coordinate_system, at_target, &mut scene.avatar.positions);
    put(&scene.target_coordinate_system, at_target, &mut scene.target_skeleton.joints);
    wind(&scene.target_coordinate_system, &mut scene.avatar);
    // The target names its bones in another order and direction.
    let bones = &mut scene.target_skeleton.bones;
    let first = below(random, bones.len());
    bones.rotate_left(first);
    bones.iter_mut().filter(|_| random.unit() < 0.5).for_each(|b| b.swap(0, 1));
}

fn space(random: &mut Random) -> CoordinateSystem {
    if chance(random, 0.4) {
        return CoordinateSystem::default();
    }
    let axes =
        [[Axis::PositiveX, Axis::NegativeX], [Axis::PositiveY, Axis::NegativeY], [Axis::PositiveZ, Axis::NegativeZ]];
    let first = below(random, 3);
    let second = (first + 1 + below(random, 2)) % 3;
    let mut axis = |k: usize| axes[k][below(random, 2)];
    let (right, up, forward) = (axis(first), axis(second), axis(3 - first - second));
    let metres_per_unit = [1.0, 0.01, 0.0254, 0.3048][below(random, 4)];
    let winding = if chance(random, 0.5) { Winding::Clockwise } else { Winding::CounterClockwise };
    CoordinateSystem { right, up, forward, metres_per_unit, winding, trusted: false }
}

fn options(random: &mut Random, hard: bool) -> Options {
    let defaults = Options { threads: 1, voxel_size: 0.02, ..Options::default() };
    if hard {
        let mut log = |low: f64, high: f64| 10f64.powf(between(random, low, high));
        let options = Options {
            fit_weight: log(-3.0, 3.0),
            surface_weight: log(-3.0, 3.0),
            position_weight: log(-3.0, 3.0),
            barrier_weight: log(3.0, 12.0),
            inflation_barrier_weight: log(3.0, 12.0),
            dhat: log(-4.0, -1.3),
            inflation_dhat: log(-4.0, -1.3),
            min_separation: log(-7.0, -4.5),
            voxel_size: log(-2.0, -0.8),
            tolerance: log(-6.0, -1.0),
            max_iterations: 1 + below(random, 200) as u32,
            ..defaults
        };
        return options;
    }
    if chance(random, 0.4) {
        return defaults;
    }
    Options {
        fit_weight: between(random, 0.0, 6.0),
        designed_clearance: between(random, 0.0, 1.5),
        surface_weight: between(random, 0.5, 2.0),
        curvature_weight: between(random, 0.0, 2.0),
        torsion_weight: between(random, 0.0, 2.0),
        position_weight: between(random, 0.0, 20.0),
        dhat: between(random, 0.001, 0.004),
        inflation_dhat: between(random, 0.005, 0.015),
        voxel_size: between(random, 0.01, 0.04),
        surface_form: if chance(random, 0.3) { SurfaceForm::Printed } else { SurfaceForm::Similarity },
        ..defaults
    }
}
