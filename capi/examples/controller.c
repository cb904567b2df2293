/* Four dampers of a bogie at 1 kHz: two from IN_SERVICE, two from REDUCED_VERTICAL.
 *
 * During the run one sensor fails for a while, another jumps, a clearance increases, and the states
 * are saved, lost and restored. All of this happens in ticks; reports are printed afterwards.
 */
#include "controller.h"

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "dashpot.h"
/* From: dashpot export --lang c --damper in-service --output in_service.c (and reduced-vertical). */
#include "in_service.h"
#include "reduced_vertical.h"

enum { DAMPERS = 4, TICKS = 10000, REPORT_EVERY = 2000, REPORTS = TICKS / REPORT_EVERY };

static const float TICK_S = 1e-3F;

static dashpot_damper in_service, reduced;
static const dashpot_damper *const dampers[DAMPERS] = {&in_service, &reduced, &in_service, &reduced};
static dashpot_state states[DAMPERS];

static uint32_t tick;
static dashpot_error fault;
static uint32_t force_digest = 2166136261U;
static dashpot_reading readings[REPORTS][DAMPERS];

/* Displacement (m): parabolic arcs of up to 3 mm, with a different period for each damper. */
static float sensor(uint32_t damper, uint32_t at)
{
    const uint32_t half = 200U + 35U * damper;
    const uint32_t in_arc = at % half;
    const float arc = (float)(in_arc * (half - in_arc)) * (0.012F / (float)(half * half));

    if (damper == 1U && at >= 2500U && at < 2520U) {
        const uint32_t not_a_number = 0x7fc00000U;
        float failed;
        memcpy(&failed, &not_a_number, sizeof failed);
        return failed;
    }
    if (damper == 2U && at == 4500U) {
        return 0.01F;
    }
    return (at / half) % 2U == 0U ? arc : -arc;
}

/* In place of the actuators of a rig: a digest of all forces (FNV-1a of the bits). */
static void command(const float forces_n[DAMPERS])
{
    for (size_t i = 0; i < DAMPERS; i++) {
        uint32_t bits;
        memcpy(&bits, &forces_n[i], sizeof bits);
        for (unsigned shift = 0; shift < 32U; shift += 8U) {
            force_digest = (force_digest ^ ((bits >> shift) & 0xffU)) * 16777619U;
        }
    }
}

/* Simulates a restart: the states are saved, lost and restored. */
static dashpot_error save_lose_restore(void)
{
    static uint8_t kept[DAMPERS][DASHPOT_SAVED_STATE_SIZE];

    for (size_t i = 0; i < DAMPERS; i++) {
        const dashpot_error error = dashpot_state_save(&states[i], kept[i], sizeof kept[i]);
        if (error != DASHPOT_ERROR_NONE) {
            return error;
        }
    }
    memset(states, 0xa5, sizeof states);
    for (size_t i = 0; i < DAMPERS; i++) {
        const dashpot_error error =
            dashpot_state_restore(&states[i], dampers[i], kept[i], sizeof kept[i]);
        if (error != DASHPOT_ERROR_NONE) {
            return error;
        }
    }
    return DASHPOT_ERROR_NONE;
}

/* Reads all dampers and clears their status bits. */
static dashpot_error note(dashpot_reading noted[DAMPERS])
{
    for (size_t i = 0; i < DAMPERS; i++) {
        dashpot_error error = dashpot_state_read(&states[i], &noted[i]);
        if (error == DASHPOT_ERROR_NONE) {
            error = dashpot_state_clear_status(&states[i]);
        }
        if (error != DASHPOT_ERROR_NONE) {
            return error;
        }
    }
    return DASHPOT_ERROR_NONE;
}

/* Checks memory for damage: at each tick a slice of one damper's constants and one state. */
static dashpot_error check_memory(void)
{
    static dashpot_check checks[2];
    const size_t i = tick % 2U;

    return dashpot_check_slice(dampers[i], &states[i], &checks[i]);
}

static dashpot_error control(float forces_n[DAMPERS])
{
    float displacements_m[DAMPERS];
    dashpot_error error = DASHPOT_ERROR_NONE;

    if (tick == 6000U) {
        error = dashpot_damper_set_clearance(&reduced, 2.5e-3F); /* wear during the run */
    } else if (tick == 7000U) {
        error = save_lose_restore();
    }
    if (error != DASHPOT_ERROR_NONE) {
        return error;
    }
    for (uint32_t i = 0; i < DAMPERS; i++) {
        displacements_m[i] = sensor(i, tick);
    }
    error = dashpot_step_bank(dampers, states, displacements_m, forces_n, DAMPERS);
    if (error == DASHPOT_ERROR_NONE) {
        error = check_memory();
    }
    if (error == DASHPOT_ERROR_NONE && (tick + 1U) % REPORT_EVERY == 0U) {
        error = note(readings[tick / REPORT_EVERY]);
    }
    return error;
}

void controller_tick(void)
{
    float forces_n[DAMPERS] = {0};

    if (controller_finished()) {
        return;
    }
    fault = control(forces_n);
    if (fault != DASHPOT_ERROR_NONE) {
        memset(forces_n, 0, sizeof forces_n); /* the safe output */
    }
    command(forces_n);
    tick++;
}

bool controller_finished(void)
{
    return tick >= TICKS || fault != DASHPOT_ERROR_NONE;
}

static bool fail(const char *what, dashpot_error error)
{
    platform_print(what);
    platform_print(": ");
    platform_print(dashpot_error_text(error));
    platform_print("\n");
    return false;
}

bool controller_start(void)
{
    dashpot_damper_info info;
    uint8_t damaged[DASHPOT_IMAGE_SIZE];
    dashpot_error error = DASHPOT_CHECK_HEADER();

    if (error != DASHPOT_ERROR_NONE) {
        return fail("C library", error);
    }
    error = dashpot_damper_init(&in_service, IN_SERVICE, sizeof IN_SERVICE);
    if (error != DASHPOT_ERROR_NONE) {
        return fail("in-service damper", error);
    }
    error = dashpot_damper_init(&reduced, REDUCED_VERTICAL, sizeof REDUCED_VERTICAL);
    if (error != DASHPOT_ERROR_NONE) {
        return fail("reduced damper", error);
    }
    /* A damaged image is refused and leaves the damper unchanged. */
    memcpy(damaged, IN_SERVICE, sizeof damaged);
    damaged[1234] ^= 0x10U;
    error = dashpot_damper_init(&in_service, damaged, sizeof damaged);
    if (error != DASHPOT_ERROR_CHECKSUM) {
        return fail("damaged image", error);
    }
    for (uint32_t i = 0; i < DAMPERS; i++) {
        error = dashpot_damper_describe(dampers[i], &info);
        if (error == DASHPOT_ERROR_NONE && info.step_s != TICK_S) {
            error = DASHPOT_ERROR_RANGE; /* built for another tick */
        }
        if (error == DASHPOT_ERROR_NONE) {
            error = dashpot_state_init(&states[i], dampers[i], sensor(i, 0));
        }
        if (error != DASHPOT_ERROR_NONE) {
            return fail("damper", error);
        }
    }
    return true;
}

/* Prints hexadecimal digits without printf, which a small target may not have. */
static void print_number(const char *name, uint32_t number)
{
    char digits[9];

    for (size_t i = 0; i < 8; i++) {
        digits[i] = "0123456789abcdef"[(number >> (28U - 4U * i)) & 0xfU];
    }
    digits[8] = '\0';
    platform_print(name);
    platform_print(digits);
}

bool controller_report(void)
{
    if (fault != DASHPOT_ERROR_NONE) {
        print_number("tick ", tick);
        return fail(" stopped", fault);
    }
    for (uint32_t i = 0; i < REPORTS; i++) {
        for (uint32_t damper = 0; damper < DAMPERS; damper++) {
            const dashpot_reading *reading = &readings[i][damper];
            print_number("tick ", (i + 1U) * REPORT_EVERY);
            print_number(" damper ", damper);
            print_number(" status ", reading->status);
            print_number(" rejected ", reading->rejected_inputs);
            platform_print("\n");
        }
    }
    print_number("forces ", force_digest);
    platform_print("\n");
    return true;
}
