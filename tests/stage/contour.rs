//! The length of intersection contours: against clipping on the line of the two planes, and its gradient against differences.

use bespoke::stage::start::contour::contour_length;
use glam::DVec3;
use testing::Random;

/// The length of what two triangles have in common, by the intervals in which the line of their planes crosses them
/// (Moeller 1997).
fn clipped([s, t]: [[DVec3; 3]; 2]) -> f64 {
    let normal = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a);
    let (n, m) = (normal(s), normal(t));
    let line = n.cross(m).normalize();
    let interval = |triangle: [DVec3; 3], origin: DVec3, across: DVec3| {
        let mut ends = Vec::new();
        for k in 0..3 {
            let (p, q) = (triangle[k], triangle[(k + 1) % 3]);
            let (from, to) = ((p - origin).dot(across), (q - origin).dot(across));
            if (from > 0.0) != (to > 0.0) {
                ends.push(p.lerp(q, from / (from - to)).dot(line));
            }
        }
        (ends.len() == 2).then(|| [ends[0].min(ends[1]), ends[0].max(ends[1])])
    };
    match (interval(s, t[0], m), interval(t, s[0], n)) {
        (Some([a, b]), Some([c, d])) => (b.min(d) - a.max(c)).max(0.0),
        _ => 0.0,
    }
}

#[test]
fn length_is_that_of_clipping() {
    let mut random = Random::new(3);
    let mut crossing = 0;
    for _ in 0..2000 {
        let points: Vec<DVec3> = (0..6).map(|_| random.vector()).collect();
        let (length, _) = contour_length(&points, &[[0, 1, 2], [3, 4, 5]], &[[0, 1]]);
        let expected = clipped([[0, 1, 2].map(|k| points[k]), [3, 4, 5].map(|k| points[k])]);
        assert!((length - expected).abs() < 1e-9, "{length} instead of {expected}");
        crossing += usize::from(expected > 0.0);
    }
    assert!(crossing > 200, "only {crossing} of the pairs of triangles cross");
}

#[test]
fn gradient_is_that_of_differences() {
    let mut random = Random::new(5);
    // Apart, and with a corner in common.
    for triangles in [[[0u32, 1, 2], [3, 4, 5]], [[0, 1, 2], [0, 3, 4]]] {
        let mut tested = 0;
        while tested < 40 {
            let points: Vec<DVec3> = (0..6).map(|_| random.vector()).collect();
            let length = |points: &[DVec3]| contour_length(points, &triangles, &[[0, 1]]);
            let (here, gradient) = length(&points);
            // Not where a crossing is about to begin or end, or a side is almost in the plane of the other.
            if here < 0.2 || gradient.iter().any(|g| g.length() > 10.0) {
                continue;
            }
            tested += 1;
            const STEP: f64 = 1e-6;
            for v in 0..points.len() {
                for axis in 0..3 {
                    let moved = |by: f64| {
                        let mut moved = points.clone();
                        moved[v][axis] += by;
                        length(&moved).0
                    };
                    let difference = (moved(STEP) - moved(-STEP)) / (2.0 * STEP);
                    assert!(
                        (difference - gradient[v][axis]).abs() < 1e-4,
                        "{difference} instead of {}",
                        gradient[v][axis]
                    );
                }
            }
        }
    }
}
