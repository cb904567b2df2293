/* The bank with dampers in portable C: dashpot export --lang c --standalone --step-us 1000. */
#include "bank.h"
#include "in_service.h"
#include "reduced_lateral.h"
#include "reduced_vertical.h"

enum { PER_KIND = 4 };

/* Names of the dampers, each with the index of the first one. */
#define EACH_KIND(DO)                         \
    DO(in_service, IN_SERVICE, 0U)            \
    DO(reduced_vertical, REDUCED_VERTICAL, 4U) \
    DO(reduced_lateral, REDUCED_LATERAL, 8U)

#define STATES(kind, KIND, first) static kind##_state kind##_states[PER_KIND];
EACH_KIND(STATES)

const char *bank_start(const float displacements_m[DAMPERS])
{
#define START(kind, KIND, first)                                                                 \
    if (kind##_digest(&kind##_as_built) != KIND##_DIGEST) {                                      \
        return "the compiler or its options change the forces";                                  \
    }                                                                                            \
    if (kind##_as_built.step_s != STEP_S) {                                                       \
        return "a damper is made for another tick";                                              \
    }                                                                                            \
    for (size_t i = 0; i < PER_KIND; i++) {                                                      \
        kind##_at_rest(&kind##_as_built, &kind##_states[i], displacements_m[first + i]);         \
    }
    EACH_KIND(START)
    return NULL;
}

void bank_step(const float displacements_m[DAMPERS], float forces_n[DAMPERS])
{
#define STEP(kind, KIND, first)                                                                             \
    for (size_t i = 0; i < PER_KIND; i++) {                                                                 \
        forces_n[first + i] = kind##_step(&kind##_as_built, &kind##_states[i], displacements_m[first + i]); \
    }
    EACH_KIND(STEP)
}

unsigned bank_take_status(size_t damper)
{
    unsigned status = 0;

#define TAKE(kind, KIND, first)                                  \
    if (damper - first < PER_KIND) {                             \
        status = kind##_status(&kind##_states[damper - first]);  \
        kind##_clear_status(&kind##_states[damper - first]);     \
    }
    EACH_KIND(TAKE)
    return status;
}
