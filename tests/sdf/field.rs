//! The field against known distances and finite differences.

use bespoke::control::Cancel;
use bespoke::error::ErrorKind;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::sdf::{Field, FieldOptions};
use glam::{DMat3, DVec3};
use rayon::prelude::*;

use crate::shapes::{cuboid, cuboid_distance, sphere, union};
use testing::Random;

/// Relative error of a number in single precision.
const PRECISION: f64 = 6e-8;

fn field(mesh: &TriangleMesh, voxel: f64) -> Field {
    Field::build(mesh, FieldOptions { voxel, threads: 1 }, &Cancel::new()).expect("a field")
}

/// The Hessian of D at `p`, by differences of the gradient.
fn hessian(field: &Field, p: DVec3, voxel: f64) -> DMat3 {
    let step = 1e-4 * voxel;
    let columns = DVec3::AXES.map(|axis| {
        let at = |s: f64| field.value_gradient(p + s * step * axis).1;
        (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * step)
    });
    DMat3::from_cols(columns[0], columns[1], columns[2])
}

#[test]
fn sphere_is_smoothed_by_the_documented_amount() {
    let (radius, voxel) = (0.5, 0.02);
    let field = field(&sphere(DVec3::new(0.3, -0.1, 0.2), radius, 100, 2.0), voxel);
    let mut random = Random::new(1);
    for _ in 0..2000 {
        let direction = random.vector().normalize();
        let r = radius * (0.3 + 1.7 * random.unit());
        let (value, gradient) = field.value_gradient(DVec3::new(0.3, -0.1, 0.2) + r * direction);
        let bias = voxel * voxel / (3.0 * r);
        // The sagitta of the facets, and higher orders of the smoothing.
        assert!((value - (r - radius) - bias).abs() < 3.5e-4, "r {r}: {value}");
        assert!((gradient - direction).length() < 0.03, "r {r}: {gradient} {direction}");
    }
}

/// But for the single precision of the nodes: `PRECISION` of a distance, which derivatives divide by the voxel.
#[test]
fn flat_faces_are_exact() {
    let half = DVec3::new(0.5, 0.3, 0.4);
    let voxel = 0.02;
    let field = field(&cuboid(half), voxel);
    let mut random = Random::new(2);
    for _ in 0..1000 {
        let axis = (random.unit() * 3.0) as usize;
        let mut p = 0.5 * half * random.vector();
        p[axis] = (half[axis] + 0.03 * random.signed()).copysign(random.signed());
        let (value, gradient) = field.value_gradient(p);
        let hessian = hessian(&field, p, voxel);
        let rounding = PRECISION * (0.03 + 2.0 * voxel);
        assert!((value - cuboid_distance(half, p)).abs() < rounding, "{p}");
        assert!((gradient[axis] - p[axis].signum()).abs() < 2.0 * rounding / voxel);
        assert!(hessian.to_cols_array().iter().all(|h| h.abs() < 4.0 * rounding / (voxel * voxel)));
    }
}

#[test]
fn derivatives_agree_with_finite_differences() {
    let mesh = union(sphere(DVec3::ZERO, 0.3, 16, 2.0), &cuboid(DVec3::new(0.5, 0.1, 0.1)));
    let voxel = 0.03;
    let field = field(&mesh, voxel);
    let mut random = Random::new(3);
    for i in 0..400 {
        // Some far out, where nothing is stored.
        let p = if i % 4 == 0 { 3.0 } else { 0.6 } * random.vector();
        let (value, gradient) = field.value_gradient(p);
        assert_eq!(value, field.value(p));
        let step = 1e-4 * voxel;
        for axis in 0..3 {
            let at = |s: f64| field.value(p + s * step * DVec3::AXES[axis]);
            let slope = (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * step);
            assert!((slope - gradient[axis]).abs() < 1e-7, "{p}: {slope} {}", gradient[axis]);
        }
        // The gradient is integrable: its derivatives are symmetric.
        let hessian = hessian(&field, p, voxel);
        for axis in 0..3 {
            let (column, row) = (hessian.col(axis), hessian.row(axis));
            assert!((column - row).length() < 2e-2, "{p}: {column} {row}");
        }
    }
}

#[test]
fn continuous_where_the_stored_region_ends() {
    let mesh = cuboid(DVec3::splat(0.2));
    let voxel = 0.05;
    let field = field(&mesh, voxel);
    // Along each axis from the middle to far out, in steps that see a jump in the second derivative's integral.
    for axis in DVec3::AXES {
        let step = 0.013;
        let mut before = field.value_gradient(0.21 * axis);
        for i in 1..200 {
            let p = (0.21 + step * f64::from(i)) * axis + DVec3::splat(0.01);
            let now = field.value_gradient(p);
            assert!((now.1 - axis).length() < 0.05, "{p}: {}", now.1);
            if i > 1 {
                assert!((now.0 - before.0 - step).abs() < 1e-3, "{p}: {} {}", before.0, now.0);
            }
            before = now;
        }
    }
    // Very far, and not a number, must not hang or panic.
    for scale in [1e6, 1e12, 1e20] {
        let value = field.value(DVec3::X * scale);
        assert!((value / scale - 1.0).abs() < 1e-6 || scale > 1e15, "{scale}: {value}");
    }
    assert!(field.value(DVec3::NAN).is_nan());
}

#[test]
fn open_surface_has_distance_and_no_inside() {
    // A bowl. Where the sign means nothing the distance must still be correct.
    let mesh = sphere(DVec3::ZERO, 0.5, 60, 0.0);
    let voxel = 0.01;
    let field = field(&mesh, voxel);
    let mut random = Random::new(4);
    let mut checked = 0;
    for _ in 0..2000 {
        let p = 0.8 * random.vector();
        let exact = field.closest_point().distance(p);
        if exact < 4.0 * voxel || p.length() < 0.1 || p.z > 0.0 {
            // Beside the sheet, and on the medial axis, the field is smooth and the distance is not.
            continue;
        }
        checked += 1;
        assert!((field.value(p) - exact).abs() < 4e-4, "{p}: {} {exact}", field.value(p));
    }
    assert!(checked > 200);
}

#[test]
fn inner_walls_of_overlapping_parts_are_inside() {
    let (a, b) = (DVec3::new(-0.2, 0.0, 0.0), DVec3::new(0.2, 0.0, 0.0));
    let mesh = union(sphere(a, 0.4, 60, 2.0), &sphere(b, 0.4, 60, 2.0));
    let field = field(&mesh, 0.01);
    let mut random = Random::new(5);
    for _ in 0..3000 {
        let p = 0.7 * random.vector();
        let union = (p.distance(a) - 0.4).min(p.distance(b) - 0.4);
        let value = field.value(p);
        if union > 0.02 {
            assert!((value - union).abs() < 2e-3, "{p}: {value} {union}");
        } else if union < -0.02 {
            assert!(value < 0.0, "{p}: {value} {union}");
        }
    }
}

#[test]
fn bits_do_not_depend_on_threads() {
    let mesh = union(sphere(DVec3::ZERO, 0.5, 40, 2.0), &cuboid(DVec3::new(0.8, 0.3, 0.2)));
    let mut random = Random::new(6);
    let points: Vec<DVec3> = (0..20_000).map(|_| random.vector()).collect();
    let sample = |threads: u32, parallel: bool| -> Vec<u64> {
        let options = FieldOptions { voxel: 0.02, threads };
        let field = Field::build(&mesh, options, &Cancel::new()).expect("a field");
        if parallel {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build().expect("a pool");
            // In reverse order, so that the nodes are first computed in another order.
            let mut bits: Vec<u64> =
                pool.install(|| points.par_iter().rev().map(|&p| field.value(p).to_bits()).collect());
            bits.reverse();
            bits
        } else {
            points.iter().map(|&p| field.value(p).to_bits()).collect()
        }
    };
    let one = sample(1, false);
    assert!(one == sample(2, false));
    assert!(one == sample(2, true));
}

#[test]
fn many_samples_are_those_of_one() {
    let field = field(&sphere(DVec3::ZERO, 0.3, 16, 2.0), 0.03);
    let mut random = Random::new(7);
    // Some far out, where nothing is stored.
    let points: Vec<DVec3> = (0..999).map(|i| if i % 7 == 0 { 3.0 } else { 0.5 } * random.vector()).collect();
    let mut values = vec![0.0; points.len()];
    let mut both = vec![(0.0, DVec3::ZERO); points.len()];
    field.values(&points, &mut values);
    field.values_gradients(&points, &mut both);
    for (i, &p) in points.iter().enumerate() {
        assert_eq!(values[i], field.value(p));
        assert_eq!(both[i], field.value_gradient(p));
        assert_eq!(values[i], both[i].0);
    }
    // As many as there are outputs.
    let mut few = [f64::NAN; 3];
    field.values(&points, &mut few[..2]);
    assert!(few[..2] == values[..2] && few[2].is_nan());
    field.values(&points[..1], &mut few);
    assert!(few[..2] == values[..2] && few[2].is_nan());
}

/// Threads that reach the same cells at the same time: every node is computed by one of them or by both, to the same bits.
#[test]
fn threads_that_meet_in_a_cell_agree() {
    let mesh = union(sphere(DVec3::ZERO, 0.5, 40, 2.0), &cuboid(DVec3::new(0.8, 0.3, 0.2)));
    let mut random = Random::new(8);
    let points: Vec<DVec3> = (0..3000).map(|_| 0.3 * random.vector() + DVec3::new(0.4, 0.1, 0.0)).collect();
    let serial = field(&mesh, 0.02);
    let want: Vec<u64> = points.iter().map(|&p| serial.value(p).to_bits()).collect();
    for _ in 0..4 {
        let shared = field(&mesh, 0.02);
        let gate = std::sync::Barrier::new(4);
        std::thread::scope(|scope| {
            for _ in 0..4 {
                scope.spawn(|| {
                    gate.wait();
                    for (&p, &bits) in points.iter().zip(&want) {
                        assert_eq!(shared.value(p).to_bits(), bits);
                    }
                });
            }
        });
    }
}

#[test]
fn refuses_what_it_cannot_use() {
    let build = |mesh: &TriangleMesh, voxel| {
        Field::build(mesh, FieldOptions { voxel, threads: 1 }, &Cancel::new()).expect_err("unusable").kind
    };
    let mesh = cuboid(DVec3::ONE);
    assert_eq!(build(&TriangleMesh::default(), 0.1), ErrorKind::InvalidMesh);
    for voxel in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-5] {
        assert_eq!(build(&mesh, voxel), ErrorKind::InvalidArgument, "{voxel}");
    }
    let stop = Cancel::new();
    stop.request();
    let stopped = Field::build(&mesh, FieldOptions::default(), &stop).expect_err("stopped");
    assert_eq!(stopped.kind, ErrorKind::Cancelled);
}

#[test]
fn a_voxel_may_be_larger_than_the_mesh() {
    let field = field(&cuboid(DVec3::splat(0.01)), 1.0);
    assert!((field.value(DVec3::new(20.0, 0.0, 0.0)) - 20.0).abs() < 0.1);
}

/// A part of a garment that begins far away must not hold up all the rest: a far sample is one search, and so, to the bit, the
/// exact distance; what is interpolated takes 64 of them.
#[test]
fn a_far_sample_is_the_exact_distance() {
    let voxel = 0.01;
    let field = field(&union(sphere(DVec3::ZERO, 0.5, 120, 2.0), &cuboid(DVec3::new(0.8, 0.3, 0.2))), voxel);
    let mut random = Random::new(11);
    let points: Vec<DVec3> = (0..4000).map(|_| 200.0 * random.vector()).filter(|p| p.length() > 3.0).collect();
    let mut out = vec![(0.0, DVec3::ZERO); points.len()];
    field.values_gradients(&points, &mut out);
    for (&p, &(value, gradient)) in points.iter().zip(&out) {
        assert_eq!(value, field.closest_point().distance(p), "{p}");
        assert!((gradient.length() - 1.0).abs() < 1e-12);
    }
}
