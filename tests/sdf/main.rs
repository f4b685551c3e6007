//! The distance field, and the shim around OpenVDB.

mod field;
mod real_avatar;
mod shapes;
mod shim;
mod volume;
