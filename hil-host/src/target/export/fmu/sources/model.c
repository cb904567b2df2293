/* A bank of dampers: displacement in, force out.
 *
 * A communication step ends at the displacement `displacement_m + h velocity_m_per_s`; on the way there the
 * displacement is linear over the internal steps. Without velocity the force at t + h is thus that of the displacement
 * given at t: one communication step late. With it the force belongs to t + h. */

#include "model.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "dampers.h"

/* Variables of each damper, in their order from 1 on. */
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
    damper_state state;
    double displacement_m;
    double velocity_m_per_s;
    double derivative_m_per_s;  /* of the displacement, for the next communication step */
    double reached_m;           /* the displacement at the last communication point */
} place;

struct model {
    damper_damper *dampers;
    damper_damper *as_loaded;
    unsigned told;              /* status bits of any damper that were told */
    place places[];
};

static void start(model *this, unsigned number)
{
    place *at = &this->places[number];
    const damper_real displacement = (damper_real)at->displacement_m;

    damper_at_rest(&this->dampers[number], &at->state, displacement);
    at->reached_m = (double)at->state.displacement_m == (double)displacement ? at->displacement_m : 0;
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
    if (this != NULL) {
        this->as_loaded = loaded;
        this->dampers = malloc(dampers_count * sizeof *this->dampers);
    }
    if (this == NULL || this->dampers == NULL) {
        (void)snprintf(reason, reason_bytes, "not enough memory");
        dampers_free(loaded);
        free(this);
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
        free(this);
    }
}

void model_reset(model *this)
{
    unsigned number;

    memcpy(this->dampers, this->as_loaded, dampers_count * sizeof *this->dampers);
    this->told = 0;
    for (number = 0; number < dampers_count; number++) {
        place *at = &this->places[number];

        at->displacement_m = 0;
        at->velocity_m_per_s = 0;
        at->derivative_m_per_s = 0;
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
        *value = (double)at->state.force_n;
        return MODEL_DONE;
    case CLEARANCE:
        *value = (double)damper_clearance_m(&this->dampers[at - this->places]);
        return MODEL_DONE;
    default:
        return MODEL_NO_VARIABLE;
    }
}

model_result model_set_real(model *this, uint32_t variable, double value)
{
    unsigned kind;
    const place *found = find(this, variable, &kind);
    place *at;
    damper_damper *damper;

    if (found == NULL) {
        return MODEL_NO_VARIABLE;
    }
    at = &this->places[found - this->places];
    damper = &this->dampers[found - this->places];
    switch (kind) {
    case DISPLACEMENT:
        at->displacement_m = value;
        return MODEL_DONE;
    case VELOCITY:
        at->velocity_m_per_s = value;
        return MODEL_DONE;
    case FORCE:
        return MODEL_READ_ONLY;
    case CLEARANCE:
        /* In double precision first: rounded, a number beyond the largest may be the largest. */
        if (!(value >= 0 && value <= dampers_largest_clearance_m)
            || damper_set_clearance_m(damper, (damper_real)value) != DAMPER_DONE) {
            return MODEL_OUT_OF_RANGE;
        }
        /* As the next step would: a state is always of its damper. */
        if (at->state.revision != damper->revision) {
            damper_adopt(damper, &at->state);
        }
        return MODEL_DONE;
    default:
        return MODEL_NO_VARIABLE;
    }
}

model_result model_set_derivative(model *this, uint32_t variable, double value)
{
    unsigned kind;
    const place *found = find(this, variable, &kind);

    if (found == NULL || kind != DISPLACEMENT) {
        return MODEL_NO_VARIABLE;
    }
    this->places[found - this->places].derivative_m_per_s = value;
    return MODEL_DONE;
}

model_result model_get_integer(const model *this, uint32_t variable, int32_t *value)
{
    unsigned kind;
    const place *at = find(this, variable, &kind);

    if (at != NULL && kind == STATUS) {
        *value = (int32_t)damper_status(&at->state);
    } else if (at != NULL && kind == REJECTED_INPUTS) {
        *value = at->state.rejected_inputs;
    } else {
        return MODEL_NO_VARIABLE;
    }
    return MODEL_DONE;
}

const char *model_allowed(uint32_t variable)
{
    return variable != 0 && (variable - 1) % VARIABLES == CLEARANCE ? "0 to 0.1 m" : "any number";
}

void model_start(model *this)
{
    unsigned number;

    for (number = 0; number < dampers_count; number++) {
        start(this, number);
    }
}

void model_step(model *this, uint64_t steps)
{
    unsigned number;
    uint64_t step;

    for (number = 0; number < dampers_count; number++) {
        const damper_damper *damper = &this->dampers[number];
        place *at = &this->places[number];
        const double velocity = at->velocity_m_per_s + at->derivative_m_per_s;
        const double from = at->reached_m;
        const double move = velocity == 0 ? 0 : velocity * ((double)steps * model_step_s);
        const double to = at->displacement_m + move;

        for (step = 1; step < steps; step++) {
            const double part = (double)step / (double)steps;

            (void)damper_step(damper, &at->state, (damper_real)(from + (to - from) * part));
        }
        (void)damper_step(damper, &at->state, (damper_real)to);
        at->derivative_m_per_s = 0;
        if (to - to == 0) {
            at->reached_m = to;
        }
    }
}

const char *model_notice(model *this)
{
    unsigned number, bits = 0;

    for (number = 0; number < dampers_count; number++) {
        bits |= damper_status(&this->places[number].state);
    }
    bits &= (DAMPER_INPUT_HELD | DAMPER_INPUT_LIMITED | DAMPER_CORRUPTED) & ~this->told;
    this->told |= bits;
    if (bits & DAMPER_CORRUPTED) {
        return "the memory of a damper was damaged: it started over at rest";
    }
    if (bits & DAMPER_INPUT_HELD) {
        return "a displacement was NaN or infinite: the last good one was held";
    }
    if (bits & DAMPER_INPUT_LIMITED) {
        return "a displacement moved faster than its damper allows: it was followed at the largest rate";
    }
    return NULL;
}

enum { PLACE_BYTES = 5 * 8 + DAMPER_STATE_BYTES };

size_t model_saved_bytes(const model *this)
{
    (void)this;
    return 4 + dampers_count * PLACE_BYTES;
}

void model_save(const model *this, uint8_t *bytes)
{
    unsigned number;

    bytes = model_put(bytes, this->told, 4);
    for (number = 0; number < dampers_count; number++) {
        const place *at = &this->places[number];

        bytes = model_put_real(bytes, (double)damper_clearance_m(&this->dampers[number]));
        bytes = model_put_real(bytes, at->displacement_m);
        bytes = model_put_real(bytes, at->velocity_m_per_s);
        bytes = model_put_real(bytes, at->derivative_m_per_s);
        bytes = model_put_real(bytes, at->reached_m);
        damper_save(&at->state, bytes);
        bytes += DAMPER_STATE_BYTES;
    }
}

/* All are read before any is written. */
model_result model_restore(model *this, const uint8_t *bytes)
{
    const uint8_t *const first = bytes + 4;
    unsigned number;
    uint64_t told;

    for (number = 0, bytes = first; number < dampers_count; number++, bytes += PLACE_BYTES) {
        damper_damper damper = this->dampers[number];
        damper_state state;
        double clearance_m;

        (void)model_take_real(bytes, &clearance_m);
        if (damper_set_clearance_m(&damper, (damper_real)clearance_m) != DAMPER_DONE
            || damper_restore(&damper, &state, bytes + 5 * 8) != DAMPER_DONE) {
            return MODEL_OTHER;
        }
    }
    (void)model_take(first - 4, &told, 4);
    this->told = (unsigned)told;
    for (number = 0, bytes = first; number < dampers_count; number++) {
        place *at = &this->places[number];
        double clearance_m;

        bytes = model_take_real(bytes, &clearance_m);
        (void)damper_set_clearance_m(&this->dampers[number], (damper_real)clearance_m);
        bytes = model_take_real(bytes, &at->displacement_m);
        bytes = model_take_real(bytes, &at->velocity_m_per_s);
        bytes = model_take_real(bytes, &at->derivative_m_per_s);
        bytes = model_take_real(bytes, &at->reached_m);
        (void)damper_restore(&this->dampers[number], &at->state, bytes);
        bytes += DAMPER_STATE_BYTES;
    }
    return MODEL_DONE;
}
