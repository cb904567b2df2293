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
    use core::array;

    /// Whether `root` is nearer to the root of `value` than the points halfway to its neighbours, for
    /// significands and exponents: `value = v 2^e`, `root = r 2^k`. All sides are whole numbers.
    fn is_nearest(v: u64, e: i32, r: u64, k: i32) -> bool {
        // (2r - 1)^2 < 4 v 2^(e - 2k) < (2r + 1)^2; a root is never halfway.
        let Ok(shift) = u32::try_from(e + 2 - 2 * k) else {
            return false;
        };
        let (target, double) = (u128::from(v) << shift, 2 * u128::from(r));
        (double - 1).pow(2) < target && target < (double + 1).pow(2)
    }

    /// Significand and exponent of a normal, positive number.
    fn parts(bits: u64, digits: u32) -> (u64, i32) {
        let stored = digits - 1;
        let bias = if digits == 24 { 127 } else { 1023 };
        let significand = bits & ((1 << stored) - 1) | 1 << stored;
        (significand, (bits >> stored) as i32 - bias - stored as i32)
    }

    /// Positive normal numbers of every size, by a linear congruential generator.
    fn random() -> impl Iterator<Item = u64> {
        let mut seed = 0x9e37_79b9_7f4a_7c15_u64;
        core::iter::from_fn(move || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            Some(seed)
        })
        .take(100_000)
    }

    #[test]
    fn single_precision_is_correctly_rounded() {
        for seed in random() {
            let value = f32::from_bits((seed >> 33) as u32);
            if !value.is_normal() {
                continue;
            }
            let bits = [value, super::f32(value)].map(|x| u64::from(x.to_bits()));
            let [(v, e), (r, k)] = bits.map(|bits| parts(bits, f32::MANTISSA_DIGITS));
            assert!(is_nearest(v, e, r, k), "{value}");
        }
        let kept = [0.0, -0.0, 1.0, f32::INFINITY];
        assert_eq!(
            kept.map(super::f32).map(f32::to_bits),
            kept.map(f32::to_bits)
        );
        // 2^-148, the second smallest number there is.
        assert_eq!(super::f32(f32::from_bits(2)).to_bits(), (127 - 74) << 23);
        assert!(super::f32(-1.0).is_nan());
    }

    #[test]
    fn double_precision_is_correctly_rounded() {
        for seed in random() {
            let value = f64::from_bits(seed >> 1);
            if !value.is_normal() {
                continue;
            }
            let bits = [value, super::f64(value)].map(f64::to_bits);
            let [(v, e), (r, k)] = bits.map(|bits| parts(bits, f64::MANTISSA_DIGITS));
            assert!(is_nearest(v, e, r, k), "{value}");
        }
        let kept = [0.0, -0.0, 1.0, f64::INFINITY];
        assert_eq!(
            kept.map(super::f64).map(f64::to_bits),
            kept.map(f64::to_bits)
        );
        assert_eq!(super::f64(f64::from_bits(1)).to_bits(), (1023 - 537) << 52);
        assert!(super::f64(-1.0).is_nan());
    }

    #[test]
    fn the_check_sees_the_last_bit() {
        let (value, root) = (parts(2.0_f64.to_bits(), 53), super::f64(2.0).to_bits());
        let nearest: [bool; 3] = array::from_fn(|place| {
            let (r, k) = parts(root - 1 + place as u64, 53);
            is_nearest(value.0, value.1, r, k)
        });
        assert_eq!(nearest, [false, true, false]);
    }
}
