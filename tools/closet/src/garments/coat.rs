//! A puffer coat to the thighs: bulging rings on trunk and sleeves, a padded stand-up collar, a zip.

use glam::DVec3;

use super::super::SEED;
use super::super::implicit::{Field, Owner, Shape, smooth_min};
use super::super::loft::{Loft, Section};
use super::super::random::Random;
use super::super::skeleton::{ARMS, LEGS, NECK, ROOT, WAIST};
use super::super::surface::{Design, Function, Seam};
use super::folds::{ridge, step};
use super::limb::Limb;
use super::panels::panels;
use super::upper::{Upper, cuffs, sleeves, trunk};
use super::{Mannequin, Piece};

/// The cloth keeps this distance (metres) from the skin.
const CLEARANCE: f64 = 0.014;

/// Edge length in metres, and as a share of it along the stitches.
const EDGE: f64 = 0.0200;
const FINE: f64 = 0.66;

/// Rings between stitches.
#[derive(Clone, Debug)]
struct Rings {
    /// Where the stitches are, in metres along the garment, rising.
    stitches: Vec<f64>,
    /// How far each ring bulges, in metres.
    heights: Vec<f64>,
}

impl Rings {
    /// `count` rings of about the same width between `from` and `to`, each a little different.
    fn new([from, to]: [f64; 2], count: usize, height: f64, random: &mut Random) -> Self {
        let width = (to - from) / count as f64;
        let stitches = (0..=count)
            .map(|i| from + width * (i as f64 + if i % count == 0 { 0.0 } else { 0.05 * random.signed() }))
            .collect();
        Self { stitches, heights: (0..count).map(|_| height * (1.0 + 0.10 * random.signed())).collect() }
    }

    /// How far the cloth stands out: a round bulge with a narrow valley on both sides.
    fn height(&self, along: f64) -> f64 {
        let after = self.stitches.partition_point(|&stitch| stitch <= along);
        if after == 0 || after == self.stitches.len() {
            return 0.0;
        }
        let (from, to) = (self.stitches[after - 1], self.stitches[after]);
        // Edges run along the stitches, so the valley may be narrow.
        const ROUND: f64 = 0.003;
        let from_stitch = (along - from).min(to - along).hypot(ROUND) - ROUND;
        let half = (0.5 * (to - from)).hypot(ROUND) - ROUND;
        self.heights[after - 1] * (1.0 - (1.0 - from_stitch / half).powf(2.8))
    }

    /// Metres to the nearest stitch.
    fn stitch(&self, along: f64) -> f64 {
        self.stitches.iter().map(|stitch| (along - stitch).abs()).fold(f64::INFINITY, f64::min)
    }
}

/// Designs the coat.
pub fn coat(mannequin: &Mannequin) -> Piece {
    let (skeleton, body) = (&mannequin.skeleton, &mannequin.body);
    let mut random = Random::new(SEED);
    let j = &skeleton.joints;
    let arms = ARMS.map(|joints| Limb::new(skeleton, joints));
    let (waist, shoulder, neck) = (j[WAIST].z, j[ARMS[0][0]].z, j[NECK]);
    let hem = j[LEGS[0][0]].z - 0.150;
    let up = |t: f64| waist + (shoulder - waist) * t;
    let trunk = trunk(&[
        [hem - 0.06, 0.226, 0.150, 0.160],
        [hem + 0.06, 0.222, 0.148, 0.158],
        [j[ROOT].z - 0.02, 0.212, 0.144, 0.150],
        [waist, 0.180, 0.134, 0.124],
        [up(0.40), 0.180, 0.138, 0.128],
        [up(0.70), 0.188, 0.144, 0.138],
        [up(0.90), 0.184, 0.130, 0.138],
        [shoulder + 0.30 * (neck.z - shoulder), 0.140, 0.090, 0.112],
        [neck.z - 0.03, 0.085, 0.072, 0.080],
    ]);
    let sleeves = sleeves(
        skeleton,
        &[[0.0, 0.056, 0.066], [0.4, 0.058, 0.064], [1.0, 0.057, 0.060]],
        &[[0.0, 0.057, 0.060], [0.5, 0.052, 0.055], [0.80, 0.046, 0.049], [0.86, 0.038, 0.042], [1.0, 0.037, 0.041]],
    );
    let upper = Upper::new(skeleton, trunk, 0.046, sleeves);
    let collar = {
        let sections = [
            Section::ellipse(0.0, 0.086, 0.088),
            Section::ellipse(0.5, 0.082, 0.088),
            Section::ellipse(1.0, 0.084, 0.096),
        ];
        let low = neck + DVec3::new(0.0, 0.004, -0.105);
        let mut field = Field::default();
        let own = Owner::Joint(NECK);
        field.add(Shape::Loft(Loft::new(low, neck + DVec3::new(0.0, -0.006, 0.065), DVec3::Y, &sections)), 0.0, own);
        field.finish()
    };

    let top = up(0.93);
    let trunk_rings = Rings::new([hem + 0.012, top], 7, 0.025, &mut random);
    let sleeve_rings = Rings::new([0.055, arms[0].length() * 0.90], 6, 0.019, &mut random);
    // Height above the collar's seam, which rises to the back as its rim does.
    let rise = move |p: DVec3| p.z - 0.30 * (p.y - neck.y);
    let collar_rings = Rings::new([neck.z - 0.070, neck.z + 0.006], 1, 0.014, &mut random);
    let side = |p: DVec3| usize::from(p.x < 0.0);
    let puffs = |p: DVec3| {
        let apart = upper.apart(p);
        let height =
            if apart > 0.0 { sleeve_rings.height(arms[side(p)].place(p).along) } else { trunk_rings.height(p.z) };
        // Flat along the armhole, where the sleeves are sewn on; below it sleeve and trunk must not meet.
        smooth_min(height, 0.42 * apart.abs(), 0.010).max(0.0)
    };
    // It ends below the collar's rim.
    let zip = |p: DVec3| {
        if p.y < 0.0 { 0.011 * ridge(p.x, 0.017) * step(neck.z - 0.024 - rise(p), 0.014) } else { 0.0 }
    };
    let solid = |p: DVec3| {
        let shell = smooth_min(upper.cloth.value(p) - puffs(p), collar.value(p) - collar_rings.height(rise(p)), 0.014);
        smooth_min(shell + zip(p), body.value(p) - CLEARANCE, 0.015)
    };
    let edge_length = |p: DVec3| {
        let stitch = if upper.apart(p) > 0.0 {
            sleeve_rings.stitch(arms[side(p)].place(p).along)
        } else {
            trunk_rings.stitch(p.z)
        };
        let near = |distance: f64, reach: f64| FINE + (1.0 - FINE) * step(distance - reach, 0.020);
        let mut length = near(stitch, 0.010);
        if p.y < 0.0 {
            length = length.min(near(p.x.abs(), 0.020));
        }
        EDGE * length.min(near(neck.z - 0.075 - rise(p), 0.0))
    };
    let mut cuts: Vec<Function> = cuffs(&arms, 0.955);
    cuts.push(Box::new(move |p| hem - p.z));
    cuts.push(Box::new(move |p| if p.x.abs() < 0.13 { rise(p) - (neck.z - 0.002) } else { -1.0 }));
    let mut seams = vec![Seam { function: Box::new(|p| p.x), within: Box::new(|p| p.y < 0.0) }];
    for &stitch in &trunk_rings.stitches {
        seams.push(Seam { function: Box::new(move |p| p.z - stitch), within: Box::new(|p| upper.apart(p) < -0.006) });
    }
    for &stitch in &sleeve_rings.stitches {
        seams.push(Seam {
            function: Box::new(move |p| arms[side(p)].place(p).along - stitch),
            within: Box::new(|p| upper.apart(p) > 0.006),
        });
    }
    let bounds = upper.cloth.bounds();
    let bounds = [bounds[0] - 0.03, bounds[1] + DVec3::new(0.03, 0.03, 0.08)];
    let mesh =
        Design { solid: Box::new(solid), cuts, edge_length: Box::new(edge_length), bounds, cell: 0.0150, rounds: 4 }
            .sewn(&seams, &[]);
    let no_fit = (0..mesh.positions.len() as u32)
        .filter(|&v| {
            let p = mesh.positions[v as usize];
            p.x.abs() < 0.13 && rise(p) > neck.z - 0.055
        })
        .collect();
    let texture = panels(&mesh, hem, &arms, &|p| upper.sleeve(p));
    Piece { mesh, texture, no_fit }
}
