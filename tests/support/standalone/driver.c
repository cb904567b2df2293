/* Reads requests from standard input and answers each on standard output: the returned value, the state as it is in
 * memory, and the state as it is saved. */
#include <stdio.h>

#include "damper.h"

enum { AT_REST, STEP, SET_CLEARANCE, ADOPT, RESTORE, OVERWRITE, CLEAR_STATUS };

typedef union payload {
    prefix_real number;
    uint8_t bytes[PREFIX_STATE_BYTES];
    prefix_state state;
} payload;

int main(void)
{
    prefix_damper damper = prefix_as_built;
    prefix_state state;
    payload request;
    uint8_t saved[PREFIX_STATE_BYTES];
    int kind;

    prefix_at_rest(&damper, &state, 0);
    while ((kind = getchar()) != EOF && fread(&request, sizeof request, 1, stdin) == 1) {
        prefix_result result = PREFIX_DONE;
        prefix_real number = 0;

        switch (kind) {
        case AT_REST:
            prefix_at_rest(&damper, &state, request.number);
            break;
        case STEP:
            number = prefix_step(&damper, &state, request.number);
            break;
        case SET_CLEARANCE:
            result = prefix_set_clearance_m(&damper, request.number);
            number = prefix_clearance_m(&damper);
            break;
        case ADOPT:
            prefix_adopt(&damper, &state);
            number = prefix_force_limit_n(&damper);
            break;
        case RESTORE:
            result = prefix_restore(&damper, &state, request.bytes);
            break;
        case OVERWRITE:
            state = request.state;
            break;
        case CLEAR_STATUS:
            prefix_clear_status(&state);
            break;
        default:
            return 1;
        }
        prefix_save(&state, saved);
        putchar((int)result);
        (void)fwrite(&number, sizeof number, 1, stdout);
        (void)fwrite(&state, sizeof state, 1, stdout);
        (void)fwrite(saved, sizeof saved, 1, stdout);
    }
    return 0;
}
