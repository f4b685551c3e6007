//! The samples of the closet hold what the demo and the other tests take for granted.

mod avatars;
mod distance;
mod garments;
mod rigs;
mod shells;
mod strange;

use std::collections::{BTreeMap, HashSet};
use std::sync::LazyLock;

use closet::mesh::Mesh;
use closet::skeleton::{ARMS, BONES, JOINTS, LEGS, NECK, ROOT, WAIST};
use closet::{Kind, Sample, sample};
use distance::Triangles;
use glam::DVec3;

static MANNEQUIN: LazyLock<Sample> = LazyLock::new(|| sample(Kind::Mannequin));
static HEAVY: LazyLock<Sample> = LazyLock::new(|| sample(Kind::Heavy));
static CREATURE: LazyLock<Sample> = LazyLock::new(|| sample(Kind::Creature));
static JACKET: LazyLock<Sample> = LazyLock::new(|| sample(Kind::Jacket));

fn bodies() -> [&'static Sample; 3] {
    [&MANNEQUIN, &HEAVY, &CREATURE]
}

/// Vertices - edges + triangles, after a check that every directed edge appears once and each vertex has one fan.
fn euler_characteristic(mesh: &Mesh) -> i64 {
    let mut directed = HashSet::new();
    for &[a, b, c] in &mesh.triangles {
        for side in [(a, b), (b, c), (c, a)] {
            assert!(side.0 != side.1 && directed.insert(side), "edge {side:?} twice in one direction");
        }
    }
    let mut degree = vec![0i64; mesh.positions.len()];
    let mut starts = vec![0i64; mesh.positions.len()];
    for &(a, b) in &directed {
        degree[a as usize] += 1;
        starts[a as usize] += i64::from(!directed.contains(&(b, a)));
    }
    assert!(degree.iter().all(|&d| d > 0), "a vertex without triangles");
    assert!(starts.iter().all(|&s| s <= 1), "two fans meet in one boundary vertex");
    mesh.positions.len() as i64 - mesh.edges().len() as i64 + mesh.triangles.len() as i64
}

fn smallest_angles(mesh: &Mesh) -> Vec<f64> {
    let corner = |p: DVec3, q: DVec3, r: DVec3| (q - p).angle_between(r - p).to_degrees();
    (0..mesh.triangles.len() as u32)
        .map(|t| {
            let [a, b, c] = mesh.corners(t);
            corner(a, b, c).min(corner(b, c, a)).min(corner(c, a, b))
        })
        .collect()
}

/// The longest side of the box around the joints: 2 in the normalised space.
fn longest_side(sample: &Sample) -> f64 {
    let low = sample.skeleton.joints.iter().copied().fold(DVec3::INFINITY, DVec3::min);
    let high = sample.skeleton.joints.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
    (high - low).max_element()
}

/// The closed boundary curves, each along the direction of its triangles.
fn boundary_loops(mesh: &Mesh) -> Vec<Vec<u32>> {
    let sides = |&[a, b, c]: &[u32; 3]| [(a, b), (b, c), (c, a)];
    let all: HashSet<(u32, u32)> = mesh.triangles.iter().flat_map(sides).collect();
    let mut next: BTreeMap<u32, u32> = all.iter().copied().filter(|&(a, b)| !all.contains(&(b, a))).collect();
    let mut loops = Vec::new();
    while let Some((first, mut at)) = next.pop_first() {
        let mut curve = vec![first];
        while at != first {
            curve.push(at);
            at = next.remove(&at).expect("a boundary curve ends in the open");
        }
        loops.push(curve);
    }
    loops
}

#[test]
fn the_same_bits_every_time() {
    for (kind, first) in [(Kind::Creature, &*CREATURE), (Kind::Jacket, &*JACKET)] {
        assert_eq!(sample(kind), *first);
    }
}

#[test]
fn skeletons_share_their_topology_and_their_pose() {
    let mut degree = [0; JOINTS];
    for joint in BONES.iter().flatten() {
        degree[*joint as usize] += 1;
    }
    assert_eq!(degree[ROOT], 3);
    assert_eq!(degree[WAIST], 4);
    for leaf in [NECK, ARMS[0][2], ARMS[1][2], LEGS[0][2], LEGS[1][2]] {
        assert_eq!(degree[leaf], 1);
    }
    let direction = |sample: &Sample, [a, b]: [u32; 2]| {
        (sample.skeleton.joints[b as usize] - sample.skeleton.joints[a as usize]).normalize()
    };
    for body in bodies() {
        for bone in BONES {
            let angle = direction(body, bone).angle_between(direction(&MANNEQUIN, bone)).to_degrees();
            assert!(angle < 25.0, "bone {bone:?} is turned by {angle} degrees");
        }
        for (left, right) in ARMS[0].iter().chain(&LEGS[0]).zip(ARMS[1].iter().chain(&LEGS[1])) {
            let [l, r] = [*left, *right].map(|joint| body.skeleton.joints[joint]);
            assert!(l.x > 0.0 && (l - r * DVec3::new(-1.0, 1.0, 1.0)).length() < 1e-12);
        }
    }
    assert_eq!(JACKET.skeleton, MANNEQUIN.skeleton);
}

#[test]
fn bodies_are_closed_and_without_handles() {
    for body in bodies() {
        let (_, components) = body.mesh.components();
        assert_eq!(euler_characteristic(&body.mesh), 2 * components as i64);
        assert!(boundary_loops(&body.mesh).is_empty());
        let volume: f64 = (0..body.mesh.triangles.len() as u32)
            .map(|t| body.mesh.corners(t))
            .map(|[a, b, c]| a.dot(b.cross(c)) / 6.0)
            .sum();
        assert!((0.03..0.3).contains(&volume), "volume {volume} cubic metres");
    }
    assert_eq!(MANNEQUIN.mesh.components().1, 1);
    assert_eq!(HEAVY.mesh.components().1, 1);
    assert_eq!(CREATURE.mesh.components().1, 3);
}

#[test]
fn a_horn_goes_through_the_skull() {
    let (component, _) = CREATURE.mesh.components();
    let head = &CREATURE.mesh;
    let skull = Triangles::new(head, |t| component[head.triangles[t as usize][0] as usize] == 0);
    let horn: Vec<DVec3> =
        (0..head.positions.len()).filter(|&v| component[v] == 1).map(|v| head.positions[v]).collect();
    let inside = horn.iter().filter(|p| skull.winding_number(**p) > 0.5).count();
    assert!(inside > 5 && inside < horn.len() / 2, "{inside} of {} vertices are inside", horn.len());
}

#[test]
fn the_jacket_is_an_open_manifold_of_regular_triangles() {
    let mesh = &JACKET.mesh;
    assert!((2000..=4000).contains(&mesh.positions.len()), "{} vertices", mesh.positions.len());
    // A sphere with four holes.
    assert_eq!(mesh.components().1, 1);
    assert_eq!(boundary_loops(mesh).len(), 4);
    assert_eq!(euler_characteristic(mesh), 2 - 4);
    let angles = smallest_angles(mesh);
    assert!(angles.iter().all(|&angle| angle > 15.0));
    assert!(angles.iter().filter(|&&angle| angle < 30.0).count() * 100 < angles.len());
    let scale = 2.0 / longest_side(&JACKET);
    let edges = mesh.edges();
    let lengths = edges
        .iter()
        .map(|e| scale * mesh.positions[e.vertices[0] as usize].distance(mesh.positions[e.vertices[1] as usize]));
    let mean = lengths.sum::<f64>() / edges.len() as f64;
    assert!((0.02..0.04).contains(&mean), "mean edge length {mean} in the normalised space");
}

#[test]
fn the_jackets_rims_are_smooth() {
    let mesh = &JACKET.mesh;
    for curve in boundary_loops(mesh) {
        let at = |i: usize| mesh.positions[curve[i % curve.len()] as usize];
        for i in 0..curve.len() {
            let (before, after) = (at(i + 1) - at(i), at(i + 2) - at(i + 1));
            let turn = before.angle_between(after).to_degrees();
            assert!(turn < 50.0, "a rim of {} vertices turns by {turn} degrees", curve.len());
        }
    }
}

#[test]
fn the_jacket_keeps_clear_of_the_mannequin() {
    let scale = 2.0 / longest_side(&JACKET);
    let body = Triangles::new(&MANNEQUIN.mesh, |_| true);
    let cloth = Triangles::new(&JACKET.mesh, |_| true);
    // Both ways, with the middles of the triangles, so that neither mesh slips through the other between vertices.
    let points = |mesh: &Mesh| {
        let middles = (0..mesh.triangles.len() as u32).map(|t| mesh.corners(t).iter().sum::<DVec3>() / 3.0);
        mesh.positions.iter().copied().chain(middles).collect::<Vec<_>>()
    };
    let nearest = |triangles: &Triangles, points: Vec<DVec3>| {
        points.into_iter().map(|p| triangles.distance(p, 0.03)).fold(f64::INFINITY, f64::min) * scale
    };
    let clearance = nearest(&body, points(&JACKET.mesh)).min(nearest(&cloth, points(&MANNEQUIN.mesh)));
    assert!(clearance > 0.011, "clearance {clearance} in the normalised space");
    let inside = JACKET.mesh.positions.iter().step_by(50).filter(|p| body.winding_number(**p) > 0.5).count();
    assert_eq!(inside, 0);
}

#[test]
fn the_jacket_keeps_clear_of_itself() {
    let scale = 2.0 / longest_side(&JACKET);
    let mesh = &JACKET.mesh;
    let cloth = Triangles::new(mesh, |_| true);
    for (v, &p) in mesh.positions.iter().enumerate() {
        let distance = scale * cloth.distance_unless(p, 0.03, |triangle| triangle.contains(&(v as u32)));
        assert!(distance > 0.004, "vertex {v} comes as close to the cloth as {distance}");
    }
}

#[test]
fn skin_weights_are_smooth_and_follow_the_body() {
    for body in bodies() {
        let count = body.mesh.positions.len();
        assert_eq!(body.skin.len(), JOINTS);
        assert!(body.skin.iter().all(|row| row.len() == count && row.iter().all(|w| (0.0..=1.0).contains(w))));
        for v in 0..count {
            let sum: f64 = body.skin.iter().map(|row| row[v]).sum();
            assert!((sum - 1.0).abs() < 1e-9);
        }
        for edge in body.mesh.edges() {
            let [a, b] = edge.vertices.map(|v| v as usize);
            assert!(body.skin.iter().all(|row| (row[a] - row[b]).abs() < 0.4), "edge {:?}", edge.vertices);
        }
        // The outermost vertex on the left belongs to the left hand, the topmost to the head.
        let positions = &body.mesh.positions;
        let furthest = |axis: DVec3| {
            (0..count).max_by(|&a, &b| positions[a].dot(axis).total_cmp(&positions[b].dot(axis))).unwrap()
        };
        assert!(body.skin[ARMS[0][2]][furthest(DVec3::X)] > 0.9);
        assert!(body.skin[ARMS[1][2]][furthest(DVec3::NEG_X)] > 0.9);
        assert!(body.skin[NECK][furthest(DVec3::Z)] > 0.9);
    }
}

#[test]
fn texture_and_list_belong_to_the_jacket() {
    let (mesh, texture) = (&JACKET.mesh, &JACKET.texture);
    assert_eq!(texture.triangles.len(), mesh.triangles.len());
    assert!(texture.coordinates.iter().flatten().all(|c| (0.0..=1.0).contains(c)));
    assert!(texture.coordinates.len() > mesh.positions.len(), "the seams double some vertices");
    let folded = texture.triangles.iter().filter(|t| {
        let [a, b, c] = t.map(|i| texture.coordinates[i as usize]);
        (b[0] - a[0]) * (c[1] - a[1]) <= (b[1] - a[1]) * (c[0] - a[0])
    });
    assert!(folded.count() * 100 < mesh.triangles.len(), "the atlas is mirrored or folded");
    assert!(!JACKET.no_fit.is_empty() && JACKET.no_fit.len() * 5 < mesh.positions.len());
    assert!(JACKET.no_fit.iter().all(|&v| (v as usize) < mesh.positions.len()));
}
