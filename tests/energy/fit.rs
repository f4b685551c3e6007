//! The fit term: its closed form on a plane, its derivatives, its clearances.

use std::ops::Range;
use std::sync::Arc;

use bespoke::control::Cancel;
use bespoke::energy::fit::{Clearance, Fit};
use bespoke::energy::{Configuration, Direction, Energy, Sink};
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::sdf::{Field, FieldOptions};
use glam::DVec3;

use crate::harness::{check_gradient, check_hessian, check_semidefinite, dense};
use testing::Random;

/// A tetrahedron with one face in the plane z = 0 and the rest below.
fn field(voxel: f64) -> Arc<Field> {
    let positions = vec![
        DVec3::new(-2.0, -1.5, 0.0),
        DVec3::new(2.0, -1.5, 0.0),
        DVec3::new(0.0, 2.5, 0.0),
        DVec3::new(0.0, 0.0, -2.0),
    ];
    let mesh = TriangleMesh { positions, triangles: vec![[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]] };
    Arc::new(Field::build(&mesh, FieldOptions { voxel, threads: 1 }, &Cancel::new()).expect("a field"))
}

/// Two triangles over one edge, some way above the plane.
fn garment(random: &mut Random, height: f64) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let corners = [[-0.3, -0.2], [0.4, -0.1], [0.1, 0.3], [0.0, -0.5]];
    let x = corners.map(|[x, y]| DVec3::new(x, y, height) + 0.05 * random.vector());
    (x.to_vec(), vec![[0, 1, 2], [1, 0, 3]])
}

fn value(fit: &Fit, x: &[DVec3]) -> f64 {
    fit.value(Configuration { x, t: 1.0 }, 0..fit.len())
}

#[test]
fn integral_over_a_plane_is_exact() {
    let field = field(0.05);
    let mut random = Random::new(1);
    let (x, triangles) = garment(&mut random, 0.2);
    // The integral of d^2 over a triangle with corner values d, over its area.
    let moment =
        |d: [f64; 3]| (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] + d[0] * d[1] + d[0] * d[2] + d[1] * d[2]) / 6.0;
    // Large faces and small ones use different rules; both are exact here.
    for area in [0.3, 1e-4] {
        let fit = Fit::new(field.clone(), &triangles, &[area, 2.0 * area], &[1.0; 4]);
        let per_face = |t: [u32; 3]| moment(t.map(|v| x[v as usize].z));
        let exact = area * per_face(triangles[0]) + 2.0 * area * per_face(triangles[1]);
        // But for the single precision of the field's nodes.
        assert!((value(&fit, &x) / exact - 1.0).abs() < 2e-7, "area {area}: {} {exact}", value(&fit, &x));
    }
    // Weights are linear on a face: with constant distance the integral is their mean.
    let flat: Vec<DVec3> = x.iter().map(|p| p.with_z(0.25)).collect();
    let fit = Fit::new(field, &triangles[..1], &[0.3], &[1.0, 0.5, 3.0, 9.0]);
    assert!((value(&fit, &flat) / (0.3 * 1.5 * 0.0625) - 1.0).abs() < 2e-7);
}

#[test]
fn derivatives_agree_with_finite_differences() {
    let field = field(0.05);
    let mut random = Random::new(2);
    for height in [0.02, 0.1, 0.5, 1.5] {
        let (x, triangles) = garment(&mut random, height);
        let mut fit = Fit::new(field.clone(), &triangles, &[0.2, 0.1], &[1.0, 0.3, 2.0, 0.0]);
        // Too loose at some samples, too tight at others, right at a third.
        let wanted: Vec<Clearance> = fit
            .sample_points(&x)
            .iter()
            .map(|p| match random.unit() {
                u if u < 0.4 => Clearance { most: 0.5 * random.unit() * p.z.abs(), least: f64::NEG_INFINITY },
                u if u < 0.8 => Clearance { most: 10.0, least: p.z + 0.1 + height * random.unit() },
                _ => Clearance { most: 10.0, least: 0.0 },
            })
            .collect();
        fit.set_clearances(&wanted).expect("one a sample");
        check_gradient(&fit, &x, 1.0, 1e-5, 1e-7);
        check_semidefinite(&fit, &x, 1.0, &mut || random.signed());
    }
    // Beside the edges of the body, where D bends.
    let (mut x, triangles) = garment(&mut random, 0.1);
    x.iter_mut().for_each(|p| *p += DVec3::new(1.6, -1.5, 0.0));
    let fit = Fit::new(field.clone(), &triangles, &[0.2, 0.1], &[1.0; 4]);
    check_gradient(&fit, &x, 1.0, 1e-5, 1e-7);
    check_semidefinite(&fit, &x, 1.0, &mut || random.signed());
    // D is linear above the plane, but for the nodes' single precision, so Gauss-Newton is the whole Hessian.
    let (x, triangles) = garment(&mut random, 0.3);
    check_hessian(&Fit::new(field, &triangles, &[0.2, 0.1], &[1.0; 4]), &x, 1.0, 1e-4, 1e-5);
}

/// Samples are kept for the derivatives at the same place, in blocks of elements; what is asked for does not depend on it.
#[test]
fn what_was_asked_before_changes_no_bit() {
    let field = field(0.05);
    let mut random = Random::new(4);
    let (columns, rows) = (12u32, 5u32);
    let mut at = || -> Vec<DVec3> {
        let point = |n: u32| DVec3::new(0.05 * f64::from(n % columns), 0.05 * f64::from(n / columns), 0.2);
        (0..columns * rows).map(|n| point(n) + 0.01 * random.vector()).collect()
    };
    let (x, y) = (at(), at());
    let corner = |n: u32| n / (columns - 1) * columns + n % (columns - 1);
    let triangles: Vec<[u32; 3]> = (0..(columns - 1) * (rows - 1))
        .map(corner)
        .flat_map(|v| [[v, v + 1, v + columns], [v + 1, v + columns + 1, v + columns]])
        .collect();
    // Both rules.
    let areas: Vec<f64> = (0..triangles.len()).map(|n| if n % 3 == 0 { 0.3 } else { 1e-4 }).collect();
    let new = || Fit::new(field.clone(), &triangles, &areas, &vec![1.0; x.len()]);
    let (fresh_value, fresh) = (value(&new(), &y), dense(&new(), &y, 1.0));
    let fit = new();
    value(&fit, &x);
    // A part of it, across the blocks, elsewhere.
    fit.value(Configuration { x: &y, t: 1.0 }, 20..70);
    let check = |when: &str| {
        let found = dense(&fit, &y, 1.0);
        assert!(found.gradient == fresh.gradient && found.hessian == fresh.hessian, "{when}");
    };
    check("half of it kept");
    assert_eq!(value(&fit, &y).to_bits(), fresh_value.to_bits());
    check("all of it kept");
    value(&fit, &x);
    check("kept elsewhere");
}

/// Writes down what it is handed, bit by bit.
#[derive(Default, PartialEq, Debug)]
struct Written(Vec<u64>);

impl Sink for Written {
    fn rank_one(&mut self, a: Direction<'_>, g: f64, h: f64) {
        self.0.extend(a.vertices.iter().map(|&v| u64::from(v)));
        let components = a.components.iter().flat_map(|c| c.to_array());
        self.0.extend(components.chain([a.t, g, h]).map(f64::to_bits));
    }
}

/// A term that was asked for values and derivatives here and there, by several threads at once, beside one that never was.
#[test]
fn kept_samples_are_those_of_a_term_that_keeps_none() {
    let field = field(0.05);
    let mut random = Random::new(5);
    let triangles: Vec<[u32; 3]> = (0..150).map(|n| [n, n + 1, n + 2]).collect();
    let areas: Vec<f64> = (0..150).map(|n| if n % 4 == 0 { 0.3 } else { 1e-4 }).collect();
    let mut places: Vec<Vec<DVec3>> =
        (0..3).map(|_| (0..152).map(|_| DVec3::new(0.0, 0.0, 0.2) + 0.3 * random.vector()).collect()).collect();
    // All but one vertex as before, and nothing but the sign of a zero.
    let mut other = places[0].clone();
    other[70].x += 1e-12;
    places.push(other);
    let (mut plus, mut minus) = (places[1].clone(), places[1].clone());
    (plus[5].y, minus[5].y) = (0.0, -0.0);
    places.extend([plus, minus]);
    let new = || Fit::new(field.clone(), &triangles, &areas, &[1.0; 152]);
    let asked = |fit: &Fit, place: usize, range: Range<usize>, has_value: bool| -> Written {
        let at = Configuration { x: &places[place], t: 1.0 };
        let mut written = Written::default();
        if has_value {
            written.0.push(fit.value(at, range).to_bits());
        } else {
            fit.derivatives(at, range, &mut written);
        }
        written
    };
    let mut question = || {
        let mut number = |below: usize| (random.unit() * below as f64) as usize;
        let (a, b) = (number(151), number(151));
        (number(places.len()), a.min(b)..a.max(b), number(2) == 0)
    };
    let questions: Vec<(usize, Range<usize>, bool)> = (0..600).map(|_| question()).collect();
    let answers: Vec<Written> =
        questions.iter().map(|(place, range, has_value)| asked(&new(), *place, range.clone(), *has_value)).collect();
    assert!(answers.iter().filter(|answer| answer.0.len() > 1).count() > 200, "derivatives were asked for");
    let fit = new();
    let check = |number: usize| {
        let (place, range, has_value) = questions[number].clone();
        assert!(asked(&fit, place, range, has_value) == answers[number], "question {number}: {:?}", questions[number]);
    };
    (0..questions.len()).for_each(check);
    std::thread::scope(|scope| {
        for thread in 0..4 {
            let check = &check;
            scope.spawn(move || (0..600).for_each(|k| check((7 * k + 151 * thread) % 600)));
        }
    });
}

#[test]
fn inside_and_within_the_clearance_cost_nothing() {
    let field = field(0.05);
    let mut random = Random::new(3);
    let (below, triangles) = garment(&mut random, -0.2);
    let mut fit = Fit::new(field, &triangles, &[0.2, 0.1], &[1.0; 4]);
    assert_eq!(value(&fit, &below), 0.0);
    assert!(dense(&fit, &below, 1.0).gradient.iter().all(|g| *g == 0.0));

    let (above, _) = garment(&mut random, 0.2);
    assert!(value(&fit, &above) > 0.0);
    // As designed: the clearance that the samples have now.
    let designed = |p: &DVec3| Clearance { most: p.z + 1e-7, least: p.z - 1e-7 };
    let wanted: Vec<Clearance> = fit.sample_points(&above).iter().map(designed).collect();
    fit.set_clearances(&wanted).expect("one a sample");
    assert_eq!(value(&fit, &above), 0.0);
    // Too loose and too tight cost the same.
    for shift in [0.1, -0.1] {
        let shifted: Vec<DVec3> = above.iter().map(|p| *p + shift * DVec3::Z).collect();
        assert!((value(&fit, &shifted) - 0.3 * 0.01).abs() < 1e-8);
    }
    assert!(fit.set_clearances(&wanted[1..]).is_err());
    for bad in [Clearance { most: -1.0, least: -2.0 }, Clearance { most: 1.0, least: 2.0 }] {
        assert!(fit.set_clearances(&vec![bad; wanted.len()]).is_err());
    }
}

#[test]
fn faces_without_weight_are_left_out() {
    let (x, triangles) = garment(&mut Random::new(4), 0.2);
    let field = field(0.1);
    let areas = [0.2, 0.1];
    let both = Fit::new(field.clone(), &triangles, &areas, &[1.0; 4]);
    let one = Fit::new(field.clone(), &triangles, &areas, &[0.0, 0.0, 0.0, 1.0]);
    let none = Fit::new(field, &triangles, &areas, &[0.0; 4]);
    assert_eq!((both.len(), one.len(), none.len()), (2, 1, 0));
    let mut stencils = Vec::new();
    one.stencils(&mut |s| stencils.push(s.to_vec()));
    assert_eq!(stencils, [[1, 0, 3]]);
    assert_eq!(value(&none, &x), 0.0);
    // The elements add up, however they are cut.
    let at = Configuration { x: &x, t: 1.0 };
    assert_eq!(both.value(at, 0..2), both.value(at, 0..1) + both.value(at, 1..2));
}
