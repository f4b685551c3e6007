//! Which bones a garment encloses: one answer for one surface, however it is cut into triangles.

use std::f64::consts::{PI, TAU};

use bespoke::geometry::mesh::{Topology, TriangleMesh, label_pieces};
use bespoke::stage::start::enclosure::{Enclosures, encloses};
use bespoke::stage::start::winding::windings;
use glam::{DQuat, DVec3};
use testing::Random;

/// Bones of a body 2 high that stands on z = -1, its arms to the sides, as far as the body goes on beyond them.
fn body() -> Vec<[DVec3; 2]> {
    let joints = [
        [0.0, 0.0, 0.0],   // pelvis
        [0.0, 0.02, 0.25], // waist
        [0.0, 0.0, 0.55],  // chest
        [0.0, 0.02, 0.68], // neck
        [0.0, 0.0, 0.95],  // top of the head
        [0.22, 0.0, 0.58], // shoulders, hands
        [0.9, 0.03, 0.5],
        [-0.22, 0.0, 0.58],
        [-0.9, 0.03, 0.5],
        [0.12, 0.0, -0.05], // hips, knees, feet
        [0.14, 0.03, -0.5],
        [0.15, 0.0, -0.98],
        [-0.12, 0.0, -0.05],
        [-0.14, 0.03, -0.5],
        [-0.15, 0.0, -0.98],
    ];
    let bones = [
        [0, 1],
        [1, 2],
        [2, 3],
        [3, 4],
        [2, 5],
        [5, 6],
        [2, 7],
        [7, 8],
        [0, 9],
        [9, 10],
        [10, 11],
        [0, 12],
        [12, 13],
        [13, 14],
    ];
    bones.map(|bone: [usize; 2]| bone.map(|j| DVec3::from(joints[j]))).to_vec()
}

const TRUNK: [u32; 2] = [0, 1];
const NECK: [u32; 2] = [2, 3];

/// A strip of `rows` by `sides` faces at `at(around, across)`, both from 0 to 1; closed around or open there, its diagonals
/// one way or at random.
fn strip(at: impl Fn(f64, f64) -> DVec3, [sides, rows]: [u32; 2], closed: bool, random: &mut Random) -> TriangleMesh {
    let columns = if closed { sides } else { sides + 1 };
    let mut mesh = TriangleMesh::default();
    for r in 0..=rows {
        for s in 0..columns {
            mesh.positions.push(at(f64::from(s) / f64::from(sides), f64::from(r) / f64::from(rows)));
        }
    }
    let v = |s: u32, r: u32| r * columns + s % columns;
    for r in 0..rows {
        for s in 0..sides {
            let [a, b, c, d] = [v(s, r), v(s + 1, r), v(s + 1, r + 1), v(s, r + 1)];
            mesh.triangles.extend(if random.unit() < 0.5 { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] });
        }
    }
    mesh
}

/// A ring of a radius about `centre`, tilted by an angle about a horizontal axis.
fn ring(centre: DVec3, tilt: f64, axis: f64, radius: f64, angle: f64) -> DVec3 {
    let turn = DQuat::from_axis_angle(DVec3::new(axis.cos(), axis.sin(), 0.0), tilt);
    centre + turn * (radius * DVec3::new(angle.cos(), angle.sin(), 0.0))
}

const TESSELLATIONS: [[u32; 2]; 5] = [[7, 1], [16, 1], [24, 3], [61, 2], [150, 7]];

fn only(garment: &TriangleMesh) -> (bool, Vec<u32>) {
    let found = Enclosures::find(garment, &body());
    assert_eq!(found.pieces.len(), 1);
    assert_eq!(encloses(garment, &body()), found.any());
    (found.pieces[0].encloses, found.pieces[0].segments.clone())
}

/// At any height between joints, thin or wide, tilted or not.
#[test]
fn forty_belts_are_around_the_trunk_in_every_tessellation() {
    let mut random = Random::new(21);
    for belt in 0..40 {
        let height = 0.02 + 0.01 * f64::from(belt);
        let (tilt, axis, width) = (0.4 * random.unit(), TAU * random.unit(), 0.004 + 0.08 * random.unit());
        for tessellation in TESSELLATIONS {
            let at = |around: f64, across: f64| {
                let centre = DVec3::new(0.0, 0.01, height + width * (across - 0.5));
                ring(centre, tilt, axis, 0.19, TAU * around)
            };
            let garment = strip(at, tessellation, true, &mut random);
            assert_eq!(only(&garment), (true, TRUNK.to_vec()), "belt {belt}, {tessellation:?}");
        }
    }
}

/// A chain around the neck, a torus without a border, lying on chest and back.
#[test]
fn a_necklace_is_around_the_neck_at_any_tilt() {
    let mut random = Random::new(22);
    for tilt in [0.0, 10.0, 25.0, 45.0, 60.0_f64] {
        for tessellation in [[12, 3], [40, 5], [160, 9]] {
            let at = |around: f64, across: f64| {
                let centre = DVec3::new(0.0, 0.01, 0.63);
                let out = ring(DVec3::ZERO, tilt.to_radians(), 0.0, 1.0, TAU * around);
                let up = DQuat::from_axis_angle(DVec3::X, tilt.to_radians()) * DVec3::Z;
                centre + 0.15 * out + 0.008 * ((TAU * across).cos() * out + (TAU * across).sin() * up)
            };
            let mut garment = strip(at, tessellation, true, &mut random);
            // The last row is the first.
            let [sides, rows] = tessellation;
            garment.triangles.iter_mut().flatten().for_each(|v| *v %= sides * rows);
            garment.positions.truncate((sides * rows) as usize);
            assert_eq!(only(&garment), (true, NECK.to_vec()), "{tilt} degrees, {tessellation:?}");
        }
    }
}

/// Open at the clasp: no closed curve is around anything, but its own plane shows it.
#[test]
fn a_belt_with_a_gap_is_around_the_trunk() {
    let mut random = Random::new(23);
    for tilt in [0.0, 0.2, 0.5] {
        for tessellation in TESSELLATIONS {
            let at = |around: f64, across: f64| {
                let centre = DVec3::new(0.0, 0.01, 0.13 + 0.03 * across);
                ring(centre, tilt, 1.0, 0.19, 0.1 + (TAU - 0.2) * around)
            };
            let (encloses, segments) = only(&strip(at, tessellation, false, &mut random));
            assert!(encloses && segments.contains(&0), "tilt {tilt}, {tessellation:?}: {segments:?}");
        }
    }
}

/// A sheet in front of the legs that hangs on a band around the waist.
#[test]
fn an_apron_is_around_the_waist() {
    let mut random = Random::new(24);
    for tessellation in [[16, 1], [48, 2], [144, 3]] {
        let [sides, _] = tessellation;
        let band =
            |around: f64, across: f64| ring(DVec3::new(0.0, 0.01, 0.2 - 0.02 * across), 0.2, 0.0, 0.19, TAU * around);
        let mut garment = strip(band, tessellation, true, &mut random);
        let sheet =
            |around: f64, across: f64| band(0.5 + 0.5 * around, 1.0) - DVec3::new(0.0, 0.05 * across, 0.5 * across);
        let hanging = strip(sheet, [sides / 2, sides / 2], false, &mut random);
        // The sheet's first row is the half of the band's last one.
        let (first, last) = (garment.positions.len() as u32, sides * tessellation[1]);
        let own = |v: u32| if v <= sides / 2 { last + (sides / 2 + v) % sides } else { first + v };
        garment.positions.extend(&hanging.positions);
        garment.triangles.extend(hanging.triangles.iter().map(|t| t.map(own)));
        assert_eq!(only(&garment), (true, TRUNK.to_vec()), "{tessellation:?}");
    }
}

/// A cape with a closed collar: all but a ring at the neck is behind the back.
#[test]
fn a_cape_with_a_closed_collar_is_around_the_neck() {
    let mut random = Random::new(25);
    for tessellation in [[16, 8], [40, 30], [64, 36], [90, 50]] {
        let at = |around: f64, across: f64| {
            let angle = TAU * around;
            let back = angle.sin().max(0.0);
            let collar = ring(DVec3::new(0.0, 0.01, 0.66), 0.15, 0.0, 0.1, angle);
            collar + across * (0.04 * DVec3::new(angle.cos(), angle.sin(), -0.5) + back * DVec3::new(0.0, 0.15, -1.1))
        };
        assert_eq!(only(&strip(at, tessellation, true, &mut random)), (true, NECK.to_vec()), "{tessellation:?}");
    }
}

/// Over one shoulder and under the other arm: around the chest, and around no single bone.
#[test]
fn a_sash_is_around_the_body() {
    let mut random = Random::new(26);
    for tessellation in TESSELLATIONS {
        let at = |around: f64, across: f64| {
            let turned = ring(DVec3::ZERO, 0.0, 0.0, 1.0, TAU * around);
            DVec3::new(0.04 * across - 0.03 + 0.2 * turned.x, 0.15 * turned.y, 0.45 + 0.28 * turned.x)
        };
        assert!(only(&strip(at, tessellation, true, &mut random)).0, "{tessellation:?}");
    }
}

/// Closed over the end of a bone: a hat, and a shoe on a leg without a foot bone.
#[test]
fn a_hat_and_a_shoe_are_around_ends() {
    let mut random = Random::new(27);
    for tessellation in [[9, 5], [24, 12], [80, 40]] {
        let dome = |around: f64, across: f64| {
            let (angle, up) = (TAU * around, 0.5 * PI * across);
            DVec3::new(0.0, 0.0, 0.86) + 0.13 * DVec3::new(angle.cos() * up.cos(), angle.sin() * up.cos(), up.sin())
        };
        assert_eq!(only(&strip(dome, tessellation, true, &mut random)), (true, vec![3]), "{tessellation:?}");
        let shoe = |around: f64, across: f64| {
            let (angle, down) = (TAU * around, 0.5 * PI * across);
            let out = DVec3::new(0.07 * angle.cos(), 0.13 * angle.sin(), 0.0) * down.cos();
            DVec3::new(0.15, -0.04, -0.88) + out - DVec3::new(0.0, 0.0, 0.11 * down.sin())
        };
        assert_eq!(only(&strip(shoe, tessellation, true, &mut random)), (true, vec![10]), "{tessellation:?}");
    }
}

/// Beside the body, beyond its ends, or on its front or back only.
#[test]
fn what_is_beside_the_skeleton_encloses_nothing() {
    let mut random = Random::new(28);
    for tessellation in TESSELLATIONS {
        let tube = |centre: DVec3, along: DVec3, radius: f64| {
            let (u, v) = along.any_orthonormal_pair();
            move |around: f64, across: f64| {
                centre + along * (0.3 * (across - 0.5)) + radius * ((TAU * around).cos() * u + (TAU * around).sin() * v)
            }
        };
        let beside = [
            tube(DVec3::new(0.5, 0.5, 0.2), DVec3::Z, 0.2),
            tube(DVec3::new(0.0, -0.4, 0.3), DVec3::Z, 0.3),
            // On the lines of an arm, a leg and the head.
            tube(DVec3::new(1.4, 0.03, 0.47), DVec3::X, 0.2),
            tube(DVec3::new(0.15, 0.0, -1.4), DVec3::Z, 0.2),
            tube(DVec3::new(0.0, 0.0, 1.4), DVec3::Z, 0.2),
        ];
        for (k, at) in beside.iter().enumerate() {
            assert_eq!(only(&strip(at, tessellation, true, &mut random)), (false, vec![]), "{k}, {tessellation:?}");
        }
        let sheet = |around: f64, across: f64| DVec3::new(0.5 * around - 0.25, 0.2, 0.5 - 0.9 * across);
        assert_eq!(only(&strip(sheet, tessellation, false, &mut random)), (false, vec![]), "{tessellation:?}");
    }
}

/// Pieces are told apart: a belt, a badge and a bracelet in one mesh.
#[test]
fn each_piece_has_an_answer_of_its_own() {
    let mut random = Random::new(29);
    let belt =
        strip(|a, b| ring(DVec3::new(0.0, 0.01, 0.1 + 0.03 * b), 0.1, 0.0, 0.19, TAU * a), [20, 1], true, &mut random);
    let badge = strip(|a, b| DVec3::new(0.1 * a, -0.2, 0.4 + 0.1 * b), [3, 3], false, &mut random);
    let bracelet = strip(
        |a, b| DVec3::new(0.8 + 0.02 * b, 0.05 * (TAU * a).cos() + 0.025, 0.05 * (TAU * a).sin() + 0.515),
        [14, 1],
        true,
        &mut random,
    );
    let (mut garment, mut firsts) = (TriangleMesh::default(), Vec::new());
    for part in [&belt, &badge, &bracelet] {
        let first = garment.positions.len() as u32;
        firsts.push(first);
        garment.positions.extend(&part.positions);
        garment.triangles.extend(part.triangles.iter().map(|t| t.map(|v| v + first)));
    }
    garment.positions.push(DVec3::ONE);
    let found = Enclosures::find(&garment, &body());
    assert_eq!(found.of(firsts[0]).unwrap().segments, TRUNK);
    assert!(!found.of(firsts[1]).unwrap().encloses);
    // From the chest on, an arm is a row without a branch.
    assert_eq!(found.of(firsts[2]).unwrap().segments, [4, 5]);
    assert!(found.of(garment.positions.len() as u32 - 1).is_none());
}

/// The linking number of two closed polygons by Gauss's integral: for two segments the signed area of a spherical
/// quadrilateral.
fn gauss(curve: &[DVec3], line: &[DVec3]) -> f64 {
    let mut sum = 0.0;
    for i in 0..curve.len() {
        for j in 0..line.len() {
            let [a, b] = [curve[i], curve[(i + 1) % curve.len()]];
            let [c, d] = [line[j], line[(j + 1) % line.len()]];
            let (ac, ad, bd, bc) = (c - a, d - a, d - b, c - b);
            let faces = [ac.cross(ad), ad.cross(bd), bd.cross(bc), bc.cross(ac)].map(|n| n.normalize_or_zero());
            let angle = |k: usize| faces[k].dot(faces[(k + 1) % 4]).clamp(-1.0, 1.0).asin();
            sum += (angle(0) + angle(1) + angle(2) + angle(3)) * (d - c).cross(b - a).dot(ac).signum();
        }
    }
    sum / (2.0 * TAU)
}

/// Thin tubes along random closed curves among the branches of random trees, whose ends are far away.
#[test]
fn winding_is_what_gauss_integral_gives() {
    let mut random = Random::new(30);
    let mut point = |size: f64| size * random.vector();
    let (mut linked, mut free, mut sure) = (0, 0, 0);
    for _ in 0..150 {
        let forks = [DVec3::ZERO + point(0.3), point(1.0), point(1.0)];
        let tips: Vec<DVec3> = (0..5).map(|_| 400.0 * point(1.0).normalize_or(DVec3::X)).collect();
        let segments = [
            [forks[0], forks[1]],
            [forks[0], forks[2]],
            [forks[1], tips[0]],
            [forks[1], tips[1]],
            [forks[2], tips[2]],
            [forks[2], tips[3]],
            [forks[0], tips[4]],
        ];
        let knots: Vec<DVec3> = (0..5).map(|_| point(1.0)).collect();
        let core: Vec<DVec3> = (0..5)
            .flat_map(|k| (0..6).map(move |i| (k, i)))
            .map(|(k, i)| knots[k].lerp(knots[(k + 1) % 5], f64::from(i) / 6.0))
            .collect();
        // Far enough from every bone and from itself for a thin tube.
        let radius = 1e-3;
        let near = core.iter().enumerate().any(|(i, &p)| {
            let q = core[(i + 1) % core.len()];
            segments.iter().any(|&[a, b]| segment_distance([p, q], [a, b]) < 4.0 * radius)
        });
        if near {
            continue;
        }
        sure += 1;
        let mut tube = TriangleMesh::default();
        for &p in &core {
            tube.positions.extend([DVec3::X, DVec3::Y, -DVec3::ONE].map(|d| p + radius * d));
        }
        let count = core.len() as u32;
        for s in 0..count {
            for k in 0..3 {
                let v = |s: u32, k: u32| 3 * (s % count) + k % 3;
                tube.triangles.push([v(s, k), v(s + 1, k), v(s, k + 1)]);
                tube.triangles.push([v(s + 1, k), v(s + 1, k + 1), v(s, k + 1)]);
            }
        }
        let topology = Topology::new(tube.positions.len(), &tube.triangles);
        let (pieces, count) = label_pieces(tube.positions.len(), topology.edges.iter().copied());
        let found = &windings(&tube, &topology.edges, &pieces, count, &segments)[0];

        // From the last tip to each of the others, closed far away.
        let path = |way: &[usize], tip: usize| {
            let mut line = vec![tips[4]];
            line.extend(way.iter().map(|&k| forks[k]));
            let far = (tips[4] + tips[tip]).normalize_or(tips[4].any_orthonormal_vector()) * 4e3;
            line.extend([tips[tip], tips[tip] * 10.0, far, tips[4] * 10.0]);
            gauss(&core, &line)
        };
        let exact = [path(&[0, 1], 0), path(&[0, 1], 1), path(&[0, 2], 2), path(&[0, 2], 3)];
        let numbers = exact.map(f64::round);
        assert!(exact.iter().zip(numbers).all(|(x, n)| (x - n).abs() < 0.05), "{exact:?}");
        assert_eq!(found.linked, numbers != [0.0; 4], "{numbers:?} {found:?}");
        // A bone is wound around where the numbers are a multiple of what a ring around it has.
        let rings = [
            [1.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, 1.0, 1.0],
            [1.0, 0.0, 0.0, 0.0],
            [0.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, 1.0, 0.0],
            [0.0, 0.0, 0.0, 1.0],
            [1.0, 1.0, 1.0, 1.0],
        ];
        let is_multiple = |ring: &[f64; 4]| {
            let factor = numbers.iter().copied().find(|&n| n != 0.0).unwrap_or(0.0);
            factor != 0.0 && numbers == ring.map(|r| r * factor)
        };
        let wound: Vec<u32> = (0u32..).zip(&rings).filter(|(_, ring)| is_multiple(ring)).map(|(k, _)| k).collect();
        assert_eq!(found.segments, wound, "{numbers:?}");
        *(if found.linked { &mut linked } else { &mut free }) += 1;
    }
    assert!(sure > 80 && linked > 20 && free > 20, "{sure} {linked} {free}");
}

fn segment_distance([a, b]: [DVec3; 2], [c, d]: [DVec3; 2]) -> f64 {
    // Coarse, and that suffices: the least over points of one of them.
    (0..=200)
        .map(|k| a.lerp(b, f64::from(k) / 200.0))
        .map(|p| {
            let along = ((p - c).dot(d - c) / (d - c).length_squared()).clamp(0.0, 1.0);
            p.distance(c.lerp(d, along))
        })
        .fold(f64::INFINITY, f64::min)
}
