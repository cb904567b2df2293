//! Correctly rounded square roots: the one file with `unsafe`, for the processor's instruction.
//!
//! Every path rounds as IEEE 754 asks, so all of them return the same bits.
#![allow(unsafe_code)]

/// Square root of `value`, correctly rounded.
#[inline(always)]
pub(crate) fn f32(value: f32) -> f32 {
    #[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
    {
        use core::arch::x86_64::{_mm_cvtss_f32, _mm_set_ss, _mm_sqrt_ss};
        // SAFETY: the intrinsics need SSE2 only, which the surrounding cfg guarantees.
        unsafe { _mm_cvtss_f32(_mm_sqrt_ss(_mm_set_ss(value))) }
    }
    #[cfg(all(target_arch = "arm", target_feature = "vfp2"))]
    {
        let root: f32;
        // SAFETY: VSQRT.F32 reads and writes only the two registers named; the cfg guarantees it.
        unsafe {
            core::arch::asm!("vsqrt.f32 {root}, {value}", root = lateout(sreg) root,
                value = in(sreg) value, options(pure, nomem, nostack, preserves_flags));
        }
        root
    }
    #[cfg(not(any(
        all(target_arch = "x86_64", target_feature = "sse2"),
        all(target_arch = "arm", target_feature = "vfp2")
    )))]
    {
        libm::sqrtf(value)
    }
}

/// Square root of `value`, correctly rounded.
#[inline(always)]
pub(crate) fn f64(value: f64) -> f64 {
    #[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
    {
        use core::arch::x86_64::{_mm_cvtsd_f64, _mm_set_sd, _mm_sqrt_sd};
        // SAFETY: the intrinsics need SSE2 only, which the surrounding cfg guarantees.
        unsafe { _mm_cvtsd_f64(_mm_sqrt_sd(_mm_set_sd(0.0), _mm_set_sd(value))) }
    }
    #[cfg(not(all(target_arch = "x86_64", target_feature = "sse2")))]
    {
        libm::sqrt(value)
    }
}

#[cfg(test)]
mod tests {
    /// The instruction and the software root of another author agree bit for bit.
    #[test]
    fn agrees_with_libm() {
        let mut seed = 0x9e37_79b9_u32;
        for _ in 0..100_000 {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let single = f32::from_bits(seed & 0x7f7f_ffff);
            assert_eq!(super::f32(single).to_bits(), libm::sqrtf(single).to_bits());
            let double = f64::from(single) * 1.000_000_1;
            assert_eq!(super::f64(double).to_bits(), libm::sqrt(double).to_bits());
        }
        assert_eq!(super::f32(-0.0).to_bits(), (-0.0_f32).to_bits());
        assert_eq!(super::f32(1e-40).to_bits(), libm::sqrtf(1e-40).to_bits());
    }
}
