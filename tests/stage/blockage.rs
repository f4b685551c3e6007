//! What holds the garment where the inflation stalls: two boxes that grow towards a garment around one of them.

use std::sync::Arc;

use bespoke::contact::Configuration;
use bespoke::control::Cancel;
use bespoke::geometry::closest_point::closest_on_triangle;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::body::Body;
use bespoke::input::diagnostic::{AvatarPart, Diagnostic, Element, Subject};
use bespoke::input::skeleton::Skeleton;
use bespoke::input::skin::SkinWeights;
use bespoke::input::weld::Weld;
use bespoke::options::Options;
use bespoke::stage::blockage;
use bespoke::stage::setup::problem::{Inputs, Problem};
use bespoke::verify::intersections;
use glam::{DQuat, DVec3};

use testing::Random;

/// A box with `n` times `n` squares a side, or without its two ends.
fn block(low: DVec3, high: DVec3, n: u32, ends: bool) -> TriangleMesh {
    let mut mesh = TriangleMesh::default();
    for axis in 0..if ends { 3 } else { 2 } {
        for side in [0.0, 1.0] {
            let first = mesh.positions.len() as u32;
            for i in 0..=n {
                for j in 0..=n {
                    let mut share = DVec3::ZERO;
                    share[axis] = side;
                    share[(axis + 1) % 3] = f64::from(i) / f64::from(n);
                    share[(axis + 2) % 3] = f64::from(j) / f64::from(n);
                    mesh.positions.push(low + share * (high - low));
                }
            }
            for i in 0..n {
                for j in 0..n {
                    let a = first + i * (n + 1) + j;
                    let [b, c, d] = [a + n + 1, a + 1, a + n + 2];
                    let squares = if side > 0.0 { [[a, b, d], [a, d, c]] } else { [[a, d, b], [a, c, d]] };
                    mesh.triangles.extend(squares);
                }
            }
        }
    }
    mesh
}

/// Two parallel bones at x = 0 and x = 1, joined by a third, far from the garment.
fn skeleton() -> Skeleton {
    let joints = [[0.0, 0.0, -1.0], [0.0, 0.0, 1.0], [1.0, 0.0, -1.0], [1.0, 0.0, 1.0]];
    Skeleton { joints: joints.map(DVec3::from).to_vec(), bones: vec![[0, 1], [2, 3], [1, 3]] }
}

struct Case {
    /// A garment without ends around the first bone.
    garment: TriangleMesh,
    /// The boxes around the two bones at full size.
    boxes: [TriangleMesh; 2],
    t: f64,
    turn: DQuat,
}

impl Case {
    /// The diagnostics of the garment where it is, and at t, after a check of what no case may miss.
    fn found(&self) -> Vec<Diagnostic> {
        let turned = |mesh: &TriangleMesh| TriangleMesh {
            positions: mesh.positions.iter().map(|&p| self.turn * p).collect(),
            triangles: mesh.triangles.clone(),
        };
        let mut avatar = turned(&self.boxes[0]);
        let first = avatar.positions.len() as u32;
        let other = turned(&self.boxes[1]);
        avatar.positions.extend(&other.positions);
        avatar.triangles.extend(other.triangles.iter().map(|t| t.map(|v| v + first)));
        // Joints 0 and 2 belong to one bone each.
        let vertices = avatar.positions.len();
        let weight = |joint, v| if joint == [0, 2][usize::from(v >= first as usize)] { 1.0 } else { 0.0 };
        let weights: Vec<f64> = (0..4).flat_map(|joint| (0..vertices).map(move |v| weight(joint, v))).collect();
        let skin = SkinWeights::from_dense(&weights, 4, vertices, "skin").unwrap();
        let bones = Skeleton { joints: skeleton().joints.iter().map(|&p| self.turn * p).collect(), ..skeleton() };
        let body = Body::from(avatar);
        let (weld, _) = Weld::new(&turned(&self.garment));
        let inputs = Inputs {
            garment: &weld.mesh,
            weld: Arc::new(weld.clone()),
            source_skeleton: &bones,
            avatar: &body,
            target_skeleton: &bones,
            skin: Some(&skin),
            ends: [None, None],
            source_avatar: None,
            fit_weights: None,
            pins: &[],
            rigid_groups: &[],
            curves: &[],
            offset: 0.0,
            coordinate_error: 0.0,
            turns: true,
            known: Arc::default(),
        };
        let options = Options::default();
        let problem = Problem::new(&inputs, &options, &Cancel::new(), &mut Vec::new()).unwrap();
        let mut objective = problem.inflation_objective(&options, &Cancel::new(), &mut Vec::new()).unwrap();
        let at = Configuration { x: &problem.rest, t: self.t };
        let found = blockage::find(&problem, &body, &mut objective, at);
        assert_eq!(found, blockage::find(&problem, &body, &mut objective, at), "the same twice");

        // What is named is near: by many points of the garment triangle, against pieces of the avatar's triangle at t.
        let near = |garment: u32, part: &AvatarPart| {
            assert_eq!(part.triangle.subject, Subject::TargetAvatar);
            let kept = weld.to_kept[garment as usize].unwrap();
            let [a, b, c] = problem.triangles[kept as usize].map(|v| problem.rest[v as usize]);
            let pieces = problem.projected.origins.iter().zip(&problem.projected.triangles);
            let now = |v: u32| problem.projected.start[v as usize].lerp(problem.projected.end[v as usize], self.t);
            let pieces: Vec<[DVec3; 3]> =
                pieces.filter(|(o, _)| **o == part.triangle.index).map(|(_, t)| t.map(now)).collect();
            let count = 40;
            let points =
                (0..=count).flat_map(|i| (0..=count - i).map(move |j| [i, j].map(|k| f64::from(k) / f64::from(count))));
            let distance =
                |p: DVec3| pieces.iter().map(|t| closest_on_triangle(p, t).distance(p)).fold(f64::INFINITY, f64::min);
            points.map(|[u, v]| distance(a + u * (b - a) + v * (c - a))).fold(f64::INFINITY, f64::min)
        };
        for diagnostic in &found {
            match diagnostic {
                Diagnostic::InflationHeld { garment, part, distance, .. } => {
                    assert!((near(*garment, part) - distance).abs() < 2e-3 && *distance < options.inflation_dhat);
                }
                Diagnostic::InflationSqueezed { garment, parts, .. } => {
                    assert!(near(*garment, &parts[0]) < options.inflation_dhat);
                    // The second part may push against a neighbour of the triangle.
                    let own = problem.triangles[weld.to_kept[*garment as usize].unwrap() as usize];
                    let mut beside =
                        (0u32..).zip(&problem.triangles).filter(|(_, t)| t.iter().any(|v| own.contains(v)));
                    assert!(
                        beside.any(|(t, _)| near(weld.triangle_of[t as usize], &parts[1]) < options.inflation_dhat)
                    );
                }
                other => panic!("{other:?}"),
            }
            assert!(diagnostic.to_string().len() < 511, "{diagnostic}");
            assert_eq!(diagnostic.elements()[0].subject, Subject::Garment);
        }
        found
    }
}

fn bones(parts: &[AvatarPart; 2]) -> [u32; 2] {
    let [a, b] = parts.map(|part| part.bone.unwrap().index);
    [a.min(b), a.max(b)]
}

/// A garment in the gap of two boxes that grow towards each other, of all sizes and finenesses, wherever they are: both are
/// named, and they are reported to touch if they do at full size, by an exact test of the whole boxes.
#[test]
fn both_sides_are_named_and_whether_they_touch() {
    let mut random = Random::new(7);
    let mut counts = [0; 2];
    for round in 0..60 {
        let mut uniform = |low: f64, high: f64| low + (high - low) * random.unit();
        let whole = if round % 2 == 0 { uniform(0.985, 0.9999) } else { uniform(1.0001, 1.2) };
        let first = uniform(0.35, 0.65);
        let (n, m, k) = (1 + round % 4, 1 + round / 4 % 3, 3 + round % 5);
        // The gap is a hundredth or less, and the garment in the middle of it.
        let t = (uniform(0.988, 0.994) / whole).min(1.0);
        let middle = 0.5 * (t * first + 1.0 - t * (whole - first));
        let point = DVec3::new;
        let boxes = [
            block(point(-0.4, -0.4, -0.9), point(first, 0.4, 0.9), n, true),
            block(point(1.0 - (whole - first), -0.3, -0.7), point(1.4, 0.3, 0.7), m, true),
        ];
        let garment = block(point(-0.6, -0.5, -0.5), point(middle, 0.5, 0.5), k, false);
        let axis = point(uniform(-1.0, 1.0), uniform(-1.0, 1.0), uniform(-1.0, 1.0)).normalize();
        let turn = if round < 8 { DQuat::IDENTITY } else { DQuat::from_axis_angle(axis, uniform(0.0, 3.0)) };
        let touch = intersections(&boxes[0], Some(&boxes[1]), 1).unwrap().count > 0;
        assert_eq!(touch, whole > 1.0);
        let mut case = Case { garment, boxes, t, turn };
        if round % 3 == 0 {
            // Wound the other way.
            case.boxes.iter_mut().flat_map(|mesh| &mut mesh.triangles).for_each(|t| t.swap(1, 2));
        }
        let found = case.found();
        let [Diagnostic::InflationSqueezed { parts, same, gap, .. }] = &found[..] else { panic!("{round}: {found:?}") };
        assert_eq!((bones(parts), *same), ([0, 1], false));
        // Normalised, the skeleton is 2 long however it is turned.
        let longest = |f: fn(f64, f64) -> f64, start: f64| {
            skeleton()
                .joints
                .iter()
                .map(|&p| turn * p)
                .fold(DVec3::splat(start), |m, p| DVec3::new(f(m.x, p.x), f(m.y, p.y), f(m.z, p.z)))
        };
        let size = (longest(f64::max, f64::NEG_INFINITY) - longest(f64::min, f64::INFINITY)).max_element();
        match gap {
            None => assert!(touch, "{round}: they are {} apart", 1.0 - whole),
            Some(gap) => {
                assert!(!touch, "{round}: they overlap by {}", whole - 1.0);
                assert!((gap - (1.0 - whole) * 2.0 / size).abs() < 1e-9, "{round}: {gap} {}", 1.0 - whole);
            }
        }
        let text = found[0].to_string();
        assert_eq!(text.contains("no garment can pass there"), touch, "{text}");
        assert!(text.contains("bone 0 (joints 0-1)") && text.contains("bone 1 (joints 2-3)"), "{text}");
        counts[usize::from(touch)] += 1;
    }
    assert_eq!(counts, [30, 30]);
}

/// A box that fills the garment pushes from inside alone: however thin it is, it is one part that holds it.
#[test]
fn from_inside_it_is_one_part() {
    let point = DVec3::new;
    for (half, clearance, n) in
        [(0.3, 0.004, 2), (0.3, 0.008, 3), (0.004, 0.003, 2), (0.001, 0.006, 4), (0.002, 0.009, 1)]
    {
        let boxes = [
            block(point(-half, -0.3, -0.9), point(half, 0.3, 0.9), n, true),
            block(point(0.8, -0.1, -0.5), point(1.2, 0.1, 0.5), 1, true),
        ];
        let out = half + clearance;
        let garment = block(point(-out, -0.4, -0.5), point(out, 0.4, 0.5), 4, false);
        let found = Case { garment, boxes, t: 1.0, turn: DQuat::IDENTITY }.found();
        let [diagnostic @ Diagnostic::InflationHeld { part, distance, held, .. }] = &found[..] else {
            panic!("{found:?}")
        };
        assert_eq!(part.bone.unwrap().index, 0);
        // It may be a thin box's edge that pushes hardest, from a little farther away.
        assert!((clearance - 1e-9..0.01).contains(distance) && *held > 8, "{distance} {held}");
        assert_eq!(diagnostic.elements()[2], Element::bone(Subject::SourceSkeleton, 0));
        let text = diagnostic.to_string();
        assert!(
            text.contains("one side") && !text.contains("between") && text.contains("bone 0 (joints 0-1)"),
            "{text}"
        );
    }
}

/// Far from everything, nothing holds it.
#[test]
fn without_contact_there_is_nothing_to_say() {
    let point = DVec3::new;
    let small = |x: f64| block(point(x - 0.1, -0.1, -0.9), point(x + 0.1, 0.1, 0.9), 2, true);
    let garment = block(point(-0.4, -0.4, -0.5), point(0.4, 0.4, 0.5), 3, false);
    assert_eq!(Case { garment, boxes: [small(0.0), small(1.0)], t: 1.0, turn: DQuat::IDENTITY }.found(), []);
}
