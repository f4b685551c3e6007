//! Bones inside of bodies, through openings and through cloth, against counting by the signs of volumes.

use std::f64::consts::TAU;

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::placement::evidence::{Threaded, Threading, inside_share};
use bespoke::input::skeleton::Skeleton;
use glam::{DMat3, DVec3};

use testing::Random;

/// Six times the volume of a tetrahedron, with its sign.
fn volume(a: DVec3, b: DVec3, c: DVec3, d: DVec3) -> f64 {
    DMat3::from_cols(b - a, c - a, d - a).determinant()
}

/// 1 or -1 where a segment passes through a triangle, by the side from which it comes, else 0.
fn crossing([p, q]: [DVec3; 2], [a, b, c]: [DVec3; 3]) -> i32 {
    let [from, to] = [p, q].map(|end| volume(a, b, c, end) > 0.0);
    let sides = [[a, b], [b, c], [c, a]].map(|[u, v]| volume(p, q, u, v) > 0.0);
    if from == to || sides != [sides[0]; 3] { 0 } else { 1 - 2 * i32::from(to) }
}

/// Rings of random radii about a random line, and the first vertex of the first and of the last ring.
fn tube(random: &mut Random, is_closed: bool) -> (TriangleMesh, [u32; 2]) {
    const RINGS: u32 = 5;
    const SIDES: u32 = 9;
    let (from, along) = (0.5 * random.vector(), random.vector());
    let (u, v) = along.normalize().any_orthonormal_pair();
    let mut mesh = TriangleMesh::default();
    for r in 0..RINGS {
        let middle = from + f64::from(r) / f64::from(RINGS - 1) * along;
        for s in 0..SIDES {
            let (sin, cos) = (TAU * f64::from(s) / f64::from(SIDES)).sin_cos();
            mesh.positions.push(middle + (0.2 + 0.2 * random.unit()) * (cos * u + sin * v));
        }
    }
    let at = |r: u32, s: u32| r * SIDES + s % SIDES;
    for (r, s) in (0..RINGS - 1).flat_map(|r| (0..SIDES).map(move |s| (r, s))) {
        mesh.triangles.extend([[at(r, s), at(r, s + 1), at(r + 1, s)], [at(r, s + 1), at(r + 1, s + 1), at(r + 1, s)]]);
    }
    let ends = [0, RINGS - 1].map(|r| at(r, 0));
    for (ring, middle) in [(0, from), (RINGS - 1, from + along)].into_iter().filter(|_| is_closed) {
        let tip = mesh.positions.len() as u32;
        mesh.positions.push(middle);
        let fan = (0..SIDES).map(|s| [at(ring, s), at(ring, s + 1), tip]);
        mesh.triangles.extend(fan.map(|[a, b, tip]| if ring == 0 { [b, a, tip] } else { [a, b, tip] }));
    }
    (mesh, ends)
}

/// A tree of bones.
fn bones(random: &mut Random, count: u32) -> Skeleton {
    let joints = (0..=count).map(|_| random.vector()).collect();
    Skeleton { joints, bones: (1..=count).map(|j| [(f64::from(j) * random.unit()) as u32, j]).collect() }
}

#[test]
fn the_share_of_bones_inside_a_body_is_that_of_points_with_an_odd_number_of_walls_above_them() {
    let mut random = Random::new(74);
    let (mut least, mut most) = (1.0_f64, 0.0_f64);
    for _ in 0..60 {
        let (body, _) = tube(&mut random, true);
        let skeleton = bones(&mut random, 4);
        let far = 10.0 * random.vector().normalize();
        let is_inside = |p: &DVec3| {
            let walls: i32 =
                (0..body.triangles.len() as u32).map(|t| crossing([*p, *p + far], body.corners(t)).abs()).sum();
            walls % 2 == 1
        };
        let (mut inside, mut whole) = (0.0, 0.0);
        for bone in &skeleton.bones {
            let [a, b] = bone.map(|j| skeleton.joints[j as usize]);
            let points = (0..6).map(|k| a + (f64::from(k) + 0.5) / 6.0 * (b - a));
            inside += points.filter(is_inside).count() as f64 / 6.0 * (b - a).length();
            whole += (b - a).length();
        }
        let share = inside_share(&body, &skeleton);
        assert!((share - inside / whole).abs() < 1e-12, "{share} {}", inside / whole);
        (least, most) = (least.min(share), most.max(share));
    }
    assert!(least == 0.0 && most > 0.2, "{least} {most}");
}

#[test]
fn openings_and_cloth_on_the_way_of_bones_are_those_that_they_cross() {
    let mut random = Random::new(75);
    let mut seen = [0; 3];
    for _ in 0..100 {
        // Two tubes anywhere, of four openings.
        let (mut garment, first) = tube(&mut random, false);
        let (other, second) = tube(&mut random, false);
        let offset = garment.positions.len() as u32;
        garment.positions.extend(other.positions);
        garment.triangles.extend(other.triangles.iter().map(|t| t.map(|v| offset + v)));
        let openings: Vec<Vec<DVec3>> = first
            .into_iter()
            .chain(second.map(|v| offset + v))
            .map(|start| garment.positions[start as usize..start as usize + 9].to_vec())
            .collect();
        let skeleton = bones(&mut random, 5);
        let ends = |bone: &[u32; 2]| bone.map(|j| skeleton.joints[j as usize]);
        let is_leaf = |joint: u32| skeleton.bones.iter().flatten().filter(|&&j| j == joint).count() == 1;
        // Half as long again beyond the ends of limbs.
        let reaching = skeleton.bones.iter().map(|bone| {
            let [a, b] = ends(bone);
            let more = |joint: u32| if is_leaf(joint) { 0.5 } else { 0.0 };
            [a - more(bone[0]) * (b - a), b + more(bone[1]) * (b - a)]
        });
        let reaching: Vec<[DVec3; 2]> = reaching.collect();
        let goes_through = |points: &[DVec3], segment: [DVec3; 2]| {
            let middle = points.iter().sum::<DVec3>() / points.len() as f64;
            let fan = (0..points.len()).map(|k| [middle, points[k], points[(k + 1) % points.len()]]);
            fan.map(|corners| crossing(segment, corners)).sum::<i32>() != 0
        };
        let passes_cloth = |segment: [DVec3; 2]| {
            (0..garment.triangles.len() as u32).any(|t| crossing(segment, garment.corners(t)) != 0)
        };
        let expected = Threading {
            through: openings.iter().filter(|points| reaching.iter().any(|&bone| goes_through(points, bone))).count(),
            pierced: skeleton.bones.iter().filter(|bone| passes_cloth(ends(bone))).count(),
        };
        let threaded = Threaded::new(&garment);
        assert_eq!(threaded.on(&skeleton), expected);
        assert_eq!(threaded.empty_openings(&skeleton).len(), 4 - expected.through);
        // Each opening by itself, whichever number it has.
        for &bone in &reaching {
            assert_eq!(threaded.passes_cloth(bone), passes_cloth(bone));
            for k in 0..4 {
                let (middle, length) = threaded.opening(k);
                let own = openings.iter().find(|points| (points.iter().sum::<DVec3>() / 9.0).distance(middle) < 1e-12);
                let own = own.expect("the middle of an opening");
                assert_eq!(threaded.goes_through(k, bone), goes_through(own, bone));
                let around: f64 = (0..9).map(|k| own[k].distance(own[(k + 1) % 9])).sum();
                assert!((length - around).abs() < 1e-12);
            }
        }
        seen[0] += expected.through;
        seen[1] += expected.pierced;
        seen[2] += 5 - expected.pierced;
    }
    assert!(seen.iter().all(|&count| count > 20), "{seen:?}");
}
