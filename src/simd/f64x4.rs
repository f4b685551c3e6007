//! SIMD vectors of four doubles, and run-time dispatch between AVX2 and portable code.

#[cfg(target_arch = "x86_64")]
use std::arch::x86_64::*;

/// A SIMD vector of four doubles.
pub(crate) trait F64x4: Copy {
    /// All lanes equal to `value`.
    fn splat(value: f64) -> Self;

    /// Loads from an array.
    fn load(values: &[f64; 4]) -> Self;

    /// Stores to an array.
    fn store(self, to: &mut [f64; 4]);

    /// Converts from single precision.
    fn widen(values: [f32; 4]) -> Self;

    /// `self + factor * other`, fused where the processor has it.
    fn add_scaled(self, factor: f64, other: Self) -> Self;

    /// The inner product with `other`.
    fn dot(self, other: [f64; 4]) -> f64;
}

/// Four doubles without intrinsics, for any processor.
#[derive(Clone, Copy)]
struct Portable([f64; 4]);

impl F64x4 for Portable {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self([value; 4])
    }

    #[inline(always)]
    fn load(values: &[f64; 4]) -> Self {
        Self(*values)
    }

    #[inline(always)]
    fn store(self, to: &mut [f64; 4]) {
        *to = self.0;
    }

    #[inline(always)]
    fn widen(values: [f32; 4]) -> Self {
        Self(values.map(f64::from))
    }

    #[inline(always)]
    fn add_scaled(self, factor: f64, other: Self) -> Self {
        // On 64-bit Arm fused multiply-add is a base instruction.
        let one = |k| {
            let (s, o): (f64, f64) = (self.0[k], other.0[k]);
            if cfg!(target_arch = "aarch64") { factor.mul_add(o, s) } else { s + factor * o }
        };
        Self([one(0), one(1), one(2), one(3)])
    }

    #[inline(always)]
    fn dot(self, other: [f64; 4]) -> f64 {
        let [a, b, c, d] = self.0;
        (a * other[0] + c * other[2]) + (b * other[1] + d * other[3])
    }
}

/// Four doubles in one AVX register. Only code that [`dispatch`] instantiates with it may use it.
#[cfg(target_arch = "x86_64")]
#[derive(Clone, Copy)]
struct Avx2(__m256d);

// SAFETY, of all its functions: `dispatch` alone names the type, after it has checked that the processor has AVX2 and FMA.
#[cfg(target_arch = "x86_64")]
impl F64x4 for Avx2 {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        // SAFETY: above.
        Self(unsafe { _mm256_set1_pd(value) })
    }

    #[inline(always)]
    fn load(values: &[f64; 4]) -> Self {
        // SAFETY: above; the load needs no alignment, and four numbers are there.
        Self(unsafe { _mm256_loadu_pd(values.as_ptr()) })
    }

    #[inline(always)]
    fn store(self, to: &mut [f64; 4]) {
        // SAFETY: above; the store needs no alignment, and there is room for four numbers.
        unsafe { _mm256_storeu_pd(to.as_mut_ptr(), self.0) }
    }

    #[inline(always)]
    fn widen(values: [f32; 4]) -> Self {
        // SAFETY: above; the load needs no alignment, and four numbers are there.
        Self(unsafe { _mm256_cvtps_pd(_mm_loadu_ps(values.as_ptr())) })
    }

    #[inline(always)]
    fn add_scaled(self, factor: f64, other: Self) -> Self {
        // SAFETY: above.
        Self(unsafe { _mm256_fmadd_pd(_mm256_set1_pd(factor), other.0, self.0) })
    }

    #[inline(always)]
    fn dot(self, other: [f64; 4]) -> f64 {
        // SAFETY: above; the load needs no alignment, and four numbers are there.
        unsafe {
            let product = _mm256_mul_pd(self.0, _mm256_loadu_pd(other.as_ptr()));
            let pair = _mm_add_pd(_mm256_castpd256_pd128(product), _mm256_extractf128_pd::<1>(product));
            _mm_cvtsd_f64(_mm_add_sd(pair, _mm_unpackhi_pd(pair, pair)))
        }
    }
}

/// Code that is compiled once for each vector type. `run`, and all generic functions that it calls with `V`, have to be
/// `#[inline(always)]`.
pub(crate) trait Kernel {
    /// The result.
    type Output;

    /// Runs the code.
    fn run<V: F64x4>(self) -> Self::Output;
}

/// Runs `kernel` with the best vector type for this processor: the same one at every call, so that results have the
/// same bits. Between processors with and without fused multiply-add they differ by rounding.
#[inline]
pub(crate) fn dispatch<K: Kernel>(kernel: K) -> K::Output {
    #[cfg(target_arch = "x86_64")]
    {
        #[target_feature(enable = "avx2,fma")]
        fn avx2<K: Kernel>(kernel: K) -> K::Output {
            kernel.run::<Avx2>()
        }
        if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
            // SAFETY: the processor has what the function is compiled for.
            return unsafe { avx2(kernel) };
        }
    }
    kernel.run::<Portable>()
}
