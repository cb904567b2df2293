/* Vectors and start-up code of a Cortex-M7. */
#include <stdint.h>

#include "board.h"
#include "processor.h"
#include "rig.h"
#include "tick.h"

extern uint32_t stack_top[], data_start[], data_end[], bss_start[], bss_end[];
extern const uint32_t data_image[];

int main(void);
void reset(void);
void nmi(void);

/* A fault: zero forces, and nothing else until the watchdog resets the board. */
static void fault(void)
{
    const float zeros_n[DAMPERS] = {0};

    __asm__ volatile("cpsid i");
    rig_drive(zeros_n);
    for (;;) {
    }
}

/* A board whose watchdog warns before it resets has its own. */
__attribute__((weak)) void nmi(void)
{
    fault();
}

void reset(void)
{
    const uint32_t *from = data_image;

    for (uint32_t *to = data_start; to < data_end; to++) {
        *to = *from++;
    }
    for (uint32_t *to = bss_start; to < bss_end; to++) {
        *to = 0;
    }
    SCB_CPACR |= SCB_CPACR_FPU;
    processor_barrier();
    (void)main();
    fault();
}

typedef void (*vector)(void);

/* Stack, reset, and the fourteen exceptions of the architecture. */
__attribute__((section(".vectors"), used)) static const struct {
    uint32_t *stack;
    vector entries[15];
} vectors = {stack_top,
             {reset, nmi, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault,
              tick_interrupt}};
