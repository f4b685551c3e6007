//! The six garments are what their names say, and clean enough to be dressed and measured.

use std::collections::HashSet;
use std::sync::LazyLock;
use std::thread;

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::verify::intersections;
use glam::{DVec2, DVec3};

use crate::distance::Triangles;
use crate::{MANNEQUIN, boundary_loops, euler_characteristic, smallest_angles};
use closet::Sample;
use closet::garments::{Garment, garment};
use closet::mesh::Mesh;
use closet::skeleton::{ARMS, BONES, LEGS, NECK, ROOT, WAIST};

static GARMENTS: LazyLock<Vec<(Garment, Sample)>> = LazyLock::new(|| {
    thread::scope(|scope| {
        let threads = Garment::ALL.map(|kind| scope.spawn(move || (kind, garment(kind))));
        threads.into_iter().map(|thread| thread.join().expect("a garment")).collect()
    })
});

pub fn made(kind: Garment) -> &'static Sample {
    &GARMENTS.iter().find(|(other, _)| *other == kind).expect("a garment of the catalogue").1
}

fn positions<'a>(sample: &'a Sample, curve: &'a [u32]) -> impl Iterator<Item = DVec3> + Clone + 'a {
    curve.iter().map(|&v| sample.mesh.positions[v as usize])
}

fn centre(sample: &Sample, curve: &[u32]) -> DVec3 {
    positions(sample, curve).sum::<DVec3>() / curve.len() as f64
}

/// The opening whose centre is nearest to a point.
fn opening(sample: &Sample, near: DVec3) -> Vec<u32> {
    let loops = boundary_loops(&sample.mesh);
    let distance = |curve: &Vec<u32>| centre(sample, curve).distance(near);
    loops.into_iter().min_by(|a, b| distance(a).total_cmp(&distance(b))).expect("an opening")
}

/// How often a closed curve goes around a vertical line, counter-clockwise from above.
fn turns(curve: impl Iterator<Item = DVec3> + Clone, line: DVec3) -> f64 {
    let flat = |p: DVec3| DVec2::new(p.x - line.x, p.y - line.y);
    let next = curve.clone().skip(1).chain(curve.clone().take(1));
    curve.zip(next).map(|(p, q)| flat(p).angle_to(flat(q))).sum::<f64>() / std::f64::consts::TAU
}

fn solid(mesh: &Mesh) -> TriangleMesh {
    // As a tool reads them: in 32 bits.
    let positions = mesh.positions.iter().map(|p| p.as_vec3().as_dvec3()).collect();
    TriangleMesh { positions, triangles: mesh.triangles.clone() }
}

#[test]
fn the_same_bits_every_time() {
    for (kind, first) in &*GARMENTS {
        assert_eq!(garment(*kind), *first, "{kind:?}");
    }
}

#[test]
fn each_has_its_openings_and_nothing_else() {
    let j = &MANNEQUIN.skeleton.joints;
    let (neck, hem) = (j[NECK], j[ROOT]);
    let ends = |limbs: [[usize; 3]; 2]| limbs.map(|[_, _, end]| j[end]);
    for (kind, sample) in &*GARMENTS {
        let named: Vec<DVec3> = match kind {
            Garment::Jumpsuit => [vec![neck], ends(ARMS).into(), ends(LEGS).into()].concat(),
            Garment::Coat | Garment::Sweater => [vec![neck, hem - DVec3::Z * 0.1], ends(ARMS).into()].concat(),
            Garment::Skirt => vec![j[WAIST], DVec3::Z * j[LEGS[0][1]].z],
            Garment::Vest => vec![neck - DVec3::Z * 0.1, hem, j[ARMS[0][0]], j[ARMS[1][0]]],
            Garment::Trousers => [vec![j[WAIST]], ends(LEGS).into()].concat(),
        };
        let mesh = &sample.mesh;
        assert!((1500..=6000).contains(&mesh.positions.len()), "{kind:?}: {} vertices", mesh.positions.len());
        assert_eq!(mesh.components().1, 1, "{kind:?}");
        // A sphere with that many holes.
        assert_eq!(euler_characteristic(mesh), 2 - named.len() as i64, "{kind:?}");
        let loops = boundary_loops(mesh);
        assert_eq!(loops.len(), named.len(), "{kind:?}");
        let found: HashSet<usize> = named
            .iter()
            .map(|&point| {
                let distance = |i: &usize| centre(sample, &loops[*i]).distance(point);
                let nearest = (0..loops.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0);
                assert!(distance(&nearest) < 0.13, "{kind:?}: no opening near {point}");
                nearest
            })
            .collect();
        assert_eq!(found.len(), named.len(), "{kind:?}: two openings are one");
        assert_eq!(sample.skeleton, MANNEQUIN.skeleton);
    }
}

#[test]
fn the_openings_are_smooth_curves() {
    for (kind, sample) in &*GARMENTS {
        // Some nine edges make one fold of the skirt.
        let most = if *kind == Garment::Skirt { 75.0 } else { 50.0 };
        for curve in boundary_loops(&sample.mesh) {
            let points: Vec<DVec3> = positions(sample, &curve).collect();
            let at = |i: usize| points[i % points.len()];
            let sharp = (0..points.len())
                .filter(|&i| (at(i + 1) - at(i)).angle_between(at(i + 2) - at(i + 1)).to_degrees() > most)
                .count();
            // The point of the V is the one corner.
            let corners = usize::from(*kind == Garment::Vest && curve == opening(sample, v_point(sample)));
            assert_eq!(sharp, corners, "{kind:?}: corners in an opening of {} vertices", points.len());
        }
    }
}

#[test]
fn triangles_are_regular() {
    for (kind, sample) in &*GARMENTS {
        let angles = smallest_angles(&sample.mesh);
        let smallest = angles.iter().copied().fold(f64::INFINITY, f64::min);
        assert!(smallest > 18.0, "{kind:?}: an angle of {smallest} degrees");
        let below = |limit: f64| angles.iter().filter(|&&angle| angle < limit).count();
        assert!(below(25.0) * 500 < angles.len(), "{kind:?}: {} of {} below 25 degrees", below(25.0), angles.len());
        assert!(below(35.0) * 33 < angles.len(), "{kind:?}: {} of {} below 35 degrees", below(35.0), angles.len());
    }
}

#[test]
fn no_triangle_meets_another_or_the_mannequin() {
    let body = solid(&MANNEQUIN.mesh);
    for (kind, sample) in &*GARMENTS {
        let cloth = solid(&sample.mesh);
        for (other, name) in [(None, "itself"), (Some(&body), "the mannequin")] {
            let found = intersections(&cloth, other, 3).expect("finite coordinates");
            assert_eq!(found.count, 0, "{kind:?} and {name}: {:?}", found.pairs);
        }
    }
}

#[test]
fn bones_leave_through_the_openings() {
    // Each bone as a triangle without area; those that end in hands, feet and head go on.
    let j = &MANNEQUIN.skeleton.joints;
    let mut bones = TriangleMesh { positions: j.to_vec(), triangles: BONES.map(|[a, b]| [a, b, b]).to_vec() };
    for [_, middle, end] in ARMS.into_iter().chain(LEGS).chain([[ROOT, WAIST, NECK]]) {
        bones.positions.push(j[end] + 0.1 * (j[end] - j[middle]).normalize());
        let beyond = bones.positions.len() as u32 - 1;
        bones.triangles.push([end as u32, beyond, beyond]);
    }
    for (kind, sample) in &*GARMENTS {
        let found = intersections(&solid(&sample.mesh), Some(&bones), 3).expect("finite coordinates");
        assert_eq!(found.count, 0, "{kind:?}: {:?}", found.pairs);
    }
}

#[test]
fn a_gap_between_cloth_and_skin() {
    let body = Triangles::new(&MANNEQUIN.mesh, |_| true);
    let points = |mesh: &Mesh| {
        let middles = (0..mesh.triangles.len() as u32).map(|t| mesh.corners(t).iter().sum::<DVec3>() / 3.0);
        mesh.positions.iter().copied().chain(middles).collect::<Vec<_>>()
    };
    for (kind, sample) in &*GARMENTS {
        let cloth = Triangles::new(&sample.mesh, |_| true);
        let nearest = |triangles: &Triangles, points: Vec<DVec3>| {
            points.into_iter().map(|p| triangles.distance(p, 0.02)).fold(f64::INFINITY, f64::min)
        };
        let gap = nearest(&body, points(&sample.mesh)).min(nearest(&cloth, points(&MANNEQUIN.mesh)));
        assert!(gap > 0.003, "{kind:?}: {gap} metres");
        if *kind == Garment::Jumpsuit {
            let gaps = sample.mesh.positions.iter().map(|&p| body.distance(p, 0.05));
            let mean = gaps.sum::<f64>() / sample.mesh.positions.len() as f64;
            assert!((0.006..0.012).contains(&mean), "the jumpsuit is tight: {mean} metres");
        }
        for (v, &p) in sample.mesh.positions.iter().enumerate().step_by(7) {
            let own = cloth.distance_unless(p, 0.02, |triangle| triangle.contains(&(v as u32)));
            assert!(own > 0.0025, "{kind:?}: vertex {v} comes as close to the cloth as {own} metres");
        }
    }
}

/// The lowest vertex of the vest's neckline in front.
fn v_point(sample: &Sample) -> DVec3 {
    let neck = opening(sample, sample.skeleton.joints[NECK] - DVec3::Z * 0.08);
    positions(sample, &neck).filter(|p| p.y < 0.0).min_by(|a, b| a.z.total_cmp(&b.z)).expect("a neckline in front")
}

#[test]
fn the_vests_neckline_is_a_v() {
    let vest = made(Garment::Vest);
    let point = v_point(vest);
    assert!(point.x.abs() < 1e-4, "the V's point is off the middle: {point}");
    let neck = opening(vest, vest.skeleton.joints[NECK] - DVec3::Z * 0.08);
    let mut angle = 0.0;
    for side in [1.0, -1.0] {
        let along: Vec<DVec3> =
            positions(vest, &neck).filter(|p| p.y < -0.03 && side * p.x > 0.0 && p.z > point.z).collect();
        assert!(along.len() >= 8, "{} vertices on one side of the V", along.len());
        let top = along.iter().max_by(|a, b| a.z.total_cmp(&b.z)).expect("a side of the V");
        assert!(top.z - point.z > 0.10, "the V is {} metres high", top.z - point.z);
        // Straight as seen from the front.
        let direction = DVec2::new(top.x - point.x, top.z - point.z).normalize();
        for p in &along {
            let off = direction.perp_dot(DVec2::new(p.x - point.x, p.z - point.z)).abs();
            assert!(off < 0.0015, "{p} is {off} metres off the V's side");
        }
        angle += direction.angle_to(DVec2::Y).abs().to_degrees();
    }
    assert!((40.0..56.0).contains(&angle), "the V opens by {angle} degrees");
}

#[test]
fn the_skirt_hangs_around_both_legs_in_growing_folds() {
    let skirt = made(Garment::Skirt);
    let j = &skirt.skeleton.joints;
    let hem = opening(skirt, DVec3::Z * j[LEGS[0][1]].z);
    let waist = opening(skirt, j[WAIST]);
    for joint in LEGS.map(|[_, knee, _]| j[knee]) {
        assert!((turns(positions(skirt, &hem), joint).abs() - 1.0).abs() < 1e-6, "the hem goes around both knees");
        assert!(positions(skirt, &hem).all(|p| p.z < joint.z), "the hem is below the knees");
    }
    // Crests of the folds: local maxima of the distance from the axis, compared with a smooth curve.
    let crests = |curve: &[u32]| {
        let radii: Vec<f64> = positions(skirt, curve).map(|p| p.x.hypot(p.y)).collect();
        let n = radii.len();
        let depth = |i: usize| radii[i] - (radii[(i + n - 5) % n] + radii[(i + 5) % n]) / 2.0;
        (0..n).map(depth).fold(0.0, f64::max)
    };
    assert!(crests(&hem) > 0.03 && crests(&waist) < 0.01, "{} and {} metres", crests(&hem), crests(&waist));
    let length = |curve: &[u32]| -> f64 {
        let points: Vec<DVec3> = positions(skirt, curve).collect();
        (0..points.len()).map(|i| points[i].distance(points[(i + 1) % points.len()])).sum()
    };
    assert!(length(&hem) > 2.2 * length(&waist), "flared");
}

#[test]
fn what_hangs_freely_is_listed() {
    for (kind, sample) in &*GARMENTS {
        let free: HashSet<u32> = sample.no_fit.iter().copied().collect();
        assert_eq!(free.len(), sample.no_fit.len());
        assert!(free.iter().all(|&v| (v as usize) < sample.mesh.positions.len()));
        let has = |curve: &[u32]| curve.iter().filter(|v| free.contains(v)).count();
        let j = &sample.skeleton.joints;
        match kind {
            Garment::Skirt => {
                let hem = opening(sample, DVec3::Z * j[LEGS[0][1]].z);
                assert_eq!(has(&hem), hem.len());
                assert_eq!(has(&opening(sample, j[WAIST])), 0);
            }
            Garment::Coat => {
                let collar = opening(sample, j[NECK]);
                assert_eq!(has(&collar), collar.len());
                assert!(free.len() * 10 < sample.mesh.positions.len());
                assert!(free.iter().all(|&v| sample.mesh.positions[v as usize].z > j[ARMS[0][0]].z));
            }
            _ => assert!(free.is_empty(), "{kind:?}"),
        }
    }
}

#[test]
fn texture_coordinates_show_the_outside() {
    for (kind, sample) in &*GARMENTS {
        let (mesh, texture) = (&sample.mesh, &sample.texture);
        assert_eq!(texture.triangles.len(), mesh.triangles.len());
        assert!(texture.coordinates.iter().flatten().all(|c| (0.0..=1.0).contains(c)));
        let folded = texture.triangles.iter().filter(|t| {
            let [a, b, c] = t.map(|i| texture.coordinates[i as usize]);
            (b[0] - a[0]) * (c[1] - a[1]) <= (b[1] - a[1]) * (c[0] - a[0])
        });
        assert!(folded.count() * 100 < mesh.triangles.len(), "{kind:?}: the atlas is mirrored or folded");
    }
}
