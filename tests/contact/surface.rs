use bespoke::contact::Surface;

use crate::scene::{grid, soup, sphere};
use testing::Random;

/// Every vertex of a triangle and every edge is owned once, by a triangle that has it.
fn check_ownership(surface: &Surface) {
    let mut vertex_owners = vec![0; surface.vertex_count];
    let mut edge_owners = vec![0; surface.edges.len()];
    for (i, t) in surface.triangles.iter().enumerate() {
        let owned = surface.ownership(i as u32);
        for k in 0..3 {
            let (a, b) = (t[k], t[(k + 1) % 3]);
            vertex_owners[a as usize] += usize::from(owned.corner(k));
            if owned.side(k) {
                edge_owners[surface.edges.binary_search(&[a.min(b), a.max(b)]).unwrap()] += 1;
            }
        }
        assert_eq!(owned.face(), t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
    }
    for (v, owners) in vertex_owners.into_iter().enumerate() {
        let used = surface.triangles.iter().any(|t| t.contains(&(v as u32)));
        assert_eq!(owners, usize::from(used), "vertex {v}");
    }
    assert!(edge_owners.iter().all(|&n| n == 1));
    assert!(surface.edges.is_sorted_by(|a, b| a < b));
    assert!(surface.edges.iter().all(|e| e[0] < e[1]));
    for t in &surface.triangles {
        for k in 0..3 {
            let (a, b) = (t[k], t[(k + 1) % 3]);
            assert!(a == b || surface.edges.contains(&[a.min(b), a.max(b)]));
        }
    }
}

#[test]
fn owners_are_unique() {
    let (p, t) = grid(7);
    let surface = Surface::new(p.len(), t);
    // Euler's formula for a disc.
    assert_eq!(surface.vertex_count + surface.triangles.len(), surface.edges.len() + 1);
    check_ownership(&surface);
    let (p, t) = sphere(12);
    let surface = Surface::new(p.len(), t);
    assert_eq!(surface.vertex_count + surface.triangles.len(), surface.edges.len() + 2);
    check_ownership(&surface);
}

#[test]
fn degenerate_repeated_and_unused_are_fine() {
    let mut random = Random::new(1);
    for _ in 0..50 {
        check_ownership(&soup(40, 60, &mut random));
    }
    let surface = Surface::new(5, vec![[1, 1, 1], [2, 3, 2]]);
    assert_eq!(surface.edges, [[2, 3]]);
    assert!(!surface.ownership(0).face() && !surface.ownership(1).face());
    check_ownership(&surface);
    check_ownership(&Surface::new(3, vec![]));
    check_ownership(&Surface::new(0, vec![]));
}
