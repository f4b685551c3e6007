//! The strange avatars: bodies of many parts, and the one that is bent forward.

use std::collections::HashSet;

use glam::DVec3;

use super::distance::Triangles;
use super::{MANNEQUIN, euler_characteristic};
use closet::Sample;
use closet::avatars::{Avatar, avatar};
use closet::mesh::Mesh;
use closet::skeleton::{ARMS, BONES, JOINTS, LEGS, NECK, ROOT, WAIST};

const STRANGE: [Avatar; 4] = [Avatar::Skeleton, Avatar::Elemental, Avatar::Robot, Avatar::Dinosaur];

/// The connected parts as meshes of their own, and the vertices of each in the whole mesh.
fn parts(mesh: &Mesh) -> Vec<(Mesh, Vec<u32>)> {
    let (component, count) = mesh.components();
    (0..count as u32)
        .map(|part| {
            let mut own = mesh.clone();
            let old = own.retain(|triangle| component[triangle[0] as usize] == part);
            (own, old)
        })
        .collect()
}

fn volume(mesh: &Mesh) -> f64 {
    // About the first vertex, so that small parts far from the origin lose no digits.
    let origin = mesh.positions[0];
    let corners = |t| mesh.corners(t).map(|corner| corner - origin);
    (0..mesh.triangles.len() as u32).map(corners).map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
}

#[test]
fn parts_are_closed_and_face_outwards() {
    for kind in STRANGE {
        let body = avatar(kind);
        let count = body.mesh.positions.len();
        assert!((2000..=6000).contains(&count), "{kind:?} has {count} vertices");
        assert!(body.mesh.positions.iter().all(|p| p.is_finite()));
        for (part, _) in parts(&body.mesh) {
            let sides = |&[a, b, c]: &[u32; 3]| [(a, b), (b, c), (c, a)];
            let directed: HashSet<(u32, u32)> = part.triangles.iter().flat_map(sides).collect();
            assert!(directed.iter().all(|&(a, b)| directed.contains(&(b, a))), "{kind:?}: a part is open");
            let euler = euler_characteristic(&part);
            assert!(euler % 2 == 0 && euler <= 2, "{kind:?}: a part has the Euler characteristic {euler}");
            let (place, size) = (part.positions[0], volume(&part));
            assert!(size > 1e-8, "{kind:?}: the part at {place} has the volume {size}");
            for t in 0..part.triangles.len() as u32 {
                let [a, b, c] = part.corners(t);
                assert!((b - a).cross(c - a).length() > 1e-8, "{kind:?}: a triangle at {a} has no area");
            }
        }
    }
}

#[test]
fn bodies_have_the_parts_that_make_them() {
    let count = |kind: Avatar| avatar(kind).mesh.components().1;
    // 22 vertebrae with their processes, 20 ribs, 20 teeth, 38 bones of the fingers and 30 of the toes, and more.
    assert!((180..260).contains(&count(Avatar::Skeleton)));
    assert!((70..110).contains(&count(Avatar::Elemental)));
    assert!((100..200).contains(&count(Avatar::Robot)));
    // The dinosaur is one body with teeth, eyes, spikes and claws on it.
    let dinosaur = avatar(Avatar::Dinosaur);
    let parts = parts(&dinosaur.mesh);
    assert!((40..80).contains(&parts.len()));
    let largest = parts.iter().map(|(part, _)| part.positions.len()).max().unwrap();
    assert!(largest * 10 > dinosaur.mesh.positions.len() * 8);
}

#[test]
fn the_same_bits_every_time() {
    for kind in STRANGE {
        assert_eq!(avatar(kind), avatar(kind), "{kind:?}");
    }
}

/// Points of a triangle, so many that each of its points is within 2.4 mm of one.
fn samples([a, b, c]: [DVec3; 3]) -> Vec<DVec3> {
    const SPACING: f64 = 0.004;
    let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
    let n = (longest / SPACING).ceil().max(1.0) as usize;
    let point = |i: usize, j: usize| a + (b - a) * (i as f64 / n as f64) + (c - a) * (j as f64 / n as f64);
    (0..=n).flat_map(|i| (0..=n - i).map(move |j| (i, j))).map(|(i, j)| point(i, j)).collect()
}

#[test]
fn stones_float_apart() {
    let body = avatar(Avatar::Elemental);
    let (component, count) = body.mesh.components();
    let part_of = |t: u32| component[body.mesh.triangles[t as usize][0] as usize];
    let mut neighbours = 0;
    for part in 0..count as u32 {
        let others = Triangles::new(&body.mesh, |t| part_of(t) != part);
        let own = (0..body.mesh.triangles.len() as u32).filter(|&t| part_of(t) == part);
        let points = own.flat_map(|t| samples(body.mesh.corners(t)));
        let distance = points.map(|p| others.distance(p, 0.015)).fold(f64::INFINITY, f64::min);
        assert!(distance > 0.003, "stone {part} is {distance} m from another");
        // So a stone is as a whole inside or outside of the others.
        let first = component.iter().position(|&c| c == part).unwrap();
        assert!(others.winding_number(body.mesh.positions[first]).abs() < 1e-6, "stone {part} is inside another");
        neighbours += usize::from(distance.is_finite());
    }
    assert!(neighbours > 10, "the stones are too far apart");
}

#[test]
fn hard_parts_follow_one_joint() {
    for kind in STRANGE {
        let body = avatar(kind);
        assert_eq!(body.skin.len(), JOINTS);
        let mut rigid = 0;
        let parts = parts(&body.mesh);
        for (_, vertices) in &parts {
            for &v in vertices {
                let sum: f64 = body.skin.iter().map(|row| row[v as usize]).sum();
                assert!((sum - 1.0).abs() < 1e-9, "{kind:?}: the weights of vertex {v} sum to {sum}");
            }
            rigid += usize::from(body.skin.iter().any(|row| vertices.iter().all(|&v| row[v as usize] == 1.0)));
        }
        let bending = parts.len() - rigid;
        match kind {
            Avatar::Skeleton | Avatar::Elemental => assert_eq!(bending, 0, "{kind:?}"),
            // The flesh; cables, neck and bellows.
            Avatar::Dinosaur => assert_eq!(bending, 1),
            _ => assert!((10..40).contains(&bending), "{bending} parts of {kind:?} bend"),
        }
    }
}

fn direction(sample: &Sample, [a, b]: [u32; 2]) -> DVec3 {
    (sample.skeleton.joints[b as usize] - sample.skeleton.joints[a as usize]).normalize()
}

#[test]
fn only_the_dinosaur_bends() {
    for kind in STRANGE {
        let body = avatar(kind);
        let turned = |bone| direction(&body, bone).angle_between(direction(&MANNEQUIN, bone)).to_degrees();
        let spine = turned([WAIST as u32, NECK as u32]);
        if kind == Avatar::Dinosaur {
            assert!((40.0..60.0).contains(&spine), "the trunk is bent by {spine} degrees");
            // The head is before the toes of a man, the tail behind.
            let low = body.mesh.positions.iter().copied().fold(DVec3::INFINITY, DVec3::min);
            let high = body.mesh.positions.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
            let root = body.skeleton.joints[ROOT];
            assert!(root.y - low.y > 0.5 && high.y - root.y > 0.45);
            for bone in
                BONES.into_iter().filter(|bone| ARMS.iter().chain(&LEGS).flatten().any(|&j| bone[0] as usize == j))
            {
                assert!(turned(bone) < 25.0, "bone {bone:?} is turned by {} degrees", turned(bone));
            }
        } else {
            assert!(BONES.into_iter().all(|bone| turned(bone) < 25.0), "{kind:?}");
        }
        for joints in ARMS.iter().zip(&ARMS[1..]).chain(LEGS.iter().zip(&LEGS[1..])) {
            for (&left, &right) in joints.0.iter().zip(joints.1) {
                let [l, r] = [left, right].map(|joint| body.skeleton.joints[joint]);
                assert!(l.x > 0.0 && l.distance(r * DVec3::new(-1.0, 1.0, 1.0)) < 1e-12);
            }
        }
    }
}
