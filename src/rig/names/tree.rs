//! The tree of a rig's joints, whatever was given as parents.

/// Parents without circles, and who is above whom.
#[derive(Default)]
pub struct Tree {
    /// The joint above each; none for a root, and where a parent is out of range or a circle was cut.
    pub parents: Vec<Option<u32>>,
    /// All joints, each after its parent.
    pub order: Vec<u32>,
    /// How many joints lie above each.
    pub depth: Vec<u32>,
    enter: Vec<u32>,
    leave: Vec<u32>,
}

impl Tree {
    /// The tree of `count` joints; what is missing in `parents` is a root.
    pub fn new(count: usize, parents: &[Option<u32>]) -> Self {
        let given = |joint: usize| parents.get(joint).copied().flatten().filter(|&parent| (parent as usize) < count);
        let mut tree = Self {
            parents: (0..count).map(given).collect(),
            order: Vec::with_capacity(count),
            depth: vec![0; count],
            enter: vec![0; count],
            leave: vec![0; count],
        };
        tree.cut_circles();
        let mut children = vec![Vec::new(); count];
        for joint in (0..count as u32).rev() {
            if let Some(parent) = tree.parents[joint as usize] {
                children[parent as usize].push(joint);
            }
        }
        let roots = (0..count as u32).rev().filter(|&joint| tree.parents[joint as usize].is_none());
        // Each joint is on the stack twice: where it is entered, and below its children where it is left.
        let mut stack: Vec<(u32, bool)> = roots.map(|joint| (joint, false)).collect();
        while let Some((joint, is_done)) = stack.pop() {
            let at = joint as usize;
            if is_done {
                tree.leave[at] = tree.order.len() as u32;
                continue;
            }
            tree.enter[at] = tree.order.len() as u32;
            tree.order.push(joint);
            tree.depth[at] = tree.parents[at].map_or(0, |parent| tree.depth[parent as usize] + 1);
            stack.push((joint, true));
            stack.extend(children[at].iter().map(|&child| (child, false)));
        }
        tree
    }

    fn cut_circles(&mut self) {
        // 0: not seen; otherwise the walk in which the joint was seen first.
        let mut seen = vec![0; self.parents.len()];
        for start in 0..self.parents.len() {
            let walk = start + 1;
            let mut at = start;
            while seen[at] == 0 {
                seen[at] = walk;
                let Some(parent) = self.parents[at] else { break };
                if seen[parent as usize] == walk {
                    self.parents[at] = None;
                    break;
                }
                at = parent as usize;
            }
        }
    }

    /// Whether `above` is an ancestor of `joint`.
    pub fn is_above(&self, above: u32, joint: u32) -> bool {
        above != joint
            && self.enter[above as usize] <= self.enter[joint as usize]
            && self.enter[joint as usize] < self.leave[above as usize]
    }

    /// Whether `above` is `joint` or an ancestor of it.
    pub fn holds(&self, above: u32, joint: u32) -> bool {
        above == joint || self.is_above(above, joint)
    }

    /// The joints above one, the nearest first.
    pub fn above(&self, joint: u32) -> impl Iterator<Item = u32> + '_ {
        std::iter::successors(self.parents[joint as usize], |&at| self.parents[at as usize])
    }

    /// The nearest joint that holds both.
    pub fn common(&self, a: u32, b: u32) -> Option<u32> {
        std::iter::once(a).chain(self.above(a)).find(|&at| self.holds(at, b))
    }
}
