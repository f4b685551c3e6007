//! Edges with one triangle, against counting them one by one.

use bespoke::geometry::border_edges::{BorderEdge, border_edges};

use testing::Random;

#[test]
fn those_that_are_counted_once() {
    let mut random = Random::new(8);
    for _ in 0..50 {
        // Few vertices, so that edges with one, two and more triangles occur, and corners that repeat.
        let triangles: Vec<[u32; 3]> = (0..12).map(|_| [0; 3].map(|_: u32| (9.0 * random.unit()) as u32)).collect();
        let side = |t: usize, k: usize| [triangles[t][k], triangles[t][(k + 1) % 3]];
        let sides: Vec<(usize, usize)> = (0..triangles.len()).flat_map(|t| [0, 1, 2].map(|k| (t, k))).collect();
        let is_same = |a: [u32; 2], b: [u32; 2]| a == b || a == [b[1], b[0]];
        let mut counted: Vec<BorderEdge> = Vec::new();
        for &(t, k) in &sides {
            let [a, b] = side(t, k);
            if a != b && sides.iter().filter(|&&(u, j)| is_same(side(u, j), [a, b])).count() == 1 {
                let opposite = triangles[t][(k + 2) % 3];
                counted.push(BorderEdge { ends: [a, b], opposite, triangle: t as u32, corner: k });
            }
        }
        assert!(!counted.is_empty());
        counted.sort_by_key(|edge| [edge.ends[0].min(edge.ends[1]), edge.ends[0].max(edge.ends[1])]);
        assert_eq!(border_edges(&triangles), counted);
    }
}
