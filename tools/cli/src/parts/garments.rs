//! Which parts are one garment: those of one node that touch or lie within each other.

use std::collections::{BTreeMap, HashMap};

use glam::DVec3;

/// What is looked at of a part.
#[derive(Clone, Copy, Debug)]
pub struct Piece<'a> {
    /// Its node.
    pub node: usize,
    /// Where its vertices are.
    pub positions: &'a [DVec3],
}

/// How much of the smaller of two boxes must lie in the other for the two to be one garment: a button and its jacket do,
/// a dress and the shoes below it do not.
const WITHIN: f64 = 0.5;

/// The pieces of each garment, ascending, garments by their first piece.
pub fn group(pieces: &[Piece]) -> Vec<Vec<usize>> {
    let mut label: Vec<usize> = (0..pieces.len()).collect();
    for b in 0..pieces.len() {
        for a in 0..b {
            if pieces[a].node == pieces[b].node && (touch(&pieces[a], &pieces[b]) || lie_within(&pieces[a], &pieces[b]))
            {
                let (from, to) = (label[b].max(label[a]), label[b].min(label[a]));
                label.iter_mut().filter(|l| **l == from).for_each(|l| *l = to);
            }
        }
    }
    let mut garments: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (piece, &l) in label.iter().enumerate() {
        garments.entry(l).or_default().push(piece);
    }
    garments.into_values().collect()
}

/// Whether two pieces have vertices in one place, as those of two materials along their seam.
fn touch(a: &Piece, b: &Piece) -> bool {
    let key = |p: &DVec3| p.to_array().map(|x| (x + 0.0).to_bits());
    let places: HashMap<[u64; 3], ()> = a.positions.iter().map(|p| (key(p), ())).collect();
    b.positions.iter().any(|p| places.contains_key(&key(p)))
}

/// Whether the smaller box lies mostly in the other.
fn lie_within(a: &Piece, b: &Piece) -> bool {
    let extent = |piece: &Piece| {
        let first = *piece.positions.first()?;
        Some(piece.positions.iter().fold([first; 2], |[low, high], &p| [low.min(p), high.max(p)]))
    };
    let (Some([a0, a1]), Some([b0, b1])) = (extent(a), extent(b)) else { return false };
    // A flat piece has a box without volume: a hair's breadth of the larger one is added to all sides.
    let breadth = 1e-3 * (a1 - a0).max_element().max((b1 - b0).max_element());
    let volume = |low: DVec3, high: DVec3| (high - low + breadth).max(DVec3::ZERO).element_product();
    let smaller = volume(a0, a1).min(volume(b0, b1));
    volume(a0.max(b0), a1.min(b1)) >= WITHIN * smaller
}
