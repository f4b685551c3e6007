//! The start (section 3.3 of the paper): the avatar projected onto the source skeleton, inside the garment. Where the
//! skeleton itself leaves the garment, it is bent around it or retracted.

pub mod bent_skeleton;
pub mod beyond_openings;
pub mod caps;
pub mod contour;
pub mod enclosure;
pub mod foreign_parts;
pub mod inside;
pub mod joints;
pub mod offset_grid;
pub mod open_ends;
pub mod owners;
pub mod path_search;
mod path_trace;
pub mod projection;
pub mod repair;
pub mod smooth;
pub mod untangle;
pub mod weight_check;
pub mod winding;
