/* A bank of dampers in the SysTick interrupt. The main loop feeds the watchdog and prints a line each 100 ms. */
#include "board.h"
#include "line.h"
#include "processor.h"
#include "tick.h"

static void print(const struct report *report)
{
    line_text("tick ");
    line_number(report->tick);
    line_text(" hash ");
    line_hexadecimal(report->hash);
    line_text(" status ");
    line_number(report->status);
    line_text(" rejected ");
    line_number(report->rejected);
    line_text(" late ");
    line_number(report->late);
    line_text(" cycles ");
    line_number(report->cycles);
    line_text(" forces");
    for (size_t i = 0; i < DAMPERS; i++) {
        line_text(" ");
        line_newtons(report->forces_n[i]);
    }
    line_text("\r\n");
}

int main(void)
{
    const char *reason;
    uint32_t fed_at = 0;

    board_start();
    line_text(board_was_reset_by_watchdog() ? "reset by the watchdog\r\n" : "start\r\n");
    reason = tick_start();
    if (reason != NULL) {
        line_text(reason);
        line_text("\r\n");
        while (!line_send()) {
        }
        for (;;) {
        }
    }
    board_start_watchdog();
    for (;;) {
        struct report report;

        if (tick_count() != fed_at) {
            fed_at = tick_count();
            board_feed_watchdog();
        }
        if (tick_take_report(&report)) {
            print(&report);
        }
        if (line_send()) {
            processor_sleep();
        }
    }
}
