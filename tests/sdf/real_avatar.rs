//! The Goblin: 20 components that cross each other, with open loops. Prints its figures (`--nocapture`).

use std::time::Instant;

use bespoke::control::Cancel;
use bespoke::geometry::closest_point::closest_on_triangle;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::sdf::volume::{BLOCK, Volume};
use bespoke::sdf::{Field, FieldOptions};
use glam::DVec3;

use testing::Random;
use testing::obj::{assets, read_mesh, read_skeleton};

/// The Goblin, scaled so that the longest side of its skeleton's box is 2; none without the assets.
fn goblin() -> Option<TriangleMesh> {
    let folder = assets()?.join("avatars/Goblin");
    let scale = 2.0 / read_skeleton(&folder.join("skeleton.obj")).longest_side("skeleton").unwrap();
    let mut mesh = read_mesh(&folder.join("avatar.obj"));
    mesh.positions.iter_mut().for_each(|p| *p *= scale);
    Some(mesh)
}

fn brute_force(mesh: &TriangleMesh, p: DVec3) -> f64 {
    let all = mesh.triangles.iter().map(|t| closest_on_triangle(p, &t.map(|v| mesh.positions[v as usize])));
    all.map(|q| q.distance_squared(p)).fold(f64::INFINITY, f64::min).sqrt()
}

/// Points at random distances up to `reach` from random triangles.
fn around(mesh: &TriangleMesh, reach: f64, count: usize) -> Vec<DVec3> {
    let mut random = Random::new(7);
    (0..count)
        .map(|_| {
            let t = mesh.triangles[(random.unit() * mesh.triangles.len() as f64) as usize];
            mesh.positions[t[0] as usize] + reach * random.vector()
        })
        .collect()
}

/// Six points a triangle some way in front of it, triangle by triangle: what a garment's faces sample.
fn layer(mesh: &TriangleMesh, height: f64) -> Vec<DVec3> {
    mesh.triangles
        .iter()
        .flat_map(|t| {
            let [a, b, c] = t.map(|v| mesh.positions[v as usize]);
            let lift = height * (b - a).cross(c - a).normalize_or_zero();
            [(0.1, 0.1), (0.8, 0.1), (0.1, 0.8), (0.4, 0.2), (0.2, 0.4), (0.4, 0.4)]
                .map(|(v, w)| a + v * (b - a) + w * (c - a) + lift)
        })
        .collect()
}

#[test]
fn field_outside_is_the_distance() {
    let Some(mesh) = goblin() else { return };
    let voxel = 0.01;
    let start = Instant::now();
    let options = FieldOptions { voxel, threads: 1 };
    let field = Field::build(&mesh, options, &Cancel::new()).expect("a field");
    println!("build {:.3} s, {:.1} MB", start.elapsed().as_secs_f64(), field.memory() as f64 / 1e6);

    let points = around(&mesh, 0.3, 3000);
    let mut errors: Vec<f64> = Vec::new();
    let mut inside = 0;
    for &p in &points {
        let value = field.value(p);
        let exact = brute_force(&mesh, p);
        assert!((exact - field.closest_point().distance(p)).abs() <= 1e-14);
        if value > 2.0 * voxel {
            errors.push((value - exact).abs());
        } else if value < 0.0 {
            inside += 1;
        }
        // The error is never above the support of the spline, whatever the sign.
        assert!((value.abs() - exact).abs() < 2.0 * voxel, "{p}: {value} {exact}");
    }
    errors.sort_by(f64::total_cmp);
    let at = |q: f64| errors[(q * (errors.len() - 1) as f64) as usize];
    println!(
        "{} outside, {inside} inside; error median {:.1e}, 99 % {:.1e}, largest {:.1e} (voxel {voxel})",
        errors.len(),
        at(0.5),
        at(0.99),
        at(1.0)
    );
    assert!(errors.len() > 1000 && inside > 100);
    // Halfway between two parts of the body the distance has a ridge, which the spline rounds by half a voxel:
    // the mean of |x| under the cubic B-spline is 0.47 along one axis, 0.6 where ridges cross.
    assert!(at(0.5) < 0.02 * voxel && at(0.99) < 0.3 * voxel && at(1.0) < 0.65 * voxel);
}

#[test]
fn bits_do_not_depend_on_threads() {
    let Some(mesh) = goblin() else { return };
    let points = around(&mesh, 0.02, 60_000);
    let sample = |threads| -> Vec<u64> {
        let options = FieldOptions { voxel: 0.01, threads };
        let field = Field::build(&mesh, options, &Cancel::new()).expect("a field");
        points.iter().map(|&p| field.value(p).to_bits()).collect()
    };
    let one = sample(1);
    for _ in 0..3 {
        let two = sample(2);
        let differing = one.iter().zip(&two).filter(|(a, b)| a != b).count();
        assert_eq!(differing, 0, "samples that differ between one thread and two");
    }
}

/// How many nodes around `points` lie inside.
fn nodes_inside(volume: &Volume, points: &[[f32; 3]]) -> u32 {
    let blocks = |axis: usize| {
        let coordinates = || points.iter().map(move |p| p[axis]);
        let low = coordinates().fold(f32::INFINITY, f32::min);
        let high = coordinates().fold(f32::NEG_INFINITY, f32::max);
        (low as i32 - 1..=high as i32 + BLOCK as i32).step_by(BLOCK)
    };
    let origins = blocks(0).flat_map(|x| blocks(1).flat_map(move |y| blocks(2).map(move |z| [x, y, z])));
    origins.map(|origin| volume.block(origin).iter().map(|layer| layer.count_ones()).sum::<u32>()).sum()
}

#[test]
fn figures() {
    let Some(mesh) = goblin() else { return };
    let voxel = 0.01;
    let points: Vec<[f32; 3]> = mesh.positions.iter().map(|&p| (p / voxel).as_vec3().to_array()).collect();
    for band in [2.0, 3.0, 5.0] {
        for threads in [1, 2] {
            let start = Instant::now();
            let volume = Volume::build(&points, &mesh.triangles, band, threads, &Cancel::new()).expect("one");
            let seconds = start.elapsed().as_secs_f64();
            let (nodes, megabytes) = (nodes_inside(&volume, &points), volume.memory() as f64 / 1e6);
            println!("band {band}, {threads} threads: {seconds:.2} s, {nodes} nodes inside, {megabytes:.1} MB");
            assert!(nodes > 100_000);
        }
    }
    let field = Field::build(&mesh, FieldOptions { voxel, threads: 1 }, &Cancel::new()).expect("a field");
    let points = layer(&mesh, 0.03);
    let per = |name: &str, sample: &dyn Fn(DVec3) -> f64| {
        let start = Instant::now();
        let sum: f64 = points.iter().map(|&p| sample(p)).sum();
        let nanoseconds = start.elapsed().as_secs_f64() * 1e9 / points.len() as f64;
        println!("{name}: {nanoseconds:.0} ns a sample (sum {sum:.3}), {:.1} MB", field.memory() as f64 / 1e6);
        assert!(sum.is_finite());
    };
    per("first touch", &|p| field.value(p));
    for _ in 0..2 {
        per("value", &|p| field.value(p));
        per("gradient", &|p| field.value_gradient(p).1.x);
    }
    per("closest point", &|p| field.closest_point().distance(p));
}
