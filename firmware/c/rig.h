/* Sensors and actuators. Replace rig.c by yours. */
#ifndef RIG_H
#define RIG_H

#include <stdint.h>

#include "bank.h"

/* Reads the displacement of each damper (m), positive in extension. A failed reading is not a number. */
void rig_read(uint32_t tick, float displacements_m[DAMPERS]);

/* Sends the force of each damper (N) to its actuator. */
void rig_drive(const float forces_n[DAMPERS]);

/* Hash of the bits of all forces so far: an image that computes the forces of another prints the same. */
uint32_t rig_hash(void);

#endif
