/* The forces equal those of the Rust model bit for bit only if the compiler rounds every operation once, in its own
 * type, and neither fuses nor reorders operations. Fusing is turned off below; do not request the other
 * optimisations. */
#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || defined(_M_FP_FAST) \
    || defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || defined(__NO_SIGNED_ZEROS__)
#error "the forces would not be those of the model: compile without -ffast-math and its parts (/fp:fast)"
#endif
#if defined(_MSC_VER) && !defined(__clang__)
#if defined(_M_IX86) && _M_IX86_FP < 2
#error "the forces would not be those of the model: on 32-bit x86 compile with /arch:SSE2"
#endif
#elif !defined(FLT_EVAL_METHOD) || (FLT_EVAL_METHOD != 0 && FLT_EVAL_METHOD != 16)
#error "the forces would not be those of the model: on 32-bit x86 compile with -msse2 -mfpmath=sse"
#endif
#if FLT_RADIX != 2 || FLT_MANT_DIG != 24 || DBL_MANT_DIG != 53
#error "floating-point numbers must be those of IEEE 754"
#endif

/* clang defines no macro for -funsafe-math-optimizations and its parts (-fassociative-math, -freciprocal-math,
 * -fno-signed-zeros), so no #error can detect them. Its pragmas turn them off; prefix_digest detects the rest. */
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#if defined(__x86_64__) || defined(__i386__)
#pragma float_control(precise, on, push)
#endif
#if __clang_major__ >= 12
#pragma clang fp reassociate(off)
#endif
#if __clang_major__ >= 18 && !defined(__apple_build_version__)
#pragma clang fp reciprocal(off)
#endif
#elif defined(__GNUC__)
#pragma GCC push_options
#pragma GCC optimize("fp-contract=off")
#elif defined(_MSC_VER)
#pragma fp_contract(off)
#else
#pragma STDC FP_CONTRACT OFF
#endif

#if defined(__GNUC__) || defined(__clang__)
#define PREFIX_INLINE static inline __attribute__((always_inline))
#elif defined(_MSC_VER)
#define PREFIX_INLINE static __forceinline
#else
#define PREFIX_INLINE static inline
#endif

/* Floating-point registers in inline assembly of GCC and clang. */
#if defined(__GNUC__) && defined(__SSE2__)
#define PREFIX_REGISTER "+x"
#elif defined(__GNUC__) && defined(__aarch64__)
#define PREFIX_REGISTER "+w"
#elif defined(__GNUC__) && defined(__ARM_FP) && SCALAR_BITS == 32
#define PREFIX_REGISTER "+t"
#endif

/* Keeps a product from being fused; an option of clang can override the pragma. */
#if defined(__clang__) && defined(PREFIX_REGISTER)
#define PREFIX_ROUND(product) __asm__("" : PREFIX_REGISTER(product))
#else
#define PREFIX_ROUND(product) ((void)0)
#endif

