use std::collections::BTreeSet;

use bespoke::contact::{
    Avatar, Bodies, BroadPhase, CandidateSet, CollisionGroup, Configuration, Garment, Motion, PairType, Step, Surface,
};
use glam::DVec3;

use crate::scene::{Scene, grid};

/// Brute force: the pairs whose swept boxes come within the margins along every axis.
fn boxes(bodies: &Bodies, motion: &Motion, part: f64, margins: [f64; 2]) -> [BTreeSet<[u32; 4]>; 4] {
    let n = bodies.garment_count() as u32;
    let around = |vertices: &[u32]| {
        let places = vertices.iter().flat_map(|&v| [motion.position(v, 0.0), motion.position(v, part)]);
        places.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)))
    };
    let primitives = |surface: &Surface, offset: u32| {
        let points: BTreeSet<u32> = surface.triangles.iter().flatten().map(|v| v + offset).collect();
        let faces: Vec<[u32; 3]> = surface
            .triangles
            .iter()
            .filter(|t| t[0] != t[1] && t[1] != t[2] && t[2] != t[0])
            .map(|t| t.map(|v| v + offset))
            .collect();
        let edges: Vec<[u32; 2]> = surface.edges.iter().map(|e| e.map(|v| v + offset)).collect();
        (points, faces, edges)
    };
    let garment = primitives(&bodies.garment.surface, 0);
    let avatar = primitives(&bodies.avatar.surface, n);
    let close = |a: &[u32], b: &[u32], margin: f64| {
        let ((low, high), (other_low, other_high)) = (around(a), around(b));
        !a.iter().any(|v| b.contains(v)) && (other_low - high).max(low - other_high).max_element() <= margin
    };
    let mut out: [BTreeSet<[u32; 4]>; 4] = Default::default();
    let mut point_triangle = |run: usize, points: &BTreeSet<u32>, faces: &[[u32; 3]]| {
        for &p in points {
            for f in faces.iter().filter(|f| close(&[p], *f, margins[run / 2])) {
                out[run].insert([p, f[0], f[1], f[2]]);
            }
        }
    };
    point_triangle(0, &garment.0, &garment.1);
    point_triangle(2, &garment.0, &avatar.1);
    point_triangle(2, &avatar.0, &garment.1);
    for (i, e) in garment.2.iter().enumerate() {
        for f in garment.2[i + 1..].iter().filter(|f| close(e, *f, margins[0])) {
            out[1].insert([e[0], e[1], f[0], f[1]]);
        }
        for f in avatar.2.iter().filter(|f| close(e, *f, margins[1])) {
            out[3].insert([e[0], e[1], f[0], f[1]]);
        }
    }
    out
}

/// The pairs of a range with garment edges in ascending order; fails on a pair that occurs twice. A face that is
/// listed twice in the surface is two faces.
fn sorted(set: &CandidateSet, pair_type: PairType, group: CollisionGroup, faces_differ: bool) -> BTreeSet<[u32; 4]> {
    let pairs = set.of(pair_type, group).iter().map(|&[a, b, c, d]| {
        if pair_type == PairType::EdgeEdge && group == CollisionGroup::Garment && [a, b] > [c, d] {
            [c, d, a, b]
        } else {
            [a, b, c, d]
        }
    });
    let unique: BTreeSet<_> = pairs.collect();
    if faces_differ || pair_type == PairType::EdgeEdge {
        assert_eq!(unique.len(), set.of(pair_type, group).len(), "a pair occurs twice");
    }
    unique
}

/// Whether a pair is nearer than `margin` at one of many sampled times.
fn comes_near(pair_type: PairType, motion: &Motion, part: f64, margin: f64, pair: [u32; 4]) -> bool {
    let distance = |k: usize| {
        let place = pair.map(|v| motion.position(v, part * k as f64 / 40.0));
        pair_type.separation(&place).squared.sqrt()
    };
    (0..=40).any(|k| distance(k) < margin)
}

/// Every pair whose boxes overlap and that comes near is found, and none that is not. Returns how many of the boxes' pairs
/// are left out.
fn check(bodies: &Bodies, motion: &Motion, part: f64, margins: [f64; 2], out: &CandidateSet) -> usize {
    let inside = boxes(bodies, motion, part, margins);
    let outside = boxes(bodies, motion, part, margins.map(|m| m + 1e-5));
    let unique_faces = |s: &Surface| s.triangles.iter().collect::<BTreeSet<_>>().len() == s.triangles.len();
    let differ = unique_faces(&bodies.garment.surface) && unique_faces(&bodies.avatar.surface);
    let mut left_out = 0;
    for (k, (pair_type, group)) in RANGES.into_iter().enumerate() {
        let found = sorted(out, pair_type, group, differ);
        assert!(found.is_subset(&outside[k]), "{pair_type:?} {group:?}");
        for &pair in inside[k].difference(&found) {
            assert!(!comes_near(pair_type, motion, part, margins[k / 2], pair), "{pair_type:?} {group:?} {pair:?}");
            left_out += 1;
        }
    }
    left_out
}

const RANGES: [(PairType, CollisionGroup); 4] = [
    (PairType::PointTriangle, CollisionGroup::Garment),
    (PairType::EdgeEdge, CollisionGroup::Garment),
    (PairType::PointTriangle, CollisionGroup::Avatar),
    (PairType::EdgeEdge, CollisionGroup::Avatar),
];

#[test]
fn broad_phase_misses_nothing_that_brute_force_finds() {
    let (mut pairs, mut left_out) = (0, 0);
    for seed in 0..6 {
        let scene = Scene::random(seed, 0.1);
        let mut broad_phase = BroadPhase::new(&scene.bodies);
        let mut out = CandidateSet::default();
        for (t, dt) in [(0.0, 0.5), (0.7, -0.3), (1.0, 0.0)] {
            let at = Configuration { x: &scene.x, t };
            let step = Step { dx: &scene.dx, dt };
            for margins in [[0.0, 0.0], [0.01, 0.03], [0.1, 0.01]] {
                for (step, part) in [(None, 1.0), (Some(&step), 0.3), (Some(&step), 1.0)] {
                    let motion = Motion::new(&scene.bodies, at, step);
                    broad_phase.candidates(&scene.bodies, &motion, part, margins[0], margins[1], &mut out);
                    left_out += check(&scene.bodies, &motion, part, margins, &out);
                    pairs += out.len();
                }
            }
        }
    }
    assert!(pairs > 10_000 && left_out > 1000, "{pairs} {left_out}");
}

/// What comes near during a part of the motion stays in the set that was found for the whole, in the same order, and
/// not much else does.
#[test]
fn filtering_keeps_all_that_comes_near() {
    let margin = |group: CollisionGroup| if group == CollisionGroup::Garment { 0.01 } else { 0.02 };
    let (mut near, mut kept) = (0, 0);
    for seed in 0..6 {
        let scene = Scene::random(seed, 0.2);
        let (at, step) = (Configuration { x: &scene.x, t: 0.3 }, Step { dx: &scene.dx, dt: 0.3 });
        let motion = Motion::new(&scene.bodies, at, Some(&step));
        let mut all = CandidateSet::default();
        BroadPhase::new(&scene.bodies).candidates(&scene.bodies, &motion, 1.0, 0.01, 0.02, &mut all);
        for part in [0.0, 0.1, 1.0] {
            let mut some = all.clone();
            some.retain_near(&motion, part, margin);
            for (pair_type, group) in RANGES {
                let mut left = some.of(pair_type, group).iter().copied().peekable();
                for &pair in all.of(pair_type, group) {
                    let is_near = comes_near(pair_type, &motion, part, margin(group), pair);
                    let is_kept = left.next_if_eq(&pair).is_some();
                    assert!(is_kept || !is_near, "{pair_type:?} {pair:?}");
                    near += usize::from(is_near);
                    kept += usize::from(is_kept);
                }
                assert_eq!(left.next(), None);
            }
        }
    }
    assert!(near > 3000 && kept < 4 * near, "{near} {kept}");
}

#[test]
fn any_number_of_threads_gives_the_same_order() {
    let scene = Scene::random(11, 0.2);
    let step = Step { dx: &scene.dx, dt: 0.4 };
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut out = CandidateSet::default();
            let at = Configuration { x: &scene.x, t: 0.2 };
            let motion = Motion::new(&scene.bodies, at, Some(&step));
            BroadPhase::new(&scene.bodies).candidates(&scene.bodies, &motion, 1.0, 0.01, 0.02, &mut out);
            let whole = out.clone();
            out.retain_near(&motion, 0.5, |_| 0.01);
            (whole, out)
        })
    };
    let one = run(1);
    assert!(one.1.len() > 300 && one.1.len() < one.0.len());
    assert_eq!(one, run(2));
    assert_eq!(one, run(5));
}

#[test]
fn empty_surfaces_and_no_motion() {
    let (rest, triangles) = grid(3);
    let empty = Avatar { surface: Surface::new(0, vec![]), start: vec![], motion: vec![] };
    let bodies =
        Bodies { garment: Garment { surface: Surface::new(rest.len(), triangles), rest: rest.clone() }, avatar: empty };
    let mut out = CandidateSet::new(&[[0; 4]], &[], &[], &[]);
    let at = Configuration { x: &rest, t: 0.0 };
    let motion = Motion::new(&bodies, at, None);
    BroadPhase::new(&bodies).candidates(&bodies, &motion, 1.0, 1e-3, 1e-3, &mut out);
    check(&bodies, &motion, 1.0, [1e-3; 2], &out);
    assert!(out.of(PairType::PointTriangle, CollisionGroup::Avatar).is_empty());

    let (start, triangles) = grid(2);
    let bodies = Bodies {
        garment: Garment { surface: Surface::new(2, vec![]), rest: vec![DVec3::ZERO; 2] },
        avatar: Avatar { surface: Surface::new(start.len(), triangles), motion: vec![DVec3::ZERO; start.len()], start },
    };
    let at = Configuration { x: &[DVec3::ZERO; 2], t: 0.0 };
    BroadPhase::new(&bodies).candidates(&bodies, &Motion::new(&bodies, at, None), 1.0, 1.0, 1.0, &mut out);
    assert!(out.is_empty());
}

/// All pairs of a grid are near: many more than the budget.
#[test]
fn a_search_ends_at_the_pair_budget() {
    let (rest, triangles) = grid(24);
    let empty = Avatar { surface: Surface::new(0, vec![]), start: vec![], motion: vec![] };
    let bodies =
        Bodies { garment: Garment { surface: Surface::new(rest.len(), triangles), rest: rest.clone() }, avatar: empty };
    let at = Configuration { x: &rest, t: 0.0 };
    let motion = Motion::new(&bodies, at, None);
    let mut broad_phase = BroadPhase::new(&bodies);
    let (mut all, mut some) = (CandidateSet::default(), CandidateSet::default());
    broad_phase.candidates(&bodies, &motion, 1.0, 10.0, 10.0, &mut all);
    assert!(all.len() > 1_000_000 && !broad_phase.is_incomplete(), "{}", all.len());
    broad_phase.set_most(20_000);
    broad_phase.candidates(&bodies, &motion, 1.0, 10.0, 10.0, &mut some);
    assert!(broad_phase.is_incomplete());
    assert!((20_000..400_000).contains(&some.len()), "{}", some.len());
    broad_phase.set_most(all.len() + 1);
    broad_phase.candidates(&bodies, &motion, 1.0, 10.0, 10.0, &mut some);
    assert!(all == some && !broad_phase.is_incomplete());
}

#[test]
fn ranges_cover_any_part_of_a_set() {
    let set = CandidateSet::new(&[[0; 4]; 3], &[], &[[1; 4]; 2], &[[2; 4]; 4]);
    assert_eq!(set.len(), 9);
    for start in 0..=9 {
        for end in start..=9 {
            let mut next = start;
            for run in set.ranges(start..end) {
                assert_eq!(run.first, next);
                for (k, pair) in run.pairs.iter().enumerate() {
                    assert_eq!(set.pairs()[next + k], *pair);
                    assert!(set.of(run.pair_type, run.group).contains(pair));
                }
                next += run.pairs.len();
            }
            assert_eq!(next, end);
        }
    }
    assert_eq!(set.of(PairType::EdgeEdge, CollisionGroup::Avatar), [[2; 4]; 4]);
}
