
/* A number and its bits. */
typedef union prefix_word {
    float real;
    uint32_t bits;
} prefix_word;

static uint32_t prefix_bits_of(float value)
{
    prefix_word word;

    word.real = value;
    return word.bits;
}

static float prefix_real_of(uint32_t bits)
{
    prefix_word word;

    word.bits = bits;
    return word.real;
}

PREFIX_INLINE float prefix_magnitude(float value)
{
    return prefix_real_of(prefix_bits_of(value) & 0x7fffffffU);
}

/* The product a b, always rounded. */
PREFIX_INLINE float prefix_product(float a, float b)
{
    float product = a * b;

    PREFIX_ROUND(product);
    return product;
}

/* `value` limited to `most` in either direction; `most` if it is not a number. */
PREFIX_INLINE float prefix_clamped(float value, float most)
{
    return (value < most) ? ((value > -most) ? value : -most) : most;
}

/* `value` if its magnitude is at most `most`, else 0: a number that no sensor delivers must not spoil sums. */
PREFIX_INLINE float prefix_credible(float value, float most)
{
    return (prefix_magnitude(value) <= most) ? value : 0.0f;
}

/* Moves a mean by a share of the way to a value. */
PREFIX_INLINE void prefix_fade(float *mean, float fading, float value)
{
    *mean = *mean + prefix_product(fading, value - *mean);
}

/* The next three functions are those that the core uses, because a C library may round otherwise. They come from
 * FreeBSD's msun, through musl and Rust's libm:
 *
 * Copyright (C) 1993 by Sun Microsystems, Inc. All rights reserved.
 *
 * Developed at SunPro, a Sun Microsystems, Inc. business. Permission to use, copy, modify, and distribute this software
 * is freely granted, provided that this notice is preserved. */

/* The exponential of a number from -87 to 0. */
static float prefix_exponential(float x)
{
    const float half = 0.5f;
    const float inverse_ln2 = 1.4426950216f;
    const float ln2_high = 6.9314575195e-01f;
    const float ln2_low = 1.4286067653e-06f;
    const uint32_t magnitude = prefix_bits_of(x) & 0x7fffffffU;
    float high = x;
    float low = 0.0f;
    int32_t power = 0;

    if (magnitude > 0x3eb17218U) { /* ln2/2 */
        power = -1;
        if (magnitude > 0x3f851592U) { /* 1.5 ln2 */
            power = (int32_t)(prefix_product(inverse_ln2, x) - half);
        }
        high = x - prefix_product((float)power, ln2_high);
        low = prefix_product((float)power, ln2_low);
    }
    if (magnitude <= 0x39000000U) {
        return 1.0f + x;
    }
    const float r = high - low;
    const float square = prefix_product(r, r);
    const float c = r - prefix_product(square, 1.6666625440e-1f + prefix_product(square, -2.7667332906e-3f));
    const float y = 1.0f + ((((r * c) / (2.0f - c)) - low) + high);
    const int32_t exponent = power + 127;
    /* The power of two is not subnormal, as the number is at least -87. */
    return (power == 0) ? y : (y * prefix_real_of((uint32_t)exponent << 23U));
}

/* The arc tangent of a positive number. */
static float prefix_arc_tangent(float x)
{
    static const float highs[4] = {4.6364760399e-01f, 7.8539812565e-01f, 9.8279368877e-01f, 1.5707962513e+00f};
    static const float lows[4] = {5.0121582440e-09f, 3.7748947079e-08f, 3.4473217170e-08f, 7.5497894159e-08f};
    const uint32_t bits = prefix_bits_of(x);
    float y = x;
    int part = -1;

    if (bits >= 0x4c800000U) { /* 2^26 */
        return highs[3];
    }
    if (bits < 0x3ee00000U) {     /* 7/16 */
        if (bits < 0x39800000U) { /* 2^-12 */
            return x;
        }
    } else if (bits < 0x3f300000U) { /* 11/16 */
        part = 0;
        y = ((2.0f * x) - 1.0f) / (2.0f + x); /* the product is exact */
    } else if (bits < 0x3f980000U) { /* 19/16 */
        part = 1;
        y = (x - 1.0f) / (x + 1.0f);
    } else if (bits < 0x401c0000U) { /* 39/16 */
        part = 2;
        y = (x - 1.5f) / (1.0f + prefix_product(1.5f, x));
    } else {
        part = 3;
        y = -1.0f / x;
    }
    const float square = prefix_product(y, y);
    const float fourth = prefix_product(square, square);
    float even = 1.4253635705e-01f + prefix_product(fourth, 6.1687607318e-02f);
    even = prefix_product(square, 3.3333328366e-01f + prefix_product(fourth, even));
    float odd = -1.9999158382e-01f + prefix_product(fourth, -1.0648017377e-01f);
    odd = prefix_product(fourth, odd);
    if (part < 0) {
        return y - prefix_product(y, even + odd);
    }
    return highs[part] - ((prefix_product(y, even + odd) - lows[part]) - y);
}

/* The angle of the point (x, y), from -pi to pi, for finite numbers. */
static float prefix_angle(float y, float x)
{
    const float pi = 3.1415927410e+00f;
    const float pi_low = -8.7422776573e-08f;
    const float half_pi = pi / 2.0f;
    const uint32_t of_x = prefix_bits_of(x) & 0x7fffffffU;
    const uint32_t of_y = prefix_bits_of(y) & 0x7fffffffU;
    const bool is_left = (prefix_bits_of(x) >> 31U) != 0U;
    const bool is_below = (prefix_bits_of(y) >> 31U) != 0U;
    const uint32_t factor = 0x0d000000U; /* between the bits of two numbers of which one is 2^26 times the other */
    float angle;

    if ((of_x > 0x7f800000U) || (of_y > 0x7f800000U)) {
        return x + y;
    }
    if (of_y == 0U) {
        return is_left ? (is_below ? -pi : pi) : y;
    }
    if (prefix_bits_of(x) == 0x3f800000U) {
        angle = prefix_arc_tangent(prefix_magnitude(y));
        return is_below ? -angle : angle;
    }
    if ((of_x == 0U) || ((of_x + factor) < of_y)) {
        return is_below ? -half_pi : half_pi;
    }
    angle = (is_left && ((of_y + factor) < of_x)) ? 0.0f : prefix_arc_tangent(prefix_magnitude(y / x));
    if (is_left) {
        return is_below ? ((angle - pi_low) - pi) : (pi - (angle - pi_low));
    }
    return is_below ? -angle : angle;
}

/* The square root of a number that is 0 or positive, rounded to nearest, by integers. */
static float prefix_root(float value)
{
    const bool is_subnormal = prefix_bits_of(value) < 0x00800000U;
    /* 2^48 times a subnormal number is a normal one. */
    const float scale = is_subnormal ? 281474976710656.0f : 1.0f;
    const float root_of_scale = is_subnormal ? 16777216.0f : 1.0f;
    const uint32_t bits = prefix_bits_of(value * scale);
    uint32_t root = 0U;
    uint32_t bit;

    if ((bits == 0U) || (bits >= 0x7f800000U)) {
        return value;
    }
    /* The number is `square` of 49 or 50 bits times an even power of two; the root of `square` has 25 bits. */
    const bool is_even = ((bits >> 23U) % 2U) == 0U;
    const uint32_t mantissa = (bits & 0x7fffffU) | 0x800000U;
    const uint64_t square = (uint64_t)mantissa << (is_even ? 26U : 25U);
    for (bit = 0x1000000U; bit != 0U; bit >>= 1U) {
        const uint64_t tried = (uint64_t)root | (uint64_t)bit;

        if ((tried * tried) <= square) {
            root |= bit;
        }
    }
    /* The last bit rounds; a root of so many bits is never halfway between two numbers. */
    const uint32_t rounded = (root + 1U) >> 1U;
    return ((float)rounded * prefix_real_of((((bits >> 23U) + 81U) / 2U) << 23U)) / root_of_scale;
}
