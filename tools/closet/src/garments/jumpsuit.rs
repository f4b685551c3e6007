//! A tight jumpsuit from the neck to wrists and ankles, with a zip, a waistband and padded knees and elbows.

use std::f64::consts::PI;

use glam::DVec3;

use super::super::skeleton::{ARMS, LEGS, NECK, WAIST};
use super::super::surface::{Design, Function, Seam};
use super::folds::{Fold, Folds, ridge, step};
use super::limb::{Limb, Place};
use super::panels::{LIMB, panels};
use super::{Mannequin, Piece};

/// The cloth keeps this distance (metres) from the skin.
const CLEARANCE: f64 = 0.0085;

/// Edge length in metres, and where the cloth is padded, stitched or creased.
const EDGE: f64 = 0.0222;
const FINE: f64 = 0.0125;

/// Designs the jumpsuit.
pub fn jumpsuit(mannequin: &Mannequin) -> Piece {
    let (skeleton, body) = (&mannequin.skeleton, &mannequin.body);
    let j = &skeleton.joints;
    let arms = ARMS.map(|joints| Limb::new(skeleton, joints));
    let legs = LEGS.map(|joints| Limb::new(skeleton, joints));
    let (waist, neck) = (j[WAIST], j[NECK]);
    let crotch = j[LEGS[0][0]].z - 0.10;
    let side = |p: DVec3| usize::from(p.x < 0.0);
    // A sleeve begins where the arm leaves the trunk.
    let sleeve = move |p: DVec3, place: &Place| place.along > 0.07 && place.radius < 0.075 && p.z > waist.z - 0.15;

    let elbow = creases(arms[0].middle(), 0.0, LIMB, 0.0045);
    let knee = creases(legs[0].middle(), PI, LIMB, 0.006);
    let belt = |z: f64| step(z - (waist.z - 0.045), 0.006) - step(z - (waist.z - 0.002), 0.006);
    let raised = |p: DVec3| {
        let mut height = 0.0;
        let (arm, leg) = (arms[side(p)].place(p), legs[side(p)].place(p));
        if sleeve(p, &arm) {
            height += pad(arm.along - arms[0].middle(), (arm.angle.abs() - PI) * 0.045, [0.080, 0.045], 0.007);
            height += elbow.height([arm.angle * LIMB, arm.along]);
            height += 0.004 * step(arm.along - 0.86 * arms[0].length(), 0.006);
        } else if p.z < crotch {
            height += pad(leg.along - legs[0].middle(), leg.angle * 0.062, [0.100, 0.060], 0.009);
            height += knee.height([leg.angle * LIMB, leg.along]);
            height += 0.004 * step(leg.along - 0.90 * legs[0].length(), 0.006);
        } else {
            height += 0.007 * belt(p.z);
            if p.y < 0.0 && p.z > waist.z {
                // The placket with the zip in its middle, from the belt to below the collar's rim.
                let shown = step(p.z - waist.z - 0.008, 0.008) * step(neck.z - 0.060 - p.z, 0.015);
                let placket = 0.0045 * (step(p.x + 0.024, 0.006) - step(p.x - 0.024, 0.006));
                height += shown * (placket - 0.006 * ridge(p.x, 0.013));
            }
        }
        height
    };
    let solid = |p: DVec3| body.value(p) - CLEARANCE - raised(p);
    let edge_length = |p: DVec3| {
        let (arm, leg) = (arms[side(p)].place(p), legs[side(p)].place(p));
        let near = |distance: f64, reach: f64| 1.0 - step(distance - reach, 0.025);
        let fine = if sleeve(p, &arm) {
            near((arm.along - arms[0].middle()).abs(), 0.055).max(near(arms[0].length() - arm.along, 0.06))
        } else if p.z < crotch {
            near((leg.along - legs[0].middle()).abs(), 0.07).max(near(legs[0].length() - leg.along, 0.06))
        } else {
            let belt = near((p.z - waist.z + 0.023).abs(), 0.030);
            let zip = if p.y < 0.0 && p.z > waist.z { near(p.x.abs(), 0.020) } else { 0.0 };
            belt.max(zip).max(0.6 * near((p.z - neck.z + 0.03).abs(), 0.05))
        };
        EDGE + (FINE - EDGE) * fine
    };

    let mut cuts: Vec<Function> = Vec::new();
    for (limbs, end) in [(&arms, 0.955), (&legs, 0.945)] {
        for limb in limbs {
            let (centre, axis) = limb.bone(true, end);
            // Beyond the reach the plane would also cut the hip.
            cuts.push(Box::new(move |p| if p.distance(centre) < 0.2 { axis.dot(p - centre) } else { -1.0 }));
        }
    }
    cuts.push(Box::new(move |p| if p.x.abs() < 0.13 { p.z - (neck.z - 0.012 + 0.42 * (p.y - neck.y)) } else { -1.0 }));
    // The zip, and both edges of the belt.
    let seams = [
        Seam { function: Box::new(|p| p.x), within: Box::new(|p| p.y < 0.0 && p.z > waist.z) },
        Seam { function: Box::new(|p| p.z - waist.z + 0.045), within: Box::new(|p| p.x.abs() < 0.25) },
        Seam { function: Box::new(|p| p.z - waist.z + 0.002), within: Box::new(|p| p.x.abs() < 0.25) },
    ];
    let bounds = body.bounds();
    let mesh =
        Design { solid: Box::new(solid), cuts, edge_length: Box::new(edge_length), bounds, cell: 0.0135, rounds: 4 }
            .sewn(&seams, &[]);
    let limbs = [arms, legs].concat();
    let texture = panels(&mesh, crotch, &limbs, &|p| match side(p) {
        side if sleeve(p, &arms[side].place(p)) => Some(side),
        side => (p.z < crotch).then_some(2 + side),
    });
    Piece { mesh, texture, no_fit: Vec::new() }
}

/// Three creases across the inside of a joint that lies `along` a limb.
fn creases(along: f64, angle: f64, radius: f64, height: f64) -> Folds {
    let fold = |shift: f64, half: f64, bow: f64| Fold {
        from: [(angle - half) * radius, along + shift],
        to: [(angle + half) * radius, along + shift],
        bow,
        width: 0.013,
        height,
    };
    let folds = vec![fold(-0.034, 1.2, -0.010), fold(0.0, 1.6, 0.0), fold(0.034, 1.2, 0.010)];
    Folds { period: 2.0 * PI * radius, folds }
}

/// A padded oval around a joint, with grooves across it.
fn pad(along: f64, around: f64, [long, wide]: [f64; 2], height: f64) -> f64 {
    let rim = 1.0 - ((along / long).powi(4) + (around / wide).powi(4)).powf(0.25);
    if rim < -0.2 {
        return 0.0;
    }
    let grooves: f64 = [-0.5, 0.0, 0.5].iter().map(|t| ridge(along - t * long, 0.012)).sum();
    height * step(rim - 0.1, 0.18) * (1.0 - 0.9 * grooves)
}
