/* The controller on a Cortex-M4F, M7 or M33. The tick is the SysTick interrupt, and text goes to the
 * debugger through semihosting. The linker script of the board defines memory and clock. Needs no C library. */
#include <stdbool.h>
#include <stdint.h>

#include "controller.h"

enum { TICK_HZ = 1000 };

#define SYST_CSR (*(volatile uint32_t *)0xE000E010U)
#define SYST_RVR (*(volatile uint32_t *)0xE000E014U)
#define SYST_CVR (*(volatile uint32_t *)0xE000E018U)
#define CPACR (*(volatile uint32_t *)0xE000ED88U)
#define SYST_RUN 7U            /* counter, interrupt, processor clock */
#define SYST_WRAPPED (1U << 16) /* since the last read of the register */

enum { SYS_WRITE0 = 0x04, SYS_EXIT = 0x18 };
#define STOPPED_BY_EXIT 0x20026U
#define STOPPED_BY_ERROR 0x20023U

extern const char clock_hz[]; /* the address is the value */
extern uint32_t stack_top[], data_start[], data_end[], data_image[], bss_start[], bss_end[];

static volatile bool finished;
static volatile bool overrun;

static void semihosting(uint32_t operation, uintptr_t argument)
{
    register uint32_t r0 __asm__("r0") = operation;
    register uintptr_t r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
}

void platform_print(const char *text)
{
    semihosting(SYS_WRITE0, (uintptr_t)text);
}

static _Noreturn void stop(bool well)
{
    semihosting(SYS_EXIT, well ? STOPPED_BY_EXIT : STOPPED_BY_ERROR);
    for (;;) {
    }
}

static void tick_interrupt(void)
{
    (void)SYST_CSR; /* clears the wrap of this interrupt */
    controller_tick();
    if ((SYST_CSR & SYST_WRAPPED) != 0U) {
        overrun = true;
    }
    finished = controller_finished();
}

static void unexpected(void)
{
    platform_print("unexpected exception\n");
    stop(false);
}

void start(void); /* entry point of the linker script */
void start(void)
{
    const uint32_t *from = data_image;

    for (uint32_t *to = data_start; to < data_end; to++) {
        *to = *from++;
    }
    for (uint32_t *to = bss_start; to < bss_end; to++) {
        *to = 0;
    }
    CPACR |= 0xFU << 20; /* enables floating point */
    __asm__ volatile("dsb\n\tisb" ::: "memory");

    if (!controller_start()) {
        stop(false);
    }
    SYST_RVR = (uint32_t)(uintptr_t)clock_hz / TICK_HZ - 1;
    SYST_CVR = 0;
    SYST_CSR = SYST_RUN;
    while (!finished) {
        __asm__ volatile("wfi");
    }
    SYST_CSR = 0;
    if (overrun) {
        platform_print("a tick took longer than a period\n");
        stop(false);
    }
    stop(controller_report());
}

typedef void (*vector)(void);

/* Stack, reset, and the fourteen exceptions of the architecture. */
__attribute__((section(".vectors"), used)) static const struct {
    uint32_t *stack;
    vector entries[15];
} vectors = {stack_top,
             {start, unexpected, unexpected, unexpected, unexpected, unexpected, unexpected, unexpected,
              unexpected, unexpected, unexpected, unexpected, unexpected, unexpected, tick_interrupt}};
