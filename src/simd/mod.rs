//! Vectors of the processor, chosen while running.
//!
//! Two layers, for two jobs. [`four`] is for code that works on points: always four doubles, safe methods, sums across the
//! vector. [`lanes`] is for the dense kernels of the factorisation: as wide as the processor has it, through pointers,
//! and every scalar goes through the same operations whatever the width, so that the factor has the same bits with AVX2
//! and AVX-512. The crate `pulp`, which faer brings along, does a similar job; it is not taken, for it chooses the
//! width and the order of sums by itself, and pinned results depend on both.

pub(crate) mod four;
pub(crate) mod lanes;
