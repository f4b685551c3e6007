//! A flared skirt over the knees that hangs in folds from a waistband.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::super::SEED;
use super::super::implicit::Field;
use super::super::mesh::Mesh;
use super::super::random::Random;
use super::super::skeleton::WAIST;
use super::folds::step;
use super::panels::panels;
use super::{Mannequin, Piece};

/// The cloth keeps this distance (metres) from the skin.
const CLEARANCE: f64 = 0.010;

/// Vertices around the waist, and as many at the hem.
const AROUND: usize = 100;

/// Height of the waistband, and of the whole skirt along the cloth, in metres.
const BAND: f64 = 0.042;
const LENGTH: f64 = 0.665;

/// How much wider the skirt gets over its length below the hips.
const FLARE: f64 = 0.24;

/// Number of folds, and how far they stand out at the hem, in metres.
const FOLDS: usize = 11;
const DEPTH: f64 = 0.038;

/// Directions and steps down in which the hanging shape is worked out.
const DIRECTIONS: usize = 180;
const STEP: f64 = 0.004;
const STEPS: usize = 170;

/// Designs the skirt.
pub fn skirt(mannequin: &Mannequin) -> Piece {
    let top = mannequin.skeleton.joints[WAIST].z - 0.004;
    let drape = Drape::new(&mannequin.body, top);
    let mut positions: Vec<DVec3> = Vec::new();
    let mut rows = 0;
    let mut length = 0.0;
    // The last row is the hem: a row that would come close to it is left out.
    loop {
        let last = length > LENGTH - 0.006;
        let row = drape.row(if last { LENGTH } else { length }, 0.5 * (rows % 2) as f64);
        // Rows as far apart as makes equilateral triangles of the edges along them.
        length += 0.75f64.sqrt() * row[0].distance(row[1]);
        positions.extend(row);
        rows += 1;
        if last {
            break;
        }
    }
    let mut triangles = Vec::new();
    for row in 0..rows - 1 {
        for i in 0..AROUND {
            let at = |row: usize, i: usize| (row * AROUND + i % AROUND) as u32;
            let [a, b, c, d] = [at(row, i), at(row, i + 1), at(row + 1, i), at(row + 1, i + 1)];
            // The odd rows are half an edge ahead.
            triangles.extend(if row % 2 == 0 { [[a, c, b], [b, c, d]] } else { [[a, d, b], [a, c, d]] });
        }
    }
    let mesh = Mesh { positions, triangles };
    let hip = top - 0.20;
    let no_fit = (0..mesh.positions.len() as u32).filter(|&v| mesh.positions[v as usize].z < hip).collect();
    let texture = panels(&mesh, top - LENGTH, &[], &|_| None);
    Piece { mesh, texture, no_fit }
}

/// One fold: its crest in radians, the height along the cloth where it begins, and its size beside the others'.
struct Fold {
    angle: f64,
    begin: f64,
    size: f64,
}

/// The hanging cloth: for each direction the radius and the height at each step along the cloth.
struct Drape {
    lines: Vec<Vec<[f64; 2]>>,
    folds: Vec<Fold>,
}

fn direction(angle: f64) -> DVec3 {
    DVec3::new(angle.sin(), -angle.cos(), 0.0)
}

impl Drape {
    fn new(body: &Field, top: f64) -> Self {
        let skin = |angle: f64, z: f64| {
            // From outside, within the reach of the hands, to the first skin.
            let mut radius = 0.36;
            loop {
                let room = body.value(direction(angle) * radius + DVec3::Z * z) - CLEARANCE;
                if room < 1e-4 || radius < 0.05 {
                    return radius;
                }
                // Far from the body the value may be too large.
                radius -= (0.7 * room).min(0.01);
            }
        };
        let rows = STEPS + 1;
        let mut radii = vec![vec![0.0; rows]; DIRECTIONS];
        for (i, line) in radii.iter_mut().enumerate() {
            let angle = i as f64 * TAU / DIRECTIONS as f64;
            for k in 0..rows {
                let depth = k as f64 * STEP;
                // Cloth hangs from the widest place above, and ever farther from it.
                let flare = FLARE * step(depth - 0.10, 0.12);
                let hanging = if k == 0 { 0.0 } else { line[k - 1] + flare * STEP };
                line[k] = hanging.max(skin(angle, top - depth));
            }
        }
        for _ in 0..60 {
            let old = radii.clone();
            for (i, line) in radii.iter_mut().enumerate() {
                let (left, right) = (&old[(i + DIRECTIONS - 1) % DIRECTIONS], &old[(i + 1) % DIRECTIONS]);
                for (k, radius) in line.iter_mut().enumerate() {
                    let (above, below) = (old[i][k.saturating_sub(1)], old[i][(k + 1).min(rows - 1)]);
                    // Never closer to the skin than before.
                    *radius = radius.max(0.25 * (left[k] + right[k] + above + below));
                }
            }
        }
        let lines = radii
            .iter()
            .map(|line| {
                let mut z = top;
                let mut points = vec![[line[0], z]];
                for pair in line.windows(2) {
                    let rise = (pair[1] - pair[0]).clamp(-0.9 * STEP, 0.9 * STEP);
                    z -= (STEP * STEP - rise * rise).sqrt();
                    points.push([pair[1], z]);
                }
                points
            })
            .collect();
        let mut random = Random::new(SEED);
        let spacing = TAU / FOLDS as f64;
        let folds = (0..FOLDS)
            .map(|i| Fold {
                angle: spacing * (i as f64 + 0.11 * random.signed()),
                begin: 0.13 + 0.07 * random.signed(),
                size: 1.0 + 0.22 * random.signed(),
            })
            .collect();
        Self { lines, folds }
    }

    /// How far the folds stand out.
    fn fold(&self, angle: f64, length: f64) -> f64 {
        let angle = angle.rem_euclid(TAU);
        let next = self.folds.iter().position(|fold| fold.angle > angle).unwrap_or(0);
        let before = (next + FOLDS - 1) % FOLDS;
        let crest = |fold: &Fold| {
            let share = ((length - fold.begin) / (LENGTH - fold.begin)).max(0.0);
            DEPTH * fold.size * share.powf(1.15) * step(length - fold.begin, 0.08)
        };
        let (a, b) = (&self.folds[before], &self.folds[next]);
        let width = (b.angle - a.angle).rem_euclid(TAU);
        let t = (angle - a.angle).rem_euclid(TAU) / width;
        // From one crest to the next; the valley between them is a little wider than the crests.
        let (from, to) = (crest(a), crest(b));
        let valley = -0.8 * f64::midpoint(from, to);
        let end = if t < 0.5 { from } else { to };
        let wave = 0.5 + 0.5 * (TAU * t).cos();
        valley + (end - valley) * wave
    }

    /// The point in a direction at a length along the cloth.
    fn point(&self, angle: f64, length: f64) -> DVec3 {
        let turn = angle.rem_euclid(TAU) / TAU * DIRECTIONS as f64;
        let (i, s) = (turn as usize % DIRECTIONS, turn.fract());
        let down = (length / STEP).min(STEPS as f64 - 1e-9);
        let (k, t) = (down as usize, down.fract());
        let along = |line: &[[f64; 2]], n: usize| line[k][n] + (line[k + 1][n] - line[k][n]) * t;
        let [radius, z] = [0, 1].map(|n| {
            let (a, b) = (along(&self.lines[i], n), along(&self.lines[(i + 1) % DIRECTIONS], n));
            a + (b - a) * s
        });
        let band = 0.004 * (1.0 - step(length - BAND, 0.008));
        direction(angle) * (radius + band + self.fold(angle, length)) + DVec3::Z * z
    }

    /// The vertices around the skirt at a length along the cloth, equally far from each other, from `shift` edges
    /// beyond the middle of the back.
    fn row(&self, length: f64, shift: f64) -> Vec<DVec3> {
        const FINE: usize = 1440;
        let points: Vec<DVec3> = (0..=FINE).map(|i| self.point(PI + i as f64 * TAU / FINE as f64, length)).collect();
        let mut reached = vec![0.0];
        for pair in points.windows(2) {
            reached.push(reached[reached.len() - 1] + pair[0].distance(pair[1]));
        }
        let around = reached[FINE];
        (0..AROUND)
            .map(|i| {
                let wanted = (i as f64 + shift) * around / AROUND as f64;
                let after = reached.partition_point(|&length| length <= wanted).clamp(1, FINE);
                let t = (wanted - reached[after - 1]) / (reached[after] - reached[after - 1]);
                points[after - 1].lerp(points[after], t)
            })
            .collect()
    }
}
