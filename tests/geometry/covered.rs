//! What a garment covers of a body, against brute force and on shapes of which it is known.

use std::f64::consts::TAU;

use bespoke::control::Cancel;
use bespoke::geometry::closest_point::ray_triangle;
use bespoke::geometry::cover::direction;
use bespoke::geometry::covered::{CoveredOptions, DIRECTIONS, FLAT, Wearer, covered_triangles, points_within};
use bespoke::geometry::mesh::{TriangleMesh, triangle_area};
use glam::{DAffine3, DQuat, DVec3};
use testing::Random;

/// A tube along z, open or with tips at its ends.
fn tube(radius: f64, [low, high]: [f64; 2], rings: u32, sides: u32, closed: bool) -> TriangleMesh {
    let mut mesh = TriangleMesh::default();
    for r in 0..=rings {
        let z = low + (high - low) * f64::from(r) / f64::from(rings);
        for s in 0..sides {
            let angle = TAU * f64::from(s) / f64::from(sides);
            mesh.positions.push(DVec3::new(radius * angle.cos(), radius * angle.sin(), z));
        }
    }
    let at = |r: u32, s: u32| r * sides + s % sides;
    for r in 0..rings {
        for s in 0..sides {
            let [a, b, c, d] = [at(r, s), at(r, s + 1), at(r + 1, s + 1), at(r + 1, s)];
            mesh.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    if closed {
        for (ring, z, turn) in [(0, low, true), (rings, high, false)] {
            let tip = mesh.positions.len() as u32;
            mesh.positions.push(DVec3::new(0.0, 0.0, z));
            for s in 0..sides {
                let [a, b] = if turn { [at(ring, s + 1), at(ring, s)] } else { [at(ring, s), at(ring, s + 1)] };
                mesh.triangles.push([a, b, tip]);
            }
        }
    }
    mesh
}

fn joined(a: &TriangleMesh, b: &TriangleMesh) -> TriangleMesh {
    let first = a.positions.len() as u32;
    let further = b.triangles.iter().map(|t| t.map(|v| v + first));
    TriangleMesh {
        positions: [&a.positions[..], &b.positions[..]].concat(),
        triangles: a.triangles.iter().copied().chain(further).collect(),
    }
}

fn skin(mesh: &TriangleMesh) -> Wearer<'_> {
    Wearer { mesh, asked: 0..mesh.triangles.len() as u32, is_cloth: false }
}

fn covered(body: &TriangleMesh, garment: &TriangleMesh, margin: u32, openness: f64) -> Vec<u32> {
    covered_triangles(&skin(body), garment, &CoveredOptions { margin, openness }, &Cancel::new()).unwrap()
}

/// The heights of the middles of the lowest and the highest of some triangles.
fn span(mesh: &TriangleMesh, triangles: &[u32]) -> [f64; 2] {
    let heights = || triangles.iter().map(|&t| mesh.centre(t).z);
    [heights().fold(f64::INFINITY, f64::min), heights().fold(f64::NEG_INFINITY, f64::max)]
}

fn arm() -> TriangleMesh {
    tube(0.1, [-1.0, 1.0], 80, 16, true)
}

#[test]
fn a_sleeve_covers_the_arm_but_for_what_is_seen_through_its_cuffs() {
    let arm = arm();
    let tight = covered(&arm, &tube(0.11, [-0.5, 0.5], 40, 16, false), 1, 0.0);
    let [low, high] = span(&arm, &tight);
    assert!((-0.5..-0.3).contains(&low) && (0.3..0.5).contains(&high), "{low} to {high}");
    // All around, in between.
    let within = |t: &u32| arm.centre(*t).z.abs() < 0.35;
    let all = (0..arm.triangles.len() as u32).filter(within).collect::<Vec<u32>>();
    assert_eq!(tight.into_iter().filter(within).collect::<Vec<u32>>(), all);
    // The wider the sleeve is, the farther one sees into it.
    let wide = covered(&arm, &tube(0.14, [-0.5, 0.5], 40, 16, false), 1, 0.0);
    let [wide_low, wide_high] = span(&arm, &wide);
    assert!(wide_low > low + 0.05 && wide_high < high - 0.05 && wide_low < wide_high, "{wide_low} to {wide_high}");
}

#[test]
fn more_margin_is_less_and_more_openness_more() {
    let (arm, sleeve) = (arm(), tube(0.12, [-0.5, 0.5], 40, 16, false));
    let length = |margin, openness| {
        let [low, high] = span(&arm, &covered(&arm, &sleeve, margin, openness));
        high - low
    };
    // A ring is 0.025 high.
    for margin in 0..3 {
        let lost = length(margin, 0.0) - length(margin + 1, 0.0);
        assert!((lost - 0.05).abs() < 0.02, "ring {margin}: {lost}");
    }
    let lengths = [0.0, 0.1, 0.2, 0.4].map(|openness| length(0, openness));
    assert!(lengths.is_sorted() && lengths[3] > lengths[0] + 0.05, "{lengths:?}");
    assert!(lengths[3] < 1.0, "not beyond the cuffs: {lengths:?}");
}

#[test]
fn a_skirt_covers_with_openness_alone() {
    let (leg, skirt) = (tube(0.1, [-1.0, 0.2], 48, 16, true), tube(0.4, [-0.5, 0.1], 24, 24, false));
    // Its upper end is closed.
    let waist = tube(0.4, [0.1, 0.10001], 1, 24, true);
    let skirt = joined(&skirt, &waist);
    let shown = covered(&leg, &skirt, 0, 0.0);
    let lenient = covered(&leg, &skirt, 0, 0.3);
    let [bottom, _] = span(&leg, &lenient);
    assert!(lenient.len() > shown.len() + 100 && bottom > -0.5, "{} {} {bottom}", shown.len(), lenient.len());
}

#[test]
fn what_is_beside_a_garment_or_beyond_it_is_not_in_it() {
    let trunk = tube(0.3, [-1.0, 1.0], 60, 24, true);
    let vest = tube(0.32, [-0.6, 0.6], 36, 24, false);
    // An arm along the vest, so near that whatever looks from its side sees the vest.
    let mut arm = tube(0.08, [-0.5, 0.5], 30, 12, true);
    arm.positions.iter_mut().for_each(|p| p.x += 0.405);
    let body = joined(&trunk, &arm);
    let found = covered(&body, &vest, 0, 0.0);
    assert!(found.iter().all(|&t| (t as usize) < trunk.triangles.len()), "the arm is bare");
    assert_eq!(found, covered(&trunk, &vest, 0, 0.0), "and hides nothing");
    // A hand before the cuff closes it in this pose only.
    let (forearm, sleeve) = (tube(0.1, [-1.0, 0.5], 60, 16, false), tube(0.2, [-0.8, 0.4], 40, 16, false));
    let mut hand = tube(0.4, [0.42, 0.43], 1, 16, true);
    hand.positions.iter_mut().for_each(|p| *p += DVec3::new(0.001, 0.002, 0.0));
    let with_hand = covered(&joined(&forearm, &hand), &sleeve, 0, 0.0);
    assert_eq!(with_hand, covered(&forearm, &sleeve, 0, 0.0));
}

#[test]
fn a_part_in_the_garment_closes_what_is_behind_it() {
    // Beneath a belly: faces downwards, and would be seen through the hem, were it not for the hips.
    let chest = tube(0.3, [0.0, 0.6], 20, 24, true);
    let hips = tube(0.36, [-0.5, -0.1], 20, 24, true);
    let shirt = tube(0.38, [-0.45, 0.5], 40, 24, false);
    let beneath = |body: &TriangleMesh| {
        let found = covered(body, &shirt, 0, 0.0);
        found.iter().filter(|&&t| body.centre(t).z.abs() < 1e-9).count()
    };
    assert_eq!(beneath(&joined(&chest, &hips)), 24);
    assert_eq!(beneath(&chest), 0);
}

#[test]
fn neither_place_nor_size_nor_winding_nor_seams_make_a_difference() {
    let (arm, sleeve) = (arm(), tube(0.15, [-0.5, 0.5], 40, 16, false));
    let expected = covered(&arm, &sleeve, 1, 0.0);
    let flip = |mesh: &TriangleMesh| TriangleMesh {
        positions: mesh.positions.clone(),
        triangles: mesh.triangles.iter().map(|&[a, b, c]| [a, c, b]).collect(),
    };
    assert_eq!(covered(&flip(&arm), &sleeve, 1, 0.0), expected);
    assert_eq!(covered(&arm, &flip(&sleeve), 1, 0.0), expected);
    let moved = |mesh: &TriangleMesh, scale: f64, by: DVec3| TriangleMesh {
        positions: mesh.positions.iter().map(|&p| scale * p + by).collect(),
        triangles: mesh.triangles.clone(),
    };
    // Powers of two, so that the numbers are the same but for their exponents.
    assert_eq!(covered(&moved(&arm, 128.0, DVec3::ZERO), &moved(&sleeve, 128.0, DVec3::ZERO), 1, 0.0), expected);
    let by = DVec3::new(3.0, -4.0, 8.0);
    let far = covered(&moved(&arm, 1.0, by), &moved(&sleeve, 1.0, by), 1, 0.0);
    assert!(far.len().abs_diff(expected.len()) <= 32, "{} {}", far.len(), expected.len());
    // Every triangle with corners of its own: the rings of the margin go on.
    let soup = TriangleMesh::from_corners((0..arm.triangles.len() as u32).map(|t| arm.corners(t)));
    assert_eq!(covered(&soup, &sleeve, 1, 0.0), expected);
}

#[test]
fn a_coarse_body_is_looked_at_within_its_triangles() {
    // A window in the sleeve before the middle of a long face of the arm.
    let arm = tube(0.1, [-1.0, 1.0], 1, 4, true);
    let mut sleeve = tube(0.15, [-1.5, 1.5], 300, 64, true);
    let all = covered(&arm, &sleeve, 0, 0.0);
    assert_eq!(all.len(), arm.triangles.len());
    let window = |t: &[u32; 3]| {
        let p = t.iter().map(|&v| sleeve.positions[v as usize]).sum::<DVec3>() / 3.0;
        p.x > 0.0 && p.y > 0.0 && (p.x - p.y).abs() < 0.05 && p.z.abs() < 0.05
    };
    sleeve.triangles = sleeve.triangles.iter().copied().filter(|t| !window(t)).collect();
    let found = covered(&arm, &sleeve, 0, 0.0);
    assert!(found.len() < all.len() && found.len() >= all.len() - 2, "{} of {}", found.len(), all.len());
}

#[test]
fn cloth_is_looked_at_from_both_sides() {
    // A shirt on nobody, in a jacket that is open below.
    let (shirt, jacket) = (tube(0.3, [-0.5, 0.5], 40, 24, false), tube(0.31, [-0.6, 0.6], 48, 24, false));
    let ask = |mesh: &TriangleMesh, is_cloth| {
        let wearer = Wearer { mesh, asked: 0..shirt.triangles.len() as u32, is_cloth };
        covered_triangles(&wearer, &jacket, &CoveredOptions::default(), &Cancel::new()).unwrap().len()
    };
    assert!(ask(&shirt, false) > 500);
    assert!(ask(&shirt, true) < ask(&shirt, false) / 2);
    // The trunk in it closes its inner side.
    let worn = joined(&shirt, &tube(0.28, [-1.0, 1.0], 80, 24, true));
    assert!(ask(&worn, true) > 500, "{}", ask(&worn, true));
}

#[test]
fn triangles_are_cut_into_equal_pieces() {
    let corners = [DVec3::ZERO, DVec3::new(3.0, 0.0, 1.0), DVec3::new(1.0, 2.0, -1.0)];
    for pieces in 1..=4 {
        let points: Vec<DVec3> = points_within(corners, pieces).collect();
        assert_eq!(points.len(), pieces * pieces);
        let mean = points.iter().sum::<DVec3>() / points.len() as f64;
        assert!(mean.distance(corners.iter().sum::<DVec3>() / 3.0) < 1e-12, "{mean}");
        let least = points.iter().enumerate().flat_map(|(k, p)| points[..k].iter().map(move |q| p.distance(*q)));
        assert!(least.fold(f64::INFINITY, f64::min) > 0.4 / pieces as f64);
    }
}

/// The same question with no tree: every ray against every triangle.
fn brute_force(body: &TriangleMesh, garment: &TriangleMesh, openness: f64) -> Vec<u32> {
    let corners = |mesh: &TriangleMesh| (0..mesh.triangles.len() as u32).map(|t| mesh.corners(t)).collect::<Vec<_>>();
    let meets = |soup: &[[DVec3; 3]], p: DVec3, d: DVec3| soup.iter().any(|t| ray_triangle(p, d, t).is_some());
    let directions: Vec<DVec3> = (0..DIRECTIONS).map(|k| direction(k, DIRECTIONS)).collect();
    let cloth = corners(garment);
    let around = |p: DVec3| 2 * directions.iter().filter(|&&d| meets(&cloth, p, d)).count() >= DIRECTIONS;
    let is_inside: Vec<bool> = corners(body).iter().map(|t| t.iter().all(|&p| around(p))).collect();
    let inner: Vec<[DVec3; 3]> =
        corners(body).into_iter().zip(&is_inside).filter(|(_, inside)| **inside).map(|(t, _)| t).collect();
    let [size, length] = [body, garment].map(|mesh| {
        let low = mesh.positions.iter().copied().fold(DVec3::INFINITY, DVec3::min);
        let high = mesh.positions.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
        (high - low).max_element()
    });
    let is_seen = |[a, b, c]: [DVec3; 3]| {
        let normal = (b - a).cross(c - a).normalize_or_zero();
        let facing: Vec<DVec3> = directions.iter().copied().filter(|d| d.dot(normal) > FLAT).collect();
        let allowed = openness * facing.len() as f64;
        let middle = (a + b + c) / 3.0;
        let corners = [a, b, c].map(|corner| (corner, corner.lerp(middle, 0.05)));
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        let pieces = (longest / (0.03 * length)).min(6.0) as usize;
        let within = points_within([a, b, c], pieces).map(|p| (p, p));
        corners.into_iter().chain(within).any(|(from, p)| {
            let p = p + 1e-7 * size * normal;
            let open = facing.iter().filter(|&&d| !meets(&cloth, from, d) && !meets(&inner, p, d)).count();
            open as f64 > allowed.floor()
        })
    };
    let soup = corners(body);
    (0..soup.len() as u32).filter(|&t| is_inside[t as usize] && !is_seen(soup[t as usize])).collect()
}

#[test]
fn random_bodies_as_by_brute_force() {
    let mut random = Random::new(7);
    let (mut some, mut all) = (0, 0);
    for round in 0..4 {
        let mut body = tube(0.3, [-1.0, 1.0], 16, 10, true);
        let mut sleeve = tube(0.33 + 0.05 * random.unit(), [-0.7, 0.8], 12, 10, round % 3 == 0);
        body.positions.iter_mut().for_each(|p| *p += 0.01 * random.vector());
        sleeve.positions.iter_mut().for_each(|p| *p += 0.01 * random.vector());
        // Some of its triangles are missing.
        if round % 2 == 0 {
            sleeve.triangles.retain(|_| random.unit() > 0.02);
        }
        let turn = DAffine3::from_quat(DQuat::from_scaled_axis(random.vector()));
        for mesh in [&mut body, &mut sleeve] {
            mesh.positions.iter_mut().for_each(|p| *p = turn.transform_point3(*p));
        }
        let openness = [0.0, 0.05, 0.2][round % 3];
        let expected = brute_force(&body, &sleeve, openness);
        assert_eq!(covered(&body, &sleeve, 0, openness), expected, "round {round}");
        some += expected.len();
        all += body.triangles.len();
        assert!(body.areas().iter().all(|&area| area > 0.0) && triangle_area(sleeve.corners(0)) > 0.0);
    }
    assert!(some > all / 8 && some < all * 7 / 8, "{some} of {all}");
}

#[test]
fn nothing_covers_nothing_and_a_stop_is_heard() {
    let arm = arm();
    assert_eq!(covered(&arm, &TriangleMesh::default(), 1, 1.0), Vec::<u32>::new());
    assert_eq!(covered(&TriangleMesh::default(), &arm, 1, 0.0), Vec::<u32>::new());
    let stop = Cancel::new();
    stop.request();
    assert!(covered_triangles(&skin(&arm), &arm, &CoveredOptions::default(), &stop).is_err());
}
