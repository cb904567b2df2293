/* A bank of dampers: displacement in, force out.
 *
 * A communication step of h ends at the displacement `displacement_m + h velocity_m_per_s`; on the way there, the
 * displacement is linear over the internal steps. Without the velocity, the force at t + h is thus that of the
 * displacement given at t: it is one communication step late. With the velocity, the force belongs to t + h. An
 * importer that interpolates can give input derivatives. A derivative of the displacement replaces the velocity. Half
 * the derivative of the velocity times h is added to the velocity, which gives the mean over the step. */

#include "model.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "dampers.h"

/* Variables of each damper, in their order. */
enum {
    DISPLACEMENT,
    VELOCITY,
    FORCE,
    CLEARANCE,
    STATUS,
    REJECTED_INPUTS,
    VARIABLES
};

typedef struct place {
    double displacement_m;
    double velocity_m_per_s;
    double clearance_m;         /* as set, before rounding */
    double reached_m;           /* the displacement at the last communication point */
    double derivative_m_per_s;  /* of the displacement, for the next communication step; */
    double is_derived;          /* valid if this is not 0 */
    double derivative_m_per_s2; /* of the velocity, for the next communication step */
    double from_m, to_m;        /* ends of the current communication step */
} place;

struct model {
    damper_damper *dampers;
    damper_damper *as_loaded;
    damper_state *states;
    damper_real *displacements_m; /* of the current internal step */
    unsigned reported;          /* status bits that were already reported, of all dampers */
    bool is_started;
    place places[];
};

/* Value of `reached_m` before the first valid displacement. */
static const double nowhere_m = 1e300;

/* True if a step to a displacement follows it completely or in part. */
static bool is_good(const damper_damper *damper, double displacement_m)
{
    const damper_real displacement = (damper_real)displacement_m;
    const damper_real most = damper_largest_displacement_m(damper);

    return displacement >= -most && displacement <= most;
}

/* Starts a damper. An invalid displacement is rejected; the damper then starts at the first valid one. */
static void start(model *this, unsigned number)
{
    place *at = &this->places[number];

    damper_at_rest(&this->dampers[number], &this->states[number], (damper_real)at->displacement_m);
    at->reached_m = is_good(&this->dampers[number], at->displacement_m) ? at->displacement_m : nowhere_m;
}

static void forget_derivatives(place *at)
{
    at->derivative_m_per_s = 0;
    at->is_derived = 0;
    at->derivative_m_per_s2 = 0;
}

static const place *find(const model *this, uint32_t variable, unsigned *kind)
{
    const uint32_t number = (variable - 1) / VARIABLES;

    if (variable == 0 || number >= dampers_count) {
        return NULL;
    }
    *kind = (variable - 1) % VARIABLES;
    return &this->places[number];
}

model *model_new(const char *resources, char *reason, size_t reason_bytes)
{
    damper_damper *loaded = dampers_new(resources, reason, reason_bytes);
    model *this;

    if (loaded == NULL) {
        return NULL;
    }
    this = malloc(sizeof *this + dampers_count * sizeof this->places[0]);
    if (this == NULL) {
        (void)snprintf(reason, reason_bytes, "not enough memory");
        dampers_free(loaded);
        return NULL;
    }
    this->as_loaded = loaded;
    this->dampers = malloc(dampers_count * sizeof *this->dampers);
    this->states = malloc(dampers_count * sizeof *this->states);
    this->displacements_m = malloc(dampers_count * sizeof *this->displacements_m);
    if (this->dampers == NULL || this->states == NULL || this->displacements_m == NULL) {
        (void)snprintf(reason, reason_bytes, "not enough memory");
        model_free(this);
        return NULL;
    }
    model_reset(this);
    return this;
}

void model_free(model *this)
{
    if (this != NULL) {
        dampers_free(this->as_loaded);
        free(this->dampers);
        free(this->states);
        free(this->displacements_m);
        free(this);
    }
}

void model_reset(model *this)
{
    unsigned number;

    memcpy(this->dampers, this->as_loaded, dampers_count * sizeof *this->dampers);
    this->reported = 0;
    this->is_started = false;
    for (number = 0; number < dampers_count; number++) {
        place *at = &this->places[number];

        at->displacement_m = 0;
        at->velocity_m_per_s = 0;
        at->clearance_m = (double)damper_clearance_m(&this->dampers[number]);
        forget_derivatives(at);
        start(this, number);
    }
}

model_result model_get_real(const model *this, uint32_t variable, double *value)
{
    unsigned kind;
    const place *at = find(this, variable, &kind);

    switch (at == NULL ? VARIABLES : (int)kind) {
    case DISPLACEMENT:
        *value = at->displacement_m;
        return MODEL_DONE;
    case VELOCITY:
        *value = at->velocity_m_per_s;
        return MODEL_DONE;
    case FORCE:
        *value = (double)this->states[at - this->places].force_n;
        return MODEL_DONE;
    case CLEARANCE:
        *value = at->clearance_m;
        return MODEL_DONE;
    default:
        return MODEL_NO_VARIABLE;
    }
}

model_result model_check_real(const model *this, uint32_t variable, double value)
{
    unsigned kind;

    switch (find(this, variable, &kind) == NULL ? VARIABLES : (int)kind) {
    case DISPLACEMENT:
    case VELOCITY:
        return MODEL_DONE;
    case FORCE:
        return MODEL_READ_ONLY;
    case CLEARANCE:
        return value >= 0 && value <= dampers_largest_clearance_m ? MODEL_DONE : MODEL_OUT_OF_RANGE;
    default:
        return MODEL_NO_VARIABLE;
    }
}

void model_set_real(model *this, uint32_t variable, double value)
{
    unsigned kind;
    const place *found = find(this, variable, &kind);
    const size_t number = found == NULL ? 0 : (size_t)(found - this->places);
    place *at = &this->places[number];
    damper_damper *damper = &this->dampers[number];

    if (model_check_real(this, variable, value) != MODEL_DONE) {
        return;
    }
    switch (kind) {
    case DISPLACEMENT:
        at->displacement_m = value;
        break;
    case VELOCITY:
        at->velocity_m_per_s = value;
        break;
    default:
        at->clearance_m = value;
        (void)damper_set_clearance_m(damper, (damper_real)value);
        if (!this->is_started) {
            start(this, (unsigned)number);
        } else if (this->states[number].revision != damper->revision) {
            /* The next step would do the same; this way, a state always belongs to its damper. */
            damper_adopt(damper, &this->states[number]);
        }
    }
}

model_result model_set_derivative(model *this, uint32_t variable, double value)
{
    unsigned kind;
    const place *found = find(this, variable, &kind);
    place *at;

    if (found == NULL) {
        return MODEL_NO_VARIABLE;
    }
    at = &this->places[found - this->places];
    switch (kind) {
    case DISPLACEMENT:
        at->derivative_m_per_s = value;
        at->is_derived = 1;
        return MODEL_DONE;
    case VELOCITY:
        at->derivative_m_per_s2 = value;
        return MODEL_DONE;
    default:
        return MODEL_NO_VARIABLE;
    }
}

model_result model_get_integer(const model *this, uint32_t variable, int32_t *value)
{
    unsigned kind;
    const place *at = find(this, variable, &kind);

    if (at != NULL && kind == STATUS) {
        *value = (int32_t)damper_status(&this->states[at - this->places]);
    } else if (at != NULL && kind == REJECTED_INPUTS) {
        *value = this->states[at - this->places].rejected_inputs;
    } else {
        return MODEL_NO_VARIABLE;
    }
    return MODEL_DONE;
}

const char *model_allowed(uint32_t variable)
{
    return variable != 0 && (variable - 1) % VARIABLES == CLEARANCE ? "a clearance of 0 to 0.1 m" : "any number";
}

void model_start(model *this)
{
    unsigned number;

    for (number = 0; number < dampers_count; number++) {
        start(this, number);
    }
    this->is_started = true;
}

/* Mean velocity over a communication step of h. */
static double velocity(const place *at, double h)
{
    if (at->is_derived != 0) {
        return at->derivative_m_per_s;
    }
    return at->derivative_m_per_s2 == 0 ? at->velocity_m_per_s : at->velocity_m_per_s + 0.5 * h * at->derivative_m_per_s2;
}

uint64_t model_step(model *this, uint64_t steps)
{
    const double h = (double)steps * model_step_s;
    unsigned number;
    uint64_t step;

    for (number = 0; number < dampers_count; number++) {
        place *at = &this->places[number];

        at->to_m = at->displacement_m + velocity(at, h) * h;
        at->from_m = at->reached_m == nowhere_m ? at->to_m : at->reached_m;
        forget_derivatives(at);
    }
    for (step = 1; step <= steps; step++) {
        const double part = (double)step / (double)steps;

        for (number = 0; number < dampers_count; number++) {
            const place *at = &this->places[number];
            const double displacement_m = step < steps ? at->from_m + (at->to_m - at->from_m) * part : at->to_m;

            this->displacements_m[number] = (damper_real)displacement_m;
        }
        dampers_step(this->dampers, this->states, this->displacements_m);
    }
    for (number = 0; number < dampers_count; number++) {
        place *at = &this->places[number];

        if (is_good(&this->dampers[number], at->to_m)) {
            at->reached_m = at->to_m;
        }
    }
    return steps;
}

bool model_has_ended(const model *this)
{
    (void)this;
    return false;
}

bool model_has_failed(const model *this)
{
    (void)this;
    return false;
}

const char *model_notice(model *this)
{
    unsigned number, bits = 0;

    for (number = 0; number < dampers_count; number++) {
        bits |= damper_status(&this->states[number]);
    }
    bits &= (DAMPER_INPUT_HELD | DAMPER_INPUT_LIMITED | DAMPER_CORRUPTED | DAMPER_RESTARTED) & ~this->reported;
    this->reported |= bits;
    if (bits & DAMPER_CORRUPTED) {
        return "the memory of a damper was damaged: it started over at rest";
    }
    if (bits & DAMPER_RESTARTED) {
        return "a displacement jumped too far to catch up with: the damper restarted at rest there, without force";
    }
    if (bits & DAMPER_INPUT_HELD) {
        return "a displacement was not finite, beyond limits.displacement_m or too far away: the last one was held";
    }
    if (bits & DAMPER_INPUT_LIMITED) {
        return "a displacement moved faster than its damper allows: it was followed at the largest rate";
    }
    return NULL;
}

/* Header of a damper, before its state. */
enum { PLACE_REALS = 7, PLACE_BYTES = PLACE_REALS * 8 + DAMPER_STATE_BYTES };

static uint8_t *put_reals(uint8_t *bytes, const place *at)
{
    bytes = model_put_real(bytes, at->clearance_m);
    bytes = model_put_real(bytes, at->displacement_m);
    bytes = model_put_real(bytes, at->velocity_m_per_s);
    bytes = model_put_real(bytes, at->reached_m);
    bytes = model_put_real(bytes, at->derivative_m_per_s);
    bytes = model_put_real(bytes, at->is_derived);
    return model_put_real(bytes, at->derivative_m_per_s2);
}

static const uint8_t *take_reals(const uint8_t *bytes, place *at)
{
    bytes = model_take_real(bytes, &at->clearance_m);
    bytes = model_take_real(bytes, &at->displacement_m);
    bytes = model_take_real(bytes, &at->velocity_m_per_s);
    bytes = model_take_real(bytes, &at->reached_m);
    bytes = model_take_real(bytes, &at->derivative_m_per_s);
    bytes = model_take_real(bytes, &at->is_derived);
    return model_take_real(bytes, &at->derivative_m_per_s2);
}

size_t model_saved_bytes(const model *this)
{
    (void)this;
    return 2 * 4 + dampers_count * PLACE_BYTES;
}

void model_save(const model *this, uint8_t *bytes)
{
    unsigned number;

    bytes = model_put(bytes, this->reported, 4);
    bytes = model_put(bytes, this->is_started, 4);
    for (number = 0; number < dampers_count; number++) {
        bytes = put_reals(bytes, &this->places[number]);
        damper_save(&this->states[number], bytes);
        bytes += DAMPER_STATE_BYTES;
    }
}

/* Reads a damper's clearance and state from bytes. */
static bool restored(const damper_damper *of, damper_damper *damper, place *at, damper_state *state,
                     const uint8_t *bytes)
{
    *damper = *of;
    bytes = take_reals(bytes, at);
    return at->clearance_m >= 0 && at->clearance_m <= dampers_largest_clearance_m && at->reached_m - at->reached_m == 0
           && damper_set_clearance_m(damper, (damper_real)at->clearance_m) == DAMPER_DONE
           && damper_restore(damper, state, bytes) == DAMPER_DONE;
}

/* All dampers are read before any is changed. */
model_result model_restore(model *this, const uint8_t *bytes)
{
    const uint8_t *const first = bytes + 2 * 4;
    damper_damper damper;
    damper_state state;
    place at;
    uint64_t reported, is_started;
    unsigned number;

    for (number = 0; number < dampers_count; number++) {
        if (!restored(&this->dampers[number], &damper, &at, &state, first + (size_t)number * PLACE_BYTES)) {
            return MODEL_OTHER;
        }
    }
    (void)model_take(model_take(bytes, &reported, 4), &is_started, 4);
    this->reported = (unsigned)reported;
    this->is_started = is_started != 0;
    for (number = 0; number < dampers_count; number++) {
        (void)restored(&this->dampers[number], &damper, &at, &state, first + (size_t)number * PLACE_BYTES);
        this->dampers[number] = damper;
        this->places[number] = at;
        this->states[number] = state;
    }
    return MODEL_DONE;
}
