//! SIMD vectors of the processor's width, for the dense kernels of the factorisation, and run-time dispatch to them.

/// A SIMD vector of doubles.
pub(crate) trait Lanes: Copy {
    /// Number of lanes; divides 8.
    const COUNT: usize;
    /// Vectors of rows in a register tile of eight columns, at most.
    const STRIPS: usize;

    /// # Safety
    /// `COUNT` scalars can be read at `from`; the processor has the instructions.
    unsafe fn load(from: *const f64) -> Self;

    /// # Safety
    /// `COUNT` scalars can be written at `to`; the processor has the instructions.
    unsafe fn store(self, to: *mut f64);

    /// # Safety
    /// The processor has the instructions.
    unsafe fn splat(value: f64) -> Self;

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
    fn scalar_minus_product(c: f64, a: f64, b: f64) -> f64;
}

/// Four doubles without intrinsics, for any processor. Multiply-adds are fused where the target always has them.
#[derive(Clone, Copy)]
pub(crate) struct Portable([f64; 4]);

impl Lanes for Portable {
    const COUNT: usize = 4;
    const STRIPS: usize = 1;

    #[inline(always)]
    unsafe fn load(from: *const f64) -> Self {
        // SAFETY: the caller's promise; arrays of scalars have no alignment of their own.
        Self(unsafe { from.cast::<[f64; 4]>().read() })
    }

    #[inline(always)]
    unsafe fn store(self, to: *mut f64) {
        // SAFETY: as above.
        unsafe { to.cast::<[f64; 4]>().write(self.0) };
    }

    #[inline(always)]
    unsafe fn splat(value: f64) -> Self {
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
    fn scalar_minus_product(c: f64, a: f64, b: f64) -> f64 {
        if cfg!(any(target_arch = "aarch64", target_feature = "fma")) { (-a).mul_add(b, c) } else { c - a * b }
    }
}

#[cfg(target_arch = "x86_64")]
pub(crate) mod x86 {
    //! Vectors with fused multiply-add: four doubles with AVX2, eight with AVX-512.

    use std::arch::x86_64::*;

    use super::Lanes;

    macro_rules! lanes {
        ($name:ident, $vector:ty, $count:literal, $strips:literal, $load:ident, $store:ident, $splat:ident, $times:ident,
         $minus_product:ident) => {
            #[derive(Clone, Copy)]
            pub(crate) struct $name($vector);

            impl Lanes for $name {
                const COUNT: usize = $count;
                const STRIPS: usize = $strips;

                #[inline(always)]
                unsafe fn load(from: *const f64) -> Self {
                    // SAFETY: the caller's promise.
                    Self(unsafe { $load(from) })
                }

                #[inline(always)]
                unsafe fn store(self, to: *mut f64) {
                    // SAFETY: the caller's promise.
                    unsafe { $store(to, self.0) };
                }

                #[inline(always)]
                unsafe fn splat(value: f64) -> Self {
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
                fn scalar_minus_product(c: f64, a: f64, b: f64) -> f64 {
                    (-a).mul_add(b, c)
                }
            }
        };
    }

    lanes!(Avx2, __m256d, 4, 1, _mm256_loadu_pd, _mm256_storeu_pd, _mm256_set1_pd, _mm256_mul_pd, _mm256_fnmadd_pd);
    lanes!(Avx512, __m512d, 8, 3, _mm512_loadu_pd, _mm512_storeu_pd, _mm512_set1_pd, _mm512_mul_pd, _mm512_fnmadd_pd);
}

/// Run-time dispatch: calls a generic kernel, an unsafe function with a [`Lanes`] type as its first parameter, with the
/// widest vectors of this processor. The kernel is inlined there, so that it is compiled for these instructions.
macro_rules! for_this_processor {
    ($kernel:ident($($argument:ident: $type:ty),* $(,)?) $(-> $result:ty)?) => {{
        #[cfg(target_arch = "x86_64")]
        {
            use $crate::simd::lanes::x86;

            #[target_feature(enable = "avx512f")]
            unsafe fn avx512($($argument: $type),*) $(-> $result)? {
                // SAFETY: the processor has the instructions of this function; the rest is the caller's promise.
                unsafe { $kernel::<x86::Avx512>($($argument),*) }
            }
            #[target_feature(enable = "avx2,fma")]
            unsafe fn avx2($($argument: $type),*) $(-> $result)? {
                // SAFETY: as above.
                unsafe { $kernel::<x86::Avx2>($($argument),*) }
            }
            if is_x86_feature_detected!("avx512f") {
                avx512($($argument),*)
            } else if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
                avx2($($argument),*)
            } else {
                $kernel::<$crate::simd::lanes::Portable>($($argument),*)
            }
        }
        #[cfg(not(target_arch = "x86_64"))]
        {
            $kernel::<$crate::simd::lanes::Portable>($($argument),*)
        }
    }};
}

pub(crate) use for_this_processor;
