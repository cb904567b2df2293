/* Interface for a platform: call start once, then one tick per millisecond until finished, then report. */
#ifndef CONTROLLER_H
#define CONTROLLER_H

#include <stdbool.h>

/* Prepares the run. Returns false after it has printed the reason. */
bool controller_start(void);

/* Runs one tick: reads the sensors, steps the dampers and commands the forces. Call it in an interrupt. */
void controller_tick(void);

/* True after the end of the run or a fault. */
bool controller_finished(void);

/* Prints a report. True if the run ended without a fault. */
bool controller_report(void);

/* Provided by the platform. */
void platform_print(const char *text);

#endif
