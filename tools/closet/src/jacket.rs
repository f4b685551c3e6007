//! A quilted jacket with sleeves, a stand-up collar, a zip and ribbed bands, designed on a given body.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::implicit::{Field, Owner, Shape, smooth_min};
use super::loft::{Loft, Section};
use super::mesh::Mesh;
use super::random::Random;
use super::skeleton::{ARMS, LEGS, NECK, ROOT, Skeleton, WAIST};
use super::surface::{Design, Function};
use super::texture::{Panel, Texture, unwrap};

/// The cloth keeps this distance (metres) from the body.
const CLEARANCE: f64 = 0.013;

/// Edge length in metres, and beside the zip.
const EDGE: f64 = 0.0212;
const ZIP_EDGE: f64 = 0.0155;

/// A jacket, its texture coordinates and the vertices that need not fit.
pub struct Jacket {
    /// Open at the collar, the hem and the cuffs.
    pub mesh: Mesh,
    /// Body and sleeves side by side.
    pub texture: Texture,
    /// The vertices of the collar, which stands away from the neck.
    pub no_fit: Vec<u32>,
}

/// Designs a jacket for a body. `seed` varies the puffs; `coarseness` multiplies the edge lengths.
pub fn jacket(skeleton: &Skeleton, body: &Field, seed: u64, coarseness: f64) -> Jacket {
    let mut random = Random::new(seed);
    let j = &skeleton.joints;
    let hem = j[LEGS[0][0]].z - 0.050;
    let sleeves = ARMS.map(|joints| sleeve(joints, skeleton, &mut random));
    let trunk = trunk(skeleton, hem, &mut random);
    let collar = collar(skeleton);
    let mut cloth = Field::default();
    let own = Owner::Joint(WAIST);
    cloth.add(Shape::Loft(trunk), 0.02, own);
    for (side, [shoulder, ..]) in [1.0, -1.0].into_iter().zip(ARMS) {
        let sections =
            [Section::circle(0.0, 0.048), Section::ellipse(0.5, 0.050, 0.068), Section::ellipse(1.0, 0.054, 0.068)];
        let tip = j[shoulder] + DVec3::new(side * 0.01, 0.0, -0.010);
        let yoke = Loft::new(j[NECK] - DVec3::Z * 0.075, tip, DVec3::Y, &sections);
        cloth.add(Shape::Loft(yoke), 0.05, own);
    }
    for [upper, lower] in &sleeves {
        cloth.add(Shape::Loft(upper.clone()), 0.045, own);
        cloth.add(Shape::Loft(lower.clone()), 0.012, own);
    }
    cloth.add(Shape::Loft(collar.clone()), 0.018, own);
    let cloth = cloth.finish();

    let zip_top = j[NECK].z;
    let solid = |p: DVec3| {
        let groove = if p.y < 0.0 && p.z < zip_top { 0.007 * (-(p.x / 0.011).powi(2)).exp() } else { 0.0 };
        smooth_min(cloth.value(p) + groove, body.value(p) - CLEARANCE, 0.015)
    };
    let mut cuts: Vec<Function> = vec![Box::new(move |p| hem - p.z)];
    for (_, elbow, wrist) in ARMS.map(|[shoulder, elbow, wrist]| (shoulder, j[elbow], j[wrist])) {
        let axis = (wrist - elbow).normalize();
        let cuff = elbow.lerp(wrist, 0.93);
        let reach = 0.8 * elbow.distance(wrist);
        // Beyond the reach the plane would also cut the hip.
        cuts.push(Box::new(move |p| if p.distance(cuff) < reach { axis.dot(p - cuff) } else { -1.0 }));
    }
    let neck = j[NECK];
    cuts.push(Box::new(move |p| {
        // Higher at the nape; in front it dips where the zip ends. The shoulders stay whole.
        let (x, y) = (p.x, p.y - neck.y);
        if x.abs() > 0.13 {
            return -1.0;
        }
        let dip = 0.022 * (-(x / 0.030).powi(2)).exp() / (1.0 + (y / 0.012).exp());
        p.z - (neck.z - 0.006 + 0.36 * y - dip)
    }));
    let edge_length = |p: DVec3| {
        let beside = ((p.x.abs() - 0.02) / 0.06).clamp(0.0, 1.0);
        coarseness * if p.y < 0.0 { ZIP_EDGE + (EDGE - ZIP_EDGE) * beside } else { EDGE }
    };
    let bounds = cloth.bounds();
    let mesh =
        Design { solid: Box::new(solid), cuts, edge_length: Box::new(edge_length), bounds, cell: 0.017, rounds: 4 }
            .mesh();

    let no_fit = (0..mesh.positions.len() as u32)
        .filter(|&v| {
            let p = mesh.positions[v as usize];
            collar.local(p)[0] > 0.55 && collar.distance(p) < 0.01
        })
        .collect();
    let texture = texture(&mesh, skeleton, &sleeves);
    Jacket { mesh, texture, no_fit }
}

fn trunk(skeleton: &Skeleton, hem: f64, random: &mut Random) -> Loft {
    let j = &skeleton.joints;
    let (waist, shoulder, neck) = (j[WAIST].z, j[ARMS[0][0]].z, j[NECK].z);
    let (bottom, top) = (hem - 0.06, neck - 0.03);
    let up = |t: f64| waist + (shoulder - waist) * t;
    // Height, half the width, depth to the front and to the back. The first three make the band.
    let table = [
        (bottom, 0.206, 0.140, 0.150),
        (hem + 0.030, 0.208, 0.142, 0.152),
        (hem + 0.055, 0.216, 0.150, 0.158),
        (hem + 0.100, 0.222, 0.156, 0.162),
        (j[ROOT].z + 0.04, 0.216, 0.152, 0.152),
        (waist + 0.02, 0.192, 0.142, 0.134),
        (up(0.40), 0.194, 0.146, 0.138),
        (up(0.70), 0.200, 0.150, 0.146),
        (up(0.90), 0.192, 0.134, 0.144),
        (shoulder + 0.30 * (neck - shoulder), 0.140, 0.090, 0.116),
        (top, 0.085, 0.072, 0.080),
    ];
    let share = |z: f64| (z - bottom) / (top - bottom);
    let sections = table.map(|(z, width, front, back)| Section { t: share(z), centre: [0.0, 0.0], width, front, back });
    Loft::new(DVec3::Z * bottom, DVec3::Z * top, DVec3::Y, &sections).capped(0.3).quilted(
        [share(hem + 0.055), share(up(0.95))],
        6,
        0.014,
        random,
    )
}

fn sleeve([shoulder, elbow, wrist]: [usize; 3], skeleton: &Skeleton, random: &mut Random) -> [Loft; 2] {
    let [a, b, c] = [shoulder, elbow, wrist].map(|joint| skeleton.joints[joint]);
    let upper =
        [Section::ellipse(0.0, 0.058, 0.070), Section::ellipse(0.4, 0.061, 0.068), Section::ellipse(1.0, 0.060, 0.062)];
    // The last sections make the ribbed cuff.
    let lower = [
        Section::ellipse(0.0, 0.060, 0.062),
        Section::ellipse(0.5, 0.056, 0.058),
        Section::ellipse(0.72, 0.050, 0.052),
        Section::ellipse(0.80, 0.041, 0.045),
        Section::ellipse(1.0, 0.040, 0.044),
    ];
    [
        Loft::new(a, b, DVec3::Y, &upper).quilted([0.1, 1.0], 4, 0.010, random),
        Loft::new(b, c, DVec3::Y, &lower).quilted([0.0, 0.79], 3, 0.010, random),
    ]
}

fn collar(skeleton: &Skeleton) -> Loft {
    let neck = skeleton.joints[NECK];
    let sections =
        [Section::ellipse(0.0, 0.084, 0.086), Section::ellipse(0.5, 0.078, 0.082), Section::ellipse(1.0, 0.084, 0.094)];
    let low = neck + DVec3::new(0.0, 0.004, -0.105);
    Loft::new(low, neck + DVec3::new(0.0, -0.004, 0.055), DVec3::Y, &sections)
}

/// Body and sleeves as unrolled cylinders, in one atlas.
fn texture(mesh: &Mesh, skeleton: &Skeleton, sleeves: &[[Loft; 2]; 2]) -> Texture {
    let j = &skeleton.joints;
    let trunk = Panel {
        coordinates: Box::new(|p| (p.x.atan2(-p.y), p.z)),
        radius: 0.2,
        corner: [0.0, 0.0],
        origin: [-PI, j[ROOT].z - 0.25],
    };
    let mut panels = vec![trunk];
    for (side, [upper, lower]) in sleeves.iter().enumerate() {
        let [shoulder, elbow, wrist] = ARMS[side].map(|joint| j[joint]);
        let (above, below) = (shoulder.distance(elbow), elbow.distance(wrist));
        panels.push(Panel {
            coordinates: Box::new(move |p| {
                // The seam runs along the inside of the arm. The two halves share one length along the arm.
                let [t, s] = [upper.local(p), lower.local(p)];
                let ([_, x, y], along) =
                    if t[0] < 1.0 { (t, t[0] * above) } else { (s, above + s[0].max(0.0) * below) };
                // Mirrored to the left, so that the cloth's outside shows on both.
                (if wrist.x > 0.0 { (-y).atan2(x) } else { y.atan2(-x) }, along)
            }),
            radius: 0.06,
            corner: [0.2 * TAU + 0.03 + side as f64 * (0.06 * TAU + 0.03), 0.0],
            origin: [-PI, -0.15],
        });
    }
    let which = |p: DVec3| {
        let sleeve =
            |[upper, lower]: &[Loft; 2]| upper.local(p)[0] > 0.12 && upper.distance(p).min(lower.distance(p)) < 0.02;
        sleeves.iter().position(sleeve).map_or(0, |side| side + 1)
    };
    unwrap(mesh, &panels, &which)
}
