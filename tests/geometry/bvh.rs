use bespoke::geometry::bvh::{Aabb, Bvh};
use glam::DVec3;

use testing::Random;

fn boxes(count: usize, size: f64, margin: f64, random: &mut Random) -> Vec<Aabb> {
    (0..count)
        .map(|_| {
            let p = random.vector();
            Aabb::around(p, p + size * random.vector(), margin)
        })
        .collect()
}

fn brute(a: &[Aabb], b: Option<&[Aabb]>) -> Vec<[u32; 2]> {
    let mut out = Vec::new();
    for (i, first) in a.iter().enumerate() {
        let from = if b.is_none() { i + 1 } else { 0 };
        for (j, second) in b.unwrap_or(a).iter().enumerate().skip(from) {
            if first.overlaps(second) {
                out.push([i as u32, j as u32]);
            }
        }
    }
    out
}

/// The overlapping pairs by traversal, over `wanted` tasks, sorted.
fn found(trees: (&Bvh, Option<&Bvh>), b: Option<&[Aabb]>, wanted: usize) -> Vec<[u32; 2]> {
    let (tree, other) = trees;
    let mut work: Vec<_> = tree.roots(other.unwrap_or(tree)).into_iter().collect();
    tree.subdivide(other, wanted, &mut work);
    let (mut out, mut stack) = (Vec::new(), Vec::new());
    for start in work {
        tree.traverse(other, start, &mut stack, |i, j| {
            out.push(if b.is_none() { [i.min(j), i.max(j)] } else { [i, j] });
        });
    }
    out.sort_unstable();
    out
}

#[test]
fn traversal_finds_every_overlap_once() {
    let mut random = Random::new(1);
    for count in [0, 1, 3, 4, 5, 9, 40, 333] {
        for (size, margin) in [(0.0, 0.02_f64), (0.05, 0.0), (0.05, -0.01), (0.3, 0.0)] {
            let mut a = boxes(count, size, margin.max(0.0), &mut random);
            let mut b = boxes(count / 2 + 1, size, margin, &mut random);
            let (mut tree_a, mut tree_b) = (Bvh::new(&a), Bvh::new(&b));
            for round in 0..3 {
                for wanted in [1, 16, 1000] {
                    let own = found((&tree_a, None), None, wanted);
                    assert_eq!(own, brute(&a, None), "{count} {size} {round}");
                    let both = found((&tree_a, Some(&tree_b)), Some(&b), wanted);
                    assert_eq!(both, brute(&a, Some(&b)), "{count} {size} {round}");
                }
                // The trees stay, the boxes move.
                a = boxes(a.len(), size, margin.max(0.0), &mut random);
                b = boxes(b.len(), size, margin, &mut random);
                tree_a.refit(|i| a[i as usize]);
                tree_b.refit(|i| b[i as usize]);
            }
        }
    }
}

#[test]
fn collapsed_boxes_build_a_shallow_tree() {
    // All centres equal: the median still halves.
    let same = vec![Aabb::around(DVec3::ONE, DVec3::ONE, 0.0); 3000];
    let tree = Bvh::new(&same);
    let mut count = 0;
    tree.traverse(None, [0, 0], &mut Vec::new(), |_, _| count += 1);
    assert_eq!(count, 3000 * 2999 / 2);
}

#[test]
fn boxes_are_rounded_outwards() {
    let mut random = Random::new(2);
    for k in 0..20_000 {
        let scale = 10f64.powi(k % 80 - 45);
        let (a, b) = (scale * random.vector(), scale * random.vector());
        let margin = if k % 3 == 0 { 0.0 } else { 0.1 * scale };
        let bounds = Aabb::around(a, b, margin);
        let (min, max) = (a.min(b) - DVec3::splat(margin), a.max(b) + DVec3::splat(margin));
        assert!(bounds.min.as_dvec3().cmple(min).all() && bounds.max.as_dvec3().cmpge(max).all(), "{a} {b}");
        let slack = 3e-7 * scale + 1e-37;
        assert!((min - bounds.min.as_dvec3()).max_element() < slack.min(f64::from(f32::MAX)), "{a} {b}");
    }
    let exact = Aabb::around(DVec3::splat(0.5), DVec3::splat(0.5), 0.0);
    assert!(exact.min.x < 0.5 && exact.max.x > 0.5);
}

#[test]
fn box_overlap() {
    let unit = Aabb::around(DVec3::ZERO, DVec3::ONE, 0.0);
    let at = |x: f64, margin: f64| Aabb::around(DVec3::new(x, 0.5, 0.5), DVec3::new(x + 1.0, 0.5, 0.5), margin);
    assert!(unit.overlaps(&at(1.0, 0.0)) && !unit.overlaps(&at(1.0 + 1e-6, 0.0)));
    assert!(unit.overlaps(&at(1.25, 0.25)) && !unit.overlaps(&at(1.2501, 0.25)));
    assert!(!Aabb::EMPTY.overlaps(&unit));
    assert_eq!(Aabb::EMPTY.union(unit), unit);
}
