//! What belongs together stays together: seams, plackets, a shirt over trousers.

use std::f64::consts::TAU;
use std::ops::Range;

use bespoke::control::Stage;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::diagnostic::DiagnosticKind;
use bespoke::options::Options;
use bespoke::session::{Precision, Session};
use glam::DVec3;

use crate::small::{session, tube};

const ROWS: u32 = 16;
const COLUMNS: u32 = 20;

/// A sheet around the arm with its two borders along it, from one angle to another: `radius` of a share of the way around.
fn wrapped(low: f64, high: f64, angles: Range<f64>, radius: impl Fn(f64) -> f64) -> TriangleMesh {
    let mut mesh = TriangleMesh::default();
    for (r, c) in (0..=ROWS).flat_map(|r| (0..=COLUMNS).map(move |c| (r, c))) {
        let z = low + (high - low) * f64::from(r) / f64::from(ROWS);
        let share = f64::from(c) / f64::from(COLUMNS);
        let angle = angles.start + (angles.end - angles.start) * share;
        let centre = DVec3::new(0.2 * z.max(0.0), 0.0, z);
        mesh.positions.push(centre + radius(share) * DVec3::new(angle.cos(), angle.sin(), 0.0));
    }
    for (r, c) in (0..ROWS).flat_map(|r| (0..COLUMNS).map(move |c| (r, c))) {
        let [a, b, c, d] = [(r, c), (r, c + 1), (r + 1, c + 1), (r + 1, c)].map(|(r, c)| r * (COLUMNS + 1) + c);
        mesh.triangles.extend([[a, b, c], [a, c, d]]);
    }
    mesh
}

fn dressed(session: &mut Session, garment: &TriangleMesh) -> Vec<DVec3> {
    session.set_garment(garment.clone(), Precision::F64).unwrap();
    assert_eq!(session.run().unwrap(), Stage::Done);
    assert!(session.verify(Precision::F64).unwrap().is_clean());
    session.garment_positions().unwrap()
}

fn has(session: &Session, kind: DiagnosticKind) -> bool {
    session.diagnostics().iter().any(|diagnostic| diagnostic.kind() == kind)
}

/// For each row the first and the last column.
fn borders(x: &[DVec3]) -> impl Iterator<Item = [DVec3; 2]> {
    x.chunks(COLUMNS as usize + 1).map(|row| [row[0], row[COLUMNS as usize]])
}

#[test]
fn a_seam_that_is_open_by_a_hair_comes_out_closed() {
    let garment = wrapped(-0.6, 0.7, 0.0..TAU - 6e-5, |_| 0.3);
    let widest = |x: &[DVec3]| borders(x).map(|[a, b]| a.distance(b)).fold(0.0, f64::max);
    assert!((1e-5..2e-5).contains(&widest(&garment.positions)));
    let mut closed = session(1.0, DVec3::ZERO);
    assert_eq!(widest(&dressed(&mut closed, &garment)), 0.0);
    assert!(has(&closed, DiagnosticKind::WeldedNear));
    // As modelled, only what is in one place is one.
    let mut open = session(1.0, DVec3::ZERO);
    open.set_options(Options { weld_distance: 0.0, ..Options::default() }).unwrap();
    assert!(widest(&dressed(&mut open, &garment)) > 0.0);
    assert!(!has(&open, DiagnosticKind::WeldedNear));
}

/// A placket of two fronts that overlap by 0.1 and are 0.012 apart.
#[test]
fn a_placket_keeps_its_overlap_and_its_gap() {
    let garment = wrapped(-0.6, 0.7, 0.0..TAU + 0.33, |share| 0.3 + 0.012 * share);
    let mut session = session(1.0, DVec3::ZERO);
    let x = dressed(&mut session, &garment);
    assert!(has(&session, DiagnosticKind::KeptTogether));
    // Between the borders of each row: along the arm's surface, and away from it.
    let relation = |[a, b]: [DVec3; 2]| {
        let out = DVec3::new(a.x + b.x - 0.4 * a.z.max(0.0), a.y + b.y, 0.0).normalize();
        ((b - a).reject_from_normalized(out).length(), (b - a).dot(out))
    };
    for (row, (was, is)) in borders(&garment.positions).zip(borders(&x)).enumerate() {
        let ((overlap, gap), (overlap_now, gap_now)) = (relation(was), relation(is));
        println!("{row}: {overlap:.4} {gap:.4} -> {overlap_now:.4} {gap_now:.4}");
        assert!((0.5..2.0).contains(&(overlap_now / overlap)), "{row}: {overlap} {overlap_now}");
        assert!((0.5..2.0).contains(&(gap_now / gap)), "{row}: {gap} {gap_now}");
    }
}

/// A shirt over trousers, 0.015 outside them and 0.1 beyond their waist.
#[test]
fn a_shirt_over_trousers_keeps_its_overlap() {
    let mut garment = tube(-0.6, 0.05, |_, _| 0.3, 10, 20, false);
    let trousers = garment.positions.len();
    let shirt = tube(-0.05, 0.7, |_, _| 0.315, 12, 20, false);
    garment.positions.extend(&shirt.positions);
    garment.triangles.extend(shirt.triangles.iter().map(|t| t.map(|v| v + trousers as u32)));
    let mut session = session(1.0, DVec3::ZERO);
    let x = dressed(&mut session, &garment);
    assert!(has(&session, DiagnosticKind::KeptTogether));
    let (waist, hem) = (trousers - 20..trousers, trousers..trousers + 20);
    for (w, h) in waist.zip(hem) {
        let (was, is) = (garment.positions[w].z - garment.positions[h].z, x[w].z - x[h].z);
        println!("{was:.4} -> {is:.4}");
        assert!((0.5..2.0).contains(&(is / was)), "{was} {is}");
    }
}
