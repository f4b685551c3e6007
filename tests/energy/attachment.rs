//! Attachment of loose pieces: which pieces are loose, and which triangles hold them.

use std::f64::consts::TAU;

use bespoke::energy::attachment::{Attachment, SizeHold};
use bespoke::energy::{Configuration, Energy};
use bespoke::input::diagnostic::{DiagnosticKind, Element, Severity, Subject};
use bespoke::stage::setup::loose_pieces::LoosePieces;
use glam::DVec3;

use crate::harness::{check_gradient, check_hessian, check_semidefinite, dense};
use crate::patch::{rotation, shaken, similar, triangles};
use testing::Random;

/// A garment in the making: pieces that share no vertex.
#[derive(Clone, Default)]
struct Garment {
    rest: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
}

impl Garment {
    fn add(&mut self, positions: impl IntoIterator<Item = DVec3>, triangles: &[[u32; 3]]) {
        let first = self.rest.len() as u32;
        self.rest.extend(positions);
        self.triangles.extend(triangles.iter().map(|t| t.map(|v| v + first)));
    }

    /// A tube along z around the axis through `centre`, open at both ends.
    fn tube(&mut self, centre: DVec3, radius: f64, height: f64, columns: u32, rows: u32) {
        let at = |k: u32| {
            let angle = TAU * f64::from(k % columns) / f64::from(columns);
            let z = height * (f64::from(k / columns) / f64::from(rows - 1) - 0.5);
            centre + DVec3::new(radius * angle.cos(), radius * angle.sin(), z)
        };
        self.add((0..columns * rows).map(at), &triangles(columns, rows, true));
    }

    /// A flat disc in the plane of `u` and `v`: a fan around its middle.
    fn disc(&mut self, centre: DVec3, u: DVec3, v: DVec3) {
        let rim = (0..6).map(|k| f64::from(k) * TAU / 6.0).map(|a| centre + u * a.cos() + v * a.sin());
        let fan: Vec<[u32; 3]> = (0..6).map(|k| [0, 1 + k, 1 + (k + 1) % 6]).collect();
        self.add([centre].into_iter().chain(rim), &fan);
    }

    fn loose(&self) -> LoosePieces {
        LoosePieces::find(&self.rest, &self.triangles)
    }

    fn term(&self) -> Attachment {
        Attachment::new(&self.rest, &self.loose().holds, &[])
    }

    fn value(&self, x: &[DVec3]) -> f64 {
        value(&self.term(), x)
    }
}

fn value(term: &Attachment, x: &[DVec3]) -> f64 {
    term.value(Configuration { x, t: 0.0 }, 0..term.len())
}

/// A small tube with a button that stands off it, and where the button begins.
fn button() -> (Garment, usize) {
    let mut garment = Garment::default();
    garment.tube(DVec3::ZERO, 1.0, 2.0, 6, 3);
    let first = garment.rest.len();
    garment.disc(DVec3::new(0.9, 0.2, 0.1), 0.1 * DVec3::Y, 0.1 * DVec3::Z);
    (garment, first)
}

#[test]
fn buttons_are_held_to_the_coat() {
    let mut garment = Garment::default();
    garment.tube(DVec3::ZERO, 1.0, 3.0, 24, 16);
    let coat = garment.triangles.len() as u32;
    for k in 0..10 {
        garment.disc(DVec3::new(1.02, 0.0, 0.25 * f64::from(k) - 1.2), 0.03 * DVec3::Y, 0.03 * DVec3::Z);
    }
    let (loose, term) = (garment.loose(), garment.term());
    assert_eq!((loose.pieces.len(), term.len()), (10, 70));
    for (k, piece) in (0u32..).zip(&loose.pieces) {
        assert_eq!(piece.triangle, coat + 6 * k);
        assert_eq!(piece.vertices, (24 * 16 + 7 * k..24 * 16 + 7 * k + 7).collect::<Vec<_>>());
        assert!(piece.host < coat);
        assert!((0.019..0.03).contains(&piece.distance), "{}", piece.distance);
    }
    let diagnostics = loose.diagnostics(|t| t + 1000);
    assert_eq!(diagnostics.len(), 10);
    assert_eq!((diagnostics[1].kind(), diagnostics[1].severity()), (DiagnosticKind::LoosePiece, Severity::Note));
    let host = loose.pieces[1].host;
    assert_eq!(diagnostics[1].elements(), [coat + 1006, host + 1000].map(|t| Element::triangle(Subject::Garment, t)));
    assert!(diagnostics[1].to_string().contains(&format!("7 vertices with triangle {}", coat + 1006)));
    assert_eq!(diagnostics[1].distance(), loose.pieces[1].distance);
}

#[test]
fn a_belt_is_held_and_so_is_its_buckle_to_the_belt() {
    let mut garment = Garment::default();
    garment.tube(DVec3::ZERO, 1.0, 6.0, 24, 20);
    let suit = garment.triangles.len() as u32;
    garment.tube(DVec3::ZERO, 1.06, 0.3, 24, 3);
    let belt = garment.triangles.len() as u32;
    garment.disc(DVec3::new(1.09, 0.0, 0.0), 0.1 * DVec3::Y, 0.1 * DVec3::Z);
    let hosts: Vec<u32> = garment.loose().pieces.iter().map(|p| p.host).collect();
    assert_eq!(hosts.len(), 2);
    assert!(hosts[0] < suit && (suit..belt).contains(&hosts[1]), "{hosts:?}");
}

#[test]
fn what_is_large_or_far_is_not_loose() {
    // A pair of socks; a scarf over a jumpsuit; a trouser leg with a sock that begins inside it; a button in space.
    let mut socks = Garment::default();
    socks.tube(DVec3::ZERO, 0.1, 0.6, 8, 6);
    socks.tube(DVec3::new(0.22, 0.0, 0.0), 0.1, 0.6, 8, 6);
    let mut scarf = Garment::default();
    scarf.tube(DVec3::ZERO, 0.5, 3.0, 12, 8);
    scarf.tube(DVec3::new(0.0, 0.0, 2.0), 0.3, 0.2, 12, 2);
    let mut leg = Garment::default();
    leg.tube(DVec3::ZERO, 0.2, 2.0, 12, 10);
    leg.tube(DVec3::new(0.0, 0.0, -1.1), 0.12, 0.4, 12, 6);
    let mut space = Garment::default();
    space.tube(DVec3::ZERO, 1.0, 3.0, 24, 16);
    space.disc(DVec3::new(1.2, 0.0, 0.0), 0.03 * DVec3::Y, 0.03 * DVec3::Z);
    let mut one = Garment::default();
    one.tube(DVec3::ZERO, 1.0, 3.0, 24, 16);
    for (name, garment) in [("socks", socks), ("scarf", scarf), ("leg", leg), ("space", space), ("one", one)] {
        assert_eq!((garment.loose().pieces.len(), garment.term().len()), (0, 0), "{name}");
    }
    assert!(LoosePieces::find(&[], &[]).holds.is_empty());
}

/// The rule does not depend on place, size and direction.
#[test]
fn the_rule_follows_similarities() {
    let mut random = Random::new(5);
    let (garment, _) = button();
    for scale in [1e-3, 1.0, 1e3] {
        let moved = similar(&garment.rest, scale, &mut random);
        let loose = LoosePieces::find(&moved, &garment.triangles);
        assert_eq!((loose.pieces.len(), Attachment::new(&moved, &loose.holds, &[]).len()), (1, 7));
    }
}

#[test]
fn the_hanging_end_of_a_belt_is_free() {
    let mut garment = Garment::default();
    garment.tube(DVec3::ZERO, 1.0, 6.0, 24, 20);
    garment.tube(DVec3::ZERO, 1.06, 0.3, 24, 3);
    let end = garment.rest.len() as u32;
    // A triangle that stands off by one vertex.
    garment.rest.push(DVec3::new(1.8, 0.0, 0.0));
    garment.triangles.push([end - 1, end - 2, end]);
    let term = garment.term();
    assert_eq!((garment.loose().pieces[0].vertices.len(), term.len()), (73, 72));
    term.stencils(&mut |v| assert!(!v.contains(&end)));
}

#[test]
fn a_piece_without_area_is_held() {
    let (mut garment, first) = button();
    garment.rest.truncate(first);
    garment.triangles.retain(|t| t.iter().all(|&v| (v as usize) < first));
    garment.add([DVec3::new(0.9, 0.2, 0.1), DVec3::new(0.9, 0.3, 0.1)], &[[0, 1, 1]]);
    assert_eq!(garment.term().len(), 2);
    let mut moved = garment.rest.clone();
    moved[first] += 0.1 * DVec3::Y;
    assert!(garment.value(&moved) > 0.0);
}

#[test]
fn similarities_cost_nothing_and_drifting_growing_turning_do() {
    let mut random = Random::new(1);
    let (garment, first) = button();
    for scale in [0.2, 1.0, 4.0] {
        assert!(garment.value(&similar(&garment.rest, scale, &mut random)) < 1e-20);
    }
    let middle = garment.rest[first];
    let turn = rotation(&mut random);
    let changes: [&dyn Fn(DVec3) -> DVec3; 4] =
        [&|p| p + 0.05 * DVec3::Y, &|p| p - 0.05 * DVec3::X, &|p| middle + 1.5 * (p - middle), &|p| {
            middle + turn * (p - middle)
        }];
    for change in changes {
        let mut x = garment.rest.clone();
        x[first..].iter_mut().for_each(|p| *p = change(*p));
        let cost = garment.value(&x);
        assert!(cost > 1e-6, "{cost:e}");
        // An imperfect fit grows with the square of scale.
        let larger: Vec<DVec3> = x.iter().map(|p| 1.5 * p).collect();
        assert!((garment.value(&larger) / cost - 2.25).abs() < 1e-9);
    }
}

/// On a flat host of unit cells, a button that slides by d costs `area d^2 / (4/3 + height^2)`, as in the formula.
#[test]
fn the_cost_of_sliding_is_a_strain_times_an_area() {
    let mut garment = Garment::default();
    let cell = |k: u32| DVec3::new(f64::from(k % 9), f64::from(k / 9), 0.0);
    garment.add((0..81).map(cell), &triangles(9, 9, false));
    garment.disc(DVec3::new(4.4, 4.3, 0.2), 0.3 * DVec3::X, 0.3 * DVec3::Y);
    let mut x = garment.rest.clone();
    x[81..].iter_mut().for_each(|p| *p += 0.1 * DVec3::X);
    let area = 6.0 * 0.5 * 0.09 * (TAU / 6.0).sin();
    let wanted = area * 0.01 / (4.0 / 3.0 + 0.04);
    assert!((garment.value(&x) / wanted - 1.0).abs() < 1e-9);
}

#[test]
fn derivatives_are_exact() {
    let mut random = Random::new(2);
    let (garment, _) = button();
    let term = garment.term();
    assert_eq!(term.len(), 7);
    for _ in 0..3 {
        let x = shaken(&garment.rest, 0.1, &mut random);
        check_gradient(&term, &x, 0.0, 1e-4, 1e-7);
        check_semidefinite(&term, &shaken(&garment.rest, 0.5, &mut random), 0.0, &mut || random.signed());
    }
    check_hessian(&term, &garment.rest, 0.0, 1e-4, 1e-7);
    check_hessian(&term, &similar(&garment.rest, 2.0, &mut random), 0.0, 1e-4, 1e-7);
}

/// Three vertices that keep their distances: motions cost nothing, and growing costs a strain times the area.
#[test]
fn a_size_is_kept_and_its_derivatives_are_exact() {
    let mut random = Random::new(6);
    let rest: Vec<DVec3> = (0..3).map(|_| random.vector()).collect();
    let sizes = [[0, 1], [1, 2], [2, 0]].map(|vertices| SizeHold { vertices, area: 0.3 });
    let term = Attachment::new(&rest, &[], &sizes);
    assert_eq!(term.len(), 3);
    assert!(value(&term, &similar(&rest, 1.0, &mut random)) < 1e-20);
    let grown: Vec<DVec3> = rest.iter().map(|p| 2.0 * p).collect();
    assert!((value(&term, &grown) / (3.0 * 0.3 * 2.25) - 1.0).abs() < 1e-9);
    for _ in 0..3 {
        let x = shaken(&rest, 0.1, &mut random);
        check_gradient(&term, &x, 0.0, 1e-4, 1e-7);
        check_semidefinite(&term, &x, 0.0, &mut || random.signed());
    }
    check_hessian(&term, &rest, 0.0, 1e-4, 1e-7);
    // Two vertices at one place have no distance to keep.
    assert!(Attachment::new(&[DVec3::X; 2], &[], &sizes[..1]).is_empty());
}

#[test]
fn a_collapsed_host_gives_finite_derivatives() {
    let (garment, first) = button();
    let term = garment.term();
    for height in [0.0, 1e-300, 1e-31, 1e-20] {
        let mut x = garment.rest.clone();
        x[..first].iter_mut().for_each(|p| *p = DVec3::new(p.x, height * p.y, 0.0));
        let d = dense(&term, &x, 0.0);
        assert!(value(&term, &x).is_finite());
        assert!(d.gradient.iter().chain(d.hessian.iter().flatten()).all(|v| v.is_finite()));
    }
}

/// Thousands of sequins: each is found, in bounded time, and the list of diagnostics stays short.
#[test]
fn sequins_are_held() {
    let mut garment = Garment::default();
    garment.tube(DVec3::ZERO, 1.0, 4.0, 40, 40);
    for k in 0..3000 {
        let (angle, z) = (f64::from(k) * 2.4, f64::from(k) / 800.0 - 1.9);
        let (out, along) = (DVec3::new(angle.cos(), angle.sin(), 0.0), DVec3::new(-angle.sin(), angle.cos(), 0.0));
        garment.disc(1.01 * out + DVec3::Z * z, 0.01 * along, 0.01 * DVec3::Z);
    }
    let loose = garment.loose();
    assert_eq!(loose.pieces.len(), 3000);
    assert!(loose.pieces.iter().all(|p| p.host < 2 * 40 * 39));
    let diagnostics = loose.diagnostics(|t| t);
    assert_eq!(diagnostics.len(), 1001);
    assert_eq!(diagnostics[1000].to_string(), "2000 more loose pieces of the garment are held");
}

#[test]
fn ranges_add_up_and_stencils_cover_the_hessian() {
    let (garment, first) = button();
    let term = garment.term();
    let x = shaken(&garment.rest, 0.2, &mut Random::new(8));
    let at = Configuration { x: &x, t: 0.0 };
    let parts = term.value(at, 0..3) + term.value(at, 3..term.len());
    assert!((parts - value(&term, &x)).abs() < 1e-12);
    let mut held = Vec::new();
    term.stencils(&mut |v| {
        assert!(v[..3].iter().all(|&w| (w as usize) < first));
        held.push(v[3] as usize);
    });
    assert_eq!(held, (first..first + 7).collect::<Vec<_>>());
}
