/* Numbers as bytes, little-endian on any processor. */

#include "model.h"

typedef union real_bits {
    double real;
    uint64_t bits;
} real_bits;

uint8_t *model_put(uint8_t *to, uint64_t value, unsigned bytes)
{
    unsigned byte;

    for (byte = 0; byte < bytes; byte++) {
        *to++ = (uint8_t)(value >> 8 * byte & 0xff);
    }
    return to;
}

const uint8_t *model_take(const uint8_t *from, uint64_t *value, unsigned bytes)
{
    unsigned byte;

    *value = 0;
    for (byte = 0; byte < bytes; byte++) {
        *value |= (uint64_t)*from++ << 8 * byte;
    }
    return from;
}

uint8_t *model_put_real(uint8_t *to, double value)
{
    real_bits word;

    word.real = value;
    return model_put(to, word.bits, 8);
}

const uint8_t *model_take_real(const uint8_t *from, double *value)
{
    real_bits word;

    from = model_take(from, &word.bits, 8);
    *value = word.real;
    return from;
}
