//! Whether a result is plausible: what the verifier cannot see, for a garment in which a hand is shut up in a sleeve passes
//! through nothing.
//!
//! Result and design are compared by what does not depend on how finely anything is divided: what goes through an opening,
//! in how many directions a point of the body sees the garment, and the area of a piece. Nothing here uses contact or
//! solver, nor the skin weights: what the run believed is not asked.

mod crumpled;
mod distorted;
mod lifted;
mod limbs;
mod nearest;
mod opening;
mod pieces;
mod strands;
mod swallowed;

use crate::control::{Cancel, Cancelled};
use crate::geometry::mesh::{Topology, TriangleMesh};
use crate::input::skeleton::{BoneGraph, Skeleton};

pub use crate::geometry::cover::{DIRECTIONS, cover};
use crate::geometry::crumpled::Crumpled;
pub use opening::{Disc, Section};

/// A bone reaches beyond a leaf joint by this share of its length: hands, feet and the head go on beyond their joints.
pub const LEAF_REACH: f64 = 0.5;

/// A garment as designed and as it became, with skeletons and body. Both are in the normalised space, in which the skeleton is
/// 2 long.
#[derive(Clone, Copy)]
pub struct Outcome<'a> {
    /// The garment as designed, around `source`.
    pub design: &'a TriangleMesh,
    /// The same garment in the end, on `body`.
    pub result: &'a TriangleMesh,
    /// The skeleton that the garment was designed on.
    pub source: &'a Skeleton,
    /// The skeleton of `body`, with the joints and bones of `source`.
    pub target: &'a Skeleton,
    /// The body without what it wears already.
    pub body: &'a TriangleMesh,
    /// What it wears already, under the garment.
    pub worn: &'a TriangleMesh,
    /// Triangles of the body that the garment is not meant to fit, ascending.
    pub collision_only: &'a [u32],
    /// Pairs of triangles of the result that pass through each other, ascending.
    pub intersecting: &'a [[u32; 2]],
}

/// Where a limb is that should be elsewhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Misplacement {
    /// The bone went through an opening of the design, or should have, and nothing of the body goes through it now.
    OutOfOpening {
        /// The bone.
        bone: u32,
        /// A garment vertex of the opening.
        vertex: u32,
    },
    /// The end of the limb was outside of the garment and is shut up in it now.
    Inside {
        /// The last bone of the limb.
        bone: u32,
        /// A triangle of the body that is inside.
        triangle: u32,
        /// The share of the limb's end that is.
        share: f64,
    },
    /// The part of the body around the bone was inside of the garment and is beside it now.
    Beside {
        /// The bone.
        bone: u32,
        /// A triangle of the body that is beside.
        triangle: u32,
        /// The share of the part that is.
        share: f64,
    },
    /// A part of the body that sticks out of it, without a bone of its own, is shut up in the garment, which has no room for it in
    /// the design.
    Swallowed {
        /// The bone that it is nearest to.
        bone: u32,
        /// A triangle of the part.
        triangle: u32,
        /// How many times farther from the bone it reaches than the garment does there in the design, beside how far the
        /// garment is from the bone as a whole.
        times: f64,
        /// Whether nobody would wear the result.
        is_gross: bool,
    },
    /// A loose sheet of the body, such as a strand of hair, begins outside of the garment and ends under it.
    Under {
        /// The bone at which it does.
        bone: u32,
        /// A triangle of it that is under the garment.
        triangle: u32,
        /// The share of it that is, with other sheets of which some is.
        share: f64,
    },
}

impl Misplacement {
    /// The bone that it is about.
    pub fn bone(&self) -> u32 {
        match *self {
            Self::OutOfOpening { bone, .. }
            | Self::Inside { bone, .. }
            | Self::Beside { bone, .. }
            | Self::Swallowed { bone, .. }
            | Self::Under { bone, .. } => bone,
        }
    }

    /// Whether nobody would wear the result.
    pub fn is_gross(&self) -> bool {
        !matches!(self, Self::Swallowed { is_gross: false, .. } | Self::Under { .. })
    }
}

/// A piece of the garment whose size is far from that of what it hangs on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resized {
    /// The piece's triangle of lowest index.
    pub triangle: u32,
    /// How many triangles it has.
    pub triangles: usize,
    /// Its size beside that which it should have: below 1 where it shrank.
    pub scale: f64,
    /// Whether nobody would wear it.
    pub is_gross: bool,
}

/// Cloth that became much larger in one place than in another, in a result that nobody would wear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Distorted {
    /// How many times as large, as lengths, all but a twentieth of the cloth is at least, and at most.
    pub scales: [f64; 2],
    /// A triangle of each size.
    pub triangles: [u32; 2],
}

/// Cloth that stands off the body, in a result that nobody would wear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lifted {
    /// A triangle of it.
    pub triangle: u32,
    /// How many times farther from the bones than in the design it is, beside the cloth that lies nearest.
    pub times: f64,
}

/// How a result differs from its design.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Findings {
    /// Limbs that are elsewhere than in the design; where any is gross the result is not plausible.
    pub misplaced: Vec<Misplacement>,
    /// Pieces of another size, where any is gross the result is not plausible.
    pub resized: Vec<Resized>,
    /// The cloth as a whole, where it is distorted so much that the result is not plausible.
    pub distorted: Option<Distorted>,
    /// Cloth that stands off, where so much of it does that the result is not plausible.
    pub lifted: Option<Lifted>,
    /// Cloth that passes through itself beside where it is, and whether so much does that the result is not plausible.
    pub crumpled: Option<(Crumpled, bool)>,
}

impl Findings {
    /// Whether nobody would wear the result.
    pub fn is_gross(&self) -> bool {
        self.misplaced.iter().any(Misplacement::is_gross)
            || self.resized.iter().any(|piece| piece.is_gross)
            || self.distorted.is_some()
            || self.lifted.is_some()
            || self.crumpled.as_ref().is_some_and(|crumpled| crumpled.1)
    }
}

/// Compares result and design. `design` and `result` share their triangles, whose indices are in range.
///
/// # Errors
/// [`Cancelled`].
pub fn compare(outcome: &Outcome<'_>, cancel: &Cancel) -> Result<Findings, Cancelled> {
    let topology = Topology::new(outcome.design.positions.len(), &outcome.design.triangles);
    let graph = BoneGraph::new(outcome.source);
    let openings = opening::openings(outcome, &topology);
    cancel.check()?;
    let mut misplaced = opening::empty_openings(outcome, &openings);
    cancel.check()?;
    misplaced.extend(limbs::misplaced(outcome, &graph, &openings, cancel)?);
    cancel.check()?;
    let missed = opening::missed_openings(outcome, &openings);
    let is_new = |limb: &Misplacement| misplaced.iter().all(|known| known.bone() != limb.bone());
    let missed: Vec<Misplacement> = missed.into_iter().filter(is_new).collect();
    misplaced.extend(missed);
    cancel.check()?;
    misplaced.extend(swallowed::swallowed(outcome, &graph, cancel)?);
    cancel.check()?;
    misplaced.extend(strands::strands(outcome, &graph, cancel)?);
    cancel.check()?;
    let resized = pieces::resized(outcome, &openings);
    cancel.check()?;
    let lifted = lifted::lifted(outcome, &graph);
    let (distorted, crumpled) = (distorted::distorted(outcome), crumpled::left(outcome));
    Ok(Findings { misplaced, resized, distorted, lifted, crumpled })
}
