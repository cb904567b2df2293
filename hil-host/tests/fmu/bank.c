/* Steps the dampers of an FMU called `it` together and prints each state's bytes. Input: displacements as doubles. */

#include <stdio.h>
#include <stdlib.h>

#include "dampers.h"

int main(int count, char **words)
{
    char reason[256];
    it_damper_damper *const dampers = it_dampers_new(NULL, reason, sizeof reason);
    it_damper_state *const states = malloc(it_dampers_count * sizeof *states);
    it_damper_real *const displacements_m = malloc(it_dampers_count * sizeof *displacements_m);
    FILE *const file = count == 2 ? fopen(words[1], "rb") : NULL;
    double next_m;
    unsigned number;

    if (file == NULL || dampers == NULL || states == NULL || displacements_m == NULL) {
        return 1;
    }
    for (number = 0; number < it_dampers_count; number++) {
        it_damper_at_rest(&dampers[number], &states[number], 0);
    }
    number = 0;
    while (fread(&next_m, sizeof next_m, 1, file) == 1) {
        displacements_m[number] = (it_damper_real)next_m;
        number++;
        if (number < it_dampers_count) {
            continue;
        }
        it_dampers_step(dampers, states, displacements_m);
        for (number = 0; number < it_dampers_count; number++) {
            uint8_t bytes[DAMPER_STATE_BYTES];
            unsigned byte;

            it_damper_save(&states[number], bytes);
            for (byte = 0; byte < sizeof bytes; byte++) {
                (void)printf("%02x", bytes[byte]);
            }
            (void)printf("\n");
        }
        number = 0;
    }
    (void)fclose(file);
    free(states);
    free(displacements_m);
    it_dampers_free(dampers);
    return 0;
}
