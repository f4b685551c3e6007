//! The distance field, the search tree below it, and the shim around OpenVDB.

mod closest_point;
mod field;
mod real_avatar;
mod shapes;
mod volume;
