//! The queries that continuous collision detection is known to get wrong, checked by a distance found by search and by exact
//! predicates on densely sampled positions: neither uses the code under test.

use bespoke::contact::PairType;
use bespoke::contact::ccd::pair_step;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::verify::intersections;
use glam::{DMat3, DVec3};

use crate::distance::searched;
use crate::pairs::{PAIR_TYPES, SIZE, interior};
use testing::Random;

const MIN_SEPARATION: f64 = 1e-5;

fn moved(x: &[DVec3; 4], v: &[DVec3; 4], time: f64) -> [DVec3; 4] {
    std::array::from_fn(|i| x[i] + time * v[i])
}

fn distance(pair_type: PairType, x: &[DVec3; 4]) -> f64 {
    // The search does not subtract a base point, so this does.
    let base = x[1];
    searched(pair_type, &x.map(|p| p - base)).sqrt()
}

/// Whether the primitives touch, exactly; points and edges are triangles without area.
fn touch(pair_type: PairType, x: &[DVec3; 4]) -> bool {
    let first = pair_type.first_count() as u32;
    let mesh = |corners| TriangleMesh { positions: x.to_vec(), triangles: vec![corners] };
    let second = if first == 1 { [1, 2, 3] } else { [2, 3, 3] };
    intersections(&mesh([0, first - 1, first - 1]), Some(&mesh(second)), 0).unwrap().count > 0
}

/// Asserts that the pair keeps its target and never touches up to the answer, which is returned. Coordinates are rounded to
/// `ulp`.
fn check_query(
    pair_type: PairType,
    x: &[DVec3; 4],
    v: &[DVec3; 4],
    min_separation: f64,
    ulp: f64,
    tally: &mut Tally,
) -> f64 {
    let answer = pair_step(pair_type, x, v, min_separation, 1.0);
    let label = || format!("{pair_type:?} {x:?} {v:?} min_separation {min_separation:e}, answer {answer:e}");
    let first = distance(pair_type, x);
    let target = min_separation + 0.1 * (first - min_separation);
    let slack = 4.0 * ulp + 1e-6 * (target - min_separation);
    assert!(answer > 0.0 && answer <= 1.0, "{}", label());
    let mut last = first;
    for k in 1..=60 {
        let now = moved(x, v, answer * f64::from(k) / 60.0);
        last = distance(pair_type, &now);
        assert!(last >= target - slack, "{}: {last:e} < {target:e} at {k}", label());
        assert!(k % 15 != 0 || ulp > 0.1 * target || !touch(pair_type, &now), "{}: touches at {k}", label());
    }
    if answer == 1.0 {
        tally.full += 1;
    } else if last <= target + 0.025 * (first - min_separation) + slack {
        tally.stopped += 1;
    } else {
        tally.early += 1;
    }
    answer
}

/// How queries ended: at the full step, near the target, or before that since the advances were used up.
#[derive(Debug, Default)]
struct Tally {
    full: usize,
    stopped: usize,
    early: usize,
}

impl Tally {
    /// At least so many ended each way, and hardly any early.
    fn check(&self, full: usize, stopped: usize) {
        println!("{self:?}");
        assert!(self.full >= full && self.stopped >= stopped, "{self:?}");
        assert!(20 * self.early <= self.stopped, "{self:?}");
    }
}

fn rotation(random: &mut Random) -> DMat3 {
    let x = random.vector().normalize();
    let y = x.cross(random.vector()).normalize();
    DMat3::from_cols(x, y, x.cross(y))
}

#[test]
fn nearly_parallel_edges_slide() {
    let mut random = Random::new(21);
    let mut tally = Tally::default();
    for k in 0..1500 {
        let turn = rotation(&mut random);
        let gap = MIN_SEPARATION + 10f64.powi(-3 - k % 6);
        let angle = if k % 7 == 0 { 0.0 } else { 10f64.powi(-1 - k % 13) };
        let offset = 2.0 * SIZE * random.signed();
        let end = SIZE * DVec3::new(1.0, angle * random.signed(), 0.0);
        let lift = DVec3::new(offset, 0.0, gap);
        let x = [lift, lift + end, DVec3::ZERO, SIZE * DVec3::X].map(|p| turn * p);
        // Along each other, a little apart or together, and a little of a turn.
        let closing = gap * random.signed();
        let slide = turn * DVec3::new(4.0 * SIZE * random.signed(), 1e-3 * SIZE * random.signed(), closing);
        let twist = turn * (DVec3::Z * 0.2 * closing.abs() * random.signed());
        let v = [slide, slide + twist, DVec3::ZERO, DVec3::ZERO];
        check_query(PairType::EdgeEdge, &x, &v, MIN_SEPARATION, 1e-17, &mut tally);
    }
    tally.check(300, 100);
}

#[test]
fn edges_that_turn_through_the_parallel_position() {
    let mut random = Random::new(22);
    let mut tally = Tally::default();
    for k in 0..600 {
        let gap = MIN_SEPARATION + 10f64.powi(-3 - k % 5);
        // From one side of parallel to the other, at one height, or sinking onto the edge below.
        let sink = if k % 2 == 0 { 0.0 } else { -2.0 * gap * random.unit() };
        let swing = SIZE * DVec3::Y * (0.5 + random.unit());
        let half = SIZE * DVec3::X;
        let lift = gap * DVec3::Z;
        let x = [lift - half - swing, lift + half + swing, -half, half];
        let fall = sink * DVec3::Z;
        let v = [2.0 * swing + fall, -2.0 * swing + fall, DVec3::ZERO, DVec3::ZERO];
        let turn = rotation(&mut random);
        let answer = check_query(
            PairType::EdgeEdge,
            &x.map(|p| turn * p),
            &v.map(|p| turn * p),
            MIN_SEPARATION,
            1e-17,
            &mut tally,
        );
        assert!(sink != 0.0 || answer == 1.0, "no motion towards each other: {answer}");
    }
    tally.check(300, 100);
}

#[test]
fn a_point_in_the_plane_of_its_triangle() {
    let mut random = Random::new(23);
    let mut tally = Tally::default();
    let mut hits = 0;
    for k in 0..1000 {
        let turn = rotation(&mut random);
        let flat = |random: &mut Random| SIZE * DVec3::new(random.signed(), random.signed(), 0.0);
        let corners = [flat(&mut random), flat(&mut random), flat(&mut random)];
        let point = if k % 3 == 0 {
            // Just beside an edge.
            let side = (corners[1] - corners[0]).cross(DVec3::Z).normalize();
            let inward = side.dot(corners[2] - corners[0]).signum();
            corners[0].lerp(corners[1], random.unit()) - inward * side * (MIN_SEPARATION + 10f64.powi(-4 - k % 6))
        } else {
            3.0 * flat(&mut random)
        };
        let x = [point, corners[0], corners[1], corners[2]].map(|p| turn * p);
        if distance(PairType::PointTriangle, &x) <= 1.01 * MIN_SEPARATION {
            continue;
        }
        let v = [4.0 * flat(&mut random), 0.1 * flat(&mut random), DVec3::ZERO, DVec3::ZERO].map(|p| turn * p);
        let answer = check_query(PairType::PointTriangle, &x, &v, MIN_SEPARATION, 1e-17, &mut tally);
        // In the plane, the dense samples alone tell whether it hits.
        let met = (0..=500)
            .any(|k| distance(PairType::PointTriangle, &moved(&x, &v, f64::from(k) / 500.0)) <= MIN_SEPARATION);
        assert!(!met || answer < 1.0);
        hits += usize::from(met);
    }
    tally.check(100, hits.max(100));
}

#[test]
fn primitives_without_extent_meet_as_what_they_are() {
    let mut random = Random::new(24);
    let mut tally = Tally::default();
    for k in 0..200 {
        let turn = rotation(&mut random);
        let gap = 10f64.powi(-2 - k % 5);
        let (s, d) = (0.2 + 0.6 * random.unit(), turn * DVec3::Z);
        let [a, b] = [turn * (-s * SIZE * DVec3::X), turn * ((1.0 - s) * SIZE * DVec3::X)];
        let p = (MIN_SEPARATION + gap) * d;
        let fall = -2.0 * gap * d;
        // A point against an edge, against a point, and in both forms of a pair; the gap is closed at half time, and
        // nine tenths of it may be.
        let cases = [
            (PairType::EdgeEdge, [p, p, a, b], 2),
            (PairType::EdgeEdge, [p + a, p + b, DVec3::ZERO, DVec3::ZERO], 2),
            (PairType::EdgeEdge, [p, p, DVec3::ZERO, DVec3::ZERO], 2),
            (PairType::PointTriangle, [p, a, b, a], 1),
            (PairType::PointTriangle, [p, a, b, a.lerp(b, random.unit())], 1),
            (PairType::PointTriangle, [p, DVec3::ZERO, DVec3::ZERO, DVec3::ZERO], 1),
        ];
        for (pair_type, x, falling) in cases {
            let v = std::array::from_fn(|i| if i < falling { fall } else { DVec3::ZERO });
            let answer = check_query(pair_type, &x, &v, MIN_SEPARATION, 1e-17, &mut tally);
            assert!((answer - 0.45).abs() < 0.011, "{pair_type:?} {x:?}: {answer}");
        }
    }
    tally.check(0, 1000);
}

#[test]
fn gaps_of_a_thousandth_of_a_millionth_and_less() {
    let mut random = Random::new(25);
    let mut tally = Tally::default();
    for pair_type in PAIR_TYPES {
        for gap in [1e-9, 1e-10, 1e-11, 1e-12] {
            for k in 0..150 {
                // Near 0, where the coordinates have digits for such a gap, and with a minimum separation below it.
                let place = interior(pair_type, 0.0, &mut random);
                let centre = place.iter().sum::<DVec3>() / 4.0;
                let mut x = place.map(|p| p - centre);
                let n = match pair_type {
                    PairType::PointTriangle => (x[2] - x[1]).cross(x[3] - x[1]),
                    PairType::EdgeEdge => (x[1] - x[0]).cross(x[3] - x[2]),
                };
                let lift = gap * n.normalize();
                x[..pair_type.first_count()].iter_mut().for_each(|p| *p += lift);
                let min_separation = 0.25 * gap * f64::from(k % 2);
                let first = distance(pair_type, &x);
                if first < 0.5 * gap {
                    continue;
                }
                let speed = if k % 3 == 0 { SIZE } else { 3.0 * gap };
                let v: [DVec3; 4] = std::array::from_fn(|_| speed * random.vector());
                check_query(pair_type, &x, &v, min_separation, 1e-17, &mut tally);
            }
        }
    }
    tally.check(100, 300);
}

#[test]
fn large_coordinates_cost_digits_but_no_safety() {
    let mut random = Random::new(26);
    let mut tally = Tally::default();
    for pair_type in PAIR_TYPES {
        for away in [1e2, 1e4, 1e6] {
            let ulp = away * f64::EPSILON;
            for k in 0..200 {
                let shift = away * random.vector();
                let gap = MIN_SEPARATION + (1e4 * ulp).max(10f64.powi(-3 - k % 4));
                let place = interior(pair_type, gap, &mut random);
                let x = place.map(|p| p + shift);
                let ride = if k % 2 == 0 { 100.0 * random.vector() } else { DVec3::ZERO };
                let v: [DVec3; 4] = std::array::from_fn(|_| ride + 0.2 * SIZE * random.vector());
                check_query(pair_type, &x, &v, MIN_SEPARATION, ulp.max(1e-14), &mut tally);
            }
        }
    }
    tally.check(100, 200);
}
