
#undef PREFIX_INLINE
#undef PREFIX_COLD
#undef PREFIX_REGISTER
#undef PREFIX_ROUND
#undef PREFIX_ALWAYS
#undef PREFIX_HAS_MAXIMUM
#undef PREFIX_GAMMA
#undef PREFIX_REST_OF_GAMMA
#undef PREFIX_LARGEST_CORRECTION
#undef PREFIX_LARGEST_FORCE_N
#undef PREFIX_LARGEST_CLEARANCE_M
#undef PREFIX_LARGEST_BOUND_M
#undef PREFIX_CATCH_UP_S
#undef PREFIX_LEAST_FALL
#undef PREFIX_MARK
#undef PREFIX_MARK_BITS
#undef PREFIX_HASH_START
#undef PREFIX_HASH_FACTOR
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC pop_options
#elif defined(__clang__) && (defined(__x86_64__) || defined(__i386__))
#pragma float_control(pop)
#endif
