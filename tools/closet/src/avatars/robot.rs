//! The robot: bevelled plates on cylinders and ball joints, with looms of thin cables from the trunk to head and limbs.

use glam::{DAffine3, DVec3};

use super::super::Sample;
use super::super::mesh::Mesh;
use super::super::parts::{Parts, moved, placed};
use super::super::polyhedron::Polyhedron;
use super::super::skeleton::{ARMS, LEGS, NECK, Proportions, ROOT, Skeleton, WAIST};
use super::super::tube::{ball, curve, lathe, tube};

/// Models the robot.
pub fn robot() -> Sample {
    let skeleton = Proportions {
        ankle: 0.100,
        shin: 0.420,
        thigh: 0.400,
        leg_angle: 8.0,
        hip: 0.120,
        belly: 0.110,
        chest: 0.440,
        hunch: 0.010,
        shoulder: 0.215,
        shoulder_drop: 0.110,
        upper_arm: 0.280,
        forearm: 0.270,
        arm_angle: 52.0,
    }
    .skeleton();
    let mut parts = Parts::default();
    trunk(&mut parts, &skeleton);
    head(&mut parts, skeleton.joints[NECK]);
    arms(&mut parts, &skeleton);
    legs(&mut parts, &skeleton);
    cables(&mut parts, &skeleton);
    parts.sample(skeleton)
}

/// A box with these half-axes, cut by planes (normal and offset), and with its edges bevelled (unless by 0).
fn plate(half: [f64; 3], bevel: f64, cuts: &[([f64; 3], f64)]) -> Polyhedron {
    let mut plate = Polyhedron::cuboid(DVec3::from_array(half));
    for &(normal, offset) in cuts {
        let normal = DVec3::from_array(normal);
        plate.cut(normal.normalize(), offset / normal.length());
    }
    if bevel > 0.0 { plate.bevelled(bevel).welded(0.0005) } else { plate }
}

fn at(place: DVec3) -> DAffine3 {
    DAffine3::from_translation(place)
}

/// A plain cylinder from `start` to `end`.
fn rod(start: DVec3, end: DVec3, radius: f64, sides: usize) -> Mesh {
    lathe(start, end, sides, &[[0.0, radius], [1.0, radius]])
}

/// A cylinder with bevelled rims from `start` to `end`.
fn cylinder(start: DVec3, end: DVec3, radius: f64, sides: usize) -> Mesh {
    let bevel = (0.15 * radius).min(0.006);
    let edge = bevel / start.distance(end);
    let profile = [[0.0, radius - bevel], [edge, radius], [1.0 - edge, radius], [1.0, radius - bevel]];
    lathe(start, end, sides, &profile)
}

/// A round disc of `radius` that stands out by `height` along `axis`, with a hollow rim.
fn cap(place: DVec3, axis: DVec3, radius: f64, height: f64, sides: usize) -> Mesh {
    let profile = [[0.0, radius], [0.8, radius], [1.0, 0.80 * radius], [1.0, 0.56 * radius], [0.5, 0.50 * radius]];
    lathe(place, place + height * axis.normalize(), sides, &profile)
}

fn trunk(parts: &mut Parts, skeleton: &Skeleton) {
    let [root, waist, neck] = [ROOT, WAIST, NECK].map(|joint| skeleton.joints[joint]);
    // Pelvis: a block cut away above the thighs, with a guard in front and behind.
    let pelvis = plate([0.135, 0.085, 0.075], 0.010, &[([0.9, 0.0, -1.0], 0.105), ([-0.9, 0.0, -1.0], 0.105)]);
    parts.add(&moved(&pelvis.mesh(), &at(root + DVec3::new(0.0, 0.0, -0.020))), ROOT);
    let guard = plate([0.056, 0.014, 0.066], 0.007, &[([1.0, 0.0, -0.5], 0.052), ([-1.0, 0.0, -0.5], 0.052)]);
    for y in [-0.094, 0.094] {
        parts.add(&moved(&guard.mesh(), &at(root + DVec3::new(0.0, y, -0.025))), ROOT);
    }
    // The waist: a bellows of discs around a column, with two pistons.
    let bellows: Vec<[f64; 2]> = (0..9).map(|i| [i as f64 / 8.0, if i % 2 == 0 { 0.074 } else { 0.090 }]).collect();
    parts.add_between(&lathe(root + DVec3::Z * 0.050, waist + DVec3::Z * 0.070, 12, &bellows), [ROOT, WAIST], |p| {
        (p.z - root.z - 0.050) / (waist.z - root.z)
    });
    for y in [-0.060, 0.060] {
        let foot = root + DVec3::new(0.092, y, 0.045);
        let head = waist + DVec3::new(0.105, y, 0.090);
        let middle = foot.lerp(head, 0.55);
        parts.add_pair(&cylinder(foot, middle, 0.016, 8), ROOT);
        parts.add_pair(&rod(foot.lerp(head, 0.40), head, 0.009, 6), WAIST);
    }
    // Chest: a broad block, narrow below; plates in front, a pack with vents behind.
    let chest = waist.lerp(neck, 0.55) + DVec3::new(0.0, 0.004, 0.0);
    let sides = [([1.0, 0.0, -0.42], 0.178), ([-1.0, 0.0, -0.42], 0.178), ([0.0, -0.55, 1.0], 0.165)];
    parts.add(&moved(&plate([0.195, 0.110, 0.160], 0.016, &sides).mesh(), &at(chest)), WAIST);
    let breast = plate(
        [0.080, 0.016, 0.072],
        0.008,
        &[([1.0, 0.0, -0.5], 0.080), ([-1.0, 0.0, -1.1], 0.098), ([0.0, -1.0, 0.35], 0.024)],
    );
    parts.add_pair(&moved(&breast.mesh(), &at(chest + DVec3::new(0.090, -0.112, 0.042))), WAIST);
    let lamp = chest + DVec3::new(0.0, -0.106, -0.030);
    parts.add(&cap(lamp, DVec3::NEG_Y, 0.040, 0.026, 16), WAIST);
    for i in 0..3 {
        let rib = plate([0.062 - 0.010 * i as f64, 0.012, 0.008], 0.0, &[]);
        parts.add(&moved(&rib.mesh(), &at(chest + DVec3::new(0.0, -0.106, -0.090 - 0.024 * i as f64))), WAIST);
    }
    let pack = plate([0.125, 0.045, 0.115], 0.014, &[([0.0, 1.0, 0.45], 0.062), ([0.0, 1.0, -0.45], 0.066)]);
    parts.add(&moved(&pack.mesh(), &at(chest + DVec3::new(0.0, 0.130, 0.020))), WAIST);
    for i in 0..4 {
        let vent = plate([0.042, 0.008, 0.007], 0.0, &[]);
        let place = chest + DVec3::new(0.060, 0.176, 0.075 - 0.026 * i as f64);
        parts.add_pair(&moved(&vent.mesh(), &at(place)), WAIST);
    }
    let nozzle = chest + DVec3::new(0.070, 0.140, -0.090);
    let profile = [[0.0, 0.024], [0.5, 0.026], [1.0, 0.036], [1.0, 0.029], [0.6, 0.020]];
    parts.add_pair(&lathe(nozzle, nozzle + DVec3::new(0.0, 0.020, -0.055), 10, &profile), WAIST);
    // The collar, and bolts on the chest.
    let rim = [[0.0, 0.098], [0.55, 0.098], [1.0, 0.084], [1.0, 0.068], [0.5, 0.064]];
    parts.add(&lathe(neck - DVec3::Z * 0.055, neck - DVec3::Z * 0.010, 16, &rim), WAIST);
    for (x, z) in [(0.160, 0.098), (0.028, 0.098), (0.150, -0.010)] {
        let place = chest + DVec3::new(x, -0.118 - 0.20 * (z - 0.04f64).min(0.0), z);
        parts.add_pair(&rod(place, place + DVec3::NEG_Y * 0.020, 0.008, 6), WAIST);
    }
}

fn head(parts: &mut Parts, neck: DVec3) {
    let at_head = |x: f64, y: f64, z: f64| neck + DVec3::new(x, y, z);
    let rings: Vec<[f64; 2]> = (0..9).map(|i| [i as f64 / 8.0, if i % 2 == 0 { 0.042 } else { 0.050 }]).collect();
    parts.add_between(&lathe(at_head(0.0, 0.010, -0.030), at_head(0.0, 0.0, 0.060), 12, &rings), [WAIST, NECK], |p| {
        (p.z - neck.z + 0.030) / 0.080
    });
    let skull = plate(
        [0.088, 0.102, 0.090],
        0.014,
        &[([0.0, 1.0, 1.0], 0.150), ([0.0, -0.6, 1.0], 0.125), ([1.0, 0.0, 0.5], 0.118), ([-1.0, 0.0, 0.5], 0.118)],
    );
    parts.add(&moved(&skull.mesh(), &at(at_head(0.0, -0.010, 0.140))), NECK);
    let jaw = plate(
        [0.070, 0.050, 0.036],
        0.009,
        &[([0.0, -1.0, -0.9], 0.064), ([1.0, -0.6, 0.0], 0.086), ([-1.0, -0.6, 0.0], 0.086)],
    );
    parts.add(&moved(&jaw.mesh(), &at(at_head(0.0, -0.082, 0.070))), NECK);
    for i in -2..=2 {
        let slot = plate([0.006, 0.006, 0.018], 0.0, &[]);
        parts.add(&moved(&slot.mesh(), &at(at_head(0.020 * f64::from(i), -0.132, 0.078))), NECK);
    }
    // A visor, with one brow above and two eyes within.
    let visor = plate([0.078, 0.018, 0.024], 0.006, &[([1.0, -0.8, 0.0], 0.080), ([-1.0, -0.8, 0.0], 0.080)]);
    parts.add(&moved(&visor.mesh(), &at(at_head(0.0, -0.112, 0.142))), NECK);
    parts.add_pair(&cap(at_head(0.034, -0.126, 0.142), DVec3::NEG_Y, 0.016, 0.014, 10), NECK);
    let brow = plate([0.090, 0.030, 0.012], 0.005, &[([1.0, -1.0, 0.0], 0.100), ([-1.0, -1.0, 0.0], 0.100)]);
    parts.add(&moved(&brow.mesh(), &placed(at_head(0.0, -0.098, 0.176), DVec3::new(0.0, 0.25, 1.0), DVec3::X)), NECK);
    // Ears with antennas: the left one long.
    parts.add_pair(&cap(at_head(0.082, 0.005, 0.140), DVec3::X, 0.038, 0.030, 12), NECK);
    for (side, length) in [(1.0, 0.230), (-1.0, 0.120)] {
        let foot = at_head(side * 0.098, 0.015, 0.150);
        let tip = foot + DVec3::new(side * 0.030, 0.040, length);
        let profile = [[0.0, 0.009], [0.22, 0.009], [0.24, 0.0035], [0.97, 0.0030], [1.0, 0.0025]];
        parts.add(&lathe(foot, tip, 6, &profile), NECK);
        parts.add(&ball(tip, 0.010, 6, 3), NECK);
    }
    let crest = plate([0.014, 0.085, 0.020], 0.006, &[([0.0, -1.0, 1.0], 0.075)]);
    parts.add(&moved(&crest.mesh(), &at(at_head(0.0, 0.0, 0.228))), NECK);
}

fn arms(parts: &mut Parts, skeleton: &Skeleton) {
    let [shoulder, elbow, wrist] = ARMS[0];
    let [a, b, c] = ARMS[0].map(|joint| skeleton.joints[joint]);
    let (upper, lower) = ((b - a).normalize(), (c - b).normalize());
    let (length, reach) = (a.distance(b), b.distance(c));
    parts.add_pair(&rod(a - DVec3::X * 0.070, a + DVec3::X * 0.030, 0.040, 10), WAIST);
    parts.add_pair(&ball(a + 0.020 * DVec3::X, 0.068, 12, 6), shoulder);
    // The shoulder plate stands out and up, its outer edge cut.
    let guard = plate(
        [0.080, 0.088, 0.050],
        0.012,
        &[([1.0, 0.0, 0.9], 0.088), ([0.0, 1.0, 0.8], 0.100), ([0.0, -1.0, 0.8], 0.100), ([-1.0, 0.0, -1.0], 0.088)],
    );
    let tilt = DVec3::new(0.45, 0.0, 1.0);
    parts.add_pair(&moved(&guard.mesh(), &placed(a + DVec3::new(0.056, 0.0, 0.048), tilt, DVec3::X)), shoulder);
    parts.add_pair(&rod(a + 0.03 * upper, b, 0.030, 10), shoulder);
    let shell = plate([0.046, 0.052, 0.068], 0.010, &[([1.0, 0.0, 0.35], 0.052), ([-1.0, 0.0, 0.35], 0.052)]);
    parts.add_pair(&moved(&shell.mesh(), &placed(a + 0.56 * length * upper, upper, DVec3::X)), shoulder);
    // The elbow: an axle across, with caps.
    let axle = lower.cross(DVec3::X.reject_from_normalized(lower)).normalize();
    parts.add_pair(&cylinder(b - 0.044 * axle, b + 0.044 * axle, 0.040, 12), elbow);
    for end in [1.0, -1.0] {
        parts.add_pair(&cap(b + end * 0.040 * axle, end * axle, 0.026, 0.014, 9), elbow);
    }
    // The forearm widens towards the wrist.
    let sleeve = plate(
        [0.052, 0.060, 0.086],
        0.012,
        &[
            ([1.0, 0.0, -0.16], 0.048),
            ([-1.0, 0.0, -0.16], 0.048),
            ([0.0, 1.0, -0.2], 0.056),
            ([0.0, -1.0, -0.2], 0.056),
        ],
    );
    parts.add_pair(&rod(b, c + 0.015 * lower, 0.027, 10), elbow);
    parts.add_pair(&moved(&sleeve.mesh(), &placed(b + 0.60 * reach * lower, lower, DVec3::X)), elbow);
    let front = DVec3::NEG_Y.reject_from_normalized(lower).normalize();
    let outwards = front.cross(lower) * front.cross(lower).x.signum();
    let fin = plate([0.010, 0.030, 0.060], 0.004, &[([0.0, 0.0, 1.0], 0.060)]);
    parts.add_pair(&moved(&fin.mesh(), &placed(b + 0.62 * reach * lower + 0.052 * outwards, lower, outwards)), elbow);
    parts.add_pair(&cylinder(c, c + 0.030 * lower, 0.036, 10), wrist);
    // The hand: a block, three jointed fingers and a thumb.
    let palm = plate([0.026, 0.046, 0.040], 0.008, &[]);
    let motion = placed(c + 0.066 * lower, lower, outwards);
    parts.add_pair(&moved(&palm.mesh(), &motion), wrist);
    for across in [-0.032, 0.0, 0.032] {
        let knuckle = c + 0.108 * lower + across * front;
        let bend = knuckle + 0.046 * lower + 0.006 * outwards;
        let tip = bend + 0.046 * (lower - 0.7 * outwards).normalize();
        parts.add_pair(&rod(knuckle, bend, 0.011, 6), wrist);
        parts.add_pair(&lathe(bend, tip, 6, &[[0.0, 0.011], [0.1, 0.013], [0.8, 0.010], [1.0, 0.006]]), wrist);
    }
    let base = c + 0.055 * lower + 0.044 * front - 0.012 * outwards;
    let middle = base + 0.040 * (lower + 0.9 * front - 0.5 * outwards).normalize();
    parts.add_pair(&rod(base, middle, 0.013, 6), wrist);
    let tip = middle + 0.042 * (lower - 0.3 * outwards).normalize();
    parts.add_pair(&lathe(middle, tip, 6, &[[0.0, 0.011], [0.1, 0.013], [0.8, 0.010], [1.0, 0.006]]), wrist);
}

fn legs(parts: &mut Parts, skeleton: &Skeleton) {
    let [hip, knee, ankle] = LEGS[0];
    let [a, b, c] = LEGS[0].map(|joint| skeleton.joints[joint]);
    let (upper, lower) = ((b - a).normalize(), (c - b).normalize());
    let (length, reach) = (a.distance(b), b.distance(c));
    parts.add_pair(&ball(a + DVec3::new(0.012, 0.0, -0.010), 0.062, 12, 6), hip);
    parts.add_pair(&cap(a + DVec3::new(0.060, 0.0, -0.005), DVec3::X, 0.044, 0.030, 12), hip);
    parts.add_pair(&rod(a, b, 0.038, 10), hip);
    let thigh = plate(
        [0.066, 0.074, 0.118],
        0.014,
        &[([1.0, 0.0, 0.16], 0.062), ([-1.0, 0.0, 0.16], 0.062), ([0.0, 1.0, 0.18], 0.072), ([0.0, -1.0, 0.12], 0.070)],
    );
    parts.add_pair(&moved(&thigh.mesh(), &placed(a + 0.53 * length * upper, upper, DVec3::X)), hip);
    let pocket = plate([0.010, 0.040, 0.062], 0.005, &[([0.0, 1.0, 0.5], 0.050)]);
    parts.add_pair(&moved(&pocket.mesh(), &placed(a + 0.52 * length * upper + DVec3::X * 0.066, upper, DVec3::X)), hip);
    // The knee: an axle with caps, and a shield in front.
    parts.add_pair(&cylinder(b - DVec3::X * 0.050, b + DVec3::X * 0.050, 0.048, 12), knee);
    for end in [1.0, -1.0] {
        parts.add_pair(&cap(b + end * 0.046 * DVec3::X, end * DVec3::X, 0.032, 0.014, 9), knee);
    }
    let shield = plate(
        [0.042, 0.016, 0.052],
        0.008,
        &[([1.0, 0.0, 0.7], 0.052), ([-1.0, 0.0, 0.7], 0.052), ([1.0, 0.0, -0.7], 0.056), ([-1.0, 0.0, -0.7], 0.056)],
    );
    parts.add_pair(&moved(&shield.mesh(), &placed(b + DVec3::new(0.0, -0.056, 0.004), -lower, DVec3::X)), knee);
    // The shin: broad as a boot below, with a calf behind and a piston.
    parts.add_pair(&rod(b, c, 0.032, 10), knee);
    let boot = plate(
        [0.068, 0.076, 0.132],
        0.014,
        &[
            ([1.0, 0.0, -0.20], 0.056),
            ([-1.0, 0.0, -0.20], 0.056),
            ([0.0, 1.0, 0.10], 0.070),
            ([0.0, -1.0, -0.16], 0.064),
        ],
    );
    parts.add_pair(&moved(&boot.mesh(), &placed(b + 0.58 * reach * lower, lower, DVec3::X)), knee);
    let calf = plate([0.036, 0.022, 0.080], 0.010, &[([0.0, -1.0, 0.3], 0.026), ([0.0, -1.0, -0.3], 0.026)]);
    let behind = b + 0.50 * reach * lower + DVec3::Y * 0.074;
    parts.add_pair(&moved(&calf.mesh(), &placed(behind, lower, DVec3::X)), knee);
    // The foot.
    let sole = DVec3::new(c.x, c.y, 0.0);
    parts.add_pair(&ball(c, 0.048, 10, 5), ankle);
    let heel = plate([0.052, 0.064, 0.040], 0.010, &[([0.0, 1.0, 1.0], 0.078)]);
    parts.add_pair(&moved(&heel.mesh(), &at(sole + DVec3::new(0.0, 0.014, 0.044))), ankle);
    let toe = plate(
        [0.062, 0.078, 0.036],
        0.010,
        &[([0.0, -0.55, 1.0], 0.042), ([1.0, -0.6, 0.0], 0.088), ([-1.0, -0.6, 0.0], 0.088)],
    );
    parts.add_pair(&moved(&toe.mesh(), &at(sole + DVec3::new(0.008, -0.110, 0.036))), ankle);
}

/// A cable through `knots`, from one joint's part to another's.
fn cable(parts: &mut Parts, knots: &[DVec3], radius: f64, pieces: usize, joints: [usize; 2]) {
    let points = curve(knots, pieces);
    let wire = tube(&points, DVec3::new(0.3, 0.2, 1.0), 5, 0.0, |_| [radius; 2]);
    let (start, end) = (knots[0], knots[knots.len() - 1]);
    parts.add_pair_between(&wire, joints, |p| {
        let t = p.distance(start) / (p.distance(start) + p.distance(end));
        t * t * (3.0 - 2.0 * t)
    });
}

fn cables(parts: &mut Parts, skeleton: &Skeleton) {
    let [root, waist, neck] = [ROOT, WAIST, NECK].map(|joint| skeleton.joints[joint]);
    let chest = waist.lerp(neck, 0.55);
    let [a, b, _] = ARMS[0].map(|joint| skeleton.joints[joint]);
    let [hip, knee, _] = LEGS[0].map(|joint| skeleton.joints[joint]);
    let upper = (b - a).normalize();
    let point = |from: DVec3, x: f64, y: f64, z: f64| from + DVec3::new(x, y, z);
    for i in 0..3 {
        let s = i as f64;
        // From the pack to the back of the head.
        let knots = [
            point(chest, 0.030 + 0.022 * s, 0.130, 0.130),
            point(neck, 0.034 + 0.020 * s, 0.130 - 0.012 * s, 0.010),
            point(neck, 0.030 + 0.014 * s, 0.125 - 0.010 * s, 0.080),
            point(neck, 0.026 + 0.014 * s, 0.075, 0.115),
        ];
        cable(parts, &knots, 0.0064, 3, [WAIST, NECK]);
        // From the pack over the back of the shoulder into the upper arm.
        let knots = [
            point(chest, 0.115, 0.125, 0.090 - 0.035 * s),
            point(a, -0.010, 0.125 - 0.006 * s, -0.030 - 0.030 * s),
            a + (0.080 + 0.020 * s) * upper + DVec3::new(0.020 - 0.020 * s, 0.090, 0.0),
            a + (0.140 + 0.006 * s) * upper + DVec3::new(0.012 - 0.014 * s, 0.044, 0.0),
        ];
        cable(parts, &knots, 0.0064, 3, [WAIST, ARMS[0][0]]);
    }
    for i in 0..2 {
        let s = i as f64;
        // Under the chest, around the waist to the pelvis, and on into the thigh.
        let knots = [
            point(chest, 0.050 + 0.028 * s, -0.070, -0.140),
            point(waist, 0.066 + 0.030 * s, -0.108, 0.020),
            point(root, 0.070 + 0.026 * s, -0.078, 0.035),
        ];
        cable(parts, &knots, 0.0072, 5, [WAIST, ROOT]);
        let knots = [
            point(root, 0.110, 0.060 - 0.020 * s, 0.030),
            point(hip, 0.085 + 0.012 * s, 0.085 - 0.020 * s, 0.010),
            point(hip.lerp(knee, 0.42), 0.040 + 0.012 * s, 0.060, 0.0),
        ];
        cable(parts, &knots, 0.0072, 5, [ROOT, LEGS[0][0]]);
        // A loop at the elbow, and one at the hollow of the knee.
        let lower = (skeleton.joints[ARMS[0][2]] - b).normalize();
        let side = DVec3::new(0.016 - 0.032 * s, 0.0, 0.0);
        let knots = [
            b - 0.070 * upper + DVec3::new(0.0, 0.044, 0.0) + side,
            b + DVec3::new(0.0, 0.086, -0.010) + side,
            b + 0.085 * lower + DVec3::new(0.0, 0.040, 0.0) + side,
        ];
        cable(parts, &knots, 0.0060, 4, [ARMS[0][0], ARMS[0][1]]);
    }
}
