//! Exempt pairs against their definition; and that no new pair of triangles ever intersects.

use bespoke::contact::ccd::max_step;
use bespoke::contact::exempt_pairs::triangle_pairs_of;
use bespoke::contact::{
    Avatar, Bodies, BroadPhase, CandidateSet, CollisionGroup, Configuration, ExemptPairs, Garment, Motion, PairType,
    Step, Surface,
};
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::verify::{intersecting, intersections};
use glam::DVec3;

use crate::scene::{Scene, grid, soup};
use testing::Random;

/// All the pairs of triangles that hold a pair of primitives, by testing every triangle.
fn holders(surface: &Surface, pair_type: PairType, [a, b, c, d]: [u32; 4]) -> Vec<[u32; 2]> {
    let with = |vertices: &[u32]| -> Vec<u32> {
        let count = surface.triangles.len() as u32;
        (0..count).filter(|&t| vertices.iter().all(|v| surface.triangles[t as usize].contains(v))).collect()
    };
    let (first, second) = match pair_type {
        PairType::PointTriangle => (with(&[a]), with(&[b, c, d])),
        PairType::EdgeEdge => (with(&[a, b]), with(&[c, d])),
    };
    let mut pairs: Vec<[u32; 2]> =
        first.iter().flat_map(|&s| second.iter().map(move |&t| [s.min(t), s.max(t)])).collect();
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}

#[test]
fn a_pair_has_the_group_that_its_triangles_give_it() {
    let mut counts = [0; 3];
    for seed in 1..20 {
        let mut random = Random::new(seed);
        let surface = soup(40, 60, &mut random);
        let count = surface.triangles.len();
        let mut pick = |n: usize| (random.unit() * n as f64) as u32;
        // Random pairs would hold hardly any primitive whole: take most of the pairs of a random part.
        let part: Vec<u32> = (0..18).map(|_| pick(count)).collect();
        let mut pairs = Vec::new();
        for &s in &part {
            for &t in &part {
                if s != t && pick(10) > 0 {
                    pairs.push([s, t]);
                }
            }
        }
        let exempt = ExemptPairs::new(&surface, &pairs);
        let intersects = |[s, t]: &[u32; 2]| pairs.contains(&[*s, *t]) || pairs.contains(&[*t, *s]);

        let apart = |p: &[u32], q: &[u32]| p.iter().all(|v| !q.contains(v));
        let mut check = |pair_type: PairType, pair: [u32; 4]| {
            let held = triangle_pairs_of(&surface, &[(pair_type, pair)]);
            assert_eq!(held, holders(&surface, pair_type, pair), "{pair_type:?} {pair:?}");
            let (expected, count) = match held.iter().filter(|pair| intersects(pair)).count() {
                0 => (Some(CollisionGroup::Garment), 0),
                n if n < held.len() => (Some(CollisionGroup::Intersecting), 1),
                _ => (None, 2),
            };
            assert_eq!(exempt.group(pair_type, pair), expected, "seed {seed}, {pair_type:?} {pair:?}");
            counts[count] += 1;
        };
        for (t, &[a, b, c]) in surface.triangles.iter().enumerate() {
            if surface.ownership(t as u32).face() {
                let used = |v: &u32| surface.triangles.iter().any(|t| t.contains(v));
                (0..40).filter(used).filter(|v| apart(&[*v], &[a, b, c])).for_each(|v| {
                    check(PairType::PointTriangle, [v, c, a, b]);
                });
            }
        }
        for (k, &[a, b]) in surface.edges.iter().enumerate() {
            for &[c, d] in &surface.edges[k + 1..] {
                if apart(&[a, b], &[c, d]) {
                    check(PairType::EdgeEdge, [d, c, a, b]);
                }
            }
        }
    }
    // Each of the answers occurs often.
    assert!(counts[0] > 10_000 && counts[1] > 1000 && counts[2] > 200, "{counts:?}");
}

#[test]
fn no_intersection_exempts_nothing() {
    let surface = soup(20, 20, &mut Random::new(5));
    let exempt = ExemptPairs::new(&surface, &[]);
    assert!(exempt.is_empty() && !exempt.contains(0, 1));
    assert_eq!(exempt.group(PairType::EdgeEdge, [0, 1, 2, 3]), Some(CollisionGroup::Garment));
}

#[test]
fn exempt_pairs_are_left_out_and_no_others() {
    for seed in 30..34 {
        let scene = Scene::random(seed, 0.1);
        let at = Configuration { x: &scene.x, t: 0.3 };
        let mesh =
            TriangleMesh { positions: scene.x.clone(), triangles: scene.bodies.garment.surface.triangles.clone() };
        let intersecting_pairs = intersections(&mesh, None, usize::MAX).unwrap().pairs;
        let exempt = ExemptPairs::new(&scene.bodies.garment.surface, &intersecting_pairs);
        let (mut all, mut constrained) = (CandidateSet::default(), CandidateSet::default());
        let mut broad_phase = BroadPhase::new(&scene.bodies);
        let motion = Motion::new(&scene.bodies, at, None);
        broad_phase.candidates(&scene.bodies, &motion, 1.0, 0.05, 0.05, &mut all);
        broad_phase.set_exempt_pairs(exempt.clone());
        broad_phase.candidates(&scene.bodies, &motion, 1.0, 0.05, 0.05, &mut constrained);
        let (mut found, mut kept) = (0, 0);
        for pair_type in [PairType::PointTriangle, PairType::EdgeEdge] {
            for group in [CollisionGroup::Garment, CollisionGroup::Intersecting] {
                let of_group = |pair: &&[u32; 4]| exempt.group(pair_type, **pair) == Some(group);
                let expected: Vec<_> =
                    all.of(pair_type, CollisionGroup::Garment).iter().filter(of_group).copied().collect();
                assert_eq!(constrained.of(pair_type, group), expected);
                kept += expected.len();
            }
            found += all.of(pair_type, CollisionGroup::Garment).len();
            assert_eq!(constrained.of(pair_type, CollisionGroup::Avatar), all.of(pair_type, CollisionGroup::Avatar));
        }
        assert!(kept < found, "seed {seed}");
    }
}

/// Two wavy sheets, one through the other, and a third that crosses nothing.
fn sheets(random: &mut Random) -> (Vec<DVec3>, Surface) {
    let (positions, triangles) = grid(5);
    let count = positions.len() as u32;
    let mut all = Vec::new();
    for (height, wave) in [(0.0, 0.05), (0.03, 0.05), (0.3, 0.02)] {
        all.extend(positions.iter().map(|p| *p + DVec3::new(0.01 * height, 0.0, height) + wave * random.vector()));
    }
    let list = (0..3).flat_map(|k| triangles.iter().map(move |t| t.map(|v| v + k * count))).collect();
    (all, Surface::new(3 * count as usize, list))
}

/// Random motions, each as far as the constrained pairs admit: the exact verifier never finds a pair of triangles that
/// did not intersect before, and some separate.
#[test]
fn initial_intersections_only_get_fewer() {
    let mut separated = 0;
    for seed in 1..7 {
        let mut random = Random::new(100 + seed);
        let (mut x, surface) = sheets(&mut random);
        let triangles = surface.triangles.clone();
        let bodies = Bodies {
            garment: Garment { surface, rest: x.clone() },
            avatar: Avatar { surface: Surface::new(0, vec![]), start: vec![], motion: vec![] },
        };
        let mut mesh = TriangleMesh { positions: x.clone(), triangles };
        let mut intersecting_pairs = intersections(&mesh, None, usize::MAX).unwrap().pairs;
        assert!(intersecting_pairs.len() > 5);
        let mut broad_phase = BroadPhase::new(&bodies);
        let mut near = CandidateSet::default();
        for round in 0..60 {
            broad_phase.set_exempt_pairs(ExemptPairs::new(&bodies.garment.surface, &intersecting_pairs));
            // Half of the motions pull the second sheet out of the first.
            let dx: Vec<DVec3> = (0..x.len())
                .map(|v| {
                    let pull = if round % 2 == 0 && (36..72).contains(&v) { 0.02 } else { 0.0 };
                    DVec3::Z * pull + 0.02 * random.vector()
                })
                .collect();
            let (at, step) = (Configuration { x: &x, t: 0.0 }, Step { dx: &dx, dt: 0.0 });
            let motion = Motion::new(&bodies, at, Some(&step));
            broad_phase.candidates(&bodies, &motion, 1.0, 1e-3, 1e-3, &mut near);
            let fraction = max_step(&motion, &near, |_| 1e-9, 1.0);
            x.iter_mut().zip(&dx).for_each(|(x, d)| *x += fraction * *d);
            mesh.positions.clone_from(&x);
            let now = intersections(&mesh, None, usize::MAX).unwrap().pairs;
            let new: Vec<_> = now.iter().filter(|p| !intersecting_pairs.contains(p)).collect();
            assert!(new.is_empty(), "seed {seed}, round {round}: {new:?}");
            assert_eq!(now, intersecting(&mesh, &intersecting_pairs).unwrap());
            separated += intersecting_pairs.len() - now.len();
            intersecting_pairs = now;
        }
    }
    assert!(separated >= 10, "{separated}");
}
