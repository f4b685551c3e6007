//! Left and right of a skeleton: the plane that maps it onto itself, and the pairs of limbs on its two sides.

use glam::DVec3;

use super::alignment::normalised;
use crate::input::coordinate_system::AxisTurn;
use crate::input::skeleton::Skeleton;

/// How far a joint may be from the mirror image of its counterpart, in units of the skeleton's radius.
const NEAR: f64 = 0.15;
/// Joints farther apart than this can be a pair that gives the plane.
const APART: f64 = 0.1;
/// Skeletons of more joints are not looked at.
const MOST_JOINTS: usize = 400;
/// From this cosine on, the lines from right to left of two skeletons go the same way.
const CLEAR: f64 = 0.3;

/// The pairs of joints on two sides of a plane.
#[derive(Clone, Debug, PartialEq)]
pub struct MirrorPairs {
    /// The normal of the plane, of length 1.
    pub normal: DVec3,
    /// For each joint its counterpart; itself on the plane.
    pub other: Vec<u32>,
    /// Joints of pairs of limbs: of each the joints on one side, from the trunk outwards.
    pub limbs: Vec<Vec<u32>>,
}

impl MirrorPairs {
    /// The pairs of a skeleton; none where no plane maps its joints and bones onto themselves.
    pub fn of(skeleton: &Skeleton) -> Option<Self> {
        let joints = normalised(&skeleton.joints);
        if joints.len() > MOST_JOINTS {
            return None;
        }
        let mut degree = vec![0; joints.len()];
        skeleton.bones.iter().flatten().for_each(|&j| degree[j as usize] += 1);
        let leaves: Vec<usize> = (0..joints.len()).filter(|&j| degree[j] == 1).collect();
        let mut best: Option<(f64, DVec3, Vec<u32>)> = None;
        for (k, &a) in leaves.iter().enumerate() {
            for &b in &leaves[k + 1..] {
                let across = joints[b] - joints[a];
                if across.length() < APART {
                    continue;
                }
                let (normal, middle) = (across.normalize(), 0.5 * (joints[a] + joints[b]));
                let Some((far, other)) = counterparts(&joints, normal, middle) else { continue };
                if best.as_ref().is_none_or(|(least, ..)| far < *least) && keeps_bones(skeleton, &other) {
                    best = Some((far, normal, other));
                }
            }
        }
        let (_, normal, other) = best?;
        let limbs = limbs(skeleton, &other);
        (!limbs.is_empty()).then_some(Self { normal, other, limbs })
    }

    /// The joints, with those of `limbs` on the places of their counterparts.
    pub fn swapped(&self, joints: &[DVec3], limbs: &[usize]) -> Vec<DVec3> {
        let mut swapped = joints.to_vec();
        for &j in limbs.iter().flat_map(|&limb| &self.limbs[limb]) {
            swapped.swap(j as usize, self.other[j as usize] as usize);
        }
        swapped
    }

    /// All limbs.
    pub fn all_limbs(&self) -> Vec<usize> {
        (0..self.limbs.len()).collect()
    }

    /// A pair of joints of the first of `limbs`, the innermost.
    pub fn example(&self, limbs: &[usize]) -> [u32; 2] {
        let first = limbs.first().and_then(|&limb| self.limbs[limb].first()).copied().unwrap_or(0);
        [first, self.other[first as usize]]
    }

    /// The limbs, not all of them, that are on the other side in `target` than in `source`, where `turn` is between the two;
    /// none where all agree. Limbs that are only crossed begin on their own side.
    pub fn limbs_swapped(&self, source: &Skeleton, target: &Skeleton, turn: AxisTurn) -> Vec<usize> {
        // A half turn exchanges the sides of all, and so cannot tell which are exchanged.
        let turn = if turn.degrees() > 150.0 { AxisTurn::IDENTITY } else { turn };
        let sides: Vec<i32> = self.limbs.iter().map(|limb| self.side(limb, source, target, turn)).collect();
        let wrong = |&k: &usize| sides[k] < 0;
        if sides.iter().any(|&side| side > 0) { (0..sides.len()).filter(wrong).collect() } else { Vec::new() }
    }

    /// 1 where a limb is on the same side of its counterpart in both, -1 where on the other, 0 where that is not clear.
    fn side(&self, limb: &[u32], source: &Skeleton, target: &Skeleton, turn: AxisTurn) -> i32 {
        let across = |skeleton: &Skeleton, limb: &[u32]| -> DVec3 {
            let from_other = |&j: &u32| skeleton.joints[j as usize] - skeleton.joints[self.other[j as usize] as usize];
            limb.iter().map(from_other).sum()
        };
        let same = |limb: &[u32]| {
            let (a, b) = (across(source, limb), turn.apply(across(target, limb)));
            a.normalize_or_zero().dot(b.normalize_or_zero())
        };
        let both = [same(limb), same(&limb[..1])];
        i32::from(both.iter().all(|&x| x > CLEAR)) - i32::from(both.iter().all(|&x| x < -CLEAR))
    }
}

/// For each joint the one nearest to its mirror image, and the largest distance; none where that is far or not one to one.
fn counterparts(joints: &[DVec3], normal: DVec3, middle: DVec3) -> Option<(f64, Vec<u32>)> {
    let mut farthest = 0.0_f64;
    let mut other = Vec::with_capacity(joints.len());
    for &p in joints {
        let image = p - 2.0 * (p - middle).dot(normal) * normal;
        let (nearest, distance) =
            joints.iter().zip(0_u32..).map(|(q, k)| (k, q.distance(image))).min_by(|a, b| a.1.total_cmp(&b.1))?;
        if distance > NEAR {
            return None;
        }
        farthest = farthest.max(distance);
        other.push(nearest);
    }
    let is_mutual = other.iter().zip(0..).all(|(&k, j)| other[k as usize] == j);
    is_mutual.then_some((farthest, other))
}

fn keeps_bones(skeleton: &Skeleton, other: &[u32]) -> bool {
    let undirected = |[a, b]: [u32; 2]| [a.min(b), a.max(b)];
    let mut bones: Vec<[u32; 2]> = skeleton.bones.iter().map(|&b| undirected(b)).collect();
    bones.sort_unstable();
    skeleton.bones.iter().all(|bone| bones.binary_search(&undirected(bone.map(|j| other[j as usize]))).is_ok())
}

/// Connected joints that are not on the plane: of each two that mirror each other, the one with the lower joint.
fn limbs(skeleton: &Skeleton, other: &[u32]) -> Vec<Vec<u32>> {
    let is_aside = |j: u32| other[j as usize] != j;
    let mut seen = vec![false; other.len()];
    let mut limbs = Vec::new();
    // From the trunk outwards: joints that a bone connects with the plane first.
    let inner = |j: u32| skeleton.bones.iter().any(|b| b.contains(&j) && b.iter().any(|&k| !is_aside(k)));
    let mut order: Vec<u32> = (0..other.len() as u32).filter(|&j| is_aside(j)).collect();
    order.sort_by_key(|&j| (!inner(j), j));
    for first in order {
        if seen[first as usize] {
            continue;
        }
        let (mut limb, mut next) = (vec![first], 0);
        seen[first as usize] = true;
        while next < limb.len() {
            let j = limb[next];
            next += 1;
            for bone in skeleton.bones.iter().filter(|bone| bone.contains(&j)) {
                let k = if bone[0] == j { bone[1] } else { bone[0] };
                // Not across the plane where a bone joins the two sides.
                if is_aside(k) && !seen[k as usize] && !limb.contains(&other[k as usize]) {
                    seen[k as usize] = true;
                    limb.push(k);
                }
            }
        }
        limb.iter().for_each(|&j| seen[other[j as usize] as usize] = true);
        limbs.push(limb);
    }
    limbs
}
