//! The elimination tree, gathered into supernodes: sets of columns that are eliminated together.
//!
//! Everything is counted in vertices, which stand for three columns each.

use super::ordering::Graph;

/// No parent, no sibling.
pub(super) const NONE: u32 = u32::MAX;

/// What a front costs, in nanoseconds of one processor. Where one front costs less than two, they become one.
fn cost(columns: usize, rows: usize) -> f64 {
    const FRONT: f64 = 400.0;
    const SCALAR: f64 = 4.0;
    const UPDATE: f64 = 1.5;
    const PRODUCT: f64 = 0.04;
    let (k, r) = (3.0 * columns as f64, 3.0 * rows as f64);
    FRONT + SCALAR * k * (k + r) + UPDATE * r * r / 2.0 + PRODUCT * products(columns, rows)
}

/// Multiplications with an addition in the factorisation of a front.
pub(super) fn products(columns: usize, rows: usize) -> f64 {
    let (k, r) = (3.0 * columns as f64, 3.0 * rows as f64);
    k * r * r / 2.0 + k * k * r / 2.0 + k * k * k / 6.0
}

/// Supernodes, children before their parents. The last one is the root of all: it has no columns.
pub(super) struct Supernodes {
    /// The vertex that is eliminated at each position.
    pub vertex_at: Vec<u32>,
    /// The position at which each vertex is eliminated.
    pub position: Vec<u32>,
    /// For each supernode its first position; one more.
    pub first: Vec<u32>,
    /// For each supernode how many rows it has below its columns.
    pub row_count: Vec<u32>,
    /// For each supernode where its children begin in `children`; one more.
    pub child_start: Vec<u32>,
    /// The children of all, ascending.
    pub children: Vec<u32>,
    /// For each supernode the products in the fronts at and below it.
    pub work: Vec<f64>,
    /// For each supernode whether parts of the tree below it are for several threads.
    pub forks: Vec<bool>,
}

/// Fewest products of a part of the tree that is worth a thread, and the largest share of all the products where that
/// is more: beyond so many parts the tree is not cut further.
const PART: f64 = 5e5;
const PART_SHARE: f64 = 1.0 / 128.0;

/// Columns that are eliminated together while supernodes are being merged, as a linked list of ranges.
struct Draft {
    columns: usize,
    rows: usize,
    parent: u32,
    /// The first range; the last one is its own.
    head: u32,
    first_child: u32,
    last_child: u32,
    sibling: u32,
    /// The range after this one in the list that it is in.
    next: u32,
    merged: bool,
}

impl Supernodes {
    /// The tree of `graph` eliminated in nearly this `order`: positions change only where the fill does not.
    pub(super) fn new(graph: &Graph, order: Vec<u32>) -> Self {
        let (order, parent) = postordered(graph, order);
        let position = inverse(&order);
        let counts = column_counts(graph, &order, &position, &parent);
        let (begins, mut drafts) = maximal_supernodes(&parent, &counts);
        for s in 0..drafts.len() {
            merge_children(&mut drafts, s);
        }
        arranged(&order, &begins, &drafts)
    }

    /// Number of supernodes.
    pub(super) fn len(&self) -> usize {
        self.row_count.len()
    }

    /// The children of supernode `s`, ascending.
    pub(super) fn children(&self, s: usize) -> &[u32] {
        &self.children[self.child_start[s] as usize..self.child_start[s + 1] as usize]
    }

    /// Whether the part of the tree at and below `s` is worth a thread.
    pub(super) fn is_large(&self, s: usize) -> bool {
        self.work[s] >= part_work(&self.work)
    }
}

fn part_work(work: &[f64]) -> f64 {
    PART.max(PART_SHARE * work.last().copied().unwrap_or(0.0))
}

fn inverse(order: &[u32]) -> Vec<u32> {
    let mut position = vec![0; order.len()];
    for (p, &v) in order.iter().enumerate() {
        position[v as usize] = p as u32;
    }
    position
}

/// The elimination tree, and the order changed so that each column comes right after the columns below it.
fn postordered(graph: &Graph, order: Vec<u32>) -> (Vec<u32>, Vec<u32>) {
    let n = graph.vertex_count();
    let position = inverse(&order);
    let mut parent = vec![NONE; n];
    // A shortcut from each column to the furthest ancestor so far.
    let mut ancestor = vec![NONE; n];
    for j in 0..n as u32 {
        for neighbour in graph.neighbours(order[j as usize]) {
            let mut i = position[neighbour.vertex as usize];
            while i < j {
                let next = std::mem::replace(&mut ancestor[i as usize], j);
                if next == NONE {
                    parent[i as usize] = j;
                    break;
                }
                i = next;
            }
        }
    }
    let mut first_child = vec![NONE; n + 1];
    let mut sibling = vec![NONE; n];
    for j in (0..n).rev() {
        let p = if parent[j] == NONE { n } else { parent[j] as usize };
        sibling[j] = first_child[p];
        first_child[p] = j as u32;
    }
    let mut renumbered = vec![NONE; n];
    let mut next_order = Vec::with_capacity(n);
    let mut at = first_child[n];
    let mut up = Vec::new();
    while at != NONE || !up.is_empty() {
        while at != NONE {
            up.push(at);
            at = first_child[at as usize];
        }
        if let Some(j) = up.pop() {
            renumbered[j as usize] = next_order.len() as u32;
            next_order.push(order[j as usize]);
            at = sibling[j as usize];
        }
    }
    let mut next_parent = vec![NONE; n];
    for j in 0..n {
        if parent[j] != NONE {
            next_parent[renumbered[j] as usize] = renumbered[parent[j] as usize];
        }
    }
    (next_order, next_parent)
}

/// How many vertices the factor has in each column, the diagonal included.
fn column_counts(graph: &Graph, order: &[u32], position: &[u32], parent: &[u32]) -> Vec<u32> {
    let n = order.len();
    let mut counts = vec![1u32; n];
    let mut seen = vec![NONE; n];
    for i in 0..n as u32 {
        seen[i as usize] = i;
        for neighbour in graph.neighbours(order[i as usize]) {
            let mut k = position[neighbour.vertex as usize];
            // All columns on the way up to i have a row i.
            while k < i && seen[k as usize] != i {
                seen[k as usize] = i;
                counts[k as usize] += 1;
                k = parent[k as usize];
            }
        }
    }
    counts
}

/// Neighbouring columns with the same rows. Returns where each supernode begins, one more, and the supernodes, the root
/// of all among them.
fn maximal_supernodes(parent: &[u32], counts: &[u32]) -> (Vec<u32>, Vec<Draft>) {
    let n = parent.len();
    let mut begins = Vec::new();
    let mut of = Vec::with_capacity(n);
    for j in 0..n {
        let same = j > 0 && parent[j - 1] == j as u32 && counts[j - 1] == counts[j] + 1;
        if !same {
            begins.push(j as u32);
        }
        of.push(begins.len() as u32 - 1);
    }
    let root = begins.len() as u32;
    begins.extend([n as u32; 2]);
    let mut drafts: Vec<Draft> = (0..=root)
        .map(|s| {
            let (begin, end) = (begins[s as usize] as usize, begins[s as usize + 1] as usize);
            let (rows, parent) = match end.checked_sub(1).filter(|_| s < root) {
                Some(last) if parent[last] != NONE => (counts[last] as usize - 1, of[parent[last] as usize]),
                Some(_) => (0, root),
                None => (0, NONE),
            };
            Draft {
                columns: end - begin,
                rows,
                parent,
                head: s,
                first_child: NONE,
                last_child: NONE,
                sibling: NONE,
                next: NONE,
                merged: false,
            }
        })
        .collect();
    for s in (0..root).rev() {
        let p = drafts[s as usize].parent as usize;
        drafts[s as usize].sibling = drafts[p].first_child;
        drafts[p].first_child = s;
        if drafts[p].last_child == NONE {
            drafts[p].last_child = s;
        }
    }
    (begins, drafts)
}

fn children_of(drafts: &[Draft], s: usize) -> Vec<u32> {
    let first = Some(drafts[s].first_child).filter(|&c| c != NONE);
    std::iter::successors(first, |&c| Some(drafts[c as usize].sibling).filter(|&c| c != NONE)).collect()
}

/// Merges those children into `s` with which it is cheaper, those with the most rows first.
fn merge_children(drafts: &mut [Draft], s: usize) {
    // The root of all has no front.
    if drafts[s].parent == NONE || drafts[s].first_child == NONE {
        return;
    }
    let mut children = children_of(drafts, s);
    children.sort_by_key(|&c| std::cmp::Reverse((drafts[c as usize].rows, c)));
    let (mut first, mut last) = (NONE, NONE);
    for c in children {
        let child = &drafts[c as usize];
        let (columns, rows) = (drafts[s].columns, drafts[s].rows);
        let apart = cost(columns, rows) + cost(child.columns, child.rows);
        let (mut head, mut tail) = (c, c);
        if cost(columns + child.columns, rows) < apart {
            let (together, ranges) = (columns + child.columns, child.head);
            (head, tail) = (child.first_child, child.last_child);
            drafts[s].columns = together;
            drafts[c as usize].next = drafts[s].head;
            drafts[c as usize].merged = true;
            drafts[s].head = ranges;
        }
        if head != NONE {
            if last == NONE {
                first = head;
            } else {
                drafts[last as usize].sibling = head;
            }
            last = tail;
            drafts[tail as usize].sibling = NONE;
        }
    }
    drafts[s].first_child = first;
    drafts[s].last_child = last;
}

/// The final numbering: children before parents, and the children of one parent as it suits those who share the work.
fn arranged(order: &[u32], begins: &[u32], drafts: &[Draft]) -> Supernodes {
    let count = drafts.len();
    let root = count - 1;
    let mut children = vec![Vec::new(); count];
    let mut work = vec![0.0; count];
    for s in 0..count {
        if drafts[s].merged {
            continue;
        }
        children[s] = children_of(drafts, s);
        work[s] =
            products(drafts[s].columns, drafts[s].rows) + children[s].iter().map(|&c| work[c as usize]).sum::<f64>();
    }
    let large = part_work(&work);
    let mut forks = vec![false; count];
    for s in 0..count {
        let (big, small): (Vec<u32>, Vec<u32>) = children[s].iter().partition(|&&c| work[c as usize] >= large);
        let rest: f64 = small.iter().map(|&c| work[c as usize]).sum();
        forks[s] = big.len() + usize::from(rest >= large) >= 2;
        // For several threads all the small ones come first, as one part; otherwise the large one comes first, for
        // whoever does it goes on here.
        children[s].sort_by(|&a, &b| work[a as usize].total_cmp(&work[b as usize]).then(a.cmp(&b)));
        if !forks[s] {
            children[s].reverse();
        }
    }

    let mut out = Supernodes {
        vertex_at: Vec::with_capacity(order.len()),
        position: Vec::new(),
        first: vec![0],
        row_count: Vec::new(),
        child_start: vec![0],
        children: Vec::new(),
        work: Vec::new(),
        forks: Vec::new(),
    };
    let mut number = vec![NONE; count];
    let mut path = vec![(root, 0)];
    while let Some((s, next)) = path.last_mut() {
        if let Some(&c) = children[*s].get(*next) {
            *next += 1;
            path.push((c as usize, 0));
            continue;
        }
        let s = *s;
        path.pop();
        number[s] = out.row_count.len() as u32;
        let mut range = if s == root { NONE } else { drafts[s].head };
        while range != NONE {
            let r = range as usize;
            out.vertex_at.extend_from_slice(&order[begins[r] as usize..begins[r + 1] as usize]);
            range = if r == s { NONE } else { drafts[r].next };
        }
        out.first.push(out.vertex_at.len() as u32);
        out.row_count.push(drafts[s].rows as u32);
        out.children.extend(children[s].iter().map(|&c| number[c as usize]));
        out.child_start.push(out.children.len() as u32);
        out.work.push(work[s]);
        out.forks.push(forks[s]);
    }
    out.position = inverse(&out.vertex_at);
    out
}
