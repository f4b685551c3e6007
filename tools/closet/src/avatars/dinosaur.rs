//! The dinosaur: a trunk bent forward over digitigrade legs, a thick tail, a big head full of teeth. The hard case.

use glam::{DMat3, DVec3};

use super::super::Sample;
use super::super::implicit::{Field, Owner, Shape};
use super::super::loft::{Loft, Section};
use super::super::mesh::Mesh;
use super::super::parts::{Parts, modelled};
use super::super::skeleton::{ARMS, JOINTS, LEGS, NECK, ROOT, Skeleton, WAIST};
use super::super::skin::skin;
use super::super::tube::{ball, column, curve};

/// How far the trunk leans forward, in degrees from the vertical.
const LEAN: f64 = 50.0;

/// Models the dinosaur.
pub fn dinosaur() -> Sample {
    let skeleton = skeleton();
    let j = &skeleton.joints;
    let mut field = Field::default();
    trunk(&mut field, &skeleton);
    tail(&mut field, j[ROOT]);
    for (side, (arm_joints, leg_joints)) in [1.0, -1.0].into_iter().zip(ARMS.into_iter().zip(LEGS)) {
        arm(&mut field, side, arm_joints, &skeleton);
        leg(&mut field, side, leg_joints, &skeleton);
    }
    head(&mut field, j[NECK]);
    let field = field.finish();
    // Balls of finer triangles: centre, radius, edge length.
    let mut fine = vec![(j[NECK] + DVec3::new(0.0, -0.26, 0.09), 0.15, 0.0130)];
    fine.extend(tail_line(j[ROOT]).last().map(|&tip| (tip, 0.02, 0.010)));
    for ([_, elbow, wrist], [_, _, ankle]) in ARMS.into_iter().zip(LEGS) {
        fine.push((j[wrist] + 0.05 * (j[wrist] - j[elbow]).normalize(), 0.08, 0.0145));
        fine.push((toes(j[ankle]), 0.10, 0.018));
    }
    let edge_length = |p: DVec3| {
        let near = |&(centre, radius, edge): &(DVec3, f64, f64)| edge + 0.1 * (p.distance(centre) - radius).max(0.0);
        fine.iter().map(near).fold(0.032, f64::min)
    };
    let flesh = modelled(&field, 0.012, edge_length);
    let mut parts = Parts::default();
    let weights = skin(&flesh, &field);
    parts.add_skinned(&flesh, weights);
    teeth(&mut parts, j[NECK]);
    spikes(&mut parts, &skeleton);
    claws(&mut parts, &skeleton);
    parts.sample(skeleton)
}

fn skeleton() -> Skeleton {
    let mut joints = [DVec3::ZERO; JOINTS];
    let lean = LEAN.to_radians();
    let spine = DVec3::new(0.0, -lean.sin(), lean.cos());
    joints[ROOT] = DVec3::new(0.0, 0.080, 0.855);
    joints[WAIST] = joints[ROOT] + DVec3::new(0.0, -0.062, 0.088);
    joints[NECK] = joints[WAIST] + 0.440 * spine;
    for (side, ([shoulder, elbow, wrist], [hip, knee, ankle])) in
        [1.0, -1.0].into_iter().zip(ARMS.into_iter().zip(LEGS))
    {
        let out = |x: f64, y: f64, z: f64| DVec3::new(side * x, y, z).normalize();
        joints[shoulder] = joints[NECK] - 0.120 * spine + DVec3::new(side * 0.175, 0.0, -0.020);
        joints[elbow] = joints[shoulder] + 0.200 * out(0.62, 0.10, -0.78);
        joints[wrist] = joints[elbow] + 0.190 * out(0.60, -0.36, -0.76);
        joints[hip] = joints[ROOT] + DVec3::new(side * 0.115, 0.0, -0.052);
        joints[knee] = joints[hip] + 0.345 * out(0.16, -0.36, -0.92);
        joints[ankle] = joints[knee] + 0.320 * out(0.08, 0.42, -0.90);
    }
    Skeleton { joints }
}

/// Where the toes begin: before and below the ankle, which is off the ground.
fn toes(ankle: DVec3) -> DVec3 {
    DVec3::new(1.06 * ankle.x, ankle.y - 0.115, 0.040)
}

fn add(field: &mut Field, from: DVec3, to: DVec3, back: DVec3, sections: &[Section], blend: f64, owner: Owner) {
    field.add(Shape::Loft(Loft::new(from, to, back, sections)), blend, owner);
}

fn trunk(field: &mut Field, skeleton: &Skeleton) {
    let [root, waist, neck] = [ROOT, WAIST, NECK].map(|joint| skeleton.joints[joint]);
    let spine = Owner::Passage { joints: [ROOT, WAIST], height: waist.z, reach: 0.08 };
    let axis = (neck - waist).normalize();
    let section = |t: f64, width: f64, front: f64, back: f64| Section { t, centre: [0.0; 2], width, front, back };
    // From the rump to the neck; the front of a section is the belly.
    let sections = [
        section(0.00, 0.120, 0.120, 0.085),
        section(0.18, 0.132, 0.130, 0.092),
        section(0.42, 0.140, 0.142, 0.100),
        section(0.66, 0.156, 0.150, 0.112),
        section(0.84, 0.140, 0.125, 0.105),
        section(1.00, 0.085, 0.080, 0.085),
    ];
    add(field, root + DVec3::new(0.0, 0.035, -0.010), neck - 0.02 * axis, DVec3::Y, &sections, 0.05, spine);
    let belly = root.lerp(neck, 0.38) + DVec3::new(0.0, -0.020, -0.085);
    let turned = DMat3::from_rotation_x(-0.5);
    let radii = DVec3::new(0.118, 0.175, 0.095);
    field.add(Shape::Ellipsoid { centre: belly, radii, rotation: turned }, 0.06, spine);
    for side in [1.0, -1.0] {
        let shoulder = skeleton.joints[ARMS[0][0]] * DVec3::new(side, 1.0, 1.0);
        let breast = shoulder.lerp(neck, 0.45) + DVec3::new(0.0, -0.010, -0.075);
        field.add(Shape::ellipsoid(breast, DVec3::new(0.066, 0.058, 0.064)), 0.05, Owner::Joint(WAIST));
        let blade = shoulder - 0.05 * axis + DVec3::new(-side * 0.055, 0.050, 0.050);
        let radii = DVec3::new(0.062, 0.095, 0.055);
        field.add(
            Shape::Ellipsoid { centre: blade, radii, rotation: DMat3::from_rotation_x(-0.7) },
            0.06,
            Owner::Joint(WAIST),
        );
    }
}

/// The tail's middle line, from the rump. Short and low, for whatever covers the rump has to go over it.
fn tail_line(root: DVec3) -> Vec<DVec3> {
    let knots = [(0.02, -0.02), (0.12, -0.07), (0.22, -0.14), (0.32, -0.22), (0.42, -0.28), (0.52, -0.30)];
    curve(&knots.map(|(y, z)| root + DVec3::new(0.0, y, z)), 3)
}

/// Half the tail's thickness at each point of its line.
fn tail_radius(t: f64) -> f64 {
    0.014 + 0.108 * (1.0 - t).powf(1.25)
}

fn tail(field: &mut Field, root: DVec3) {
    let line = tail_line(root);
    let last = line.len() - 1;
    for i in 0..last {
        let [r, s] = [i, i + 1].map(|k| tail_radius(k as f64 / last as f64));
        let sections = [Section::ellipse(0.0, 0.92 * r, 1.08 * r), Section::ellipse(1.0, 0.92 * s, 1.08 * s)];
        let blend = if i == 0 { 0.06 } else { 0.002 };
        add(field, line[i], line[i + 1], DVec3::Z, &sections, blend, Owner::Joint(ROOT));
    }
}

fn arm(field: &mut Field, side: f64, [shoulder, elbow, wrist]: [usize; 3], skeleton: &Skeleton) {
    let [a, b, c] = [shoulder, elbow, wrist].map(|joint| skeleton.joints[joint]);
    let upper = [
        Section::ellipse(0.0, 0.058, 0.066),
        Section::ellipse(0.3, 0.058, 0.064),
        Section::ellipse(0.65, 0.048, 0.053),
        Section::ellipse(1.0, 0.038, 0.040),
    ];
    let inner = a - DVec3::new(side * 0.050, 0.0, -0.010);
    add(field, inner, b, DVec3::Y, &upper, 0.05, Owner::Joint(shoulder));
    let lower = [
        Section::ellipse(0.0, 0.038, 0.040),
        Section::ellipse(0.28, 0.044, 0.046),
        Section::ellipse(0.7, 0.032, 0.034),
        Section::ellipse(1.0, 0.025, 0.029),
    ];
    add(field, b, c, DVec3::Y, &lower, 0.02, Owner::Joint(elbow));
    let palm = [Section::ellipse(0.0, 0.023, 0.030), Section::ellipse(1.0, 0.022, 0.044)];
    let [along, ..] = hand(b, c);
    add(field, c, c + 0.052 * along, DVec3::Y, &palm, 0.02, Owner::Joint(wrist));
    for [knuckle, bend, tip] in fingers(b, c) {
        for (p, q, r, s) in [(knuckle, bend, 0.0170, 0.0155), (bend, tip, 0.0155, 0.0130)] {
            add(field, p, q, DVec3::Y, &[Section::circle(0.0, r), Section::circle(1.0, s)], 0.010, Owner::Joint(wrist));
        }
    }
}

/// Along the hand, forwards across it, and out of the palm.
fn hand(elbow: DVec3, wrist: DVec3) -> [DVec3; 3] {
    let along = (wrist - elbow).normalize();
    let front = DVec3::NEG_Y.reject_from_normalized(along).normalize();
    let palm = along.cross(front);
    [along, front, if palm.x * wrist.x < 0.0 { palm } else { -palm }]
}

/// Knuckle, bend and tip of the three fingers.
fn fingers(elbow: DVec3, wrist: DVec3) -> [[DVec3; 3]; 3] {
    let [along, front, palm] = hand(elbow, wrist);
    [(0.042, 0.030, 0.060), (0.0, 0.050, 0.0), (-0.040, 0.046, -0.045)].map(|(across, start, spread)| {
        let knuckle = wrist + start * along + across * front;
        let bend = knuckle + 0.052 * (along + 8.0 * spread * front).normalize();
        [knuckle, bend, bend + 0.046 * (along + 5.0 * spread * front + 0.7 * palm).normalize()]
    })
}

fn leg(field: &mut Field, side: f64, [hip, knee, ankle]: [usize; 3], skeleton: &Skeleton) {
    let [a, b, c] = [hip, knee, ankle].map(|joint| skeleton.joints[joint]);
    let thigh = [
        Section::ellipse(0.0, 0.092, 0.125).moved(-side * 0.006, 0.0),
        Section::ellipse(0.35, 0.090, 0.122),
        Section::ellipse(0.72, 0.070, 0.086),
        Section::ellipse(1.0, 0.053, 0.060),
    ];
    add(field, a, b, DVec3::Y, &thigh, 0.05, Owner::Joint(hip));
    let shin = [
        Section::ellipse(0.0, 0.053, 0.060),
        Section::ellipse(0.26, 0.058, 0.072).moved(0.0, 0.012),
        Section::ellipse(0.66, 0.040, 0.046).moved(0.0, 0.004),
        Section::ellipse(1.0, 0.034, 0.038),
    ];
    add(field, b, c, DVec3::Y, &shin, 0.025, Owner::Joint(knee));
    let own = Owner::Joint(ankle);
    let foot = toes(c);
    let instep =
        [Section::ellipse(0.0, 0.034, 0.036), Section::ellipse(0.5, 0.032, 0.030), Section::ellipse(1.0, 0.050, 0.036)];
    add(field, c, foot, DVec3::Y, &instep, 0.02, own);
    for [from, to] in toe_lines(c) {
        let bend = from.lerp(to, 0.55) + DVec3::Z * 0.010;
        for (p, q, r, s) in [(from, bend, 0.034, 0.030), (bend, to, 0.030, 0.021)] {
            add(field, p, q, DVec3::Z, &[Section::circle(0.0, r), Section::circle(1.0, s)], 0.014, own);
        }
    }
    field.carve(Shape::Below { height: 0.0 }, 0.010, own);
}

/// Beginning and end of the three toes.
fn toe_lines(ankle: DVec3) -> [[DVec3; 2]; 3] {
    let foot = toes(ankle);
    let side = ankle.x.signum();
    [(-0.075, -0.120), (0.010, -0.155), (0.090, -0.110)].map(|(x, y)| {
        let tip = DVec3::new(foot.x + side * x, foot.y + y, 0.024);
        [foot + DVec3::new(0.4 * side * x, 0.0, -0.006), tip]
    })
}

fn head(field: &mut Field, neck: DVec3) {
    let own = Owner::Joint(NECK);
    let at = |x: f64, y: f64, z: f64| neck + DVec3::new(x, y, z);
    let passage = Owner::Passage { joints: [WAIST, NECK], height: neck.z, reach: 0.06 };
    let throat =
        [Section::ellipse(0.0, 0.092, 0.100), Section::ellipse(0.5, 0.078, 0.086), Section::ellipse(1.0, 0.074, 0.082)];
    add(field, at(0.0, 0.060, -0.055), at(0.0, -0.075, 0.120), DVec3::Y, &throat, 0.05, passage);
    let skull = [
        Section { t: 0.0, centre: [0.0; 2], width: 0.088, front: 0.070, back: 0.072 },
        Section { t: 0.35, centre: [0.0; 2], width: 0.086, front: 0.052, back: 0.068 },
        Section { t: 0.62, centre: [0.0; 2], width: 0.058, front: 0.040, back: 0.050 },
        Section { t: 0.88, centre: [0.0; 2], width: 0.052, front: 0.036, back: 0.042 },
        Section { t: 1.0, centre: [0.0; 2], width: 0.042, front: 0.030, back: 0.034 },
    ];
    let skull = Loft::new(at(0.0, -0.080, 0.150), at(0.0, -0.360, 0.112), DVec3::Z, &skull).capped(0.7);
    field.add(Shape::Loft(skull), 0.03, own);
    let jaw = [
        Section::ellipse(0.0, 0.072, 0.038),
        Section::ellipse(0.55, 0.048, 0.024),
        Section::ellipse(1.0, 0.036, 0.018),
    ];
    add(field, at(0.0, -0.105, 0.078), at(0.0, -0.325, 0.008), DVec3::Z, &jaw, 0.016, own);
    for side in [1.0, -1.0] {
        let cheek = at(side * 0.058, -0.110, 0.100);
        field.add(Shape::ellipsoid(cheek, DVec3::new(0.034, 0.050, 0.048)), 0.03, own);
        let socket = at(side * 0.086, -0.168, 0.172);
        field.carve(Shape::ellipsoid(socket, DVec3::new(0.026, 0.028, 0.022)), 0.012, own);
        let brow = [Section::circle(0.0, 0.017), Section::circle(0.6, 0.019), Section::circle(1.0, 0.012)];
        add(field, at(side * 0.068, -0.105, 0.212), at(side * 0.058, -0.215, 0.182), DVec3::Z, &brow, 0.016, own);
        field.add(Shape::ellipsoid(at(side * 0.064, -0.165, 0.172), DVec3::splat(0.020)), 0.004, own);
        let bridge = [Section::circle(0.0, 0.013), Section::circle(1.0, 0.017)];
        add(field, at(side * 0.026, -0.230, 0.172), at(side * 0.024, -0.350, 0.142), DVec3::Z, &bridge, 0.020, own);
        field.carve(Shape::ellipsoid(at(side * 0.030, -0.388, 0.138), DVec3::new(0.009, 0.014, 0.008)), 0.008, own);
    }
}

/// A flat or round spike from `foot` to `tip`; the half-axes of its foot are along `first` and across.
fn spike(foot: DVec3, tip: DVec3, first: DVec3, [u, v]: [f64; 2], sides: usize) -> Mesh {
    column(foot, tip, first, sides, &[[0.0, u, v], [0.55, 0.62 * u, 0.62 * v], [0.96, 0.10 * u, 0.10 * v]])
}

fn teeth(parts: &mut Parts, neck: DVec3) {
    for i in 0..7 {
        let t = f64::from(i) / 6.0;
        // Along the rim of the snout, from the tip to the corner of the mouth.
        let width = 0.030 + 0.022 * (t * 3.0).min(1.0) + 0.010 * t;
        let foot = neck + DVec3::new(width - 0.010, -0.372 + 0.185 * t, 0.092 + 0.012 * t);
        let length = if i == 1 || i == 3 { 0.044 } else { 0.034 };
        let tip = foot + DVec3::new(0.004, 0.004, -length);
        parts.add_pair(&spike(foot, tip, DVec3::Y, [0.010, 0.007], 5), NECK);
        if i < 6 {
            let foot = neck + DVec3::new(0.024 + 0.020 * t, -0.330 + 0.150 * t, 0.018 + 0.045 * t);
            parts.add_pair(&spike(foot, foot + DVec3::new(0.003, 0.0, 0.034), DVec3::Y, [0.009, 0.006], 5), NECK);
        }
    }
    let eye = neck + DVec3::new(0.068, -0.170, 0.172);
    parts.add_pair(&ball(eye, 0.0185, 9, 5), NECK);
}

fn spikes(parts: &mut Parts, skeleton: &Skeleton) {
    let [root, waist, neck] = [ROOT, WAIST, NECK].map(|joint| skeleton.joints[joint]);
    // Down the head and the neck, the back and the tail: foot, direction, height, length of the foot, joint.
    let mut crest = Vec::new();
    for (y, z, height) in
        [(-0.130, 0.205, 0.040), (-0.070, 0.208, 0.055), (-0.010, 0.160, 0.062), (0.040, 0.105, 0.058)]
    {
        crest.push((neck + DVec3::new(0.0, y, z), DVec3::new(0.0, 0.75, 0.75), height, NECK));
    }
    let spine = (neck - waist).normalize();
    let dorsal = DVec3::new(0.0, spine.z, -spine.y);
    for (t, height) in [(0.72, 0.034), (0.52, 0.030), (0.32, 0.028), (0.12, 0.028)] {
        let foot = waist.lerp(neck, t) + (0.078 + 0.026 * t) * dorsal;
        crest.push((foot, dorsal + 0.5 * DVec3::Y, height, WAIST));
    }
    let line = tail_line(root);
    let last = line.len() - 1;
    for i in (2..last).step_by(3) {
        let t = i as f64 / last as f64;
        let tangent = (line[i + 1] - line[i - 1]).normalize();
        let up = DVec3::Z.reject_from_normalized(tangent).normalize();
        crest.push((line[i] + 1.04 * tail_radius(t) * up, up + 0.6 * tangent, 0.072 - 0.040 * t, ROOT));
    }
    for (foot, direction, height, joint) in crest {
        let direction = direction.normalize();
        let plate =
            spike(foot - 0.012 * direction, foot + height * direction, DVec3::Y, [0.55 * height + 0.006, 0.011], 6);
        parts.add(&plate, joint);
    }
}

fn claws(parts: &mut Parts, skeleton: &Skeleton) {
    for joints in ARMS {
        let [_, elbow, wrist] = joints.map(|joint| skeleton.joints[joint]);
        let [along, _, palm] = hand(elbow, wrist);
        for [_, bend, tip] in fingers(elbow, wrist) {
            let end = tip + 0.040 * ((tip - bend).normalize() + 0.35 * palm + 0.2 * along).normalize();
            parts.add(&spike(tip, end, palm, [0.0115, 0.009], 6), joints[2]);
        }
    }
    for joints in LEGS {
        for [from, to] in toe_lines(skeleton.joints[joints[2]]) {
            let along = (to - from).normalize();
            let foot = to + 0.006 * along;
            let tip = to + 0.058 * along - DVec3::Z * 0.012;
            parts.add(&spike(foot, tip, DVec3::Z, [0.016, 0.013], 6), joints[2]);
        }
    }
}
