//! Checks of skeletons, their alignment, and the ways along bones.

use bespoke::error::ErrorKind;
use bespoke::input::skeleton::{BoneGraph, Location, Skeleton};
use glam::DVec3;

use testing::Random;
use testing::obj::{assets, read_skeleton};

/// Joints 0 - 1 - 2 in a column, 3 - 4 to the right of 1, 5 - 6 to the left of it; bones in that order.
fn tee() -> Skeleton {
    let at = |x: f64, y: f64| DVec3::new(x, y, 0.0);
    Skeleton {
        joints: vec![at(0., 0.), at(0., 2.), at(0., 3.), at(1., 2.), at(2., 2.), at(-1., 2.), at(-3., 2.)],
        bones: vec![[0, 1], [1, 2], [1, 3], [3, 4], [5, 1], [6, 5]],
    }
}

fn inside(bone: u32) -> Location {
    Location::Bone { bone, parameter: 0.5 }
}

fn between(graph: &BoneGraph, a: Location, b: Location) -> Vec<u32> {
    let mut path = vec![77];
    graph.joints_between(a, b, &mut path);
    path
}

/// Number of joints between two bones: 0 for the same bone, 1 for bones that share a joint.
fn bone_distance(skeleton: &Skeleton, graph: &BoneGraph, a: u32, b: u32) -> usize {
    let [ends, others] = [a, b].map(|bone| skeleton.bones[bone as usize]);
    let nearest = ends.iter().flat_map(|&j| others.map(|k| graph.joint_distance(j, k))).min().unwrap();
    if a == b { 0 } else { nearest + 1 }
}

#[test]
fn unusable_skeletons_are_named() {
    let broken = |change: fn(&mut Skeleton)| {
        let mut skeleton = tee();
        change(&mut skeleton);
        let error = skeleton.check("target skeleton").unwrap_err();
        assert_eq!(error.kind, ErrorKind::InvalidSkeleton);
        error.message
    };
    assert_eq!(tee().check("target skeleton"), Ok(()));
    assert_eq!(broken(|s| s.joints.clear()), "target skeleton: there are no joints");
    assert_eq!(broken(|s| s.bones.clear()), "target skeleton: there are 7 joints but no bones");
    assert_eq!(broken(|s| s.bones[3] = [3, 7]), "target skeleton: bone 3 has joint 7, the skeleton has 7 joints");
    assert_eq!(broken(|s| s.bones[3] = [3, 3]), "target skeleton: bone 3 joins joint 3 to itself");
    assert_eq!(broken(|s| s.bones.push([1, 5])), "target skeleton: bones 4 and 6 both join joints 1 and 5");
    assert_eq!(broken(|s| s.bones.truncate(5)), "target skeleton: joint 6 is not connected to joint 0 by bones");
    assert!(broken(|s| s.joints[4].z = f64::NAN).starts_with("target skeleton: joint 4 has z = NaN"));
    assert!(broken(|s| s.joints.resize(5000, DVec3::ZERO)).contains("5000 joints"));
    // A bone of no length is none of these.
    let mut point = tee();
    point.joints[4] = point.joints[3];
    assert_eq!(point.check("target skeleton"), Ok(()));
}

#[test]
fn alignment_takes_order_and_direction_of_the_source() {
    let source = tee();
    let mut target = Skeleton { joints: source.joints.iter().map(|j| *j * 2.0).collect(), ..tee() };
    target.bones.reverse();
    target.bones[2].reverse();
    let aligned = target.aligned_to(&source).unwrap();
    assert_eq!((&aligned.bones, &aligned.joints), (&source.bones, &target.joints));

    let refuse = |target: &Skeleton| target.aligned_to(&source).unwrap_err().message;
    let mut other = tee();
    other.bones[3] = [4, 0];
    assert_eq!(refuse(&other), "target skeleton: has no bone between joints 3 and 4, which the source skeleton has");
    other = tee();
    other.bones.push([0, 6]);
    assert_eq!(
        refuse(&other),
        "target skeleton: has a bone between joints 0 and 6, which the source skeleton does not have"
    );
    other.joints.pop();
    assert!(refuse(&other).starts_with("target skeleton: has 6 joints, the source skeleton has 7"));
}

#[test]
fn size_and_middle() {
    assert_eq!(tee().longest_side("source skeleton"), Ok(5.0));
    assert_eq!(tee().mean_joint(), DVec3::new(-1.0, 13.0, 0.0) / 7.0);
    let point = Skeleton { joints: vec![DVec3::ONE; 2], bones: vec![[0, 1]] };
    assert!(point.longest_side("source skeleton").unwrap_err().message.contains("all joints are in one place"));
}

#[test]
fn only_leaf_joints_lengthen_bones() {
    let skeleton = tee();
    let graph = BoneGraph::new(&skeleton);
    for (&[j, k], [a, b]) in skeleton.bones.iter().zip(skeleton.lengthened(0.5)) {
        let [p, q] = [j, k].map(|joint| skeleton.joints[joint as usize]);
        let length = |is_leaf: bool| if is_leaf { 0.5 * p.distance(q) } else { 0.0 };
        let along = (q - p).normalize();
        assert!(a.distance(p - length(graph.is_leaf(j)) * along) < 1e-12);
        assert!(b.distance(q + length(graph.is_leaf(k)) * along) < 1e-12);
    }
    assert!(skeleton.bones.iter().flatten().any(|&joint| !graph.is_leaf(joint)));
}

#[test]
fn ways_along_bones() {
    let graph = BoneGraph::new(&tee());
    assert_eq!((graph.degree(1), graph.bones_at(1)), (4, &[0, 1, 2, 4][..]));
    let leaves: Vec<u32> = (0..7).filter(|&j| graph.is_leaf(j)).collect();
    assert_eq!(leaves, [0, 2, 4, 6]);
    let distance = |a, b| bone_distance(&tee(), &graph, a, b);
    assert_eq!((distance(3, 3), distance(0, 1), distance(3, 5)), (0, 1, 3));

    assert_eq!(between(&graph, inside(3), inside(3)), [0; 0]);
    assert_eq!(between(&graph, inside(0), inside(1)), [1]);
    assert_eq!(between(&graph, inside(3), inside(5)), [3, 1, 5]);
    assert_eq!(between(&graph, inside(3), Location::Joint(3)), [0; 0]);
    assert_eq!(between(&graph, inside(3), Location::Joint(1)), [3]);
    assert_eq!(between(&graph, Location::Joint(4), inside(0)), [3, 1]);
    assert_eq!(between(&graph, Location::Joint(4), Location::Joint(6)), [3, 1, 5]);
    assert_eq!(between(&graph, Location::Joint(1), Location::Joint(3)), [0; 0]);
    assert_eq!(between(&graph, Location::Joint(1), Location::Joint(1)), [0; 0]);
    // The end of a bone is the joint there, and shares every bone at it.
    assert_eq!(between(&graph, Location::Bone { bone: 2, parameter: 0.0 }, inside(4)), [0; 0]);
    assert_eq!(between(&graph, Location::Bone { bone: 2, parameter: 1.0 }, inside(4)), [1]);
    assert_eq!(graph.common_bone(&[Location::Joint(1), Location::Joint(3), inside(2)]), Some(2));
    assert_eq!(graph.common_bone(&[Location::Joint(1), inside(3)]), None);
    assert_eq!(graph.common_bone(&[]), None);
}

#[test]
fn ways_are_connected_and_shortest_on_random_graphs() {
    let mut random = Random::new(21);
    for round in 0..30 {
        let n = 12usize;
        // A random tree, with some more bones in half of the rounds.
        let mut bones: Vec<[u32; 2]> = (1..n as u32).map(|j| [(random.unit() * f64::from(j)) as u32, j]).collect();
        for _ in 0..(round % 2) * 4 {
            let [a, b] = std::array::from_fn(|_| (random.unit() * n as f64) as u32);
            if a != b && !bones.iter().any(|x| x.contains(&a) && x.contains(&b)) {
                bones.push([a, b]);
            }
        }
        let skeleton = Skeleton { joints: (0..n).map(|_| random.vector()).collect(), bones };
        skeleton.check("skeleton").unwrap();
        let graph = BoneGraph::new(&skeleton);

        // Floyd-Warshall.
        let mut table = vec![vec![99usize; n]; n];
        (0..n).for_each(|j| table[j][j] = 0);
        for [a, b] in skeleton.bones.iter().map(|b| b.map(|j| j as usize)) {
            (table[a][b], table[b][a]) = (1, 1);
        }
        for (k, a, b) in (0..n * n * n).map(|i| (i / n / n, i / n % n, i % n)) {
            table[a][b] = table[a][b].min(table[a][k] + table[k][b]);
        }
        for (a, b) in (0..n * n).map(|i| (i / n, i % n)) {
            assert_eq!(graph.joint_distance(a as u32, b as u32), table[a][b]);
        }

        let places: Vec<Location> =
            (0..skeleton.bones.len() as u32).map(inside).chain((0..n as u32).map(Location::Joint)).collect();
        for &a in &places {
            for &b in &places {
                let path = between(&graph, a, b);
                let mut stops = vec![a];
                stops.extend(path.iter().map(|&j| Location::Joint(j)));
                stops.push(b);
                assert!(stops.windows(2).all(|w| graph.common_bone(w).is_some()), "{a:?} {b:?}: {path:?}");
                assert_eq!(between(&graph, b, a).len(), path.len());
                if let (Location::Bone { bone: x, .. }, Location::Bone { bone: y, .. }) = (a, b) {
                    let ends = |bone: u32| skeleton.bones[bone as usize].map(|j| j as usize);
                    let nearest = ends(x).iter().flat_map(|&j| ends(y).map(|k| table[j][k])).min().unwrap();
                    let expected = if x == y { 0 } else { nearest + 1 };
                    assert_eq!((path.len(), bone_distance(&skeleton, &graph, x, y)), (expected, expected));
                }
            }
        }
    }
}

#[test]
fn projection_is_clamped_at_interior_joints_only() {
    let mut skeleton = tee();
    let graph = BoneGraph::new(&skeleton);
    let p = DVec3::new(5.0, 2.5, 1.0);
    assert_eq!(graph.project(&skeleton, 2, p), 1.0);
    assert_eq!(graph.project(&skeleton, 3, p), 4.0);
    assert_eq!(graph.project(&skeleton, 3, -p), 0.0);
    assert_eq!(skeleton.point_at(3, 4.0), DVec3::new(5.0, 2.0, 0.0));
    assert_eq!(graph.project(&skeleton, 0, DVec3::new(0.0, -3.0, 0.0)), -1.5);
    assert_eq!(graph.project(&skeleton, 0, DVec3::new(0.0, 9.0, 0.0)), 1.0);
    // Exact at the joints.
    skeleton.joints[3] = DVec3::new(0.1, 0.7, 1e9);
    assert_eq!((skeleton.point_at(3, 0.0), skeleton.point_at(2, 1.0)), (skeleton.joints[3], skeleton.joints[3]));
    // A bone without length is a point; a bone that is lost in rounding against the distance too.
    skeleton.joints[4] = skeleton.joints[3];
    assert_eq!(graph.project(&skeleton, 3, p), 0.0);
    skeleton.joints[4] = skeleton.joints[3] + DVec3::X * 1e-300;
    assert_eq!(graph.project(&skeleton, 3, p), 0.0);
}

#[test]
fn real_skeletons_share_a_topology() {
    let Some(assets) = assets() else { return };
    let source = read_skeleton(&assets.join("garments/jumpsuit_dense/skeleton.obj"));
    source.check("source skeleton").unwrap();
    let graph = BoneGraph::new(&source);
    let leaves: Vec<u32> = (0..15).filter(|&j| graph.is_leaf(j)).collect();
    assert_eq!(leaves, [2, 5, 7, 11, 14]);
    for avatar in ["Goblin", "FoxGirl", "slim_adult", "heavy_adult", "child"] {
        let target = read_skeleton(&assets.join("avatars").join(avatar).join("skeleton.obj"));
        target.check("target skeleton").unwrap();
        assert_eq!(target.aligned_to(&source).unwrap().bones, source.bones);
    }
}
