//! Normals and tangents: rigid motions exactly, bends by their turn, hard edges hard and seams smooth.

use bespoke::error::ErrorKind;
use bespoke::follow::normals::RenderVertices;
use glam::{DVec3, DVec4};
use testing::Random;

use crate::scene::{bumpy, moved, sheet, similarity};

/// The triangles with vertices of their own, and the vertex that each was.
fn split(triangles: &[[u32; 3]]) -> (Vec<[u32; 3]>, Vec<u32>) {
    let own = (0..triangles.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    (own, triangles.iter().flatten().copied().collect())
}

#[test]
fn a_similarity_turns_any_normal_exactly() {
    let mut random = Random::new(1);
    for scale in [1.0, 0.01, 7.0] {
        let (points, triangles) = bumpy(5, &mut random);
        let (map, turn) = similarity(&mut random, scale);
        let surface = moved(&points, &triangles, |p| map.transform_point3(p));
        let (own, _) = split(&triangles);
        for (render, count) in [(&triangles, points.len()), (&own, 3 * triangles.len())] {
            let vertices = RenderVertices::new(&surface, render, count).unwrap();
            // Any normals, not those of the surface.
            let normals: Vec<DVec3> = (0..count).map(|_| random.vector()).collect();
            let tangents: Vec<DVec4> = normals
                .iter()
                .map(|n| n.any_orthogonal_vector().normalize().extend(if random.signed() > 0.0 { 1.0 } else { -1.0 }))
                .collect();
            let turned = vertices.normals(&surface, &normals);
            let along = vertices.tangents(&surface, &normals, &tangents, &turned);
            for v in 0..count {
                assert!(turned[v].distance(turn * normals[v].normalize()) < 1e-12);
                assert!(along[v].truncate().distance(turn * tangents[v].truncate()) < 1e-12);
                assert_eq!(along[v].w, tangents[v].w);
            }
        }
    }
}

/// Rolled up to a tube, a flat sheet has the tube's normals.
#[test]
fn a_bend_gives_the_normals_of_the_bent_surface() {
    let (points, triangles) = sheet(24);
    let roll = |p: DVec3| DVec3::new(p.x.sin(), p.y, 1.0 - p.x.cos());
    let surface = moved(&points, &triangles, roll);
    let vertices = RenderVertices::new(&surface, &triangles, points.len()).unwrap();
    let flat = vertices.designed_normals(&surface);
    assert!(flat.iter().all(|n| n.distance(DVec3::Z) < 1e-12));
    let along = vec![DVec4::new(1.0, 0.0, 0.0, -1.0); points.len()];
    let normals = vertices.normals(&surface, &flat);
    let tangents = vertices.tangents(&surface, &flat, &along, &normals);
    for (v, p) in points.iter().enumerate() {
        let is_edge = p.x < 0.01 || p.x > 0.99;
        let bar = if is_edge { 0.03 } else { 1e-3 };
        assert!(normals[v].distance(DVec3::new(-p.x.sin(), 0.0, p.x.cos())) < bar, "{p} {}", normals[v]);
        assert!(tangents[v].truncate().distance(DVec3::new(p.x.cos(), 0.0, p.x.sin())) < bar);
        assert!(tangents[v].truncate().dot(normals[v]).abs() < 1e-12);
        assert!((normals[v].length() - 1.0).abs() < 1e-12 && tangents[v].w == -1.0);
    }
}

/// A shear turns a normal by the inverse transpose, not as a point.
#[test]
fn a_stretch_turns_slanted_normals() {
    let (points, triangles) = sheet(1);
    // A ramp, stretched along x: it becomes flatter.
    let ramp: Vec<DVec3> = points.iter().map(|p| DVec3::new(p.x, p.y, p.x)).collect();
    let surface = moved(&ramp, &triangles, |p| DVec3::new(3.0 * p.x, p.y, p.z));
    let vertices = RenderVertices::new(&surface, &triangles, 4).unwrap();
    let wanted = DVec3::new(-1.0, 0.0, 3.0).normalize();
    for n in vertices.normals(&surface, &vertices.designed_normals(&surface)) {
        assert!(n.distance(wanted) < 1e-12, "{n}");
    }
}

/// Two faces at a right angle, folded flat: over a hard edge each keeps its own normal, over a smooth one they share it.
#[test]
fn hard_edges_stay_hard_and_seams_smooth() {
    let points = [DVec3::ZERO, DVec3::Y, DVec3::X, DVec3::Z];
    let triangles = [[0, 2, 1], [1, 3, 0]];
    let own = [[0, 1, 2], [3, 4, 5]];
    let fold = |p: DVec3| if p.z > 0.5 { DVec3::new(-0.6, 0.0, 0.8) } else { p };
    let surface = moved(&points, &triangles, fold);
    let vertices = RenderVertices::new(&surface, &own, 6).unwrap();
    let hard = vertices.designed_normals(&surface);
    assert!(hard[0].distance(DVec3::Z) < 1e-12 && hard[4].distance(DVec3::X) < 1e-12);
    let turned = vertices.normals(&surface, &hard);
    assert!([0, 1, 2].iter().all(|&v: &usize| turned[v].distance(DVec3::Z) < 1e-12));
    assert!([3, 4, 5].iter().all(|&v: &usize| turned[v].distance(DVec3::new(0.8, 0.0, 0.6)) < 1e-12));
    // The same with normals that agree along the edge, but for the few bits that they were stored in.
    let smooth = DVec3::new(1.0, 0.0, 1.0).normalize();
    let mut given = vec![smooth; 6];
    given[0] += DVec3::new(0.001, -0.001, 0.0);
    let turned = vertices.normals(&surface, &given);
    // Vertices 0 and 5, 2 and 3 are in one place.
    for [a, b] in [[0, 5], [2, 3]] {
        assert!(turned[a].distance(turned[b]) < 0.002, "{} {}", turned[a], turned[b]);
    }
    assert!(turned[2].y.abs() < 1e-12 && turned[2].distance(turned[1]) > 0.1);
}

/// The normals of a garment with a seam are those of the one without.
#[test]
fn a_seam_changes_nothing() {
    let mut random = Random::new(3);
    let (points, triangles) = bumpy(6, &mut random);
    let surface = moved(&points, &triangles, |p| DVec3::new(p.x.sin(), p.y * 1.3, p.z + p.x * p.y));
    let whole = RenderVertices::new(&surface, &triangles, points.len()).unwrap();
    let designed = whole.designed_normals(&surface);
    let expected = whole.normals(&surface, &designed);
    let (own, places) = split(&triangles);
    let seams = RenderVertices::new(&surface, &own, places.len()).unwrap();
    let given: Vec<DVec3> = places.iter().map(|&v| designed[v as usize]).collect();
    for (n, &v) in seams.normals(&surface, &given).iter().zip(&places) {
        assert!(n.distance(expected[v as usize]) < 1e-12);
    }
}

#[test]
fn triangles_without_area_say_nothing() {
    let (mut points, mut triangles) = sheet(2);
    triangles.push([0, 1, 1]);
    triangles.push([0, 1, 2]);
    points.push(DVec3::new(9.0, 9.0, 9.0));
    let surface = moved(&points, &triangles, |p| if p.x > 0.9 { DVec3::new(0.5, p.y, 0.0) } else { p });
    let vertices = RenderVertices::new(&surface, &triangles, points.len()).unwrap();
    let designed = vertices.designed_normals(&surface);
    let turned = vertices.normals(&surface, &designed);
    assert_eq!(turned[9], DVec3::ZERO);
    // Those whose triangles are all crushed keep what they had.
    assert!(turned[..9].iter().all(|n| n.distance(DVec3::Z) < 1e-12), "{turned:?}");
}

#[test]
fn other_triangles_are_refused() {
    let (points, triangles) = sheet(1);
    let surface = moved(&points, &triangles, |p| p);
    for (triangles, words) in [
        (vec![[0, 1, 3]], "there are 1, the garment has 2"),
        (vec![[0, 1, 3], [0, 3, 4]], "triangle 1 names vertex 4, there are 4"),
        (vec![[0, 1, 3], [3, 0, 2]], "vertex 3 is in two places"),
    ] {
        let Err(error) = RenderVertices::new(&surface, &triangles, 4) else { panic!("{triangles:?}") };
        assert_eq!(error.kind, ErrorKind::InvalidArgument);
        assert!(error.message.contains(words), "{error}");
    }
}
