//! What holds for rigged characters, whatever their names, pose and habits.

use std::collections::HashSet;
use std::sync::LazyLock;

use closet::garments::{Garment, garment};
use closet::mesh::Mesh;
use closet::rigs::{Body, Character, INFLUENCES, Naming, Pose, Role, SIDES, Side, character, y_up};
use closet::{Sample, files};
use glam::{DAffine3, DVec3};

use crate::MANNEQUIN;

static BIG_HEAD: LazyLock<Sample> = LazyLock::new(|| Body::BigHead.model());
static THICK_LIMBS: LazyLock<Sample> = LazyLock::new(|| Body::ThickLimbs.model());
static CHILD: LazyLock<Sample> = LazyLock::new(|| Body::named("child").expect("an avatar").model());

fn bodies() -> [(&'static str, &'static Sample); 4] {
    [("mannequin", &MANNEQUIN), ("big-head", &BIG_HEAD), ("thick-limbs", &THICK_LIMBS), ("child", &CHILD)]
}

fn place(character: &Character, role: Role) -> DVec3 {
    character.joints.iter().find(|joint| joint.role == role).expect("a joint of this role").bind.translation
}

/// Vertices moved with what changed of the joints' transforms, and nothing else.
fn skinned(from: &Character, to: &Character) -> Vec<DVec3> {
    let joint = |k: usize| to.joints[k].bind * from.joints[k].bind.inverse();
    let vertex = |(&p, influences): (&DVec3, &Vec<(usize, f64)>)| {
        influences.iter().map(|&(k, weight)| weight * joint(k).transform_point3(p)).sum()
    };
    from.mesh.positions.iter().zip(&from.influences).map(vertex).collect()
}

#[track_caller]
fn near(a: &[DVec3], b: &[DVec3], tolerance: f64) {
    assert_eq!(a.len(), b.len());
    let worst = a.iter().zip(b).map(|(p, q)| p.distance(*q)).fold(0.0, f64::max);
    assert!(worst < tolerance, "apart by {worst}");
}

fn volume(mesh: &Mesh) -> f64 {
    (0..mesh.triangles.len() as u32).map(|t| mesh.corners(t)).map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
}

#[test]
fn weights_are_few_and_sum_to_1() {
    for (name, body) in bodies() {
        for naming in Naming::ALL {
            let name = format!("{name} by {}", naming.word());
            let character = character(body, naming);
            assert_eq!(character.influences.len(), body.mesh.positions.len(), "{name}");
            let mut weighted = HashSet::new();
            for influences in &character.influences {
                assert!((1..=INFLUENCES).contains(&influences.len()), "{name}");
                let sum: f64 = influences.iter().map(|(_, weight)| weight).sum();
                assert!((sum - 1.0).abs() < 1e-12, "{name}: weights that sum to {sum}");
                assert!(influences.iter().all(|(_, weight)| *weight > 0.0), "{name}");
                weighted.extend(influences.iter().map(|(joint, _)| *joint));
            }
            for (k, joint) in character.joints.iter().enumerate() {
                assert!(!weighted.contains(&k) || !joint.role.is_control(), "{name}: flesh on {:?}", joint.role);
                let is_end = matches!(joint.role, Role::HeadEnd | Role::ToeEnd(_));
                let is_bone = !joint.role.is_control() && !is_end;
                assert!(weighted.contains(&k) || !is_bone, "{name}: nothing on {:?}", joint.role);
            }
        }
    }
}

#[test]
fn neighbours_move_alike() {
    for (name, body) in bodies() {
        // Without fingers: these move one by one, and may be one piece of flesh.
        let character = character(body, Naming::Controls);
        let row = |v: u32| {
            let mut row = vec![0.0; character.joints.len()];
            character.influences[v as usize].iter().for_each(|(joint, weight)| row[*joint] = *weight);
            row
        };
        let mut steps: Vec<f64> = Vec::new();
        for edge in body.mesh.edges() {
            let [a, b] = edge.vertices.map(row);
            steps.push(0.5 * a.iter().zip(&b).map(|(a, b)| (a - b).abs()).sum::<f64>());
        }
        steps.sort_by(f64::total_cmp);
        // A vertex on one joint beside a vertex on another would be a step of 1.
        let steep = steps[steps.len() * 99 / 100];
        assert!(steep < 0.6, "{name}: one edge in a hundred carries a change of more than {steep}");
    }
}

#[test]
fn joints_have_their_own_names_and_come_after_their_parents() {
    for naming in Naming::ALL {
        let character = character(&MANNEQUIN, naming);
        let word = naming.word();
        let names: HashSet<&str> = character.joints.iter().map(|joint| joint.name.as_str()).collect();
        let expected = if naming == Naming::Unnamed { 1 } else { character.joints.len() };
        assert_eq!(names.len(), expected, "{word}: a name twice");
        let roots = character.joints.iter().filter(|joint| joint.parent.is_none()).count();
        assert_eq!(roots, 1, "{word}");
        for (k, joint) in character.joints.iter().enumerate() {
            assert!(joint.parent.is_none_or(|parent| parent < k), "{word}: {}", joint.name);
            let turned = joint.bind.matrix3;
            assert!((turned.determinant() - 1.0).abs() < 1e-9, "{word}: {} is no rotation", joint.name);
        }
        assert!(character.joints.len() >= 30, "{word}: {} joints", character.joints.len());
    }
    let parent = |character: &Character, name: &str| {
        let joint = character.joints.iter().find(|joint| joint.name == name).expect(name);
        joint.parent.map(|parent| character.joints[parent].name.clone())
    };
    let named = |naming| character(&MANNEQUIN, naming);
    assert_eq!(parent(&named(Naming::Mixamo), "mixamorig:Hips"), None);
    assert_eq!(parent(&named(Naming::Unreal), "ik_foot_l").as_deref(), Some("ik_foot_root"));
    assert_eq!(parent(&named(Naming::Unreal), "hand_r").as_deref(), Some("lowerarm_r"));
    assert_eq!(parent(&named(Naming::FeetOnRoot), "Foot.L").as_deref(), Some("Root"));
    assert_eq!(parent(&named(Naming::Controls), "upperarm.l").as_deref(), Some("chest"));
    assert_eq!(parent(&named(Naming::Controls), "hand.l").as_deref(), Some("wrist.l"));
    assert_eq!(parent(&named(Naming::Vrm), "leftIndexDistal").as_deref(), Some("leftIndexIntermediate"));
    assert_eq!(parent(&named(Naming::Rigify), "DEF-spine.006").as_deref(), Some("DEF-spine.004"));
}

#[test]
fn poses_are_what_they_say() {
    for (name, body) in bodies() {
        let bound = character(body, Naming::Unnamed);
        near(&bound.posed(&Pose::BIND).mesh.positions, &bound.mesh.positions, 1e-12);
        for (word, pose) in Pose::ALL {
            let posed = bound.posed(&pose);
            assert!(posed.mesh.positions.iter().all(|p| p.is_finite()), "{name}: {word}");
            near(&posed.mesh.positions, &skinned(&bound, &posed), 1e-9);
            assert!(posed.joints.iter().all(|joint| (joint.bind.matrix3.determinant() - 1.0).abs() < 1e-9));
            let floor = |c: &Character| c.mesh.positions.iter().map(|p| p.z).fold(f64::INFINITY, f64::min);
            assert!((floor(&posed) - floor(&bound)).abs() < 1e-9, "{name}: {word}: not on the floor");
            let kept = volume(&posed.mesh) / volume(&bound.mesh);
            assert!((0.8..1.1).contains(&kept), "{name}: {word}: {kept} of the volume");
            let root = [Role::Root, Role::FeetControl].map(|role| place(&posed, role).distance(place(&bound, role)));
            assert_eq!(root, [0.0, 0.0], "{name}: {word}: the root has left the floor");
            for side in SIDES {
                let direction = |from, to| {
                    let d: DVec3 = place(&posed, to) - place(&posed, from);
                    if side == Side::Left { d.normalize() } else { (d * DVec3::new(-1.0, 1.0, 1.0)).normalize() }
                };
                let (shoulder, elbow, wrist) = (Role::UpperArm(side), Role::LowerArm(side), Role::Wrist(side));
                if let Some([upper, fore]) = pose.arms {
                    assert!(direction(shoulder, elbow).distance(upper.normalize()) < 1e-9, "{name}: {word}");
                    assert!(direction(elbow, wrist).distance(fore.normalize()) < 1e-9, "{name}: {word}");
                }
                if let Some([thigh, shin]) = pose.legs {
                    let (hip, knee, ankle) = (Role::Thigh(side), Role::Calf(side), Role::Foot(side));
                    assert!(direction(hip, knee).distance(thigh.normalize()) < 1e-9, "{name}: {word}");
                    assert!(direction(knee, ankle).distance(shin.normalize()) < 1e-9, "{name}: {word}");
                }
                for (target, of) in [(Role::HandTarget(side), wrist), (Role::FootTarget(side), Role::Foot(side))] {
                    assert!(place(&posed, target).distance(place(&posed, of)) < 1e-9, "{name}: {word}: {target:?}");
                }
            }
        }
        // From one pose to another as from the bind pose: joints are where the pose has them.
        let there = bound.posed(&Pose::T).posed(&Pose::ARMS_DOWN);
        let straight = bound.posed(&Pose::ARMS_DOWN);
        let wrist = |c: &Character| place(c, Role::Wrist(Side::Left)) - place(c, Role::LowerArm(Side::Left));
        assert!(wrist(&there).distance(wrist(&straight)) < 1e-9, "{name}");
    }
}

#[test]
fn habits_of_tools_change_transforms_and_not_the_body() {
    let bound = character(&MANNEQUIN, Naming::FeetOnRoot);
    let mirror = DAffine3::from_scale(DVec3::new(-1.0, 1.0, 1.0));
    let spaces = [
        DAffine3::IDENTITY,
        y_up(),
        y_up() * DAffine3::from_scale(DVec3::splat(100.0)),
        DAffine3::from_rotation_z(0.7) * DAffine3::from_translation(DVec3::new(3.0, -2.0, 1.0)),
        mirror,
    ];
    for space in spaces {
        let placed = bound.placed(space);
        let habits = [
            placed.clone(),
            placed.clone().with_joint_scale(100.0),
            placed.clone().with_mirrored_joints(),
            placed.with_helpers(),
        ];
        for habit in habits {
            let expected: Vec<DVec3> = bound.mesh.positions.iter().map(|&p| space.transform_point3(p)).collect();
            near(&habit.mesh.positions, &expected, 1e-12);
            let ratio = volume(&habit.mesh) / volume(&bound.mesh);
            assert!((ratio / space.matrix3.determinant().abs() - 1.0).abs() < 1e-9, "turned inside out");
            for (word, pose) in Pose::ALL {
                let posed = habit.posed(&pose);
                let expected = bound.posed(&pose).placed(space);
                let size = space.matrix3.determinant().abs().cbrt();
                near(&posed.mesh.positions, &expected.mesh.positions, 1e-9 * size);
                near(&posed.mesh.positions, &skinned(&habit, &posed), 1e-9 * size);
                let wrist = Role::Wrist(Side::Right);
                assert!(place(&posed, wrist).distance(place(&expected, wrist)) < 1e-9 * size, "{word}");
            }
        }
    }
    let mirrored = bound.clone().with_mirrored_joints();
    let negative = |joint: &&closet::rigs::Joint| joint.bind.matrix3.determinant() < 0.0;
    assert!(mirrored.joints.iter().filter(negative).all(|joint| joint.name.contains(".R")));
    assert!(mirrored.joints.iter().filter(negative).count() > 10);

    let helped = bound.with_helpers();
    let helpers: Vec<_> = (0..helped.joints.len()).filter(|&k| helped.joints[k].name.ends_with("_offset")).collect();
    assert!(helpers.len() > 20);
    for k in helpers {
        let child = helped.joints.iter().find(|joint| joint.parent == Some(k)).expect("a helper carries a joint");
        assert_eq!(child.bind.translation, helped.joints[k].bind.translation);
        assert!(helped.influences.iter().flatten().all(|(joint, _)| *joint != k), "flesh on a helper");
    }
}

#[test]
fn garments_go_along_with_the_body_in_them() {
    let body = character(&MANNEQUIN, Naming::Unreal);
    let worn = body.wears(&garment(Garment::Trousers).mesh);
    for influences in &worn.influences {
        let sum: f64 = influences.iter().map(|(_, weight)| weight).sum();
        assert!((sum - 1.0).abs() < 1e-12 && influences.len() <= INFLUENCES);
    }
    // How far the nearest flesh is, before and after.
    let gap = |body: &Character, worn: &Character, v: usize| {
        let distance = |p: &DVec3| p.distance(worn.mesh.positions[v]);
        body.mesh.positions.iter().map(distance).fold(f64::INFINITY, f64::min)
    };
    for (word, pose) in Pose::ALL {
        let motions = body.motions(&pose);
        let (posed_body, posed) = (body.moved(&motions), worn.moved(&motions));
        for v in (0..posed.mesh.positions.len()).step_by(7) {
            let [before, after] = [gap(&body, &worn, v), gap(&posed_body, &posed, v)];
            assert!(after < 2.0 * before + 0.02, "{word}: vertex {v} was {before} m from the body and is {after} m");
        }
    }
}

#[test]
fn files_hold_what_is_written() {
    let folder = std::env::temp_dir().join(format!("closet-rigs-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let character = character(&CHILD, Naming::Unreal).posed(&Pose::T).with_joint_scale(100.0);
    let [rig, skin] = ["child.rig", "child.skin"].map(|name| folder.join(name));
    files::write_rig(&rig, character.rig()).expect("a file");
    files::write_influences(&skin, &character.influences).expect("a file");
    let text = std::fs::read_to_string(rig).expect("a file");
    assert_eq!(text.lines().count(), character.joints.len());
    for (line, joint) in text.lines().zip(&character.joints) {
        let words: Vec<&str> = line.split(' ').collect();
        assert_eq!((words.len(), words[0], words[1]), (19, "joint", joint.name.as_str()));
        assert_eq!(words[2].parse::<i64>().expect("an index"), joint.parent.map_or(-1, |parent| parent as i64));
        let numbers: Vec<f64> = words[3..].iter().map(|word| word.parse().expect("a number")).collect();
        let bind = glam::DMat4::from_cols_slice(&numbers);
        assert!(bind.abs_diff_eq(glam::DMat4::from(joint.bind), 1e-12));
        assert_eq!(numbers[12..15], joint.bind.translation.to_array());
    }
    let text = std::fs::read_to_string(skin).expect("a file");
    for (line, influences) in text.lines().zip(&character.influences) {
        let numbers: Vec<f64> = line.split(' ').map(|word| word.parse().expect("a number")).collect();
        let read: Vec<(usize, f64)> = numbers.chunks(2).map(|pair| (pair[0] as usize, pair[1])).collect();
        assert_eq!(&read, influences);
    }
    std::fs::remove_dir_all(folder).expect("the test's own folder");
}
