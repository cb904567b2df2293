/* Forces the computation of a number in every step, even if it is not used, so that each step has the same cost. */
#ifdef PREFIX_REGISTER
#define PREFIX_ALWAYS(number) __asm__ volatile("" : PREFIX_REGISTER(number))
#else
#define PREFIX_ALWAYS(number) ((void)0)
#endif

/* A function that is rarely called and must not be inlined. */
#if defined(__GNUC__) || defined(__clang__)
#define PREFIX_COLD static __attribute__((noinline, cold))
#elif defined(_MSC_VER)
#define PREFIX_COLD static __declspec(noinline)
#else
#define PREFIX_COLD static
#endif

/* True if maximum and minimum are single instructions: Armv8-M and Armv8-A in single precision, and Cortex-M7 if the
 * compiler reports it. */
#if SCALAR_BITS == 32 && defined(__GNUC__) && defined(__ARM_FP) && !defined(__aarch64__) \
    && ((defined(__ARM_ARCH) && __ARM_ARCH >= 8) || defined(__ARM_FPV5__))
#define PREFIX_HAS_MAXIMUM 1
#else
#define PREFIX_HAS_MAXIMUM 0
#endif

#define PREFIX_ZERO ((prefix_real)0.0)
#define PREFIX_ONE ((prefix_real)1.0)
/* gamma of both stages, 1 - 1/sqrt 2, and 1 - gamma. */
#define PREFIX_GAMMA ((prefix_real)0x1.2bec333018866p-2)
#define PREFIX_REST_OF_GAMMA ((prefix_real)0x1.6a09e667f3bcdp-1)
/* Maximum correction relative to the change of the stretch in the step, so that it never cancels the damping. */
#define PREFIX_LARGEST_CORRECTION ((prefix_real)0.125)
/* Maximum force limit (N) and maximum clearance (m) of any damper. */
#define PREFIX_LARGEST_FORCE_N ((prefix_real)1e7)
#define PREFIX_LARGEST_CLEARANCE_M ((prefix_real)0.1)
/* Bound on the displacement and the stretch of any damper (m). */
#define PREFIX_LARGEST_BOUND_M ((prefix_real)1.45)
/* Maximum lag behind the input: the travel at the largest rate in this time (s). If the input is farther away, the
 * force falls to zero in this time. The second number is the minimum decrease per step as a fraction of the force
 * limit. */
#define PREFIX_CATCH_UP_S ((prefix_real)0.01)
#define PREFIX_LEAST_FALL ((prefix_real)1e-4)

/* Upper bits of a state's status word; they distinguish a state from memory that was never written. */
#define PREFIX_MARK 0x3940U
#define PREFIX_MARK_BITS 0xffc0U

/* Initial value and factor of the hash FNV-1a (Fowler, Noll, Vo; 32 bit). */
#define PREFIX_HASH_START 0x811c9dc5U
#define PREFIX_HASH_FACTOR 0x01000193U

/* Bins per side. */
#define PREFIX_BINS 2048U
/* Rows of a piece: three cubics in z, the reach beyond the knot of the piece (coefficients of 1, z, z^2, z^3), and the
 * knots. A side has 64 pieces; two pieces of zeros follow those of both sides. */
#define PREFIX_FLOW 0U       /* times the step (m), with the sign of the stretch */
#define PREFIX_POTENTIAL 1U  /* flow potential times the step (m^2), positive */
#define PREFIX_STIFFNESS 2U  /* force over stretch beyond the clearance (N/m) */
#define PREFIX_KNOTS 3U      /* where the piece and the next one begin (m), two unused numbers */
#define PREFIX_ROWS_PER_PIECE 4U
/* Leading bits of a number's fraction that contribute to the index of a bin. */
#define PREFIX_BIN_FRACTION_BITS 7U
/* Sizes of a number, of its fraction, and of the fraction's bits below those that give the index of a bin. */
#define PREFIX_REAL_BITS SCALAR_BITSU
#define PREFIX_REAL_BYTES (PREFIX_REAL_BITS / 8U)
#define PREFIX_FRACTION_BITS SCALAR_FRACTION_BITSU
#define PREFIX_BIN_SHIFT (PREFIX_FRACTION_BITS - PREFIX_BIN_FRACTION_BITS)
/* All bits of a number but its sign. */
#define PREFIX_MAGNITUDE_BITS ((prefix_bits)(~(prefix_bits)0U) >> 1U)

/* A number and its bits. */
typedef union prefix_word {
    prefix_real real;
    prefix_bits bits;
} prefix_word;

/* Four numbers of a table. */
struct prefix_row {
    prefix_real numbers[4];
};

PREFIX_INLINE prefix_bits prefix_bits_of(prefix_real value)
{
    prefix_word word;

    word.real = value;
    return word.bits;
}

PREFIX_INLINE prefix_real prefix_real_of(prefix_bits bits)
{
    prefix_word word;

    word.bits = bits;
    return word.real;
}

PREFIX_INLINE prefix_real prefix_magnitude(prefix_real value)
{
#if !defined(__GNUC__)
    return prefix_real_of(prefix_bits_of(value) & PREFIX_MAGNITUDE_BITS);
#elif SCALAR_BITS == 32
    return __builtin_fabsf(value);
#else
    return __builtin_fabs(value);
#endif
}

/* Maximum and minimum; if one number is NaN, the result is the other one. */
PREFIX_INLINE prefix_real prefix_larger(prefix_real value, prefix_real other)
{
#if PREFIX_HAS_MAXIMUM
    return __builtin_fmaxf(value, other);
#else
    return (value > other) ? value : other;
#endif
}

PREFIX_INLINE prefix_real prefix_smaller(prefix_real value, prefix_real other)
{
#if PREFIX_HAS_MAXIMUM
    return __builtin_fminf(value, other);
#else
    return (value < other) ? value : other;
#endif
}

/* True if a number is neither NaN nor infinite. */
PREFIX_INLINE bool prefix_is_finite(prefix_real value)
{
    const prefix_bits exponent = (PREFIX_MAGNITUDE_BITS >> PREFIX_FRACTION_BITS) << PREFIX_FRACTION_BITS;

    return (prefix_bits_of(value) & exponent) != exponent;
}

/* True if the magnitude of a number is at most that of the bound, given as doubled bits. False for NaN, whose bits
 * exceed those of every number. */
PREFIX_INLINE bool prefix_is_within(prefix_real value, prefix_bits bound)
{
    return bound >= (prefix_bits)(prefix_bits_of(value) << 1U);
}

/* The product a b, always rounded. */
PREFIX_INLINE prefix_real prefix_product(prefix_real a, prefix_real b)
{
    prefix_real product = a * b;

    PREFIX_ROUND(product);
    return product;
}

/* sum + a b, and sum - a b: the product is rounded before it is added. */
PREFIX_INLINE prefix_real prefix_add_product(prefix_real sum, prefix_real a, prefix_real b)
{
#if SCALAR_BITS == 32 && defined(__GNUC__) && defined(__ARM_FP) && !defined(__aarch64__)
    /* One instruction that also rounds the product; GCC would use two. */
    __asm__("vmla.f32 %0, %1, %2" : "+t"(sum) : "t"(a), "t"(b));
    return sum;
#else
    return sum + prefix_product(a, b);
#endif
}

PREFIX_INLINE prefix_real prefix_subtract_product(prefix_real sum, prefix_real a, prefix_real b)
{
#if SCALAR_BITS == 32 && defined(__GNUC__) && defined(__ARM_FP) && !defined(__aarch64__)
    __asm__("vmls.f32 %0, %1, %2" : "+t"(sum) : "t"(a), "t"(b));
    return sum;
#else
    return sum - prefix_product(a, b);
#endif
}

/* c0 + c1 z + c2 z^2 + c3 z^3, evaluated in pairs: one more product than Horner's scheme, but a shorter dependency
 * chain. */
PREFIX_INLINE prefix_real prefix_cubic(const prefix_row *row, prefix_real z)
{
    const prefix_real *const c = row->numbers;
    const prefix_real low = prefix_add_product(c[0], c[1], z);
    const prefix_real high = prefix_add_product(c[2], c[3], z);

    return prefix_add_product(low, high, z * z);
}

/* Solution of an implicit stage. */
typedef struct prefix_stage {
    prefix_real flow_m;  /* times the step */
    const prefix_row *piece;
    prefix_real z_m;     /* in the piece */
} prefix_stage;

/* 1 if a positive number exceeds a knot, else 0, without a branch. Positive numbers have the same order as their
 * bits. */
PREFIX_INLINE prefix_bits prefix_exceeds(prefix_bits reach, prefix_real knot)
{
    return (prefix_bits)(prefix_bits_of(knot) - reach) >> (PREFIX_REAL_BITS - 1U);
}

/* Finds the stage whose stretch and flow sum to `reach` (m). The exponent and leading bits of the reach beyond the
 * offset give the index of a bin, and the bin gives the piece at its lower border; at most one knot lies within a bin.
 * Every number can be looked up safely: any bin and the piece after it are within the table. */
PREFIX_INLINE void prefix_solve(const prefix_damper *damper, prefix_real reach, prefix_stage *stage)
{
    /* The same as max(|reach| - offset, 0) + knot, but needs no constant zero. */
    const prefix_real knot = damper->first_knot_m;
    const prefix_real place = prefix_larger((prefix_magnitude(reach) - damper->offset_m) + knot, knot);
    const prefix_bits bits = prefix_bits_of(place);
    const unsigned side = (unsigned)(prefix_bits_of(reach) >> (PREFIX_REAL_BITS - 1U));
    const unsigned bin = (unsigned)(bits >> PREFIX_BIN_SHIFT) % PREFIX_BINS;
    const prefix_row *const first = &damper->rows[(PREFIX_ROWS_PER_PIECE / 2U) * damper->bins[bin][side]];

    stage->piece = &first[PREFIX_ROWS_PER_PIECE * prefix_exceeds(bits, first[PREFIX_KNOTS].numbers[1])];
    stage->z_m = place - stage->piece[PREFIX_KNOTS].numbers[0];
    stage->flow_m = prefix_cubic(&stage->piece[PREFIX_FLOW], stage->z_m);
}

/* Force magnitude (N) at a stretch (m), from the stiffness of the stage that ended there; it may exceed the limit. */
PREFIX_INLINE prefix_real prefix_force(const prefix_damper *damper, prefix_real stretch, prefix_real stiffness)
{
    const prefix_real clearance = damper->half_clearance_m;

    return (prefix_larger(prefix_magnitude(stretch), clearance) - clearance) * stiffness;
}

/* With the stretch u = x - x_r of clearance and springs, the chain x = g + delta(F) + x_r, dx_r/dt = v_h(F) is one
 * equation, du/dt = dx/dt - f(u), where f = v_h(F(u)) is zero in the clearance and rises beyond it. A step takes two
 * implicit stages (Alexander's SDIRK2, gamma = 1 - 1/sqrt 2: second order, L-stable, last stage at the tick) and then
 * corrects the flow by the difference between its exact mean along the step's straight path and the stages'
 * quadrature of that path. The method is in docs/numerics.md of Dashpot; core/src/step.rs is the same step in Rust.
 * Inlined twice, so that the usual step calls nothing and saves no registers for a call. */
PREFIX_INLINE prefix_real prefix_move(const prefix_damper *damper, prefix_state *state, prefix_real travel)
{
    const prefix_real gamma = PREFIX_GAMMA;
    /* Sums of travels on this grid are exact, so a piston at rest in its clearance does not drift. */
    const prefix_real move = (travel + damper->position_rounder_m) - damper->position_rounder_m;
    const prefix_real start = state->stretch_m;
    prefix_stage first;
    prefix_stage last;

    state->displacement_m = state->displacement_m + move;

    prefix_solve(damper, prefix_add_product(start, gamma, move), &first);
    prefix_solve(damper, prefix_subtract_product(start + move, PREFIX_REST_OF_GAMMA, first.flow_m), &last);
    const prefix_real bend = prefix_product(gamma, last.flow_m - first.flow_m);
    const prefix_real quadrature = first.flow_m + bend;
    const prefix_real change = move - quadrature;
    const prefix_real end = start + change;

    /* Mean flow over the straight path, from the potential; the slope gives the part off the path. */
    const prefix_real end_potential = prefix_cubic(&last.piece[PREFIX_POTENTIAL], last.z_m);
    const prefix_real area = prefix_add_product(end_potential - state->potential_m2, bend, bend);
    const prefix_real most = prefix_magnitude(change * PREFIX_LARGEST_CORRECTION);
    prefix_real correction = prefix_larger(prefix_smaller((area / change) - quadrature, most), -most);
    PREFIX_ALWAYS(correction);
    const prefix_real contact = (last.flow_m * start) * state->potential_m2;
    if (contact > PREFIX_ZERO) {
        correction = PREFIX_ZERO;
    }

    const prefix_real stretch = ((end + damper->rest_rounder_m) - correction) - damper->rest_rounder_m;
    const prefix_real magnitude =
        prefix_force(damper, stretch, prefix_cubic(&last.piece[PREFIX_STIFFNESS], last.z_m));
    const prefix_real limit = damper->force_limit_n;
    prefix_real limited = magnitude;
    unsigned status_word = state->status_word;
    if (!(magnitude < limit)) {
        limited = limit;
        status_word |= PREFIX_SATURATED;
    }
    state->status_word = (uint16_t)status_word;
    /* Only damaged constants make the force negative, NaN or larger than any limit; in all these cases its bits exceed
     * those of the bound. */
    if (prefix_bits_of(limited) > prefix_bits_of(PREFIX_LARGEST_FORCE_N)) {
        limited = prefix_larger(prefix_smaller(limited, PREFIX_LARGEST_FORCE_N), PREFIX_ZERO);
    }
    const prefix_real force = (stretch >= PREFIX_ZERO) ? limited : -limited;

    state->stretch_m = stretch;
    state->potential_m2 = prefix_subtract_product(end_potential, last.flow_m, correction);
    state->force_n = force;
    return force;
}

PREFIX_COLD prefix_real prefix_unusual_step(const prefix_damper *damper, prefix_state *state,
                                            prefix_real displacement_m);

/* True if a state, its damper and its displacement allow the usual step. */
PREFIX_INLINE bool prefix_is_usual(const prefix_damper *damper, const prefix_state *state, prefix_real displacement_m)
{
    return (state->revision == damper->revision)
           && prefix_is_within(displacement_m - state->displacement_m, damper->move_bound)
           && prefix_is_within(displacement_m, damper->displacement_bound)
           && prefix_is_within(state->stretch_m, damper->stretch_bound);
}

prefix_real prefix_step(const prefix_damper *damper, prefix_state *state, prefix_real displacement_m)
{
    if (prefix_is_usual(damper, state, displacement_m)) {
        return prefix_move(damper, state, displacement_m - state->displacement_m);
    }
    return prefix_unusual_step(damper, state, displacement_m);
}

/* Largest credible move of the input in a step (m). */
static prefix_real prefix_largest_move_m(const prefix_damper *damper)
{
    return prefix_real_of(damper->move_bound >> 1U);
}

prefix_real prefix_largest_displacement_m(const prefix_damper *damper)
{
    return prefix_real_of(damper->displacement_bound >> 1U);
}

/* Reach beyond the offset (m) at the end of the bins; no stage of an undamaged state looks beyond it. */
static prefix_real prefix_largest_reach_beyond_offset(const prefix_damper *damper)
{
    const uint32_t octaves = 1UL << (PREFIX_BINS >> PREFIX_BIN_FRACTION_BITS);

    return (prefix_real)octaves * damper->first_knot_m;
}

/* True if all numbers of a state are finite. */
static bool prefix_is_finite_state(const prefix_state *state)
{
    return prefix_is_finite(state->displacement_m) && prefix_is_finite(state->stretch_m)
           && prefix_is_finite(state->potential_m2) && prefix_is_finite(state->force_n);
}

/* True if a step of the damper could produce the numbers of a state. Rounding to the grid of positions may exceed the
 * range of displacement by less than a thousandth. */
static bool prefix_could_leave(const prefix_damper *damper, const prefix_state *state)
{
    const prefix_real most = prefix_product((prefix_real)1.001, prefix_largest_displacement_m(damper));

    return (prefix_magnitude(state->displacement_m) <= most) && prefix_is_finite(state->potential_m2)
           && prefix_is_within(state->stretch_m, damper->stretch_bound)
           && (prefix_magnitude(state->force_n) <= prefix_force_limit_n(damper));
}

static void prefix_count_rejected_input(prefix_state *state)
{
    if (state->rejected_inputs != UINT16_MAX) {
        state->rejected_inputs = (uint16_t)(state->rejected_inputs + 1U);
    }
}

static void prefix_latch(prefix_state *state, unsigned status)
{
    state->status_word = (uint16_t)(state->status_word | status);
}

/* Returns the travel (m) of a step whose displacement is held, and latches and counts the event. */
static prefix_real prefix_hold(prefix_state *state)
{
    prefix_count_rejected_input(state);
    prefix_latch(state, PREFIX_INPUT_HELD);
    return PREFIX_ZERO;
}

/* Puts a state at rest at a displacement (m); keeps its latched bits and its counter. */
static void prefix_restart(const prefix_damper *damper, prefix_state *state, prefix_real displacement_m,
                           unsigned because)
{
    const bool marked = (state->status_word & PREFIX_MARK_BITS) == PREFIX_MARK;
    const unsigned status = marked ? prefix_status(state) : 0U;
    const uint16_t count = (uint16_t)(marked ? state->rejected_inputs : 0U);

    prefix_at_rest(damper, state, displacement_m);
    state->rejected_inputs = count; /* callers count held displacements */
    prefix_latch(state, status | because);
}

static void prefix_take_force(const prefix_damper *damper, prefix_state *state, prefix_real force);

/* Returns the travel (m) to a displacement (m), after making the state valid for the damper. A state that no step could
 * produce restarts at rest; a state of another damper is adopted. A displacement that is not finite or out of range is
 * held. One that is too fast is followed at the largest rate while it is near enough. If it is farther away, it is held
 * while the force falls to zero, and then the damper restarts at rest there. Each event is latched, and the last three
 * are counted. */
static prefix_real prefix_travel(const prefix_damper *damper, prefix_state *state, prefix_real displacement_m)
{
    const prefix_real most = prefix_largest_move_m(damper);
    const bool known = state->revision == damper->revision;

    if (((state->status_word & PREFIX_MARK_BITS) != PREFIX_MARK) || !prefix_is_finite_state(state)
        || (known && !prefix_could_leave(damper, state))) {
        prefix_restart(damper, state, displacement_m, PREFIX_CORRUPTED);
    }
    if (state->revision != damper->revision) {
        prefix_adopt(damper, state);
    }
    if (!prefix_is_within(displacement_m, damper->displacement_bound)) {
        return prefix_hold(state);
    }
    const prefix_real travel = displacement_m - state->displacement_m;
    if (prefix_magnitude(travel) <= most) {
        return travel;
    }
    const prefix_real steps = PREFIX_CATCH_UP_S / damper->step_s;
    if (prefix_magnitude(travel) <= (most * prefix_larger(steps, (prefix_real)2.0))) {
        prefix_count_rejected_input(state);
        prefix_latch(state, PREFIX_INPUT_LIMITED);
        return prefix_smaller(prefix_larger(travel, -most), most);
    }
    const prefix_real share = prefix_smaller(prefix_larger(PREFIX_ONE / steps, PREFIX_LEAST_FALL), PREFIX_ONE);
    const prefix_real fall = prefix_force_limit_n(damper) * share;
    if (prefix_magnitude(state->force_n) <= fall) {
        prefix_restart(damper, state, displacement_m, PREFIX_RESTARTED);
        prefix_count_rejected_input(state);
        return PREFIX_ZERO;
    }
    prefix_take_force(damper, state, state->force_n + ((state->force_n < PREFIX_ZERO) ? fall : -fall));
    return prefix_hold(state);
}

PREFIX_COLD prefix_real prefix_unusual_step(const prefix_damper *damper, prefix_state *state,
                                            prefix_real displacement_m)
{
    return prefix_move(damper, state, prefix_travel(damper, state, displacement_m));
}

void prefix_at_rest(const prefix_damper *damper, prefix_state *state, prefix_real displacement_m)
{
    const bool good = prefix_is_within(displacement_m, damper->displacement_bound);
    const prefix_real end = prefix_largest_displacement_m(damper);

    state->displacement_m = good ? displacement_m : ((displacement_m < PREFIX_ZERO) ? -end : end);
    state->stretch_m = PREFIX_ZERO;
    state->potential_m2 = PREFIX_ZERO;
    state->force_n = PREFIX_ZERO;
    state->revision = damper->revision;
    state->status_word = (uint16_t)(good ? PREFIX_MARK : (PREFIX_MARK | PREFIX_INPUT_HELD));
    state->rejected_inputs = (uint16_t)(good ? 0U : 1U);
}

/* Gives a state the stretch and the flow potential at which the damper has a force (N); finds them by bisection. */
static void prefix_take_force(const prefix_damper *damper, prefix_state *state, prefix_real force)
{
    const prefix_real target = prefix_magnitude(force);
    prefix_real low = damper->half_clearance_m;
    prefix_real high = prefix_largest_reach_beyond_offset(damper) + damper->offset_m;
    unsigned halving;

    for (halving = 0U; halving < (PREFIX_FRACTION_BITS + 3U); halving++) {
        const prefix_real middle = (prefix_real)0.5 * (low + high);
        const prefix_real reach = (force < PREFIX_ZERO) ? -middle : middle;
        prefix_stage stage;

        prefix_solve(damper, reach, &stage);
        const prefix_real stretch = prefix_subtract_product(reach, PREFIX_GAMMA, stage.flow_m);
        state->stretch_m = stretch;
        state->potential_m2 = prefix_cubic(&stage.piece[PREFIX_POTENTIAL], stage.z_m);
        if (prefix_force(damper, stretch, prefix_cubic(&stage.piece[PREFIX_STIFFNESS], stage.z_m)) < target) {
            low = middle;
        } else {
            high = middle;
        }
    }
}

/* Limits displacement and force to the range of the damper, and sets the stretch to that of the damper under this
 * force; without force, the stretch stays within the clearance. */
void prefix_adopt(const prefix_damper *damper, prefix_state *state)
{
    const prefix_real limit = prefix_force_limit_n(damper);
    const prefix_real force = prefix_smaller(prefix_larger(state->force_n, -limit), limit);
    const prefix_real most = damper->half_clearance_m;
    const prefix_real end = prefix_largest_displacement_m(damper);

    if (force == PREFIX_ZERO) {
        state->stretch_m = prefix_smaller(prefix_larger(state->stretch_m, -most), most);
        state->potential_m2 = PREFIX_ZERO;
    } else {
        prefix_take_force(damper, state, force);
    }
    state->displacement_m = prefix_smaller(prefix_larger(state->displacement_m, -end), end);
    state->force_n = force;
    if (state->revision != 0U) {
        prefix_latch(state, PREFIX_DAMPER_SWAPPED);
    }
    state->revision = damper->revision;
}

static uint32_t prefix_hash_byte(uint32_t hash, unsigned byte)
{
    return ((hash ^ byte) * PREFIX_HASH_FACTOR) & UINT32_MAX;
}

/* Continues the hash over the bits of a number, zero-extended to 64 bits, lowest byte first. */
static uint32_t prefix_hash_bits(uint32_t hash, uint64_t bits)
{
    uint32_t hashed = hash;
    unsigned shift;

    for (shift = 0U; shift < 64U; shift += 8U) {
        hashed = prefix_hash_byte(hashed, (unsigned)((bits >> shift) & 0xffU));
    }
    return hashed;
}

static uint32_t prefix_hash_real(uint32_t hash, prefix_real value)
{
    return prefix_hash_bits(hash, prefix_bits_of(value));
}

/* Doubled bits of the largest stretch after a step. From a stretch u beyond the offset, the stages look up at most
 * sqrt(2) u and 1.12 moves, which must be in the table. */
static prefix_bits prefix_stretch_bound(const prefix_damper *damper)
{
    const prefix_real end = prefix_largest_reach_beyond_offset(damper);
    const prefix_real most = prefix_subtract_product(end, (prefix_real)1.12, prefix_largest_move_m(damper));
    const prefix_real in_table = prefix_add_product(damper->offset_m, (prefix_real)0.7, most);

    return prefix_bits_of(prefix_smaller(prefix_larger(in_table, PREFIX_ZERO), PREFIX_LARGEST_BOUND_M)) << 1U;
}

prefix_result prefix_set_clearance_m(prefix_damper *damper, prefix_real clearance_m)
{
    uint32_t hash = damper->table_revision;

    if (!((clearance_m >= PREFIX_ZERO) && (clearance_m <= PREFIX_LARGEST_CLEARANCE_M))) {
        return PREFIX_CLEARANCE_REFUSED;
    }
    damper->half_clearance_m = (prefix_real)0.5 * clearance_m;
    damper->offset_m = damper->half_clearance_m + damper->held_m;
    damper->stretch_bound = prefix_stretch_bound(damper);
    hash = prefix_hash_bits(hash, damper->move_bound);
    hash = prefix_hash_real(hash, damper->position_rounder_m);
    hash = prefix_hash_real(hash, damper->rest_rounder_m);
    hash = prefix_hash_real(hash, damper->step_s);
    hash = prefix_hash_real(hash, damper->offset_m);
    hash = prefix_hash_real(hash, damper->first_knot_m);
    hash = prefix_hash_real(hash, damper->half_clearance_m);
    hash = prefix_hash_real(hash, (prefix_real)0.5 * damper->force_limit_n); /* the core stores half of it */
    hash = prefix_hash_real(hash, damper->held_m);
    hash = prefix_hash_bits(hash, damper->displacement_bound);
    hash = prefix_hash_bits(hash, damper->stretch_bound);
    damper->revision = (hash == 0U) ? 1U : hash;
    return PREFIX_DONE;
}

unsigned prefix_status(const prefix_state *state)
{
    return state->status_word & ~PREFIX_MARK_BITS;
}

void prefix_clear_status(prefix_state *state)
{
    state->status_word = (uint16_t)(state->status_word & PREFIX_MARK_BITS);
    state->rejected_inputs = 0;
}

prefix_real prefix_clearance_m(const prefix_damper *damper)
{
    return damper->half_clearance_m + damper->half_clearance_m;
}

/* Also valid for damaged constants. */
prefix_real prefix_force_limit_n(const prefix_damper *damper)
{
    const prefix_real limit = damper->force_limit_n;

    return (limit <= PREFIX_LARGEST_FORCE_N) ? prefix_larger(limit, PREFIX_ZERO) : PREFIX_LARGEST_FORCE_N;
}

/* Writes the lower bytes of a value, the lowest first. */
static void prefix_put(uint8_t *to, uint64_t value, unsigned bytes)
{
    uint64_t rest = value;
    unsigned byte;

    for (byte = 0U; byte < bytes; byte++) {
        to[byte] = (uint8_t)(rest & 0xffU);
        rest = rest >> 8U;
    }
}

static uint64_t prefix_get(const uint8_t *from, unsigned bytes)
{
    uint64_t value = 0U;
    unsigned byte;

    for (byte = bytes; byte > 0U; byte--) {
        value = (value << 8U) | from[byte - 1U];
    }
    return value;
}

static prefix_real prefix_get_real(const uint8_t *from)
{
    return prefix_real_of((prefix_bits)prefix_get(from, PREFIX_REAL_BYTES));
}

void prefix_save(const prefix_state *state, uint8_t bytes[PREFIX_STATE_BYTES])
{
    uint8_t *const rest = &bytes[4U * PREFIX_REAL_BYTES];

    prefix_put(bytes, prefix_bits_of(state->displacement_m), PREFIX_REAL_BYTES);
    prefix_put(&bytes[PREFIX_REAL_BYTES], prefix_bits_of(state->stretch_m), PREFIX_REAL_BYTES);
    prefix_put(&bytes[2U * PREFIX_REAL_BYTES], prefix_bits_of(state->potential_m2), PREFIX_REAL_BYTES);
    prefix_put(&bytes[3U * PREFIX_REAL_BYTES], prefix_bits_of(state->force_n), PREFIX_REAL_BYTES);
    prefix_put(rest, state->revision, 4U);
    prefix_put(&rest[4], prefix_status(state), 2U);
    prefix_put(&rest[6], state->rejected_inputs, 2U);
}

prefix_result prefix_restore(const prefix_damper *damper, prefix_state *state,
                             const uint8_t bytes[PREFIX_STATE_BYTES])
{
    const uint8_t *const rest = &bytes[4U * PREFIX_REAL_BYTES];
    prefix_state saved;

    saved.displacement_m = prefix_get_real(bytes);
    saved.stretch_m = prefix_get_real(&bytes[PREFIX_REAL_BYTES]);
    saved.potential_m2 = prefix_get_real(&bytes[2U * PREFIX_REAL_BYTES]);
    saved.force_n = prefix_get_real(&bytes[3U * PREFIX_REAL_BYTES]);
    saved.revision = (uint32_t)prefix_get(rest, 4U);
    saved.status_word = (uint16_t)(PREFIX_MARK | (prefix_get(&rest[4], 2U) & (~PREFIX_MARK_BITS & 0xffffU)));
    saved.rejected_inputs = (uint16_t)prefix_get(&rest[6], 2U);

    if (saved.revision != damper->revision) {
        return PREFIX_OTHER_DAMPER;
    }
    if (!prefix_could_leave(damper, &saved)) {
        return PREFIX_IMPOSSIBLE_VALUES;
    }
    /* Member by member, because compilers may turn the copy of a structure into a call of memcpy. */
    state->displacement_m = saved.displacement_m;
    state->stretch_m = saved.stretch_m;
    state->potential_m2 = saved.potential_m2;
    state->force_n = saved.force_n;
    state->revision = saved.revision;
    state->status_word = saved.status_word;
    state->rejected_inputs = saved.rejected_inputs;
    return PREFIX_DONE;
}

static void prefix_copy(prefix_damper *to, const prefix_damper *from)
{
    to->move_bound = from->move_bound;
    to->position_rounder_m = from->position_rounder_m;
    to->rest_rounder_m = from->rest_rounder_m;
    to->step_s = from->step_s;
    to->offset_m = from->offset_m;
    to->first_knot_m = from->first_knot_m;
    to->half_clearance_m = from->half_clearance_m;
    to->force_limit_n = from->force_limit_n;
    to->held_m = from->held_m;
    to->displacement_bound = from->displacement_bound;
    to->stretch_bound = from->stretch_bound;
    to->revision = from->revision;
    to->table_revision = from->table_revision;
    to->rows = from->rows;
    to->bins = from->bins;
}

/* The motion consists of random moves about zero from a linear congruential generator (Numerical Recipes). The moves
 * start at the largest credible size, are halved every 128 steps and start over every 1024 steps. There are also failed
 * readings, a jump and a change of clearance. */
uint32_t prefix_digest(const prefix_damper *damper)
{
    prefix_damper copy;
    prefix_state state;
    uint8_t bytes[PREFIX_STATE_BYTES];
    uint32_t hash = PREFIX_HASH_START;
    uint32_t random = 1U;
    const prefix_real largest_move = prefix_largest_move_m(damper);
    prefix_real move = largest_move;
    prefix_real displacement = PREFIX_ZERO;
    unsigned step;
    unsigned byte;

    prefix_copy(&copy, damper);
    prefix_at_rest(&copy, &state, PREFIX_ZERO);
    for (step = 0U; step < PREFIX_DIGEST_STEPS; step++) {
        const bool failed = (step % 512U) == 300U;

        random = ((random * 1664525U) + 1013904223U) & UINT32_MAX;
        const uint32_t upper = random >> 9U;
        const prefix_real fraction = ((prefix_real)upper * (prefix_real)0x1p-22) - PREFIX_ONE; /* exact */
        displacement = prefix_add_product(prefix_product((prefix_real)0.875, displacement), move, fraction);
        if ((step % 128U) == 127U) {
            move = ((step % 1024U) == 1023U) ? largest_move : ((prefix_real)0.5 * move);
        }
        if (step == 700U) {
            displacement = displacement + PREFIX_ONE;
        }
        if (step == 1500U) {
            (void)prefix_set_clearance_m(&copy, (prefix_real)0x1p-10);
        }
        (void)prefix_step(&copy, &state, failed ? prefix_real_of(~(prefix_bits)0U) : displacement);
        prefix_save(&state, bytes);
        for (byte = 0U; byte < PREFIX_STATE_BYTES; byte++) {
            hash = prefix_hash_byte(hash, bytes[byte]);
        }
    }
    return hash;
}
