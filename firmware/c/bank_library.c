/* The bank with Dashpot's C library: dashpot export --lang c --step-us 1000. */
#include "bank.h"
#include "dashpot.h"
#include "in_service.h"
#include "reduced_lateral.h"
#include "reduced_vertical.h"

enum { KINDS = 3 };

static dashpot_damper kinds[KINDS];
static const dashpot_damper *dampers[DAMPERS];
static dashpot_state states[DAMPERS];
static dashpot_check checks[KINDS];
static unsigned damage; /* STATUS_CORRUPTED after the check of the constants found damage */

static dashpot_error start(const float displacements_m[DAMPERS])
{
    const uint8_t *const images[KINDS] = {IN_SERVICE, REDUCED_VERTICAL, REDUCED_LATERAL};
    dashpot_damper_info info;
    dashpot_error error = DASHPOT_CHECK_HEADER();

    for (size_t i = 0; i < KINDS && error == DASHPOT_ERROR_NONE; i++) {
        error = dashpot_damper_init(&kinds[i], images[i], DASHPOT_IMAGE_SIZE);
        if (error == DASHPOT_ERROR_NONE) {
            error = dashpot_damper_describe(&kinds[i], &info);
        }
        if (error == DASHPOT_ERROR_NONE && info.step_s != STEP_S) {
            error = DASHPOT_ERROR_RANGE;
        }
    }
    for (size_t i = 0; i < DAMPERS && error == DASHPOT_ERROR_NONE; i++) {
        dampers[i] = &kinds[i / (DAMPERS / KINDS)];
        error = dashpot_state_init(&states[i], dampers[i], displacements_m[i]);
    }
    return error;
}

const char *bank_start(const float displacements_m[DAMPERS])
{
    const dashpot_error error = start(displacements_m);

    return error == DASHPOT_ERROR_NONE ? NULL : dashpot_error_text(error);
}

void bank_step(const float displacements_m[DAMPERS], float forces_n[DAMPERS])
{
    static size_t checked;

    checked = (checked + 1U) % KINDS;
    if (dashpot_step_bank(dampers, states, displacements_m, forces_n, DAMPERS) != DASHPOT_ERROR_NONE
        || dashpot_check_slice(&kinds[checked], &states[DAMPERS / KINDS * checked], &checks[checked])
               != DASHPOT_ERROR_NONE) {
        damage = STATUS_CORRUPTED;
    }
}

unsigned bank_take_status(size_t damper)
{
    dashpot_reading reading;

    if (dashpot_state_read(&states[damper], &reading) != DASHPOT_ERROR_NONE
        || dashpot_state_clear_status(&states[damper]) != DASHPOT_ERROR_NONE) {
        return STATUS_CORRUPTED;
    }
    return reading.status | damage;
}
