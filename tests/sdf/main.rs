//! The distance field, the search tree below it, and the shim around OpenVDB.

#[path = "../support/obj.rs"]
mod obj;
#[path = "../support/mod.rs"]
mod support;

mod closest_point;
mod field;
mod real_avatar;
mod shapes;
mod volume;
