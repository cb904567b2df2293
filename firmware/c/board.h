/* What the example needs of a board. For another board write these functions and a memory.ld. */
#ifndef BOARD_H
#define BOARD_H

#include <stdbool.h>
#include <stdint.h>

/* Starts clocks and serial line, and the counter that board_cycles reads. */
void board_start(void);

/* Clock of processor and SysTick (Hz). */
extern const uint32_t board_clock_hz;

/* Cycles of the processor's clock; the count wraps. */
uint32_t board_cycles(void);

/* Sends a byte, or returns false if the line has no room now. */
bool board_send(char byte);

/* Starts the watchdog, which resets the board 100 ms after it was last fed. */
void board_start_watchdog(void);
void board_feed_watchdog(void);

/* True if the watchdog caused the last reset. */
bool board_was_reset_by_watchdog(void);

#endif
