//! A reference by brute force in integers, with another algorithm.
//!
//! Two convex hulls meet where 0 is in the hull of the differences of their points, and by Caratheodory then in a
//! simplex of at most four of them. No case distinction for degenerate triangles is needed.

pub type Point = [i128; 3];

fn sub(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: Point, b: Point) -> i128 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn det(a: Point, b: Point, c: Point) -> i128 {
    dot(a, cross(b, c))
}

/// Whether 0 is in the convex hull of `points`.
fn hull_contains_zero(points: &[Point]) -> bool {
    const ZERO: Point = [0; 3];
    for (i, &a) in points.iter().enumerate() {
        if a == ZERO {
            return true;
        }
        for (j, &b) in points.iter().enumerate().take(i) {
            if cross(a, b) == ZERO && dot(a, b) <= 0 {
                return true;
            }
            for (k, &c) in points.iter().enumerate().take(j) {
                if det(a, b, c) == 0 {
                    let parts = [cross(a, b), cross(b, c), cross(c, a)];
                    let n = [0, 1, 2].map(|m| parts[0][m] + parts[1][m] + parts[2][m]);
                    if n != ZERO && parts.iter().all(|&p| dot(p, n) >= 0) {
                        return true;
                    }
                }
                for &d in points.iter().take(k) {
                    let parts = [det(b, c, d), -det(a, c, d), det(a, b, d), -det(a, b, c)];
                    let volume: i128 = parts.iter().sum();
                    if volume != 0 && parts.iter().all(|p| p.signum() * volume.signum() >= 0) {
                        return true;
                    }
                }
            }
        }
    }
    false
}

/// Whether the hulls of two point sets meet.
pub fn meet(s: &[Point], t: &[Point]) -> bool {
    let differences: Vec<Point> = s.iter().flat_map(|&a| t.iter().map(move |&b| sub(a, b))).collect();
    hull_contains_zero(&differences)
}

/// Whether a triangle has an area.
pub fn has_area(t: [Point; 3]) -> bool {
    cross(sub(t[1], t[0]), sub(t[2], t[0])) != [0; 3]
}

/// Whether triangles (v, a, b) and (v, c, d), both with an area, have more in common than v: the cones from v do.
pub fn more_than_corner(v: Point, [a, b]: [Point; 2], [c, d]: [Point; 2]) -> bool {
    hull_contains_zero(&[sub(a, v), sub(b, v), sub(v, c), sub(v, d)])
}

/// Whether triangles (p, q, a) and (p, q, b) have more in common than the segment from p to q.
pub fn more_than_edge([p, q]: [Point; 2], a: Point, b: Point) -> bool {
    if has_area([p, q, a]) && has_area([p, q, b]) {
        let e = sub(q, p);
        let (m, n) = (cross(e, sub(a, p)), cross(e, sub(b, p)));
        return cross(m, n) == [0; 3] && dot(m, n) > 0;
    }
    // What they have in common is then a segment that ends in given points.
    [a, b].iter().any(|&x| meet(&[x], &[p, q, a]) && meet(&[x], &[p, q, b]) && !meet(&[x], &[p, q]))
}
