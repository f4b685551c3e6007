//! What holds for every body of the closet, and what holds for those of one piece of flesh.

use std::collections::HashSet;
use std::sync::LazyLock;
use std::thread;

use glam::DVec3;

use crate::distance::Triangles;
use crate::{MANNEQUIN, euler_characteristic};
use closet::Sample;
use closet::avatars::{Avatar, avatar};
use closet::mesh::Mesh;
use closet::skeleton::{ARMS, BONES, JOINTS, LEGS};

/// All the bodies, modelled at the same time.
static AVATARS: LazyLock<Vec<(Avatar, Sample)>> = LazyLock::new(all);

/// Bodies whose first and largest part goes around all the bones.
const FLESHY: [Avatar; 7] =
    [Avatar::Slim, Avatar::Heavy, Avatar::Tall, Avatar::Child, Avatar::Giant, Avatar::LongArms, Avatar::TwoHeaded];

fn all() -> Vec<(Avatar, Sample)> {
    thread::scope(|scope| {
        let threads = Avatar::ALL.map(|name| (name, scope.spawn(move || avatar(name))));
        threads.into_iter().map(|(name, thread)| (name, thread.join().unwrap())).collect()
    })
}

/// Six times the volume of each connected part.
fn volumes(mesh: &Mesh) -> Vec<f64> {
    let (component, count) = mesh.components();
    let mut volumes = vec![0.0; count];
    for (index, triangle) in mesh.triangles.iter().enumerate() {
        let [a, b, c] = mesh.corners(index as u32);
        volumes[component[triangle[0] as usize] as usize] += a.dot(b.cross(c));
    }
    volumes
}

#[test]
fn the_same_bits_whenever_they_are_modelled() {
    for ((name, first), (_, second)) in AVATARS.iter().zip(all()) {
        assert!(*first == second, "{}: modelled twice, with two results", name.name());
    }
}

#[test]
fn of_believable_density() {
    for (name, body) in AVATARS.iter() {
        let name = name.name();
        let count = body.mesh.positions.len();
        assert!((2000..=6000).contains(&count), "{name}: {count} vertices");
        assert!(body.mesh.positions.iter().all(|p| p.is_finite()), "{name}: a vertex that is not finite");
        for t in 0..body.mesh.triangles.len() as u32 {
            let [a, b, c] = body.mesh.corners(t);
            let area = 0.5 * (b - a).cross(c - a).length();
            assert!(area > 1e-9, "{name}: triangle {t} has {area} square metres");
        }
    }
}

#[test]
fn every_part_is_closed_and_faces_outwards() {
    for (name, body) in AVATARS.iter() {
        let name = name.name();
        euler_characteristic(&body.mesh);
        let sides = |&[a, b, c]: &[u32; 3]| [(a, b), (b, c), (c, a)];
        let directed: HashSet<(u32, u32)> = body.mesh.triangles.iter().flat_map(sides).collect();
        assert!(directed.iter().all(|&(a, b)| directed.contains(&(b, a))), "{name}: an open edge");
        for (part, volume) in volumes(&body.mesh).into_iter().enumerate() {
            assert!(volume > 0.0, "{name}: part {part} is turned inside out");
        }
    }
}

#[test]
fn skins_give_each_vertex_to_the_joints_in_full() {
    for (name, body) in AVATARS.iter() {
        let name = name.name();
        assert_eq!(body.skin.len(), JOINTS, "{name}");
        let count = body.mesh.positions.len();
        assert!(body.skin.iter().all(|row| row.len() == count), "{name}");
        assert!(body.skin.iter().flatten().all(|weight| (0.0..=1.0).contains(weight)), "{name}");
        for v in 0..count {
            let sum: f64 = body.skin.iter().map(|row| row[v]).sum();
            assert!((sum - 1.0).abs() < 1e-9, "{name}: the weights of vertex {v} sum to {sum}");
        }
    }
}

#[test]
fn all_stand_like_the_mannequin_and_the_same_on_both_sides() {
    let direction = |body: &Sample, [a, b]: [u32; 2]| {
        (body.skeleton.joints[b as usize] - body.skeleton.joints[a as usize]).normalize()
    };
    for (avatar, body) in AVATARS.iter() {
        let name = avatar.name();
        // The dinosaur is bent: it is the hard case.
        for bone in BONES.into_iter().filter(|_| *avatar != Avatar::Dinosaur) {
            let angle = direction(body, bone).angle_between(direction(&MANNEQUIN, bone)).to_degrees();
            assert!(angle < 25.0, "{name}: bone {bone:?} is turned by {angle} degrees");
        }
        for (left, right) in ARMS[0].iter().chain(&LEGS[0]).zip(ARMS[1].iter().chain(&LEGS[1])) {
            let [l, r] = [*left, *right].map(|joint| body.skeleton.joints[joint]);
            assert!(l.x > 0.0 && (l - r * DVec3::new(-1.0, 1.0, 1.0)).length() < 1e-12, "{name}: joint {left}");
        }
    }
}

#[test]
fn flesh_goes_around_the_bones() {
    for (avatar, body) in AVATARS.iter().filter(|(avatar, _)| FLESHY.contains(avatar)) {
        let name = avatar.name();
        let (component, _) = body.mesh.components();
        let flesh = Triangles::new(&body.mesh, |t| component[body.mesh.triangles[t as usize][0] as usize] == 0);
        for (joint, &p) in body.skeleton.joints.iter().enumerate() {
            assert!(flesh.winding_number(p) > 0.5, "{name}: joint {joint} is outside");
            let depth = flesh.distance(p, 0.05);
            assert!(depth > 0.012, "{name}: joint {joint} is {depth} m below the skin");
        }
        for [a, b] in BONES {
            let [a, b] = [a, b].map(|joint| body.skeleton.joints[joint as usize]);
            for t in [0.2, 0.4, 0.6, 0.8] {
                assert!(flesh.winding_number(a.lerp(b, t)) > 0.5, "{name}: a bone from {a} to {b} leaves the flesh");
            }
        }
    }
}
