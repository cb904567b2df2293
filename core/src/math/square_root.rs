//! Correctly rounded square roots: the one file with `unsafe`, for the processor's instruction.
//!
//! Every path rounds as IEEE 754 asks, so all of them return the same bits. No path is chosen by a
//! feature that stable compilers hide, as they do those of Arm: `build.rs` finds out, and warns where the
//! root is software on a processor that may have the instruction.
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
    #[cfg(all(target_arch = "aarch64", target_feature = "neon"))]
    {
        let root: f32;
        // SAFETY: FSQRT reads and writes only the two registers named; every AArch64 FPU has it.
        unsafe {
            core::arch::asm!("fsqrt {root:s}, {value:s}", root = lateout(vreg) root,
                value = in(vreg) value, options(pure, nomem, nostack, preserves_flags));
        }
        root
    }
    #[cfg(double_registers)]
    {
        let root: f32;
        // SAFETY: VSQRT.F32 reads and writes only the two registers named; the build found the FPU.
        unsafe {
            core::arch::asm!("vsqrt.f32 {root}, {value}", root = lateout(sreg) root,
                value = in(sreg) value, options(pure, nomem, nostack, preserves_flags));
        }
        root
    }
    // Of an FPU without double precision the compiler takes no register as an operand, only as clobbered.
    #[cfg(all(target_arch = "arm", target_abi = "eabihf", not(double_registers)))]
    {
        let root: u32;
        // SAFETY: every FPU has VSQRT.F32, and hard-float calls need an FPU; s0 and the operand are named.
        unsafe {
            core::arch::asm!("vmov s0, {bits}", "vsqrt.f32 s0, s0", "vmov {bits}, s0",
                bits = inlateout(reg) value.to_bits() => root, lateout("s0") _,
                options(pure, nomem, nostack, preserves_flags));
        }
        f32::from_bits(root)
    }
    #[cfg(not(any(
        all(target_arch = "x86_64", target_feature = "sse2"),
        all(target_arch = "aarch64", target_feature = "neon"),
        double_registers,
        all(target_arch = "arm", target_abi = "eabihf")
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
    #[cfg(all(target_arch = "aarch64", target_feature = "neon"))]
    {
        let root: f64;
        // SAFETY: as for single precision.
        unsafe {
            core::arch::asm!("fsqrt {root:d}, {value:d}", root = lateout(vreg) root,
                value = in(vreg) value, options(pure, nomem, nostack, preserves_flags));
        }
        root
    }
    #[cfg(double_registers)]
    {
        let root: f64;
        // SAFETY: as for single precision; the build found the double registers.
        unsafe {
            core::arch::asm!("vsqrt.f64 {root}, {value}", root = lateout(dreg_low16) root,
                value = in(dreg_low16) value, options(pure, nomem, nostack, preserves_flags));
        }
        root
    }
    #[cfg(not(any(
        all(target_arch = "x86_64", target_feature = "sse2"),
        all(target_arch = "aarch64", target_feature = "neon"),
        double_registers
    )))]
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
