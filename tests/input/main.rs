//! What a caller hands in: checks, connectivity, skeleton, weights, buffers, spaces, guides of boundary loops.

mod body;
mod buffer;
mod guide;
mod skeleton;
mod skin;
mod space;
mod weld;
