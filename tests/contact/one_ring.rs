use std::collections::BTreeSet;

use bespoke::contact::Surface;
use bespoke::contact::one_ring::OneRingPairs;

use crate::scene::{grid, soup, sphere};
use testing::Random;

/// One form for two edges, whichever comes first.
fn ordered([a, b, c, d]: [u32; 4]) -> [u32; 4] {
    if [a, b] < [c, d] { [a, b, c, d] } else { [c, d, a, b] }
}

/// By brute force, the pairs of primitives owned by triangles that are listed as neighbours.
fn brute(surface: &Surface, list: &OneRingPairs) -> (Vec<[u32; 4]>, Vec<[u32; 4]>) {
    let (mut point_triangle, mut edge_edge) = (Vec::new(), Vec::new());
    for s in 0..surface.triangles.len() {
        for t in 0..surface.triangles.len() {
            let (p, q) = (surface.triangles[s], surface.triangles[t]);
            if s == t || !list.has(p, q) {
                continue;
            }
            for (k, v) in p.iter().enumerate() {
                if surface.ownership(s as u32).corner(k) && surface.ownership(t as u32).face() && !q.contains(v) {
                    point_triangle.push([*v, q[0], q[1], q[2]]);
                }
            }
            for [i, j] in surface.owned_sides(s as u32).filter(|_| s < t) {
                for [k, l] in surface.owned_sides(t as u32) {
                    if ![k, l].contains(&i) && ![k, l].contains(&j) {
                        edge_edge.push(ordered([i, j, k, l]));
                    }
                }
            }
        }
    }
    point_triangle.sort_unstable();
    edge_edge.sort_unstable();
    (point_triangle, edge_edge)
}

fn check(surface: &Surface) -> usize {
    let list = OneRingPairs::new(surface);
    let mut point_triangle = list.point_triangle.clone();
    let mut edge_edge: Vec<_> = list.edge_edge.iter().copied().map(ordered).collect();
    point_triangle.sort_unstable();
    edge_edge.sort_unstable();
    assert_eq!(brute(surface, &list), (point_triangle, edge_edge.clone()));
    assert_eq!(edge_edge.iter().collect::<BTreeSet<_>>().len(), edge_edge.len());
    list.point_triangle.len() + list.edge_edge.len()
}

#[test]
fn every_pair_of_neighbours_is_listed_once() {
    let (positions, triangles) = grid(6);
    let surface = Surface::new(positions.len(), triangles);
    assert!(check(&surface) > 200);
    let list = OneRingPairs::new(&surface);
    for p in &surface.triangles {
        for q in &surface.triangles {
            assert_eq!(list.has(*p, *q), p.iter().any(|v| q.contains(v)));
        }
    }
    let mut random = Random::new(3);
    for _ in 0..20 {
        check(&soup(40, 60, &mut random));
    }
    assert_eq!(check(&Surface::new(0, vec![])), 0);
}

/// At a vertex of thousands of triangles all are neighbours: such pairs are left to the tree.
#[test]
fn a_vertex_of_large_valence_does_not_fill_the_list() {
    let (positions, triangles) = sphere(40);
    check(&Surface::new(positions.len(), triangles));
    let fan: Vec<[u32; 3]> = (1..5000).map(|k| [0, k, k + 1]).collect();
    let list = OneRingPairs::new(&Surface::new(5001, fan));
    assert!(list.point_triangle.len() + list.edge_edge.len() < 50_000);
    assert!(list.has([0, 1, 2], [0, 2, 3]) && !list.has([0, 1, 2], [0, 3, 4]));
}
