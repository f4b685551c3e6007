//! Meshes, search trees and closest points against brute force and known answers.

mod alignment;
mod border_edges;
mod bvh;
mod closest_point;
mod covered;
mod maths;
mod median;
mod mesh;
mod missing_faces;
mod outfit;
mod piece;
mod quantile;
mod sliver_caps;
mod solid_angle;
mod spread;
mod t_junctions;
mod triangle_motion;
mod turn;
