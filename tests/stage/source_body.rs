//! The body that a garment was designed on: signs against the solid angle, sizes of limbs against bodies of known thickness.

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::skeleton::Skeleton;
use bespoke::stage::setup::source_body::SourceBody;
use glam::DVec3;
use testing::Random;

/// Of the bodies.
const SIDES: u32 = 24;
const RINGS: u32 = 44;
const END: f64 = 1.1;

/// Two bones in line along z, from -1 to 0 and on to 1.
fn skeleton() -> Skeleton {
    Skeleton { joints: vec![-DVec3::Z, DVec3::ZERO, DVec3::Z], bones: vec![[0, 1], [1, 2]] }
}

/// A closed tube around the skeleton with this radius at each height, from -1.1 to 1.1.
fn body(radius: impl Fn(f64) -> f64) -> TriangleMesh {
    let mut mesh = TriangleMesh::default();
    for ring in 0..=RINGS {
        let z = END * (2.0 * f64::from(ring) / f64::from(RINGS) - 1.0);
        mesh.positions.extend((0..SIDES).map(|side| {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(side) / f64::from(SIDES)).sin_cos();
            DVec3::new(radius(z) * cos, radius(z) * sin, z)
        }));
    }
    let tips = [mesh.positions.len() as u32, mesh.positions.len() as u32 + 1];
    mesh.positions.extend([-END, END].map(|z| DVec3::new(0.0, 0.0, z)));
    for side in 0..SIDES {
        let next = (side + 1) % SIDES;
        let at = |ring: u32| [ring * SIDES + side, ring * SIDES + next];
        for ring in 0..RINGS {
            let ([a, b], [c, d]) = (at(ring), at(ring + 1));
            mesh.triangles.extend([[a, b, d], [a, d, c]]);
        }
        let ([a, b], [c, d]) = (at(0), at(RINGS));
        mesh.triangles.extend([[tips[0], b, a], [tips[1], c, d]]);
    }
    mesh
}

/// The winding number of a mesh around `p` (Van Oosterom and Strackee 1983).
fn winding(mesh: &TriangleMesh, p: DVec3) -> f64 {
    let angle = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| mesh.positions[v as usize] - p);
        let [la, lb, lc] = [a, b, c].map(DVec3::length);
        let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
        2.0 * a.dot(b.cross(c)).atan2(below)
    };
    mesh.triangles.iter().map(angle).sum::<f64>() / (4.0 * std::f64::consts::PI)
}

fn turned(mesh: &TriangleMesh) -> TriangleMesh {
    let triangles = mesh.triangles.iter().map(|&[a, b, c]| [a, c, b]).collect();
    TriangleMesh { positions: mesh.positions.clone(), triangles }
}

#[test]
fn the_sign_agrees_with_the_winding_number() {
    let bone = skeleton();
    let wavy = body(|z| 0.2 + 0.1 * (9.0 * z).sin());
    // Turned inside out it is the same body.
    for mesh in [wavy.clone(), turned(&wavy)] {
        let designed_on = SourceBody::new(mesh.clone(), &bone, &bone, &mesh);
        let mut random = Random::new(31);
        let mut inside = 0;
        for _ in 0..2000 {
            let p = DVec3::new(0.35, 0.35, 1.2) * random.vector();
            let (signed, winding) = (designed_on.signed_distance(p), winding(&mesh, p).abs());
            assert!((winding - winding.round()).abs() < 1e-9);
            assert_eq!(signed < 0.0, winding > 0.5, "{p}: {signed}, winding number {winding}");
            assert_eq!(signed.abs(), designed_on.surface.distance(p));
            inside += usize::from(winding > 0.5);
        }
        assert!((200..1800).contains(&inside), "{inside}");
    }
}

/// A body without its ends, as where parts under clothes are cut away.
#[test]
fn a_body_with_holes_has_an_inside() {
    let bone = skeleton();
    let mut mesh = body(|_| 0.2);
    mesh.triangles.retain(|t| t.iter().all(|&v| v < SIDES * (RINGS + 1)));
    let designed_on = SourceBody::new(mesh.clone(), &bone, &bone, &mesh);
    let mut random = Random::new(32);
    for _ in 0..500 {
        let direction = (DVec3::new(1.0, 1.0, 0.0) * random.vector()).normalize();
        let z = 0.9 * random.vector().x;
        let at = |radius: f64| designed_on.signed_distance(radius * direction + z * DVec3::Z);
        assert!(at(0.15) < 0.0 && at(0.25) > 0.0, "{direction} {z}: {} {}", at(0.15), at(0.25));
    }
}

/// Thickness 0.2 becomes 0.4 around the first bone and 0.1 around the second: so do clearances, and between them they change
/// slowly.
#[test]
fn the_clearance_is_in_proportion_to_the_limb() {
    let bone = skeleton();
    let (mannequin, target) = (body(|_| 0.2), body(|z| if z < 0.0 { 0.4 } else { 0.1 }));
    let designed_on = SourceBody::new(mannequin.clone(), &bone, &bone, &target);
    let clearance = |p: DVec3| designed_on.clearance(p, designed_on.signed_distance(p));
    let at = |z: f64| clearance(DVec3::new(0.23, 0.0, z)) / 0.03;
    for k in 0..20 {
        let z = 0.3 + 0.035 * f64::from(k);
        assert!((at(-z) - 2.0).abs() < 0.02 && (at(z) - 0.5).abs() < 0.02, "{z}: {} {}", at(-z), at(z));
    }
    let mut last = at(-0.5);
    for k in -499..=500 {
        let now = at(1e-3 * f64::from(k));
        assert!((now - last).abs() < 0.02 && now < last + 1e-9, "from {last} to {now} at {k}");
        last = now;
    }
    // What lay inside is not pushed off the surface.
    assert_eq!(clearance(DVec3::new(0.15, 0.0, 0.3)), 0.0);
}

/// Where bones lie outside of the bodies, the others say how thick they are; where all do, nothing is scaled.
#[test]
fn bones_beside_the_body_change_nothing() {
    let mut bones = skeleton();
    bones.joints.extend([DVec3::new(2.0, 0.0, 0.0), DVec3::new(3.0, 0.0, 0.0)]);
    bones.bones.push([3, 4]);
    let (mannequin, target) = (body(|_| 0.2), body(|_| 0.3));
    let ratio = |bones: &Skeleton, p: DVec3| {
        let designed_on = SourceBody::new(mannequin.clone(), bones, bones, &target);
        designed_on.clearance(p, designed_on.signed_distance(p)) / designed_on.signed_distance(p)
    };
    assert!((ratio(&bones, DVec3::new(2.5, 0.1, 0.0)) - 1.5).abs() < 1e-6);
    let lone = Skeleton { joints: bones.joints[3..].to_vec(), bones: vec![[0, 1]] };
    assert_eq!(ratio(&lone, DVec3::new(0.25, 0.0, 0.0)), 1.0);
}
