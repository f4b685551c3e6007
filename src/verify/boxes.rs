//! A tree of axis-aligned boxes: the broad phase of the exact test. Overlap compares coordinates, so nothing is rounded.

use glam::DVec3;

/// A closed box.
#[derive(Clone, Copy)]
pub struct Aabb {
    low: DVec3,
    high: DVec3,
}

impl Aabb {
    /// The smallest box around a triangle.
    pub fn around([a, b, c]: [DVec3; 3]) -> Self {
        Self { low: a.min(b).min(c), high: a.max(b).max(c) }
    }

    #[inline]
    fn overlaps(&self, other: &Aabb) -> bool {
        self.low.cmple(other.high).all() && other.low.cmple(self.high).all()
    }
}

/// Boxes in a leaf.
const LEAF_SIZE: usize = 4;

struct Node {
    bounds: Aabb,
    /// First item of a leaf, or the right child (the left one follows its parent).
    first: u32,
    /// Items of a leaf, 0 for an inner node.
    count: u32,
}

/// Boxes, halved at the median of their centres along the longest side.
pub struct Tree {
    nodes: Vec<Node>,
    /// Indices and boxes of the items, leaf after leaf.
    items: Vec<(u32, Aabb)>,
}

impl Tree {
    /// The tree of `boxes`; an item is known by its index there.
    pub fn new(boxes: &[Aabb]) -> Self {
        let mut tree = Self { nodes: Vec::new(), items: (0..).zip(boxes.iter().copied()).collect() };
        if !boxes.is_empty() {
            tree.nodes.reserve(boxes.len());
            tree.build(0, boxes.len());
        }
        tree
    }

    fn build(&mut self, begin: usize, end: usize) {
        let items = &mut self.items[begin..end];
        let mut bounds = items[0].1;
        for (_, b) in &items[1..] {
            bounds = Aabb { low: bounds.low.min(b.low), high: bounds.high.max(b.high) };
        }
        let node = self.nodes.len();
        if items.len() <= LEAF_SIZE {
            self.nodes.push(Node { bounds, first: begin as u32, count: items.len() as u32 });
            return;
        }
        let axis = (bounds.high - bounds.low).max_position();
        let half = items.len() / 2;
        let centre = |item: &(u32, Aabb)| item.1.low[axis] + item.1.high[axis];
        items.select_nth_unstable_by(half, |p, q| centre(p).total_cmp(&centre(q)).then(p.0.cmp(&q.0)));
        self.nodes.push(Node { bounds, first: 0, count: 0 });
        self.build(begin, begin + half);
        self.nodes[node].first = self.nodes.len() as u32;
        self.build(begin + half, end);
    }

    /// Calls `visit` with each item whose box has a point in common with `query`.
    pub fn for_each_overlap(&self, query: &Aabb, mut visit: impl FnMut(u32)) {
        // Depth is at most 32 (halving fewer than 2^32 items), and each level leaves one node on the stack.
        let mut stack = [0u32; 64];
        let mut depth = usize::from(!self.nodes.is_empty());
        while depth > 0 {
            depth -= 1;
            let index = stack[depth];
            let node = &self.nodes[index as usize];
            if !node.bounds.overlaps(query) {
                continue;
            }
            if node.count == 0 {
                stack[depth] = node.first;
                stack[depth + 1] = index + 1;
                depth += 2;
            } else {
                let first = node.first as usize;
                for (item, bounds) in &self.items[first..first + node.count as usize] {
                    if bounds.overlaps(query) {
                        visit(*item);
                    }
                }
            }
        }
    }
}
