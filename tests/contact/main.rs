//! Contact against brute force.

mod bvh;
mod candidates;
mod ccd;
mod distance;
mod hard_queries;
mod mollifier;
mod neighbours;
mod pairs;
mod scene;
mod surface;
mod tangle;
