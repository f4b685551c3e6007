//! A human head: skull, jaw and the features of the face, with eyes, brows and lips as parts of their own.

use glam::{DMat3, DVec3};

use super::super::implicit::{Owner, Shape};
use super::super::loft::Section;
use super::super::skeleton::NECK;
use super::clay::{Clay, Frame, Part, SIDES, rigid};
use super::sweep::{ellipsoid, ring, sweep};

/// What makes a face. Multiples of the mannequin's measures unless stated otherwise.
#[derive(Clone, Copy, Debug)]
pub struct Face {
    /// Size of the brain's part of the skull.
    pub skull: f64,
    /// Width of cheeks and jaw.
    pub wide: f64,
    /// Width of the jaw's corners beyond that.
    pub jaw: f64,
    /// How far the chin stands out and down.
    pub chin: f64,
    /// Fullness of the cheeks.
    pub cheeks: f64,
    /// Thickness of the ridge over the eyes.
    pub brow: f64,
    /// Length of the nose.
    pub nose: f64,
    /// Thickness of the nose.
    pub nostrils: f64,
    /// Size of the eyes.
    pub eyes: f64,
    /// Fullness of the lips.
    pub lips: f64,
    /// Width of the mouth.
    pub mouth: f64,
    /// Size of the ears.
    pub ears: f64,
    /// Thickness of the eyebrows; 0 for none.
    pub eyebrows: f64,
    /// Edge length of the triangles, relative to the head.
    pub edge: f64,
}

/// The mannequin's measures.
pub const PLAIN: Face = Face {
    skull: 1.0,
    wide: 1.0,
    jaw: 1.0,
    chin: 1.0,
    cheeks: 1.0,
    brow: 1.0,
    nose: 1.0,
    nostrils: 1.0,
    eyes: 1.0,
    lips: 1.0,
    mouth: 1.0,
    ears: 1.0,
    eyebrows: 1.0,
    edge: 0.0075,
};

const OWN: Owner = Owner::Joint(NECK);

/// Where an eye is: its centre in the frame of the head, and its radius.
fn eye(face: &Face, side: f64) -> ([f64; 3], f64) {
    let radius = 0.0145 * face.eyes;
    ([side * (0.031 + 0.010 * (face.eyes - 1.0)) * face.wide.sqrt(), -0.096 + 0.85 * radius, 0.088], radius)
}

/// Joins a head to the body. The frame's origin is the joint of the neck.
pub fn head(clay: &mut Clay, frame: &Frame, face: &Face) {
    let (s, w) = (face.skull, face.wide);
    let lump =
        |clay: &mut Clay, centre: [f64; 3], radii: [f64; 3], blend: f64| clay.lump(frame, centre, radii, blend, OWN);
    lump(clay, [0.0, 0.006, 0.084 + 0.040 * s], [0.076 * s, 0.098 * s, 0.086 * s], 0.03);
    lump(clay, [0.0, -0.048, 0.072], [0.056 * w, 0.052, 0.072], 0.04);
    lump(clay, [0.0, -0.040, 0.022], [0.046 * w * face.jaw, 0.050, 0.036], 0.04);
    let chin = [0.0, -0.076 - 0.012 * face.chin, 0.006 - 0.010 * face.chin];
    lump(clay, chin, [0.022 * face.jaw, 0.018 * face.chin.max(0.6), 0.018], 0.028);
    lump(clay, [0.0, -0.084, 0.028], [0.029 * face.mouth, 0.022, 0.024], 0.025);
    for side in SIDES {
        lump(clay, [side * 0.043 * w * face.jaw, -0.014, 0.024], [0.014, 0.026, 0.026], 0.03);
        lump(
            clay,
            [side * 0.044 * w, -0.064, 0.056],
            [0.019 * face.cheeks, 0.022 * face.cheeks, 0.018 * face.cheeks],
            0.022,
        );
        let (centre, radius) = eye(face, side);
        clay.hollow(frame, [centre[0], -0.116, centre[2] - 0.001], [1.35 * radius, 0.022, 1.0 * radius], 0.018, OWN);
        // The ridge over the eye, falling to the outside.
        let b = face.brow;
        let above = centre[2] + 1.25 * radius;
        let ridge = [
            frame.at(side * 0.010, -0.094 - 0.004 * (b - 1.0), above),
            frame.at(centre[0] + side * 0.002, -0.092 - 0.006 * (b - 1.0), above + 0.003),
            frame.at(centre[0] + side * 0.026, -0.070, above - 0.004),
        ];
        clay.tube(&ridge, &[0.0085, 0.0095, 0.0085].map(|r| r * frame.size * b), 0.022 * frame.size, OWN);
        ear(clay, frame, face, side);
    }
    // The nose: its bridge, tip and wings.
    let (n, t) = (face.nose, face.nostrils);
    let points = [
        frame.at(0.0, -0.096, 0.100),
        frame.at(0.0, -0.106 - 0.005 * n, 0.076),
        frame.at(0.0, -0.108 - 0.016 * n, 0.060 - 0.004 * n),
    ];
    clay.tube(&points, &[0.0075, 0.0085 * t.sqrt(), 0.0115 * t].map(|r| r * frame.size), 0.012 * frame.size, OWN);
    for side in SIDES {
        lump(clay, [side * 0.0105 * t, -0.102 - 0.007 * n, 0.054 - 0.003 * n], [0.0085 * t, 0.0115, 0.0080 * t], 0.007);
    }
    clay.refine(frame.at(0.0, -0.085, 0.055), 0.068 * frame.size, face.edge * frame.size);
}

fn ear(clay: &mut Clay, frame: &Frame, face: &Face, side: f64) {
    let e = face.ears;
    if e <= 0.0 {
        return;
    }
    let turned = Frame {
        rotation: frame.rotation * DMat3::from_rotation_z(side * 0.45) * DMat3::from_rotation_x(-0.15),
        ..*frame
    };
    let radii = frame.size * e * DVec3::new(0.010, 0.019, 0.031);
    let x = side * (0.064 + 0.012 * face.skull);
    let centre = frame.at(x, 0.010, 0.076);
    clay.add(Shape::Ellipsoid { centre, radii, rotation: turned.rotation }, 0.010 * frame.size, OWN);
    let hollow = centre + turned.rotation * (frame.size * e * DVec3::new(side * 0.012, -0.004, 0.004));
    let radii = frame.size * e * DVec3::new(0.008, 0.010, 0.019);
    clay.carve(Shape::Ellipsoid { centre: hollow, radii, rotation: turned.rotation }, 0.006 * frame.size, OWN);
    clay.refine(centre, 0.03 * e * frame.size, 1.1 * face.edge * frame.size);
}

/// What lies on a face, as closed parts of their own: eyes, lids, eyebrows, lips. `open` is how far the eyes are open,
/// from 0 to 1; `frown` turns the eyebrows inwards and down, in radians.
pub fn features(frame: &Frame, face: &Face, open: f64, frown: f64) -> Vec<Part> {
    let size = frame.size;
    let mut parts = Vec::new();
    for side in SIDES {
        let ([x, y, z], radius) = eye(face, side);
        parts.extend(eyeball(&Frame { origin: frame.at(x, y, z), ..*frame }, radius, open, side));
        if face.eyebrows > 0.0 {
            let b = 0.006 * (face.brow - 1.0);
            let above = z + 1.30 * radius + 0.006;
            let thick = face.eyebrows * size;
            let point = |out: f64, y: f64, up: f64| frame.at(x + side * out, y, above + up + out * frown.sin());
            let line = [
                ring(point(-0.019, -0.100 - b, 0.000), 0.0035 * thick, 0.0040 * thick),
                ring(point(-0.006, -0.1005 - b, 0.003), 0.0050 * thick, 0.0062 * thick),
                ring(point(0.010, -0.092 - b, 0.004), 0.0050 * thick, 0.0052 * thick),
                ring(point(0.025, -0.076 - b, -0.002), 0.0030 * thick, 0.0025 * thick),
            ];
            parts.push(rigid(sweep(&line, frame.rotation.z_axis, 6, 7), NECK));
        }
    }
    // Two lips; the line of the mouth is where they meet.
    let (l, m) = (face.lips * size, face.mouth);
    // They go back with a small chin.
    let back = 0.006 * (1.0 - face.chin).max(0.0);
    for (z, thick, wide, bow) in [(0.0285, 0.0052, 0.027, 0.0022), (0.0195, 0.0062, 0.024, -0.002)] {
        let at = |x: f64, y: f64, up: f64| frame.at(x * m, y + back, 0.024 + (z - 0.024) * face.lips + up);
        let flat = 0.024 + 0.3 * (z - 0.024) - z;
        let rings = [
            ring(at(-wide, -0.0935, flat), 0.0015 * size, 0.0018 * l),
            ring(at(-0.55 * wide, -0.1055, 0.5 * bow), 0.0062 * size, 0.85 * thick * l),
            ring(at(0.0, -0.1095, 0.0), 0.0075 * size, thick * l),
            ring(at(0.55 * wide, -0.1055, 0.5 * bow), 0.0062 * size, 0.85 * thick * l),
            ring(at(wide, -0.0935, flat), 0.0015 * size, 0.0018 * l),
        ];
        parts.push(rigid(sweep(&rings, frame.rotation.z_axis, 6, 8), NECK));
    }
    parts
}

/// One eye around the origin of a frame, looking along -y, with an upper and a lower lid; `open` from 0 to 1.
pub fn eyeball(frame: &Frame, radius: f64, open: f64, side: f64) -> Vec<Part> {
    let unit = radius * frame.size;
    let axes = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| frame.rotation * axis * unit);
    let ball = ellipsoid(frame.origin, axes, 8, 5);
    let mut parts = vec![rigid(ball, NECK)];
    for (up, lift, thick) in [(1.0, 0.15 + 0.75 * open, 0.30), (-1.0, 0.25 + 0.45 * open, 0.20)] {
        // An arch over the ball from corner to corner, the outer one a little higher.
        let rings = [-1.0, -0.55, 0.0, 0.55, 1.0].map(|u: f64| {
            let arch = (1.0 - u * u).sqrt();
            let (x, z) = (1.12 * u, up * lift * arch + 0.14 * u * side);
            let y = -(1.16f64.powi(2) - 0.8 * x * x - 0.6 * z * z).max(0.05).sqrt();
            let thick = (thick * (0.45 + 0.55 * arch)) * unit;
            ring(frame.at(radius * x, radius * y, radius * z), 1.15 * thick, thick)
        });
        parts.push(rigid(sweep(&rings, frame.rotation.z_axis, 6, 7), NECK));
    }
    parts
}

/// Hair as a cap: a solid around the skull, open in front. `front` is where it begins on the forehead (0.10 is above
/// the brow, 0.18 the crown), `low` how far down it reaches behind.
pub fn hair(frame: &Frame, face: &Face, front: f64, low: f64, thickness: f64) -> Clay {
    let mut cap = Clay::new(0.016 * frame.size, 0.007 * frame.size);
    let s = face.skull;
    let z = 0.084 + 0.040 * s;
    let t = thickness;
    cap.lump(frame, [0.0, 0.010, z], [0.076 * s + t, 0.098 * s + t, 0.086 * s + t], 0.0, OWN);
    let nape = [
        Section::ellipse(0.0, (0.068 * s + t) * frame.size, (0.070 * s + t) * frame.size),
        Section::ellipse(1.0, 0.052 * s * frame.size, 0.045 * s * frame.size),
    ];
    cap.loft(frame.at(0.0, 0.030, z), frame.at(0.0, 0.046, low), &nape, 0.03 * frame.size, OWN);
    // The face, from the hairline to below the chin, and the ears.
    cap.hollow(frame, [0.0, -0.125, front - 0.105], [0.080, 0.088, 0.105], 0.010, OWN);
    for side in SIDES {
        cap.hollow(frame, [side * (0.078 * s + 0.006), 0.000, 0.062], [0.030, 0.030, 0.042], 0.008, OWN);
        cap.hollow(frame, [side * (0.078 * s + 0.006), -0.050, 0.030], [0.050, 0.055, 0.050], 0.008, OWN);
    }
    cap
}
