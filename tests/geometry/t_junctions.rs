//! T-junctions: which vertices lie on edges that do not have them, and what closes them.

use bespoke::geometry::mesh::Topology;
use bespoke::geometry::t_junctions::{TJunction, find, touching_pairs};
use glam::DVec3;

use testing::Random;

const REACH: f64 = 1e-6;

/// A bent sheet of cells.
fn sheet(columns: u32, rows: u32) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let at = |k: u32| {
        let (x, y) = (f64::from(k % columns), f64::from(k / columns));
        0.1 * DVec3::new(x, y, 0.3 * (x + 0.5 * y).sin())
    };
    let mut triangles = Vec::new();
    for (j, i) in (0..rows - 1).flat_map(|j| (0..columns - 1).map(move |i| (j, i))) {
        let (a, c) = (j * columns + i, (j + 1) * columns + i);
        triangles.extend([[a, a + 1, c], [a + 1, c + 1, c]]);
    }
    ((0..columns * rows).map(at).collect(), triangles)
}

/// Splits the first side of a triangle into `parts`, alone; the numbers of the new vertices.
fn split(positions: &mut Vec<DVec3>, triangles: &mut Vec<[u32; 3]>, t: usize, parts: u32) -> Vec<u32> {
    let [a, b, c] = triangles[t];
    let first = positions.len() as u32;
    let [from, to] = [a, b].map(|v| positions[v as usize]);
    positions.extend((1..parts).map(|k| from.lerp(to, f64::from(k) / f64::from(parts))));
    let on: Vec<u32> = (first..first + parts - 1).collect();
    triangles[t] = [a, on[0], c];
    for k in 0..on.len() {
        triangles.push([on[k], *on.get(k + 1).unwrap_or(&b), c]);
    }
    on
}

fn loops(positions: &[DVec3], triangles: &[[u32; 3]]) -> usize {
    Topology::new(positions.len(), triangles).loops.len()
}

fn closed(triangles: &[[u32; 3]], junctions: &[TJunction]) -> Vec<[u32; 3]> {
    triangles.iter().copied().chain(junctions.iter().flat_map(TJunction::caps)).collect()
}

#[test]
fn a_sheet_has_none_at_its_borders() {
    let (positions, triangles) = sheet(6, 5);
    assert!(find(&positions, &triangles, REACH).is_empty());
    // The triangles at its rim split from outside: new border, no junction.
    let (mut positions, mut triangles) = sheet(6, 5);
    split(&mut positions, &mut triangles, 0, 3);
    assert!(find(&positions, &triangles, REACH).is_empty());
}

#[test]
fn one_split_edge_is_found_with_what_touches_there() {
    for (parts, rounded) in [(2, false), (2, true), (4, false), (4, true)] {
        let (mut positions, mut triangles) = sheet(6, 5);
        // Triangle 21, (a + 1, c + 1, c): its side from c + 1 to c is one of triangle 30.
        let [a, b, c] = triangles[21];
        triangles[21] = [b, c, a];
        let on = split(&mut positions, &mut triangles, 21, parts);
        if rounded {
            positions.iter_mut().for_each(|p| *p = p.as_vec3().as_dvec3());
        }
        let found = find(&positions, &triangles, REACH);
        let [junction] = &found[..] else { panic!("{found:?}") };
        let beyond = triangles.iter().position(|t| t.contains(&b) && t.contains(&c) && !t.contains(&a)).unwrap();
        assert_eq!((junction.triangle as usize, junction.edge), (beyond, [c, b]));
        assert_eq!(junction.between, on.iter().rev().copied().collect::<Vec<_>>());
        // The slit is a boundary of its own, and closed none.
        assert_eq!(loops(&positions, &triangles), 2);
        assert_eq!(loops(&positions, &closed(&triangles, &found)), 1);
        let mut wanted: Vec<[u32; 2]> = (0..triangles.len() as u32)
            .filter(|&t| triangles[t as usize].iter().any(|v| on.contains(v)))
            .map(|t| [t.min(junction.triangle), t.max(junction.triangle)])
            .collect();
        wanted.sort_unstable();
        assert_eq!(touching_pairs(&found, &triangles), wanted);
    }
}

#[test]
fn many_beside_each_other_are_all_found() {
    let mut random = Random::new(3);
    for _ in 0..20 {
        let (mut positions, mut triangles) = sheet(9, 8);
        let mut on = Vec::new();
        for _ in 0..30 {
            let t = (random.unit() * triangles.len() as f64) as usize;
            let [a, b, _] = triangles[t];
            let both = triangles.iter().filter(|s| s.contains(&a) && s.contains(&b)).count() == 2;
            if both {
                on.extend(split(&mut positions, &mut triangles, t, 2));
            }
        }
        let found = find(&positions, &triangles, REACH);
        let mut named: Vec<u32> = found.iter().flat_map(|junction| junction.between.iter().copied()).collect();
        named.sort_unstable();
        assert_eq!(named, on);
        assert_eq!(loops(&positions, &closed(&triangles, &found)), 1, "the sheet's own");
    }
}

#[test]
fn a_slit_with_a_width_stays() {
    let (mut positions, mut triangles) = sheet(6, 5);
    let [a, b, c] = triangles[21];
    triangles[21] = [b, c, a];
    let on = split(&mut positions, &mut triangles, 21, 2);
    positions[on[0] as usize] = positions[on[0] as usize].lerp(positions[a as usize], 1e-3);
    assert!(find(&positions, &triangles, REACH).is_empty());
}
