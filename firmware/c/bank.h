/* A bank of dampers: each end of the two bogies has one in-service, one reduced vertical and one reduced lateral
 * damper. bank_portable.c and bank_library.c implement it; the forces are the same. */
#ifndef BANK_H
#define BANK_H

#include <stddef.h>

enum { DAMPERS = 12 };

/* Step for which the dampers are made (s). */
#define STEP_S 1e-3F

/* Status bits of portable C and of the library. */
enum { STATUS_HELD = 1, STATUS_CORRUPTED = 16, STATUS_RESTARTED = 32 };

/* Starts each damper at rest at its displacement (m). Returns a null pointer, or the reason why no damper may run.
 * Takes some thousand steps. */
const char *bank_start(const float displacements_m[DAMPERS]);

/* Steps all dampers to their displacements (m) and writes their forces (N). */
void bank_step(const float displacements_m[DAMPERS], float forces_n[DAMPERS]);

/* Returns the status bits of a damper and clears them. */
unsigned bank_take_status(size_t damper);

#endif
