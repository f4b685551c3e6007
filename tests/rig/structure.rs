//! Rigs without names, of all forms: what the structure says is right, or it says that it is unsure.

use bespoke::rig::body_part::{BodyPart, Side};
use bespoke::rig::structure::{Joints, read};
use glam::{DMat4, DQuat, DVec3};
use testing::Random;

/// Below this confidence a part is a guess, and the caller is told so.
const SURE: f64 = 0.6;
const CASES: usize = 2000;

/// Joints without names, what each is, and what each moves.
#[derive(Default)]
struct Rig {
    places: Vec<DVec3>,
    parents: Vec<Option<u32>>,
    truth: Vec<Option<BodyPart>>,
    moved: Vec<f64>,
}

impl Rig {
    fn add(&mut self, truth: Option<BodyPart>, parent: Option<u32>, place: DVec3, moved: f64) -> u32 {
        self.places.push(place);
        self.parents.push(parent);
        self.truth.push(truth);
        self.moved.push(moved);
        self.places.len() as u32 - 1
    }

    /// The same with its joints in another order, turned and scaled.
    fn changed(&self, random: &mut Random, is_turned: bool) -> Self {
        let turn = if is_turned { DQuat::from_scaled_axis(3.0 * random.vector()) } else { DQuat::IDENTITY };
        let scale = 10_f64.powf(2.0 * random.signed());
        let map = DMat4::from_scale_rotation_translation(DVec3::splat(scale), turn, random.vector());
        let mut order: Vec<usize> = (0..self.places.len()).collect();
        for k in (1..order.len()).rev() {
            order.swap(k, (random.unit() * (k + 1) as f64) as usize);
        }
        let mut at = vec![0; order.len()];
        order.iter().enumerate().for_each(|(new, &old)| at[old] = new as u32);
        let parent = |&old: &usize| self.parents[old].map(|parent| at[parent as usize]);
        Self {
            places: order.iter().map(|&old| map.transform_point3(self.places[old])).collect(),
            parents: order.iter().map(parent).collect(),
            truth: order.iter().map(|&old| self.truth[old]).collect(),
            moved: order.iter().map(|&old| self.moved[old]).collect(),
        }
    }
}

/// A person of random proportions in a random pose, facing along +z, with what the rigs of different tools have beside the bones of
/// a body. Whether its feet have toes.
fn person(random: &mut Random) -> (Rig, bool) {
    let mut rig = Rig::default();
    let mut chance = {
        let mut own = Random::new((random.unit() * 1e9) as u64);
        move |share: f64| own.unit() < share
    };
    let mut between = |low: f64, high: f64| low + (high - low) * random.unit();
    let legs = between(0.35, 0.95);
    let trunk = between(0.4, 0.6);
    let arm = between(0.22, 0.32) * (trunk / 0.5);
    let (hips_apart, shoulder_apart) = (between(0.08, 0.17), between(0.17, 0.23));
    let (floor_root, has_controls) = (chance(0.5), chance(0.3));
    let (legs_on_root, feet_on_root) = (floor_root && chance(0.15), floor_root && chance(0.15));
    let root = floor_root.then(|| rig.add(None, None, DVec3::ZERO, 0.0));
    let hip_height = legs;
    let hips = rig.add(Some(BodyPart::Hips), root, DVec3::new(0.0, hip_height + between(-0.08, 0.12), 0.0), 3.0);
    let hips_y = rig.places[hips as usize].y;
    let top = hip_height + trunk;

    // The spine up to where the arms leave, at or below the shoulders.
    let spines = 1 + (between(0.0, 3.99) as usize);
    let chest_y = top - between(0.02, 0.3) * trunk;
    let mut last = hips;
    for k in 1..=spines {
        let along = k as f64 / spines as f64;
        last = rig.add(
            Some(BodyPart::Spine),
            Some(last),
            DVec3::new(0.0, hips_y + along * (chest_y - hips_y), 0.02 * along),
            3.0,
        );
    }
    let chest = last;

    // Neck, head, and what is on it.
    let head = between(0.08, 0.16);
    let necks = between(0.0, 2.5) as usize;
    for k in 0..necks {
        last = rig.add(Some(BodyPart::Neck), Some(last), DVec3::new(0.0, top + 0.02 + 0.04 * k as f64, 0.0), 0.8);
    }
    let height = top + head;
    last = rig.add(Some(BodyPart::Head), Some(last), DVec3::new(0.0, height, 0.02), 10.0);
    if chance(0.4) {
        let tip = DVec3::new(0.0, height + between(0.22, 0.5), 0.0);
        rig.add(Some(BodyPart::HeadTop), Some(last), tip, 0.0);
    }
    if chance(0.3) {
        rig.add(None, Some(last), DVec3::new(0.0, height, 0.1), 1.0);
        for x in [-0.04, 0.04] {
            rig.add(None, Some(last), DVec3::new(x, height + 0.1, 0.1), 0.3);
        }
    }

    let lift = between(-1.3, 0.3);
    let bend = between(-0.2, 0.4);
    let (has_collar, collar_at) = (chance(0.7), between(0.02, 0.08));
    let knuckles = between(0.0, 3.99) as usize;
    let fingers = if chance(0.6) && knuckles > 0 { [2, 5][usize::from(chance(0.6))] } else { 0 };
    let (palm, slot) = (chance(0.4), chance(0.2));
    let twists = chance(0.3);
    let (shoulder_y, spread, knee_bend) = (top - between(0.0, 0.05), between(0.0, 0.2), between(0.0, 0.25));
    let (has_toes, has_tips, thigh) = (chance(0.7) && !feet_on_root, chance(0.5), between(0.46, 0.54));
    let hip_y = hip_height + between(-0.03, 0.03);
    for (side, x) in [(Side::Left, 1.0), (Side::Right, -1.0)] {
        let mut from = chest;
        if has_collar {
            let place = DVec3::new(x * collar_at, shoulder_y - 0.02, 0.0);
            from = rig.add(Some(BodyPart::Clavicle(side)), Some(from), place, 1.0);
        }
        let direction = |angle: f64, forward: f64| DVec3::new(x * angle.cos(), angle.sin(), forward).normalize();
        let shoulder = DVec3::new(x * shoulder_apart, shoulder_y, 0.0);
        let upper = rig.add(Some(BodyPart::UpperArm(side)), Some(from), shoulder, 2.0);
        let elbow = shoulder + arm * direction(lift, 0.0);
        if twists {
            rig.add(None, Some(upper), shoulder.lerp(elbow, 0.5), 1.0);
        }
        let lower = rig.add(Some(BodyPart::LowerArm(side)), Some(upper), elbow, 2.0);
        let wrist = elbow + 0.95 * arm * direction(lift, bend);
        if twists {
            rig.add(None, Some(lower), elbow.lerp(wrist, 0.5), 1.0);
        }
        let hand = rig.add(Some(BodyPart::Hand(side)), Some(lower), wrist, 1.0);
        let along = direction(lift, bend);
        for f in 0..fingers {
            let mut from = hand;
            let out = (f as f64 - 1.5) * 0.02 * DVec3::Z + if f == 0 { 0.02 * DVec3::Y } else { DVec3::ZERO };
            for k in 0..knuckles {
                from = rig.add(None, Some(from), wrist + out + (0.07 + 0.03 * k as f64) * along, 0.3);
            }
        }
        if fingers == 0 && palm {
            rig.add(None, Some(hand), wrist + 0.08 * along, 0.5);
        }
        if slot {
            rig.add(None, Some(hand), wrist + 0.1 * along + 0.05 * DVec3::Y, 0.0);
        }

        let hip = DVec3::new(x * hips_apart, hip_y, 0.0);
        let down = DVec3::new(x * spread, -1.0, 0.0).normalize();
        let on = if legs_on_root { root } else { Some(hips) };
        let upper = rig.add(Some(BodyPart::UpperLeg(side)), on, hip, 3.0);
        let knee = hip + thigh * 0.92 * legs * down + 0.1 * knee_bend * DVec3::Z;
        let lower = rig.add(Some(BodyPart::LowerLeg(side)), Some(upper), knee, 3.0);
        let ankle = DVec3::new(knee.x + x * spread * (knee.y - 0.08 * legs), 0.08 * legs, -0.1 * knee_bend);
        let foot = rig.add(Some(BodyPart::Foot(side)), if feet_on_root { root } else { Some(lower) }, ankle, 1.5);
        if has_toes {
            let ball = rig.add(Some(BodyPart::Toes(side)), Some(foot), DVec3::new(ankle.x, 0.02, ankle.z + 0.15), 0.5);
            if has_tips {
                rig.add(None, Some(ball), DVec3::new(ankle.x, 0.02, ankle.z + 0.22), 0.0);
            }
        }
        if has_controls && floor_root {
            rig.add(None, root, wrist, 0.0);
            rig.add(None, root, elbow - 0.6 * DVec3::Z, 0.0);
            rig.add(None, root, knee + 0.6 * DVec3::Z, 0.0);
            let roll = rig.add(None, root, DVec3::new(ankle.x, 0.0, 0.2), 0.0);
            let heel = rig.add(None, Some(roll), DVec3::new(ankle.x, 0.0, -0.1), 0.0);
            rig.add(None, Some(heel), ankle, 0.0);
        }
    }
    if chance(0.15) {
        let mut from = hips;
        for k in 1..4 {
            from = rig.add(None, Some(from), DVec3::new(0.0, hips_y, -0.12 * k as f64), 0.5);
        }
    }
    // Pairs that are no limbs: wings, and a skirt or the tails of a coat.
    let (has_wings, has_skirt) = (chance(0.1), chance(0.15));
    let (span, hem) = (between(0.2, 0.9), between(0.2, 0.7) * legs);
    for x in [1.0, -1.0] {
        if has_wings {
            let mut from = chest;
            for k in 0..3 {
                let along = DVec3::new(0.05 + 0.33 * span * k as f64, 0.1 * k as f64, -0.1);
                from = rig.add(None, Some(from), rig.places[chest as usize] + DVec3::new(x, 1.0, 1.0) * along, 1.0);
            }
        }
        for z in [-0.1, 0.1].into_iter().filter(|_| has_skirt) {
            let mut from = hips;
            for k in 1..4 {
                let below = DVec3::new(x * 0.12, -0.33 * hem * f64::from(k), z);
                from = rig.add(None, Some(from), DVec3::new(0.0, hips_y, 0.0) + below, 0.6);
            }
        }
    }
    // Nobody places joints evenly.
    let uneven = if chance(0.5) { 0.006 } else { 0.0 };
    let own: Vec<DVec3> = (0..rig.places.len()).map(|_| uneven * random.vector()).collect();
    rig.places.iter_mut().zip(own).for_each(|(place, by)| *place += by);
    (rig, has_toes)
}

/// What is wrong of what is said to be sure, and how many of the joints that a skeleton needs are known for sure, of all.
fn judged(rig: &Rig, skin: bool) -> (Vec<String>, usize, usize) {
    let mut used = vec![true; rig.places.len()];
    if skin {
        used.fill(false);
        for joint in (0..rig.places.len()).filter(|&joint| rig.moved[joint] > 0.0) {
            let mut up = Some(joint as u32);
            while let Some(k) = up {
                used[k as usize] = true;
                up = rig.parents[k as usize];
            }
        }
    }
    let moved = skin.then_some(&rig.moved[..]);
    let joints = Joints { places: &rig.places, parents: &rig.parents, used: &used, moved };
    let found = read(&joints).unwrap_or_else(|| vec![None; rig.places.len()]);
    let (mut wrong, mut known, mut all) = (Vec::new(), 0, 0);
    for (joint, (found, truth)) in found.iter().zip(&rig.truth).enumerate() {
        // The base of a neck may be the last joint of the spine; where collar bones and toes begin decides nothing.
        let is_needed = |part: BodyPart| {
            let aside = matches!(part, BodyPart::Clavicle(_) | BodyPart::Toes(_) | BodyPart::HeadTop);
            !aside && !matches!(part, BodyPart::Spine | BodyPart::Neck)
        };
        let sure = found.filter(|(_, confidence)| *confidence >= SURE).map(|(part, _)| part);
        let loose = |part: Option<BodyPart>| part.filter(|&part| is_needed(part));
        if sure.is_some() && loose(sure) != loose(*truth) {
            wrong.push(format!("joint {joint} at {}: {found:?} for {truth:?}", rig.places[joint]));
        }
        if loose(*truth).is_some() {
            all += 1;
            known += usize::from(sure == *truth);
        }
    }
    (wrong, known, all)
}

#[test]
fn rigs_without_names_are_read_rightly_or_said_to_be_unsure() {
    let mut random = Random::new(16);
    for (skin, least) in [(true, 0.95), (false, 0.9)] {
        let (mut known, mut all, mut misread) = (0, 0, Vec::new());
        for case in 0..CASES {
            let (rig, has_toes) = person(&mut random);
            // Without toes nothing says where front is.
            let rig = rig.changed(&mut random, has_toes);
            let (wrong, own, of) = judged(&rig, skin);
            if !wrong.is_empty() {
                misread.push(format!("case {case}, skin {skin}: {}", wrong.join("; ")));
            }
            if has_toes {
                known += own;
                all += of;
            }
        }
        let share = known as f64 / all as f64;
        println!("skin {skin}: {known} of {all} known ({share:.3}), misread {}", misread.len());
        assert!(misread.is_empty(), "{} of {CASES}:\n{}", misread.len(), misread[..misread.len().min(5)].join("\n"));
        assert!(share > least, "with skin {skin} {share:.3} of the joints are known for sure");
    }
}

/// The legs and the hips hang on one joint in the belly, which stands where the hips are elsewhere: nothing tells one from the other.
#[test]
fn hips_below_what_the_legs_hang_on_are_said_to_be_unsure() {
    let mut random = Random::new(17);
    for skin in [true, false] {
        let (mut known, mut all) = (0, 0);
        for case in 0..CASES / 4 {
            let (mut rig, has_toes) = person(&mut random);
            let joint_of = |part| rig.truth.iter().position(|truth| *truth == Some(part));
            let hips = joint_of(BodyPart::Hips).unwrap();
            let legs = [Side::Left, Side::Right].map(|side| joint_of(BodyPart::UpperLeg(side)).unwrap());
            let above = rig.places[hips] + DVec3::new(0.0, 0.03 + 0.08 * random.unit(), 0.08 * random.signed());
            let belly = rig.add(None, rig.parents[hips], above, 1.0);
            [hips, legs[0], legs[1]].into_iter().for_each(|joint| rig.parents[joint] = Some(belly));
            let (wrong, own, of) = judged(&rig.changed(&mut random, has_toes), skin);
            assert!(wrong.is_empty(), "case {case}, skin {skin}: {}", wrong.join("; "));
            (known, all) = (known + own, all + of);
        }
        println!("skin {skin}: {known} of {all} known");
        assert!(2 * known > all, "with skin {skin} {known} of {all} joints are known for sure");
    }
}
