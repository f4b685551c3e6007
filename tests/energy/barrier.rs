use std::ops::Range;
use std::sync::Arc;

use bespoke::contact::distance::Separation;
use bespoke::contact::{Avatar, Bodies, CandidateSet, Garment, PairType, Surface, mollifier};
use bespoke::energy::barrier::{Barrier, BarrierPathRates, BarrierSettings};
use bespoke::energy::{Configuration, Direction, Energy, Sink};
use glam::DVec3;

use crate::harness::{check_gradient, check_hessian, check_semidefinite, dense};
use testing::Random;

const SIZE: f64 = 0.03;
const T: f64 = 0.6;
const SETTINGS: BarrierSettings = BarrierSettings {
    dhat_self: 0.004,
    dhat_avatar: 0.008,
    min_separation: 1e-5,
    min_separation_intersecting: 1e-6,
    avatar_weight: 0.3,
    rest_share: f64::INFINITY,
};

/// Which body each of the two primitives of a pair is on.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Sides {
    Garment,
    GarmentThenAvatar,
    AvatarThenGarment,
}

/// One pair as a barrier of its own: four vertices, of which the garment's come first in the numbering.
struct Case {
    barrier: Barrier,
    x: Vec<DVec3>,
    pair: [u32; 4],
    pair_type: PairType,
    is_within_garment: bool,
}

impl Case {
    /// The pair at `positions` when t = T, with the rest shape `rest` for its vertices.
    fn new(pair_type: PairType, sides: Sides, positions: [DVec3; 4], rest: [DVec3; 4]) -> Self {
        let first = pair_type.first_count();
        let on_garment = |i: usize| match sides {
            Sides::Garment => true,
            Sides::GarmentThenAvatar => i < first,
            Sides::AvatarThenGarment => i >= first,
        };
        let own: Vec<usize> = (0..4).filter(|&i| on_garment(i)).collect();
        let theirs: Vec<usize> = (0..4).filter(|&i| !on_garment(i)).collect();
        let place = |i: usize| match own.iter().position(|&k| k == i) {
            Some(k) => k as u32,
            None => (own.len() + theirs.iter().position(|&k| k == i).unwrap_or(0)) as u32,
        };
        let pair = [0, 1, 2, 3].map(place);
        // The avatar's rest is where it is at t = 1, so its motion from T to 1 is given by both.
        let motion: Vec<DVec3> = theirs.iter().map(|&i| (rest[i] - positions[i]) / (1.0 - T)).collect();
        let start = theirs.iter().zip(&motion).map(|(&i, m)| positions[i] - T * *m).collect();
        let bodies = Bodies {
            garment: Garment { surface: Surface::new(own.len(), vec![]), rest: own.iter().map(|&i| rest[i]).collect() },
            avatar: Avatar { surface: Surface::new(theirs.len(), vec![]), start, motion },
        };
        let mut barrier = Barrier::new(Arc::new(bodies), SETTINGS);
        let one = [pair];
        let (none, garment) = (&[][..], sides == Sides::Garment);
        *barrier.candidates_mut() = match (pair_type, garment) {
            (PairType::PointTriangle, true) => CandidateSet::new(&one, none, none, none),
            (PairType::EdgeEdge, true) => CandidateSet::new(none, &one, none, none),
            (PairType::PointTriangle, false) => CandidateSet::new(none, none, &one, none),
            (PairType::EdgeEdge, false) => CandidateSet::new(none, none, none, &one),
        };
        let x = own.iter().map(|&i| positions[i]).collect();
        Self { barrier, x, pair, pair_type, is_within_garment: garment }
    }

    fn at(&self) -> Configuration<'_> {
        Configuration { x: &self.x, t: T }
    }

    fn positions(&self) -> [DVec3; 4] {
        self.barrier.bodies().positions(self.pair, self.at())
    }

    fn dhat(&self) -> f64 {
        if self.is_within_garment { SETTINGS.dhat_self } else { SETTINGS.dhat_avatar }
    }

    fn weight(&self) -> f64 {
        if self.is_within_garment {
            // The cube of the ratio of the d-hats.
            (SETTINGS.dhat_avatar / SETTINGS.dhat_self).powi(3)
        } else {
            SETTINGS.avatar_weight
        }
    }
}

/// Moves the first primitive so that the pair is at `distance`.
fn placed(pair_type: PairType, mut x: [DVec3; 4], distance: f64) -> [DVec3; 4] {
    let r = pair_type.separation(&x).vector;
    for p in &mut x[..pair_type.first_count()] {
        *p += (distance / r.length() - 1.0) * r;
    }
    x
}

/// All pair types and sides, at a distance between minimum separation and d-hat given by `fraction`; nearly parallel
/// edges on request.
fn cases(seed: u64, fraction: f64, parallel: bool, mut each: impl FnMut(Case, &mut Random)) {
    let mut random = Random::new(seed);
    for pair_type in [PairType::PointTriangle, PairType::EdgeEdge] {
        if parallel && pair_type == PairType::PointTriangle {
            continue;
        }
        for sides in [Sides::Garment, Sides::GarmentThenAvatar, Sides::AvatarThenGarment] {
            if pair_type == PairType::EdgeEdge && sides == Sides::AvatarThenGarment {
                continue;
            }
            for _ in 0..30 {
                let dhat = if sides == Sides::Garment { SETTINGS.dhat_self } else { SETTINGS.dhat_avatar };
                let mut x: [DVec3; 4] = std::array::from_fn(|_| SIZE * random.vector());
                if parallel {
                    x[3] = x[2] + 0.8 * (x[1] - x[0]) + 0.008 * SIZE * random.vector();
                }
                let x = placed(pair_type, x, SETTINGS.min_separation + fraction * (dhat - SETTINGS.min_separation));
                let rest = x.map(|p| p + 0.2 * SIZE * random.vector());
                let case = Case::new(pair_type, sides, x, rest);
                each(case, &mut random);
            }
        }
    }
}

#[test]
fn gradient_is_exact() {
    for (seed, fraction) in [(1, 0.3), (2, 0.6), (3, 0.95)] {
        cases(seed, fraction, false, |case, _| {
            assert!(case.barrier.value(case.at(), 0..1) > 0.0);
            check_gradient(&case.barrier, &case.x, T, 1e-7, 1e-5);
        });
    }
}

#[test]
fn gradient_is_exact_where_edges_are_nearly_parallel() {
    let mut mollified = 0;
    cases(4, 0.4, true, |case, _| {
        let rest = case.pair.map(|i| case.barrier.bodies().rest(i));
        let m = mollifier::value(&case.positions(), mollifier::threshold(&rest));
        mollified += usize::from(m < 0.9);
        check_gradient(&case.barrier, &case.x, T, 1e-8, 1e-4);
    });
    assert!(mollified > 20, "{mollified}");
}

#[test]
fn gradient_is_exact_near_the_minimum_separation() {
    for fraction in [1e-3, 1e-4] {
        cases(5, fraction, false, |case, _| {
            check_gradient(&case.barrier, &case.x, T, 1e-9, 1e-4);
        });
    }
}

/// The barrier of one pair with its weights, normal and mollifier frozen: a function of one linear form.
struct Frozen<'a> {
    case: &'a Case,
    separation: Separation,
    m: f64,
}

impl Frozen<'_> {
    fn barrier(&self, d: f64) -> f64 {
        let (d, f, hat) = (d * d, SETTINGS.min_separation.powi(2), self.case.dhat().powi(2));
        -self.m * (d - hat).powi(2) * ((d - f) / (hat - f)).ln()
    }

    /// First and second derivative, by differences that shrink towards the minimum separation.
    fn slopes(&self, d: f64) -> (f64, f64) {
        let h = 1e-3 * (d - SETTINGS.min_separation);
        let b = |k: f64| self.barrier(d + k * h);
        let first = (8.0 * (b(1.0) - b(-1.0)) - (b(2.0) - b(-2.0))) / (12.0 * h);
        let second = (16.0 * (b(1.0) + b(-1.0)) - (b(2.0) + b(-2.0)) - 30.0 * b(0.0)) / (12.0 * h * h);
        (first, second)
    }

    fn normal(&self) -> DVec3 {
        self.separation.vector.normalize()
    }

    fn distance(&self, at: Configuration<'_>) -> f64 {
        let x = self.case.barrier.bodies().positions(self.case.pair, at);
        (0..4).map(|i| self.separation.weights[i] * self.normal().dot(x[i])).sum()
    }
}

impl Energy for Frozen<'_> {
    fn name(&self) -> &'static str {
        "frozen barrier"
    }

    fn len(&self) -> usize {
        1
    }

    fn value(&self, at: Configuration<'_>, _: Range<usize>) -> f64 {
        self.case.weight() * self.barrier(self.distance(at))
    }

    fn derivatives(&self, at: Configuration<'_>, _: Range<usize>, sink: &mut dyn Sink) {
        let (g, h) = self.slopes(self.distance(at));
        let bodies = self.case.barrier.bodies();
        let (mut vertices, mut components, mut t) = (vec![], vec![], 0.0);
        for (&i, w) in self.case.pair.iter().zip(self.separation.weights) {
            match (i as usize).checked_sub(bodies.garment_count()) {
                Some(k) => t += w * self.normal().dot(bodies.avatar.motion[k]),
                None => {
                    vertices.push(i);
                    components.push(w * self.normal());
                }
            }
        }
        let a = Direction { vertices: &vertices, components: &components, t };
        sink.rank_one(a, self.case.weight() * g, self.case.weight() * h);
    }

    fn stencils(&self, _: &mut dyn FnMut(&[u32])) {}
}

#[test]
fn hessian_is_that_of_the_frozen_pair() {
    for (seed, fraction, parallel) in [(6, 0.1, false), (7, 0.5, false), (8, 0.9, false), (9, 0.3, true)] {
        cases(seed, fraction, parallel, |case, random| {
            let x = case.positions();
            let m = match case.pair_type {
                PairType::PointTriangle => 1.0,
                PairType::EdgeEdge => {
                    let rest = case.pair.map(|i| case.barrier.bodies().rest(i));
                    mollifier::value(&x, mollifier::threshold(&rest))
                }
            };
            let frozen = Frozen { case: &case, separation: case.pair_type.separation(&x), m };
            // The model has its own exact derivatives, and those of the term are the same.
            check_hessian(&frozen, &case.x, T, 1e-6, 1e-4);
            let (ours, model) = (dense(&case.barrier, &case.x, T).hessian, dense(&frozen, &case.x, T).hessian);
            let scale = model.iter().flatten().fold(0.0_f64, |s, v| s.max(v.abs()));
            for (a, b) in ours.iter().flatten().zip(model.iter().flatten()) {
                assert!((a - b).abs() <= 1e-5 * scale, "{a:e} {b:e} {scale:e}");
            }
            check_semidefinite(&case.barrier, &case.x, T, &mut || random.signed());
        });
    }
}

/// Pairs of the garment at these multiples of d-hat at rest, and at this fraction of their own d-hat now.
fn near_at_rest(seed: u64, at_rest: f64, fraction: f64, mut each: impl FnMut(Case, f64)) {
    let mut random = Random::new(seed);
    let settings = BarrierSettings { rest_share: 0.9, ..SETTINGS };
    for pair_type in [PairType::PointTriangle, PairType::EdgeEdge] {
        for _ in 0..30 {
            let shape: [DVec3; 4] = std::array::from_fn(|_| SIZE * random.vector());
            let rest = placed(pair_type, shape, at_rest * SETTINGS.dhat_self);
            let dhat = (0.9 * at_rest * SETTINGS.dhat_self).clamp(4.0 * SETTINGS.min_separation, SETTINGS.dhat_self);
            let x = placed(pair_type, shape.map(|p| p + 0.1 * SIZE * random.vector()), fraction * dhat);
            let mut case = Case::new(pair_type, Sides::Garment, x, rest);
            case.barrier.set_settings(settings);
            each(case, dhat);
        }
    }
}

#[test]
fn a_pair_that_is_near_at_rest_repels_below_a_share_of_that() {
    // The last is nearer than the minimum separation allows.
    for (seed, at_rest) in [(13, 0.5), (14, 0.1), (15, 3.0), (16, 0.003)] {
        near_at_rest(seed, at_rest, 1.001, |case, _| assert_eq!(case.barrier.value(case.at(), 0..1), 0.0));
        near_at_rest(seed, at_rest, 0.7, |case, dhat| {
            check_gradient(&case.barrier, &case.x, T, 1e-8, 1e-4);
            let x = case.positions();
            let d = case.pair_type.separation(&x).squared;
            let (floor, top) = (SETTINGS.min_separation.powi(2), dhat * dhat);
            let m = match case.pair_type {
                PairType::PointTriangle => 1.0,
                PairType::EdgeEdge => {
                    mollifier::value(&x, mollifier::threshold(&case.pair.map(|i| case.barrier.bodies().rest(i))))
                }
            };
            let weight = case.weight() * (SETTINGS.dhat_self / dhat).powi(3);
            let expected = -weight * m * (d - top).powi(2) * ((d - floor) / (top - floor)).ln();
            let value = case.barrier.value(case.at(), 0..1);
            assert!((value - expected).abs() <= 1e-9 * expected && value > 0.0, "{value} instead of {expected}");
        });
    }
}

/// What is far apart at rest has all of its barrier, and so has what passes through itself there.
#[test]
fn other_pairs_have_the_d_hat_of_their_group() {
    near_at_rest(17, 4.0, 0.9, |mut case, _| {
        let capped = case.barrier.value(case.at(), 0..1);
        case.barrier.set_settings(SETTINGS);
        assert_eq!(case.barrier.value(case.at(), 0..1), capped);
    });
    near_at_rest(18, 0.2, 1.1, |mut case, _| {
        assert_eq!(case.barrier.value(case.at(), 0..1), 0.0);
        // Contact finds its minimum separation by what is near, repelled or not.
        assert_eq!(case.barrier.activity(case.at()).count, 1);
        case.barrier.set_intersecting_at_rest(vec![true, true, true, false]);
        assert_eq!(case.barrier.value(case.at(), 0..1), 0.0);
        case.barrier.set_intersecting_at_rest(vec![true; 4]);
        assert!(case.barrier.value(case.at(), 0..1) > 0.0);
    });
}

#[test]
fn vertices_without_weight_are_left_out() {
    struct Count(Vec<usize>);
    impl Sink for Count {
        fn rank_one(&mut self, a: Direction<'_>, _: f64, _: f64) {
            self.0.push(a.vertices.len());
        }
    }
    let p = |x: f64, y: f64, z: f64| SIZE * DVec3::new(x, y, z);
    // The point is closest to a corner, to an edge, to the face.
    for (point, count) in [(p(-0.05, -0.05, 0.0), 2), (p(0.5, -0.05, 0.0), 3), (p(0.2, 0.2, 0.05), 4)] {
        let x = [point, p(0., 0., 0.), p(1., 0., 0.), p(0., 1., 0.)];
        let case = Case::new(PairType::PointTriangle, Sides::Garment, x, x);
        let mut sink = Count(vec![]);
        case.barrier.derivatives(case.at(), 0..1, &mut sink);
        assert_eq!(sink.0, [count]);
    }
}

#[test]
fn value_is_infinite_at_the_minimum_separation_and_zero_beyond_dhat() {
    for (parallel, seed) in [(false, 10), (true, 11)] {
        cases(seed, -0.0005, parallel, |case, _| {
            assert!(case.pair_type.separation(&case.positions()).squared.sqrt() < SETTINGS.min_separation);
            assert_eq!(case.barrier.value(case.at(), 0..1), f64::INFINITY);
        });
        cases(seed, 1.01, parallel, |case, _| {
            assert_eq!(case.barrier.value(case.at(), 0..1), 0.0);
            let x = case.x.clone();
            let activity = case.barrier.activity(Configuration { x: &x, t: T });
            assert_eq!((activity.count, activity.min_distance_self), (0, f64::INFINITY));
        });
    }
}

#[test]
fn two_edges_exactly_parallel_at_the_minimum_separation_are_still_refused() {
    let p = |x: f64, y: f64, z: f64| SIZE * DVec3::new(x, y, z);
    let lift = DVec3::Z * 0.5 * SETTINGS.min_separation;
    let x = [p(0., 0., 0.) + lift, p(1., 0., 0.) + lift, p(-1., 0., 0.), p(2., 0., 0.)];
    let case = Case::new(PairType::EdgeEdge, Sides::Garment, x, x);
    assert_eq!(mollifier::value(&x, mollifier::threshold(&x)), 0.0);
    assert_eq!(case.barrier.value(case.at(), 0..1), f64::INFINITY);
}

/// The vertices of each rank-one update of a Hessian.
struct Cliques(Vec<Vec<u32>>);

impl Sink for Cliques {
    fn rank_one(&mut self, a: Direction<'_>, _: f64, _: f64) {
        self.0.push(a.vertices.to_vec());
    }
}

#[test]
fn pattern_and_statistics_follow_what_is_active_and_ranges_add_up() {
    // 2000 points over one garment triangle and one avatar triangle, some active.
    let mut random = Random::new(12);
    let corner = [DVec3::ZERO, SIZE * DVec3::X, SIZE * DVec3::Y];
    let mut x: Vec<DVec3> = corner.to_vec();
    x.extend(
        (0..2000).map(|_| SIZE * DVec3::new(0.5 * random.unit(), 0.5 * random.unit(), 0.05 + 0.4 * random.unit())),
    );
    let avatar = Avatar {
        surface: Surface::new(3, vec![[0, 1, 2]]),
        start: corner.to_vec(),
        motion: vec![0.5 * SIZE * DVec3::Z; 3],
    };
    let n = x.len() as u32;
    let bodies =
        Bodies { garment: Garment { surface: Surface::new(x.len(), vec![[0, 1, 2]]), rest: x.clone() }, avatar };
    let own: Vec<[u32; 4]> = (3..n).map(|p| [p, 0, 1, 2]).collect();
    let theirs: Vec<[u32; 4]> = (3..n).map(|p| [p, n, n + 1, n + 2]).collect();
    let mut barrier = Barrier::new(Arc::new(bodies), SETTINGS);
    *barrier.candidates_mut() = CandidateSet::new(&own, &[], &theirs, &[]);
    let at = Configuration { x: &x, t: 1.0 };
    // Assembly finds the pairs of a contact by its derivatives, not from the stencils.
    barrier.stencils(&mut |_| panic!("contacts have no stencils"));
    // Where the pattern grows, it grows by all the candidates of the garment with itself, in contact or not.
    let mut passing = Vec::new();
    barrier.passing_stencils(&mut |pair| passing.push(pair.to_vec()));
    assert_eq!(passing, own);
    let pattern = |barrier: &Barrier| {
        let mut cliques = Cliques(Vec::new());
        barrier.derivatives(at, 0..barrier.len(), &mut cliques);
        cliques.0
    };

    let height = |p: &DVec3, z: f64| (p.z - z).abs();
    let avatar_z = 0.5 * SIZE;
    let close_own: Vec<u32> = (3..n).filter(|&i| height(&x[i as usize], 0.0) < SETTINGS.dhat_self).collect();
    let close_theirs: Vec<u32> = (3..n).filter(|&i| height(&x[i as usize], avatar_z) < SETTINGS.dhat_avatar).collect();
    assert!(close_own.len() > 50 && close_theirs.len() > 50 && close_theirs.len() < 1900);
    let activity = barrier.activity(at);
    assert_eq!(activity.count, close_own.len() + close_theirs.len());
    let least = |z: f64| x[3..].iter().map(|p| height(p, z)).fold(f64::INFINITY, f64::min);
    assert!((activity.min_distance_self - least(0.0)).abs() < 1e-15);
    assert!((activity.min_distance_avatar - least(avatar_z)).abs() < 1e-15);
    let mut expected: Vec<Vec<u32>> = close_own.iter().map(|&p| vec![p, 0, 1, 2]).collect();
    expected.extend(close_theirs.iter().map(|&p| vec![p]));
    assert_eq!(pattern(&barrier), expected);

    let whole = barrier.value(at, 0..barrier.len());
    let parts: f64 = (0..barrier.len()).map(|i| barrier.value(at, i..i + 1)).sum();
    assert!(whole > 0.0 && (whole - parts).abs() < 1e-12 * whole);
    for threads in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        assert_eq!(pool.install(|| barrier.activity(at)), activity);
    }

    // A wider barrier has more of them at once.
    barrier.set_settings(BarrierSettings { dhat_avatar: 0.1, ..SETTINGS });
    assert!(barrier.activity(at).count > activity.count);
    assert_eq!(pattern(&barrier).len(), barrier.activity(at).count);
}

/// The border along a barrier path against differences of the gradient along s.
#[test]
fn the_border_of_a_barrier_path_is_the_derivative_of_its_gradient() {
    let rates = BarrierPathRates { dhat_avatar: -1.6, weight: 3.0 };
    let mut compared = 0;
    for (seed, fraction) in [(8, 0.3), (9, 0.6), (10, 0.95)] {
        cases(seed, fraction, false, |mut case, _| {
            let rest = case.pair.map(|i| case.barrier.bodies().rest(i));
            if case.pair_type == PairType::EdgeEdge
                && mollifier::value(&case.positions(), mollifier::threshold(&rest)) < 1.0
            {
                return;
            }
            let n = 3 * case.x.len();
            let mut gradient_at = |s: f64| {
                let dhat_avatar = SETTINGS.dhat_avatar * (rates.dhat_avatar * s).exp();
                case.barrier.set_settings(BarrierSettings { dhat_avatar, ..SETTINGS });
                let gradient = dense(&case.barrier, &case.x, T).gradient;
                gradient.iter().map(|g| g * (rates.weight * s).exp()).collect::<Vec<_>>()
            };
            let step = 1e-6;
            let (after, before) = (gradient_at(step), gradient_at(-step));
            case.barrier.set_settings(SETTINGS);
            // The part of t, which is constant on that path, is in both.
            let of_t = dense(&case.barrier, &case.x, T).hessian;
            case.barrier.set_barrier_path(Some(rates));
            let both = dense(&case.barrier, &case.x, T).hessian;
            let numeric: Vec<f64> = (0..n).map(|i| (after[i] - before[i]) / (2.0 * step)).collect();
            let scale = numeric.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
            assert!(scale > 0.0, "nothing to compare");
            for i in 0..n {
                let border = both[i][n] - of_t[i][n];
                assert!((border - numeric[i]).abs() < 1e-5 * scale, "entry {i}: {border:e}, numeric {:e}", numeric[i]);
            }
            compared += 1;
        });
    }
    assert!(compared > 300, "{compared}");
}

/// With the curvature the Hessian is above that of the value, however small the gap: no step along it gains less than the
/// quadratic model says, to second order.
#[test]
fn curved_hessian_bounds_that_of_the_value() {
    let mut raised = 0;
    for (seed, fraction) in [(12, 0.02), (13, 0.1), (14, 0.5)] {
        cases(seed, fraction, false, |mut case, random| {
            let plain = dense(&case.barrier, &case.x, T);
            case.barrier.set_curved(true);
            let curved = dense(&case.barrier, &case.x, T);
            check_semidefinite(&case.barrier, &case.x, T, &mut || random.signed());
            assert_eq!(plain.gradient, curved.gradient);
            let x = case.positions();
            let rest = case.pair.map(|i| case.barrier.bodies().rest(i));
            if case.pair_type == PairType::EdgeEdge && mollifier::value(&x, mollifier::threshold(&rest)) < 1.0 {
                return;
            }
            let gap = fraction * (case.dhat() - SETTINGS.min_separation);
            for _ in 0..4 {
                let motion: Vec<f64> = (0..3 * case.x.len() + 1).map(|_| random.signed()).collect();
                let at = |k: f64| {
                    let step = 1e-3 * gap * k;
                    let x: Vec<DVec3> =
                        case.x.iter().zip(motion.chunks(3)).map(|(x, v)| *x + step * DVec3::from_slice(v)).collect();
                    let t = T + step * motion[motion.len() - 1];
                    case.barrier.value(Configuration { x: &x, t }, 0..1)
                };
                let step = 1e-3 * gap;
                let second =
                    (16.0 * (at(1.0) + at(-1.0)) - (at(2.0) + at(-2.0)) - 30.0 * at(0.0)) / (12.0 * step * step);
                let ours = curved.quadratic(&motion);
                assert!(ours >= second - 1e-3 * ours.abs(), "{:?}: {ours:e} {second:e}", case.pair_type);
                raised += usize::from(plain.quadratic(&motion) < second - 1e-2 * second.abs());
            }
        });
    }
    // Without it, it often is below.
    assert!(raised > 20, "{raised}");
}
