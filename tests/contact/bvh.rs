use bespoke::contact::bvh::{Aabb, Bvh};
use glam::DVec3;

use crate::support::Random;

fn boxes(count: usize, size: f64, random: &mut Random) -> Vec<Aabb> {
    (0..count)
        .map(|_| {
            let p = random.vector();
            Aabb::around(p, p + size * random.vector())
        })
        .collect()
}

fn brute(a: &[Aabb], b: Option<&[Aabb]>, margin: f64) -> Vec<[u32; 2]> {
    let mut out = Vec::new();
    for (i, first) in a.iter().enumerate() {
        let from = if b.is_none() { i + 1 } else { 0 };
        for (j, second) in b.unwrap_or(a).iter().enumerate().skip(from) {
            if first.inflated(margin).overlaps(second) {
                out.push([i as u32, j as u32]);
            }
        }
    }
    out
}

/// The overlapping pairs by traversal, over `wanted` pieces, sorted.
fn found(trees: (&Bvh, Option<&Bvh>), a: &[Aabb], b: Option<&[Aabb]>, margin: f64, wanted: usize) -> Vec<[u32; 2]> {
    let (tree, other) = trees;
    let mut work: Vec<_> = tree.roots(other.unwrap_or(tree)).into_iter().collect();
    tree.spread(other, margin, wanted, &mut work);
    let (mut out, mut stack) = (Vec::new(), Vec::new());
    for start in work {
        tree.traverse(other, margin, start, &mut stack, |i, j| {
            if a[i as usize].inflated(margin).overlaps(&b.unwrap_or(a)[j as usize]) {
                out.push(if b.is_none() { [i.min(j), i.max(j)] } else { [i, j] });
            }
        });
    }
    out.sort_unstable();
    out
}

#[test]
fn traversal_meets_every_overlap_once() {
    let mut random = Random::new(1);
    for count in [0, 1, 3, 4, 5, 9, 40, 333] {
        for size in [0.0, 0.05, 0.3] {
            let mut a = boxes(count, size, &mut random);
            let mut b = boxes(count / 2 + 1, size, &mut random);
            let (mut tree_a, mut tree_b) = (Bvh::new(&a), Bvh::new(&b));
            for round in 0..3 {
                for margin in [0.0, 0.02] {
                    for wanted in [1, 16, 1000] {
                        let own = found((&tree_a, None), &a, None, margin, wanted);
                        assert_eq!(own, brute(&a, None, margin), "{count} {size} {round}");
                        let both = found((&tree_a, Some(&tree_b)), &a, Some(&b), margin, wanted);
                        assert_eq!(both, brute(&a, Some(&b), margin), "{count} {size} {round}");
                    }
                }
                // The trees stay, everything moves.
                a = boxes(a.len(), size, &mut random);
                b = boxes(b.len(), size, &mut random);
                tree_a.refit(&a);
                tree_b.refit(&b);
            }
        }
    }
}

#[test]
fn collapsed_boxes_build_a_shallow_tree() {
    // All centres equal: the median still halves.
    let same = vec![Aabb::around(DVec3::ONE, DVec3::ONE); 3000];
    let tree = Bvh::new(&same);
    let mut count = 0;
    tree.traverse(None, 0.0, [0, 0], &mut Vec::new(), |_, _| count += 1);
    assert_eq!(count, 3000 * 2999 / 2);
}

#[test]
fn box_overlap_is_closed() {
    let unit = Aabb::around(DVec3::ZERO, DVec3::ONE);
    let at = |x: f64| Aabb::around(DVec3::new(x, 0.5, 0.5), DVec3::new(x + 1.0, 0.5, 0.5));
    assert!(unit.overlaps(&at(1.0)) && !unit.overlaps(&at(1.0 + 1e-12)));
    assert!(unit.inflated(0.25).overlaps(&at(1.25)) && !unit.inflated(0.25).overlaps(&at(1.2501)));
    assert!(!Aabb::EMPTY.overlaps(&unit));
    assert_eq!(Aabb::EMPTY.union(unit), unit);
}
