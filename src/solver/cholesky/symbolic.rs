//! Symbolic factorisation: the structure of the fronts, their layout in memory, and the tasks with their dependencies.
//!
//! All of it follows from the pattern. Each supernode has a panel in the factor and a region in the work space, nested
//! as the tree is: the regions of its children from one end, its own contribution block at the other end, over memory
//! that its children no longer need. Children in separate tasks have disjoint regions; those of one task reuse memory
//! like a stack.

use std::ops::Range;

use super::kernel::{contribution_len, padded};
use super::ordering::Graph;
use super::supernodes::Supernodes;
use crate::memory::bytes;

/// A node of the assembly tree: one supernode and its front. Counts and offsets are of scalars.
#[derive(Clone, Debug)]
pub(super) struct Node {
    /// Its first column.
    pub first: usize,
    /// Number of columns.
    pub columns: usize,
    /// Number of rows below the columns.
    pub rows: usize,
    /// Leading dimension of its panel.
    pub ld: usize,
    /// Where its panel begins in the factor.
    pub panel: usize,
    /// Its region of the work space.
    pub region: Range<usize>,
    /// Its contribution block in the factorisation, its vectors in the solve, at one end of the region.
    pub contribution: Range<usize>,
    /// Where its rows begin in the list of all rows.
    pub row_start: usize,
    /// Where its blocks begin in the list of all blocks.
    pub block_start: usize,
}

impl Node {
    /// Scalars in the panel.
    pub(super) fn panel_len(&self) -> usize {
        self.ld * self.columns
    }

    /// Vertices in its rows.
    pub(super) fn row_vertices(&self) -> usize {
        self.rows / 3
    }
}

/// Where an off-diagonal block of the matrix is scattered to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Block {
    /// Its block column in the matrix.
    pub column: u32,
    /// Its index among the blocks below the diagonal of that column.
    pub index: u32,
    /// Offset of its first scalar in the panel.
    pub target: u32,
    /// Whether it is scattered transposed.
    pub transposed: bool,
}

/// Part of the tree that one thread does: consecutive nodes, after the tasks that it depends on.
#[derive(Clone, Debug)]
pub(super) struct Task {
    /// The nodes, children first.
    pub nodes: Range<usize>,
    /// The first node of all the tasks that it depends on, or its own first node.
    pub first_node: usize,
    /// Tasks that must complete first; any worker may run them. Their nodes and their regions are consecutive.
    pub dependencies: Vec<usize>,
    /// The part of the work space that it and its dependencies use.
    pub region: Range<usize>,
}

/// A symbolic factorisation; the default is an empty one.
#[derive(Default)]
pub(super) struct Symbolic {
    pub nodes: Vec<Node>,
    /// For each node its children.
    pub child_start: Vec<u32>,
    pub children: Vec<u32>,
    /// The row structure of each node: vertices by position, ascending.
    pub rows: Vec<u32>,
    /// The same as indices into the front of the parent, in vertices: its columns, then its rows.
    pub relative_indices: Vec<u32>,
    pub blocks: Vec<Block>,
    /// Dependencies come before the tasks that wait for them; the last task is the root's.
    pub tasks: Vec<Task>,
    /// The vertex eliminated at each position.
    pub vertex_at: Vec<u32>,
    /// Scalars of the factor.
    pub values: usize,
    /// Scalars of the work space.
    pub work: usize,
}

impl Symbolic {
    /// The symbolic factorisation for `tree`. `None` where a panel is too large for its indices.
    pub(super) fn new(graph: &Graph, tree: Supernodes) -> Option<Self> {
        let count = tree.len();
        let mut nodes = Vec::with_capacity(count);
        let (mut panel, mut row_start) = (0usize, 0usize);
        for s in 0..count {
            let first = 3 * tree.first[s] as usize;
            let columns = 3 * tree.first[s + 1] as usize - first;
            let rows = 3 * tree.row_count[s] as usize;
            let ld = padded(columns + padded(rows));
            u32::try_from(ld.checked_mul(columns)?).ok()?;
            let empty = Range { start: 0, end: 0 };
            let node = Node {
                first,
                columns,
                rows,
                ld,
                panel,
                region: empty.clone(),
                contribution: empty,
                row_start,
                block_start: 0,
            };
            panel = panel.checked_add(node.panel_len())?;
            row_start += rows / 3;
            nodes.push(node);
        }
        let (rows, relative_indices, blocks) = structure(graph, &tree, &mut nodes);
        let (work, small_regions) = regions(&tree, &mut nodes);
        let tasks = tasks(&tree, &nodes, &small_regions);
        let Supernodes { vertex_at, child_start, children, .. } = tree;
        Some(Self {
            nodes,
            child_start,
            children,
            rows,
            relative_indices,
            blocks,
            tasks,
            vertex_at,
            values: panel,
            work,
        })
    }

    /// The children of node `s`.
    #[inline]
    pub(super) fn children(&self, s: usize) -> impl Iterator<Item = &Node> {
        let range = self.child_start[s] as usize..self.child_start[s + 1] as usize;
        self.children[range].iter().map(|&c| &self.nodes[c as usize])
    }

    /// The row structure of `node`: vertices by position.
    #[inline]
    pub(super) fn rows(&self, node: &Node) -> &[u32] {
        &self.rows[node.row_start..][..node.row_vertices()]
    }

    /// The relative indices of `node`: its rows in the front of its parent, for extend-add.
    #[inline]
    pub(super) fn relative_indices(&self, node: &Node) -> &[u32] {
        &self.relative_indices[node.row_start..][..node.row_vertices()]
    }

    /// The matrix's off-diagonal blocks in the panel of node `s`.
    #[inline]
    pub(super) fn blocks(&self, s: usize) -> &[Block] {
        let end = self.nodes.get(s + 1).map_or(self.blocks.len(), |next| next.block_start);
        &self.blocks[self.nodes[s].block_start..end]
    }

    /// Bytes held.
    pub(super) fn memory(&self) -> u64 {
        let indices = [&self.child_start, &self.children, &self.rows, &self.relative_indices, &self.vertex_at];
        bytes(&self.nodes) + bytes(&self.blocks) + bytes(&self.tasks) + indices.into_iter().map(bytes).sum::<u64>()
    }

    /// The part of the factor that a task and its dependencies fill.
    pub(super) fn panels(&self, task: &Task) -> Range<usize> {
        let last = &self.nodes[task.nodes.end - 1];
        self.nodes[task.first_node].panel..last.panel + last.panel_len()
    }
}

/// The row structure of each node, its relative indices, and where the matrix's blocks are scattered to.
fn structure(graph: &Graph, tree: &Supernodes, nodes: &mut [Node]) -> (Vec<u32>, Vec<u32>, Vec<Block>) {
    let n = tree.vertex_at.len();
    let total = nodes.last().map_or(0, |last| last.row_start);
    let mut rows: Vec<u32> = Vec::with_capacity(total);
    let mut relative_indices = vec![0; total];
    let mut blocks = Vec::new();
    // By position: the last supernode with it as a row, and its index in that front.
    let mut seen = vec![u32::MAX; n];
    let mut front_index = vec![0u32; n];
    for s in 0..nodes.len() {
        let (first, end) = (tree.first[s], tree.first[s + 1]);
        let start = rows.len();
        let mut add = |rows: &mut Vec<u32>, position: u32| {
            if position >= end && seen[position as usize] != s as u32 {
                seen[position as usize] = s as u32;
                rows.push(position);
            }
        };
        for &v in &tree.vertex_at[first as usize..end as usize] {
            for neighbour in graph.neighbours(v) {
                add(&mut rows, tree.position[neighbour.vertex as usize]);
            }
        }
        for &c in tree.children(s) {
            let child = &nodes[c as usize];
            for k in 0..child.row_vertices() {
                let position = rows[child.row_start + k];
                add(&mut rows, position);
            }
        }
        rows[start..].sort_unstable();
        for (k, &position) in rows[start..].iter().enumerate() {
            front_index[position as usize] = end - first + k as u32;
        }
        for position in first..end {
            front_index[position as usize] = position - first;
        }
        for &c in tree.children(s) {
            let child = &nodes[c as usize];
            for k in child.row_start..child.row_start + child.row_vertices() {
                relative_indices[k] = front_index[rows[k] as usize];
            }
        }
        nodes[s].block_start = blocks.len();
        for position in first..end {
            let v = tree.vertex_at[position as usize];
            for neighbour in graph.neighbours(v) {
                let other = tree.position[neighbour.vertex as usize];
                if other > position {
                    let (row, column) = (3 * front_index[other as usize] as usize, 3 * (position - first) as usize);
                    blocks.push(Block {
                        column: v.min(neighbour.vertex),
                        index: neighbour.index,
                        target: (row + column * nodes[s].ld) as u32,
                        transposed: v > neighbour.vertex,
                    });
                }
            }
        }
    }
    (rows, relative_indices, blocks)
}

/// Allocates the region and the contribution block of each node. Returns the size of the work space and, for each split
/// point, the region that its small children share.
fn regions(tree: &Supernodes, nodes: &mut [Node]) -> (usize, Vec<Range<usize>>) {
    let count = nodes.len();
    // The space of the contribution block also holds the vectors of the solve: two columns with the rows of the front.
    let contribution: Vec<usize> = nodes.iter().map(|node| contribution_len(node.rows).max(2 * node.ld)).collect();
    let mut size = vec![0usize; count];
    let mut offset = vec![0usize; count];
    let mut small_span = vec![0usize; count];
    for s in 0..count {
        let (mut held, mut span) = (0, 0);
        for &c in tree.children(s) {
            let c = c as usize;
            let own_task = tree.split_points[s] && tree.is_large(c);
            if own_task {
                // It runs in parallel to the children before, so their regions may not overlap.
                held = span;
            }
            offset[c] = held;
            span = span.max(held + size[c]);
            held += contribution[c];
            if tree.split_points[s] && !own_task {
                small_span[s] = span;
            }
        }
        size[s] = span.max(held + contribution[s]);
    }
    let mut flipped = vec![false; count];
    let mut small_regions = vec![0..0; count];
    let total = size.last().copied().unwrap_or(0);
    if let Some(root) = nodes.last_mut() {
        root.region = 0..total;
    }
    for s in (0..count).rev() {
        let (region, flip) = (nodes[s].region.clone(), flipped[s]);
        nodes[s].contribution =
            if flip { region.start..region.start + contribution[s] } else { region.end - contribution[s]..region.end };
        let absolute = |offset: usize, size: usize| {
            let start = if flip { region.end - offset - size } else { region.start + offset };
            start..start + size
        };
        small_regions[s] = absolute(0, small_span[s]);
        for &c in tree.children(s) {
            nodes[c as usize].region = absolute(offset[c as usize], size[c as usize]);
            flipped[c as usize] = !flip;
        }
    }
    (total, small_regions)
}

/// Cuts the tree into tasks at its split points.
fn tasks(tree: &Supernodes, nodes: &[Node], small_regions: &[Range<usize>]) -> Vec<Task> {
    const NO_TASK: usize = usize::MAX;
    let count = nodes.len();
    let mut tasks: Vec<Task> = Vec::new();
    let mut task_of = vec![NO_TASK; count];
    let mut first_node: Vec<usize> = Vec::with_capacity(count);
    for s in 0..count {
        let children = tree.children(s);
        first_node.push(children.first().map_or(s, |&c| first_node[c as usize]));
        if tree.split_points[s] {
            let small = children.iter().position(|&c| tree.is_large(c as usize)).unwrap_or(children.len());
            let mut dependencies = Vec::new();
            if small > 0 {
                dependencies.push(tasks.len());
                let nodes = first_node[s]..children[small - 1] as usize + 1;
                tasks.push(Task {
                    first_node: nodes.start,
                    nodes,
                    dependencies: Vec::new(),
                    region: small_regions[s].clone(),
                });
            }
            dependencies.extend(children[small..].iter().map(|&c| task_of[c as usize]));
            task_of[s] = tasks.len();
            tasks.push(Task {
                nodes: s..s + 1,
                first_node: first_node[s],
                dependencies,
                region: nodes[s].region.clone(),
            });
        } else if let Some(&c) = children.first().filter(|&&c| task_of[c as usize] != NO_TASK) {
            let task = task_of[c as usize];
            task_of[s] = task;
            tasks[task].nodes.end = s + 1;
            tasks[task].region = nodes[s].region.clone();
        } else if tree.is_large(s) || s + 1 == count {
            task_of[s] = tasks.len();
            let nodes_below = first_node[s]..s + 1;
            tasks.push(Task {
                first_node: first_node[s],
                nodes: nodes_below,
                dependencies: Vec::new(),
                region: nodes[s].region.clone(),
            });
        }
    }
    tasks
}
