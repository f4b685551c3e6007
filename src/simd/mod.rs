//! SIMD vectors, with run-time dispatch on the processor's features.
//!
//! Two layers, for two jobs. [`f64x4`] is for code that works on points: always four lanes, safe methods, sums across
//! the vector. [`lanes`] is for the dense kernels of the factorisation: as wide as the processor's registers, through
//! pointers, and every scalar goes through the same operations whatever the width, so that the factor has the same bits
//! with AVX2 and AVX-512. The crate `pulp`, which faer brings along, does a similar job; it is not used, because it
//! chooses the width and the order of sums by itself, and pinned results depend on both.

pub(crate) mod f64x4;
pub(crate) mod lanes;
