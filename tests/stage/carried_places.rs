//! Where carried pieces go: to their clearance, on whatever side of the body their vertices are, and hats with a filling in their
//! shape.

use bespoke::control::Cancel;
use bespoke::geometry::alignment::Similarity;
use bespoke::geometry::closest_point::ClosestPoint;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::skeleton::Skeleton;
use bespoke::sdf::{Field, FieldOptions};
use bespoke::stage::setup::bone_map::BoneMap;
use bespoke::stage::setup::carried_pieces::CarriedPiece;
use bespoke::stage::setup::carried_places::CarriedPlaces;
use bespoke::stage::setup::closed_pieces;
use bespoke::stage::setup::loose_pieces::LoosePieces;
use bespoke::stage::setup::source_body::SourceBody;
use glam::{DQuat, DVec3};

use crate::repair::{chain, tube};

/// How far the sheet is from the trunk as designed, and the more that is asked for.
const CLEARANCE: f64 = 0.05;
const OFFSET: f64 = 0.04;

fn trunk() -> TriangleMesh {
    tube([-1.1, 1.1], |z| DVec3::new(0.0, 0.0, z), |_| 0.2, [40, 32], [true; 2])
}

fn skeleton() -> Skeleton {
    chain(&[[0.0, 0.0, -1.0], [0.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
}

fn field(body: &TriangleMesh) -> Field {
    Field::build(body, FieldOptions { voxel: 0.02, threads: 1 }, &Cancel::new()).expect("a field")
}

/// A sheet that reaches around the trunk by this angle, in columns of `rows` vertices.
fn sheet(around: f64, columns: u32, rows: u32) -> TriangleMesh {
    let mut mesh = TriangleMesh::default();
    for c in 0..columns {
        let angle = around * (f64::from(c) / f64::from(columns - 1) - 0.5);
        for r in 0..rows {
            let (sin, cos) = angle.sin_cos();
            let radius = 0.2 + CLEARANCE;
            mesh.positions.push(DVec3::new(radius * cos, radius * sin, 0.1 * f64::from(r)));
        }
    }
    for c in 0..columns - 1 {
        for r in 0..rows - 1 {
            let v = c * rows + r;
            mesh.triangles.extend([[v, v + rows, v + 1], [v + 1, v + rows, v + rows + 1]]);
        }
    }
    mesh
}

/// Where the sheet goes on the body that it was designed on.
fn places(sheet: &TriangleMesh) -> Vec<DVec3> {
    let (skeleton, body) = (skeleton(), trunk());
    let source = SourceBody::new(body.clone(), &skeleton, &skeleton, &body);
    let piece = CarriedPiece {
        vertices: (0..sheet.positions.len() as u32).collect(),
        triangle: 0,
        bone: 1,
        distance: CLEARANCE,
        stiff: false,
        closed: false,
    };
    let map = BoneMap::new(&skeleton, &skeleton, None);
    let mut carried = CarriedPlaces::new(sheet, &[piece], &map, Some(&source), 1.0);
    carried.settle(&field(&body), 0.002, OFFSET);
    carried.term().pins().iter().map(|pin| pin.end).collect()
}

/// A coarse sheet has a normal that is the mean of all of it, which points into the body at its sides.
#[test]
fn a_sheet_that_reaches_around_the_body_comes_to_its_clearance() {
    for (around, columns, rows) in [(2.0, 5, 4), (4.0, 4, 2), (5.2, 5, 3), (5.2, 12, 5), (5.6, 40, 10)] {
        let sheet = sheet(around, columns, rows);
        let places = places(&sheet);
        let surface = ClosestPoint::new(&trunk());
        for (before, after) in sheet.positions.iter().zip(&places) {
            let (wanted, is) = (surface.distance(*before) + OFFSET, surface.distance(*after));
            assert!(
                (is - wanted).abs() < 0.2 * wanted,
                "{around} {columns}: {before} goes to {after}: {is} for {wanted}"
            );
            assert!(before.distance(*after) < 4.0 * OFFSET, "{around} {columns}: {before} goes to {after}");
        }
    }
}

/// A round hat on the end of the trunk that is a solid body, its crown filled: without a rim, and with nothing flat that would be the
/// cap of an opening.
fn filled_hat() -> TriangleMesh {
    const SIDES: u32 = 24;
    const RINGS: u32 = 16;
    let mut mesh = TriangleMesh::default();
    for r in 1..=RINGS {
        let (sin, cos) = (f64::from(r) * std::f64::consts::PI / f64::from(RINGS + 1)).sin_cos();
        for s in 0..SIDES {
            let (y, x) = (f64::from(s) * std::f64::consts::TAU / f64::from(SIDES)).sin_cos();
            mesh.positions.push(DVec3::new(0.32 * sin * x, 0.32 * sin * y, 0.95 - 0.35 * cos));
        }
    }
    let bottom = mesh.positions.len() as u32;
    mesh.positions.extend([DVec3::new(0.0, 0.0, 0.6), DVec3::new(0.0, 0.0, 1.3)]);
    let at = |r: u32, s: u32| r * SIDES + s % SIDES;
    for s in 0..SIDES {
        mesh.triangles.push([bottom, at(0, s + 1), at(0, s)]);
        mesh.triangles.push([at(RINGS - 1, s), at(RINGS - 1, s + 1), bottom + 1]);
        for r in 0..RINGS - 1 {
            mesh.triangles
                .extend([[at(r, s), at(r, s + 1), at(r + 1, s)], [at(r, s + 1), at(r + 1, s + 1), at(r + 1, s)]]);
        }
    }
    mesh
}

/// The hat on the way to `target`: its one closed piece, where what has a place goes, and the sets that keep their shape.
fn hat_on(hat: &TriangleMesh, target: &TriangleMesh) -> (CarriedPiece, Vec<(u32, DVec3)>, usize) {
    let (skeleton, body) = (skeleton(), trunk());
    let source = SourceBody::new(body.clone(), &skeleton, &skeleton, target);
    let loose = LoosePieces::find(&hat.positions, &hat.triangles);
    let found = closed_pieces::find(hat, &loose, &[], &skeleton, Some(&source.surface));
    assert_eq!(found.len(), 1, "{found:?}");
    let map = BoneMap::new(&skeleton, &skeleton, Some([&body, target]));
    let mut carried = CarriedPlaces::new(hat, &found, &map, Some(&source), 1.0);
    // What is no filling has a place, and nothing else.
    let fillings: Vec<u32> = carried.fillings().collect();
    let placed: Vec<u32> = carried.term().pins().iter().map(|pin| pin.vertex).collect();
    assert!((0..hat.positions.len() as u32).all(|v| fillings.contains(&v) != placed.contains(&v)));
    carried.settle(&field(target), 0.002, 0.0);
    let ends = carried.term().pins().iter().map(|pin| (pin.vertex, pin.end)).collect();
    (found[0].clone(), ends, carried.stiff().count())
}

#[test]
fn a_hat_with_a_filling_keeps_its_shape_and_stands_level() {
    let hat = filled_hat();
    let is_filling = |p: DVec3| p.truncate().length() < 0.2 - 1e-3 && p.z < 1.1 - 1e-3;
    // A larger head, one with hair on one side, and a smaller one that leans.
    let plain = tube([-1.1, 1.1], |z| DVec3::new(0.0, 0.0, z), |_| 0.26, [40, 32], [true; 2]);
    let hairy = tube([-1.1, 1.15], |z| DVec3::new(0.1 * (z - 0.7).max(0.0), 0.0, z), |_| 0.24, [40, 32], [true; 2]);
    let small = tube([-1.1, 1.05], |z| DVec3::new(0.0, 0.02 * z, z), |_| 0.15, [40, 32], [true; 2]);
    for target in [plain, hairy, small] {
        let (piece, ends, stiff) = hat_on(&hat, &target);
        assert_eq!((piece.bone, piece.closed, piece.vertices.len()), (1, true, hat.positions.len()));
        assert_eq!(stiff, 1);
        let filling = hat.positions.iter().filter(|p| is_filling(**p)).count();
        assert!(filling > 20 && ends.len() == hat.positions.len() - filling, "{} and {filling}", ends.len());
        let rest: Vec<DVec3> = ends.iter().map(|(v, _)| hat.positions[*v as usize]).collect();
        let places: Vec<DVec3> = ends.iter().map(|(_, p)| *p).collect();
        let similarity = Similarity::nearest(&rest, &places, &vec![1.0; rest.len()], None);
        let bent = rest.iter().zip(&places).map(|(&p, q)| similarity.apply(p).distance(*q)).fold(0.0, f64::max);
        let tilt = similarity.rotation.angle_between(DQuat::IDENTITY);
        println!("bent {bent:e} tilt {tilt:e} size {} at {}", similarity.scale, similarity.to);
        assert!(bent < 1e-6 && tilt < 1e-6, "bent {bent}, tilted {tilt}");
        let field = field(&target);
        assert!(places.iter().all(|&p| field.value(p) > 0.0015), "within the head");
        let size = similarity.scale / (target.positions[0].truncate().length() / 0.2);
        assert!((0.8..1.4).contains(&size), "{size} times as large as the head");
        assert!(similarity.to.truncate().length() < 0.08, "{}", similarity.to);
    }
}

/// Where a horn leaves no place for its shape, all of it has a place of its own.
#[test]
fn a_filled_hat_on_a_horn_gives_way() {
    let hat = filled_hat();
    let horned = tube([-1.1, 3.0], |z| DVec3::new(0.0, 0.0, z), |_| 0.22, [60, 32], [true; 2]);
    let (_, ends, stiff) = hat_on(&hat, &horned);
    assert_eq!((ends.len(), stiff), (hat.positions.len(), 0));
}
