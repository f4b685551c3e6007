//! Where everything of the factorisation lies in memory, and who does what after whom.
//!
//! All of it follows from the pattern. Each supernode has a panel in the factor and a region in the work space: the
//! regions of its children within it from one end, its own update matrix at the other end, over what its children no
//! longer need. Children that are done by several threads have regions of their own; the others follow one another.

use std::ops::Range;

use super::kernel::{padded, update_len};
use super::ordering::Graph;
use super::supernodes::Supernodes;
use crate::memory::bytes;

/// One supernode. Counts are of scalars.
#[derive(Clone, Debug)]
pub(super) struct Node {
    /// The first of its columns.
    pub first: usize,
    /// Its columns.
    pub columns: usize,
    /// Its rows below them.
    pub rows: usize,
    /// Scalars from one column of its panel to the next.
    pub ld: usize,
    /// Where its panel begins.
    pub panel: usize,
    /// Its region of the work space.
    pub region: Range<usize>,
    /// Its update matrix, or whatever it leaves to its parent, at one end of the region.
    pub update: Range<usize>,
    /// Where its rows are in the list of all rows.
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

/// Where a block of the matrix, off its diagonal, goes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Block {
    /// Its column in the matrix.
    pub column: u32,
    /// Which of the blocks below the diagonal it is there.
    pub place: u32,
    /// Its first scalar in the panel.
    pub target: u32,
    /// Whether rows become columns.
    pub transposed: bool,
}

/// A part of the tree for one thread: nodes with neighbouring numbers, after other parts.
#[derive(Clone, Debug)]
pub(super) struct Task {
    /// The nodes, children first.
    pub nodes: Range<usize>,
    /// The first node of all that come before.
    pub first_node: usize,
    /// What has to be done before, by whoever has time. Their nodes and their regions follow one another.
    pub before: Vec<usize>,
    /// The part of the work space that it takes, with those before.
    pub region: Range<usize>,
}

/// The plan of a factorisation; the default is none.
#[derive(Default)]
pub(super) struct Plan {
    pub nodes: Vec<Node>,
    /// For each node its children.
    pub child_start: Vec<u32>,
    pub children: Vec<u32>,
    /// The vertices' positions in the rows of each node, ascending.
    pub rows: Vec<u32>,
    /// The same as places in the front of the parent: its columns, then its rows.
    pub places: Vec<u32>,
    pub blocks: Vec<Block>,
    /// Those that others wait for first; the last one is done last.
    pub tasks: Vec<Task>,
    /// The vertex at each position.
    pub vertex_at: Vec<u32>,
    /// Scalars of the factor.
    pub values: usize,
    /// Scalars of the work space.
    pub work: usize,
}

impl Plan {
    /// The plan for `tree`. `None` where a panel is too large for its indices.
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
                update: empty,
                row_start,
                block_start: 0,
            };
            panel = panel.checked_add(node.panel_len())?;
            row_start += rows / 3;
            nodes.push(node);
        }
        let (rows, places, blocks) = incidence(graph, &tree, &mut nodes);
        let (work, groups) = regions(&tree, &mut nodes);
        let tasks = tasks(&tree, &nodes, &groups);
        let Supernodes { vertex_at, child_start, children, .. } = tree;
        Some(Self { nodes, child_start, children, rows, places, blocks, tasks, vertex_at, values: panel, work })
    }

    /// The children of node `s`.
    #[inline]
    pub(super) fn children(&self, s: usize) -> impl Iterator<Item = &Node> {
        let range = self.child_start[s] as usize..self.child_start[s + 1] as usize;
        self.children[range].iter().map(|&c| &self.nodes[c as usize])
    }

    /// The vertices' positions in the rows of `node`.
    #[inline]
    pub(super) fn rows(&self, node: &Node) -> &[u32] {
        &self.rows[node.row_start..][..node.row_vertices()]
    }

    /// Where the rows of `node` are in the front of its parent.
    #[inline]
    pub(super) fn places(&self, node: &Node) -> &[u32] {
        &self.places[node.row_start..][..node.row_vertices()]
    }

    /// The matrix's blocks in the panel of node `s`.
    #[inline]
    pub(super) fn blocks(&self, s: usize) -> &[Block] {
        let end = self.nodes.get(s + 1).map_or(self.blocks.len(), |next| next.block_start);
        &self.blocks[self.nodes[s].block_start..end]
    }

    /// Bytes that it holds.
    pub(super) fn memory(&self) -> u64 {
        let indices = [&self.child_start, &self.children, &self.rows, &self.places, &self.vertex_at];
        bytes(&self.nodes) + bytes(&self.blocks) + bytes(&self.tasks) + indices.into_iter().map(bytes).sum::<u64>()
    }

    /// The part of the factor that a task and those before it fill.
    pub(super) fn panels(&self, task: &Task) -> Range<usize> {
        let last = &self.nodes[task.nodes.end - 1];
        self.nodes[task.first_node].panel..last.panel + last.panel_len()
    }
}

/// The rows of each node, where they are in its parent's front, and where the matrix's blocks go.
fn incidence(graph: &Graph, tree: &Supernodes, nodes: &mut [Node]) -> (Vec<u32>, Vec<u32>, Vec<Block>) {
    let n = tree.vertex_at.len();
    let total = nodes.last().map_or(0, |last| last.row_start);
    let mut rows: Vec<u32> = Vec::with_capacity(total);
    let mut places = vec![0; total];
    let mut blocks = Vec::new();
    // By position: the supernode that has it as a row, and where.
    let mut seen = vec![u32::MAX; n];
    let mut place_of = vec![0u32; n];
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
            place_of[position as usize] = end - first + k as u32;
        }
        for position in first..end {
            place_of[position as usize] = position - first;
        }
        for &c in tree.children(s) {
            let child = &nodes[c as usize];
            for k in child.row_start..child.row_start + child.row_vertices() {
                places[k] = place_of[rows[k] as usize];
            }
        }
        nodes[s].block_start = blocks.len();
        for position in first..end {
            let v = tree.vertex_at[position as usize];
            for neighbour in graph.neighbours(v) {
                let other = tree.position[neighbour.vertex as usize];
                if other > position {
                    let (row, column) = (3 * place_of[other as usize] as usize, 3 * (position - first) as usize);
                    blocks.push(Block {
                        column: v.min(neighbour.vertex),
                        place: neighbour.place,
                        target: (row + column * nodes[s].ld) as u32,
                        transposed: v > neighbour.vertex,
                    });
                }
            }
        }
    }
    (rows, places, blocks)
}

/// Gives each node its region and its update matrix. Returns the size of all and, for each node that forks, the region
/// of its small children together.
fn regions(tree: &Supernodes, nodes: &mut [Node]) -> (usize, Vec<Range<usize>>) {
    let count = nodes.len();
    // The update matrix also holds what the substitution leaves: two columns with the rows of the front.
    let update: Vec<usize> = nodes.iter().map(|node| update_len(node.rows).max(2 * node.ld)).collect();
    let mut size = vec![0usize; count];
    let mut offset = vec![0usize; count];
    let mut group = vec![0usize; count];
    for s in 0..count {
        let (mut held, mut span) = (0, 0);
        for &c in tree.children(s) {
            let c = c as usize;
            let alone = tree.forks[s] && tree.is_large(c);
            if alone {
                // It may not lie over what those before still need.
                held = span;
            }
            offset[c] = held;
            span = span.max(held + size[c]);
            held += update[c];
            if tree.forks[s] && !alone {
                group[s] = span;
            }
        }
        size[s] = span.max(held + update[s]);
    }
    let mut flipped = vec![false; count];
    let mut groups = vec![0..0; count];
    let total = size.last().copied().unwrap_or(0);
    if let Some(root) = nodes.last_mut() {
        root.region = 0..total;
    }
    for s in (0..count).rev() {
        let (region, flip) = (nodes[s].region.clone(), flipped[s]);
        nodes[s].update =
            if flip { region.start..region.start + update[s] } else { region.end - update[s]..region.end };
        let place = |offset: usize, size: usize| {
            let start = if flip { region.end - offset - size } else { region.start + offset };
            start..start + size
        };
        groups[s] = place(0, group[s]);
        for &c in tree.children(s) {
            nodes[c as usize].region = place(offset[c as usize], size[c as usize]);
            flipped[c as usize] = !flip;
        }
    }
    (total, groups)
}

/// Cuts the tree into parts.
fn tasks(tree: &Supernodes, nodes: &[Node], groups: &[Range<usize>]) -> Vec<Task> {
    const NOBODY: usize = usize::MAX;
    let count = nodes.len();
    let mut tasks: Vec<Task> = Vec::new();
    let mut task_of = vec![NOBODY; count];
    let mut first_node: Vec<usize> = Vec::with_capacity(count);
    for s in 0..count {
        let children = tree.children(s);
        first_node.push(children.first().map_or(s, |&c| first_node[c as usize]));
        if tree.forks[s] {
            let small = children.iter().position(|&c| tree.is_large(c as usize)).unwrap_or(children.len());
            let mut before = Vec::new();
            if small > 0 {
                before.push(tasks.len());
                let nodes = first_node[s]..children[small - 1] as usize + 1;
                tasks.push(Task { first_node: nodes.start, nodes, before: Vec::new(), region: groups[s].clone() });
            }
            before.extend(children[small..].iter().map(|&c| task_of[c as usize]));
            task_of[s] = tasks.len();
            tasks.push(Task { nodes: s..s + 1, first_node: first_node[s], before, region: nodes[s].region.clone() });
        } else if let Some(&c) = children.first().filter(|&&c| task_of[c as usize] != NOBODY) {
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
                before: Vec::new(),
                region: nodes[s].region.clone(),
            });
        }
    }
    tasks
}
