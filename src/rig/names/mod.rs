//! What the joints of a rig are, by their names and by what hangs on what.
//!
//! Names are split into words. A table of the names that a tool writes says what each means (`profiles/`), and a
//! vocabulary what words mean anywhere. A name can claim several parts, and several joints one: in each limb the chain
//! from joint to joint that fits best decides (`limbs.rs`), in the trunk what hangs on it (`trunk.rs`).

mod affixes;
mod claims;
mod fingers;
mod limbs;
mod profiles;
mod slot;
mod table;
mod tokens;
mod tree;
mod trunk;
mod vocabulary;

use super::body_part::BodyPart;
use claims::Reader;
use slot::Slot;

/// What a joint is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Named {
    /// A part of the body.
    Part(BodyPart),
    /// A helper along a limb: it twists, bulges, or halves a bone.
    Twist,
    /// It moves other joints, or nothing: a root on the floor, the target or pole of an IK chain, a roll of the foot.
    Control,
    /// Where a thing is held or carried, or a camera.
    Prop,
    /// Hair, clothes, face, tail, and what else hangs on a body.
    Secondary,
    /// Nothing is known of it.
    Unknown,
}

/// What the joints of a rig are.
#[derive(Clone, Debug)]
pub struct Naming {
    /// The table that the names follow, if they follow one. Where tables have the same names, the first of them.
    pub profile: Option<&'static str>,
    /// What each joint is. No two are the same part, but for [`BodyPart::Spine`] and [`BodyPart::Neck`].
    pub joints: Vec<Named>,
    /// How sure that is, from 0 to 1; 0 for [`Named::Unknown`], below 0.6 for what is a guess or what the tree contradicts.
    pub confidence: Vec<f64>,
}

/// Reads the joints of a rig that have these names and hang on these parents. Parents that are out of range, missing or
/// go in a circle are no error: such joints hang on nothing.
pub fn read(names: &[&str], parents: &[Option<u32>]) -> Naming {
    let mut reader = Reader::new(names, parents);
    find(&mut reader);
    // A table that the rig does not follow says nothing.
    if let Some(mut other) = reader.without_table() {
        find(&mut other);
        return other.finish();
    }
    reader.finish()
}

fn find(reader: &mut Reader) {
    limbs::read(reader);
    trunk::read(reader);
    fingers::read(reader);
}

/// The kind of joint that a row stands for, where it is no part of the body.
fn kind(slot: Slot) -> Option<Named> {
    Some(match slot {
        Slot::Twist => Named::Twist,
        Slot::Control => Named::Control,
        Slot::Prop => Named::Prop,
        Slot::Secondary => Named::Secondary,
        _ => return None,
    })
}
