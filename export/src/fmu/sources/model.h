/* What stands behind the interface: variables by number, a state at rest, steps of one size. */

#ifndef DASHPOT_MODEL_H
#define DASHPOT_MODEL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Sums and products are rounded one by one, as they are written. */
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#elif defined(__GNUC__)
#pragma GCC optimize("fp-contract=off")
#elif defined(_MSC_VER)
#pragma fp_contract(off)
#endif

typedef struct model model;

typedef enum model_result {
    MODEL_DONE,
    MODEL_NO_VARIABLE,   /* no variable of this type has the number */
    MODEL_READ_ONLY,     /* it is computed */
    MODEL_OUT_OF_RANGE,  /* the value is not allowed; the variable keeps the one it has */
    MODEL_OTHER          /* saved bytes of another model, or damaged */
} model_result;

/* The fixed internal step (s), and what tells this model from others. */
extern const double model_step_s;
extern const char model_token[];

/* A model with its start values; NULL with a reason where there is no memory or `resources` (a folder) lacks a file. */
model *model_new(const char *resources, char *reason, size_t reason_bytes);
void model_free(model *this);

/* Start values again. */
void model_reset(model *this);

/* Variables from 1 on; 0 is the time. A derivative is that of an input, for the next step alone. Whether a value may be set is known
 * before it is. */
model_result model_get_real(const model *this, uint32_t variable, double *value);
model_result model_check_real(const model *this, uint32_t variable, double value);
void model_set_real(model *this, uint32_t variable, double value);
model_result model_set_derivative(model *this, uint32_t variable, double value);
model_result model_get_integer(const model *this, uint32_t variable, int32_t *value);

/* What is allowed for a variable, in words. */
const char *model_allowed(uint32_t variable);

/* Ends the initialization: at rest at the inputs. */
void model_start(model *this);

/* Steps of model_step_s, the last at the communication point to come, and how many it took: fewer where the model ends on the way. */
uint64_t model_step(model *this, uint64_t steps);

/* Whether it goes no further, and whether that is a failure; model_notice says why. */
bool model_has_ended(const model *this);
bool model_has_failed(const model *this);

/* What happened since it was last asked and should be told; NULL where nothing did. */
const char *model_notice(model *this);

/* All that changes, as bytes of a fixed number; little-endian. */
size_t model_saved_bytes(const model *this);
void model_save(const model *this, uint8_t *bytes);
/* Refused, the model stays as it is. */
model_result model_restore(model *this, const uint8_t *bytes);

/* Numbers as bytes, and back; each returns where the next stands. */
uint8_t *model_put(uint8_t *to, uint64_t value, unsigned bytes);
const uint8_t *model_take(const uint8_t *from, uint64_t *value, unsigned bytes);
uint8_t *model_put_real(uint8_t *to, double value);
const uint8_t *model_take_real(const uint8_t *from, double *value);

#endif
