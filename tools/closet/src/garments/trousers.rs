//! Long trousers with a waistband and creases at hips, knees and ankles.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::super::implicit::{Field, Owner, Shape, smooth_min};
use super::super::loft::{Loft, Section};
use super::super::skeleton::{LEGS, ROOT, WAIST};
use super::super::surface::{Design, Function, Seam};
use super::folds::{Fold, Folds, ridge, step};
use super::limb::Limb;
use super::panels::{LIMB, TRUNK, panels, trunk_angle};
use super::{Mannequin, Piece};

/// The cloth keeps this distance (metres) from the skin.
const CLEARANCE: f64 = 0.009;

/// Edge length in metres, as a share of it on folds and seams.
const EDGE: f64 = 0.0190;
const FINE: f64 = 0.62;

/// Designs the trousers.
pub fn trousers(mannequin: &Mannequin) -> Piece {
    let (skeleton, body) = (&mannequin.skeleton, &mannequin.body);
    let j = &skeleton.joints;
    let legs = LEGS.map(|joints| Limb::new(skeleton, joints));
    let (hip, knee) = (j[LEGS[0][0]].z, legs[0].middle());
    let (top, crotch) = (j[WAIST].z - 0.030, hip - 0.115);
    let side = |p: DVec3| usize::from(p.x < 0.0);

    let mut cloth = Field::default();
    let own = Owner::Joint(ROOT);
    let axis = |z: f64| DVec3::Z * z;
    let (low, high) = (hip - 0.10, top + 0.06);
    let seat = [
        (low, 0.150, 0.080, 0.115),
        (hip - 0.03, 0.188, 0.110, 0.128),
        (hip + 0.03, 0.186, 0.118, 0.126),
        (j[ROOT].z + 0.01, 0.172, 0.118, 0.108),
        (top - 0.035, 0.140, 0.104, 0.086),
        (top, 0.128, 0.098, 0.080),
        (high, 0.122, 0.098, 0.080),
    ]
    .map(|(z, width, front, back)| Section { t: (z - low) / (high - low), centre: [0.0; 2], width, front, back });
    cloth.add(Shape::Loft(Loft::new(axis(low), axis(high), DVec3::Y, &seat).capped(0.3)), 0.02, own);
    for [hip, knee, ankle] in LEGS.map(|joints| joints.map(|joint| j[joint])) {
        let side = hip.x.signum();
        let upper = [
            Section::ellipse(0.0, 0.100, 0.112).moved(side * -0.004, 0.004),
            Section::ellipse(0.35, 0.100, 0.108),
            Section::ellipse(1.0, 0.087, 0.092),
        ];
        let lower = [
            Section::ellipse(0.0, 0.087, 0.092),
            Section::ellipse(0.4, 0.083, 0.090).moved(0.0, 0.006),
            Section::ellipse(1.0, 0.074, 0.082).moved(0.0, 0.004),
        ];
        cloth.add(Shape::Loft(Loft::new(hip, knee, DVec3::Y, &upper)), 0.05, own);
        let end = ankle + 0.15 * (ankle - knee);
        cloth.add(Shape::Loft(Loft::new(knee, end, DVec3::Y, &lower)), 0.012, own);
    }
    let cloth = cloth.finish();

    let leg_folds = leg_folds(knee, legs[0].length());
    let seat_folds = seat_folds(hip, crotch);
    let band = top - 0.042;
    let chart = |p: DVec3| {
        let place = legs[side(p)].place(p);
        [place.angle * LIMB, place.along]
    };
    let fly = |p: DVec3| p.y < 0.0 && p.z > crotch + 0.03 && p.z < band;
    let raised = |p: DVec3| {
        // The seat passes into the legs over the height of the crotch.
        let seat = step(p.z - crotch - 0.03, 0.05);
        let mut height = (1.0 - seat) * leg_folds.height(chart(p));
        height += seat * seat_folds.height([trunk_angle(p).abs() * TRUNK, p.z]);
        if fly(p) {
            height -= 0.004 * ridge(p.x, 0.012);
        }
        let along = legs[side(p)].place(p).along;
        height + if p.z < crotch { 0.003 * step(along - 0.905 * legs[0].length(), 0.006) } else { 0.0 }
    };
    let solid = |p: DVec3| {
        let loose = smooth_min(cloth.value(p) - raised(p), body.value(p) - CLEARANCE, 0.012);
        loose - 0.006 * step(p.z - band, 0.004)
    };
    let edge_length = |p: DVec3| {
        let seat = step(p.z - crotch - 0.03, 0.05);
        let legs = leg_folds.fineness(chart(p), FINE);
        let hips = seat_folds.fineness([trunk_angle(p).abs() * TRUNK, p.z], FINE);
        let mut share = legs + (hips - legs) * seat;
        share = share.min(FINE + (1.0 - FINE) * step((p.z - band).abs() - 0.025, 0.02));
        if fly(p) {
            share = share.min(FINE + (1.0 - FINE) * step(p.x.abs() - 0.025, 0.02));
        }
        EDGE * share
    };
    let mut cuts: Vec<Function> = vec![Box::new(move |p| p.z - top - 0.10 * p.y)];
    for limb in &legs {
        let (centre, axis) = limb.bone(true, 0.955);
        cuts.push(Box::new(move |p| if p.distance(centre) < 0.2 { axis.dot(p - centre) } else { -1.0 }));
    }
    let seams = [
        Seam { function: Box::new(|p| p.z - band), within: Box::new(|_| true) },
        Seam { function: Box::new(|p| p.x), within: Box::new(fly) },
    ];
    let bounds = cloth.bounds();
    let mesh =
        Design { solid: Box::new(solid), cuts, edge_length: Box::new(edge_length), bounds, cell: 0.0135, rounds: 4 }
            .sewn(&seams, &[]);
    let texture = panels(&mesh, crotch, &legs, &|p| (p.z < crotch).then_some(side(p)));
    Piece { mesh, texture, no_fit: Vec::new() }
}

/// Cloth that gathers behind the knee, bends over it in front, and stands on the ankle.
fn leg_folds(knee: f64, length: f64) -> Folds {
    // Degrees around the leg (0: in front, 90: outside) and metres along it.
    let fold = |from: (f64, f64), to: (f64, f64), bow: f64, width: f64, height: f64| Fold {
        from: [from.0.to_radians() * LIMB, from.1],
        to: [to.0.to_radians() * LIMB, to.1],
        bow,
        width,
        height,
    };
    let folds = vec![
        fold((70.0, knee - 0.070), (250.0, knee - 0.045), -0.014, 0.018, 0.009),
        fold((95.0, knee - 0.020), (285.0, knee - 0.005), 0.004, 0.017, 0.011),
        fold((75.0, knee + 0.020), (260.0, knee + 0.040), 0.014, 0.018, 0.010),
        fold((60.0, knee + 0.085), (215.0, knee + 0.075), 0.018, 0.020, 0.006),
        fold((-75.0, knee - 0.055), (60.0, knee - 0.080), 0.012, 0.020, 0.006),
        fold((-60.0, knee + 0.065), (75.0, knee + 0.080), -0.012, 0.020, 0.006),
        fold((-110.0, length - 0.130), (70.0, length - 0.105), 0.014, 0.017, 0.007),
        fold((10.0, length - 0.085), (200.0, length - 0.100), 0.010, 0.017, 0.008),
        fold((160.0, length - 0.155), (300.0, length - 0.140), -0.010, 0.018, 0.006),
        fold((-100.0, length - 0.065), (20.0, length - 0.072), 0.006, 0.015, 0.006),
    ];
    Folds { period: TAU * LIMB, folds }
}

/// Whiskers from the crotch to the hips in front and below the seat; both sides are alike.
fn seat_folds(hip: f64, crotch: f64) -> Folds {
    let fold = |from: (f64, f64), to: (f64, f64), bow: f64, height: f64| Fold {
        from: [from.0.to_radians() * TRUNK, from.1],
        to: [to.0.to_radians() * TRUNK, to.1],
        bow,
        width: 0.016,
        height,
    };
    let folds = vec![
        fold((6.0, crotch + 0.030), (62.0, hip + 0.020), -0.010, 0.007),
        fold((6.0, crotch + 0.065), (52.0, hip + 0.055), -0.008, 0.005),
        fold((172.0, crotch + 0.020), (118.0, crotch + 0.050), -0.012, 0.007),
        fold((172.0, crotch - 0.015), (115.0, crotch + 0.005), -0.012, 0.006),
    ];
    Folds { period: 2.0 * PI * TRUNK, folds }
}
