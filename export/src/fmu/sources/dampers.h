/* The dampers of this FMU, and how they come to be. */

#ifndef DASHPOT_DAMPERS_H
#define DASHPOT_DAMPERS_H

#include <stddef.h>

#include "damper.h"

/* The dampers that this FMU was exported with. */
extern const damper_damper *const dampers_as_built[];
extern const unsigned dampers_count;

/* Largest clearance (m), which is the largest of any damper. */
extern const double dampers_largest_clearance_m;

/* The dampers for one instance, to be freed with dampers_free: those as built, or where this FMU loads them, those of the
 * images in `resources`. NULL with a reason. */
damper_damper *dampers_new(const char *resources, char *reason, size_t reason_bytes);
void dampers_free(damper_damper *dampers);

#endif
