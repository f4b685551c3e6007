//! A vest with a V-neck: no sleeves, trimmed edges, to the hips.

use std::f64::consts::TAU;

use glam::DVec3;

use super::super::implicit::smooth_min;
use super::super::skeleton::{ARMS, LEGS, NECK, ROOT, WAIST};
use super::super::surface::{Design, Function, Seam};
use super::folds::{Fold, Folds, step};
use super::panels::{TRUNK, panels, trunk_angle};
use super::upper::{Upper, trunk};
use super::{Mannequin, Piece};

/// The cloth keeps this distance (metres) from the skin.
const CLEARANCE: f64 = 0.009;

/// Edge length in metres, and as a share of it along the trimmed edges.
const EDGE: f64 = 0.0170;
const FINE: f64 = 0.62;

/// Half the opening angle of the V in degrees, seen from the front.
const HALF_ANGLE: f64 = 24.0;

/// Width of the trim along the edges in metres.
const TRIM: f64 = 0.024;

/// Designs the vest.
pub fn vest(mannequin: &Mannequin) -> Piece {
    with_edges(mannequin, 1.0)
}

/// The same with its edge lengths times `coarseness`.
pub fn with_edges(mannequin: &Mannequin, coarseness: f64) -> Piece {
    let (skeleton, body) = (&mannequin.skeleton, &mannequin.body);
    let j = &skeleton.joints;
    let (waist, shoulder, neck) = (j[WAIST].z, j[ARMS[0][0]].z, j[NECK]);
    let hem = j[LEGS[0][0]].z - 0.030;
    let up = |t: f64| waist + (shoulder - waist) * t;
    let trunk = trunk(&[
        [hem - 0.06, 0.204, 0.128, 0.142],
        [hem + 0.040, 0.202, 0.128, 0.142],
        [j[ROOT].z + 0.02, 0.182, 0.126, 0.120],
        [waist, 0.152, 0.120, 0.102],
        [up(0.30), 0.152, 0.124, 0.104],
        [up(0.65), 0.170, 0.138, 0.122],
        [up(0.88), 0.166, 0.116, 0.124],
        [shoulder + 0.30 * (neck.z - shoulder), 0.126, 0.076, 0.100],
        [neck.z - 0.03, 0.072, 0.058, 0.066],
    ]);
    let upper = Upper::new(skeleton, trunk, 0.034, Vec::new());

    let point = up(0.62);
    let neckline = move |p: DVec3| {
        // The V in front, as wide as the neck at the shoulders; behind it a shallow curve.
        let (sine, cosine) = HALF_ANGLE.to_radians().sin_cos();
        let front = (p.z - point) * sine - p.x.abs() * cosine;
        let back = p.z - (neck.z - 0.050 + 2.2 * p.x * p.x);
        let share = step(p.y - 0.020, 0.035);
        front + (back - front) * share
    };
    let armhole = move |p: DVec3| {
        // Rounded towards front and back.
        let low = (up(0.78) + 3.0 * p.y * p.y - p.z).max(0.0);
        let inset = 0.142 + 0.010 * (p.y / 0.1).powi(2);
        // Below the armhole everything up to the arm stays.
        p.x.abs() - (inset + 9.0 * low * low).min(0.182 + 0.6 * low)
    };
    let folds = folds(waist, shoulder);
    let raised = |p: DVec3| {
        let trim = step(neckline(p) + TRIM, 0.005) + step(armhole(p) + TRIM, 0.005) + step(hem + 0.045 - p.z, 0.005);
        folds.height([trunk_angle(p) * TRUNK, p.z]) + 0.006 * trim.min(1.0)
    };
    let solid = |p: DVec3| smooth_min(upper.cloth.value(p) - raised(p), body.value(p) - CLEARANCE, 0.015);
    let edge_length = |p: DVec3| {
        let band = |distance: f64, reach: f64| FINE + (1.0 - FINE) * step(distance - reach, 0.02);
        let trim = band(-neckline(p), 0.035).min(band(-armhole(p), 0.035)).min(band(p.z - hem, 0.055));
        coarseness * EDGE * trim.min(folds.fineness([trunk_angle(p) * TRUNK, p.z], 0.75))
    };
    let cuts: Vec<Function> = vec![
        Box::new(neckline),
        Box::new(move |p| if p.x > 0.0 { armhole(p) } else { -1.0 }),
        Box::new(move |p| if p.x < 0.0 { armhole(p) } else { -1.0 }),
        Box::new(move |p| hem - p.z),
    ];
    // Where the trims begin.
    let seams = [
        Seam { function: Box::new(|p| neckline(p) + TRIM), within: Box::new(|_| true) },
        Seam { function: Box::new(|p| armhole(p) + TRIM), within: Box::new(|_| true) },
        Seam { function: Box::new(|p| hem + 0.045 - p.z), within: Box::new(|_| true) },
    ];
    let bounds = body.bounds();
    let mesh =
        Design { solid: Box::new(solid), cuts, edge_length: Box::new(edge_length), bounds, cell: 0.0135, rounds: 4 }
            .sewn(&seams, &[DVec3::new(0.0, -0.15, point)]);
    let texture = panels(&mesh, hem, &[], &|_| None);
    Piece { mesh, texture, no_fit: Vec::new() }
}

/// Folds that pull from the sides to the waist.
fn folds(waist: f64, shoulder: f64) -> Folds {
    let mut folds = Vec::new();
    for side in [1.0, -1.0] {
        let both = |from: (f64, f64), to: (f64, f64), bow: f64, height: f64| Fold {
            from: [side * from.0.to_radians() * TRUNK, from.1],
            to: [side * to.0.to_radians() * TRUNK, to.1],
            bow: side * bow,
            width: 0.018,
            height,
        };
        folds.extend([
            both((82.0, shoulder - 0.190), (40.0, shoulder - 0.255), 0.010, 0.005),
            both((55.0, waist + 0.020), (125.0, waist + 0.035), -0.016, 0.006),
            both((48.0, waist - 0.030), (118.0, waist - 0.015), -0.018, 0.006),
            both((100.0, shoulder - 0.190), (140.0, shoulder - 0.265), -0.010, 0.005),
        ]);
    }
    Folds { period: TAU * TRUNK, folds }
}
