/* An instance of the model: its phases, its time as a count of steps, its messages, its states. */

#include "component.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Tolerance of a communication step's size, as a fraction of an internal step. */
#define CLOSE 1e-6

/* Tolerance of a step's start time: importers that add up steps also add up rounding errors. */
#define CLOSE_AT 0.1

/* Relative spacing of double-precision numbers. */
#define EPSILON 2.220446049250313e-16

/* Maximum number of internal steps in a communication step and in a run; a double cannot resolve more as a time. */
#define MAX_STEPS 1e9
#define MAX_TOTAL_STEPS 4503599627370496.0

const char *const component_categories[COMPONENT_ERROR + 1] = {
    NULL, "logStatusWarning", "logStatusDiscard", "logStatusError"
};

component_status component_tell(component *this, component_status status, const char *format, ...)
{
    char message[4800];
    va_list values;

    va_start(values, format);
    (void)vsnprintf(message, sizeof message, format, values);
    va_end(values);
    if (status == COMPONENT_ERROR) {
        this->phase = FAILED;
    }
    if (status == COMPONENT_ERROR || (this->logs && (this->categories & 1U << status) != 0)) {
        this->log(this, status, component_categories[status], message);
    }
    return status;
}

component *component_new(const component *with, const char *token, const char *resources)
{
    component *this = malloc(sizeof *this);
    const char *name = with->name;
    char reason[4600];

    if (this == NULL) {
        return NULL;
    }
    *this = *with;
    this->model = NULL;
    this->phase = INSTANTIATED;
    this->categories = ~0U;
    this->start_s = 0;
    this->stop_s = HUGE_VAL;
    this->steps = 0;
    this->name = malloc(strlen(name) + 1);
    if (this->name == NULL) {
        free(this);
        return NULL;
    }
    memcpy(this->name, name, strlen(name) + 1);
    if (token == NULL || strcmp(token, model_token) != 0) {
        (void)component_tell(this, COMPONENT_ERROR, "the description belongs to another FMU: its token is %.200s, this is %s",
                             token == NULL ? "missing" : token, model_token);
    } else if ((this->model = model_new(resources, reason, sizeof reason)) == NULL) {
        (void)component_tell(this, COMPONENT_ERROR, "%s", reason);
    }
    if (this->model == NULL) {
        component_free(this);
        return NULL;
    }
    return this;
}

void component_free(component *this)
{
    if (this != NULL) {
        model_free(this->model);
        free(this->name);
        free(this);
    }
}

bool component_allows(component *this, unsigned phases, const char *function)
{
    static const char *const names[] = {"instantiated", "initializing", "stepping", "terminated", "failed"};
    unsigned phase = 0;

    if (this == NULL) {
        return false;
    }
    if ((this->phase & phases) != 0) {
        return true;
    }
    while (1U << phase != (unsigned)this->phase) {
        phase++;
    }
    (void)component_tell(this, COMPONENT_ERROR, "%s is not allowed while the instance is %s", function, names[phase]);
    return false;
}

component_status component_set_logging(component *this, bool logs, size_t count, const char *const categories[])
{
    unsigned wanted = 0;
    size_t named;
    int status;

    for (named = 0; named < count; named++) {
        unsigned found = 0;

        for (status = COMPONENT_WARNING; categories[named] != NULL && status <= COMPONENT_ERROR; status++) {
            found |= strcmp(categories[named], component_categories[status]) == 0 ? 1U << status : 0;
        }
        if (found == 0) {
            return component_tell(this, COMPONENT_DISCARD, "no log category %.200s",
                                  categories[named] == NULL ? "NULL" : categories[named]);
        }
        wanted |= found;
    }
    this->logs = logs;
    this->categories = count == 0 ? ~0U : wanted;
    return COMPONENT_OK;
}

double component_time_s(const component *this)
{
    return this->start_s + (double)this->steps * model_step_s;
}

/* Latest time (s) that still resolves a thousandth of an internal step. */
static double latest_s(void)
{
    return 1e-3 / EPSILON * model_step_s;
}

static bool is_time(double time_s)
{
    return fabs(time_s) <= latest_s();
}

static void forget_refused_step(component *this)
{
    this->refused_at_s = this->refused_step_s = HUGE_VAL;
}

component_status component_begin(component *this, double start_s, bool stops, double stop_s)
{
    if (!is_time(start_s) || (stops && !(stop_s >= start_s))) {
        return component_tell(this, COMPONENT_ERROR, "an experiment from %.12g s to %.12g s, allowed: times within %.3g s of 0",
                              start_s, stop_s, latest_s());
    }
    this->start_s = start_s;
    this->stop_s = stops ? stop_s : HUGE_VAL;
    this->steps = 0;
    forget_refused_step(this);
    return COMPONENT_OK;
}

component_status component_end_initialization(component *this)
{
    const char *notice;

    model_start(this->model);
    this->phase = STEPPING;
    notice = model_notice(this->model);
    return notice == NULL ? COMPONENT_OK : component_tell(this, COMPONENT_WARNING, "%s", notice);
}

component_status component_reset(component *this)
{
    model_reset(this->model);
    this->phase = INSTANTIATED;
    this->start_s = 0;
    this->stop_s = HUGE_VAL;
    this->steps = 0;
    return COMPONENT_OK;
}

component_status component_no_variable(component *this, uint32_t variable)
{
    return component_tell(this, COMPONENT_ERROR, "no variable of this type has the value reference %lu",
                          (unsigned long)variable);
}

component_status component_none(component *this, const char *function, const uint32_t variables[], size_t count)
{
    if (!component_allows(this, ANY_BUT_FAILED, function)) {
        return COMPONENT_ERROR;
    }
    return count == 0 ? COMPONENT_OK : component_no_variable(this, variables[0]);
}

component_status component_unsupported(component *this, const char *function)
{
    if (!component_allows(this, ANY_BUT_FAILED, function)) {
        return COMPONENT_ERROR;
    }
    return component_tell(this, COMPONENT_ERROR, "this FMU does not support %s", function);
}

component_status component_get_real(component *this, uint32_t variable, double *value)
{
    if (variable == 0) {
        *value = component_time_s(this);
        return COMPONENT_OK;
    }
    return model_get_real(this->model, variable, value) == MODEL_DONE ? COMPONENT_OK
                                                                      : component_no_variable(this, variable);
}

component_status component_set_reals(component *this, const uint32_t variables[], size_t count, const double values[])
{
    size_t number;

    for (number = 0; number < count; number++) {
        const unsigned long reference = variables[number];

        switch (model_check_real(this->model, variables[number], values[number])) {
        case MODEL_DONE:
            break;
        case MODEL_OUT_OF_RANGE:
            return component_tell(this, COMPONENT_DISCARD, "value reference %lu: %.12g, allowed: %s", reference, values[number],
                                  model_allowed(variables[number]));
        case MODEL_READ_ONLY:
            return component_tell(this, COMPONENT_ERROR, "value reference %lu is an output and cannot be set", reference);
        default:
            return component_no_variable(this, variables[number]);
        }
    }
    for (number = 0; number < count; number++) {
        model_set_real(this->model, variables[number], values[number]);
    }
    return COMPONENT_OK;
}

component_status component_get_integer(component *this, uint32_t variable, int32_t *value)
{
    return model_get_integer(this->model, variable, value) == MODEL_DONE ? COMPONENT_OK
                                                                         : component_no_variable(this, variable);
}

/* Refuses a step. Refusing the same step again is an error, because the importer would repeat it forever. */
static component_status refuse_step(component *this, double at_s, double step_s, const char *format, ...)
{
    const bool is_again = this->refused_at_s == at_s && this->refused_step_s == step_s;
    char message[600];
    va_list values;

    va_start(values, format);
    (void)vsnprintf(message, sizeof message, format, values);
    va_end(values);
    this->refused_at_s = at_s;
    this->refused_step_s = step_s;
    return component_tell(this, is_again ? COMPONENT_ERROR : COMPONENT_DISCARD, "%s%s", message,
                          is_again ? "; it was refused before" : "");
}

component_status component_step(component *this, double at_s, double step_s)
{
    const double now_s = component_time_s(this);
    const double count = floor(step_s / model_step_s + 0.5);
    /* A step size that is the difference of two times also has their rounding errors. */
    const double close_s = CLOSE * model_step_s + 4 * EPSILON * fabs(now_s);
    const char *notice;

    if (!(fabs(at_s - now_s) <= CLOSE_AT * model_step_s)) {
        return refuse_step(this, at_s, step_s, "a step from %.12g s, but the last one ended at %.12g s", at_s, now_s);
    }
    if (!(count >= 1 && count <= MAX_STEPS && fabs(step_s - count * model_step_s) <= close_s)) {
        return refuse_step(this, at_s, step_s,
                           "a communication step of %.12g s, allowed: a multiple of the internal step of %.12g s, up to %.0e of it",
                           step_s, model_step_s, MAX_STEPS);
    }
    if (!(now_s + step_s <= this->stop_s + CLOSE_AT * model_step_s)) {
        return component_tell(this, COMPONENT_ERROR, "a step to %.12g s, beyond the stop time of %.12g s", now_s + step_s,
                              this->stop_s);
    }
    if (!(is_time(now_s + step_s) && (double)this->steps + count <= MAX_TOTAL_STEPS)) {
        return refuse_step(this, at_s, step_s, "a step to %.12g s, allowed: times within %.3g s of 0", now_s + step_s, latest_s());
    }
    forget_refused_step(this);
    this->steps += model_step(this->model, (uint64_t)count);
    notice = model_notice(this->model);
    if (model_has_failed(this->model)) {
        return component_tell(this, COMPONENT_ERROR, "%s", notice == NULL ? "the model failed" : notice);
    }
    return notice == NULL ? COMPONENT_OK : component_tell(this, COMPONENT_WARNING, "%s", notice);
}

bool component_has_ended(const component *this)
{
    return model_has_ended(this->model);
}

/* Header of a state: hash of everything that follows, hash of the token, phase, steps, times; then the model. */
enum { HASH_BYTES = 4, HEAD_BYTES = HASH_BYTES + 4 + 4 + 8 + 2 * 8 };

/* FNV-1a (Fowler, Noll, Vo; 32 bit). */
static uint32_t hash(const uint8_t *bytes, size_t count)
{
    uint32_t hash = UINT32_C(0x811c9dc5);

    while (count-- > 0) {
        hash = (hash ^ *bytes++) * UINT32_C(0x01000193);
    }
    return hash;
}

static uint32_t token_hash(void)
{
    return hash((const uint8_t *)model_token, strlen(model_token));
}

static component_state *new_state(component *this, size_t bytes)
{
    component_state *state = malloc(sizeof *state + bytes);

    if (state == NULL) {
        (void)component_tell(this, COMPONENT_ERROR, "not enough memory for a state");
        return NULL;
    }
    state->bytes = bytes;
    return state;
}

component_status component_get_state(component *this, void **pointer)
{
    const size_t bytes = HEAD_BYTES + model_saved_bytes(this->model);
    component_state *state = *pointer == NULL ? new_state(this, bytes) : *pointer;
    uint8_t *to;

    if (state == NULL) {
        return COMPONENT_ERROR;
    }
    to = model_put(state->content + HASH_BYTES, token_hash(), 4);
    to = model_put(to, (uint64_t)this->phase, 4);
    to = model_put(to, this->steps, 8);
    to = model_put_real(to, this->start_s);
    to = model_put_real(to, this->stop_s);
    model_save(this->model, to);
    (void)model_put(state->content, hash(state->content + HASH_BYTES, bytes - HASH_BYTES), HASH_BYTES);
    *pointer = state;
    return COMPONENT_OK;
}

/* True for a complete state of this FMU. */
static bool is_state(const component *this, const uint8_t *bytes, size_t count)
{
    uint64_t stated, token;

    if (count != HEAD_BYTES + model_saved_bytes(this->model)) {
        return false;
    }
    (void)model_take(model_take(bytes, &stated, HASH_BYTES), &token, 4);
    return stated == hash(bytes + HASH_BYTES, count - HASH_BYTES) && token == token_hash();
}

component_status component_set_state(component *this, const component_state *state)
{
    const uint8_t *from;
    uint64_t phase, steps;
    double start_s, stop_s;

    if (state == NULL || !is_state(this, state->content, state->bytes)) {
        return component_tell(this, COMPONENT_DISCARD, "not a state of this FMU");
    }
    from = model_take(state->content + HASH_BYTES + 4, &phase, 4);
    from = model_take(from, &steps, 8);
    from = model_take_real(from, &start_s);
    from = model_take_real(from, &stop_s);
    if (phase == 0 || phase > FAILED || (phase & (phase - 1)) != 0 || !is_time(start_s) || !(stop_s >= start_s)
        || (double)steps > MAX_TOTAL_STEPS || model_restore(this->model, from) != MODEL_DONE) {
        return component_tell(this, COMPONENT_DISCARD, "the state belongs to another model");
    }
    forget_refused_step(this);
    this->phase = (component_phase)phase;
    this->steps = steps;
    this->start_s = start_s;
    this->stop_s = stop_s;
    return COMPONENT_OK;
}

component_status component_free_state(component *this, const char *function, void **state)
{
    if (!component_allows(this, ANY_BUT_FAILED | FAILED, function)) {
        return COMPONENT_ERROR;
    }
    if (state != NULL) {
        free(*state);
        *state = NULL;
    }
    return COMPONENT_OK;
}

component_status component_state_size(component *this, const char *function, const component_state *state, size_t *size)
{
    if (!component_allows(this, ANY_BUT_FAILED, function)) {
        return COMPONENT_ERROR;
    }
    if (state == NULL) {
        return component_tell(this, COMPONENT_DISCARD, "no state");
    }
    *size = state->bytes;
    return COMPONENT_OK;
}

component_status component_serialize(component *this, const component_state *state, uint8_t *bytes, size_t count)
{
    if (state == NULL || count < state->bytes) {
        return component_tell(this, COMPONENT_DISCARD, "%lu bytes for a state of %lu bytes", (unsigned long)count,
                              state == NULL ? 0UL : (unsigned long)state->bytes);
    }
    memcpy(bytes, state->content, state->bytes);
    return COMPONENT_OK;
}

component_status component_deserialize(component *this, const uint8_t *bytes, size_t count, void **pointer)
{
    component_state *state;

    if (!is_state(this, bytes, count)) {
        return component_tell(this, COMPONENT_DISCARD, "the %lu bytes are not a state of this FMU, or are damaged",
                              (unsigned long)count);
    }
    state = *pointer == NULL ? new_state(this, count) : *pointer;
    if (state == NULL) {
        return COMPONENT_ERROR;
    }
    memcpy(state->content, bytes, count);
    *pointer = state;
    return COMPONENT_OK;
}
