
/* Dampers loaded from images in the resources folder, as Dashpot exports them; an image can be replaced by that of
 * another damper. */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "dampers.h"

const double dampers_largest_clearance_m = 0.1;

enum {
    PIECES = 64, /* per side */
    ROWS = DAMPER_ROWS_PER_PIECE * (2 * PIECES + 2),
    SCALARS = 11,
    WORDS_OF_PIECE = 13,
    IMAGE_WORDS = SCALARS + 2 + 2 * PIECES * WORDS_OF_PIECE,
    HEADER_BYTES = 16,
    IMAGE_BYTES = HEADER_BYTES + IMAGE_WORDS * DAMPER_REAL_BYTES + 4,
    IMAGE_VERSION = 4
};

/* Table in memory. */
typedef struct table {
    damper_row rows[ROWS];
    uint8_t bins[DAMPER_BINS][2];
} table;

/* CRC-32 (ISO-HDLC). */
static uint32_t crc_32(const uint8_t *bytes, size_t count)
{
    uint32_t crc = 0xffffffffU;
    int bit;

    while (count-- > 0) {
        crc ^= *bytes++;
        for (bit = 0; bit < 8; bit++) {
            crc = (crc >> 1) ^ ((crc & 1) != 0 ? UINT32_C(0xedb88320) : 0);
        }
    }
    return crc ^ 0xffffffffU;
}

static damper_real word(const uint8_t *image, unsigned number)
{
    return damper_real_of(
        (damper_bits)damper_get(image + HEADER_BYTES + number * DAMPER_REAL_BYTES, DAMPER_REAL_BYTES));
}

/* Numbers of a row of a piece. */
static damper_real *row(table *this, unsigned piece, unsigned number)
{
    return this->rows[DAMPER_ROWS_PER_PIECE * piece + number].numbers;
}

/* Finds the piece at the lower border of each bin of a side. The knots increase; the first is a power of two. */
static void index_side(table *this, unsigned side)
{
    const unsigned end = (side + 1) * PIECES;
    const damper_bits width = (damper_bits)1 << DAMPER_BIN_SHIFT;
    const damper_bits first = damper_bits_of(row(this, side * PIECES, DAMPER_KNOTS)[0]);
    unsigned piece, bin;

    for (piece = side * PIECES; piece < end; piece++) {
        row(this, piece, DAMPER_KNOTS)[1] = piece + 1 < end ? row(this, piece + 1, DAMPER_KNOTS)[0]
                                            : DAMPER_REAL_BYTES == 4 ? (damper_real)FLT_MAX
                                                                     : (damper_real)DBL_MAX;
    }
    piece = side * PIECES;
    for (bin = 0; bin < DAMPER_BINS; bin++) {
        const damper_bits border = (damper_bits)(first + width * bin);

        while (piece + 1 < end && damper_bits_of(row(this, piece + 1, DAMPER_KNOTS)[0]) <= border) {
            piece++;
        }
        this->bins[(unsigned)(border / width) % DAMPER_BINS][side] = (uint8_t)(2 * piece);
    }
}

/* Builds a damper from an image; returns a description of the problem, or NULL. */
static const char *load(damper_damper *damper, table *this, const uint8_t *image, size_t count)
{
    static const uint8_t magic[] = {'D', 'A', 'S', 'H', 0xff, 0xfe};
    damper_real bounds[3];
    damper_real *const scalars[SCALARS] = {
        &bounds[0],                &damper->position_rounder_m, &damper->rest_rounder_m,
        &damper->step_s,           &damper->offset_m,           &damper->first_knot_m,
        &damper->half_clearance_m, &damper->force_limit_n,      &damper->held_m,
        &bounds[1],                &bounds[2]
    };
    uint32_t hash = UINT32_C(0x811c9dc5);
    unsigned number, piece;

    if (count < HEADER_BYTES || memcmp(image, magic, sizeof magic) != 0) {
        return "not a damper image: it does not begin with DASH";
    }
    if (damper_get(image + 6, 2) != IMAGE_VERSION || damper_get(image + 8, 4) != DAMPER_REAL_BYTES) {
        return DAMPER_REAL_BYTES == 4 ? "an image of another version or scalar; allowed: one exported in f32"
                                      : "an image of another version or scalar; allowed: one exported in f64";
    }
    if (count != IMAGE_BYTES || damper_get(image + 12, 4) != IMAGE_BYTES) {
        return "an image that is cut short or too long";
    }
    if (crc_32(image, IMAGE_BYTES - 4) != damper_get(image + IMAGE_BYTES - 4, 4)) {
        return "a damaged image: its checksum is wrong";
    }
    for (number = 0; number < SCALARS; number++) {
        *scalars[number] = word(image, number);
        if (!(damper_is_finite(*scalars[number]) && *scalars[number] >= 0)) {
            return "an image with a constant out of range";
        }
    }
    damper->force_limit_n = damper->force_limit_n + damper->force_limit_n; /* an image contains half of it */
    damper->move_bound = damper_bits_of(bounds[0]);
    damper->displacement_bound = damper_bits_of(bounds[1]);
    memset(this->rows, 0, sizeof this->rows);
    for (piece = 0; piece < 2 * PIECES; piece++) {
        for (number = 0; number < WORDS_OF_PIECE; number++) {
            const damper_real value = word(image, SCALARS + 2 + piece * WORDS_OF_PIECE + number);

            if (!damper_is_finite(value)) {
                return "an image with a number that is not finite";
            }
            hash = damper_hash_real(hash, value);
            row(this, piece, number / 4)[number % 4] = value;
        }
    }
    index_side(this, 0);
    index_side(this, 1);
    damper->table_revision = (uint32_t)damper_get(image + HEADER_BYTES + (SCALARS + 1) * DAMPER_REAL_BYTES, 4);
    damper->rows = this->rows;
    damper->bins = (const uint8_t (*)[2])this->bins;
    if (hash != damper->table_revision
        || damper_set_clearance_m(damper, damper_clearance_m(damper)) != DAMPER_DONE
        || damper->revision != damper_get(image + HEADER_BYTES + SCALARS * DAMPER_REAL_BYTES, 4)
        || !(damper->move_bound > 0 && damper->first_knot_m > 0)
        || !(damper_largest_displacement_m(damper) >= (damper_real)1e-3)
        || !(damper_largest_displacement_m(damper) <= (damper_real)0.7)
        || !(damper->force_limit_n <= (damper_real)1e7)) {
        return "an image with inconsistent constants";
    }
    if (damper->step_s != dampers_as_built[0]->step_s) {
        return "an image for a different step than that of this FMU";
    }
    return NULL;
}

damper_damper *dampers_new(const char *resources, char *reason, size_t reason_bytes)
{
    const size_t memory = dampers_count * (sizeof(damper_damper) + sizeof(table));
    damper_damper *dampers = malloc(memory);
    table *tables = (table *)(void *)(dampers + dampers_count);
    unsigned number;

    if (dampers == NULL) {
        (void)snprintf(reason, reason_bytes, "not enough memory");
        return NULL;
    }
    for (number = 0; number < dampers_count; number++) {
        uint8_t image[IMAGE_BYTES + 1];
        char path[4096];
        const int length = snprintf(path, sizeof path, "%s/image_%u.bin", resources == NULL ? "" : resources, number + 1);
        FILE *file = resources != NULL && length > 0 && (size_t)length < sizeof path ? fopen(path, "rb") : NULL;
        const char *wrong = resources == NULL ? "the importer gave no resources folder" : "cannot be read";

        if (file != NULL) {
            wrong = load(&dampers[number], &tables[number], image, fread(image, 1, sizeof image, file));
            (void)fclose(file);
        }
        if (wrong != NULL) {
            (void)snprintf(reason, reason_bytes, "%s: %s", wrong, path);
            free(dampers);
            return NULL;
        }
    }
    return dampers;
}

void dampers_free(damper_damper *dampers)
{
    free(dampers);
}
