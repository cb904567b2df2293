/* The dampers of this FMU and how they are created. */

#ifndef DASHPOT_DAMPERS_H
#define DASHPOT_DAMPERS_H

#include <stddef.h>

#include "damper.h"

/* The dampers with which this FMU was exported. */
extern const damper_damper *const dampers_as_built[];
extern const unsigned dampers_count;

/* Maximum clearance (m), the same for all dampers. */
extern const double dampers_largest_clearance_m;

/* Returns dampers for one instance: as built, or, if this FMU loads them, from the images in `resources`. Free them
 * with dampers_free. On failure returns NULL and writes the reason. */
damper_damper *dampers_new(const char *resources, char *reason, size_t reason_bytes);
void dampers_free(damper_damper *dampers);

/* Steps all dampers of an instance one tick, each to its displacement (m). The states and forces are those of
 * damper_step. */
void dampers_step(const damper_damper *dampers, damper_state *states, const damper_real *displacements_m);

#endif
