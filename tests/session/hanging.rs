//! Pieces that hang on others keep their size, as those do that hang on nothing.

use bespoke::control::Stage;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::session::{Precision, Session};
use glam::DVec3;

use crate::small::{session, sleeve};

/// A closed box around `centre`, each side of 4 x 4 cells, as one piece.
fn pouch(centre: DVec3, half: DVec3) -> TriangleMesh {
    const N: i32 = 4;
    let mut points: Vec<[i32; 3]> = Vec::new();
    let mut triangles = Vec::new();
    for side in 0..6 {
        let (axis, sign) = (side / 2, if side % 2 == 0 { -1 } else { 1 });
        let mut at = |i: i32, j: i32| {
            let mut p = [0; 3];
            p[axis] = sign * N;
            p[(axis + 1) % 3] = 2 * i - N;
            p[(axis + 2) % 3] = 2 * j - N;
            let known = points.iter().position(|q| *q == p);
            known.unwrap_or_else(|| {
                points.push(p);
                points.len() - 1
            }) as u32
        };
        for (i, j) in (0..N).flat_map(|i| (0..N).map(move |j| (i, j))) {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            triangles.extend(if sign > 0 { [[a, b, c], [a, c, d]] } else { [[a, c, b], [a, d, c]] });
        }
    }
    let place = |p: [i32; 3]| centre + half * DVec3::from(p.map(f64::from)) / f64::from(N);
    TriangleMesh { positions: points.into_iter().map(place).collect(), triangles }
}

/// Adds `more` to `garment`; the range of its vertices.
fn add(garment: &mut TriangleMesh, more: TriangleMesh) -> std::ops::Range<usize> {
    let first = garment.positions.len();
    garment.positions.extend(more.positions);
    garment.triangles.extend(more.triangles.iter().map(|t| t.map(|v| v + first as u32)));
    first..garment.positions.len()
}

/// The root mean square distance from the mean.
fn spread(points: &[DVec3]) -> f64 {
    let mean = points.iter().sum::<DVec3>() / points.len() as f64;
    (points.iter().map(|p| p.distance_squared(mean)).sum::<f64>() / points.len() as f64).sqrt()
}

fn dressed(session: &mut Session, garment: &TriangleMesh) -> Vec<DVec3> {
    session.set_garment(garment.clone(), Precision::F64).unwrap();
    assert_eq!(session.run().unwrap(), Stage::Done);
    assert!(session.verify(Precision::F64).unwrap().is_clean());
    session.garment_positions().unwrap()
}

#[test]
fn a_pouch_on_a_sleeve_keeps_its_size() {
    let mut garment = sleeve();
    let rest = garment.positions.clone();
    // Its back is 0.02 off the sleeve, its front 0.22, much farther than a loose piece may be.
    let range = add(&mut garment, pouch(DVec3::new(0.0, 0.45, 0.1), DVec3::new(0.12, 0.1, 0.12)));
    let mut session = session(1.0, DVec3::ZERO);
    let x = dressed(&mut session, &garment);
    let grown = spread(&x[..rest.len()]) / spread(&rest);
    let scale = spread(&x[range.clone()]) / spread(&garment.positions[range.clone()]);
    assert!((0.8..1.25).contains(&(scale / grown)), "{scale} {grown}");
    // It still hangs where it hung.
    let middle = x[range].iter().sum::<DVec3>() / 98.0;
    assert!(middle.y > 0.4 && middle.x.abs() < 0.1 && (middle.z - 0.1).abs() < 0.1, "{middle}");
}

/// A chain of two: a pocket on a pouch on a sleeve. The pocket is far from the sleeve.
#[test]
fn what_hangs_on_what_hangs_keeps_its_size() {
    let mut garment = sleeve();
    let first = add(&mut garment, pouch(DVec3::new(0.0, 0.45, 0.1), DVec3::new(0.12, 0.1, 0.12)));
    let second = add(&mut garment, pouch(DVec3::new(0.0, 0.62, 0.1), DVec3::new(0.06, 0.06, 0.06)));
    let mut session = session(1.0, DVec3::ZERO);
    let x = dressed(&mut session, &garment);
    let scale = |range: std::ops::Range<usize>| spread(&x[range.clone()]) / spread(&garment.positions[range]);
    let (first, second) = (scale(first), scale(second));
    assert!((0.8..1.25).contains(&(first / second)) && (0.8..1.6).contains(&first), "{first} {second}");
}

/// A badge that floats far beside the sleeve: nothing is near, and it keeps the bodies' scale, which is 1.
#[test]
fn what_hangs_on_nothing_keeps_the_bodies_scale() {
    let mut garment = sleeve();
    let range = add(&mut garment, pouch(DVec3::new(0.0, 0.9, 0.1), DVec3::new(0.12, 0.03, 0.12)));
    let mut session = session(1.0, DVec3::ZERO);
    let x = dressed(&mut session, &garment);
    let scale = spread(&x[range.clone()]) / spread(&garment.positions[range]);
    assert!((0.8..1.25).contains(&scale), "{scale}");
}
