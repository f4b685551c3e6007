//! Bodies around a skeleton: muscles, fat and bones as smooth unions of lofts and ellipsoids.

use glam::{DMat3, DVec3};

use super::implicit::{Field, Owner, Shape};
use super::loft::{Loft, Section};
use super::skeleton::{ARMS, LEGS, NECK, ROOT, Skeleton, WAIST};

/// Sizes of a body, as multiples of the mannequin's unless stated otherwise.
#[derive(Clone, Copy, Debug)]
pub struct Build {
    /// Width of the hips.
    pub hips: f64,
    /// Width of the waist.
    pub waist: f64,
    /// Width of the chest.
    pub chest: f64,
    /// Depth of the trunk, front to back.
    pub depth: f64,
    /// How far the belly stands out, in metres (0: flat).
    pub belly: f64,
    /// Size of the breast or chest muscles.
    pub bust: f64,
    /// Thickness of the arms.
    pub arms: f64,
    /// Thickness of the legs.
    pub legs: f64,
    /// Thickness of the neck.
    pub neck: f64,
    /// Size of the head.
    pub head: f64,
    /// How far the jaw stands out, in metres beyond a human one.
    pub jaw: f64,
    /// Length of pointed ears in metres (0: round ears).
    pub ears: f64,
    /// Size of the hands.
    pub hands: f64,
    /// Size of the feet.
    pub feet: f64,
}

const BACK: DVec3 = DVec3::Y;

/// The solid of a body.
pub fn body(skeleton: &Skeleton, build: &Build) -> Field {
    let mut field = Field::default();
    trunk(&mut field, skeleton, build);
    for (side, joints) in [1.0, -1.0].into_iter().zip(LEGS) {
        leg(&mut field, side, joints, skeleton, build);
    }
    for (side, joints) in [1.0, -1.0].into_iter().zip(ARMS) {
        arm(&mut field, side, joints, skeleton, build);
    }
    neck_and_head(&mut field, skeleton, build);
    field.finish()
}

/// A curved horn on the left (`side` 1) or the right (-1), a solid of its own that begins inside the head.
pub fn horn(skeleton: &Skeleton, build: &Build, side: f64) -> Field {
    let mut field = Field::default();
    let at = |x: f64, y: f64, z: f64| skeleton.joints[NECK] + build.head * DVec3::new(x, y, z);
    // A spiral that starts inside the skull, bends out and back, and thins towards the tip.
    const PIECES: usize = 8;
    let point = |t: f64| {
        let turn = 2.3 * t;
        at(side * (0.030 + 0.075 * turn.sin()), -0.045 + 0.045 * (1.0 - turn.cos()), 0.140 + 0.150 * t)
    };
    let radius = |t: f64| build.head * (0.026 - 0.020 * t);
    for piece in 0..PIECES {
        let [s, t] = [piece, piece + 1].map(|i| i as f64 / PIECES as f64);
        let sections = [Section::circle(0.0, radius(s)), Section::circle(1.0, radius(t))];
        field.add(Shape::Loft(Loft::new(point(s), point(t), BACK, &sections)), 0.004, Owner::Joint(NECK));
    }
    field.finish()
}

fn trunk(field: &mut Field, skeleton: &Skeleton, build: &Build) {
    let j = &skeleton.joints;
    let (root, waist, neck) = (j[ROOT], j[WAIST], j[NECK]);
    let (hip, shoulder) = (j[LEGS[0][0]], j[ARMS[0][0]]);
    let bottom = hip.z - 0.09;
    let top = neck.z - 0.02;
    let forward = |z: f64| {
        // Where the spine is: straight up to the waist, then bent forward to the neck.
        let t = ((z - waist.z) / (neck.z - waist.z)).clamp(0.0, 1.0);
        waist.y + (neck.y - waist.y) * t.powf(1.5)
    };
    let between = |a: f64, b: f64, t: f64| a + (b - a) * t;
    let (hips, middle, chest, depth) = (build.hips, build.waist, build.chest, build.depth);
    // Height, half the width, depth to the front and to the back.
    let table = [
        (bottom, 0.100 * hips, 0.060, 0.085),
        (hip.z, 0.163 * hips, 0.096, 0.100),
        (root.z, 0.160 * hips, 0.102, 0.092),
        (between(root.z, waist.z, 0.55), 0.140 * between(hips, middle, 0.6), 0.100, 0.078),
        (waist.z, 0.124 * middle, 0.095, 0.076),
        (between(waist.z, shoulder.z, 0.3), 0.128 * between(middle, chest, 0.6), 0.103, 0.086),
        (between(waist.z, shoulder.z, 0.65), 0.150 * chest, 0.114, 0.102),
        (between(waist.z, shoulder.z, 0.88), 0.148 * chest, 0.100, 0.106),
        (between(shoulder.z, neck.z, 0.25), 0.115 * chest, 0.068, 0.086),
        (top, 0.062 * build.neck, 0.048, 0.056),
    ];
    let sections = table.map(|(z, width, front, back)| Section {
        t: (z - bottom) / (top - bottom),
        centre: [0.0, forward(z)],
        width,
        front: front * depth,
        back: back * depth,
    });
    let spine = Owner::Passage { joints: [ROOT, WAIST], height: waist.z, reach: 0.10 };
    let axis = |z: f64| DVec3::new(0.0, 0.0, z);
    field.add(Shape::Loft(Loft::new(axis(bottom), axis(top), BACK, &sections).capped(0.3)), 0.02, spine);
    if build.belly > 0.0 {
        let centre = DVec3::new(0.0, waist.y - 0.085 * depth, between(root.z, waist.z, 0.7));
        let radii = DVec3::new(0.125 * middle, build.belly, 0.16 + 0.3 * build.belly);
        field.add(Shape::ellipsoid(centre, radii), 0.08, spine);
    }
    for side in [1.0, -1.0] {
        let seat = DVec3::new(side * 0.078 * hips, 0.052 * depth, hip.z - 0.022);
        let radii = DVec3::new(0.080 * hips, 0.072 * depth, 0.092 * hips.sqrt());
        field.add(Shape::ellipsoid(seat, radii), 0.06, Owner::Joint(ROOT));
        let height = between(waist.z, shoulder.z, 0.66);
        let breast = DVec3::new(side * 0.075 * chest, forward(height) - 0.080 * depth, height);
        let radii = DVec3::new(0.064, 0.048, 0.056) * build.bust;
        field.add(Shape::ellipsoid(breast, radii), 0.045, Owner::Joint(WAIST));
        // Shoulder blade and the muscle from the neck to the shoulder.
        let blade = DVec3::new(side * 0.085 * chest, forward(height) + 0.058 * depth, height + 0.03);
        field.add(Shape::ellipsoid(blade, DVec3::new(0.060, 0.040, 0.085) * chest), 0.05, Owner::Joint(WAIST));
        let outer = DVec3::new(side * shoulder.x, shoulder.y, shoulder.z - 0.012);
        let collar = Loft::new(
            neck - DVec3::Z * 0.062,
            outer,
            BACK,
            &[
                Section::ellipse(0.0, 0.034, 0.044),
                Section::ellipse(0.55, 0.035, 0.048),
                Section::ellipse(1.0, 0.036 * build.arms.sqrt(), 0.046 * build.arms.sqrt()),
            ],
        );
        field.add(Shape::Loft(collar), 0.05, Owner::Joint(WAIST));
    }
}

fn leg(field: &mut Field, side: f64, [hip, knee, ankle]: [usize; 3], skeleton: &Skeleton, build: &Build) {
    let [a, b, c] = [hip, knee, ankle].map(|joint| skeleton.joints[joint]);
    let section = |t: f64, width: f64, depth: f64| Section::ellipse(t, width * build.legs, depth * build.legs);
    let thigh = [
        section(0.0, 0.086, 0.092).moved(-side * 0.006, 0.0),
        section(0.3, 0.083, 0.090).moved(-side * 0.004, -0.004),
        section(0.65, 0.067, 0.074).moved(0.0, -0.006),
        section(0.9, 0.054, 0.057),
        section(1.0, 0.052, 0.054),
    ];
    field.add(Shape::Loft(Loft::new(a, b, BACK, &thigh)), 0.045, Owner::Joint(hip));
    let shin = [
        section(0.0, 0.051, 0.053),
        section(0.12, 0.051, 0.053).moved(0.0, 0.004),
        section(0.32, 0.056, 0.060).moved(0.0, 0.014),
        section(0.62, 0.043, 0.046).moved(0.0, 0.010),
        section(0.88, 0.032, 0.036),
        section(1.0, 0.034, 0.040),
    ];
    field.add(Shape::Loft(Loft::new(b, c, BACK, &shin)), 0.02, Owner::Joint(knee));
    let size = build.feet;
    let sole = DVec3::new(c.x, c.y, 0.0);
    let heel = sole + size * DVec3::new(0.0, 0.022, 0.034);
    field.add(Shape::ellipsoid(heel, size * DVec3::new(0.034, 0.040, 0.044)), 0.03, Owner::Joint(ankle));
    let toes = sole + size * DVec3::new(side * 0.025, -0.150, 0.016);
    let instep = [
        Section::ellipse(0.0, 0.032 * size, 0.040 * size),
        Section::ellipse(0.45, 0.036 * size, 0.034 * size),
        Section::ellipse(0.75, 0.044 * size, 0.026 * size),
        Section::ellipse(1.0, 0.034 * size, 0.019 * size),
    ];
    let ankle_front = sole + size * DVec3::new(0.0, -0.005, 0.045);
    field.add(Shape::Loft(Loft::new(ankle_front, toes, DVec3::Z, &instep).capped(1.4)), 0.03, Owner::Joint(ankle));
    field.carve(Shape::Below { height: 0.0 }, 0.012, Owner::Joint(ankle));
}

fn arm(field: &mut Field, side: f64, [shoulder, elbow, wrist]: [usize; 3], skeleton: &Skeleton, build: &Build) {
    let [a, b, c] = [shoulder, elbow, wrist].map(|joint| skeleton.joints[joint]);
    let section = |t: f64, width: f64, depth: f64| Section::ellipse(t, width * build.arms, depth * build.arms);
    let upper = [
        section(0.0, 0.041, 0.047),
        section(0.25, 0.046, 0.052),
        section(0.55, 0.042, 0.048),
        section(0.85, 0.037, 0.039),
        section(1.0, 0.037, 0.038),
    ];
    field.add(Shape::Loft(Loft::new(a, b, BACK, &upper)), 0.055, Owner::Joint(shoulder));
    let lower = [
        section(0.0, 0.037, 0.038),
        section(0.28, 0.040, 0.043),
        section(0.65, 0.031, 0.034),
        section(0.9, 0.022, 0.028),
        section(1.0, 0.021, 0.028),
    ];
    field.add(Shape::Loft(Loft::new(b, c, BACK, &lower)), 0.018, Owner::Joint(elbow));

    // The palm faces the thigh: its width runs front to back, its thickness sideways.
    let size = build.hands;
    let along = (c - b).normalize();
    let across = DVec3::NEG_Y.reject_from_normalized(along).normalize();
    let palm_normal = along.cross(across);
    let inwards = if palm_normal.x * side < 0.0 { palm_normal } else { -palm_normal };
    let at = |u: f64, v: f64, w: f64| c + size * (u * along + v * across + w * inwards);
    let own = Owner::Joint(wrist);
    let palm = [
        Section::ellipse(0.0, 0.018 * size, 0.026 * size),
        Section::ellipse(0.5, 0.017 * size, 0.037 * size),
        Section::ellipse(1.0, 0.013 * size, 0.041 * size),
    ];
    field.add(Shape::Loft(Loft::new(at(0.0, 0.0, 0.0), at(0.088, 0.0, 0.004), BACK, &palm).capped(0.7)), 0.02, own);
    // The fingers stay closed: a gap between them would be finer than the mesh.
    for (v, length) in [(0.029, 0.066), (0.0098, 0.077), (-0.0098, 0.072), (-0.029, 0.054)] {
        let knuckle = at(0.080, v, 0.003);
        let bend = at(0.080 + 0.55 * length, v, 0.007);
        let tip = at(0.080 + length, 0.97 * v, 0.018);
        for (p, q, r0, r1) in [(knuckle, bend, 0.0118, 0.0114), (bend, tip, 0.0114, 0.0104)] {
            let sections = [Section::circle(0.0, r0 * size), Section::circle(1.0, r1 * size)];
            field.add(Shape::Loft(Loft::new(p, q, BACK, &sections)), 0.012 * size, own);
        }
    }
    let thumb = [at(0.016, 0.014, 0.005), at(0.048, 0.054, 0.013), at(0.080, 0.078, 0.018)];
    for (p, q, r0, r1) in [(thumb[0], thumb[1], 0.019, 0.014), (thumb[1], thumb[2], 0.014, 0.010)] {
        let sections = [Section::circle(0.0, r0 * size), Section::circle(1.0, r1 * size)];
        field.add(Shape::Loft(Loft::new(p, q, BACK, &sections)), 0.020 * size, own);
    }
}

fn neck_and_head(field: &mut Field, skeleton: &Skeleton, build: &Build) {
    let neck = skeleton.joints[NECK];
    let size = build.head;
    let at = |x: f64, y: f64, z: f64| neck + size * DVec3::new(x, y, z);
    let own = Owner::Joint(NECK);
    let mut ball = |centre: DVec3, radii: [f64; 3], blend: f64| {
        field.add(Shape::ellipsoid(centre, size * DVec3::from_array(radii)), blend * size, own);
    };
    ball(at(0.0, 0.004, 0.122), [0.073, 0.094, 0.084], 0.03);
    ball(at(0.0, -0.052, 0.064), [0.054, 0.050, 0.078], 0.04);
    ball(at(0.0, -0.030, 0.032), [0.053, 0.056, 0.042], 0.03);
    let jaw = DVec3::Y * build.jaw;
    ball(at(0.0, -0.069, 0.026) - 0.8 * jaw, [0.030, 0.033, 0.028], 0.03);
    ball(at(0.0, -0.075, -0.006) - jaw, [0.027 + 0.3 * build.jaw, 0.022, 0.020], 0.03);
    let column = [
        Section::circle(0.0, 0.066 * build.neck),
        Section::circle(0.4, 0.052 * build.neck),
        Section::circle(1.0, 0.049 * build.neck),
    ];
    let low = neck + DVec3::new(0.0, 0.012, -0.085);
    let column = Loft::new(low, at(0.0, 0.010, 0.075), BACK, &column);
    field.add(Shape::Loft(column), 0.04, Owner::Passage { joints: [WAIST, NECK], height: neck.z - 0.02, reach: 0.06 });

    let nose = Loft::new(
        at(0.0, -0.094, 0.100),
        at(0.0, -0.112, 0.056),
        BACK,
        &[Section::circle(0.0, 0.008 * size), Section::circle(0.7, 0.0105 * size), Section::circle(1.0, 0.0120 * size)],
    );
    field.add(Shape::Loft(nose), 0.012 * size, own);
    for side in [1.0, -1.0] {
        let tilt = DMat3::from_rotation_z(side * 0.25);
        let mut ellipsoid = |centre: DVec3, radii: [f64; 3], blend: f64, carve: bool| {
            let shape = Shape::Ellipsoid { centre, radii: size * DVec3::from_array(radii), rotation: tilt };
            if carve { field.carve(shape, blend * size, own) } else { field.add(shape, blend * size, own) }
        };
        ellipsoid(at(side * 0.040, -0.068, 0.062), [0.022, 0.024, 0.018], 0.02, false);
        ellipsoid(at(side * 0.032, -0.110, 0.088), [0.019, 0.016, 0.013], 0.018, true);
        ellipsoid(at(side * 0.030, -0.088, 0.106), [0.024, 0.010, 0.007], 0.014, false);
        ellipsoid(at(side * 0.031, -0.086, 0.087), [0.013, 0.012, 0.010], 0.006, false);
        if build.ears > 0.0 {
            let tip = at(side * 0.075, 0.02, 0.09) + DVec3::new(side * 0.85, 0.25, 0.45) * build.ears;
            let ear = Loft::new(
                at(side * 0.062, 0.005, 0.080),
                tip,
                DVec3::new(side * 0.3, 1.0, 0.0),
                &[
                    Section::ellipse(0.0, 0.028 * size, 0.017 * size),
                    Section::ellipse(0.35, 0.031 * size, 0.015 * size),
                    Section::ellipse(1.0, 0.008 * size, 0.008 * size),
                ],
            );
            field.add(Shape::Loft(ear), 0.012 * size, own);
        } else {
            let turned = DMat3::from_rotation_z(side * 0.35);
            let radii = size * DVec3::new(0.013, 0.019, 0.031);
            let ear = Shape::Ellipsoid { centre: at(side * 0.074, 0.004, 0.074), radii, rotation: turned };
            field.add(ear, 0.012 * size, own);
        }
    }
    for (y, z, radii) in [(-0.105, 0.031, [0.020, 0.008, 0.0055]), (-0.103, 0.019, [0.018, 0.008, 0.0060])] {
        let lip = Shape::ellipsoid(at(0.0, y, z) - 0.9 * jaw, size * DVec3::from_array(radii));
        field.add(lip, 0.006 * size, own);
    }
}
