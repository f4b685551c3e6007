//! The order in which garments of known places are worn.

use std::f64::consts::TAU;

use bespoke::control::Cancel;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::geometry::outfit::{OutfitOrder, WornPair, in_order, outfit_order};
use glam::DVec3;
use testing::Random;

/// A tube along z whose radius goes from one end to the other, open at both.
fn tube(radii: [f64; 2], [low, high]: [f64; 2], sides: u32) -> TriangleMesh {
    let rings = 24;
    let mut mesh = TriangleMesh::default();
    for r in 0..=rings {
        let along = f64::from(r) / f64::from(rings);
        let radius = radii[0] + (radii[1] - radii[0]) * along;
        for s in 0..sides {
            let angle = TAU * f64::from(s) / f64::from(sides);
            mesh.positions.push(DVec3::new(radius * angle.cos(), radius * angle.sin(), low + (high - low) * along));
        }
    }
    for r in 0..rings {
        for s in 0..sides {
            let at = |r: u32, s: u32| r * sides + s % sides;
            let [a, b, c, d] = [at(r, s), at(r, s + 1), at(r + 1, s + 1), at(r + 1, s)];
            mesh.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    mesh
}

fn moved(mut mesh: TriangleMesh, by: DVec3) -> TriangleMesh {
    mesh.positions.iter_mut().for_each(|p| *p += by);
    mesh
}

/// Vest, shirt tucked into trousers, jacket over both, shoes under the trousers' hem; from the innermost, but for the shoes.
fn outfit() -> Vec<TriangleMesh> {
    vec![
        tube([0.29, 0.29], [-0.1, 0.6], 21),
        tube([0.31, 0.31], [-0.2, 0.6], 24),
        tube([0.4, 0.33], [-1.0, 0.0], 30),
        tube([0.42, 0.36], [-0.4, 0.6], 27),
        tube([0.3, 0.31], [-1.1, -0.9], 20),
    ]
}

fn body() -> TriangleMesh {
    tube([0.27, 0.27], [-1.2, 0.8], 25)
}

fn order_of(garments: &[TriangleMesh], body: Option<&TriangleMesh>) -> OutfitOrder {
    outfit_order(&garments.iter().collect::<Vec<_>>(), body, &Cancel::new()).unwrap()
}

fn permutations(count: usize) -> Vec<Vec<usize>> {
    if count == 0 {
        return vec![Vec::new()];
    }
    let shorter = permutations(count - 1);
    let with = |p: &Vec<usize>, at: usize| [&p[..at], &[count - 1], &p[at..]].concat();
    shorter.iter().flat_map(|p| (0..count).map(move |at| with(p, at))).collect()
}

#[test]
fn permutations_of_an_outfit_are_dressed_from_the_inside_outwards() {
    let (outfit, body) = (outfit(), body());
    let beneath = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3], [4, 2]];
    for (k, permutation) in permutations(outfit.len()).into_iter().step_by(17).enumerate() {
        let garments: Vec<TriangleMesh> = permutation.iter().map(|&g| outfit[g].clone()).collect();
        let found = order_of(&garments, (k % 2 == 0).then_some(&body));
        let order: Vec<usize> = found.order.iter().map(|&g| permutation[g as usize]).collect();
        let place = |garment: usize| order.iter().position(|&g| g == garment).unwrap();
        assert_eq!(order.len(), outfit.len());
        for [inner, outer] in beneath {
            assert!(place(inner) < place(outer), "{order:?}: {inner} is beneath {outer}");
        }
        let mut pairs: Vec<[usize; 2]> =
            found.pairs.iter().map(|p| [p.inner, p.outer].map(|g| permutation[g as usize])).collect();
        pairs.sort_unstable();
        assert_eq!(pairs, beneath, "what meets");
        assert!(found.pairs.iter().all(|pair| pair.confidence > 0.5 && !pair.is_overruled), "{:?}", found.pairs);
    }
}

#[test]
fn garments_that_cut_through_each_other_are_ordered_by_the_greater_part() {
    let mut random = Random::new(3);
    let rough = |mut mesh: TriangleMesh, random: &mut Random| {
        mesh.positions.iter_mut().for_each(|p| *p += 0.015 * random.vector());
        mesh
    };
    for _ in 0..6 {
        let inner = rough(tube([0.3, 0.3], [-0.5, 0.5], 24), &mut random);
        let outer = rough(tube([0.32, 0.32], [-0.5, 0.5], 24), &mut random);
        let found = order_of(&[outer, inner], None);
        assert_eq!(found.order, [1, 0]);
        assert!(found.pairs[0].confidence > 0.2 && found.pairs[0].confidence < 0.999, "{:?}", found.pairs);
    }
}

#[test]
fn what_lies_on_a_garment_without_enclosing_it_is_over_it() {
    let (coat, body) = (tube([0.32, 0.32], [-0.5, 0.5], 32), body());
    let bag = moved(tube([0.1, 0.1], [-0.2, 0.2], 16), DVec3::new(0.43, 0.0, 0.0));
    for (garments, order) in [([bag.clone(), coat.clone()], [1, 0]), ([coat.clone(), bag.clone()], [0, 1])] {
        let found = order_of(&garments, Some(&body));
        assert_eq!(found.order, order);
        assert!(found.pairs[0].confidence > 0.0 && found.pairs[0].confidence <= 0.5, "{:?}", found.pairs);
        assert!(order_of(&garments, None).pairs.is_empty(), "without a body nothing tells");
    }
    // What does not meet stays in the order of the caller.
    let far = moved(coat.clone(), DVec3::new(5.0, 0.0, 0.0));
    let apart = order_of(&[far, coat], Some(&body));
    assert!(apart.order == [0, 1] && apart.pairs.is_empty(), "{apart:?}");
}

#[test]
fn a_circle_is_broken_where_it_is_weakest() {
    let pair = |inner, outer, confidence| WornPair { inner, outer, confidence, is_overruled: false };
    let found = in_order(4, vec![pair(0, 1, 0.9), pair(1, 2, 0.3), pair(2, 0, 0.8), pair(3, 0, 0.5)]);
    assert_eq!(found.order, [2, 3, 0, 1]);
    let overruled: Vec<[u32; 2]> =
        found.pairs.iter().filter(|pair| pair.is_overruled).map(|pair| [pair.inner, pair.outer]).collect();
    assert_eq!(overruled, [[1, 2]]);
    assert_eq!(in_order(3, Vec::new()).order, [0, 1, 2]);
}

/// Every order that follows the pairs that are not overruled is one; there is one, and the one found is the first of them.
#[test]
fn random_pairs_as_by_trying_all_orders() {
    let mut random = Random::new(11);
    for _ in 0..60 {
        let mut pairs = Vec::new();
        for inner in 0..5 {
            for outer in 0..5 {
                if inner != outer && random.unit() < 0.4 {
                    pairs.push(WornPair { inner, outer, confidence: random.unit(), is_overruled: false });
                }
            }
        }
        let found = in_order(5, pairs.clone());
        assert_eq!(found.pairs.len(), pairs.len());
        assert!(found.pairs.is_sorted_by(|a, b| a.confidence >= b.confidence));
        let follows = |order: &[u32], pairs: &[WornPair]| {
            let place = |g: u32| order.iter().position(|&k| k == g);
            pairs.iter().all(|pair| place(pair.inner) < place(pair.outer))
        };
        let all: Vec<Vec<u32>> =
            permutations(5).into_iter().map(|p| p.into_iter().map(|g| g as u32).collect()).collect();
        let mut kept: Vec<WornPair> = Vec::new();
        for pair in &found.pairs {
            kept.push(*pair);
            let is_possible = all.iter().any(|order| follows(order, &kept));
            assert_eq!(is_possible, !pair.is_overruled, "{pair:?}");
            if !is_possible {
                kept.pop();
            }
        }
        assert_eq!(all.into_iter().filter(|order| follows(order, &kept)).min(), Some(found.order));
    }
}

#[test]
fn nothing_is_in_order_and_a_stop_is_heard() {
    assert_eq!(order_of(&[], None), OutfitOrder::default());
    assert_eq!(order_of(&[TriangleMesh::default(), body()], Some(&body())).order, [0, 1]);
    let stop = Cancel::new();
    stop.request();
    let (a, b) = (body(), body());
    assert!(outfit_order(&[&a, &b], None, &stop).is_err());
}
