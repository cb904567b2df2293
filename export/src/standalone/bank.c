
/* A bank in vectors of four dampers. The operations and their order are those of prefix_step, so the bits are the same.
 * GCC and clang have vectors in C; for another compiler or processor, dampers are stepped one by one. */
#if SCALAR_BITS == 32 && defined(__GNUC__) && (defined(__SSE2__) || (defined(__aarch64__) && !defined(__AARCH64EB__)))
#define PREFIX_HAS_VECTORS 1

#include <stddef.h>

#if defined(__clang__)
#define PREFIX_SHUFFLE(a, b, i, j, k, l) __builtin_shufflevector(a, b, i, j, k, l)
#else
#define PREFIX_SHUFFLE(a, b, i, j, k, l) __builtin_shuffle(a, b, (prefix_mask){i, j, k, l})
#endif

enum {
    PREFIX_LANES = 4,
    /* The processor works on one vector while the other waits for a result. */
    PREFIX_VECTORS = 2,
    PREFIX_GROUP = PREFIX_LANES * PREFIX_VECTORS
};

/* A number of each lane, and for each lane all bits set (true) or none. */
typedef prefix_real prefix_vector __attribute__((vector_size(16)));
typedef int32_t prefix_mask __attribute__((vector_size(16)));

PREFIX_INLINE prefix_vector prefix_splat(prefix_real value)
{
    return (prefix_vector){value, value, value, value};
}

PREFIX_INLINE prefix_vector prefix_choose(prefix_mask mask, prefix_vector yes, prefix_vector no)
{
    return (prefix_vector)(((prefix_mask)yes & mask) | ((prefix_mask)no & ~mask));
}

PREFIX_INLINE prefix_vector prefix_magnitudes(prefix_vector values)
{
    return (prefix_vector)((prefix_mask)values & INT32_MAX);
}

/* Like prefix_larger and prefix_smaller: if one number is NaN, the result is the second. */
PREFIX_INLINE prefix_vector prefix_larger_of(prefix_vector values, prefix_vector others)
{
    return prefix_choose(values > others, values, others);
}

PREFIX_INLINE prefix_vector prefix_smaller_of(prefix_vector values, prefix_vector others)
{
    return prefix_choose(values < others, values, others);
}

PREFIX_INLINE prefix_vector prefix_products(prefix_vector a, prefix_vector b)
{
    prefix_vector products = a * b;

    PREFIX_ROUND(products);
    return products;
}

PREFIX_INLINE prefix_vector prefix_load(const prefix_real *numbers)
{
    prefix_vector vector;

    __builtin_memcpy(&vector, numbers, sizeof vector);
    return vector;
}

/* Transposes four rows of four numbers. */
PREFIX_INLINE void prefix_transpose(prefix_vector rows[4])
{
    const prefix_vector low_01 = PREFIX_SHUFFLE(rows[0], rows[1], 0, 4, 1, 5);
    const prefix_vector high_01 = PREFIX_SHUFFLE(rows[0], rows[1], 2, 6, 3, 7);
    const prefix_vector low_23 = PREFIX_SHUFFLE(rows[2], rows[3], 0, 4, 1, 5);
    const prefix_vector high_23 = PREFIX_SHUFFLE(rows[2], rows[3], 2, 6, 3, 7);

    rows[0] = PREFIX_SHUFFLE(low_01, low_23, 0, 1, 4, 5);
    rows[1] = PREFIX_SHUFFLE(low_01, low_23, 2, 3, 6, 7);
    rows[2] = PREFIX_SHUFFLE(high_01, high_23, 0, 1, 4, 5);
    rows[3] = PREFIX_SHUFFLE(high_01, high_23, 2, 3, 6, 7);
}

/* Four consecutive numbers of each lane, as columns: the first at `first`, those of the next lane `stride` bytes on. */
PREFIX_INLINE void prefix_columns(prefix_vector columns[4], const prefix_real *first, size_t stride)
{
    unsigned lane;

    for (lane = 0; lane < PREFIX_LANES; lane++) {
        columns[lane] = prefix_load((const prefix_real *)(const void *)((const char *)first + lane * stride));
    }
    prefix_transpose(columns);
}

/* Stages of four dampers; see prefix_solve. */
typedef struct prefix_stages {
    prefix_vector z_m;
    const prefix_row *pieces[PREFIX_LANES];
} prefix_stages;

PREFIX_INLINE prefix_vector prefix_cubics(const prefix_stages *stages, unsigned row)
{
    const prefix_vector z = stages->z_m;
    prefix_vector c[4], low, high;
    unsigned lane;

    for (lane = 0; lane < PREFIX_LANES; lane++) {
        c[lane] = prefix_load(stages->pieces[lane][row].numbers);
    }
    prefix_transpose(c);
    low = c[0] + prefix_products(c[1], z);
    high = c[2] + prefix_products(c[3], z);
    return low + prefix_products(high, prefix_products(z, z));
}

PREFIX_INLINE void prefix_locate(const prefix_damper *dampers, prefix_vector reach, prefix_vector offset,
                                 prefix_vector knot, prefix_stages *stages)
{
    const prefix_vector places = prefix_larger_of(prefix_magnitudes(reach) - offset + knot, knot);
    prefix_vector knots[4];
    prefix_mask is_next;
    unsigned lane;

    for (lane = 0; lane < PREFIX_LANES; lane++) {
        const unsigned bin = (unsigned)(prefix_bits_of(places[lane]) >> PREFIX_BIN_SHIFT) % PREFIX_BINS;
        const unsigned side = (unsigned)(prefix_bits_of(reach[lane]) >> (PREFIX_REAL_BITS - 1));
        const prefix_damper *const damper = &dampers[lane];

        stages->pieces[lane] = &damper->rows[PREFIX_ROWS_PER_PIECE / 2 * damper->bins[bin][side]];
        knots[lane] = prefix_load(stages->pieces[lane][PREFIX_KNOTS].numbers);
    }
    prefix_transpose(knots);
    is_next = places > knots[1];
    stages->z_m = places - prefix_choose(is_next, knots[1], knots[0]);
    for (lane = 0; lane < PREFIX_LANES; lane++) {
        stages->pieces[lane] += PREFIX_ROWS_PER_PIECE & (unsigned)is_next[lane];
    }
}

/* Steps a group of usual dampers; see prefix_move. */
PREFIX_INLINE void prefix_move_group(const prefix_damper *dampers, prefix_state *states,
                                     const prefix_real *displacements_m)
{
    const prefix_vector zero = prefix_splat(0);
    const prefix_vector gamma = prefix_splat(PREFIX_GAMMA);
    const prefix_vector largest_force = prefix_splat(PREFIX_LARGEST_FORCE_N);
    prefix_vector position[PREFIX_VECTORS], start[PREFIX_VECTORS], potential[PREFIX_VECTORS], travel[PREFIX_VECTORS];
    prefix_vector rest_rounder[PREFIX_VECTORS], first_flow[PREFIX_VECTORS], constants[PREFIX_VECTORS][4];
    prefix_stages stages[PREFIX_VECTORS];
    unsigned vector, lane;

    for (vector = 0; vector < PREFIX_VECTORS; vector++) {
        const unsigned begin = PREFIX_LANES * vector;
        prefix_vector columns[4];

        prefix_columns(columns, &states[begin].displacement_m, sizeof *states);
        position[vector] = columns[0];
        start[vector] = columns[1];
        potential[vector] = columns[2];
        prefix_columns(columns, &dampers[begin].position_rounder_m, sizeof *dampers);
        rest_rounder[vector] = columns[1];
        travel[vector] = prefix_load(displacements_m + begin) - position[vector];
        travel[vector] = (travel[vector] + columns[0]) - columns[0];
        position[vector] = position[vector] + travel[vector];
        prefix_columns(constants[vector], &dampers[begin].offset_m, sizeof *dampers);
        prefix_locate(&dampers[begin], start[vector] + prefix_products(gamma, travel[vector]), constants[vector][0],
                      constants[vector][1], &stages[vector]);
    }
    for (vector = 0; vector < PREFIX_VECTORS; vector++) {
        const prefix_vector back = prefix_splat(PREFIX_REST_OF_GAMMA);

        first_flow[vector] = prefix_cubics(&stages[vector], PREFIX_FLOW);
        prefix_locate(&dampers[PREFIX_LANES * vector],
                      start[vector] + travel[vector] - prefix_products(back, first_flow[vector]),
                      constants[vector][0], constants[vector][1], &stages[vector]);
    }
    for (vector = 0; vector < PREFIX_VECTORS; vector++) {
        const prefix_vector clearance = constants[vector][2], limit = constants[vector][3];
        const prefix_vector last_flow = prefix_cubics(&stages[vector], PREFIX_FLOW);
        const prefix_vector end_potential = prefix_cubics(&stages[vector], PREFIX_POTENTIAL);
        const prefix_vector stiffness = prefix_cubics(&stages[vector], PREFIX_STIFFNESS);
        const prefix_vector bend = prefix_products(gamma, last_flow - first_flow[vector]);
        const prefix_vector quadrature = first_flow[vector] + bend;
        const prefix_vector change = travel[vector] - quadrature;
        const prefix_vector area = end_potential - potential[vector] + prefix_products(bend, bend);
        const prefix_vector most = prefix_magnitudes(prefix_products(change, prefix_splat(PREFIX_LARGEST_CORRECTION)));
        const prefix_vector contact = prefix_products(prefix_products(last_flow, start[vector]), potential[vector]);
        prefix_vector correction = area / change - quadrature;
        prefix_vector stretch, magnitude, limited, rows[4];
        prefix_mask yields;

        correction = prefix_larger_of(prefix_smaller_of(correction, most), -most);
        correction = prefix_choose(contact > zero, zero, correction);
        stretch = ((start[vector] + change + rest_rounder[vector]) - correction) - rest_rounder[vector];
        magnitude = prefix_products(prefix_larger_of(prefix_magnitudes(stretch), clearance) - clearance, stiffness);
        yields = ~(magnitude < limit);
        limited = prefix_choose(yields, limit, magnitude);
        limited = prefix_larger_of(prefix_smaller_of(limited, largest_force), zero);
        rows[0] = position[vector];
        rows[1] = stretch;
        rows[2] = end_potential - prefix_products(last_flow, correction);
        rows[3] = prefix_choose(stretch >= zero, limited, -limited);
        prefix_transpose(rows);
        for (lane = 0; lane < PREFIX_LANES; lane++) {
            prefix_state *const state = &states[PREFIX_LANES * vector + lane];

            __builtin_memcpy(&state->displacement_m, &rows[lane], sizeof rows[lane]);
            state->status_word = (uint16_t)(state->status_word | (PREFIX_SATURATED & (unsigned)yields[lane]));
        }
    }
}
#else
#define PREFIX_HAS_VECTORS 0
#endif

/* Steps dampers that stand one after another: the forces, states and bits of prefix_step for each. */
static void prefix_step_bank(const prefix_damper *dampers, prefix_state *states, const prefix_real *displacements_m,
                             unsigned count)
{
    unsigned number = 0;

#if PREFIX_HAS_VECTORS
    for (; number + PREFIX_GROUP <= count; number += PREFIX_GROUP) {
        bool are_usual = true;
        unsigned lane;

        for (lane = number; lane < number + PREFIX_GROUP; lane++) {
            are_usual &= prefix_is_usual(&dampers[lane], &states[lane], displacements_m[lane]);
        }
        if (are_usual) {
            prefix_move_group(&dampers[number], &states[number], &displacements_m[number]);
        } else {
            for (lane = number; lane < number + PREFIX_GROUP; lane++) {
                (void)prefix_step(&dampers[lane], &states[lane], displacements_m[lane]);
            }
        }
    }
#endif
    for (; number < count; number++) {
        (void)prefix_step(&dampers[number], &states[number], displacements_m[number]);
    }
}
