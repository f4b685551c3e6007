//! What a caller hands in.

mod guide;
