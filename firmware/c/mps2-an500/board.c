/* QEMU's mps2-an500: CMSDK peripherals (Arm DUI 0479, chapter 4). */
#include "../board.h"

#include "../processor.h"

const uint32_t board_clock_hz = 25000000;

#define TIMER_CTRL REGISTER(0x40000000U)
#define TIMER_VALUE REGISTER(0x40000004U) /* counts down */
#define TIMER_RELOAD REGISTER(0x40000008U)
#define UART_DATA REGISTER(0x40004000U)
#define UART_STATE REGISTER(0x40004004U)
#define UART_STATE_FULL 1U
#define UART_CTRL REGISTER(0x40004008U)
#define UART_CTRL_TRANSMIT 1U
#define UART_BAUDDIV REGISTER(0x40004010U)
#define WATCHDOG_LOAD REGISTER(0x40008000U)
#define WATCHDOG_CONTROL REGISTER(0x40008008U)
#define WATCHDOG_CONTROL_RUN 3U /* an NMI after the time, a reset after the same time again */
#define WATCHDOG_INTCLR REGISTER(0x4000800CU)

#define NOTE 0x57444F47U

/* NOTE if the watchdog was about to reset the board. */
static uint32_t note __attribute__((section(".noinit")));
static bool was_reset_by_watchdog;

void nmi(void);

void board_start(void)
{
    was_reset_by_watchdog = note == NOTE;
    note = 0;
    TIMER_RELOAD = UINT32_MAX;
    TIMER_VALUE = UINT32_MAX;
    TIMER_CTRL = 1;
    UART_BAUDDIV = board_clock_hz / 1000000U; /* 1 Mbaud */
    UART_CTRL = UART_CTRL_TRANSMIT;
}

/* The emulator has no DWT. */
uint32_t board_cycles(void)
{
    return ~TIMER_VALUE;
}

bool board_send(char byte)
{
    const bool has_room = (UART_STATE & UART_STATE_FULL) == 0U;

    if (has_room) {
        UART_DATA = (uint8_t)byte;
    }
    return has_room;
}

void board_start_watchdog(void)
{
    WATCHDOG_LOAD = board_clock_hz / 20U;
    WATCHDOG_CONTROL = WATCHDOG_CONTROL_RUN;
}

void board_feed_watchdog(void)
{
    WATCHDOG_INTCLR = 1;
}

/* The reset follows in 50 ms. */
void nmi(void)
{
    note = NOTE;
    for (;;) {
    }
}

bool board_was_reset_by_watchdog(void)
{
    return was_reset_by_watchdog;
}
