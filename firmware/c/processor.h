/* Registers of the processor (Armv7-M Architecture Reference Manual, chapters B3 and C1) and a word of memory. */
#ifndef PROCESSOR_H
#define PROCESSOR_H

#include <stdint.h>

#define REGISTER(address) (*(volatile uint32_t *)(address))

#define SYST_CSR REGISTER(0xE000E010U)
#define SYST_CSR_RUN 7U /* counter, interrupt, clock of the processor */
#define SYST_RVR REGISTER(0xE000E014U)
#define SYST_CVR REGISTER(0xE000E018U)

#define SCB_CCR REGISTER(0xE000ED14U)
#define SCB_CCR_IC (1U << 17) /* instruction cache */
#define SCB_CPACR REGISTER(0xE000ED88U)
#define SCB_CPACR_FPU (0xFU << 20)
#define SCB_ICIALLU REGISTER(0xE000EF50U)

#define DCB_DEMCR REGISTER(0xE000EDFCU)
#define DCB_DEMCR_TRCENA (1U << 24)
#define DWT_CTRL REGISTER(0xE0001000U)
#define DWT_CTRL_CYCCNTENA 1U
#define DWT_CYCCNT REGISTER(0xE0001004U)
#define DWT_LAR REGISTER(0xE0001FB0U)
#define DWT_LAR_KEY 0xC5ACCE55U

/* Completes all memory accesses, and fetches instructions anew. */
static inline void processor_barrier(void)
{
    __asm__ volatile("dsb\n\tisb" ::: "memory");
}

/* Sleeps until the next interrupt. */
static inline void processor_sleep(void)
{
    __asm__ volatile("wfi" ::: "memory");
}

#endif
