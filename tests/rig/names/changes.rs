//! What people do to a rig: names with something before or behind them, joints left out, added, and in another order.

use bespoke::rig::body_part::BodyPart;
use bespoke::rig::names::Named;
use testing::Random;

use super::lists::Joint;

/// The joints in another order.
pub fn shuffled(joints: &[Joint], random: &mut Random) -> Vec<Joint> {
    let mut order: Vec<usize> = (0..joints.len()).collect();
    for k in (1..order.len()).rev() {
        order.swap(k, (random.unit() * (k + 1) as f64) as usize % (k + 1));
    }
    reordered(joints, &order)
}

/// The joints backwards: children first, right before left.
pub fn backwards(joints: &[Joint]) -> Vec<Joint> {
    reordered(joints, &(0..joints.len()).rev().collect::<Vec<_>>())
}

fn reordered(joints: &[Joint], order: &[usize]) -> Vec<Joint> {
    let mut place = vec![0; joints.len()];
    for (to, &from) in order.iter().enumerate() {
        place[from] = to;
    }
    let moved =
        |&from: &usize| Joint { parent: joints[from].parent.map(|parent| place[parent]), ..joints[from].clone() };
    order.iter().map(moved).collect()
}

/// Other names.
pub fn renamed(joints: &[Joint], name: impl Fn(usize, &str) -> String) -> Vec<Joint> {
    let own = |(index, joint): (usize, &Joint)| Joint { name: name(index, &joint.name), ..joint.clone() };
    joints.iter().enumerate().map(own).collect()
}

/// Without some joints: what hung on them hangs on what they hung on.
pub fn without(joints: &[Joint], leaves: impl Fn(usize, &Joint) -> bool) -> Vec<Joint> {
    let mut place = vec![None; joints.len()];
    let mut left: Vec<Joint> = Vec::new();
    for (index, joint) in joints.iter().enumerate() {
        // Where the joint is now, or that on which it hung.
        let parent = joint.parent.and_then(|parent| place[parent]);
        if leaves(index, joint) {
            place[index] = parent;
            continue;
        }
        place[index] = Some(left.len());
        left.push(Joint { parent, ..joint.clone() });
    }
    left
}

/// With another joint of the name of each part, which hangs on nothing: as where meshes and joints have the same names.
pub fn doubled(joints: &[Joint]) -> Vec<Joint> {
    let parts = joints.iter().filter(|joint| matches!(joint.named, Named::Part(_)));
    let doubles = parts.map(|joint| Joint { parent: None, named: Named::Unknown, ..joint.clone() });
    joints.iter().cloned().chain(doubles).collect()
}

/// The indices of the joints that are `part`.
pub fn of(joints: &[Joint], part: BodyPart) -> Vec<usize> {
    (0..joints.len()).filter(|&index| joints[index].named == Named::Part(part)).collect()
}

/// With `count` joints of the spine, where the last one has a number behind it: those above count on, as do all others that
/// have no name but the number.
pub fn with_spines(joints: &[Joint], count: usize) -> Option<Vec<Joint>> {
    let spines = of(joints, BodyPart::Spine);
    if count <= spines.len() {
        // The last is the one on which the arms hang: those before it go.
        let gone = &spines[..spines.len() - count];
        let fewer = without(joints, |index, _| gone.contains(&index));
        return Some(if is_one_row(joints) { numbered(&fewer) } else { fewer });
    }
    let last = *spines.last()?;
    let first_digit = joints[last].name.trim_end_matches(|c: char| c.is_ascii_digit()).len();
    let (base, number) = joints[last].name.split_at(first_digit);
    // Vertebrae are no row that goes on.
    if base.len() < 2 {
        return None;
    }
    let width = number.len();
    let highest = spines.iter().filter_map(|&k| joints[k].name.strip_prefix(base)?.parse::<u32>().ok()).max()?;
    let mut more = joints.to_vec();
    let mut at = last;
    for k in 0..count - spines.len() {
        let name = format!("{base}{:0width$}", highest + 1 + k as u32);
        more.push(Joint { name, parent: Some(at), named: Named::Part(BodyPart::Spine) });
        let new = more.len() - 1;
        for joint in &mut more[..new] {
            if joint.parent == Some(at) {
                joint.parent = Some(new);
            }
        }
        at = new;
    }
    Some(if is_one_row(joints) { numbered(&more) } else { more })
}

/// Whether hips, spine, neck and head are one row of numbers, as in Rigify's meta-rig.
fn is_one_row(joints: &[Joint]) -> bool {
    let head = of(joints, BodyPart::Head);
    head.iter().any(|&head| joints[head].name.ends_with("spine.006"))
}

fn numbered(joints: &[Joint]) -> Vec<Joint> {
    let mut named = joints.to_vec();
    let Some(&head) = of(joints, BodyPart::Head).first() else { return named };
    let up = std::iter::successors(Some(head), |&at| joints[at].parent);
    let trunk: Vec<usize> =
        up.filter(|&at| joints[at].name.contains("spine") && matches!(joints[at].named, Named::Part(_))).collect();
    for (number, &at) in trunk.iter().rev().enumerate() {
        let (base, _) = joints[at].name.split_at(joints[at].name.find("spine").unwrap_or(0) + "spine".len());
        named[at].name = if number == 0 { base.to_owned() } else { format!("{base}.{number:03}") };
    }
    named
}
