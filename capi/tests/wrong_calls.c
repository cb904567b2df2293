/* Makes wrong calls. The program fails if a call is not refused or changes anything. */
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "dashpot.h"

static int failed;

static void expect(const char *call, dashpot_error expected, dashpot_error found)
{
    if (found != expected) {
        fprintf(stderr, "%s: %s\n", call, dashpot_error_text(found));
        failed = 1;
    }
}

int main(void)
{
    static dashpot_damper damper, before;
    static dashpot_state state;
    static dashpot_transfer transfer;
    const dashpot_motion motion = {0.001F, 0.0F, 0.0F, 0.0F};
    dashpot_transfer_settings settings;
    dashpot_command command;
    uint8_t *bytes = (uint8_t *)&damper;
    const uint32_t later = DASHPOT_VERSION + 100U;

    memset(&damper, 0x5a, sizeof damper);
    before = damper;
    expect("init, image in the storage", DASHPOT_ERROR_OVERLAP,
           dashpot_damper_init(&damper, bytes + 1, DASHPOT_IMAGE_SIZE));
    expect("init, image from the last byte of the storage on", DASHPOT_ERROR_OVERLAP,
           dashpot_damper_init(&damper, bytes + sizeof damper - 1, 1));
    expect("describe", DASHPOT_ERROR_OVERLAP,
           dashpot_damper_describe(&damper, (dashpot_damper_info *)&damper));
    expect("state_init", DASHPOT_ERROR_OVERLAP,
           dashpot_state_init((dashpot_state *)&damper, &damper, 0.0F));
    expect("step", DASHPOT_ERROR_OVERLAP,
           dashpot_step(&damper, &state, 0.0F, (float *)&state.opaque[2]));
    if (memcmp(&damper, &before, sizeof damper) != 0) {
        fprintf(stderr, "a refused call has changed the damper\n");
        failed = 1;
    }

    expect("transfer_settings_init", DASHPOT_ERROR_NONE,
           dashpot_transfer_settings_init(&settings, 0.05F, 0.5F, 20e3F));
    expect("transfer_init, settings in the storage", DASHPOT_ERROR_OVERLAP,
           dashpot_transfer_init(&transfer, (dashpot_transfer_settings *)&transfer, 1e-3F));
    expect("transfer_tick without a system", DASHPOT_ERROR_NO_TRANSFER,
           dashpot_transfer_tick(&transfer, &motion, NULL, &command));
    expect("transfer_init", DASHPOT_ERROR_NONE, dashpot_transfer_init(&transfer, &settings, 1e-3F));
    expect("transfer_tick, command in the system", DASHPOT_ERROR_OVERLAP,
           dashpot_transfer_tick(&transfer, &motion, NULL, (dashpot_command *)&transfer.opaque[9]));
    expect("transfer_tick", DASHPOT_ERROR_NONE, dashpot_transfer_tick(&transfer, &motion, NULL, &command));
    if (command.status != DASHPOT_HYBRID_MEASUREMENT_MISSED) {
        fprintf(stderr, "transfer_tick: status %u\n", (unsigned)command.status);
        failed = 1;
    }

    expect("check_header", DASHPOT_ERROR_NONE, DASHPOT_CHECK_HEADER());
    expect("check_header, later version", DASHPOT_ERROR_HEADER,
           dashpot_check_header(later, sizeof damper, sizeof state));
    expect("check_header, other size", DASHPOT_ERROR_HEADER,
           dashpot_check_header(DASHPOT_VERSION, sizeof damper - 4, sizeof state));
    if (dashpot_version() != DASHPOT_VERSION) {
        fprintf(stderr, "version %u\n", (unsigned)dashpot_version());
        failed = 1;
    }
    return failed;
}
