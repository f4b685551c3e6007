//! The elimination tree (Liu 1990) and its supernodes, relaxed by amalgamation (Ashcraft and Grimes 1989).
//!
//! Everything is counted in vertices, which stand for three scalar columns each.

use super::ordering::Graph;

/// No parent, no sibling.
pub(super) const NONE: u32 = u32::MAX;

/// Modelled time of a front, in nanoseconds on one core. Two fronts are amalgamated where one costs less than both:
/// that weighs the explicit zeros against the overhead of a front.
fn front_cost(columns: usize, rows: usize) -> f64 {
    const FRONT: f64 = 400.0;
    const SCALAR: f64 = 4.0;
    const CONTRIBUTION: f64 = 1.5;
    const MULTIPLY_ADD: f64 = 0.04;
    let (k, r) = (3.0 * columns as f64, 3.0 * rows as f64);
    FRONT + SCALAR * k * (k + r) + CONTRIBUTION * r * r / 2.0 + MULTIPLY_ADD * multiply_adds(columns, rows)
}

/// Multiply-adds in the factorisation of a front.
pub(super) fn multiply_adds(columns: usize, rows: usize) -> f64 {
    let (k, r) = (3.0 * columns as f64, 3.0 * rows as f64);
    k * r * r / 2.0 + k * k * r / 2.0 + k * k * k / 6.0
}

/// The supernodal elimination tree in postorder. The last supernode is a virtual root without columns, the parent of
/// all roots.
pub(super) struct Supernodes {
    /// The vertex that is eliminated at each position.
    pub vertex_at: Vec<u32>,
    /// The position at which each vertex is eliminated.
    pub position: Vec<u32>,
    /// For each supernode its first position; one entry more than supernodes.
    pub first: Vec<u32>,
    /// For each supernode how many rows it has below its columns.
    pub row_count: Vec<u32>,
    /// For each supernode where its children begin in `children`; one entry more than supernodes.
    pub child_start: Vec<u32>,
    /// The children of all, ascending.
    pub children: Vec<u32>,
    /// For each supernode the multiply-adds in the fronts of its subtree, its own included.
    pub work: Vec<f64>,
    /// For each supernode whether it is a parallel split point: its children's subtrees become separate tasks.
    pub split_points: Vec<bool>,
}

/// Multiply-adds below which a subtree is not worth a task of its own.
const MIN_TASK_MULTIPLY_ADDS: f64 = 5e5;
/// The same as a share of all multiply-adds, where that is more: it bounds the number of tasks.
const MIN_TASK_SHARE: f64 = 1.0 / 128.0;

/// A supernode during amalgamation. Its columns are a linked list of ranges, each the columns of a maximal supernode.
struct Supernode {
    columns: usize,
    rows: usize,
    parent: u32,
    /// The first range of the list; the last one is its own.
    head: u32,
    first_child: u32,
    last_child: u32,
    sibling: u32,
    /// The range after this one in its list.
    next: u32,
    amalgamated: bool,
}

impl Supernodes {
    /// The supernodal elimination tree of `graph` for the elimination `order`, which is postordered: an equivalent
    /// reordering, with the same fill.
    pub(super) fn new(graph: &Graph, order: Vec<u32>) -> Self {
        let (order, parent) = postordered_columns(graph, order);
        let position = inverse(&order);
        let counts = column_counts(graph, &order, &position, &parent);
        let (begins, mut supernodes) = maximal_supernodes(&parent, &counts);
        for s in 0..supernodes.len() {
            amalgamate_children(&mut supernodes, s);
        }
        postordered_supernodes(&order, &begins, &supernodes)
    }

    /// Number of supernodes.
    pub(super) fn len(&self) -> usize {
        self.row_count.len()
    }

    /// The children of supernode `s`, ascending.
    pub(super) fn children(&self, s: usize) -> &[u32] {
        &self.children[self.child_start[s] as usize..self.child_start[s + 1] as usize]
    }

    /// Whether the subtree of `s` is worth a task of its own.
    pub(super) fn is_large(&self, s: usize) -> bool {
        self.work[s] >= min_task_work(&self.work)
    }
}

fn min_task_work(work: &[f64]) -> f64 {
    MIN_TASK_MULTIPLY_ADDS.max(MIN_TASK_SHARE * work.last().copied().unwrap_or(0.0))
}

fn inverse(order: &[u32]) -> Vec<u32> {
    let mut position = vec![0; order.len()];
    for (p, &v) in order.iter().enumerate() {
        position[v as usize] = p as u32;
    }
    position
}

/// The order in a postorder of its elimination tree, and the tree: the parent of each column (Liu 1990).
fn postordered_columns(graph: &Graph, order: Vec<u32>) -> (Vec<u32>, Vec<u32>) {
    let n = graph.vertex_count();
    let position = inverse(&order);
    let mut parent = vec![NONE; n];
    // Path compression: a shortcut from each column to its furthest known ancestor.
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
    let mut stack = Vec::new();
    while at != NONE || !stack.is_empty() {
        while at != NONE {
            stack.push(at);
            at = first_child[at as usize];
        }
        if let Some(j) = stack.pop() {
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

/// Column counts: how many vertices the factor has in each column, the diagonal included. Walks the row subtrees of the
/// elimination tree, one step for each entry of the factor.
fn column_counts(graph: &Graph, order: &[u32], position: &[u32], parent: &[u32]) -> Vec<u32> {
    let n = order.len();
    let mut counts = vec![1u32; n];
    let mut seen = vec![NONE; n];
    for i in 0..n as u32 {
        seen[i as usize] = i;
        for neighbour in graph.neighbours(order[i as usize]) {
            let mut k = position[neighbour.vertex as usize];
            // The row subtree of i: all columns on the path up to i have an entry in row i.
            while k < i && seen[k as usize] != i {
                seen[k as usize] = i;
                counts[k as usize] += 1;
                k = parent[k as usize];
            }
        }
    }
    counts
}

/// Maximal supernodes: runs of consecutive columns, each the parent of the one before, with the same structure below.
/// Returns where each begins, with a final entry, and the supernodes with the virtual root.
fn maximal_supernodes(parent: &[u32], counts: &[u32]) -> (Vec<u32>, Vec<Supernode>) {
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
    let mut supernodes: Vec<Supernode> = (0..=root)
        .map(|s| {
            let (begin, end) = (begins[s as usize] as usize, begins[s as usize + 1] as usize);
            let (rows, parent) = match end.checked_sub(1).filter(|_| s < root) {
                Some(last) if parent[last] != NONE => (counts[last] as usize - 1, of[parent[last] as usize]),
                Some(_) => (0, root),
                None => (0, NONE),
            };
            Supernode {
                columns: end - begin,
                rows,
                parent,
                head: s,
                first_child: NONE,
                last_child: NONE,
                sibling: NONE,
                next: NONE,
                amalgamated: false,
            }
        })
        .collect();
    for s in (0..root).rev() {
        let p = supernodes[s as usize].parent as usize;
        supernodes[s as usize].sibling = supernodes[p].first_child;
        supernodes[p].first_child = s;
        if supernodes[p].last_child == NONE {
            supernodes[p].last_child = s;
        }
    }
    (begins, supernodes)
}

fn children_of(supernodes: &[Supernode], s: usize) -> Vec<u32> {
    let first = Some(supernodes[s].first_child).filter(|&c| c != NONE);
    std::iter::successors(first, |&c| Some(supernodes[c as usize].sibling).filter(|&c| c != NONE)).collect()
}

/// Relaxed amalgamation: merges into `s` each child with which one front is cheaper than two, those with the most rows
/// first.
fn amalgamate_children(supernodes: &mut [Supernode], s: usize) {
    // The virtual root has no front.
    if supernodes[s].parent == NONE || supernodes[s].first_child == NONE {
        return;
    }
    let mut children = children_of(supernodes, s);
    children.sort_by_key(|&c| std::cmp::Reverse((supernodes[c as usize].rows, c)));
    let (mut first, mut last) = (NONE, NONE);
    for c in children {
        let child = &supernodes[c as usize];
        let (columns, rows) = (supernodes[s].columns, supernodes[s].rows);
        let separate = front_cost(columns, rows) + front_cost(child.columns, child.rows);
        let (mut head, mut tail) = (c, c);
        if front_cost(columns + child.columns, rows) < separate {
            let (total, ranges) = (columns + child.columns, child.head);
            (head, tail) = (child.first_child, child.last_child);
            supernodes[s].columns = total;
            supernodes[c as usize].next = supernodes[s].head;
            supernodes[c as usize].amalgamated = true;
            supernodes[s].head = ranges;
        }
        if head != NONE {
            if last == NONE {
                first = head;
            } else {
                supernodes[last as usize].sibling = head;
            }
            last = tail;
            supernodes[tail as usize].sibling = NONE;
        }
    }
    supernodes[s].first_child = first;
    supernodes[s].last_child = last;
}

/// The final postorder of the amalgamated tree, with the children of each supernode in an order that suits the tasks,
/// and the parallel split points.
fn postordered_supernodes(order: &[u32], begins: &[u32], supernodes: &[Supernode]) -> Supernodes {
    let count = supernodes.len();
    let root = count - 1;
    let mut children = vec![Vec::new(); count];
    let mut work = vec![0.0; count];
    for s in 0..count {
        if supernodes[s].amalgamated {
            continue;
        }
        children[s] = children_of(supernodes, s);
        work[s] = multiply_adds(supernodes[s].columns, supernodes[s].rows)
            + children[s].iter().map(|&c| work[c as usize]).sum::<f64>();
    }
    let min_work = min_task_work(&work);
    let mut split_points = vec![false; count];
    for s in 0..count {
        let (large, small): (Vec<u32>, Vec<u32>) = children[s].iter().partition(|&&c| work[c as usize] >= min_work);
        let rest: f64 = small.iter().map(|&c| work[c as usize]).sum();
        split_points[s] = large.len() + usize::from(rest >= min_work) >= 2;
        // At a split point the small subtrees come first, together as one task; otherwise the largest subtree comes
        // first, since its task continues here.
        children[s].sort_by(|&a, &b| work[a as usize].total_cmp(&work[b as usize]).then(a.cmp(&b)));
        if !split_points[s] {
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
        split_points: Vec::new(),
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
        let mut range = if s == root { NONE } else { supernodes[s].head };
        while range != NONE {
            let r = range as usize;
            out.vertex_at.extend_from_slice(&order[begins[r] as usize..begins[r + 1] as usize]);
            range = if r == s { NONE } else { supernodes[r].next };
        }
        out.first.push(out.vertex_at.len() as u32);
        out.row_count.push(supernodes[s].rows as u32);
        out.children.extend(children[s].iter().map(|&c| number[c as usize]));
        out.child_start.push(out.children.len() as u32);
        out.work.push(work[s]);
        out.split_points.push(split_points[s]);
    }
    out.position = inverse(&out.vertex_at);
    out
}
