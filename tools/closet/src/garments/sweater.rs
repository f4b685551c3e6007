//! A loose sweater with tight bands at hem and cuffs, gathers above them, and wrinkles at elbows and armpits.

use std::f64::consts::TAU;

use glam::DVec3;

use super::super::implicit::smooth_min;
use super::super::skeleton::{ARMS, LEGS, NECK, WAIST};
use super::super::surface::{Design, Function, Seam};
use super::folds::{Fold, Folds, step};
use super::limb::Limb;
use super::panels::{LIMB, TRUNK, panels, trunk_angle};
use super::upper::{Upper, cuffs, round_neck, sleeves, trunk};
use super::{Mannequin, Piece};

/// The cloth keeps this distance (metres) from the skin.
const CLEARANCE: f64 = 0.010;

/// Edge length in metres, as a share of it on folds and bands.
const EDGE: f64 = 0.0170;
const FINE: f64 = 0.68;

/// Height of the bands at hem, cuffs and neck in metres.
const HEM_BAND: f64 = 0.058;
const NECK_BAND: f64 = 0.024;

/// Designs the sweater.
pub fn sweater(mannequin: &Mannequin) -> Piece {
    let (skeleton, body) = (&mannequin.skeleton, &mannequin.body);
    let j = &skeleton.joints;
    let arms = ARMS.map(|joints| Limb::new(skeleton, joints));
    let (waist, shoulder, neck) = (j[WAIST].z, j[ARMS[0][0]].z, j[NECK]);
    let hem = j[LEGS[0][0]].z - 0.010;
    let up = |t: f64| waist + (shoulder - waist) * t;
    let trunk = trunk(&[
        [hem - 0.06, 0.192, 0.126, 0.136],
        [hem + 0.040, 0.192, 0.126, 0.136],
        [hem + 0.066, 0.207, 0.142, 0.148],
        [hem + 0.100, 0.206, 0.144, 0.146],
        [waist, 0.180, 0.136, 0.124],
        [up(0.40), 0.176, 0.140, 0.126],
        [up(0.70), 0.182, 0.148, 0.134],
        [up(0.90), 0.176, 0.130, 0.132],
        [shoulder + 0.30 * (neck.z - shoulder), 0.128, 0.080, 0.104],
        [neck.z - 0.03, 0.078, 0.064, 0.072],
    ]);
    let sleeves = sleeves(
        skeleton,
        &[[0.0, 0.056, 0.068], [0.4, 0.060, 0.066], [1.0, 0.056, 0.060]],
        &[[0.0, 0.056, 0.060], [0.45, 0.053, 0.056], [0.70, 0.049, 0.052], [0.79, 0.037, 0.041], [1.0, 0.036, 0.040]],
    );
    let upper = Upper::new(skeleton, trunk, 0.042, sleeves);

    let sleeve_folds = [0, 1].map(|side| sleeve_folds(arms[0].middle(), arms[0].length(), side));
    let trunk_folds = trunk_folds(waist, shoulder, hem);
    let neckline = round_neck(skeleton, [0.096, 0.080], -0.010);
    let side = |p: DVec3| usize::from(p.x < 0.0);
    let chart = |p: DVec3| {
        let place = arms[side(p)].place(p);
        [place.angle * LIMB, place.along]
    };
    let raised = |p: DVec3| {
        let share = upper.on_sleeve(p);
        let mut height = 0.0;
        if share > 0.0 {
            let [around, along] = chart(p);
            let before_cuff = arms[0].length() - 0.075 - along;
            height += share
                * (sleeve_folds[side(p)].height([around, along]) + gathers(around / LIMB * 9.0, before_cuff, 0.0022));
        }
        if share < 1.0 {
            let angle = trunk_angle(p);
            height += (1.0 - share)
                * (trunk_folds.height([angle * TRUNK, p.z]) + gathers(angle * 19.0, p.z - hem - HEM_BAND, 0.0032));
        }
        height + 0.004 * step(neckline(p) + NECK_BAND, 0.006)
    };
    let solid = |p: DVec3| smooth_min(upper.cloth.value(p) - raised(p), body.value(p) - CLEARANCE, 0.015);
    let edge_length = |p: DVec3| {
        let share = upper.on_sleeve(p);
        let place = arms[side(p)].place(p);
        let band = |distance: f64, reach: f64| FINE + (1.0 - FINE) * step(distance - reach, 0.02);
        let arm = sleeve_folds[side(p)].fineness(chart(p), FINE).min(band(arms[0].length() - place.along, 0.10));
        let trunk = trunk_folds.fineness([trunk_angle(p) * TRUNK, p.z], FINE).min(band(p.z - hem, 0.10));
        EDGE * (trunk + (arm - trunk) * share).min(band(-neckline(p), 0.04))
    };
    let mut cuts: Vec<Function> = cuffs(&arms, 0.945);
    cuts.push(Box::new(move |p| hem - p.z));
    cuts.push(Box::new(neckline));
    // Where the bands begin.
    let seams = [
        Seam { function: Box::new(|p| neckline(p) + NECK_BAND), within: Box::new(|_| true) },
        Seam { function: Box::new(|p| p.z - hem - 0.044), within: Box::new(|p| upper.apart(p) < 0.0) },
    ];
    let bounds = upper.cloth.bounds();
    let mesh =
        Design { solid: Box::new(solid), cuts, edge_length: Box::new(edge_length), bounds, cell: 0.0150, rounds: 4 }
            .sewn(&seams, &[]);
    let texture = panels(&mesh, hem, &arms, &|p| upper.sleeve(p));
    Piece { mesh, texture, no_fit: Vec::new() }
}

/// Small pleats that start at a band and fade out over the cloth above it, some sooner than others.
fn gathers(phase: f64, above: f64, height: f64) -> f64 {
    if above < -0.01 {
        return 0.0;
    }
    let reach = 0.060 * (1.0 + 0.35 * (0.37 * phase).sin());
    height * phase.cos() * step(above - 0.004, 0.012) * (-(above / reach).powi(2)).exp()
}

/// Cloth that gathers inside the elbow, stacks above the cuff and pulls from the armpit.
fn sleeve_folds(elbow: f64, length: f64, side: usize) -> Folds {
    // The right sleeve was pushed up a little more.
    let shift = 0.008 * side as f64;
    let fold = |from: (f64, f64), to: (f64, f64), bow: f64, width: f64, height: f64| Fold {
        from: [from.0.to_radians() * LIMB, from.1 - shift],
        to: [to.0.to_radians() * LIMB, to.1 - shift],
        bow,
        width,
        height,
    };
    let folds = vec![
        fold((-110.0, elbow - 0.085), (60.0, elbow - 0.060), -0.016, 0.018, 0.008),
        fold((-100.0, elbow - 0.035), (95.0, elbow - 0.020), -0.008, 0.016, 0.011),
        fold((-115.0, elbow + 0.012), (85.0, elbow + 0.022), 0.006, 0.016, 0.011),
        fold((-95.0, elbow + 0.066), (75.0, elbow + 0.060), 0.016, 0.017, 0.009),
        fold((75.0, elbow + 0.105), (230.0, elbow + 0.085), 0.014, 0.018, 0.007),
        fold((-140.0, length - 0.155), (40.0, length - 0.130), 0.012, 0.017, 0.008),
        fold((20.0, length - 0.115), (200.0, length - 0.135), 0.010, 0.017, 0.008),
        fold((-170.0, 0.150), (-40.0, 0.095), -0.014, 0.019, 0.007),
        fold((-160.0, 0.205), (-10.0, 0.165), -0.014, 0.019, 0.006),
        fold((170.0, 0.155), (60.0, 0.110), 0.012, 0.020, 0.006),
    ];
    Folds { period: TAU * LIMB, folds }
}

/// Folds from the armpits over chest and back, and swags above the hem.
fn trunk_folds(waist: f64, shoulder: f64, hem: f64) -> Folds {
    let fold = |from: (f64, f64), to: (f64, f64), bow: f64, width: f64, height: f64| Fold {
        from: [from.0.to_radians() * TRUNK, from.1],
        to: [to.0.to_radians() * TRUNK, to.1],
        bow,
        width,
        height,
    };
    let mut folds = Vec::new();
    for side in [1.0, -1.0] {
        let both = |from: (f64, f64), to: (f64, f64), bow: f64, width: f64, height: f64| {
            fold((side * from.0, from.1), (side * to.0, to.1), side * bow, width, height)
        };
        folds.extend([
            both((76.0, shoulder - 0.100), (28.0, shoulder - 0.160), 0.012, 0.019, 0.012),
            both((80.0, shoulder - 0.140), (36.0, shoulder - 0.235), 0.014, 0.019, 0.010),
            both((104.0, shoulder - 0.105), (150.0, shoulder - 0.165), -0.012, 0.019, 0.012),
            both((100.0, shoulder - 0.145), (142.0, shoulder - 0.245), -0.014, 0.019, 0.010),
            both((48.0, waist - 0.010), (120.0, waist + 0.030 * side), -0.022, 0.019, 0.012),
            both((62.0, waist + 0.065), (132.0, waist + 0.050), -0.020, 0.019, 0.009),
            both((20.0, hem + 0.105), (88.0, hem + 0.125 + 0.010 * side), -0.016, 0.019, 0.010),
            both((105.0, hem + 0.120), (165.0, hem + 0.100), -0.016, 0.019, 0.010),
        ]);
    }
    Folds { period: TAU * TRUNK, folds }
}
