//! Choice of the vectors that code is compiled for.

/// Runs code with AVX2 or with SSE2 on x86-64, by what `level` proves, and with the vectors of other processors.
///
/// `fearless_simd::dispatch` also compiles the code for SSE4.2 and AVX-512. That would double the time in which this
/// crate is compiled; SSE4.2 has nothing that the code uses, and few of its vectors are wider than 256 bits.
macro_rules! dispatch {
    ($level:expr, $simd:ident => $work:expr) => {{
        let level: ::fearless_simd::Level = $level;
        #[cfg(target_arch = "x86_64")]
        {
            if let Some($simd) = level.as_avx2() {
                ::fearless_simd::Simd::vectorize($simd, #[inline(always)] || $work)
            } else if let Some($simd) = level.as_sse2() {
                ::fearless_simd::Simd::vectorize($simd, #[inline(always)] || $work)
            } else {
                unreachable!("x86-64 has SSE2")
            }
        }
        #[cfg(not(target_arch = "x86_64"))]
        ::fearless_simd::dispatch!(level, $simd => $work)
    }};
}
pub(crate) use dispatch;
