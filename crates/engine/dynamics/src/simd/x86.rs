//! AVX-512 and AVX2.
//!
//! Why: over plain arrays of eight numbers the compiler keeps no kernel of this size in vector registers. One fixed RK4
//! step of the full tensor model, eight lanes: 320 to 570 ns over arrays, 46 to 54 ns over these registers (docs/records/lanes.md).
//! The crate that offers safe registers uses AVX-512 only from Ice Lake on; what is used here is older (F, DQ, VL).
//!
//! Why it is sound: the instructions are called only through [`Zmm`] and [`Ymm`], both private to this module, which
//! are used only as type arguments of kernels run by [`run_lanes`], after the processor was asked. A value of either
//! type therefore exists only where its instructions do. Tests: `tests/all/lanes.rs`, every operation against `f64`.

#![allow(unsafe_code, reason = "vector instructions; see above")]

use super::{InstructionSet, Kernel, LaneKernel, Packed, Registers};
use std::arch::x86_64::*;
use std::sync::OnceLock;

/// The instruction sets of this processor.
pub(super) fn widest() -> InstructionSet {
    static WIDEST: OnceLock<InstructionSet> = OnceLock::new();
    *WIDEST.get_or_init(|| {
        let avx2 = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
        let avx512 = is_x86_feature_detected!("avx512f")
            && is_x86_feature_detected!("avx512dq")
            && is_x86_feature_detected!("avx512vl");
        match (avx2, avx512) {
            (true, true) => InstructionSet::Avx512,
            (true, false) => InstructionSet::Avx2,
            (false, _) => InstructionSet::Portable,
        }
    })
}

/// Runs plain loops with the widest available instructions.
#[inline]
pub(super) fn run<K: Kernel>(kernel: K) -> K::Output {
    // 256 bits also where there are 512: short loops over slices gain nothing from wider registers.
    match widest() {
        // SAFETY: `widest` has found AVX2 and FMA.
        InstructionSet::Avx2 | InstructionSet::Avx512 => unsafe { loops(kernel) },
        _ => kernel.run(),
    }
}

#[target_feature(enable = "avx2,fma")]
fn loops<K: Kernel>(kernel: K) -> K::Output {
    kernel.run()
}

/// Runs a lane kernel with the instructions of `set`, or the widest available; one of the two must not be portable.
pub(super) fn run_lanes<K: LaneKernel>(set: InstructionSet, kernel: K) -> K::Output {
    if K::WIDE && set.min(widest()) == InstructionSet::Avx512 {
        // SAFETY: `widest` has found the instructions.
        return unsafe { avx512(kernel) };
    }
    // SAFETY: as above.
    unsafe { avx2(kernel) }
}

#[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma")]
fn avx512<K: LaneKernel>(kernel: K) -> K::Output {
    kernel.run::<Packed<Zmm>>()
}

#[target_feature(enable = "avx2,fma")]
fn avx2<K: LaneKernel>(kernel: K) -> K::Output {
    kernel.run::<Packed<Ymm>>()
}

/// [`Registers`] for a register of `$lanes` lanes: common parts of both widths, and below the differences.
///
/// SAFETY of every block: a value of `$name` exists only inside the function that was compiled for its instructions (see above). Loads
/// and stores stay inside the slices, which are cut to the lanes first.
macro_rules! registers {
    ($name:ident, $lanes:literal, $features:literal, $splat:ident $add:ident $sub:ident $mul:ident $div:ident
        $sqrt:ident $max:ident $min:ident, $($rest:tt)*) => {
        impl Registers for $name {
            const LANES: usize = $lanes;

            // Loads and stores are plain copies, no intrinsics: those would be calls where code that was not compiled for them
            // reads single lanes.
            #[inline(always)]
            fn load(lanes: &[f64]) -> Self {
                unsafe { lanes[..$lanes].as_ptr().cast::<Self>().read_unaligned() }
            }

            #[inline(always)]
            fn store(self, lanes: &mut [f64]) {
                unsafe { lanes[..$lanes].as_mut_ptr().cast::<Self>().write_unaligned(self) };
            }

            #[inline(always)]
            fn splat(value: f64) -> Self {
                unsafe { Self($splat(value)) }
            }

            #[inline(always)]
            fn add(self, other: Self) -> Self {
                unsafe { Self($add(self.0, other.0)) }
            }

            #[inline(always)]
            fn sub(self, other: Self) -> Self {
                unsafe { Self($sub(self.0, other.0)) }
            }

            #[inline(always)]
            fn mul(self, other: Self) -> Self {
                unsafe { Self($mul(self.0, other.0)) }
            }

            #[inline(always)]
            fn div(self, other: Self) -> Self {
                unsafe { Self($div(self.0, other.0)) }
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                unsafe { Self($sqrt(self.0)) }
            }

            // The instruction gives its second operand where neither is larger, or one is not a number.
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                unsafe { Self($max(other.0, self.0)) }
            }

            #[inline(always)]
            fn min(self, other: Self) -> Self {
                unsafe { Self($min(other.0, self.0)) }
            }

            #[inline(always)]
            fn apart<K: Kernel>(kernel: K) -> K::Output {
                #[target_feature(enable = $features)]
                #[inline(never)]
                fn apart<K: Kernel>(kernel: K) -> K::Output {
                    kernel.run()
                }
                unsafe { apart(kernel) }
            }

            $($rest)*
        }
    };
}

/// One 512-bit register.
#[derive(Clone, Copy)]
#[repr(transparent)]
struct Zmm(__m512d);

registers! { Zmm, 8, "avx512f,avx512dq,avx512vl,avx2,fma", _mm512_set1_pd _mm512_add_pd _mm512_sub_pd _mm512_mul_pd _mm512_div_pd
    _mm512_sqrt_pd _mm512_max_pd _mm512_min_pd,

    #[inline(always)]
    fn abs(self) -> Self {
        unsafe { Self(_mm512_abs_pd(self.0)) }
    }

    #[inline(always)]
    fn less(self, other: Self) -> u16 {
        unsafe { u16::from(_mm512_cmp_pd_mask::<_CMP_LT_OQ>(self.0, other.0)) }
    }

    #[inline(always)]
    fn at_most(self, other: Self) -> u16 {
        unsafe { u16::from(_mm512_cmp_pd_mask::<_CMP_LE_OQ>(self.0, other.0)) }
    }

    #[inline(always)]
    #[allow(clippy::cast_possible_truncation, reason = "the other bits belong to other registers")]
    fn select(mask: u16, a: Self, b: Self) -> Self {
        unsafe { Self(_mm512_mask_blend_pd(mask as u8, b.0, a.0)) }
    }
}

/// One 256-bit register.
#[derive(Clone, Copy)]
#[repr(transparent)]
struct Ymm(__m256d);

registers! { Ymm, 4, "avx2,fma", _mm256_set1_pd _mm256_add_pd _mm256_sub_pd _mm256_mul_pd _mm256_div_pd
    _mm256_sqrt_pd _mm256_max_pd _mm256_min_pd,

    #[inline(always)]
    fn abs(self) -> Self {
        unsafe { Self(_mm256_andnot_pd(_mm256_set1_pd(-0.0), self.0)) }
    }

    #[inline(always)]
    #[allow(clippy::cast_sign_loss, clippy::cast_possible_truncation, reason = "four bits")]
    fn less(self, other: Self) -> u16 {
        unsafe { _mm256_movemask_pd(_mm256_cmp_pd::<_CMP_LT_OQ>(self.0, other.0)) as u16 }
    }

    #[inline(always)]
    #[allow(clippy::cast_sign_loss, clippy::cast_possible_truncation, reason = "four bits")]
    fn at_most(self, other: Self) -> u16 {
        unsafe { _mm256_movemask_pd(_mm256_cmp_pd::<_CMP_LE_OQ>(self.0, other.0)) as u16 }
    }

    #[inline(always)]
    fn select(mask: u16, a: Self, b: Self) -> Self {
        unsafe {
            let bits = _mm256_set_epi64x(8, 4, 2, 1);
            let set = _mm256_and_si256(_mm256_set1_epi64x(i64::from(mask)), bits);
            let lanes = _mm256_castsi256_pd(_mm256_cmpeq_epi64(set, bits));
            Self(_mm256_blendv_pd(b.0, a.0, lanes))
        }
    }
}
