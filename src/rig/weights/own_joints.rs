//! The garment's own joints: those of its skirt, tails, laces, which no body has.
//!
//! They come along: their weights are kept, and they are placed where the fitted garment has taken what they move.

use glam::{DAffine3, DMat3, DVec3};

use super::groups::sum_up;
use crate::error::{Error, ErrorKind, Result};
use crate::geometry::alignment::Similarity;
use crate::input::skin::SkinWeights;

/// A joint that is added after those of the target rig.
#[derive(Clone, Debug, PartialEq)]
pub struct AddedJoint {
    /// The joint of the source rig that it is.
    pub source: u32,
    /// Its parent: a joint of the target rig, or that of an added joint, which are numbered on from there. None for a root.
    pub parent: Option<u32>,
    /// Its bind transform in the space of the target.
    pub bind: DAffine3,
}

/// A source rig, and what of it the target rig has.
#[derive(Clone, Copy, Debug)]
pub struct SourceRig<'a> {
    /// The parent of each joint; a circle counts as roots.
    pub parents: &'a [Option<u32>],
    /// The bind transform of each joint in the space of the source.
    pub binds: &'a [DAffine3],
    /// The joint of the target rig that each one is, if any.
    pub map: &'a [Option<u32>],
    /// Number of joints of the target rig.
    pub target_joints: usize,
}

impl SourceRig<'_> {
    /// The joints of `garment_skin` that are the garment's own, ascending: in no joint of the target, with weights on the
    /// garment, and with none on the body that the garment was made for, where that has a skin.
    pub fn own_joints(&self, garment_skin: &SkinWeights, body_skin: Option<&SkinWeights>) -> Vec<u32> {
        let used = |skin: &SkinWeights| {
            let mut used = vec![false; self.parents.len()];
            let influences = (0..skin.vertex_count()).flat_map(|v| skin.weights(v));
            influences.for_each(|&(joint, _)| used[joint as usize] = true);
            used
        };
        let (worn, of_body) = (used(garment_skin), body_skin.map(used));
        let is_own = |&j: &u32| {
            let j = j as usize;
            worn[j] && self.map[j].is_none() && of_body.as_ref().is_none_or(|body| !body[j])
        };
        (0..self.parents.len() as u32).filter(is_own).collect()
    }

    /// The joints that `own` needs in the target rig: these, and what is between them and the first joint above that the
    /// target has. Parents come before their children. `designed` and `fitted` are the garment before and after, whose
    /// weights are `garment_skin`: each joint goes where the similarity takes it that fits best what it moves, with all that
    /// hang on it; its axes are turned, never scaled.
    pub fn added_joints(
        &self,
        own: &[u32],
        garment_skin: &SkinWeights,
        designed: &[DVec3],
        fitted: &[DVec3],
    ) -> Vec<AddedJoint> {
        let above = self.unmapped_parents();
        let order = chains(own, &above);
        let mut is_added = vec![false; self.parents.len()];
        order.iter().for_each(|&joint| is_added[joint as usize] = true);
        // How much of each vertex an added joint moves, with those below it.
        let mut shares: Vec<Vec<(u32, f64)>> = vec![Vec::new(); self.parents.len()];
        for v in 0..garment_skin.vertex_count() {
            for &(joint, weight) in garment_skin.weights(v).iter().filter(|w| is_added[w.0 as usize]) {
                let chain = std::iter::successors(Some(joint), |&j| above[j as usize]);
                chain.for_each(|j| shares[j as usize].push((v as u32, weight)));
            }
        }
        let mut number: Vec<Option<u32>> = self.map.to_vec();
        let mut added: Vec<AddedJoint> = Vec::with_capacity(order.len());
        for &source in &order {
            let (vertices, weights): (Vec<u32>, Vec<f64>) = shares[source as usize].iter().copied().unzip();
            let at = |all: &[DVec3]| vertices.iter().map(|&v| all[v as usize]).collect::<Vec<_>>();
            let moved = Similarity::nearest(&at(designed), &at(fitted), &weights, None);
            let bind = self.binds[source as usize];
            let bind = DAffine3 {
                matrix3: DMat3::from_quat(moved.rotation) * bind.matrix3,
                translation: moved.apply(bind.translation),
            };
            let parent = self.parents[source as usize].and_then(|p| number[p as usize]);
            number[source as usize] = Some((self.target_joints + added.len()) as u32);
            added.push(AddedJoint { source, parent, bind });
        }
        added
    }

    /// The parent of each joint unless the target has it; circles are cut open at the joint by which they are first met.
    fn unmapped_parents(&self) -> Vec<Option<u32>> {
        let unmapped = |p: &Option<u32>| p.filter(|&p| self.map[p as usize].is_none());
        let mut above: Vec<Option<u32>> = self.parents.iter().map(unmapped).collect();
        // The walk that has met each joint.
        let mut met = vec![u32::MAX; above.len()];
        for walk in 0..above.len() as u32 {
            let mut at = walk;
            while met[at as usize] == u32::MAX {
                met[at as usize] = walk;
                match above[at as usize] {
                    Some(next) if met[next as usize] == walk => above[at as usize] = None,
                    Some(next) => at = next,
                    None => {}
                }
            }
        }
        above
    }
}

/// `own` and all above them, parents first.
fn chains(own: &[u32], above: &[Option<u32>]) -> Vec<u32> {
    let mut listed = vec![false; above.len()];
    let mut order = Vec::new();
    for &joint in own {
        let chain = std::iter::successors(Some(joint), |&j| above[j as usize]);
        let mut chain: Vec<u32> = chain.take_while(|&j| !std::mem::replace(&mut listed[j as usize], true)).collect();
        chain.reverse();
        order.extend(chain);
    }
    order
}

/// `transferred`, the garment's weights on the target rig, with the weights that it has on its own joints: what these leave
/// of a vertex is shared out as it was transferred.
///
/// # Errors
/// [`ErrorKind::InvalidWeights`] where the two are for different numbers of vertices.
pub fn keep_own(transferred: &SkinWeights, garment_skin: &SkinWeights, added: &[AddedJoint]) -> Result<SkinWeights> {
    let (count, own_count) = (transferred.vertex_count(), garment_skin.vertex_count());
    if count != own_count {
        let message = format!("the garment's skin weights are for {own_count} vertices, the garment has {count}");
        return Err(Error::new(ErrorKind::InvalidWeights, message));
    }
    let first = transferred.joint_count();
    let mut number = vec![None; garment_skin.joint_count()];
    added.iter().zip(first as u32..).for_each(|(joint, k)| number[joint.source as usize] = Some(k));
    let rows = (0..count).map(|v| {
        let weights = garment_skin.weights(v);
        let sum: f64 = weights.iter().map(|w| w.1).sum();
        let own = weights.iter().filter_map(|&(joint, weight)| Some((number[joint as usize]?, weight / sum)));
        let mut row: Vec<(u32, f64)> = own.collect();
        let left = 1.0 - row.iter().map(|w| w.1).sum::<f64>();
        if left > 1e-9 {
            row.extend(transferred.weights(v).iter().map(|&(joint, weight)| (joint, left * weight)));
        }
        sum_up(&mut row)
    });
    Ok(SkinWeights::from_rows(first + added.len(), rows))
}
