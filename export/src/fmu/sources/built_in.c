
/* Dampers with built-in constants. */

#include <stdio.h>
#include <stdlib.h>

#include "dampers.h"

const double dampers_largest_clearance_m = 0.1;

damper_damper *dampers_new(const char *resources, char *reason, size_t reason_bytes)
{
    damper_damper *dampers = malloc(dampers_count * sizeof *dampers);
    unsigned number;

    (void)resources;
    if (dampers == NULL) {
        (void)snprintf(reason, reason_bytes, "not enough memory");
        return NULL;
    }
    for (number = 0; number < dampers_count; number++) {
        dampers[number] = *dampers_as_built[number];
    }
    return dampers;
}

void dampers_free(damper_damper *dampers)
{
    free(dampers);
}
