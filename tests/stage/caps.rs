//! Garments that are closed by caps where bones leave them: the caps are left out while they are fitted, and come back.

use std::f64::consts::{PI, TAU};

use bespoke::control::Stage;
use bespoke::error::{Error, ErrorKind};
use bespoke::geometry::mesh::{Topology, TriangleMesh};
use bespoke::input::diagnostic::{Diagnostic, DiagnosticKind, ElementKind, Severity};
use bespoke::input::skeleton::Skeleton;
use bespoke::input::weld::Weld;
use bespoke::options::Options;
use bespoke::session::{Precision, Session};
use bespoke::stage::setup::cap_motion::CapMotion;
use bespoke::stage::start::caps::{Caps, NoCap};
use closet::{Kind, Sample, jacket, sample};
use glam::{DQuat, DVec3};
use testing::Random;

use crate::bodies;

/// A tube about the z axis, and how it is closed: each end by `rows` rings of triangles and a fan, or not at all. Returns
/// the mesh, and the first triangle of each end's cap; the last is the number of triangles.
fn tube([low, high]: [f64; 2], radius: f64, [rings, sides]: [u32; 2], rows: [u32; 2]) -> (TriangleMesh, [usize; 3]) {
    let mut mesh = TriangleMesh::default();
    let mut ring = |z: f64, radius: f64| {
        let first = mesh.positions.len() as u32;
        mesh.positions.extend((0..sides).map(|s| {
            let angle = TAU * f64::from(s) / f64::from(sides);
            DVec3::new(radius * angle.cos(), radius * angle.sin(), z)
        }));
        first
    };
    let walls: Vec<u32> =
        (0..=rings).map(|r| ring(low + (high - low) * f64::from(r) / f64::from(rings), radius)).collect();
    let mut ends = Vec::new();
    for (first, z, rows) in [(walls[0], low, rows[0]), (walls[rings as usize], high, rows[1])] {
        let inner = (1..rows).map(|k| ring(z, radius * f64::from(rows - k) / f64::from(rows)));
        ends.push((std::iter::once(first).chain(inner).collect::<Vec<u32>>(), z, rows));
    }
    let strip = |a: u32, b: u32| {
        (0..sides).flat_map(move |s| {
            let next = (s + 1) % sides;
            [[a + s, a + next, b + s], [a + next, b + next, b + s]]
        })
    };
    mesh.triangles.extend(walls.windows(2).flat_map(|pair| strip(pair[0], pair[1])));
    let mut firsts = [mesh.triangles.len(); 3];
    for (k, (ring, z, rows)) in ends.into_iter().enumerate() {
        if rows > 0 {
            mesh.triangles.extend(ring.windows(2).flat_map(|pair| strip(pair[0], pair[1])));
            let (last, tip) = (ring[ring.len() - 1], mesh.positions.len() as u32);
            mesh.positions.push(DVec3::new(0.0, 0.0, z));
            mesh.triangles.extend((0..sides).map(|s| [last + s, last + (s + 1) % sides, tip]));
        }
        firsts[k + 1] = mesh.triangles.len();
    }
    (mesh, firsts)
}

fn arm() -> Skeleton {
    let joints = [-1.0, 0.0, 1.0].map(|z| DVec3::new(0.0, 0.0, z)).to_vec();
    Skeleton { joints, bones: vec![[0, 1], [1, 2]] }
}

/// A session with a garment on an arm that is thicker than it, beyond both of its ends.
fn on_arm(garment: &TriangleMesh, options: Options) -> Session {
    let (body, _) = tube([-1.2, 1.2], 0.36, [24, 18], [1, 1]);
    let mut session = Session::new();
    session.set_garment(garment.clone(), Precision::F64).unwrap();
    session.set_source_skeleton(arm()).unwrap();
    session.set_target_avatar(body).unwrap();
    session.set_target_skeleton(arm()).unwrap();
    session.set_options(options).unwrap();
    session
}

fn opened(garment: &TriangleMesh, caps: impl Fn(usize) -> bool) -> TriangleMesh {
    let stays = garment.triangles.iter().enumerate().filter(|(t, _)| !caps(*t)).map(|(_, t)| *t);
    TriangleMesh { positions: garment.positions.clone(), triangles: stays.collect() }
}

fn caps_of(session: &Session) -> Vec<(u32, Vec<u32>)> {
    let cap = |diagnostic: &Diagnostic| match diagnostic {
        Diagnostic::OpeningCap { bone, triangles } => Some((bone.index, triangles.clone())),
        _ => None,
    };
    session.diagnostics().iter().filter_map(cap).collect()
}

/// The vertices that only triangles chosen by `caps` use, and those that others use too.
fn inside(garment: &TriangleMesh, caps: impl Fn(usize) -> bool) -> (Vec<usize>, Vec<usize>) {
    let mut uses = vec![[false; 2]; garment.positions.len()];
    for (t, corners) in garment.triangles.iter().enumerate() {
        corners.iter().for_each(|&v| uses[v as usize][usize::from(!caps(t))] = true);
    }
    let having = |which: [bool; 2]| (0..uses.len()).filter(|&v| uses[v] == which).collect();
    (having([true, false]), having([true, true]))
}

/// The same garment, closed and open, ends the same to the bit; what is within the caps is where the rims are.
#[test]
fn a_capped_tube_ends_like_its_opened_twin() {
    for (sides, rows) in [(16, [1, 1]), (20, [3, 2]), (18, [0, 2])] {
        let (closed, [first, second, end]) = tube([-0.6, 0.65], 0.3, [14, sides], rows);
        let is_cap = |t: usize| t >= first;
        let mut session = on_arm(&closed, Options::default());
        assert_eq!(session.run().unwrap(), Stage::Done, "{:?}", session.diagnostics());
        let mut twin = on_arm(&opened(&closed, is_cap), Options::default());
        assert_eq!(twin.run().unwrap(), Stage::Done);
        assert!(session.verify(Precision::F64).unwrap().is_clean());

        let expected: Vec<(u32, Vec<u32>)> = [(0, first..second), (1, second..end)]
            .into_iter()
            .filter(|(_, range)| !range.is_empty())
            .map(|(bone, range)| (bone, range.map(|t| t as u32).collect()))
            .collect();
        assert_eq!(caps_of(&session), expected);
        for diagnostic in session.diagnostics().iter().filter(|d| d.kind() == DiagnosticKind::OpeningCap) {
            assert_eq!(diagnostic.severity(), Severity::Warning);
            let (elements, Diagnostic::OpeningCap { triangles, .. }) = (diagnostic.elements(), diagnostic) else {
                unreachable!("its kind was asked for")
            };
            assert_eq!(elements[0].kind, ElementKind::Bone);
            // All of them, in the elements and in words.
            let named: Vec<u32> = elements[1..].iter().map(|element| element.index).collect();
            assert_eq!(named, *triangles);
            let words = format!("triangles {}-{} ({} in all)", named[0], named[named.len() - 1], named.len());
            assert!(session.sentence(diagnostic).contains(&words), "{}", session.sentence(diagnostic));
        }
        let (result, other) = (session.garment_positions().unwrap(), twin.garment_positions().unwrap());
        assert_eq!(result.len(), closed.positions.len());
        let (inner, rim) = inside(&closed, is_cap);
        for v in (0..result.len()).filter(|v| inner.binary_search(v).is_err()) {
            assert_eq!(result[v], other[v], "vertex {v}");
        }
        // Wider than designed, and flat discs still: between the rims' own heights and within them.
        for v in inner {
            let own = |w: &&usize| closed.positions[**w].z == closed.positions[v].z;
            let heights = || rim.iter().filter(own).map(|&w| result[w].z);
            let (low, high) = (heights().fold(f64::INFINITY, f64::min), heights().fold(f64::NEG_INFINITY, f64::max));
            let slack = 0.02 + 0.1 * (high - low);
            assert!((low - slack..=high + slack).contains(&result[v].z), "{v}: {} {low} {high}", result[v].z);
            let wide = |p: DVec3| p.truncate().length();
            let widest = rim.iter().filter(own).map(|&w| wide(result[w])).fold(0.0, f64::max);
            let design = wide(closed.positions[v]) / 0.3;
            assert!((wide(result[v]) - design * widest).abs() < 0.1 * widest, "{v}: {} {widest}", result[v]);
        }
    }
}

/// A tube whose ends go over into the cloth in bends of about 30 degrees each, and its caps: what faces as the middle does.
fn bevelled(sides: u32) -> (TriangleMesh, [std::ops::Range<usize>; 2]) {
    let rings = 14;
    let (mut mesh, [first, second, end]) = tube([-0.6, 0.65], 0.3, [rings, sides], [4, 4]);
    let profile = [(0.29, 0.02), (0.24, 0.05), (0.1, 0.05), (0.0, 0.05)];
    let (walls, per_end) = (((rings + 1) * sides) as usize, (3 * sides + 1) as usize);
    // Inner rings of both ends come first, and then the two tips.
    for (k, p) in mesh.positions[walls..].iter_mut().enumerate() {
        let ring = if k < 2 * (per_end - 1) { k / sides as usize % 3 } else { 3 };
        let (radius, out) = profile[ring];
        let (direction, towards) = (p.truncate().normalize_or_zero(), p.z.signum());
        *p = (radius * direction).extend(p.z + towards * out);
    }
    let strip = 2 * sides as usize;
    (mesh, [first + strip..second, second + strip..end])
}

#[test]
fn a_cap_with_bevelled_edges_is_one() {
    for sides in [12, 20] {
        let (closed, caps) = bevelled(sides);
        let is_cap = |t: usize| caps.iter().any(|range| range.contains(&t));
        let mut session = on_arm(&closed, Options::default());
        assert_eq!(session.run().unwrap(), Stage::Done, "{:?}", session.diagnostics());
        let found: Vec<Vec<u32>> = caps_of(&session).into_iter().map(|cap| cap.1).collect();
        let expected: Vec<Vec<u32>> = caps.iter().map(|range| range.clone().map(|t| t as u32).collect()).collect();
        assert_eq!(found, expected);
        let mut twin = on_arm(&opened(&closed, is_cap), Options::default());
        assert_eq!(twin.run().unwrap(), Stage::Done);
        let (result, other) = (session.garment_positions().unwrap(), twin.garment_positions().unwrap());
        let (inner, _) = inside(&closed, is_cap);
        assert!((0..result.len()).filter(|v| inner.binary_search(v).is_err()).all(|v| result[v] == other[v]));
    }
}

/// A square sleeve, closed at one end, in which the bone lies askew: it leaves through the end, or along a side, which is as flat and
/// has edges as sharp.
#[test]
fn a_side_that_a_bone_meets_along_its_way_is_no_cap() {
    let (sleeve, [walls, end, _]) = tube([-0.6, 0.65], 0.2, [12, 4], [0, 2]);
    let skewed = |angle: f64| TriangleMesh {
        positions: sleeve.positions.iter().map(|&p| DQuat::from_rotation_x(angle) * p).collect(),
        triangles: sleeve.triangles.clone(),
    };
    let extents = [[-0.2, 1.0], [0.0, 1.2]];
    let found = |angle: f64, triangle: usize| Caps::find(&skewed(angle), &[(triangle as u32, 1)], &arm(), &extents);
    for angle in [0.0, 0.3, 0.6] {
        let caps = found(angle, end);
        assert_eq!(caps.caps.len(), 1, "{angle}: {:?}", caps.refused);
        assert_eq!(caps.caps[0].triangles.len(), sleeve.triangles.len() - walls, "{angle}");
    }
    for angle in [0.1, 0.4] {
        assert_eq!(found(angle, walls - 5).refused, Some(NoCap::Along), "{angle}");
    }
}

/// At every iteration, and also where the garment comes with split vertices, the caps are where they belong.
#[test]
fn split_vertices_of_a_cap_stay_together() {
    let (welded, [first, ..]) = tube([-0.6, 0.65], 0.3, [10, 14], [2, 2]);
    let corners: Vec<u32> = welded.triangles.iter().flatten().copied().collect();
    let split = TriangleMesh {
        positions: corners.iter().map(|&v| welded.positions[v as usize]).collect(),
        triangles: (0..welded.triangles.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect(),
    };
    let mut session = on_arm(&split, Options::default());
    session.prepare().unwrap();
    let count = caps_of(&session).iter().map(|cap| cap.1.len()).sum::<usize>();
    assert_eq!(count, welded.triangles.len() - first);
    assert_eq!(session.run().unwrap(), Stage::Done);
    let result = session.garment_positions().unwrap();
    let mut place = vec![None; welded.positions.len()];
    for (k, &v) in corners.iter().enumerate() {
        assert!(result[k].is_finite());
        assert_eq!(*place[v as usize].get_or_insert(result[k]), result[k], "copies of vertex {v}");
    }
    assert_eq!(session.distortion().unwrap().len(), split.triangles.len());
}

fn refused(garment: &TriangleMesh, options: Options) -> (Error, Session) {
    let mut session = on_arm(garment, options);
    (session.prepare().expect_err("refused"), session)
}

#[test]
fn keep_caps_refuses_them() {
    let (closed, _) = tube([-0.6, 0.65], 0.3, [14, 16], [2, 2]);
    let (error, session) = refused(&closed, Options { keep_caps: true, ..Options::default() });
    assert_eq!(error.kind, ErrorKind::NotEnclosed);
    assert!(!error.message.contains("taken for the cap"), "{error}");
    assert!(caps_of(&session).is_empty());
    assert!(session.diagnostics().iter().all(|d| d.kind() == DiagnosticKind::AvatarPenetrates));
}

/// A ball around the middle of the arm has no rim, however fine it is; the refusal says so.
#[test]
fn a_ball_around_a_bone_is_refused_with_the_reason() {
    for [rings, sides] in [[6, 8], [9, 12], [24, 30]] {
        let mut ball = TriangleMesh { positions: vec![DVec3::Z * -0.5, DVec3::Z * 0.5], triangles: Vec::new() };
        let at = |r: u32, s: u32| match r {
            0 => 0,
            r if r == rings => 1,
            r => 2 + (r - 1) * sides + s % sides,
        };
        for r in 1..rings {
            let down = PI * f64::from(r) / f64::from(rings);
            ball.positions.extend((0..sides).map(|s| {
                let angle = TAU * f64::from(s) / f64::from(sides);
                0.5 * DVec3::new(down.sin() * angle.cos(), down.sin() * angle.sin(), -down.cos())
            }));
        }
        for r in 0..rings {
            for s in 0..sides {
                let faces = [[at(r, s), at(r, s + 1), at(r + 1, s)], [at(r, s + 1), at(r + 1, s + 1), at(r + 1, s)]];
                ball.triangles.extend(faces.into_iter().filter(|[a, b, c]| a != b && b != c && c != a));
            }
        }
        let (error, session) = refused(&ball, Options::default());
        assert_eq!(error.kind, ErrorKind::NotEnclosed);
        assert!(error.message.contains("not taken for the cap of an opening: it "), "{error}");
        assert!(caps_of(&session).is_empty(), "{rings} {sides}");
    }
}

fn session_of(garment: &TriangleMesh, design: &Sample, body: &Sample) -> Session {
    let mut session = Session::new();
    session.set_garment(garment.clone(), Precision::F64).unwrap();
    session.set_source_skeleton(bodies::skeleton(design)).unwrap();
    session.set_target_avatar(bodies::mesh(body)).unwrap();
    session.set_target_skeleton(bodies::skeleton(body)).unwrap();
    session
}

/// A jacket whose neck, hem and cuffs are closed by fans, on a heavier body.
#[test]
fn a_jacket_with_caps_at_neck_hem_and_cuffs_is_worn() {
    let (design, body) = (jacket(2.0), sample(Kind::Heavy));
    let mut closed = bodies::mesh(&design);
    // Welded, so that seams are no loops.
    let (weld, _) = Weld::new(&closed);
    let loops = Topology::new(weld.mesh.positions.len(), &weld.mesh.triangles).loops;
    assert_eq!(loops.len(), 4);
    let open = closed.triangles.len();
    let mut inner = Vec::new();
    for border in &loops {
        let corners: Vec<u32> = border.vertices.iter().map(|&w| weld.vertex_of[w as usize]).collect();
        let tip = closed.positions.len() as u32;
        inner.push(tip as usize);
        let sum: DVec3 = corners.iter().map(|&v| closed.positions[v as usize]).sum();
        closed.positions.push(sum / corners.len() as f64);
        let next = corners.iter().cycle().skip(1);
        closed.triangles.extend(corners.iter().zip(next).map(|(&a, &b)| [b, a, tip]));
    }
    let mut session = session_of(&closed, &design, &body);
    assert_eq!(session.run().unwrap(), Stage::Done);
    let mut found: Vec<u32> = caps_of(&session).into_iter().flat_map(|cap| cap.1).collect();
    found.sort_unstable();
    assert_eq!(found, (open as u32..closed.triangles.len() as u32).collect::<Vec<_>>());
    let mut twin = session_of(&opened(&closed, |t| t >= open), &design, &body);
    assert_eq!(twin.run().unwrap(), Stage::Done);
    let (result, other) = (session.garment_positions().unwrap(), twin.garment_positions().unwrap());
    for v in (0..result.len()).filter(|v| !inner.contains(v)) {
        assert_eq!(result[v], other[v], "vertex {v}");
    }
    for (&v, border) in inner.iter().zip(&loops) {
        let rim = || border.vertices.iter().map(|&w| result[weld.vertex_of[w as usize] as usize]);
        let middle = rim().sum::<DVec3>() / border.vertices.len() as f64;
        let radius = rim().map(|p| p.distance(middle)).fold(0.0, f64::max);
        assert!(result[v].distance(middle) < 0.35 * radius, "{v}");
    }
}

/// The vertices of a dome follow any similarity of its rim exactly, and stay finite where the rim collapses.
#[test]
fn what_is_within_a_rim_follows_it() {
    let mut random = Random::new(31);
    for _ in 0..50 {
        let mut dome = TriangleMesh::default();
        let sides = 5 + (9.0 * random.unit()) as u32;
        for (radius, height) in [(1.0, 0.0), (0.6, 0.2)] {
            dome.positions.extend((0..sides).map(|s| {
                let angle = TAU * f64::from(s) / f64::from(sides);
                DVec3::new(radius * angle.cos(), radius * angle.sin(), height) + 0.1 * random.vector()
            }));
        }
        dome.positions.push(DVec3::new(0.1, 0.0, 0.3));
        for s in 0..sides {
            let next = (s + 1) % sides;
            dome.triangles.push([s, next, sides + s]);
            dome.triangles.push([next, sides + next, sides + s]);
            dome.triangles.push([sides + s, sides + next, 2 * sides]);
        }
        let all: Vec<u32> = (0..dome.triangles.len() as u32).collect();
        let kept: Vec<bool> = (0..=2 * sides).map(|v| v < sides).collect();
        let cap = CapMotion::new(&dome, &all, &kept);
        let turn = DQuat::from_axis_angle(random.vector().normalize_or(DVec3::X), TAU * random.unit());
        let (scale, away) = (0.5 + 2.0 * random.unit(), random.vector());
        let moved: Vec<DVec3> = dome.positions.iter().map(|&p| away + scale * (turn * p)).collect();
        let mut x = moved.clone();
        x[sides as usize..].fill(DVec3::ZERO);
        cap.carry(&dome.positions, &mut x);
        for (v, (p, q)) in x.iter().zip(&moved).enumerate() {
            assert!(p.distance(*q) < 1e-9, "{v}: {p} {q}");
        }
        // All in a point, and all on a line.
        for flat in [DVec3::ZERO, DVec3::X] {
            let mut x: Vec<DVec3> = moved.iter().map(|&p| away + p * flat).collect();
            cap.carry(&dome.positions, &mut x);
            assert!(x.iter().all(|p| p.is_finite()));
        }
    }
}
