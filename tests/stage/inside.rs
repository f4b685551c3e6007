//! Shoes and gloves around the ends of limbs: where a bone passes through a wall, the limb stays inside.

use std::f64::consts::TAU;

use bespoke::error::ErrorKind;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::skeleton::Skeleton;
use bespoke::session::{Precision, Session};
use bespoke::stage::setup::normalization::Normalization;
use glam::{DVec2, DVec3};

use crate::repair::{Case, chain, tube};

/// Sides of a hose.
const SIDES: u32 = 16;

/// A hose in the plane of y and z through `x`, with radii along its middle, closed at its last ring.
fn hose(x: f64, middle: &[([f64; 2], f64)]) -> TriangleMesh {
    let mut mesh = TriangleMesh::default();
    let at = |k: usize| DVec2::from(middle[k].0);
    let last = middle.len() - 1;
    for (k, &(_, radius)) in middle.iter().enumerate() {
        let along = (at((k + 1).min(last)) - at(k.saturating_sub(1))).normalize();
        for s in 0..SIDES {
            let (sine, cosine) = (TAU * f64::from(s) / f64::from(SIDES)).sin_cos();
            let p = at(k) + radius * sine * along.perp();
            mesh.positions.push(DVec3::new(x + radius * cosine, p.x, p.y));
        }
    }
    for ring in 0..last as u32 {
        for s in 0..SIDES {
            let at = |r: u32, s: u32| r * SIDES + s % SIDES;
            mesh.triangles.push([at(ring, s), at(ring, s + 1), at(ring + 1, s)]);
            mesh.triangles.push([at(ring, s + 1), at(ring + 1, s + 1), at(ring + 1, s)]);
        }
    }
    close(&mut mesh, last as u32);
    mesh
}

/// Closes a ring at one of the ends by a fan, facing as the wall does.
fn close(mesh: &mut TriangleMesh, ring: u32) {
    let own = || (0..SIDES).map(|s| ring * SIDES + s);
    let middle = own().map(|v| mesh.positions[v as usize]).sum::<DVec3>() / f64::from(SIDES);
    let tip = mesh.positions.len() as u32;
    mesh.positions.push(middle);
    for s in 0..SIDES {
        let [a, b] = [s, (s + 1) % SIDES].map(|s| ring * SIDES + s);
        mesh.triangles.push(if ring == 0 { [b, a, tip] } else { [a, b, tip] });
    }
}

fn join(parts: &[TriangleMesh]) -> TriangleMesh {
    let mut whole = TriangleMesh::default();
    for part in parts {
        let first = whole.positions.len() as u32;
        whole.positions.extend(&part.positions);
        whole.triangles.extend(part.triangles.iter().map(|t| t.map(|v| v + first)));
    }
    whole
}

/// How often a surface winds around a point, by the solid angles of its triangles.
fn winding(mesh: &TriangleMesh, p: DVec3) -> f64 {
    let angle = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| mesh.positions[v as usize] - p);
        let (la, lb, lc) = (a.length(), b.length(), c.length());
        let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
        2.0 * a.dot(b.cross(c)).atan2(below)
    };
    mesh.triangles.iter().map(angle).sum::<f64>() / (2.0 * TAU)
}

/// The share of `points` that lie in one of `covers`, each closed at its opening, the first ring.
fn share_inside(covers: &[TriangleMesh], points: impl Iterator<Item = DVec3>) -> f64 {
    let mut closed = covers.to_vec();
    for cover in &mut closed {
        close(cover, 0);
    }
    let inside: Vec<bool> = points.map(|p| closed.iter().any(|cover| winding(cover, p).abs() > 0.5)).collect();
    assert!(!inside.is_empty());
    inside.iter().filter(|&&inside| inside).count() as f64 / inside.len() as f64
}

/// The covers, two of one kind, that come out of the whole session.
fn fitted(case: &Case) -> [TriangleMesh; 2] {
    let mut session = Session::new();
    session.set_garment(case.garment.clone(), Precision::F64).unwrap();
    session.set_source_skeleton(case.source.clone()).unwrap();
    session.set_target_avatar(case.avatar.clone()).unwrap();
    session.set_target_skeleton(case.target.clone()).unwrap();
    session.run().unwrap();
    let positions = session.garment_positions().unwrap();
    let count = positions.len() / 2;
    let triangles = case.garment.triangles[..case.garment.triangles.len() / 2].to_vec();
    [&positions[..count], &positions[count..]]
        .map(|own| TriangleMesh { positions: own.to_vec(), triangles: triangles.clone() })
}

/// Two legs with ankles, and feet as bones where there are `toes`.
fn legs(x: f64, ankle: [f64; 2], toes: Option<[f64; 2]>) -> Skeleton {
    let mut legs = chain(&[[0.0, 0.0, 1.0], [0.0, 0.0, 0.0]]);
    for x in [-x, x] {
        let mut from = 1;
        for [y, z] in std::iter::once(ankle).chain(toes) {
            legs.joints.push(DVec3::new(x, y, z));
            legs.bones.push([from, legs.joints.len() as u32 - 1]);
            from = legs.joints.len() as u32 - 1;
        }
    }
    legs
}

/// Two limbs along `middle`, of one radius, and a body above them.
fn lower_body(x: f64, middle: &[[f64; 2]], radius: f64) -> TriangleMesh {
    let limb = |x: f64| {
        let mut fine: Vec<([f64; 2], f64)> = Vec::new();
        for pair in middle.windows(2) {
            let [a, b] = [pair[0], pair[1]].map(DVec2::from);
            fine.extend((0..8).map(|k| (a.lerp(b, f64::from(k) / 8.0).into(), radius)));
        }
        fine.push((middle[middle.len() - 1], radius));
        let mut limb = hose(x, &fine);
        close(&mut limb, 0);
        limb
    };
    let trunk = tube([0.15, 1.05], |z| DVec3::new(0.0, 0.0, z), |_| 0.2, [10, 14], [true; 2]);
    join(&[limb(-x), limb(x), trunk])
}

/// The share of the start below `level` that lies in one of `covers`, in the normalised space of `case`'s source.
fn start_inside(case: &Case, covers: &[TriangleMesh], level: f64) -> f64 {
    let problem = case.problem(&mut Vec::new()).unwrap();
    let normalization = Normalization::of(&case.source, "").unwrap();
    let normalised = |cover: &TriangleMesh| TriangleMesh {
        positions: normalization.normalise_all(&cover.positions),
        triangles: cover.triangles.clone(),
    };
    let covers: Vec<TriangleMesh> = covers.iter().map(normalised).collect();
    let level = normalization.normalise_all(&[DVec3::new(0.0, 0.0, level)])[0].z;
    share_inside(&covers, problem.projected.start.iter().copied().filter(|p| p.z < level))
}

/// Low boots whose soles the leg's end passes through: around is nearer than to pull the end back, but beside the boot.
#[test]
fn a_leg_through_the_sole_ends_in_the_boot() {
    let boot = |x: f64| hose(x, &[-0.93, -0.95, -0.97, -0.99, -1.01, -1.03].map(|z| ([0.0, z], 0.05)));
    let boots = [boot(-0.12), boot(0.12)];
    let skeleton = legs(0.12, [0.0, -1.0], None);
    let case = Case {
        garment: join(&boots),
        source: skeleton.clone(),
        avatar: lower_body(0.12, &[[0.0, 0.1], [0.0, -0.8], [0.0, -1.085]], 0.04),
        target: skeleton,
    };
    case.is_repaired();
    assert_eq!(start_inside(&case, &boots, -0.94), 1.0);
    let fitted = fitted(&case);
    let feet = case.avatar.positions.iter().copied().filter(|p| p.z < -1.0);
    assert_eq!(share_inside(&fitted, feet), 1.0);
}

/// A foot's bone that leaves the boot through its upper.
#[test]
fn a_foot_bone_through_the_upper_ends_in_the_boot() {
    let middle: Vec<([f64; 2], f64)> = [
        [0.0, -0.7],
        [0.0, -0.78],
        [0.0, -0.86],
        [0.02, -0.92],
        [0.06, -0.95],
        [0.12, -0.95],
        [0.18, -0.95],
        [0.24, -0.95],
    ]
    .map(|p| (p, 0.055))
    .to_vec();
    let boots = [hose(-0.12, &middle), hose(0.12, &middle)];
    let source = legs(0.12, [0.0, -0.9], Some([0.2, -0.84]));
    let target = legs(0.12, [0.0, -0.95], Some([0.2, -0.95]));
    let case = Case {
        garment: join(&boots),
        source,
        avatar: lower_body(0.12, &[[0.0, 0.1], [0.0, -0.9], [0.05, -0.95], [0.22, -0.95]], 0.04),
        target,
    };
    case.is_repaired();
    assert_eq!(start_inside(&case, &boots, -0.72), 1.0);
    let feet = case.avatar.positions.iter().copied().filter(|p| p.z < -0.85);
    assert_eq!(share_inside(&fitted(&case), feet), 1.0);
}

/// Mittens over hands without fingers, whose bones leave through the side.
#[test]
fn a_hand_through_the_side_of_its_mitten_ends_inside() {
    let mitten = |x: f64| hose(x, &[-0.8, -0.85, -0.9, -0.95, -1.0, -1.05].map(|z| ([0.0, z], 0.05)));
    let mittens = [mitten(-0.3), mitten(0.3)];
    let source = legs(0.3, [0.0, -0.88], Some([0.09, -1.0]));
    let target = legs(0.3, [0.0, -0.88], Some([0.0, -1.0]));
    let case = Case {
        garment: join(&mittens),
        source,
        avatar: lower_body(0.3, &[[0.0, 0.1], [0.0, -0.8], [0.0, -1.03]], 0.04),
        target,
    };
    case.is_repaired();
    assert_eq!(start_inside(&case, &mittens, -0.82), 1.0);
    let hands = case.avatar.positions.iter().copied().filter(|p| p.z < -0.95);
    assert_eq!(share_inside(&fitted(&case), hands), 1.0);
}

/// Closed balls at the ends of legs, which are to stay closed: no way leads in, so they are refused by piece and bone, though
/// the sack that comes with them is around what it should be.
#[test]
fn a_bone_that_cannot_stay_inside_is_refused() {
    let ball = |x: f64| {
        let mut ball = hose(x, &[-0.93, -0.96, -0.99, -1.02].map(|z| ([0.0, z], 0.07)));
        close(&mut ball, 0);
        ball
    };
    let sack = tube([0.2, 1.15], |z| DVec3::new(0.0, 0.0, z), |_| 0.3, [60, 24], [false, true]);
    let skeleton = legs(0.12, [0.0, -1.0], None);
    let case = Case {
        garment: join(&[ball(-0.12), ball(0.12), sack]),
        source: skeleton.clone(),
        avatar: lower_body(0.12, &[[0.0, 0.1], [0.0, -0.8], [0.0, -1.085]], 0.04),
        target: skeleton,
    };
    let options = bespoke::options::Options { keep_caps: true, ..Default::default() };
    let error = case.problem_with(&options, &mut Vec::new()).err().expect("refused");
    assert_eq!(error.kind, ErrorKind::NotEnclosed);
    assert!(
        error.message.contains("the piece of triangle 0 is around the source skeleton's bone between joints 1 and 2"),
        "{}",
        error.message
    );
}
