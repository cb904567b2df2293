/* What a platform calls: start once, then one tick a millisecond until finished, then report. */
#ifndef CONTROLLER_H
#define CONTROLLER_H

#include <stdbool.h>

/* Ready to tick? If not, the reason has been printed. */
bool controller_start(void);

/* One tick: reads the sensors, steps the dampers, commands the forces. For an interrupt. */
void controller_tick(void);

/* Has the run come to its end, or to a fault? */
bool controller_finished(void);

/* Prints what happened; true when the run ended without a fault. */
bool controller_report(void);

/* Given by the platform. */
void platform_print(const char *text);

#endif
