//! SIMD vectors of the processor's width, for the dense kernels of the factorisation in either precision, and run-time
//! dispatch to them.

use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Sub};

/// What the dense kernels compute with: 64 or 32 bits.
pub(crate) trait Scalar:
    Copy
    + Default
    + PartialOrd
    + Send
    + Sync
    + Add<Output = Self>
    + AddAssign
    + Div<Output = Self>
    + Mul<Output = Self>
    + MulAssign
    + Sub<Output = Self>
{
    /// 1.
    const ONE: Self;

    /// Vectors without intrinsics.
    type Portable: Lanes<Scalar = Self>;
    /// Vectors of 256 bits.
    #[cfg(target_arch = "x86_64")]
    type Avx2: Lanes<Scalar = Self>;
    /// Vectors of 512 bits.
    #[cfg(target_arch = "x86_64")]
    type Avx512: Lanes<Scalar = Self>;

    /// The nearest to `value`.
    fn nearest(value: f64) -> Self;
    /// Itself in 64 bits.
    fn widened(self) -> f64;
    /// The square root.
    fn root(self) -> Self;
    /// Neither infinite nor not a number.
    fn is_number(self) -> bool;
    /// `self - a * b`, rounded once.
    fn minus_fused(self, a: Self, b: Self) -> Self;
}

macro_rules! scalar {
    ($scalar:ident, $avx2:ident, $avx512:ident) => {
        impl Scalar for $scalar {
            const ONE: Self = 1.0;

            type Portable = Portable<$scalar>;
            #[cfg(target_arch = "x86_64")]
            type Avx2 = x86::$avx2;
            #[cfg(target_arch = "x86_64")]
            type Avx512 = x86::$avx512;

            #[inline(always)]
            fn nearest(value: f64) -> Self {
                value as $scalar
            }

            #[inline(always)]
            fn widened(self) -> f64 {
                f64::from(self)
            }

            #[inline(always)]
            fn root(self) -> Self {
                self.sqrt()
            }

            #[inline(always)]
            fn is_number(self) -> bool {
                self.is_finite()
            }

            #[inline(always)]
            fn minus_fused(self, a: Self, b: Self) -> Self {
                (-a).mul_add(b, self)
            }
        }
    };
}

scalar!(f64, Avx2, Avx512);
scalar!(f32, Avx2Single, Avx512Single);

/// A SIMD vector.
pub(crate) trait Lanes: Copy {
    /// A lane.
    type Scalar: Scalar;
    /// Vectors of as many lanes or fewer, no more than eight, for what is left of a multiple of eight rows.
    type Rest: Lanes<Scalar = Self::Scalar>;
    /// Number of lanes; divides 16.
    const COUNT: usize;
    /// Vectors of rows in a register tile of eight columns, at most.
    const STRIPS: usize;

    /// # Safety
    /// `COUNT` scalars can be read at `from`; the processor has the instructions.
    unsafe fn load(from: *const Self::Scalar) -> Self;

    /// # Safety
    /// `COUNT` scalars can be written at `to`; the processor has the instructions.
    unsafe fn store(self, to: *mut Self::Scalar);

    /// # Safety
    /// The processor has the instructions.
    unsafe fn splat(value: Self::Scalar) -> Self;

    /// `self * b`.
    ///
    /// # Safety
    /// The processor has the instructions.
    unsafe fn times(self, b: Self) -> Self;

    /// `self - a * b`.
    ///
    /// # Safety
    /// The processor has the instructions.
    unsafe fn minus_product(self, a: Self, b: Self) -> Self;

    /// `c - a * b` of single scalars, rounded as [`Self::minus_product`] does.
    fn scalar_minus_product(c: Self::Scalar, a: Self::Scalar, b: Self::Scalar) -> Self::Scalar;
}

/// Four scalars without intrinsics, for any processor. Multiply-adds are fused where the target always has them.
#[derive(Clone, Copy)]
pub(crate) struct Portable<T>([T; 4]);

impl<T: Scalar> Lanes for Portable<T> {
    type Scalar = T;
    type Rest = Self;
    const COUNT: usize = 4;
    const STRIPS: usize = 1;

    #[inline(always)]
    unsafe fn load(from: *const T) -> Self {
        // SAFETY: the caller's promise; arrays of scalars have no alignment of their own.
        Self(unsafe { from.cast::<[T; 4]>().read() })
    }

    #[inline(always)]
    unsafe fn store(self, to: *mut T) {
        // SAFETY: as above.
        unsafe { to.cast::<[T; 4]>().write(self.0) };
    }

    #[inline(always)]
    unsafe fn splat(value: T) -> Self {
        Self([value; 4])
    }

    #[inline(always)]
    unsafe fn times(self, b: Self) -> Self {
        Self(std::array::from_fn(|k| self.0[k] * b.0[k]))
    }

    #[inline(always)]
    unsafe fn minus_product(self, a: Self, b: Self) -> Self {
        Self(std::array::from_fn(|k| Self::scalar_minus_product(self.0[k], a.0[k], b.0[k])))
    }

    #[inline(always)]
    fn scalar_minus_product(c: T, a: T, b: T) -> T {
        if cfg!(any(target_arch = "aarch64", target_feature = "fma")) { c.minus_fused(a, b) } else { c - a * b }
    }
}

#[cfg(target_arch = "x86_64")]
pub(crate) mod x86 {
    //! Vectors with fused multiply-add: of 256 bits with AVX2, of 512 with AVX-512.

    use std::arch::x86_64::*;

    use super::Lanes;

    macro_rules! lanes {
        ($name:ident, $scalar:ident, $rest:ident, $vector:ty, $count:literal, $strips:literal, $load:ident, $store:ident, $splat:ident,
         $times:ident, $minus_product:ident) => {
            #[derive(Clone, Copy)]
            pub(crate) struct $name($vector);

            impl Lanes for $name {
                type Scalar = $scalar;
                type Rest = $rest;
                const COUNT: usize = $count;
                const STRIPS: usize = $strips;

                #[inline(always)]
                unsafe fn load(from: *const $scalar) -> Self {
                    // SAFETY: the caller's promise.
                    Self(unsafe { $load(from) })
                }

                #[inline(always)]
                unsafe fn store(self, to: *mut $scalar) {
                    // SAFETY: the caller's promise.
                    unsafe { $store(to, self.0) };
                }

                #[inline(always)]
                unsafe fn splat(value: $scalar) -> Self {
                    // SAFETY: the caller's promise.
                    Self(unsafe { $splat(value) })
                }

                #[inline(always)]
                unsafe fn times(self, b: Self) -> Self {
                    // SAFETY: the caller's promise.
                    Self(unsafe { $times(self.0, b.0) })
                }

                #[inline(always)]
                unsafe fn minus_product(self, a: Self, b: Self) -> Self {
                    // SAFETY: the caller's promise.
                    Self(unsafe { $minus_product(a.0, b.0, self.0) })
                }

                #[inline(always)]
                fn scalar_minus_product(c: $scalar, a: $scalar, b: $scalar) -> $scalar {
                    (-a).mul_add(b, c)
                }
            }
        };
    }

    lanes!(
        Avx2,
        f64,
        Avx2,
        __m256d,
        4,
        1,
        _mm256_loadu_pd,
        _mm256_storeu_pd,
        _mm256_set1_pd,
        _mm256_mul_pd,
        _mm256_fnmadd_pd
    );
    lanes!(
        Avx512,
        f64,
        Avx512,
        __m512d,
        8,
        3,
        _mm512_loadu_pd,
        _mm512_storeu_pd,
        _mm512_set1_pd,
        _mm512_mul_pd,
        _mm512_fnmadd_pd
    );
    lanes!(
        Avx2Single,
        f32,
        Avx2Single,
        __m256,
        8,
        1,
        _mm256_loadu_ps,
        _mm256_storeu_ps,
        _mm256_set1_ps,
        _mm256_mul_ps,
        _mm256_fnmadd_ps
    );
    lanes!(
        Avx512Single,
        f32,
        Avx2Single,
        __m512,
        16,
        3,
        _mm512_loadu_ps,
        _mm512_storeu_ps,
        _mm512_set1_ps,
        _mm512_mul_ps,
        _mm512_fnmadd_ps
    );
}

/// Run-time dispatch: calls a generic kernel, an unsafe function with a [`Lanes`] type as its first parameter, with the
/// widest vectors of this processor for the [`Scalar`] in brackets. The kernel is inlined there, so that it is compiled for
/// these instructions; the types of its arguments name the scalar `T`.
macro_rules! for_this_processor {
    ($kernel:ident<$scalar:ty>($($argument:ident: $type:ty),* $(,)?) $(-> $result:ty)?) => {{
        #[cfg(target_arch = "x86_64")]
        {
            #[target_feature(enable = "avx512f")]
            unsafe fn avx512<T: $crate::simd::lanes::Scalar>($($argument: $type),*) $(-> $result)? {
                // SAFETY: the processor has the instructions of this function; the rest is the caller's promise.
                unsafe { $kernel::<T::Avx512>($($argument),*) }
            }
            #[target_feature(enable = "avx2,fma")]
            unsafe fn avx2<T: $crate::simd::lanes::Scalar>($($argument: $type),*) $(-> $result)? {
                // SAFETY: as above.
                unsafe { $kernel::<T::Avx2>($($argument),*) }
            }
            if is_x86_feature_detected!("avx512f") {
                avx512::<$scalar>($($argument),*)
            } else if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
                avx2::<$scalar>($($argument),*)
            } else {
                $kernel::<<$scalar as $crate::simd::lanes::Scalar>::Portable>($($argument),*)
            }
        }
        #[cfg(not(target_arch = "x86_64"))]
        {
            $kernel::<<$scalar as $crate::simd::lanes::Scalar>::Portable>($($argument),*)
        }
    }};
}

pub(crate) use for_this_processor;
