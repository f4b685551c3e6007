use bespoke::contact::ccd::{max_step, pair_step};
use bespoke::contact::{
    Avatar, Bodies, BroadPhase, CandidateSet, CollisionGroup, Configuration, Garment, Motion, PairType, Step, Surface,
};
use glam::DVec3;

use crate::pairs::{FORMS, PAIR_TYPES, SIZE, generic, interior, nasty};
use crate::scene::{Scene, sphere};
use testing::Random;

const MIN_SEPARATION: f64 = 1e-5;

fn distance(pair_type: PairType, x: &[DVec3; 4], v: &[DVec3; 4], time: f64) -> f64 {
    pair_type.separation(&std::array::from_fn(|i| x[i] + time * v[i])).squared.sqrt()
}

/// Samples the motion up to `answer` and asserts that the distance stays at the promised target.
fn check_safe(pair_type: PairType, x: &[DVec3; 4], v: &[DVec3; 4], min_separation: f64, answer: f64) {
    let first = distance(pair_type, x, v, 0.0);
    let target = min_separation + 0.1 * (first - min_separation);
    for k in 0..=400 {
        let d = distance(pair_type, x, v, answer * k as f64 / 400.0);
        assert!(
            d >= target - 1e-15 - 1e-9 * (target - min_separation),
            "{pair_type:?} {x:?} {v:?}: {d:e} < {target:e}"
        );
    }
}

/// The first sampled time at which the distance is at or below the minimum separation.
fn time_of_impact(pair_type: PairType, x: &[DVec3; 4], v: &[DVec3; 4], min_separation: f64) -> Option<f64> {
    (0..=4000).map(|k| k as f64 / 4000.0).find(|&t| distance(pair_type, x, v, t) <= min_separation)
}

#[test]
fn generic_motions_stop_late_but_not_too_late() {
    let mut random = Random::new(1);
    let (mut stopped, mut ratios) = (0, Vec::new());
    for pair_type in PAIR_TYPES {
        for _ in 0..3000 {
            let x = generic(&mut random);
            let v: [DVec3; 4] = std::array::from_fn(|_| 3.0 * SIZE * random.vector());
            let first = distance(pair_type, &x, &v, 0.0);
            if first <= MIN_SEPARATION {
                continue;
            }
            let answer = pair_step(pair_type, &x, &v, MIN_SEPARATION, 1.0);
            check_safe(pair_type, &x, &v, MIN_SEPARATION, answer);
            if answer < 1.0 {
                // It stops only where the target is all but reached.
                let left = distance(pair_type, &x, &v, answer) - (MIN_SEPARATION + 0.1 * (first - MIN_SEPARATION));
                assert!(left <= 0.02 * (first - MIN_SEPARATION), "{pair_type:?} {x:?} {v:?}: {left:e}");
                stopped += 1;
            }
            // Every hit is sampled within this width; the target is farther out.
            if first > 4e-3
                && let Some(impact) = time_of_impact(pair_type, &x, &v, 2e-4)
            {
                assert!(answer < impact);
                ratios.push(answer / impact);
            }
        }
    }
    assert!(stopped > 300 && ratios.len() > 100, "{stopped} {}", ratios.len());
    // A pair that comes close and hits much later is stopped early: the gap it keeps is a tenth.
    ratios.sort_by(f64::total_cmp);
    assert!(ratios[ratios.len() / 100] > 0.5 && ratios[ratios.len() / 2] > 0.85, "{ratios:?}");
}

#[test]
fn head_on_motion_reaches_nine_tenths() {
    let mut random = Random::new(2);
    for pair_type in PAIR_TYPES {
        for gap in [1e-2, 1e-3, 1e-4, 1e-6] {
            for _ in 0..200 {
                let x = interior(pair_type, gap + MIN_SEPARATION, &mut random);
                let first = pair_type.separation(&x);
                let direction = first.vector.normalize();
                // The first primitive goes straight through the second, on top of a common motion.
                let ride = 10.0 * random.vector();
                let count = pair_type.first_count();
                let v = std::array::from_fn(|i| if i < count { ride - 2.0 * gap * direction } else { ride });
                let answer = pair_step(pair_type, &x, &v, MIN_SEPARATION, 1.0);
                // The large common motion costs a few digits of the small relative one.
                assert!((answer - 0.45).abs() < 1e-3 + 1e-14 / gap, "{pair_type:?} {gap:e} {answer}");
            }
        }
    }
}

#[test]
fn hard_motions_are_safe() {
    let mut random = Random::new(3);
    let mut stopped = 0;
    for pair_type in PAIR_TYPES {
        for form in 0..FORMS {
            for k in 0..300 {
                let x = nasty(form, &mut random);
                let speed = 10f64.powi(-(k % 5));
                let mut v: [DVec3; 4] = std::array::from_fn(|_| speed * SIZE * random.vector());
                if k % 3 == 0 {
                    // Both primitives in translation: what is parallel stays parallel.
                    let (a, b) = (v[0], v[3]);
                    v = std::array::from_fn(|i| if i < pair_type.first_count() { a } else { b });
                }
                let separation = pair_type.separation(&x);
                if separation.squared.sqrt() <= MIN_SEPARATION {
                    continue;
                }
                if k % 2 == 0 {
                    // On top of that, straight at each other.
                    for p in &mut v[..pair_type.first_count()] {
                        *p -= 1.5 * separation.vector;
                    }
                }
                let answer = pair_step(pair_type, &x, &v, MIN_SEPARATION, 1.0);
                assert!(answer > 0.0 && answer <= 1.0);
                check_safe(pair_type, &x, &v, MIN_SEPARATION, answer);
                stopped += usize::from(answer < 1.0);
            }
        }
    }
    assert!(stopped > 1000, "{stopped}");
}

#[test]
fn tiny_gaps_are_kept() {
    let mut random = Random::new(4);
    for pair_type in PAIR_TYPES {
        for min_separation in [0.0, MIN_SEPARATION] {
            for k in 0..1000 {
                let gap = 10f64.powi(-3 - k % 7);
                let x = interior(pair_type, min_separation + gap, &mut random);
                let v: [DVec3; 4] = std::array::from_fn(|_| 10f64.powi(-(k % 4)) * SIZE * random.vector());
                let answer = pair_step(pair_type, &x, &v, min_separation, 1.0);
                assert!(answer > 0.0, "{pair_type:?} {gap:e}");
                for k in 0..=1000 {
                    let d = distance(pair_type, &x, &v, answer * k as f64 / 1000.0);
                    assert!(d > min_separation + 0.09 * gap - 1e-15, "{pair_type:?} {gap:e} {d:e}");
                }
            }
        }
    }
}

#[test]
fn sliding_past_each_other_costs_nothing() {
    // Grazing at a millionth above the minimum separation, over the whole size of the primitives.
    let gap = MIN_SEPARATION + 1e-6;
    let p = |x: f64, y: f64, z: f64| DVec3::new(x, y, z) * SIZE;
    let lift = DVec3::Z * gap;
    let cases = [
        (PairType::PointTriangle, [p(0.1, 0.1, 0.0) + lift, p(0., 0., 0.), p(1., 0., 0.), p(0., 1., 0.)]),
        (PairType::EdgeEdge, [p(-0.5, 0., 0.) + lift, p(0.5, 0., 0.) + lift, p(0., -1., 0.), p(0., 1., 0.)]),
        (PairType::EdgeEdge, [p(-0.5, 0., 0.) + lift, p(0.5, 0., 0.) + lift, p(-1., 0., 0.), p(1., 0., 0.)]),
    ];
    for (pair_type, x) in cases {
        let slide = p(0.4, 0.3, 0.0);
        let v = std::array::from_fn(|i| if i < pair_type.first_count() { slide } else { DVec3::ZERO });
        assert_eq!(pair_step(pair_type, &x, &v, MIN_SEPARATION, 1.0), 1.0);
        // A common motion, however large, is no relative motion.
        assert_eq!(pair_step(pair_type, &x, &[100.0 * slide; 4], MIN_SEPARATION, 1.0), 1.0);
    }
}

#[test]
fn pairs_below_the_minimum_separation_may_only_separate() {
    let mut random = Random::new(5);
    for pair_type in PAIR_TYPES {
        for _ in 0..300 {
            let x = interior(pair_type, 0.5 * MIN_SEPARATION, &mut random);
            let direction = pair_type.separation(&x).vector.normalize();
            let toward = |s: f64| -> [DVec3; 4] {
                std::array::from_fn(|i| if i < pair_type.first_count() { s * direction } else { DVec3::ZERO })
            };
            assert_eq!(pair_step(pair_type, &x, &toward(-1e-3), MIN_SEPARATION, 1.0), 0.0);
            assert_eq!(pair_step(pair_type, &x, &toward(1e-3), MIN_SEPARATION, 1.0), 1.0);
            assert_eq!(pair_step(pair_type, &x, &[DVec3::ZERO; 4], MIN_SEPARATION, 1.0), 1.0);
        }
        let touching = match pair_type {
            PairType::PointTriangle => [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::ZERO],
            PairType::EdgeEdge => [-DVec3::X, DVec3::X, -DVec3::Y, DVec3::Y],
        };
        assert_eq!(pair_type.separation(&touching).squared, 0.0);
        assert_eq!(
            pair_step(pair_type, &touching, &[DVec3::Z, DVec3::ZERO, DVec3::X, DVec3::Y], MIN_SEPARATION, 1.0),
            0.0
        );
        assert_eq!(pair_step(pair_type, &touching, &[DVec3::ZERO; 4], MIN_SEPARATION, 1.0), 1.0);
    }
}

/// The smallest distance over all candidates at a time of the step.
fn smallest(motion: &Motion, set: &CandidateSet, time: f64) -> f64 {
    let distances = set.ranges(0..set.len()).flat_map(|run| {
        run.pairs.iter().map(move |&pair| {
            let (x, v) = (motion.positions(pair), motion.displacements(pair));
            distance(run.pair_type, &x, &v, time)
        })
    });
    distances.fold(f64::INFINITY, f64::min)
}

#[test]
fn largest_step_is_the_minimum_over_pairs_for_any_number_of_threads() {
    let mut cut = 0;
    for seed in 0..8 {
        let scene = Scene::random(seed, 0.2);
        let at = Configuration { x: &scene.x, t: 0.3 };
        let step = Step { dx: &scene.dx, dt: 0.5 };
        let mut all = CandidateSet::default();
        let motion = Motion::new(&scene.bodies, at, Some(&step));
        BroadPhase::new(&scene.bodies).candidates(&scene.bodies, &motion, 1.0, 0.01, 0.01, &mut all);
        // The soup intersects itself; keep the pairs above the minimum separation.
        let apart = |pair_type: PairType, group: CollisionGroup| -> Vec<[u32; 4]> {
            let far = |pair: &&[u32; 4]| pair_type.separation(&scene.bodies.positions(**pair, at)).squared > 4e-4;
            all.of(pair_type, group).iter().filter(far).copied().collect()
        };
        let set = CandidateSet::new(
            &apart(PairType::PointTriangle, CollisionGroup::Garment),
            &apart(PairType::EdgeEdge, CollisionGroup::Garment),
            &apart(PairType::PointTriangle, CollisionGroup::Avatar),
            &apart(PairType::EdgeEdge, CollisionGroup::Avatar),
        );
        assert!(set.len() > 1000);
        let mut least = 1.0_f64;
        for run in set.ranges(0..set.len()) {
            for &pair in run.pairs {
                let (x, v) = (motion.positions(pair), motion.displacements(pair));
                least = least.min(pair_step(run.pair_type, &x, &v, MIN_SEPARATION, 1.0));
            }
        }
        for threads in [1, 2, 4] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            for _ in 0..5 {
                let answer = pool.install(|| max_step(&motion, &set, |_| MIN_SEPARATION, 1.0));
                assert_eq!(answer.to_bits(), least.to_bits());
            }
        }
        assert_eq!(max_step(&motion, &set, |_| MIN_SEPARATION, 0.5 * least), 0.5 * least);
        cut += usize::from(least < 1.0);
        for k in 0..=50 {
            assert!(smallest(&motion, &set, least * k as f64 / 50.0) > MIN_SEPARATION);
        }
    }
    assert!(cut >= 6);
    let scene = Scene::random(0, 0.1);
    let at = Configuration { x: &scene.x, t: 0.0 };
    let step = Step { dx: &scene.dx, dt: 0.0 };
    let motion = Motion::new(&scene.bodies, at, Some(&step));
    assert_eq!(max_step(&motion, &CandidateSet::default(), |_| MIN_SEPARATION, 0.7), 0.7);
}

#[test]
fn inflating_sphere_stops_inside_the_shell() {
    let (unit, triangles) = sphere(24);
    let shell: Vec<DVec3> = unit.iter().map(|p| 0.5 * *p).collect();
    let count = unit.len();
    let bodies = Bodies {
        garment: Garment { surface: Surface::new(count, triangles.clone()), rest: shell.clone() },
        avatar: Avatar {
            surface: Surface::new(count, triangles),
            start: unit.iter().map(|p| 0.1 * *p).collect(),
            motion: unit,
        },
    };
    let still = vec![DVec3::ZERO; count];
    let at = Configuration { x: &shell, t: 0.0 };
    let step = Step { dx: &still, dt: 1.0 };
    let mut out = CandidateSet::default();
    let mut broad_phase = BroadPhase::new(&bodies);
    let motion = Motion::new(&bodies, at, Some(&step));
    broad_phase.candidates(&bodies, &motion, 1.0, 1e-3, 1e-3, &mut out);
    let answer = max_step(&motion, &out, |_| MIN_SEPARATION, 1.0);
    // The vertices of both meet at 0.4; a tenth of the gap is kept.
    assert!(answer > 0.35 && answer < 0.4, "{answer}");
    let there = Motion::new(&bodies, Configuration { x: &shell, t: answer }, None);
    broad_phase.candidates(&bodies, &there, 1.0, 1e-3, 0.1, &mut out);
    assert!(out.len() > count);
}
