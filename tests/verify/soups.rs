//! Random triangles on a coarse grid, full of degeneracies, against the integer reference.

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::verify::intersections;
use glam::DVec3;

use crate::twin;
use testing::Random;

struct Soup {
    points: Vec<twin::Point>,
    triangles: Vec<[u32; 3]>,
}

impl Soup {
    /// Triangles between vertices on the integer grid from 0 to `side`; some repeat an index or a position.
    fn random(random: &mut Random, vertices: usize, triangles: usize, side: f64) -> Self {
        let mut below = |n: f64| (random.unit() * n).floor();
        let points = (0..vertices).map(|_| std::array::from_fn(|_| below(side + 1.0) as i128)).collect();
        let triangles = (0..triangles).map(|_| std::array::from_fn(|_| below(vertices as f64) as u32)).collect();
        Self { points, triangles }
    }

    /// The mesh with coordinates `scale * (x, y, z) + shift`.
    fn mesh(&self, scale: f64, shift: DVec3) -> TriangleMesh {
        let position = |p: &twin::Point| DVec3::from_array(p.map(|c| c as f64)) * scale + shift;
        TriangleMesh { positions: self.points.iter().map(position).collect(), triangles: self.triangles.clone() }
    }

    fn corners(&self, t: usize) -> [twin::Point; 3] {
        self.triangles[t].map(|v| self.points[v as usize])
    }
}

fn members(t: &[u32; 3], keep: impl Fn(&u32) -> bool) -> Vec<u32> {
    let mut list: Vec<u32> = t.iter().copied().filter(keep).collect();
    list.sort_unstable();
    list.dedup();
    list
}

/// Whether triangles i and j of one soup intersect beyond what they share.
fn twin_in_mesh(soup: &Soup, i: usize, j: usize) -> bool {
    let at = |list: Vec<u32>| list.into_iter().map(|v| soup.points[v as usize]).collect::<Vec<_>>();
    let (s, t) = (&soup.triangles[i], &soup.triangles[j]);
    let shared = members(s, |v| t.contains(v));
    let rest = |t: &[u32; 3]| at(members(t, |v| !shared.contains(v)));
    let (a, b) = (rest(s), rest(t));
    let common = at(shared.clone());
    match common.len() {
        0 => twin::meet(&soup.corners(i), &soup.corners(j)),
        1 => {
            let hit = (!a.is_empty() && twin::meet(&a, &soup.corners(j)))
                || (!b.is_empty() && twin::meet(&b, &soup.corners(i)));
            if twin::has_area(soup.corners(i)) && twin::has_area(soup.corners(j)) {
                assert_eq!(hit, twin::more_than_corner(common[0], [a[0], a[1]], [b[0], b[1]]));
            }
            hit
        }
        2 => a.len() == 1 && b.len() == 1 && twin::more_than_edge([common[0], common[1]], a[0], b[0]),
        _ => true,
    }
}

/// Number of pairs with each number of shared corners that the two implementations agreed to intersect, and not.
type Tally = [[u32; 2]; 4];

fn compare_within(soup: &Soup, scale: f64, shift: DVec3, tally: &mut Tally) {
    let found = intersections(&soup.mesh(scale, shift), None, usize::MAX).unwrap();
    let mut expected = Vec::new();
    for i in 0..soup.triangles.len() {
        for j in i + 1..soup.triangles.len() {
            let hit = twin_in_mesh(soup, i, j);
            let shared = members(&soup.triangles[i], |v| soup.triangles[j].contains(v)).len();
            tally[shared][usize::from(hit)] += 1;
            if hit {
                expected.push([i as u32, j as u32]);
            }
        }
    }
    let surplus = found.pairs.iter().find(|p| !expected.contains(p));
    let missing = expected.iter().find(|p| !found.pairs.contains(p));
    if let Some(pair) = surplus.or(missing) {
        let [i, j] = pair.map(|t| t as usize);
        panic!(
            "pair {pair:?} differs: {:?} {:?}, corners {:?} {:?}",
            soup.triangles[i],
            soup.triangles[j],
            soup.corners(i),
            soup.corners(j)
        );
    }
    assert_eq!(found.count, expected.len() as u64);
    assert_eq!(found.pairs, expected);
}

#[test]
fn within_one_mesh() {
    let mut random = Random::new(11);
    let mut tally = Tally::default();
    for round in 0..400 {
        let (vertices, side) = ([5, 7, 12, 60][round % 4], [1.0, 2.0, 4.0, 9.0][round / 4 % 4]);
        let soup = Soup::random(&mut random, vertices, 24, side);
        compare_within(&soup, 1.0, DVec3::ZERO, &mut tally);
    }
    println!("pairs by shared corners, [apart, intersecting]: {tally:?}");
    // Every branch was taken both ways (equal triangles always intersect).
    assert!(tally[..3].iter().flatten().all(|&n| n > 200) && tally[3][1] > 200);
}

#[test]
fn scale_and_place_do_not_matter() {
    let mut random = Random::new(12);
    for exponent in [-1070, -66, -30, 900] {
        // In two factors, since the inverse of the smallest is out of range.
        let scale = 2f64.powi(exponent / 2) * 2f64.powi(exponent - exponent / 2);
        for _ in 0..20 {
            let soup = Soup::random(&mut random, 9, 20, 3.0);
            // A shift that the grid's spacing divides, so that the sum is exact.
            let shift = if exponent == -30 { DVec3::new(20.0, -3.0, 1.0) } else { DVec3::ZERO };
            compare_within(&soup, scale, shift, &mut Tally::default());
        }
    }
}

#[test]
fn between_two_meshes() {
    let mut random = Random::new(13);
    let mut hits = 0;
    for round in 0..200 {
        let side = [1.0, 2.0, 4.0, 9.0][round % 4];
        let (s, t) = (Soup::random(&mut random, 10, 15, side), Soup::random(&mut random, 10, 15, side));
        let found = intersections(&s.mesh(1.0, DVec3::ZERO), Some(&t.mesh(1.0, DVec3::ZERO)), usize::MAX).unwrap();
        let mut expected = Vec::new();
        for i in 0..s.triangles.len() {
            for j in 0..t.triangles.len() {
                if twin::meet(&s.corners(i), &t.corners(j)) {
                    expected.push([i as u32, j as u32]);
                }
            }
        }
        assert_eq!(found.pairs, expected);
        assert_eq!(found.count, expected.len() as u64);
        hits += expected.len();
    }
    assert!(hits > 1000 && hits < 200 * 225 - 1000, "{hits}");
}

#[test]
fn threads_and_limit_change_nothing() {
    let soup = Soup::random(&mut Random::new(14), 300, 1000, 40.0);
    let mesh = soup.mesh(1.0, DVec3::ZERO);
    let all = intersections(&mesh, None, usize::MAX).unwrap();
    assert!(all.count > 1000 && all.pairs.is_sorted());
    for threads in [1, 2, 5] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        assert_eq!(pool.install(|| intersections(&mesh, None, usize::MAX)).unwrap(), all);
    }
    for limit in [0, 1, 77] {
        let some = intersections(&mesh, None, limit).unwrap();
        assert_eq!(some.count, all.count);
        assert_eq!(some.pairs, all.pairs[..limit]);
    }
}
