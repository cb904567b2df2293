#include "tick.h"

#include <string.h>

#include "board.h"
#include "processor.h"
#include "rig.h"

/* A sensor that fails for more ticks than this has failed for good: its damper has no force until it is back. */
enum { MAX_BAD_TICKS = 20 };

static volatile uint32_t ticks;
static struct report now;
static uint32_t bad_ticks[DAMPERS];
static bool is_stopped; /* after damage in memory */

/* A slot for one report, which the interrupt fills and the main loop empties. */
static struct report slot;
static volatile bool is_full;

/* Applies what the status bits of a tick mean for the forces. */
static void handle_status(float forces_n[DAMPERS])
{
    for (size_t i = 0; i < DAMPERS; i++) {
        const unsigned status = bank_take_status(i);
        const bool is_bad = (status & (STATUS_HELD | STATUS_RESTARTED)) != 0U;

        now.status |= status;
        now.rejected += is_bad ? 1U : 0U;
        bad_ticks[i] = is_bad ? bad_ticks[i] + 1U : 0U;
        if (bad_ticks[i] > MAX_BAD_TICKS) {
            forces_n[i] = 0.0F;
        }
        is_stopped = is_stopped || (status & STATUS_CORRUPTED) != 0U;
    }
    if (is_stopped) {
        memset(forces_n, 0, DAMPERS * sizeof *forces_n);
    }
}

/* Hands the report to the main loop, unless it has not taken the last one. */
static void report_now(void)
{
    if (!is_full) {
        slot = now;
        processor_barrier();
        is_full = true;
        now.cycles = 0;
        now.status = 0;
        now.rejected = 0;
    }
}

void tick_interrupt(void)
{
    const uint32_t start = board_cycles();
    float displacements_m[DAMPERS];
    uint32_t cycles;

    now.tick = ticks + 1U;
    rig_read(now.tick, displacements_m);
    bank_step(displacements_m, now.forces_n);
    handle_status(now.forces_n);
    rig_drive(now.forces_n);
    now.hash = rig_hash();
    cycles = board_cycles() - start;
    if (cycles > now.cycles) {
        now.cycles = cycles;
    }
    if (cycles >= board_clock_hz / TICK_HZ) {
        now.late++;
    }
    if (now.tick % REPORT_EVERY == 0U) {
        report_now();
    }
    ticks = now.tick;
}

const char *tick_start(void)
{
    float displacements_m[DAMPERS];
    const char *reason;

    rig_read(0, displacements_m);
    reason = bank_start(displacements_m);
    if (reason == NULL) {
        SYST_RVR = board_clock_hz / TICK_HZ - 1U;
        SYST_CVR = 0;
        SYST_CSR = SYST_CSR_RUN;
    }
    return reason;
}

uint32_t tick_count(void)
{
    return ticks;
}

bool tick_take_report(struct report *report)
{
    const bool is_new = is_full;

    if (is_new) {
        processor_barrier();
        *report = slot;
        processor_barrier();
        is_full = false;
    }
    return is_new;
}
