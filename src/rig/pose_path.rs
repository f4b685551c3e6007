//! The way of a rig from its bind pose into a pose that its caller names.
//!
//! Seen from the joint above, each joint turns about its place, is stretched, and is shifted, all evenly along the way:
//!
//! ```text
//! M_j(s) = M_parent(j)(s) L_j(s),    L_j(s)(p) = c_j + s d_j + (1 + s (S_j - 1)) Q_j^s (p - c_j)
//! ```
//!
//! with the place `c_j` of the joint in the bind pose. At s = 1 the motions are exactly those that were named.

use glam::{DAffine3, DMat3, DQuat, DVec3};

use crate::error::{Error, ErrorKind, Result};
use crate::geometry::turn;
use crate::input::rig::Rig;

/// No joint turns by more than this many degrees in a piece: each vertex goes straight where it should go along an arc.
const PIECE: f64 = 12.0;
/// The longest way: a pose turned about several times is one by mistake.
const MOST_PIECES: u32 = 60;

/// A motion of a joint as the joint above sees it.
#[derive(Clone, Copy, Debug)]
struct Local {
    turn: DQuat,
    stretch: DMat3,
    shift: DVec3,
}

/// How all joints get into a pose.
#[derive(Clone, Debug)]
pub struct PosePath {
    /// Each joint after its parent.
    order: Vec<u32>,
    parents: Vec<Option<u32>>,
    places: Vec<DVec3>,
    local: Vec<Local>,
    end: Vec<DAffine3>,
}

impl PosePath {
    /// The way to `motions`, which take what each joint moves from the bind pose of `rig` to the pose, in the space of the rig.
    ///
    /// # Errors
    /// `InvalidArgument`: another number of motions than joints, a number that is not finite, a motion without inverse.
    pub fn new(rig: &Rig, motions: Vec<DAffine3>) -> Result<Self> {
        let refuse = |message| Err(Error::new(ErrorKind::InvalidArgument, message));
        if motions.len() != rig.joints.len() {
            return refuse(format!("it moves {} joints, the target rig has {}", motions.len(), rig.joints.len()));
        }
        let has_inverse = |m: &DAffine3| m.is_finite() && (1e-6..1e6).contains(&m.matrix3.determinant().abs());
        if let Some(joint) = motions.iter().position(|m| !has_inverse(m)) {
            return refuse(format!("the transform of {} is not finite, or has no inverse", rig.called(joint)));
        }
        let order = rig.parents_first("target rig")?;
        let parents: Vec<Option<u32>> = rig.joints.iter().map(|joint| joint.parent).collect();
        let places: Vec<DVec3> = (0..rig.joints.len() as u32).map(|joint| rig.place(joint)).collect();
        let local = |joint: usize| {
            let above = parents[joint].map_or(DAffine3::IDENTITY, |parent| motions[parent as usize]);
            let own = above.inverse() * motions[joint];
            let turned = rotation(own.matrix3);
            Local {
                turn: turned,
                stretch: own.matrix3 * DMat3::from_quat(turned).transpose(),
                shift: own.transform_point3(places[joint]) - places[joint],
            }
        };
        let local = (0..motions.len()).map(local).collect();
        Ok(Self { order, parents, places, local, end: motions })
    }

    /// In how many pieces it is to be gone, so that in none a joint turns far.
    pub fn pieces(&self) -> u32 {
        let turned = self.end.iter().map(|motion| turn::angle(rotation(motion.matrix3)));
        let largest = turned.fold(0.0, f64::max).to_degrees();
        ((largest / PIECE).ceil().max(1.0) as u32).min(MOST_PIECES)
    }

    /// The motion of each joint at `share` of the way: 0 is the bind pose, 1 the pose.
    pub fn motions(&self, share: f64) -> Vec<DAffine3> {
        if share >= 1.0 {
            return self.end.clone();
        }
        let mut motions = vec![DAffine3::IDENTITY; self.end.len()];
        for &joint in &self.order {
            let j = joint as usize;
            let Local { turn, stretch, shift } = self.local[j];
            let turned = DMat3::from_quat(turn::between(DQuat::IDENTITY, turn, share));
            let matrix3 = (DMat3::IDENTITY + (stretch - DMat3::IDENTITY) * share) * turned;
            let translation = self.places[j] + share * shift - matrix3 * self.places[j];
            let above = self.parents[j].map_or(DAffine3::IDENTITY, |parent| motions[parent as usize]);
            motions[j] = above * DAffine3 { matrix3, translation };
        }
        motions
    }
}

/// The rotation in a matrix, by the directions of its first two columns; none in one that mirrors.
fn rotation(matrix: DMat3) -> DQuat {
    if matrix.determinant() <= 0.0 {
        return DQuat::IDENTITY;
    }
    let x = matrix.x_axis.normalize_or(DVec3::X);
    let y = (matrix.y_axis - matrix.y_axis.dot(x) * x).normalize_or(x.any_orthonormal_vector());
    let turn = DQuat::from_mat3(&DMat3::from_cols(x, y, x.cross(y))).normalize();
    if turn.w < 0.0 { -turn } else { turn }
}
