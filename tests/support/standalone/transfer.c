/* Reads ticks of tests/support/transfer_sequence.rs, runs them, and writes the results. */
#include <stdio.h>
#include <string.h>

#include "transfer.h"

typedef struct row {
    float desired_m;
    float measured[2];
    uint32_t is_measured;
    uint32_t ends;
    uint32_t clears;
} row;

static int put(const void *bytes, size_t length)
{
    return fwrite(bytes, 1, length, stdout) == length;
}

int main(int count, char **arguments)
{
    transfer_settings settings, wrong;
    transfer_system system;
    transfer_motion_filter filter;
    row now;

    if (transfer_digest() != TRANSFER_DIGEST) {
        fprintf(stderr, "digest %08lx\n", (unsigned long)transfer_digest());
        return 2;
    }
    transfer_default_settings(&settings, 0.05f, 0.5f, 20e3f);
    transfer_set_delay(&settings, 0.008f, 0.006f);
    settings.nominal[2] = 3.2e-5f;
    settings.nominal[3] = 8.5e-8f;
    settings.limited_s = 0.02f;
    settings.approach_m_per_s = 0.2f;
    settings.without_force_m = 0.02f;
    settings.energy_window_s = 0.3f;
    settings.action = count > 1 && strcmp(arguments[1], "zero_force") == 0 ? TRANSFER_ZERO_FORCE : TRANSFER_HOLD;
    memset(&system, 0x5a, sizeof system);
    if (transfer_init(&system, &settings, 1e-3f) != NULL
        || transfer_motion_filter_init(&filter, 40.0f, 1e-3f) != NULL) {
        return 3;
    }
    wrong = settings;
    wrong.ramp_s = 0.0f / (wrong.ramp_s - wrong.ramp_s);
    if (strcmp(transfer_init(&system, &wrong, 1e-3f), "ramp_s: 0.01 to 10") != 0
        || strcmp(transfer_init(&system, &settings, 1.0f), "step_s: 1e-5 to 0.02") != 0
        || strcmp(transfer_motion_filter_init(&filter, 251.0f, 1e-3f),
                  "pole_hz: 1 to a quarter of the rate of the ticks") != 0) {
        return 4;
    }
    while (fread(&now, sizeof now, 1, stdin) == 1) {
        transfer_motion motion = {now.desired_m, 0.0f, 0.0f, 0.0f};
        transfer_measured measured;
        transfer_command command;
        transfer_reading reading;

        measured.displacement_m = now.measured[0];
        measured.force_n = now.measured[1];
        if (now.desired_m - now.desired_m == 0.0f) {
            motion = transfer_motion_filter_push(&filter, now.desired_m);
        } else {
            transfer_motion_filter_rest_at(&filter, 0.0f);
        }
        if (now.ends) {
            transfer_end(&system);
        }
        command = transfer_tick(&system, &motion, now.is_measured ? &measured : NULL);
        reading = transfer_read(&system);
        if (!put(&motion, sizeof motion) || !put(&command, sizeof command)
            || !put(&reading, 10 * sizeof(float))) {
            return 5;
        }
        if (now.clears) {
            (void)transfer_clear(&system);
        }
    }
    return 0;
}
