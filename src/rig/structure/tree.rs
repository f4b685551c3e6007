//! The joints of a rig as a graph.

use std::collections::VecDeque;

use glam::DVec3;

use super::Joints;

/// Parents in one place, up to this share of the longest way, are one joint.
const SAME_PLACE: f64 = 1e-4;

/// The joints that are used as a graph without direction, joints in one place taken as one.
pub struct Tree<'a> {
    pub places: &'a [DVec3],
    pub neighbours: Vec<Vec<u32>>,
    pub used: Vec<bool>,
    pub moved: Option<&'a [f64]>,
    /// The diagonal of the box around all of them.
    pub size: f64,
}

impl<'a> Tree<'a> {
    pub fn new(joints: &Joints<'a>) -> Option<Self> {
        let &Joints { places, parents, moved, .. } = joints;
        let used = without_bare_roots(joints);
        let low = places.iter().zip(&used).filter(|(_, used)| **used).map(|(p, _)| *p).reduce(DVec3::min)?;
        let high = places.iter().zip(&used).filter(|(_, used)| **used).map(|(p, _)| *p).reduce(DVec3::max)?;
        let size = (high - low).length();
        let mut neighbours = vec![Vec::new(); places.len()];
        for joint in (0..places.len()).filter(|&joint| used[joint]) {
            // Over joints that lie in the same place, which stand for no bone.
            let mut up = parents[joint];
            while let Some(k) = up
                && (places[k as usize].distance(places[joint]) <= SAME_PLACE * size || !used[k as usize])
            {
                up = parents[k as usize];
            }
            if let Some(k) = up {
                neighbours[joint].push(k);
                neighbours[k as usize].push(joint as u32);
            }
        }
        (size > 0.0).then_some(Self { places, neighbours, used, moved, size })
    }

    pub fn place(&self, joint: u32) -> DVec3 {
        self.places[joint as usize]
    }

    pub fn length(&self, a: u32, b: u32) -> f64 {
        self.place(a).distance(self.place(b))
    }

    /// How far a joint is from the line through `from` along `up`.
    pub fn aside(&self, from: u32, joint: u32, up: DVec3) -> f64 {
        let there = self.place(joint) - self.place(from);
        (there - there.dot(up) * up).length()
    }

    /// The longest way from `from` by way of its neighbour `to`, without `from`.
    pub fn longest(&self, from: u32, to: u32) -> Branch {
        // Every joint once, each after the one it is reached from: that one's place in the list, the joint, how far it is.
        let mut reached = vec![(0, to, self.length(from, to))];
        let mut best = 0;
        let mut next = 0;
        while next < reached.len() {
            let (before, joint, length) = reached[next];
            if length > reached[best].2 {
                best = next;
            }
            let last = if next == 0 { from } else { reached[before].1 };
            let on = self.neighbours[joint as usize].iter().filter(|&&k| k != last);
            reached.extend(on.map(|&k| (next, k, length + self.length(joint, k))));
            next += 1;
        }
        let length = reached[best].2;
        let mut way = vec![reached[best].1];
        while best != 0 {
            best = reached[best].0;
            way.push(reached[best].1);
        }
        way.reverse();
        Branch { length, way }
    }

    /// The joints from `a` to `b`, both included.
    pub fn way(&self, a: u32, b: u32) -> Option<Vec<u32>> {
        let mut before = vec![None; self.places.len()];
        let mut queue = VecDeque::from([a]);
        while let Some(joint) = queue.pop_front() {
            if joint == b {
                let mut way = vec![b];
                while let Some(&last) = way.last()
                    && last != a
                {
                    way.push(before[last as usize]?);
                }
                way.reverse();
                return Some(way);
            }
            for &k in &self.neighbours[joint as usize] {
                if k != a && before[k as usize].is_none() {
                    before[k as usize] = Some(joint);
                    queue.push_back(k);
                }
            }
        }
        None
    }
}

/// Which joints are used, without roots that move nothing and have a single joint on them: they stand on the floor.
fn without_bare_roots(joints: &Joints<'_>) -> Vec<bool> {
    let mut used = joints.used.to_vec();
    let Some(moved) = joints.moved else { return used };
    let mut children = vec![Vec::new(); used.len()];
    for (joint, parent) in (0u32..).zip(joints.parents) {
        if let Some(parent) = parent {
            children[*parent as usize].push(joint);
        }
    }
    for root in (0..used.len()).filter(|&joint| joints.parents[joint].is_none()) {
        let mut joint = root;
        loop {
            let mut on_it = children[joint].iter().filter(|&&child| used[child as usize]);
            let (Some(&only), None) = (on_it.next(), on_it.next()) else { break };
            if moved[joint] > 0.0 {
                break;
            }
            used[joint] = false;
            joint = only as usize;
        }
    }
    used
}

/// The longest way from a joint in one direction.
#[derive(Clone)]
pub struct Branch {
    pub length: f64,
    pub way: Vec<u32>,
}

impl Branch {
    pub fn tip(&self, tree: &Tree<'_>) -> DVec3 {
        self.way.last().map_or(DVec3::ZERO, |&joint| tree.place(joint))
    }
}
