//! Weights of a garment from those of a body: known answers.

use bespoke::control::Cancel;
use bespoke::error::ErrorKind;
use bespoke::geometry::closest_point::{barycentric, closest_on_triangle};
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::skin::SkinWeights;
use bespoke::rig::weights::{TransferOptions, limited, move_as_one, sure_weights, transfer};
use glam::DVec3;
use testing::Random;

use crate::limbs::{assert_weights, joined, skin, tube, weight};

fn transferred(garment: &TriangleMesh, body: &TriangleMesh, skin: &SkinWeights) -> SkinWeights {
    transfer(garment, body, skin, &TransferOptions::default(), &Cancel::new()).expect("weights")
}

/// Strips of the body itself, one of them turned inside out.
#[test]
fn a_copy_of_the_body_gets_its_weights_back() {
    let body = tube(-3.0, 3.0, 0.5, 60, 24);
    let mut random = Random::new(3);
    // Several joints a vertex, of sums other than 1.
    let rows = body.positions.iter().map(|_| (0..4).map(|k| (7 * k, 0.1 + random.unit())).collect());
    let skin = SkinWeights::from_rows(30, rows);
    let mut garment = body.clone();
    garment.triangles.retain(|t| body.positions[t[0] as usize].x.rem_euclid(1.0) < 0.5);
    let third = garment.triangles.len() / 3;
    garment.triangles[..third].iter_mut().for_each(|t| t.swap(0, 1));
    let all = transferred(&garment, &body, &skin);
    let result = limited(&all, 4);
    assert_weights(&all, body.positions.len(), 4);
    assert_weights(&result, body.positions.len(), 4);
    for v in 0..body.positions.len() {
        let sum: f64 = skin.weights(v).iter().map(|w| w.1).sum();
        for &(joint, own) in skin.weights(v) {
            for got in [weight(&all, v, joint), weight(&result, v, joint)] {
                assert!((got - own / sum).abs() < 1e-9, "vertex {v}, joint {joint}: {got} for {}", own / sum);
            }
        }
    }
}

/// Around a limb whose weights run evenly along it, those of a sleeve do as well.
#[test]
fn a_sleeve_goes_with_the_limb() {
    let body = tube(-3.0, 3.0, 0.5, 60, 24);
    let garment = tube(-2.0, 2.0, 0.53, 30, 18);
    let result = transferred(&garment, &body, &skin(&body));
    assert_weights(&result, garment.positions.len(), 2);
    for (v, p) in garment.positions.iter().enumerate() {
        let expected = (0.5 + 0.5 * p.x).clamp(0.0, 1.0);
        let got = weight(&result, v, 1);
        assert!((got - expected).abs() < 0.02, "{p}: {got} for {expected}");
    }
}

/// A flap that sticks out from a sleeve, far from the limb that carries it and nearer to another one.
#[test]
fn what_stands_off_goes_on_from_what_is_sure() {
    let limb = tube(-1.0, 1.0, 0.3, 30, 24);
    let mut other = limb.clone();
    other.positions.iter_mut().for_each(|p| p.y += 1.6);
    let body = joined(&limb, &other);
    let of = |v: usize| vec![(u32::from(v >= limb.positions.len()), 1.0)];
    let skin = SkinWeights::from_rows(2, (0..body.positions.len()).map(of));
    // From the top of the sleeve upwards, in the plane across it, to right below the other limb.
    let mut garment = tube(-0.5, 0.5, 0.32, 10, 24);
    let root: Vec<u32> = (0..=10).map(|ring| 24 * ring).collect();
    let mut last = root;
    for step in 1..=18 {
        let next: Vec<u32> = (0..=10).map(|k| garment.positions.len() as u32 + k).collect();
        let at = |&v: &u32| DVec3::new(garment.positions[v as usize].x, 0.32 + 0.05 * f64::from(step), 0.0);
        let row: Vec<DVec3> = last.iter().map(at).collect();
        garment.positions.extend(row);
        for k in 0..10 {
            garment.triangles.push([last[k], last[k + 1], next[k + 1]]);
            garment.triangles.push([last[k], next[k + 1], next[k]]);
        }
        last = next;
    }
    let result = transferred(&garment, &body, &skin);
    for (v, p) in garment.positions.iter().enumerate() {
        assert!(weight(&result, v, 0) > 0.99, "{p}: {:?}", result.weights(v));
    }
    // The closest point alone says something else.
    let sure = sure_weights(&garment, &body, &skin, &TransferOptions::default(), &Cancel::new()).expect("weights");
    assert!(last.iter().all(|&v| weight(&sure.weights, v as usize, 1) == 1.0));
}

#[test]
fn closest_points_are_those_of_brute_force() {
    let mut random = Random::new(11);
    let body = tube(-1.0, 1.0, 0.5, 6, 9);
    let rows = body.positions.iter().map(|_| (0..3).map(|k| (k, 0.1 + random.unit())).collect()).collect::<Vec<_>>();
    let skin = SkinWeights::from_rows(3, rows);
    let mut garment = tube(-1.2, 1.2, 0.6, 9, 7);
    garment.positions.iter_mut().for_each(|p| *p += 0.1 * random.vector());
    let sure = sure_weights(&garment, &body, &skin, &TransferOptions::default(), &Cancel::new()).expect("weights");
    for (v, &p) in garment.positions.iter().enumerate() {
        let closest = |t: &u32| closest_on_triangle(p, &body.corners(*t));
        let triangles = 0..body.triangles.len() as u32;
        let best = triangles.min_by(|a, b| closest(a).distance(p).total_cmp(&closest(b).distance(p))).expect("some");
        let shares = barycentric(closest(&best), body.corners(best));
        for joint in 0..3 {
            let of = |v: u32| {
                let sum: f64 = skin.weights(v as usize).iter().map(|w| w.1).sum();
                weight(&skin, v as usize, joint) / sum
            };
            let expected: f64 = body.triangles[best as usize].iter().zip(shares).map(|(&v, share)| share * of(v)).sum();
            assert!((weight(&sure.weights, v, joint) - expected).abs() < 1e-9);
        }
    }
}

/// One piece lies near the body, one far from it, one has no triangles.
#[test]
fn pieces_that_are_nowhere_near_go_with_their_nearest_part() {
    let body = tube(-3.0, 3.0, 0.5, 60, 24);
    let sleeve = tube(-1.0, 1.0, 0.55, 20, 24);
    let mut far = tube(-0.6, 2.9, 0.3, 20, 12);
    // Tilted, so that it is nearest to the body at its end.
    far.positions.iter_mut().for_each(|p| p.y += 4.0 - 0.5 * p.x);
    let mut garment = joined(&sleeve, &far);
    garment.positions.push(DVec3::new(-5.0, 0.0, 9.0));
    let result = transferred(&garment, &body, &skin(&body));
    assert_weights(&result, garment.positions.len(), 2);
    for v in sleeve.positions.len()..garment.positions.len() - 1 {
        assert!(weight(&result, v, 1) > 0.9, "vertex {v}: {:?}", result.weights(v));
    }
    assert_eq!(result.weights(garment.positions.len() - 1), [(0, 1.0)]);
}

#[test]
fn body_vertices_without_weights_have_no_say() {
    let body = tube(-3.0, 3.0, 0.5, 60, 24);
    let all = skin(&body);
    let bare = |v: usize| body.positions[v].x.abs() < 0.35;
    let rows = (0..body.positions.len()).map(|v| if bare(v) { Vec::new() } else { all.weights(v).to_vec() });
    let garment = tube(-2.0, 2.0, 0.53, 30, 18);
    let result = transferred(&garment, &body, &SkinWeights::from_rows(2, rows));
    assert_weights(&result, garment.positions.len(), 2);
    for (v, p) in garment.positions.iter().enumerate() {
        assert!((weight(&result, v, 1) - (0.5 + 0.5 * p.x).clamp(0.0, 1.0)).abs() < 0.1, "{p}");
    }
}

#[test]
fn the_largest_influences_are_kept() {
    let row = vec![(4, 0.1), (0, 0.3), (2, 0.1), (9, 0.2), (1, 0.25), (7, 0.05)];
    let skin = SkinWeights::from_rows(10, [row, Vec::new()]);
    let four = limited(&skin, 4);
    let sum = 0.3 + 0.25 + 0.2 + 0.1;
    let expected = [(0, 0.3 / sum), (1, 0.25 / sum), (2, 0.1 / sum), (9, 0.2 / sum)];
    assert_eq!(four.weights(0).len(), 4);
    for (&got, expected) in four.weights(0).iter().zip(expected) {
        assert!(got.0 == expected.0 && (got.1 - expected.1).abs() < 1e-15, "{got:?} for {expected:?}");
    }
    assert!(four.weights(1).is_empty());
    assert_eq!(limited(&skin, 8), limited(&skin, 6));
    assert_eq!(limited(&skin, 0).weights(0), [(0, 1.0)]);
}

#[test]
fn a_group_has_one_vector() {
    let body = tube(-3.0, 3.0, 0.5, 60, 24);
    let garment = tube(-2.0, 2.0, 0.53, 30, 18);
    let skin = transferred(&garment, &body, &skin(&body));
    let group: Vec<u32> = (0..garment.positions.len() as u32).filter(|v| v % 5 == 0).collect();
    let result = move_as_one(&skin, &[vec![], group.clone()]).expect("vertices in range");
    assert_weights(&result, garment.positions.len(), 2);
    let mean = group.iter().map(|&v| weight(&skin, v as usize, 1)).sum::<f64>() / group.len() as f64;
    assert!((weight(&result, 0, 1) - mean).abs() < 1e-12);
    for v in 0..garment.positions.len() {
        let expected = if v % 5 == 0 { result.weights(0) } else { skin.weights(v) };
        assert_eq!(result.weights(v), expected);
    }
    let beyond = move_as_one(&skin, &[group, vec![1, 999_999]]).expect_err("a vertex beyond the last one");
    assert_eq!(beyond.kind, ErrorKind::InvalidArgument);
    assert!(beyond.message.contains("group 1 has vertex 999999"), "{}", beyond.message);
}

#[test]
fn the_same_bits_for_any_number_of_threads() {
    let body = tube(-3.0, 3.0, 0.5, 60, 24);
    let mut random = Random::new(5);
    let mut garment = tube(-2.0, 2.0, 0.6, 50, 40);
    garment.positions.iter_mut().for_each(|p| *p += 0.05 * random.vector());
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| transferred(&garment, &body, &skin(&body)))
    };
    let one = with(1);
    assert_weights(&one, garment.positions.len(), 2);
    assert_eq!(with(2), one);
    assert_eq!(with(7), one);
}

#[test]
fn what_cannot_be_used_is_refused() {
    let body = tube(-3.0, 3.0, 0.5, 6, 5);
    let of_body = skin(&body);
    let refused = |garment: &TriangleMesh, body: &TriangleMesh, skin: &SkinWeights| {
        let cancel = Cancel::new();
        transfer(garment, body, skin, &TransferOptions::default(), &cancel).expect_err("no weights")
    };
    let short = SkinWeights::from_rows(2, vec![vec![(0, 1.0)]]);
    let error = refused(&body, &body, &short);
    assert_eq!(error.kind, ErrorKind::InvalidWeights);
    assert!(error.message.contains("are for 1 vertices, the body has 35"), "{}", error.message);
    let none = SkinWeights::from_rows(2, vec![Vec::new(); body.positions.len()]);
    assert_eq!(refused(&body, &body, &none).kind, ErrorKind::InvalidWeights);
    let mut bad = body.clone();
    bad.positions[3].y = f64::NAN;
    assert_eq!(refused(&bad, &body, &of_body).kind, ErrorKind::InvalidMesh);
    assert_eq!(refused(&body, &bad, &of_body).kind, ErrorKind::InvalidMesh);
    bad = body.clone();
    bad.triangles[0][0] = 99;
    assert_eq!(refused(&bad, &body, &of_body).kind, ErrorKind::InvalidMesh);
    let cancel = Cancel::new();
    cancel.request();
    let garment = tube(-2.0, 2.0, 0.53, 30, 18);
    let stopped = transfer(&garment, &body, &of_body, &TransferOptions::default(), &cancel);
    assert_eq!(stopped.expect_err("stopped").kind, ErrorKind::Cancelled);
}
