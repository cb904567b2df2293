/* In place of a rig: parabolic arcs as displacements, one sensor that fails for 50 ms each second, and a hash of all
 * forces. */
#include "rig.h"

#include <math.h>
#include <string.h>

static uint32_t hash = 2166136261U;

void rig_read(uint32_t tick, float displacements_m[DAMPERS])
{
    for (uint32_t i = 0; i < DAMPERS; i++) {
        const uint32_t half = 200U + 35U * i; /* ticks of an arc, different for each damper */
        const uint32_t in_arc = tick % half;
        const float arc = (float)(in_arc * (half - in_arc)) * (0.012F / (float)(half * half)); /* up to 3 mm */

        displacements_m[i] = (tick / half) % 2U == 0U ? arc : -arc;
    }
    if (tick % 1000U >= 500U && tick % 1000U < 550U) {
        displacements_m[1] = NAN;
    }
}

void rig_drive(const float forces_n[DAMPERS])
{
    for (size_t i = 0; i < DAMPERS; i++) {
        uint32_t bits;

        memcpy(&bits, &forces_n[i], sizeof bits);
        hash = (hash ^ bits) * 16777619U; /* FNV-1a, a word at a time */
    }
}

uint32_t rig_hash(void)
{
    return hash;
}
