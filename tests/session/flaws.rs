//! Garments with flaws: where faces are missing or edges have T-junctions, they take little more than what is whole.

use bespoke::control::Stage;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::diagnostic::{Diagnostic, DiagnosticKind};
use bespoke::session::{Precision, Session};
use glam::DVec3;
use testing::Random;

use crate::small::{session, tube};

fn fine() -> TriangleMesh {
    tube(-0.6, 0.7, |z, _| 0.3 + 0.03 * (12.0 * z).sin(), 40, 48, false)
}

/// Without a share of its faces.
fn net(share: f64) -> TriangleMesh {
    let mut random = Random::new(5);
    let mut garment = fine();
    garment.triangles.retain(|_| random.unit() >= share);
    garment
}

fn dressed(garment: &TriangleMesh) -> Session {
    let mut session = session(1.0, DVec3::ZERO);
    session.set_garment(garment.clone(), Precision::F64).unwrap();
    assert_eq!(session.run().unwrap(), Stage::Done);
    session
}

fn iterations(session: &Session) -> u32 {
    session.report().inflate.iterations + session.report().fit.iterations
}

fn is_adjusted(session: &Session) -> bool {
    session.diagnostics().iter().any(|diagnostic| diagnostic.kind() == DiagnosticKind::SettingsAdjusted)
}

#[test]
fn a_net_takes_little_more_than_what_is_whole() {
    let whole = iterations(&dressed(&fine()));
    for share in [0.06, 0.12] {
        let session = dressed(&net(share));
        println!("{share} {} {whole}", iterations(&session));
        assert!(session.verify(Precision::F64).unwrap().is_clean());
        assert!(!is_adjusted(&session) && iterations(&session) <= 3 * whole, "{} {whole}", iterations(&session));
    }
}

/// With `count` T-junctions: an edge has a vertex in its middle on one side and none on the other.
fn with_t_junctions(mut garment: TriangleMesh, count: usize) -> TriangleMesh {
    let mut random = Random::new(11);
    let mut made = 0;
    while made < count {
        let t = (random.unit() * garment.triangles.len() as f64) as usize;
        let [a, b, c] = garment.triangles[t];
        let has = |s: &[u32; 3]| s.contains(&a) && s.contains(&b);
        if garment.triangles.iter().filter(|s| has(s)).count() < 2 {
            continue;
        }
        let m = garment.positions.len() as u32;
        let [p, q]: [DVec3; 2] = [a, b].map(|v| garment.positions[v as usize]);
        garment.positions.push(0.5 * (p + q));
        garment.triangles[t] = [a, m, c];
        garment.triangles.push([m, b, c]);
        made += 1;
    }
    garment
}

/// How far the vertices that were put on edges have left them, in lengths of the edge.
fn widest_slit(garment: &TriangleMesh, result: &[DVec3], first: usize) -> f64 {
    let mut widest: f64 = 0.0;
    for m in first..result.len() {
        let corners = garment.triangles.iter().find(|t| t[1] as usize == m).unwrap();
        let after = garment.triangles.iter().find(|t| t[0] as usize == m && t[2] == corners[2]).unwrap();
        let [a, b] = [corners[0], after[1]].map(|v| result[v as usize]);
        let edge = b - a;
        let s = ((result[m] - a).dot(edge) / edge.length_squared()).clamp(0.0, 1.0);
        widest = widest.max((result[m] - a - s * edge).length() / edge.length());
    }
    widest
}

/// Slits without width are no borders, whose bends would be infinite there, and take no part in contact.
#[test]
fn t_junctions_take_little_more_than_what_is_whole_and_stay_closed() {
    let whole = iterations(&dressed(&fine()));
    let count = fine().positions.len();
    for (junctions, precision) in [(1, Precision::F64), (120, Precision::F32), (600, Precision::F64)] {
        let mut garment = with_t_junctions(fine(), junctions);
        if precision == Precision::F32 {
            garment.positions.iter_mut().for_each(|p| *p = p.as_vec3().as_dvec3());
        }
        let mut session = session(1.0, DVec3::ZERO);
        session.set_garment(garment.clone(), precision).unwrap();
        assert_eq!(session.run().unwrap(), Stage::Done);
        let wide = widest_slit(&garment, &session.garment_positions().unwrap(), count);
        println!("{junctions} junctions: {} iterations, whole {whole}; slits of {wide}", iterations(&session));
        assert!(session.verify(precision).unwrap().is_clean());
        assert!(!is_adjusted(&session) && iterations(&session) <= 2 * whole, "{} {whole}", iterations(&session));
        assert!(wide < 0.25, "{wide}");
        let found: Vec<&Diagnostic> = session.diagnostics().iter().collect();
        let Some(Diagnostic::TJunctions { count: named, first, .. }) =
            found.iter().find(|diagnostic| diagnostic.kind() == DiagnosticKind::TJunctions)
        else {
            panic!("{found:?}")
        };
        assert_eq!((*named, first.len()), (junctions, junctions.min(4)));
        assert!(first.iter().all(|&v| v as usize >= count), "{first:?}");
        assert!(found.iter().all(|diagnostic| diagnostic.kind() != DiagnosticKind::SelfIntersection));
    }
}

#[test]
fn a_whole_garment_has_no_t_junctions() {
    let session = dressed(&fine());
    assert!(session.diagnostics().iter().all(|diagnostic| diagnostic.kind() != DiagnosticKind::TJunctions));
}

/// Without two triangles at some vertices each, opposite each other: what is left hangs together there in one point.
fn with_bow_ties(mut garment: TriangleMesh, every: usize) -> (TriangleMesh, usize) {
    let mut around: Vec<Vec<usize>> = vec![Vec::new(); garment.positions.len()];
    for (t, corners) in garment.triangles.iter().enumerate() {
        corners.iter().for_each(|&v| around[v as usize].push(t));
    }
    let mut removed = vec![false; garment.triangles.len()];
    let mut made = 0;
    for (v, triangles) in around.iter().enumerate().step_by(every) {
        let others =
            |t: usize| garment.triangles[t].iter().filter(|&&w| w as usize != v).copied().collect::<Vec<u32>>();
        let first = others(triangles[0]);
        let opposite = triangles.iter().filter(|&&t| others(t).iter().all(|w| !first.contains(w)));
        // The middle of those that have no edge in common with the first.
        let opposite: Vec<usize> = opposite.copied().collect();
        let is_inner = triangles.len() == 6 && opposite.len() == 3 && triangles.iter().all(|&t| !removed[t]);
        if !is_inner {
            continue;
        }
        let neighbours = |t: usize| {
            let beside = |s: usize| s != t && others(s).iter().any(|w| others(t).contains(w));
            opposite.iter().filter(|&&s| beside(s)).count()
        };
        let middle = opposite.iter().copied().find(|&t| neighbours(t) == 2).unwrap();
        (removed[triangles[0]], removed[middle]) = (true, true);
        made += 1;
    }
    let mut kept = removed.iter().map(|removed| !removed);
    garment.triangles.retain(|_| kept.next().unwrap());
    (garment, made)
}

#[test]
fn bow_ties_take_little_more_than_what_is_whole() {
    let whole = iterations(&dressed(&fine()));
    let (garment, made) = with_bow_ties(fine(), 7);
    assert!(made > 100, "{made}");
    let session = dressed(&garment);
    println!("{made} bow-ties: {} iterations, whole {whole}", iterations(&session));
    assert!(session.verify(Precision::F64).unwrap().is_clean());
    assert!(!is_adjusted(&session) && iterations(&session) <= 2 * whole, "{} {whole}", iterations(&session));
}

/// With patches that stand on the cloth with one corner each, in the middle of a triangle or of an edge.
fn with_patches(mut garment: TriangleMesh, count: usize, on_edges: bool) -> TriangleMesh {
    let mut random = Random::new(3);
    let triangles = garment.triangles.len();
    for _ in 0..count {
        let t = (random.unit() * triangles as f64) as usize;
        let [a, b, c] = garment.triangles[t].map(|v| garment.positions[v as usize]);
        let middle = if on_edges { 0.5 * (a + b) } else { (a + b + c) / 3.0 };
        let normal = (b - a).cross(c - a).normalize();
        let out = normal * normal.dot(middle - DVec3::new(0.2 * middle.z.max(0.0), 0.0, middle.z)).signum();
        let (side, up) = ((b - a).normalize(), out.cross(b - a).normalize());
        let k = garment.positions.len() as u32;
        let above = middle + 0.02 * out;
        garment.positions.extend([middle, above + 0.03 * side, above + 0.03 * (side + up), above + 0.03 * up]);
        garment.triangles.extend([[k, k + 1, k + 2], [k, k + 2, k + 3]]);
    }
    garment
}

/// What touches at rest has no distance of which a share could be kept.
#[test]
fn patches_that_touch_at_a_corner_take_little_more_than_what_is_whole() {
    let whole = iterations(&dressed(&fine()));
    for (count, on_edges, precision) in [
        (1, false, Precision::F32),
        (40, false, Precision::F64),
        (40, true, Precision::F32),
        (120, false, Precision::F32),
    ] {
        let mut garment = with_patches(fine(), count, on_edges);
        if precision == Precision::F32 {
            garment.positions.iter_mut().for_each(|p| *p = p.as_vec3().as_dvec3());
        }
        let mut session = session(1.0, DVec3::ZERO);
        session.set_garment(garment, precision).unwrap();
        assert_eq!(session.run().unwrap(), Stage::Done);
        println!("{count} patches, on edges {on_edges}: {} iterations, whole {whole}", iterations(&session));
        assert!(session.verify(precision).unwrap().is_clean());
        assert!(!is_adjusted(&session) && iterations(&session) <= 4 * whole, "{} {whole}", iterations(&session));
    }
}
