//! The gallery: pairs of a garment and an avatar of the closet, dressed, judged, and shown in a table and on a sheet of
//! pictures.

pub mod folder;
pub mod look;
pub mod models;
pub mod overview;
pub mod pair;
pub mod regularity;
pub mod sheet;
pub mod table;
