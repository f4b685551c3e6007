//! A bounding volume hierarchy over boxes: built once, refitted as the boxes move, traversed against another tree
//! or against itself.

use glam::{DVec3, Vec3A};

use crate::memory::bytes;

/// Boxes in a leaf.
const LEAF_SIZE: usize = 4;

/// An axis-aligned box. Its bounds are in single precision, rounded outwards: what it was made around is inside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// Smallest coordinates.
    pub min: Vec3A,
    /// Largest coordinates.
    pub max: Vec3A,
}

impl Aabb {
    /// The empty box.
    pub const EMPTY: Self = Self { min: Vec3A::INFINITY, max: Vec3A::NEG_INFINITY };

    /// The box around two points, with `margin` added on all sides; a negative one is taken off, which may turn the box
    /// inside out.
    #[inline]
    pub fn around(a: DVec3, b: DVec3, margin: f64) -> Self {
        // More than the error of rounding to nearest, also for subnormal numbers.
        let slack = |v: Vec3A| v.abs() * f32::EPSILON + Vec3A::splat(f32::MIN_POSITIVE);
        // Beyond single precision the nearest is infinite, and infinity minus infinity is not a number.
        let nearest = |v: DVec3| v.as_vec3a().clamp(Vec3A::MIN, Vec3A::MAX);
        let min = nearest(a.min(b) - DVec3::splat(margin));
        let max = nearest(a.max(b) + DVec3::splat(margin));
        Self { min: min - slack(min), max: max + slack(max) }
    }

    /// The box around two boxes.
    #[inline]
    pub fn union(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// True if the boxes share a point.
    #[inline]
    pub fn overlaps(&self, other: &Self) -> bool {
        (self.min.cmple(other.max) & other.min.cmple(self.max)).all()
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
    /// Their boxes, in the same order.
    boxes: Vec<Aabb>,
}

impl Bvh {
    /// Builds a tree over `boxes` by halving at the median of the centres along the longest axis. Ties are broken by
    /// number, so equal input gives an equal tree.
    pub fn new(boxes: &[Aabb]) -> Self {
        let mut tree = Self { nodes: Vec::new(), items: (0..boxes.len() as u32).collect(), boxes: Vec::new() };
        if !boxes.is_empty() {
            let centres: Vec<Vec3A> = boxes.iter().map(|b| 0.5 * (b.min + b.max)).collect();
            tree.split(&centres, 0, boxes.len());
            tree.boxes = vec![Aabb::EMPTY; boxes.len()];
            tree.refit(|item| boxes[item as usize]);
        }
        tree
    }

    /// Adds the subtree over `items[start..end]`, which is not empty. Halving bounds the depth of the recursion.
    fn split(&mut self, centres: &[Vec3A], start: usize, end: usize) {
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
        bytes(&self.nodes) + bytes(&self.items) + bytes(&self.boxes)
    }

    /// Refits the tree to new boxes, as many as when it was built.
    pub fn refit(&mut self, of: impl Fn(u32) -> Aabb) {
        for (bounds, &item) in self.boxes.iter_mut().zip(&self.items) {
            *bounds = of(item);
        }
        for i in (0..self.nodes.len()).rev() {
            let Node { link, count, .. } = self.nodes[i];
            let link = link as usize;
            self.nodes[i].bounds = if count == 0 {
                self.nodes[i + 1].bounds.union(self.nodes[link].bounds)
            } else {
                self.boxes[link..link + count as usize].iter().fold(Aabb::EMPTY, |all, &b| all.union(b))
            };
        }
    }

    /// The pair of the roots, from which every traversal starts, or nothing if a tree is empty.
    pub fn roots(&self, other: &Bvh) -> Option<NodePair> {
        (!self.nodes.is_empty() && !other.nodes.is_empty()).then_some([0, 0])
    }

    /// Splits `pairs` in place, breadth first, until there are at least `wanted` or only leaves are left: tasks
    /// for several threads. `other` is `None` for the pairs within this tree.
    pub fn subdivide(&self, other: Option<&Bvh>, wanted: usize, pairs: &mut Vec<NodePair>) {
        let mut next = Vec::new();
        while pairs.len() < wanted {
            let mut leaves_only = true;
            next.clear();
            for &pair in pairs.iter() {
                if self.descend(other, pair, &mut next) {
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

    /// Calls `hit` with each two items below `start` whose boxes overlap: the first of this tree, the second of
    /// `other`, or both of this tree, each two once. `stack` is scratch.
    #[inline]
    pub fn traverse(
        &self,
        other: Option<&Bvh>,
        start: NodePair,
        stack: &mut Vec<NodePair>,
        mut hit: impl FnMut(u32, u32),
    ) {
        let right = other.unwrap_or(self);
        stack.clear();
        stack.push(start);
        while let Some(pair) = stack.pop() {
            if self.descend(other, pair, stack) {
                continue;
            }
            let (own, theirs) = (self.leaf(pair[0]), right.leaf(pair[1]));
            let within = other.is_none() && pair[0] == pair[1];
            let bounds = right.nodes[pair[1] as usize].bounds;
            for (k, (a, a_box)) in own.enumerate() {
                if !a_box.overlaps(&bounds) {
                    continue;
                }
                for (b, b_box) in theirs.clone().skip(if within { k + 1 } else { 0 }) {
                    if a_box.overlaps(b_box) {
                        hit(a, b);
                    }
                }
            }
        }
    }

    /// Replaces a pair of nodes by pairs of their children that overlap. False if both are leaves.
    #[inline]
    fn descend(&self, other: Option<&Bvh>, [a, b]: NodePair, out: &mut Vec<NodePair>) -> bool {
        let right = other.unwrap_or(self);
        let (node_a, node_b) = (&self.nodes[a as usize], &right.nodes[b as usize]);
        let mut offer = |i: u32, j: u32| {
            if self.nodes[i as usize].bounds.overlaps(&right.nodes[j as usize].bounds) {
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
        if node_a.count > 0 && node_b.count > 0 {
            return false;
        }
        // Descend into the larger node: the boxes stay alike in size, and fewer pairs are visited.
        let size = |n: &Node| (n.bounds.max - n.bounds.min).element_sum();
        if node_b.count > 0 || (node_a.count == 0 && size(node_a) >= size(node_b)) {
            offer(a + 1, b);
            offer(node_a.link, b);
        } else {
            offer(a, b + 1);
            offer(a, node_b.link);
        }
        true
    }

    /// The items of a leaf with their boxes.
    #[inline]
    fn leaf(&self, node: u32) -> impl Iterator<Item = (u32, &Aabb)> + Clone {
        let Node { link, count, .. } = self.nodes[node as usize];
        let range = link as usize..(link + count) as usize;
        self.items[range.clone()].iter().copied().zip(&self.boxes[range])
    }
}
