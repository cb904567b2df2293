/* The tick: one step of the bank in the SysTick interrupt. */
#ifndef TICK_H
#define TICK_H

#include <stdbool.h>
#include <stdint.h>

#include "bank.h"

enum { TICK_HZ = 1000, REPORT_EVERY = 100 };

/* What happened since the last report. */
struct report {
    uint32_t tick;
    uint32_t hash;     /* of all forces since the start */
    uint32_t cycles;   /* of the longest tick */
    uint32_t late;     /* ticks since the start that took longer than a period */
    unsigned status;   /* status bits of all dampers */
    uint32_t rejected; /* displacements that were not followed */
    float forces_n[DAMPERS];
};

/* Starts the bank, then SysTick. Returns a null pointer, or the reason why it does not start. */
const char *tick_start(void);

/* Number of ticks so far. */
uint32_t tick_count(void);

/* Copies a new report, one for each REPORT_EVERY ticks. Returns false if there is none. */
bool tick_take_report(struct report *report);

/* The SysTick interrupt. */
void tick_interrupt(void);

#endif
