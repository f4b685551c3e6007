//! The bones that boundary loops follow.

use bespoke::energy::position::MovingAxis;
use bespoke::geometry::mesh::{BoundaryLoop, Topology};
use bespoke::input::skeleton::Skeleton;
use bespoke::stage::setup::loop_axis::{LoopAxis, choose_loop_axes, nearest_bone_axis};
use glam::DVec3;

use testing::obj::{assets, read_mesh, read_skeleton};

/// A person of height 1.7, z up, arms hanging down beside the body.
fn person() -> Skeleton {
    let at = |x: f64, z: f64| DVec3::new(x, 0.0, z);
    let joints = vec![
        at(0.0, 0.95),  // 0 root
        at(0.0, 1.1),   // 1 waist
        at(0.0, 1.5),   // 2 neck
        at(0.2, 1.45),  // 3 left shoulder
        at(0.28, 1.15), // 4 left elbow
        at(0.34, 0.85), // 5 left wrist
        at(-0.2, 1.45),
        at(-0.28, 1.15),
        at(-0.34, 0.85),
        at(0.1, 0.9), // 9 left hip
        at(0.1, 0.5), // 10 left knee
        at(0.1, 0.1), // 11 left ankle
        at(-0.1, 0.9),
        at(-0.1, 0.5),
        at(-0.1, 0.1),
    ];
    // The bones of one leg are listed the other way round.
    let bones = [[0, 1], [1, 2], [2, 3], [3, 4], [4, 5], [2, 6], [6, 7], [7, 8], [0, 9], [9, 10], [10, 11]]
        .into_iter()
        .chain([[12, 0], [13, 12], [14, 13]])
        .collect();
    Skeleton { joints, bones }
}

/// An ellipse of 24 points around `centre`, with the half-axes `u` and `v`.
fn ellipse(centre: DVec3, u: DVec3, v: DVec3) -> Vec<DVec3> {
    let angle = |k: i32| std::f64::consts::TAU * f64::from(k) / 24.0;
    (0..24).map(|k| centre + u * angle(k).cos() + v * angle(k).sin()).collect()
}

/// A horizontal ellipse at a height.
fn hem(height: f64, width: f64) -> Vec<DVec3> {
    ellipse(DVec3::Z * height, DVec3::X * width, DVec3::Y * 0.15)
}

fn choose(points: &[DVec3], source: &Skeleton, target: &Skeleton) -> Option<LoopAxis> {
    let boundary = BoundaryLoop { vertices: (0..points.len() as u32).collect() };
    choose_loop_axes(points, &[boundary], source, target).remove(0)
}

/// The pairs of joints of the bones chosen for a loop, each pair in ascending order.
fn chosen(points: &[DVec3], source: &Skeleton) -> Vec<[u32; 2]> {
    let bones = choose(points, source, source).map_or(vec![], |choice| choice.bones);
    bones.iter().map(|&bone| source.bones[bone as usize]).map(|[a, b]| [a.min(b), a.max(b)]).collect()
}

#[test]
fn a_loop_around_one_limb_follows_its_bone() {
    let person = person();
    assert_eq!(chosen(&hem(1.05, 0.2), &person), [[0, 1]]);
    assert_eq!(chosen(&hem(1.2, 0.2), &person), [[1, 2]]);
    let forearm = person.joints[5] - person.joints[4];
    let around = |p: DVec3| ellipse(p, 0.06 * forearm.cross(DVec3::Y).normalize(), 0.06 * DVec3::Y);
    assert_eq!(chosen(&around(person.joints[4].lerp(person.joints[5], 0.8)), &person), [[4, 5]]);
    // A sleeve that ends beyond the wrist.
    assert_eq!(chosen(&around(person.joints[4].lerp(person.joints[5], 1.15)), &person), [[4, 5]]);
    let leg = |height: f64| hem(height, 0.08).iter().map(|p| *p + DVec3::X * 0.1).collect::<Vec<_>>();
    assert_eq!(chosen(&leg(0.2), &person), [[10, 11]]);
    assert_eq!(chosen(&leg(0.05), &person), [[10, 11]]);
}

/// An armhole lies around the shoulder. Where the target's arms are raised it stays with the trunk, and a sleeve goes along.
#[test]
fn an_armhole_does_not_turn_with_the_arm() {
    let with_elbow = |place: DVec3| {
        let mut person = person();
        person.joints[4] = place;
        person.joints[5] = person.joints[3] + 2.0 * (place - person.joints[3]);
        person
    };
    let (a, t) = (with_elbow(DVec3::new(0.41, 0.0, 1.24)), with_elbow(DVec3::new(0.5, 0.0, 1.45)));
    let armhole = ellipse(DVec3::new(0.2, 0.0, 1.4), 0.06 * DVec3::Y, 0.12 * DVec3::Z);
    let across = DVec3::new(0.7, 0.0, 0.7);
    let sleeve = ellipse(DVec3::new(0.31, 0.0, 1.34), 0.06 * DVec3::Y, 0.07 * across);
    let bone = |points: &[DVec3], source: &Skeleton, target: &Skeleton| {
        let bones = choose(points, source, target).expect("an axis").bones;
        bones.iter().map(|&bone| source.bones[bone as usize]).collect::<Vec<_>>()
    };
    assert_eq!(bone(&armhole, &a, &a), [[3, 4]]);
    assert_eq!(bone(&armhole, &a, &t), [[2, 3]]);
    assert_eq!(bone(&sleeve, &a, &t), [[3, 4]]);
}

#[test]
fn a_hem_around_both_legs_follows_their_mean() {
    let person = person();
    let mini = hem(0.75, 0.22);
    assert_eq!(chosen(&mini, &person), [[9, 10], [12, 13]]);
    assert_eq!(chosen(&hem(0.3, 0.3), &person), [[10, 11], [13, 14]]);
    // A gown that ends below the ankles.
    assert_eq!(chosen(&hem(0.04, 0.5), &person), [[10, 11], [13, 14]]);
    // The arms hang outside the hem; only where it is as wide as they are do they take part.
    assert_eq!(chosen(&hem(0.87, 0.25), &person), [[9, 10], [12, 13]]);
    assert_eq!(chosen(&hem(0.87, 0.6), &person), [[4, 5], [7, 8], [9, 10], [12, 13]]);

    let mut target = person.clone();
    target.joints[10] += DVec3::new(0.4, 0.2, 0.0);
    let axis = choose(&mini, &person, &target).unwrap().axis;
    let (hip, knee) = (DVec3::Z * 0.9, DVec3::Z * 0.5);
    let is_near = |a: [DVec3; 2], b: [DVec3; 2]| a.iter().zip(b).all(|(a, b)| a.distance(b) < 1e-12);
    let shift = DVec3::new(0.2, 0.1, 0.0);
    let down = is_near(axis.start, [hip, knee]) && is_near(axis.end, [hip, knee + shift]);
    let up = is_near(axis.start, [knee, hip]) && is_near(axis.end, [knee + shift, hip]);
    assert!(down || up, "{axis:?}");
}

#[test]
fn the_mean_does_not_depend_on_how_loop_and_bones_are_listed() {
    let person = person();
    let points = hem(0.7, 0.22);
    let expected = choose(&points, &person, &person).unwrap().axis;
    let flipped = |g: MovingAxis| MovingAxis { start: [g.start[1], g.start[0]], end: [g.end[1], g.end[0]] };
    let is_near = |a: &MovingAxis, b: &MovingAxis| {
        let ends = |g: &MovingAxis| [g.start[0], g.start[1], g.end[0], g.end[1]];
        ends(a).iter().zip(ends(b)).all(|(a, b)| a.distance(b) < 1e-12)
    };
    let reversed: Vec<DVec3> = points.iter().rev().copied().collect();
    assert!(is_near(&choose(&reversed, &person, &person).unwrap().axis, &flipped(expected)));
    for turned in 0..person.bones.len() {
        let mut other = person.clone();
        other.bones[turned].swap(0, 1);
        let axis = choose(&points, &other, &person).unwrap().axis;
        assert!(is_near(&axis, &expected));
    }
}

#[test]
fn a_bone_must_pass_through_the_loop_to_be_preferred() {
    let joints = vec![DVec3::ZERO, DVec3::X, DVec3::new(0.5, -0.5, 0.3), DVec3::new(0.5, 0.5, 0.3)];
    let skeleton = Skeleton { joints, bones: vec![[0, 1], [2, 3]] };
    // Closer to the first bone, but its opening looks along the second.
    let opening = ellipse(DVec3::new(0.5, 0.0, 0.05), 0.1 * DVec3::X, 0.1 * DVec3::Z);
    assert_eq!(chosen(&opening, &skeleton), [[2, 3]]);
    // Looks along neither: the closest of all.
    let opening = ellipse(DVec3::new(0.5, 0.0, 0.05), 0.1 * DVec3::X, 0.1 * DVec3::Y);
    assert_eq!(chosen(&opening, &skeleton), [[0, 1]]);
    // A slit has no direction to look along: the closest of all, again.
    let slit = ellipse(DVec3::new(0.5, 0.0, 0.05), 0.1 * DVec3::X, DVec3::ZERO);
    assert_eq!(chosen(&slit, &skeleton), [[0, 1]]);
}

/// The hole between the strap and the sole of a sandal, beside the toes: bones from the pelvis to the hips, far above, go that way.
#[test]
fn a_bone_far_away_is_not_preferred() {
    let mut person = person();
    person.joints.extend([DVec3::new(0.1, -0.15, 0.03), DVec3::new(-0.1, -0.15, 0.03)]);
    person.bones.extend([[11, 15], [14, 16]]);
    let beside = |x: f64| ellipse(DVec3::new(x, -0.1, 0.04), 0.08 * DVec3::Y, 0.03 * DVec3::Z);
    assert_eq!(chosen(&beside(0.06), &person), [[11, 15]]);
    assert_eq!(chosen(&beside(-0.14), &person), [[14, 16]]);
    // Wider than the way to them.
    assert_eq!(chosen(&ellipse(DVec3::new(0.06, -0.1, 0.2), 0.5 * DVec3::Y, 0.5 * DVec3::Z), &person), [[0, 9]]);
}

/// Where a face is missing, and not at a cuff, however narrow, nor where the opening is as wide as the limb is thick.
#[test]
fn a_hole_in_the_cloth_follows_no_bone() {
    let person = person();
    let hole = |centre: DVec3, radius: f64| ellipse(centre, radius * DVec3::X, radius * DVec3::Z);
    assert!(choose(&hole(DVec3::new(0.0, 0.15, 1.3), 0.02), &person, &person).is_none());
    assert!(choose(&hole(DVec3::new(0.0, 0.15, 1.3), 0.1), &person, &person).is_some());
    let elbow = person.joints[4];
    assert!(choose(&hole(elbow + 0.03 * DVec3::Y, 0.02), &person, &person).is_some());
    assert!(choose(&ellipse(elbow - 0.1 * DVec3::Z, 0.03 * DVec3::X, 0.03 * DVec3::Y), &person, &person).is_some());
}

#[test]
fn two_bones_joined_on_the_plane_cross_it_once() {
    let joints = vec![-DVec3::Z, DVec3::ZERO, DVec3::Z];
    let skeleton = Skeleton { joints, bones: vec![[0, 1], [1, 2]] };
    let square = [DVec3::X, DVec3::Y, -DVec3::X, -DVec3::Y];
    assert_eq!(chosen(&square, &skeleton).len(), 1);
}

#[test]
fn without_a_loop_or_a_bone_there_is_no_guide() {
    let point = Skeleton { joints: vec![DVec3::ONE; 2], bones: vec![[0, 1]] };
    assert_eq!(choose(&[], &person(), &person()), None);
    assert_eq!(choose(&hem(1.0, 0.2), &point, &point), None);
    assert_eq!(choose(&hem(1.0, 0.2), &Skeleton::default(), &Skeleton::default()), None);
    // A single point and a line are loops of a sort.
    assert!(choose(&[DVec3::Z], &person(), &person()).is_some());
    assert!(choose(&[DVec3::Z, DVec3::X], &person(), &person()).is_some());
}

#[test]
fn a_point_follows_the_nearest_bone() {
    let (source, mut target) = (person(), person());
    target.joints.iter_mut().for_each(|p| *p *= 1.5);
    let at = |x: f64, z: f64| nearest_bone_axis(DVec3::new(x, 0.05, z), &source, &target);
    // Shin, thigh and spine, each whichever way its bone runs.
    for (x, z, joints) in [(0.12, 0.3, [10, 11]), (-0.12, 0.7, [13, 12]), (0.02, 1.3, [1, 2])] {
        let (bone, axis) = at(x, z).unwrap();
        assert_eq!(source.bones[bone as usize], joints);
        assert_eq!(axis.start, joints.map(|joint| source.joints[joint as usize]));
        assert_eq!(axis.end, joints.map(|joint| target.joints[joint as usize]));
    }
    // Where that bone is a point on the target, the next one.
    target.joints[11] = target.joints[10];
    assert_ne!(
        source.bones[nearest_bone_axis(DVec3::new(0.12, 0.05, 0.3), &source, &target).unwrap().0 as usize],
        [10, 11]
    );
    assert_eq!(nearest_bone_axis(DVec3::ZERO, &Skeleton::default(), &Skeleton::default()), None);
}

/// The bones for the loops of a published garment, as pairs of joints, sorted.
fn bones_of(garment: &str) -> Option<Vec<Vec<[u32; 2]>>> {
    let folder = assets()?.join("garments").join(garment);
    let mesh = read_mesh(&folder.join("garment.obj"));
    let skeleton = read_skeleton(&folder.join("skeleton.obj"));
    let loops = Topology::new(mesh.positions.len(), &mesh.triangles).loops;
    let name = |bone: &u32| {
        let [a, b] = skeleton.bones[*bone as usize];
        [a.min(b), a.max(b)]
    };
    let choices = choose_loop_axes(&mesh.positions, &loops, &skeleton, &skeleton);
    let mut pairs: Vec<Vec<[u32; 2]>> =
        choices.into_iter().map(|choice| choice.unwrap().bones.iter().map(name).collect()).collect();
    pairs.sort();
    Some(pairs)
}

#[test]
fn the_coat_follows_spine_and_forearms() {
    // Hem, neck, and the two sleeves (the right wrist is joint 7).
    if let Some(bones) = bones_of("Puffer_dense") {
        assert_eq!(bones, [vec![[0, 1]], vec![[1, 2]], vec![[4, 5]], vec![[7, 8]]]);
    }
}

#[test]
fn the_jumpsuit_follows_spine_forearms_and_shins() {
    if let Some(bones) = bones_of("jumpsuit_dense") {
        assert_eq!(bones, [vec![[1, 2]], vec![[4, 5]], vec![[7, 8]], vec![[10, 11]], vec![[13, 14]]]);
    }
}
