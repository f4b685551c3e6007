//! The skeleton: a skull with jaw and teeth, vertebrae, curved ribs, long bones and the small ones of hands and feet.

use glam::{DMat3, DVec3};

use super::super::Sample;
use super::super::implicit::{Field, Owner, Shape};
use super::super::loft::{Loft, Section};
use super::super::mesh::Mesh;
use super::super::parts::{Parts, modelled, moved, placed};
use super::super::polyhedron::Polyhedron;
use super::super::skeleton::{ARMS, LEGS, NECK, Proportions, ROOT, Skeleton, WAIST};
use super::super::tube::{ball, column, curve, lathe, tube};

/// Models the skeleton.
pub fn skeleton() -> Sample {
    let skeleton = Proportions {
        ankle: 0.085,
        shin: 0.430,
        thigh: 0.450,
        leg_angle: 7.5,
        hip: 0.098,
        belly: 0.095,
        chest: 0.440,
        hunch: 0.012,
        shoulder: 0.172,
        shoulder_drop: 0.106,
        upper_arm: 0.290,
        forearm: 0.255,
        arm_angle: 53.0,
    }
    .skeleton();
    let mut parts = Parts::default();
    skull(&mut parts, skeleton.joints[NECK]);
    spine(&mut parts, &skeleton);
    rib_cage(&mut parts, &skeleton);
    pelvis(&mut parts, &skeleton);
    arm(&mut parts, &skeleton);
    leg(&mut parts, &skeleton);
    parts.sample(skeleton)
}

fn skull(parts: &mut Parts, neck: DVec3) {
    let own = Owner::Joint(NECK);
    let at = |x: f64, y: f64, z: f64| neck + DVec3::new(x, y, z);
    let mut field = Field::default();
    let mut add = |centre: DVec3, radii: [f64; 3], blend: f64| {
        field.add(Shape::ellipsoid(centre, DVec3::from_array(radii)), blend, own);
    };
    add(at(0.0, 0.010, 0.150), [0.076, 0.096, 0.080], 0.02);
    add(at(0.0, -0.058, 0.088), [0.050, 0.046, 0.058], 0.03);
    add(at(0.0, -0.074, 0.056), [0.034, 0.034, 0.024], 0.02);
    for side in [1.0, -1.0] {
        add(at(side * 0.034, -0.083, 0.131), [0.032, 0.014, 0.011], 0.014);
        add(at(side * 0.046, -0.076, 0.078), [0.020, 0.022, 0.013], 0.014);
        add(at(side * 0.064, -0.040, 0.082), [0.009, 0.034, 0.008], 0.010);
    }
    for side in [1.0, -1.0] {
        let mut carve = |centre: DVec3, radii: [f64; 3], turn: f64| {
            let (radii, rotation) = (DVec3::from_array(radii), DMat3::from_rotation_y(side * turn));
            field.carve(Shape::Ellipsoid { centre, radii, rotation }, 0.010, own);
        };
        carve(at(side * 0.031, -0.104, 0.106), [0.022, 0.036, 0.0185], 0.25);
        carve(at(side * 0.0065, -0.108, 0.070), [0.0085, 0.024, 0.018], 0.22);
        carve(at(side * 0.082, -0.046, 0.112), [0.022, 0.034, 0.030], 0.0);
        carve(at(side * 0.064, -0.060, 0.048), [0.022, 0.040, 0.026], 0.0);
    }
    let face = at(0.0, -0.085, 0.092);
    let edge_length = |p: DVec3| 0.0100 + 0.14 * (p.distance(face) - 0.055).max(0.0);
    parts.add(&modelled(&field.finish(), 0.0075, edge_length), NECK);

    // The jaw: one curved bone from ear to ear, and its upright branches.
    let half = [(0.060, -0.012, 0.078), (0.058, -0.018, 0.036), (0.050, -0.042, 0.012), (0.030, -0.086, -0.002)];
    let mut knots: Vec<DVec3> = half.iter().map(|&(x, y, z)| at(x, y, z)).collect();
    knots.push(at(0.0, -0.101, -0.004));
    knots.extend(half.iter().rev().map(|&(x, y, z)| at(-x, y, z)));
    let jaw = tube(&curve(&knots, 2), DVec3::Y, 6, 0.3, |t| {
        let branch = (4.0 * (t - 0.5).abs() - 1.0).max(0.0);
        [0.0075 + 0.006 * branch, 0.0150 - 0.007 * branch]
    });
    parts.add(&jaw, NECK);
    // Teeth in two arcs, the upper in front of the lower.
    for (radius, z, size) in [(0.034, 0.0345, 0.0080), (0.032, 0.0175, 0.0072)] {
        for i in 0..5 {
            let (sin, cos) = (0.15 + 0.30 * f64::from(i)).sin_cos();
            let place = at(radius * sin, -0.070 - 0.034 * cos, z);
            let tooth = Polyhedron::cuboid(DVec3::new(0.0043, 0.0036, size)).mesh();
            parts.add_pair(&moved(&tooth, &placed(place, DVec3::Z, DVec3::new(cos, sin, 0.0))), NECK);
        }
    }
}

/// The spine's middle line at a height: behind the joints, hollow at the loins, bent at the chest.
fn spine_at(skeleton: &Skeleton, z: f64) -> DVec3 {
    let [root, neck] = [ROOT, NECK].map(|joint| skeleton.joints[joint]);
    let t = (z - root.z) / (neck.z - root.z);
    DVec3::new(0.0, 0.030 + 0.034 * (5.2 * (t - 0.36)).sin() * (1.0 - 0.4 * t) - 0.020 * t.powi(3), z)
}

fn spine(parts: &mut Parts, skeleton: &Skeleton) {
    let [root, waist, neck] = [ROOT, WAIST, NECK].map(|joint| skeleton.joints[joint]);
    let low = root.z - 0.008;
    // Five vertebrae of the loins, twelve of the chest, five of the neck: each lower than the one below is wide.
    let mut z = low;
    for i in 0..22 {
        let t = f64::from(i) / 21.0;
        let (pitch, radius) = (0.0345 - 0.013 * t, 0.0275 - 0.0125 * t);
        let pitch = pitch * (neck.z + 0.070 - low) / (22.0 * 0.028);
        let joint = match z {
            z if z < waist.z => ROOT,
            z if z < neck.z - 0.02 => WAIST,
            _ => NECK,
        };
        let (a, b) = (spine_at(skeleton, z + 0.1 * pitch), spine_at(skeleton, z + 0.86 * pitch));
        let profile =
            [[0.0, 1.0, 0.85], [0.5, 0.86, 0.74], [1.0, 1.0, 0.85]].map(|[t, u, v]| [t, u * radius, v * radius]);
        parts.add(&column(a, b, DVec3::X, 6, &profile), joint);
        // The process behind, and the two at the sides.
        let middle = a.midpoint(b);
        let foot = middle + DVec3::Y * 0.9 * radius;
        let tip = foot + DVec3::new(0.0, 0.030 + 0.3 * radius, -0.020 * (1.0 - t));
        parts.add(&column(foot, tip, DVec3::X, 4, &[[0.0, 0.006, 0.009], [1.0, 0.0045, 0.007]]), joint);
        if i % 2 == 0 && i < 5 {
            let wing = middle + DVec3::new(radius + 0.002, 0.006, 0.0);
            let end = wing + DVec3::new(0.030, 0.008, 0.004);
            parts.add_pair(&column(wing, end, DVec3::Y, 4, &[[0.0, 0.005, 0.006], [1.0, 0.003, 0.004]]), joint);
        }
        z += pitch;
    }
}

fn rib_cage(parts: &mut Parts, skeleton: &Skeleton) {
    let neck = skeleton.joints[NECK];
    // Half the width of each rib, how deep it is, and how far around it goes (1: to the breastbone).
    let ribs = [
        (0.066, 0.100, 1.0),
        (0.092, 0.128, 1.0),
        (0.110, 0.146, 1.0),
        (0.122, 0.158, 1.0),
        (0.130, 0.166, 1.0),
        (0.134, 0.170, 1.0),
        (0.135, 0.170, 0.95),
        (0.132, 0.166, 0.84),
        (0.126, 0.158, 0.72),
        (0.116, 0.144, 0.58),
    ];
    let top = neck.z - 0.050;
    for (i, (width, depth, reach)) in (0..).zip(ribs) {
        let start = spine_at(skeleton, top - 0.0285 * f64::from(i));
        let drop = 0.030 + 0.0075 * f64::from(i);
        let points: Vec<DVec3> = (0..=8)
            .map(|k| {
                // The angle goes from behind, beside the spine, around the side to the front.
                let along = reach * f64::from(k) / 8.0;
                let (sin, cos) = (-1.40 + 2.72 * along).sin_cos();
                // Ribs fall on their way forward and rise a little at the end, as cartilage.
                let fall = (1.55 * along).sin().powf(1.3) - 0.55 * (along - 0.75).max(0.0);
                let y = start.y - 0.010 - 0.5 * depth - 0.5 * depth * sin;
                DVec3::new(width * cos.max(0.0).powf(0.8), y, start.z - drop * fall)
            })
            .collect();
        let rib = tube(&points, DVec3::Z, 5, 0.4, |t| [0.0082 - 0.0015 * t, 0.0052 + 0.0012 * (1.0 - t)]);
        parts.add_pair(&rib, WAIST);
    }
    // Breastbone, collarbones and shoulder blades.
    let front = spine_at(skeleton, top).y - 0.118;
    let breastbone = column(
        DVec3::new(0.0, front, top - 0.030),
        DVec3::new(0.0, front - 0.052, top - 0.190),
        DVec3::X,
        8,
        &[
            [0.0, 0.022, 0.007],
            [0.1, 0.027, 0.009],
            [0.3, 0.015, 0.008],
            [0.75, 0.019, 0.008],
            [0.88, 0.014, 0.007],
            [1.0, 0.006, 0.005],
        ],
    );
    parts.add(&breastbone, WAIST);
    let shoulder = skeleton.joints[ARMS[0][0]];
    let collar = [
        DVec3::new(0.030, front + 0.004, top - 0.018),
        DVec3::new(0.075, front - 0.006, top - 0.004),
        DVec3::new(0.125, front + 0.045, top + 0.002),
        shoulder + DVec3::new(-0.004, -0.004, 0.040),
    ];
    let collar = tube(&curve(&collar, 3), DVec3::Z, 6, 0.4, |t| [0.0075 + 0.004 * (2.0 * t - 1.0).powi(4); 2]);
    parts.add_pair(&collar, WAIST);
    let mut blade = Polyhedron::cuboid(DVec3::new(0.052, 0.007, 0.080));
    blade.cut(DVec3::new(-0.55, 0.0, -0.45).normalize(), 0.040);
    blade.cut(DVec3::new(0.80, 0.0, -0.50).normalize(), 0.032);
    blade.cut(DVec3::new(-0.4, 0.0, 1.0).normalize(), 0.078);
    let behind = DVec3::new(shoulder.x - 0.062, spine_at(skeleton, shoulder.z - 0.05).y + 0.022, shoulder.z - 0.055);
    let motion = placed(behind, DVec3::new(0.05, -0.10, 1.0), DVec3::new(1.0, -0.30, 0.0));
    parts.add_pair(&moved(&blade.bevelled(0.004).mesh(), &motion), WAIST);
    let ridge = [
        behind + DVec3::new(-0.040, 0.020, 0.035),
        behind + DVec3::new(0.020, 0.014, 0.060),
        shoulder + DVec3::new(0.012, 0.024, 0.034),
    ];
    parts.add_pair(&tube(&curve(&ridge, 2), DVec3::Z, 5, 0.3, |t| [0.008 + 0.004 * t, 0.006 + 0.004 * t]), WAIST);
}

fn pelvis(parts: &mut Parts, skeleton: &Skeleton) {
    let own = Owner::Joint(ROOT);
    let (root, hip) = (skeleton.joints[ROOT], skeleton.joints[LEGS[0][0]]);
    let mut field = Field::default();
    let mut bone = |from: DVec3, to: DVec3, radii: [f64; 2], blend: f64| {
        let sections = [Section::circle(0.0, radii[0]), Section::circle(1.0, radii[1])];
        field.add(Shape::Loft(Loft::new(from, to, DVec3::Y, &sections)), blend, own);
    };
    let at = |x: f64, y: f64, z: f64| root + DVec3::new(x, y, z);
    // The wing is hung between the socket, the sacrum and a thick crest; below, a ring of two branches.
    let socket = hip + DVec3::new(-0.026, 0.006, 0.004);
    let (pubis, seat) = (at(0.014, -0.052, -0.075), at(0.060, 0.030, -0.128));
    let crest = [at(0.032, 0.062, 0.030), at(0.078, 0.052, 0.066), at(0.122, 0.012, 0.068), at(0.128, -0.040, 0.038)];
    for (from, to) in crest.iter().zip(&crest[1..]) {
        bone(*from, *to, [0.0105, 0.0105], 0.012);
    }
    bone(socket, at(0.060, 0.040, 0.010), [0.026, 0.020], 0.03);
    bone(socket, pubis, [0.020, 0.013], 0.02);
    bone(socket, seat, [0.020, 0.014], 0.02);
    bone(seat, pubis, [0.014, 0.010], 0.02);
    let wing = (crest[1] + crest[3] + socket) / 3.0;
    let (u, v) = ((crest[3] - crest[0]).normalize(), (crest[2] - socket).normalize());
    let normal = u.cross(v).normalize();
    let rotation = DMat3::from_cols(u, normal.cross(u), normal);
    field.add(Shape::Ellipsoid { centre: wing, radii: DVec3::new(0.078, 0.058, 0.009), rotation }, 0.022, own);
    field.carve(Shape::ellipsoid(hip + DVec3::new(0.006, 0.0, -0.004), DVec3::splat(0.026)), 0.008, own);
    parts.add_pair(&modelled(&field.finish(), 0.0075, |_| 0.0170), ROOT);
    // Sacrum and tailbone.
    let profile = [[0.0, 0.036, 0.020], [0.35, 0.033, 0.018], [0.8, 0.018, 0.012], [1.0, 0.010, 0.008]];
    let (top, bottom) = (at(0.0, 0.050, -0.010), at(0.0, 0.082, -0.108));
    parts.add(&column(top, bottom, DVec3::X, 8, &profile), ROOT);
    let tail = bottom + DVec3::new(0.0, 0.002, -0.006);
    parts.add(
        &lathe(tail, tail + DVec3::new(0.0, -0.012, -0.030), 5, &[[0.0, 0.008], [0.6, 0.006], [1.0, 0.003]]),
        ROOT,
    );
}

/// A long bone from `a` to `b` in closed parts: the flared shaft, a ball at its head (none: two knobs as well) and two
/// knobs at its foot, `across` apart.
fn long_bone(a: DVec3, b: DVec3, across: DVec3, shaft: f64, head: Option<(DVec3, f64)>, knobs: [f64; 2]) -> Mesh {
    let profile = [
        [0.0, 0.90],
        [0.03, 1.45],
        [0.09, 1.40],
        [0.24, 1.02],
        [0.52, 0.90],
        [0.78, 1.06],
        [0.92, 1.45],
        [0.98, 1.60],
        [1.0, 1.10],
    ];
    let mut bone = lathe(a, b, 7, &profile.map(|[t, r]| [t, r * shaft]));
    let [upper, lower] = knobs;
    match head {
        Some((centre, radius)) => bone.append(&ball(centre, radius, 7, 4)),
        None => [1.0, -1.0].into_iter().for_each(|s| bone.append(&ball(a + s * 0.75 * upper * across, upper, 6, 3))),
    }
    [1.0, -1.0].into_iter().for_each(|s| bone.append(&ball(b + s * 0.80 * lower * across, lower, 6, 3)));
    bone
}

/// A thin bone with knobbly ends.
fn thin_bone(from: DVec3, to: DVec3, radius: f64, sides: usize) -> Mesh {
    let profile =
        [[0.0, 0.85], [0.06, 1.5], [0.2, 0.85], [0.8, 0.8], [0.94, 1.4], [1.0, 0.8]].map(|[t, r]| [t, r * radius]);
    lathe(from, to, sides, &profile)
}

/// A small bone of a finger or a toe.
fn small_bone(from: DVec3, to: DVec3, radius: f64) -> Mesh {
    lathe(from, to, 4, &[[0.0, 1.25 * radius], [0.5, 0.75 * radius], [1.0, 1.1 * radius]])
}

fn arm(parts: &mut Parts, skeleton: &Skeleton) {
    let [shoulder, elbow, wrist] = ARMS[0];
    let [a, b, c] = ARMS[0].map(|joint| skeleton.joints[joint]);
    let (upper, lower) = ((b - a).normalize(), (c - b).normalize());
    let front = DVec3::NEG_Y.reject_from_normalized(lower).normalize();
    let head = (a + 0.012 * upper - DVec3::X * 0.010, 0.026);
    parts.add_pair(
        &long_bone(a + 0.020 * upper, b - 0.022 * upper, front, 0.0130, Some(head), [0.020, 0.0175]),
        shoulder,
    );
    // Ulna and radius side by side.
    let side = 0.017 * front;
    parts.add_pair(&thin_bone(b - 0.008 * lower - side, c - 0.016 * lower - side, 0.0098, 6), elbow);
    parts.add_pair(&thin_bone(b + 0.012 * lower + side, c - 0.010 * lower + side, 0.0105, 6), elbow);
    let elbow_tip = b - DVec3::new(0.0, -0.022, 0.0) - 0.004 * lower;
    parts.add_pair(&ball(elbow_tip, 0.012, 6, 3), elbow);
    // Wrist bones, then the rays of the hand.
    let palm = lower.cross(front);
    let inwards = if palm.x < 0.0 { palm } else { -palm };
    for (reach, v) in [(0.010, 0.017), (0.008, -0.008), (0.030, 0.022), (0.030, 0.002), (0.028, -0.018)] {
        parts.add_pair(&ball(c + reach * lower + v * front, 0.0105, 5, 3), wrist);
    }
    let mut ray = |from: DVec3, mut along: DVec3, lengths: &[f64], radius: f64| {
        let mut start = from;
        for (i, &length) in lengths.iter().enumerate() {
            parts.add_pair(&small_bone(start, start + length * along, radius * (1.0 - 0.10 * i as f64)), wrist);
            start += (length + 0.006) * along;
            along = (along + 0.12 * inwards).normalize();
        }
    };
    for (v, spread, scale) in [(0.028, 0.16, 0.95), (0.009, 0.04, 1.0), (-0.010, -0.06, 0.96), (-0.028, -0.18, 0.82)] {
        let lengths = [0.062, 0.040, 0.026, 0.019].map(|length| scale * length);
        ray(c + 0.046 * lower + v * front, (lower + spread * front).normalize(), &lengths, 0.0072);
    }
    let thumb = (lower + 0.85 * front + 0.25 * inwards).normalize();
    ray(c + 0.030 * lower + 0.036 * front, thumb, &[0.044, 0.032, 0.024], 0.0080);
}

fn leg(parts: &mut Parts, skeleton: &Skeleton) {
    let [hip, knee, ankle] = LEGS[0];
    let [a, b, c] = LEGS[0].map(|joint| skeleton.joints[joint]);
    let (upper, lower) = ((b - a).normalize(), (c - b).normalize());
    let out = DVec3::X;
    // The neck of the thigh bone leads outwards, then down to the knee.
    let turn = a + DVec3::new(0.040, 0.0, -0.020);
    let bridge = [[0.0, 0.014], [0.5, 0.0135], [1.0, 0.019]];
    parts.add_pair(&lathe(a, turn - DVec3::Z * 0.008, 7, &bridge), hip);
    let thigh = long_bone(turn, b - 0.024 * upper, out, 0.0175, Some((a, 0.0245)), [0.020, 0.0265]);
    parts.add_pair(&thigh, hip);
    let shin = long_bone(b + 0.026 * lower, c - 0.022 * lower, out, 0.0155, None, [0.0225, 0.0165]);
    parts.add_pair(&shin, knee);
    let splint = out * 0.036 + DVec3::Y * 0.008;
    parts.add_pair(&thin_bone(b + 0.050 * lower + splint, c + 0.006 * lower + 0.8 * splint, 0.0082, 6), knee);
    parts.add_pair(&ball(b + DVec3::new(0.0, -0.036, 0.0), 0.019, 6, 3), knee);
    // Heel, ankle and the rays of the foot.
    let sole = DVec3::new(c.x, c.y, 0.0);
    let heel = [[0.0, 0.017, 0.015], [0.15, 0.024, 0.023], [0.6, 0.017, 0.018], [1.0, 0.020, 0.019]];
    let (from, to) = (sole + DVec3::new(0.0, 0.052, 0.025), sole + DVec3::new(0.0, -0.018, 0.042));
    parts.add_pair(&column(from, to, DVec3::X, 7, &heel), ankle);
    parts.add_pair(&ball(sole + DVec3::new(0.0, -0.010, 0.070), 0.020, 7, 4), ankle);
    for (x, y, z) in [(-0.015, -0.044, 0.050), (0.012, -0.042, 0.046), (0.030, -0.034, 0.036)] {
        parts.add_pair(&ball(sole + DVec3::new(x, y, z), 0.0135, 5, 3), ankle);
    }
    for i in 0..5 {
        let s = f64::from(i);
        let from = sole + DVec3::new(-0.024 + 0.0135 * s, -0.062 + 0.004 * s, 0.048 - 0.0065 * s);
        let ball_of_toe = sole + DVec3::new(-0.028 + 0.0215 * s, -0.130 + 0.0085 * s, 0.015);
        let radius = if i == 0 { 0.0105 } else { 0.0078 };
        parts.add_pair(&small_bone(from, ball_of_toe, radius), ankle);
        let along = DVec3::new(0.05 * (s - 1.0), -1.0, -0.05).normalize();
        let (first, second) = if i == 0 { (0.028, 0.022) } else { (0.022 - 0.002 * s, 0.015) };
        let start = ball_of_toe + 0.006 * along;
        parts.add_pair(&small_bone(start, start + first * along, 0.95 * radius), ankle);
        let start = start + (first + 0.005) * along;
        parts.add_pair(&small_bone(start, start + second * along, 0.85 * radius), ankle);
    }
}
