//! Elementary functions with the same bits on every system.
//!
//! What the standard library calls `ln`, `sin` and so on is the system's, and the last bit of its results differs between
//! systems, their versions and processors. A result must not depend on it, so that the sources call these instead;
//! `tests/geometry/maths.rs` finds who does not. Square roots and what rounds to whole numbers are exact everywhere, and are
//! taken from the standard library.

/// The natural logarithm.
#[inline]
pub fn ln(x: f64) -> f64 {
    libm::log(x)
}

/// The logarithm to the base 2.
#[inline]
pub fn log2(x: f64) -> f64 {
    libm::log2(x)
}

/// The logarithm to the base 10.
#[inline]
pub fn log10(x: f64) -> f64 {
    libm::log10(x)
}

/// e to the power of `x`.
#[inline]
pub fn exp(x: f64) -> f64 {
    libm::exp(x)
}

/// `base` to the power of `exponent`.
#[inline]
pub fn powf(base: f64, exponent: f64) -> f64 {
    libm::pow(base, exponent)
}

/// The cube root.
#[inline]
pub fn cbrt(x: f64) -> f64 {
    libm::cbrt(x)
}

/// Sine and cosine of an angle in radians.
#[inline]
pub fn sin_cos(angle: f64) -> (f64, f64) {
    libm::sincos(angle)
}

/// The sine of an angle in radians.
#[inline]
pub fn sin(angle: f64) -> f64 {
    libm::sin(angle)
}

/// The cosine of an angle in radians.
#[inline]
pub fn cos(angle: f64) -> f64 {
    libm::cos(angle)
}

/// The angle in radians, from 0 to pi, whose cosine is `cosine`; NaN beyond -1 and 1.
#[inline]
pub fn acos(cosine: f64) -> f64 {
    libm::acos(cosine)
}

/// The angle of the direction (`x`, `y`) in radians, from -pi to pi.
#[inline]
pub fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}
