//! Contact against brute force.

mod broad_phase;
mod ccd;
mod curvature;
mod distance;
mod exempt_pairs;
mod hard_queries;
mod mollifier;
mod one_ring;
mod pairs;
mod scene;
mod surface;
