//! Where the shrunk avatar penetrates the garment: what is repaired, what is refused, and what is reported about it.

use std::f64::consts::TAU;
use std::sync::Arc;

use bespoke::control::{Cancel, Stage};
use bespoke::error::{Error, ErrorKind};
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::diagnostic::{Diagnostic, DiagnosticKind, ElementKind, Severity, Subject};
use bespoke::input::skeleton::Skeleton;
use bespoke::input::weld::Weld;
use bespoke::options::Options;
use bespoke::session::{Precision, Session};
use bespoke::stage::setup::problem::{Inputs, Problem};
use bespoke::stage::start::projection::project;
use bespoke::verify::intersections;
use glam::DVec3;

/// A tube of rings about `centre(z)`, its ends open or closed by fans.
pub fn tube(
    [low, high]: [f64; 2],
    centre: impl Fn(f64) -> DVec3,
    radius: impl Fn(f64) -> f64,
    [rings, sides]: [u32; 2],
    closed: [bool; 2],
) -> TriangleMesh {
    let mut mesh = TriangleMesh::default();
    for r in 0..=rings {
        let z = low + (high - low) * f64::from(r) / f64::from(rings);
        for s in 0..sides {
            let angle = TAU * f64::from(s) / f64::from(sides);
            mesh.positions.push(centre(z) + radius(z) * DVec3::new(angle.cos(), angle.sin(), 0.0));
        }
    }
    for r in 0..rings {
        for s in 0..sides {
            let at = |r: u32, s: u32| r * sides + s % sides;
            mesh.triangles.push([at(r, s), at(r, s + 1), at(r + 1, s)]);
            mesh.triangles.push([at(r, s + 1), at(r + 1, s + 1), at(r + 1, s)]);
        }
    }
    for (ring, z, closed) in [(0, low, closed[0]), (rings, high, closed[1])] {
        if closed {
            let tip = mesh.positions.len() as u32;
            mesh.positions.push(centre(z));
            mesh.triangles.extend((0..sides).map(|s| [ring * sides + s, ring * sides + (s + 1) % sides, tip]));
        }
    }
    mesh
}

pub fn chain(joints: &[[f64; 3]]) -> Skeleton {
    let count = joints.len() as u32;
    Skeleton {
        joints: joints.iter().map(|&j| DVec3::from(j)).collect(),
        bones: (1..count).map(|j| [j - 1, j]).collect(),
    }
}

fn straight_arm() -> Skeleton {
    chain(&[[0.0, 0.0, -1.0], [0.0; 3], [0.0, 0.0, 1.0]])
}

/// A body around the z axis.
fn body(high: f64) -> TriangleMesh {
    tube([-1.1, high], |z| DVec3::new(0.0, 0.0, z), |_| 0.2, [20, 14], [true; 2])
}

pub struct Case {
    pub garment: TriangleMesh,
    pub source: Skeleton,
    pub avatar: TriangleMesh,
    pub target: Skeleton,
}

impl Case {
    pub fn problem(&self, diagnostics: &mut Vec<Diagnostic>) -> Result<Problem, Error> {
        self.problem_with(&Options::default(), diagnostics)
    }

    pub fn problem_with(&self, options: &Options, diagnostics: &mut Vec<Diagnostic>) -> Result<Problem, Error> {
        let (weld, _) = Weld::new(&self.garment);
        let inputs = Inputs {
            garment: &weld.mesh,
            weld: Arc::new(weld.clone()),
            source_skeleton: &self.source,
            avatar: &self.avatar.clone().into(),
            target_skeleton: &self.target,
            skin: None,
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
        Problem::new(&inputs, options, &Cancel::new(), diagnostics)
    }

    pub fn shrunk_penetrates(&self) -> bool {
        let projected = project(&self.avatar, &self.target, &self.source, None);
        let shrunk = TriangleMesh { positions: projected.start, triangles: projected.triangles };
        intersections(&self.garment, Some(&shrunk), 1).unwrap().count > 0
    }

    /// Repaired: a clean start with some room, warnings that name bones, and a session that ends with a clean result.
    pub fn is_repaired(&self) -> Vec<Diagnostic> {
        assert!(self.shrunk_penetrates(), "the avatar penetrates to begin with");
        let mut diagnostics = Vec::new();
        let problem = self.problem(&mut diagnostics).unwrap();
        assert!(!diagnostics.is_empty());
        for diagnostic in &diagnostics {
            assert_eq!(
                (diagnostic.kind(), diagnostic.severity()),
                (DiagnosticKind::AvatarPenetrates, Severity::Warning)
            );
            assert!((1..=4).contains(&diagnostic.elements().len()), "{diagnostic}");
        }
        let crossings =
            edge_crossings(&problem.rest, &problem.triangles, &problem.projected.start, &problem.projected.triangles);
        assert_eq!(crossings, 0);
        let objective = problem.inflation_objective(&Options::default(), &Cancel::new(), &mut Vec::new()).unwrap();
        assert_eq!(objective.contact.min_separation(), Options::default().min_separation);
        // The pieces still tile the avatar at the end, and know what they are pieces of.
        let area = |p: &[DVec3], t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| p[v as usize]);
            0.5 * (b - a).cross(c - a).length()
        };
        let mut areas: Vec<f64> = problem.avatar.triangles.iter().map(|t| area(&problem.avatar.positions, t)).collect();
        for (piece, &origin) in problem.projected.triangles.iter().zip(&problem.projected.origins) {
            areas[origin as usize] -= area(&problem.projected.end, piece);
        }
        assert!(areas.iter().all(|rest| rest.abs() < 1e-9));

        let mut session = Session::new();
        session.set_garment(self.garment.clone(), Precision::F64).unwrap();
        session.set_source_skeleton(self.source.clone()).unwrap();
        session.set_target_avatar(self.avatar.clone()).unwrap();
        session.set_target_skeleton(self.target.clone()).unwrap();
        assert_eq!(session.run().unwrap(), Stage::Done);
        assert!(session.verify(Precision::F64).unwrap().is_clean());
        diagnostics
    }

    /// Refused, with a message and diagnostics that name triangles and bone.
    fn is_refused(&self) -> String {
        self.is_refused_with(&Options::default())
    }

    fn is_refused_with(&self, options: &Options) -> String {
        let mut diagnostics = Vec::new();
        let error = self.problem_with(options, &mut diagnostics).err().expect("refused");
        assert_eq!(error.kind, ErrorKind::NotEnclosed);
        for diagnostic in &diagnostics {
            assert_eq!((diagnostic.kind(), diagnostic.severity()), (DiagnosticKind::AvatarPenetrates, Severity::Error));
            let [garment, bone, avatar] = diagnostic.elements()[..] else { panic!("three elements: {diagnostic:?}") };
            assert_eq!((garment.subject, garment.kind), (Subject::Garment, ElementKind::Triangle));
            assert_eq!((bone.subject, bone.kind), (Subject::SourceSkeleton, ElementKind::Bone));
            assert_eq!((avatar.subject, avatar.kind), (Subject::TargetAvatar, ElementKind::Triangle));
            assert!((garment.index as usize) < self.garment.triangles.len());
            assert!((avatar.index as usize) < self.avatar.triangles.len());
        }
        assert_eq!(diagnostics.is_empty(), !self.shrunk_penetrates());
        error.message
    }
}

/// Edges of each mesh through triangles of the other, all against all, in plain arithmetic.
pub fn edge_crossings(p: &[DVec3], garment: &[[u32; 3]], q: &[DVec3], pieces: &[[u32; 3]]) -> usize {
    let through = |a: DVec3, b: DVec3, [x, y, z]: [DVec3; 3]| {
        let (e, f, d) = (y - x, z - x, b - a);
        let n = d.cross(f);
        let det = e.dot(n);
        if det.abs() < 1e-14 {
            return false;
        }
        let from = a - x;
        let (u, m) = (from.dot(n) / det, from.cross(e));
        let (v, t) = (d.dot(m) / det, f.dot(m) / det);
        u >= 0.0 && v >= 0.0 && u + v <= 1.0 && (0.0..=1.0).contains(&t)
    };
    let mut count = 0;
    for s in garment {
        let s = s.map(|v| p[v as usize]);
        for t in pieces {
            let t = t.map(|v| q[v as usize]);
            count += (0..3).filter(|&i| through(t[i], t[(i + 1) % 3], s)).count();
            count += (0..3).filter(|&i| through(s[i], s[(i + 1) % 3], t)).count();
        }
    }
    count
}

fn bones(diagnostics: &[Diagnostic]) -> Vec<u32> {
    let bone = |f: &Diagnostic| f.elements().iter().find(|e| e.kind == ElementKind::Bone).map(|e| e.index);
    diagnostics.iter().filter_map(bone).collect()
}

/// The hand goes on beyond its bone and out of a closed mitten: that part is retracted along the bone.
#[test]
fn fingers_beyond_a_closed_mitten() {
    let garment = tube([-0.5, 1.05], |z| DVec3::new(0.0, 0.0, z), |_| 0.25, [20, 16], [false, true]);
    let case = Case { garment, source: straight_arm(), avatar: body(1.3), target: straight_arm() };
    let diagnostics = case.is_repaired();
    assert_eq!(bones(&diagnostics), [1]);
    assert!(
        diagnostics[0].to_string().contains("pulled back") && !diagnostics[0].to_string().contains("aside"),
        "{}",
        diagnostics[0]
    );
    let problem = case.problem(&mut Vec::new()).unwrap();
    let tip = problem.projected.shrunk.iter().map(|p| p.z).fold(f64::NEG_INFINITY, f64::max);
    assert!((1.0..1.05).contains(&tip), "just inside the closed end: {tip}");
}

/// Finger bones beyond a closed sleeve: all that lies beyond it is retracted.
#[test]
fn finger_bones_beyond_a_closed_sleeve() {
    let mut hand = chain(&[[0.0, 0.0, -1.0], [0.0; 3], [0.0, 0.0, 0.75], [0.04, 0.0, 0.9], [-0.04, 0.0, 0.9]]);
    hand.bones = vec![[0, 1], [1, 2], [2, 3], [2, 4]];
    let garment = tube([-0.6, 0.7], |z| DVec3::new(0.0, 0.0, z), |_| 0.3, [18, 16], [false, true]);
    let case = Case { garment, source: hand.clone(), avatar: body(1.0), target: hand };
    assert_eq!(bones(&case.is_repaired()), [1, 2, 3]);
}

/// A sleeve that bows to one side: the bones leave it and come back in.
#[test]
fn a_sleeve_that_bows_to_the_side() {
    for bow in [0.3, 0.4] {
        let centre = |z: f64| DVec3::new(bow * (-9.0 * (z - 0.4) * (z - 0.4)).exp(), 0.0, z);
        let garment = tube([-0.7, 0.9], centre, |_| 0.2, [32, 18], [false; 2]);
        let avatar = tube([-1.1, 1.15], |z| DVec3::new(0.0, 0.0, z), |_| 0.12, [20, 14], [true; 2]);
        let case = Case { garment, source: straight_arm(), avatar, target: straight_arm() };
        let diagnostics = case.is_repaired();
        assert_eq!(bones(&diagnostics), [1]);
        assert!(diagnostics[0].to_string().contains("aside"), "{}", diagnostics[0]);
    }
}

/// A tail with a bone, through the middle of a sleeve that has no hole there: refused with both parts, and what to leave out.
#[test]
fn a_tail_through_cloth_is_refused_with_what_to_leave_out() {
    let mut tailed = straight_arm();
    tailed.joints.push(DVec3::new(0.0, 1.4, 0.1));
    tailed.bones.push([1, 3]);
    let tail = tube([0.1, 1.4], |z| DVec3::new(0.0, 0.0, z), |z| 0.08 * (1.5 - z), [12, 8], [true; 2]);
    let mut avatar = body(1.1);
    let first = avatar.positions.len() as u32;
    // From along z to along y.
    avatar.positions.extend(tail.positions.iter().map(|p| DVec3::new(p.x, p.z, 0.1 - p.y)));
    avatar.triangles.extend(tail.triangles.iter().map(|t| t.map(|v| v + first)));
    let garment = tube([-0.6, 0.7], |z| DVec3::new(0.0, 0.0, z), |_| 0.3, [18, 16], [false; 2]);
    let case = Case { garment, source: tailed.clone(), avatar, target: tailed };
    let message = case.is_refused();
    println!("{message}");
    for words in [
        "between joints 1 and 3",
        "(avatar triangle ",
        "at garment triangles ",
        "no opening for that part, as for a tail",
    ] {
        assert!(message.contains(words), "{message}");
    }
    let named = |words: &str| -> u32 {
        let rest = &message[message.find(words).unwrap() + words.len()..];
        rest[..rest.find(|c: char| !c.is_ascii_digit()).unwrap()].parse().unwrap()
    };
    assert!(named("(avatar triangle ") >= body(1.1).triangles.len() as u32, "of the tail: {message}");
    // On the side of the sleeve where the tail is.
    let [a, b, c] =
        case.garment.triangles[named("at garment triangles ") as usize].map(|v| case.garment.positions[v as usize]);
    assert!((a + b + c).y / 3.0 > 0.2 && ((a + b + c).z / 3.0 - 0.1).abs() < 0.2, "{message}");
}

/// A sleeve that turns aside before the wrist, so that the hand would pass through its wall.
fn turned_sleeve(aside: f64, from: f64) -> Case {
    let wrist = chain(&[[0.0, 0.0, -1.0], [0.0; 3], [0.0, 0.0, 0.6]]);
    let garment =
        tube([-0.7, 0.9], |z| DVec3::new(aside * (z - from).max(0.0), 0.0, z), |_| 0.14, [32, 18], [false; 2]);
    let avatar = tube([-1.1, 1.3], |z| DVec3::new(0.0, 0.0, z), |_| 0.12, [24, 14], [true; 2]);
    Case { garment, source: wrist.clone(), avatar, target: wrist }
}

/// What goes beyond the last joint counts as much as what is before it: the whole hand is pulled back, and that is said with its
/// share and what it may lead to.
#[test]
fn a_hand_that_is_pulled_back_whole_is_said() {
    let case = turned_sleeve(0.7, 0.3);
    let mut diagnostics = Vec::new();
    case.problem(&mut diagnostics).unwrap();
    let [Diagnostic::BoneMoved { bone, shares: [_, beyond], .. }] = diagnostics[..] else { panic!("{diagnostics:?}") };
    assert_eq!(bone.index, 1);
    assert!(beyond > 0.9, "{beyond}");
    let sentence = diagnostics[0].to_string();
    assert!(sentence.contains("beyond its end") && sentence.contains("may be shut up in it"), "{sentence}");
}

/// A straight sleeve on a bent arm: the elbow itself is outside, and both bones that meet there.
#[test]
fn an_elbow_outside_its_sleeve() {
    let bent = chain(&[[0.0, 0.0, -1.0], [0.3, 0.05, 0.0], [0.0, 0.0, 1.0]]);
    let garment = tube([-0.75, 0.75], |z| DVec3::new(0.0, 0.0, z), |_| 0.24, [28, 18], [false; 2]);
    let case = Case { garment, source: bent, avatar: body(1.1), target: straight_arm() };
    let diagnostics = case.is_repaired();
    assert_eq!(bones(&diagnostics), [0, 1]);
    let problem = case.problem(&mut Vec::new()).unwrap();
    let elbow = problem.projected.shrunk.iter().filter(|p| p.z.abs() < 0.02).map(|p| p.x).fold(0.0, f64::max);
    assert!(elbow < 0.3, "{elbow}");
}

/// A dent of the garment between bones that form a cycle, in the triangle that the body keeps there.
#[test]
fn a_dent_within_a_cycle_of_bones() {
    let pelvis = Skeleton {
        joints: [
            [0.0, 0.0, 1.0],
            [0.0, 0.0, 0.3],
            [0.4, 0.0, -0.3],
            [-0.4, 0.0, -0.3],
            [0.4, 0.0, -1.0],
            [-0.4, 0.0, -1.0],
        ]
        .map(DVec3::from)
        .to_vec(),
        bones: vec![[0, 1], [1, 2], [1, 3], [2, 3], [2, 4], [3, 5]],
    };
    let mut garment = tube([-0.75, 0.7], |z| DVec3::new(0.0, 0.0, z), |_| 0.7, [16, 24], [false; 2]);
    let dent = DVec3::new(0.0, 0.7, -0.1);
    let nearest = (0..garment.positions.len())
        .min_by(|&a, &b| garment.positions[a].distance(dent).total_cmp(&garment.positions[b].distance(dent)))
        .unwrap();
    garment.positions[nearest] = DVec3::new(0.0, -0.15, -0.1);
    let avatar = tube([-1.1, 1.1], |z| DVec3::new(0.0, 0.0, z), |_| 0.55, [3, 8], [true; 2]);
    let case = Case { garment, source: pelvis.clone(), avatar, target: pelvis };
    let diagnostics = case.is_repaired();
    assert!(diagnostics.iter().any(|f| f.to_string().contains("cycle")), "{diagnostics:?}");
}

/// A sheet across the arm like a wall, so wide that no path goes around it.
#[test]
fn a_wall_across_a_bone_is_refused() {
    let positions = [[-3.0, -3.0, 0.5], [3.0, -3.0, 0.52], [0.0, 4.0, 0.48]].map(DVec3::from).to_vec();
    let garment = TriangleMesh { positions, triangles: vec![[0, 1, 2]] };
    let case = Case { garment, source: straight_arm(), avatar: body(1.1), target: straight_arm() };
    let message = case.is_refused();
    assert!(message.contains("between joints 1 and 2") && message.contains("triangles 0 (1 in all)"), "{message}");
}

/// Closed at both ends, which are to stay so: most of the arm is outside, and to retract all of it would dress nothing.
#[test]
fn a_garment_closed_around_the_middle_of_an_arm_is_refused() {
    let garment = tube([-0.6, 0.6], |z| DVec3::new(0.0, 0.0, z), |_| 0.3, [16, 16], [true; 2]);
    let case = Case { garment, source: straight_arm(), avatar: body(1.1), target: straight_arm() };
    let message = case.is_refused_with(&Options { keep_caps: true, ..Options::default() });
    assert!(message.contains("between joints 0 and 1"), "{message}");
}

/// Beside its skeleton by half its width and more: nothing penetrates, and yet the garment encloses nothing.
#[test]
fn a_garment_beside_its_skeleton_is_refused() {
    for away in [0.31, 0.4, 0.9] {
        let garment = tube([-0.6, 0.6], |z| DVec3::new(away, 0.0, z), |_| 0.3, [16, 24], [false; 2]);
        let case = Case { garment, source: straight_arm(), avatar: body(1.1), target: straight_arm() };
        assert!(case.is_refused().contains("does not enclose the source skeleton"));
    }
    // Above the arm, though on the line of its last bone.
    let garment = tube([1.6, 2.4], |z| DVec3::new(0.0, 0.0, z), |_| 0.3, [16, 24], [false; 2]);
    let case = Case { garment, source: straight_arm(), avatar: body(1.1), target: straight_arm() };
    assert!(case.is_refused().contains("does not enclose the source skeleton"));
}

/// What does not penetrate stays as it was, to the bit.
#[test]
fn a_start_that_is_clean_is_left_alone() {
    let garment = tube([-0.6, 0.7], |z| DVec3::new(0.0, 0.0, z), |_| 0.3, [18, 16], [false; 2]);
    let case = Case { garment, source: straight_arm(), avatar: body(1.1), target: straight_arm() };
    let mut diagnostics = Vec::new();
    let problem = case.problem(&mut diagnostics).unwrap();
    assert!(diagnostics.is_empty());
    // The skeleton is in its normalised space already.
    let projected = project(&case.avatar, &case.target, &case.source, None);
    assert_eq!(problem.projected.start, projected.start);
    assert_eq!(problem.projected.triangles, projected.triangles);
}
