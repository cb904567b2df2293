/* The model behind the interface: numbered variables, a state at rest, steps of one size. */

#ifndef DASHPOT_MODEL_H
#define DASHPOT_MODEL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Each sum and product is rounded separately, as written. */
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
    MODEL_NO_VARIABLE,   /* no variable of this type has this number */
    MODEL_READ_ONLY,     /* the variable is computed */
    MODEL_OUT_OF_RANGE,  /* the value is not allowed; the variable is unchanged */
    MODEL_OTHER          /* the saved bytes belong to another model, or are damaged */
} model_result;

/* The fixed internal step (s), and the identity of this model. */
extern const double model_step_s;
extern const char model_token[];

/* Creates a model with its start values. Returns NULL and writes the reason if memory or a file in the folder
 * `resources` is missing. */
model *model_new(const char *resources, char *reason, size_t reason_bytes);
void model_free(model *this);

/* Resets the model to its start values. */
void model_reset(model *this);

/* Variables count from 1; 0 is the time. A derivative belongs to an input and applies to the next step only. Values are
 * checked before they are set. */
model_result model_get_real(const model *this, uint32_t variable, double *value);
model_result model_check_real(const model *this, uint32_t variable, double value);
void model_set_real(model *this, uint32_t variable, double value);
model_result model_set_derivative(model *this, uint32_t variable, double value);
model_result model_get_integer(const model *this, uint32_t variable, int32_t *value);

/* Describes the allowed values of a variable. */
const char *model_allowed(uint32_t variable);

/* Ends the initialization: the model is now at rest at the values of its inputs. */
void model_start(model *this);

/* Runs steps of model_step_s up to the next communication point. Returns their number, which is smaller if the model
 * ends. */
uint64_t model_step(model *this, uint64_t steps);

/* True if the model has ended, and true if it has failed; model_notice gives the reason. */
bool model_has_ended(const model *this);
bool model_has_failed(const model *this);

/* Message about the last event since the previous call; NULL if there was none. */
const char *model_notice(model *this);

/* Saves the state in a fixed number of bytes, little-endian. */
size_t model_saved_bytes(const model *this);
void model_save(const model *this, uint8_t *bytes);
/* Restores a state; on failure the model is unchanged. */
model_result model_restore(model *this, const uint8_t *bytes);

/* Write and read numbers as bytes; each function returns the position of the next number. */
uint8_t *model_put(uint8_t *to, uint64_t value, unsigned bytes);
const uint8_t *model_take(const uint8_t *from, uint64_t *value, unsigned bytes);
uint8_t *model_put_real(uint8_t *to, double value);
const uint8_t *model_take_real(const uint8_t *from, double *value);

#endif
