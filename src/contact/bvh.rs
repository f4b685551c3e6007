//! A bounding volume hierarchy over boxes: built once, refitted as the boxes move, traversed against another tree
//! or against itself.

use glam::DVec3;

use crate::memory::bytes;

/// Boxes in a leaf.
const LEAF_SIZE: usize = 4;

/// An axis-aligned box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// Smallest coordinates.
    pub min: DVec3,
    /// Largest coordinates.
    pub max: DVec3,
}

impl Aabb {
    /// The box around nothing.
    pub const EMPTY: Self = Self { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };

    /// The box around two points.
    #[inline]
    pub fn around(a: DVec3, b: DVec3) -> Self {
        Self { min: a.min(b), max: a.max(b) }
    }

    /// The box around two boxes.
    #[inline]
    pub fn union(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// The box with `margin` added on all sides.
    #[inline]
    pub fn inflated(self, margin: f64) -> Self {
        Self { min: self.min - DVec3::splat(margin), max: self.max + DVec3::splat(margin) }
    }

    /// True if the boxes share a point.
    #[inline]
    pub fn overlaps(&self, other: &Self) -> bool {
        self.min.x <= other.max.x
            && other.min.x <= self.max.x
            && self.min.y <= other.max.y
            && other.min.y <= self.max.y
            && self.min.z <= other.max.z
            && other.min.z <= self.max.z
    }
}

/// A node: its box, and either its children (the next node and `right`) or the items of a leaf.
#[derive(Clone, Copy, Debug)]
struct Node {
    bounds: Aabb,
    /// Index of the right child, or of the first item of a leaf in `Bvh::items`.
    link: u32,
    /// Number of items of a leaf, 0 for an inner node.
    count: u32,
}

/// Two nodes whose items may overlap: one of each tree, or two of one tree, where equal nodes stand for the pairs
/// within.
pub type NodePair = [u32; 2];

/// The tree. Nodes are in depth-first order, parents before children.
#[derive(Clone, Debug, Default)]
pub struct Bvh {
    nodes: Vec<Node>,
    /// Box numbers, leaf by leaf.
    items: Vec<u32>,
}

impl Bvh {
    /// Builds a tree over `boxes` by halving at the median of the centres along the longest axis. Ties are broken by
    /// number, so equal input gives an equal tree.
    pub fn new(boxes: &[Aabb]) -> Self {
        let mut tree = Self { nodes: Vec::new(), items: (0..boxes.len() as u32).collect() };
        if !boxes.is_empty() {
            let centres: Vec<DVec3> = boxes.iter().map(|b| 0.5 * (b.min + b.max)).collect();
            tree.split(&centres, 0, boxes.len());
            tree.refit(boxes);
        }
        tree
    }

    /// Adds the subtree over `items[start..end]`, which is not empty. Halving bounds the depth of the recursion.
    fn split(&mut self, centres: &[DVec3], start: usize, end: usize) {
        let node = self.nodes.len();
        let leaf = end - start <= LEAF_SIZE;
        let count = if leaf { (end - start) as u32 } else { 0 };
        self.nodes.push(Node { bounds: Aabb::EMPTY, link: start as u32, count });
        if leaf {
            return;
        }
        let extent = self.items[start..end]
            .iter()
            .map(|&i| centres[i as usize])
            .fold(Aabb::EMPTY, |b, c| b.union(Aabb { min: c, max: c }));
        let axis = (extent.max - extent.min).max_position();
        let middle = (end - start) / 2;
        self.items[start..end].select_nth_unstable_by(middle, |&i, &j| {
            centres[i as usize][axis].total_cmp(&centres[j as usize][axis]).then(i.cmp(&j))
        });
        self.split(centres, start, start + middle);
        self.nodes[node].link = self.nodes.len() as u32;
        self.split(centres, start + middle, end);
    }

    /// Bytes that it holds.
    pub fn memory(&self) -> u64 {
        bytes(&self.nodes) + bytes(&self.items)
    }

    /// Follows the boxes, which are as many as when the tree was built.
    pub fn refit(&mut self, boxes: &[Aabb]) {
        for i in (0..self.nodes.len()).rev() {
            let Node { link, count, .. } = self.nodes[i];
            let link = link as usize;
            self.nodes[i].bounds = if count == 0 {
                self.nodes[i + 1].bounds.union(self.nodes[link].bounds)
            } else {
                self.items[link..link + count as usize]
                    .iter()
                    .fold(Aabb::EMPTY, |b, &item| b.union(boxes[item as usize]))
            };
        }
    }

    /// The pair of the roots, from which every traversal starts, or nothing if a tree is empty.
    pub fn roots(&self, other: &Bvh) -> Option<NodePair> {
        (!self.nodes.is_empty() && !other.nodes.is_empty()).then_some([0, 0])
    }

    /// Splits `pairs` in place, breadth first, until there are at least `wanted` or only leaves are left: pieces of
    /// work for several threads. `other` is `None` for the pairs within this tree.
    pub fn spread(&self, other: Option<&Bvh>, margin: f64, wanted: usize, pairs: &mut Vec<NodePair>) {
        let mut next = Vec::new();
        while pairs.len() < wanted {
            let mut leaves_only = true;
            next.clear();
            for &pair in pairs.iter() {
                if self.descend(other, margin, pair, &mut next) {
                    leaves_only = false;
                } else {
                    next.push(pair);
                }
            }
            std::mem::swap(pairs, &mut next);
            if leaves_only {
                return;
            }
        }
    }

    /// Calls `hit` with each two items below `start` whose nodes come within `margin` of each other: the first of
    /// this tree, the second of `other`, or both of this tree, each two once. `stack` is scratch.
    #[inline]
    pub fn traverse(
        &self,
        other: Option<&Bvh>,
        margin: f64,
        start: NodePair,
        stack: &mut Vec<NodePair>,
        mut hit: impl FnMut(u32, u32),
    ) {
        let right = other.unwrap_or(self);
        stack.clear();
        stack.push(start);
        while let Some(pair) = stack.pop() {
            if self.descend(other, margin, pair, stack) {
                continue;
            }
            let items = self.leaf(pair[0]);
            if other.is_none() && pair[0] == pair[1] {
                for (k, &a) in items.iter().enumerate() {
                    for &b in &items[k + 1..] {
                        hit(a, b);
                    }
                }
            } else {
                for &a in items {
                    for &b in right.leaf(pair[1]) {
                        hit(a, b);
                    }
                }
            }
        }
    }

    /// Replaces a pair of nodes by pairs of their children that overlap. False if both are leaves.
    #[inline]
    fn descend(&self, other: Option<&Bvh>, margin: f64, [a, b]: NodePair, out: &mut Vec<NodePair>) -> bool {
        let right = other.unwrap_or(self);
        let (node_a, node_b) = (&self.nodes[a as usize], &right.nodes[b as usize]);
        let mut offer = |i: u32, j: u32| {
            if self.nodes[i as usize].bounds.inflated(margin).overlaps(&right.nodes[j as usize].bounds) {
                out.push([i, j]);
            }
        };
        if other.is_none() && a == b {
            if node_a.count > 0 {
                return false;
            }
            let (l, r) = (a + 1, node_a.link);
            offer(l, l);
            offer(r, r);
            offer(l, r);
            return true;
        }
        // Halve the larger node: the boxes stay alike in size, and fewer pairs are visited.
        let size = |n: &Node| if n.count > 0 { -1.0 } else { (n.bounds.max - n.bounds.min).element_sum() };
        let (size_a, size_b) = (size(node_a), size(node_b));
        if size_a < 0.0 && size_b < 0.0 {
            return false;
        }
        if size_a >= size_b {
            offer(a + 1, b);
            offer(node_a.link, b);
        } else {
            offer(a, b + 1);
            offer(a, node_b.link);
        }
        true
    }

    #[inline]
    fn leaf(&self, node: u32) -> &[u32] {
        let Node { link, count, .. } = self.nodes[node as usize];
        &self.items[link as usize..(link + count) as usize]
    }
}
