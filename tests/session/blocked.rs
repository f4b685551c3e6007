//! An inflation that cannot end says what holds the garment.

use bespoke::control::Stage;
use bespoke::error::ErrorKind;
use bespoke::geometry::closest_point::closest_on_triangle;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::diagnostic::{AvatarPart, Diagnostic, DiagnosticKind, Severity};
use bespoke::input::skeleton::Skeleton;
use bespoke::input::skin::SkinWeights;
use bespoke::options::Options;
use bespoke::session::{Budget, Precision, Session};
use glam::DVec3;

use crate::small::{arm, session, tube};

/// A box.
pub fn block(low: [f64; 3], high: [f64; 3]) -> TriangleMesh {
    let corner = |k: usize| DVec3::from_array(std::array::from_fn(|i| if k >> i & 1 == 0 { low[i] } else { high[i] }));
    let square = |[a, b, c, d]: [u32; 4]| [[a, b, c], [a, c, d]];
    let sides = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    TriangleMesh { positions: (0..8).map(corner).collect(), triangles: sides.into_iter().flat_map(square).collect() }
}

/// A sleeve around the first of two parallel bones, and a body of a box on each, the second of which ends `gap` away from
/// the first at full size.
pub fn two_boxes(gap: f64, options: Options) -> Session {
    let joints = [[0.0, 0.0, -1.0], [0.0, 0.0, 1.0], [1.0, 0.0, -1.0], [1.0, 0.0, 1.0]];
    let skeleton = Skeleton { joints: joints.map(DVec3::from).to_vec(), bones: vec![[0, 1], [2, 3], [1, 3]] };
    let mut avatar = block([-0.5, -0.4, -0.9], [0.5, 0.4, 0.9]);
    let other = block([0.5 + gap, -0.3, -0.7], [1.4, 0.3, 0.7]);
    avatar.triangles.extend(other.triangles.iter().map(|t| t.map(|v| v + 8)));
    avatar.positions.extend(other.positions);
    // Joints 0 and 2 belong to one bone each.
    let mut weights = vec![0.0; 4 * 16];
    (0..8).for_each(|v| weights[v] = 1.0);
    (8..16).for_each(|v| weights[2 * 16 + v] = 1.0);
    let mut sleeve = tube(-0.5, 0.5, |_, _| 0.3, 12, 20, false);
    sleeve.positions.iter_mut().for_each(|p| p.x -= 0.2 * p.z.max(0.0));
    let mut session = Session::new();
    session.set_garment(sleeve, Precision::F64).unwrap();
    session.set_source_skeleton(skeleton.clone()).unwrap();
    session.set_target_avatar(avatar).unwrap();
    session.set_target_skeleton(skeleton).unwrap();
    session.set_target_skin(SkinWeights::from_dense(&weights, 4, 16, "skin").unwrap()).unwrap();
    session.set_options(options).unwrap();
    session
}

/// What a session that stalls says of it, and its message.
fn stalled(session: &mut Session) -> (Vec<Diagnostic>, String) {
    let error = session.run().unwrap_err();
    assert_eq!((error.kind, session.stage()), (ErrorKind::InflationStalled, Stage::Failed), "{error}");
    assert!(error.message.contains("the diagnostics name what holds") && !error.message.contains("between"), "{error}");
    let of_kind = session.diagnostics().iter().filter(|d| d.kind() == DiagnosticKind::InflationBlocked);
    let found: Vec<Diagnostic> = of_kind.cloned().collect();
    assert!((1..=8).contains(&found.len()));
    for diagnostic in &found {
        println!("{diagnostic}");
        assert_eq!(diagnostic.severity(), Severity::Error);
        let sentence = diagnostic.to_string();
        for element in diagnostic.elements() {
            assert!(sentence.contains(&element.index.to_string()), "{sentence}");
        }
    }
    (found, error.message)
}

/// The distance of a garment triangle from a triangle of the avatar, as they are read, by many points of both.
fn distance(session: &Session, garment: &TriangleMesh, avatar: &TriangleMesh, [g, a]: [u32; 2]) -> f64 {
    let (x, y) = (session.garment_positions().unwrap(), session.avatar_positions().unwrap());
    let s = garment.triangles[g as usize].map(|v| x[v as usize]);
    let t = avatar.triangles[a as usize].map(|v| y[v as usize]);
    let count = 60;
    let on = |[a, b, c]: [DVec3; 3], i: i32, j: i32| {
        let [u, v] = [i, j].map(|k| f64::from(k) / f64::from(count));
        a + u * (b - a) + v * (c - a)
    };
    let mut least = f64::INFINITY;
    for i in 0..=count {
        for j in 0..=count - i {
            for (from, to) in [(s, t), (t, s)] {
                let p = on(from, i, j);
                least = least.min(p.distance(closest_on_triangle(p, &to)));
            }
        }
    }
    least
}

fn squeezed(diagnostic: &Diagnostic) -> (u32, [AvatarPart; 2], Option<f64>) {
    let Diagnostic::InflationSqueezed { garment, parts, same: false, gap, .. } = *diagnostic else {
        panic!("{diagnostic:?}")
    };
    let mut bones = parts.map(|part| part.bone.unwrap().index);
    bones.sort_unstable();
    assert_eq!(bones, [0, 1]);
    (garment, parts, gap)
}

/// The boxes overlap at full size, and the sleeve around one of them is between the two.
#[test]
fn a_garment_between_parts_that_overlap_is_reported_so() {
    let mut session = two_boxes(-0.1, Options::default());
    let (found, message) = stalled(&mut session);
    assert!(message.contains("others that were tried") || message.contains("max_iterations"), "{message}");
    let (garment, parts, gap) = squeezed(&found[0]);
    assert_eq!((gap, found[0].distance()), (None, 0.0));
    let sentence = found[0].to_string();
    for words in ["no garment can pass there", "touch each other at full size", "(joints 0-1)", "(joints 2-3)"] {
        assert!(sentence.contains(words), "{sentence}");
    }
    let cloth = tube(-0.5, 0.5, |_, _| 0.3, 12, 20, false);
    let mut body = block([-0.5, -0.4, -0.9], [0.5, 0.4, 0.9]);
    body.triangles.extend(body.triangles.clone().iter().map(|t| t.map(|v| v + 8)));
    // Each pushes against the triangle, or against a neighbour of it.
    let own = cloth.triangles[garment as usize];
    let beside: Vec<u32> = (0..cloth.triangles.len() as u32)
        .filter(|&t| cloth.triangles[t as usize].iter().any(|v| own.contains(v)))
        .collect();
    for part in parts {
        let near = |&t: &u32| distance(&session, &cloth, &body, [t, part.triangle.index]) < 0.01;
        assert!(beside.iter().any(near), "triangles {garment} and {}", part.triangle.index);
    }
    // It is said again where the same is done again, and forgotten by a reset.
    session.reset();
    assert!(session.diagnostics().is_empty());
    let mut again = two_boxes(-0.1, Options { threads: 1, ..Options::default() });
    assert_eq!(stalled(&mut again).0, found);
}

/// The boxes leave a gap, and only too few iterations are allowed.
#[test]
fn a_garment_between_parts_that_are_apart_is_reported_with_the_gap() {
    let mut session = two_boxes(0.012, Options::default());
    session.prepare().unwrap();
    // As many iterations as it takes until the garment is in the gap.
    let mut iterations = 0;
    while session.report().t < 0.985 {
        session.step(Budget { iterations: 1, milliseconds: 0 }).unwrap();
        iterations += 1;
    }
    let mut session = two_boxes(0.012, Options { max_iterations: iterations, ..Options::default() });
    let (found, message) = stalled(&mut session);
    assert!(message.contains(&format!("did not end in {iterations} iterations")), "{message}");
    assert!(message.contains("raise max_iterations"), "{message}");
    let (_, _, gap) = squeezed(&found[0]);
    let gap = gap.expect("they do not touch");
    assert!((0.012 - 1e-9..0.2).contains(&gap), "{gap}");
    let sentence = found[0].to_string();
    assert!(!sentence.contains("touch") && sentence.contains("less than two inflation_dhat"), "{sentence}");
}

/// A rigid ring around an arm that outgrows it, and too few iterations: one part holds it, from inside.
#[test]
fn a_garment_that_one_part_holds_is_not_between_parts() {
    let mut session = session(1.0, DVec3::ZERO);
    session.add_rigid_group((100..120).collect()).unwrap();
    session.set_options(Options { max_iterations: 40, ..Options::default() }).unwrap();
    let (found, message) = stalled(&mut session);
    assert!(message.contains("raise max_iterations"), "{message}");
    for diagnostic in &found {
        let Diagnostic::InflationHeld { part, .. } = diagnostic else { panic!("{diagnostic:?}") };
        assert!((part.bone.unwrap().index as usize) < arm(1.0, DVec3::ZERO).bones.len());
        let sentence = diagnostic.to_string();
        assert!(sentence.contains("from one side") && !sentence.contains("between"), "{sentence}");
    }
    // The ring is the sixth of twenty vertices, beside the triangles of two rows.
    let Diagnostic::InflationHeld { garment, .. } = found[0] else { unreachable!() };
    assert!((160..240).contains(&garment), "{garment}");
}
