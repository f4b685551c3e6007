//! One garment over another.

use std::sync::Arc;

use bespoke::control::{Cancel, Stage};
use bespoke::error::ErrorKind;
use bespoke::geometry::closest_point::ClosestPoint;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::body::Body;
use bespoke::input::coordinate_system::{Axis, CoordinateSystem, Winding};
use bespoke::input::diagnostic::{DiagnosticKind, Subject};
use bespoke::input::skin::SkinWeights;
use bespoke::options::Options;
use bespoke::sdf::{Field, FieldOptions};
use bespoke::session::{CoveredOptions, Precision, Session};
use bespoke::verify::intersections;
use glam::DVec3;

use crate::small::{arm, session, sleeve, thick_arm, tube};
use closet::skeleton::BONES;
use closet::{Kind, Sample, jacket, sample};
use testing::Random;

/// The result as a caller reads it in 32 bits.
fn read(session: &Session, garment: &TriangleMesh) -> TriangleMesh {
    let positions = session.garment_as_read(Precision::F32).unwrap();
    let positions = positions.into_iter().map(|p| Precision::F32.round(p)).collect();
    TriangleMesh { positions, triangles: garment.triangles.clone() }
}

/// The sleeve on the thick arm.
fn first_layer() -> TriangleMesh {
    let mut session = session(1.0, DVec3::ZERO);
    assert_eq!(session.run().unwrap(), Stage::Done);
    read(&session, &sleeve())
}

fn count(a: &TriangleMesh, b: &TriangleMesh) -> u64 {
    intersections(a, Some(b), 0).unwrap().count
}

fn segments(ends: impl Iterator<Item = [DVec3; 2]>) -> TriangleMesh {
    let positions: Vec<DVec3> = ends.flatten().collect();
    let triangles = (0..positions.len() as u32 / 2).map(|k| [2 * k, 2 * k + 1, 2 * k + 1]).collect();
    TriangleMesh { positions, triangles }
}

/// Vertices and middles of the triangles.
fn places(mesh: &TriangleMesh) -> Vec<DVec3> {
    let middle = |t: &[u32; 3]| t.iter().map(|&v| mesh.positions[v as usize]).sum::<DVec3>() / 3.0;
    mesh.positions.iter().copied().chain(mesh.triangles.iter().map(middle)).collect()
}

/// Nothing of `outer` is between `inner` and `body`.
fn is_over(outer: &TriangleMesh, inner: &TriangleMesh, body: &TriangleMesh) {
    let tree = ClosestPoint::new(body);
    // The nearest point of the body is not what lies beneath where the segment to it leads through the layer once more, as from
    // the trunk to an arm.
    let mut ways: Vec<[DVec3; 2]> = places(inner)
        .into_iter()
        .map(|p| {
            let nearest = tree.closest(p).unwrap().point;
            [p.lerp(nearest, 1e-3), nearest]
        })
        .collect();
    let all = ways.len();
    let elsewhere = intersections(&segments(ways.iter().copied()), Some(inner), usize::MAX).unwrap().pairs;
    for &[way, _] in &elsewhere {
        ways[way as usize][0] = ways[way as usize][1];
    }
    ways.retain(|[a, b]| a != b);
    assert!(ways.len() > all * 9 / 10, "{} of {all}", ways.len());
    let found = intersections(&segments(ways.into_iter()), Some(outer), 3).unwrap().pairs;
    assert_eq!(found, Vec::<[u32; 2]>::new(), "beneath the layer");
    for (a, b) in [(outer, inner), (outer, body), (inner, body)] {
        assert_eq!(count(a, b), 0);
    }
    for mesh in [outer, inner] {
        assert_eq!(intersections(mesh, None, 0).unwrap().count, 0);
    }
}

#[test]
fn a_sleeve_over_a_sleeve_lies_outside_it_everywhere() {
    let (layer, body) = (first_layer(), thick_arm());
    // Longer than the layer, so that it hangs over both of its openings, and shorter.
    for (low, high, radius) in [(-0.75, 0.85, 0.4), (-0.4, 0.5, 0.25)] {
        let garment = tube(low, high, |z, _| radius + 0.02 * (9.0 * z).cos(), 13, 17, false);
        let mut session = session(1.0, DVec3::ZERO);
        session.set_garment(garment.clone(), Precision::F32).unwrap();
        session.add_layer(layer.clone()).unwrap();
        assert_eq!(session.run().unwrap(), Stage::Done);
        assert!(session.verify(Precision::F32).unwrap().is_clean());
        let outer = read(&session, &garment);
        is_over(&outer, &layer, &body);

        // And it covers the layer: whoever leaves that away from the bones, goes through it.
        let inside = |p: &DVec3| (low.max(-0.6) + 0.15..high.min(0.7) - 0.15).contains(&p.z);
        let out = |p: DVec3| [p, p + 5.0 * (p - DVec3::new(0.2 * p.z.max(0.0), 0.0, p.z))];
        let rays = segments(places(&layer).into_iter().filter(inside).map(out));
        assert!(rays.triangles.len() > 100);
        let mut hit: Vec<u32> =
            intersections(&rays, Some(&outer), usize::MAX).unwrap().pairs.iter().map(|p| p[0]).collect();
        hit.dedup();
        assert_eq!(hit.len(), rays.triangles.len(), "the layer shows");
        // It hangs on the layer, and not in the air: a coarse tube rests on it by its edges, in one of several ways.
        let gap = ClosestPoint::new(&layer);
        let near = outer.positions.iter().filter(|p| inside(p)).map(|&p| gap.distance(p)).fold(0.0, f64::max);
        assert!(near < 0.11, "{near}");
    }
}

#[test]
fn three_layers_in_another_coordinate_system_and_unit() {
    let space = CoordinateSystem {
        right: Axis::NegativeY,
        up: Axis::PositiveZ,
        forward: Axis::PositiveX,
        metres_per_unit: 0.01,
        winding: Winding::Clockwise,
        trusted: false,
    };
    let there = |mesh: &TriangleMesh| TriangleMesh {
        positions: mesh.positions.iter().map(|&p| space.position_from_internal(p)).collect(),
        triangles: mesh.triangles.iter().map(|&[a, b, c]| [a, c, b]).collect(),
    };
    let skeleton = |mut s: bespoke::input::skeleton::Skeleton| {
        s.joints.iter_mut().for_each(|p| *p = space.position_from_internal(*p));
        s
    };
    let garments = [sleeve(), tube(-0.5, 0.8, |_, _| 0.35, 13, 17, false), tube(-0.7, 0.6, |_, _| 0.4, 12, 15, false)];
    let mut layers: [Vec<TriangleMesh>; 2] = Default::default();
    for garment in &garments {
        for is_there in [false, true] {
            let mut session = session(1.0, DVec3::ZERO);
            session.set_garment(garment.clone(), Precision::F64).unwrap();
            if is_there {
                session.set_target_coordinate_system(space).unwrap();
                session.set_target_avatar(there(&thick_arm())).unwrap();
                session.set_target_skeleton(skeleton(arm(1.0, DVec3::ZERO))).unwrap();
            }
            for layer in &layers[usize::from(is_there)] {
                session.add_layer(layer.clone()).unwrap();
            }
            assert_eq!(session.run().unwrap(), Stage::Done);
            layers[usize::from(is_there)].push(read(&session, garment));
        }
    }
    let body = there(&thick_arm());
    for k in 1..3 {
        (0..k).for_each(|inner| is_over(&layers[1][k], &layers[1][inner], &body));
    }
    // The same as without a coordinate system, to within the tolerance of the fit.
    for (here, there) in layers[0].iter().zip(&layers[1]) {
        for (p, q) in here.positions.iter().zip(&there.positions) {
            assert!(p.distance(space.position_to_internal(*q)) < 0.01, "{p} {}", space.position_to_internal(*q));
        }
    }
}

#[test]
fn the_avatar_that_is_read_and_counted_is_the_avatar_alone() {
    let layer = first_layer();
    let bits = |p: &[DVec3]| p.iter().map(|p| p.to_array().map(f64::to_bits)).collect::<Vec<_>>();
    let (mut bare, mut worn) = (session(1.0, DVec3::ZERO), session(1.0, DVec3::ZERO));
    worn.add_layer(layer.clone()).unwrap();
    worn.add_layer(layer).unwrap();
    assert_eq!(worn.layer_count(), 2);
    worn.clear_layers().unwrap();
    assert_eq!(worn.layer_count(), 0);
    worn.add_layer(first_layer()).unwrap();
    for session in [&mut bare, &mut worn] {
        session.prepare().unwrap();
    }
    let (one, other) = (bare.report(), worn.report());
    assert_eq!((one.avatar_size, one.projected_size), (other.avatar_size, other.projected_size));
    assert!(other.memory > one.memory + 10_000, "{} {}", one.memory, other.memory);
    assert_eq!(bits(&bare.avatar_positions().unwrap()), bits(&worn.avatar_positions().unwrap()));
    worn.run().unwrap();
    assert_eq!(bits(&worn.avatar_positions().unwrap()), bits(&thick_arm().positions));
    let result = bits(&worn.garment_positions().unwrap());

    for error in [worn.add_layer(sleeve()).unwrap_err(), worn.clear_layers().unwrap_err()] {
        assert_eq!(error.kind, ErrorKind::InvalidState);
        assert!(error.message.contains("reset"), "{error}");
    }
    // Layers stay, and the bits with them; without them it is a session without layers.
    worn.reset();
    assert_eq!(worn.layer_count(), 1);
    worn.run().unwrap();
    assert_eq!(result, bits(&worn.garment_positions().unwrap()));
    worn.reset();
    worn.clear_layers().unwrap();
    worn.run().unwrap();
    bare.run().unwrap();
    let without = bits(&bare.garment_positions().unwrap());
    assert_eq!(without, bits(&worn.garment_positions().unwrap()));
    assert_ne!(without, result);
}

#[test]
fn layers_are_checked_and_counted_before_the_run() {
    let mut session = session(1.0, DVec3::ZERO);
    session.add_layer(first_layer()).unwrap();
    let mut bad = sleeve();
    bad.triangles[33][1] = 9000;
    let error = session.add_layer(bad).unwrap_err();
    assert_eq!(error.kind, ErrorKind::InvalidMesh);
    assert!(error.message.contains("layer 1: triangle 33"), "{error}");
    assert_eq!(session.layer_count(), 1);
    session.set_options(Options { memory_limit: 120_000_000, ..Options::default() }).unwrap();
    session.prepare().unwrap();
    session.reset();
    session.add_layer(tube(-0.6, 0.7, |_, _| 0.6, 300, 300, false)).unwrap();
    let error = session.prepare().unwrap_err();
    assert_eq!(error.kind, ErrorKind::MemoryLimit);
    assert!(error.message.contains("the avatar"), "{error}");
}

/// With skin weights, those of the avatar count for its layers, so that these need none.
#[test]
fn an_avatar_with_skin_weights_takes_layers_without() {
    let (layer, body) = (first_layer(), thick_arm());
    let joints: Vec<u32> = body.positions.iter().map(|p| if p.z < 0.0 { 0 } else { 2 }).collect();
    let weights = vec![3.0; joints.len()];
    let mut session = session(1.0, DVec3::ZERO);
    let skin = SkinWeights::from_sparse(&joints, &weights, 1, 3, joints.len(), "skin").unwrap();
    session.set_target_skin(skin).unwrap();
    session.add_layer(layer.clone()).unwrap();
    assert_eq!(session.run().unwrap(), Stage::Done);
    is_over(&read(&session, &sleeve()), &layer, &body);
}

#[test]
fn a_layer_that_penetrates_is_named() {
    let mut session = session(1.0, DVec3::ZERO);
    // Closed around the middle of the arm, and meant so: what reaches out of it at both ends cannot be put inside.
    session.set_options(Options { keep_caps: true, ..Options::default() }).unwrap();
    session.set_garment(tube(-0.6, 0.6, |_, _| 0.3, 16, 16, true), Precision::F32).unwrap();
    let inside = tube(-0.4, 0.4, |_, _| 0.2, 8, 8, true);
    session.set_target_avatar(inside.clone()).unwrap();
    session.prepare().unwrap();
    session.reset();
    session.add_layer(inside).unwrap();
    session.prepare().unwrap();
    session.reset();
    let long = tube(-1.1, 1.1, |_, _| 0.25, 14, 12, false);
    session.add_layer(long.clone()).unwrap();
    assert_eq!(session.prepare().unwrap_err().kind, ErrorKind::NotEnclosed);
    let penetrations: Vec<_> =
        session.diagnostics().iter().filter(|f| f.kind() == DiagnosticKind::AvatarPenetrates).collect();
    assert!(!penetrations.is_empty());
    for diagnostic in penetrations {
        let element = *diagnostic.elements().last().unwrap();
        assert_eq!(element.subject, Subject::Layer(1), "{diagnostic}");
        assert!((element.index as usize) < long.triangles.len());
        assert!(diagnostic.to_string().contains(&format!("triangle {} of layer 1", element.index)), "{diagnostic}");
    }
}

/// An open layer has two outer sides, and the space beneath it is open where its ends are.
#[test]
fn the_field_of_a_layered_body_is_right_beside_the_openings() {
    let body = Arc::new(thick_arm());
    let field =
        |mesh: &TriangleMesh| Field::build(mesh, FieldOptions { voxel: 0.01, threads: 1 }, &Cancel::new()).unwrap();
    let bare = field(&body);
    let mut random = Random::new(5);
    // A wide one, and a tight one, under which the space may be closed to the voxels.
    let wide = tube(-0.6, 0.7, |_, _| 0.8, 16, 24, false);
    for (layer, beyond) in [(wide, 0.03), (first_layer(), 0.15)] {
        let rim: Vec<DVec3> = layer.positions.iter().copied().filter(|p| !(-0.5..0.6).contains(&p.z)).collect();
        let dressed = Body::new(&body, &[Arc::new(layer)]).unwrap();
        let (field, exact) = (field(&dressed.mesh), ClosestPoint::new(&dressed.mesh));
        let (mut outside, mut inside) = (0, 0);
        for k in 0..6000 {
            let p = match k % 2 {
                0 => rim[(random.unit() * rim.len() as f64) as usize] + 0.15 * random.vector(),
                _ => DVec3::new(1.2, 1.2, 1.4) * random.vector(),
            };
            let (distance, to_body, value) = (exact.distance(p), bare.value(p), field.value(p));
            assert!((value.abs() - distance).abs() < 0.02, "{p}: {value} {distance}");
            if to_body > beyond && distance > 0.03 {
                assert!((value - distance).abs() < 0.01, "{p}: {value} {distance}");
                outside += 1;
            } else if to_body < -0.03 {
                assert!((value + distance).abs() < 0.01, "{p}: {value} {distance}");
                inside += 1;
            }
        }
        assert!(outside > 1000 && inside > 100, "{outside} {inside}");
    }
}

fn mesh(sample: &Sample) -> TriangleMesh {
    TriangleMesh { positions: sample.mesh.positions.clone(), triangles: sample.mesh.triangles.clone() }
}

/// The closet's jacket on the heavy body, and a coarser one over it.
#[test]
fn a_jacket_over_a_jacket() {
    let heavy = sample(Kind::Heavy);
    let mut layers: Vec<TriangleMesh> = Vec::new();
    for coarseness in [1.6, 2.0] {
        let jacket = jacket(coarseness);
        let skeleton = |sample: &Sample| bespoke::input::skeleton::Skeleton {
            joints: sample.skeleton.joints.to_vec(),
            bones: BONES.to_vec(),
        };
        let mut session = Session::new();
        session.set_garment(mesh(&jacket), Precision::F32).unwrap();
        session.set_source_skeleton(skeleton(&jacket)).unwrap();
        session.set_target_avatar(mesh(&heavy)).unwrap();
        session.set_target_skeleton(skeleton(&heavy)).unwrap();
        let (rows, columns) = (heavy.skin.len(), heavy.mesh.positions.len());
        session.set_target_skin(SkinWeights::from_dense(&heavy.skin.concat(), rows, columns, "skin").unwrap()).unwrap();
        layers.iter().for_each(|layer| session.add_layer(layer.clone()).unwrap());
        assert_eq!(session.run().unwrap(), Stage::Done);
        layers.push(read(&session, &mesh(&jacket)));
    }
    is_over(&layers[1], &layers[0], &mesh(&heavy));
}

#[test]
fn what_is_covered_of_the_arm_and_of_the_layer() {
    let mut session = session(1.0, DVec3::ZERO);
    let options = CoveredOptions::default();
    assert_eq!(session.covered_triangles(None, &options).unwrap_err().kind, ErrorKind::InvalidState);
    session.run().unwrap();
    let bare = session.covered_triangles(None, &options).unwrap();
    let arm = thick_arm();
    assert!(!bare.is_empty() && bare.len() < arm.triangles.len(), "{} of {}", bare.len(), arm.triangles.len());
    let sleeve_length = sleeve().positions.iter().fold(0.0_f64, |most, p| most.max(p.z.abs()));
    assert!(bare.iter().all(|&t| arm.centre(t).z.abs() < 1.5 * sleeve_length));
    assert_eq!(session.covered_triangles(None, &options).unwrap(), bare);
    let more = session.covered_triangles(None, &CoveredOptions { margin: 0, ..options }).unwrap();
    assert!(bare.iter().all(|t| more.contains(t)) && more.len() > bare.len());
    for openness in [-0.1, 1.1, f64::NAN] {
        let wrong = session.covered_triangles(None, &CoveredOptions { openness, ..options }).unwrap_err();
        assert_eq!(wrong.kind, ErrorKind::InvalidArgument);
    }
    let error = session.covered_triangles(Some(0), &options).unwrap_err();
    assert!(error.kind == ErrorKind::InvalidArgument && error.message.contains("layer 0"), "{}", error.message);

    let inner = read(&session, &sleeve());
    session.reset();
    session.add_layer(inner.clone()).unwrap();
    session.run().unwrap();
    let of_layer = session.covered_triangles(Some(0), &CoveredOptions { margin: 0, ..options }).unwrap();
    assert!(!of_layer.is_empty() && of_layer.iter().all(|&t| (t as usize) < inner.triangles.len()));
}
