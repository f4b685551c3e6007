//! Tables of names, one a file: the rigs that tools and engines make.
//!
//! A row says what its names stand for. Names are separated by commas. `*` stands where a side is written, whether as
//! `Left`, `L` or `l`; `#` at the end for any number, or none. Case and separators do not matter, and neither does what
//! all names of a rig have in front or behind. A row of a finger has its bones in order from the first that is free to
//! the tip; with `#` the number says which.
//!
//! To add a rig: a file with its table and where the names are from, and a line in [`ALL`]. Of tables with the same names
//! the first is taken. `tests/rig/names/lists.rs` has the joints that it is tried on.

mod advanced_skeleton;
mod auto_rig_pro;
mod biped;
mod blender;
mod character_creator;
mod daz;
mod godot;
mod human_ik;
mod kaykit;
mod khronos;
mod makehuman;
mod makehuman_cmu;
mod mikumikudance;
mod mixamo;
mod quaternius;
mod rigify;
mod roblox;
mod second_life;
mod smpl;
mod source_engine;
mod unity;
mod unreal;
mod vrchat;
mod vrm;
mod vroid;
mod xsens;

use super::slot::Slot;

/// A table of names.
pub struct Profile {
    /// What it is called.
    pub name: &'static str,
    /// What its names may begin with.
    pub prefixes: &'static [&'static str],
    /// What names stand for.
    pub rows: &'static [(Slot, &'static str)],
}

/// All tables.
pub const ALL: &[&Profile] = &[
    &mixamo::PROFILE,
    &unreal::PROFILE,
    &vrm::PROFILE,
    &vroid::PROFILE,
    &unity::PROFILE,
    &godot::PROFILE,
    &rigify::PROFILE,
    &blender::PROFILE,
    &makehuman::PROFILE,
    &makehuman_cmu::PROFILE,
    &roblox::PROFILE,
    &biped::PROFILE,
    &source_engine::PROFILE,
    &character_creator::PROFILE,
    &daz::GENESIS_8,
    &daz::GENESIS_9,
    &human_ik::PROFILE,
    &smpl::PROFILE,
    &auto_rig_pro::PROFILE,
    &advanced_skeleton::PROFILE,
    &vrchat::PROFILE,
    &second_life::PROFILE,
    &mikumikudance::PROFILE,
    &xsens::PROFILE,
    &kaykit::PROFILE,
    &quaternius::PROFILE,
    &khronos::PROFILE,
];
