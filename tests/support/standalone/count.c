/* Counts the instructions of a step in C without a library on a Cortex-M under QEMU's `-icount shift=10`, where an
 * instruction takes 1024 ns. The results are ticks of SysTick, which runs with the processor's clock. Semihosting sends
 * every number to the debugger. */
#include <stdint.h>

#include "damper.h"
#include "motion.h"

#define SYST_CSR (*(volatile uint32_t *)0xE000E010U)
#define SYST_RVR (*(volatile uint32_t *)0xE000E014U)
#define SYST_CVR (*(volatile uint32_t *)0xE000E018U)
#define CPACR (*(volatile uint32_t *)0xE000ED88U)
#define SYST_RUN 5U /* counter on, with the processor's clock */
#define SYST_MASK 0xffffffU

enum { SYS_WRITE0 = 0x04, SYS_EXIT = 0x18 };
#define STOPPED_BY_EXIT 0x20026U

extern const char clock_hz[]; /* the symbol's address is the frequency */
extern uint32_t stack_top[], data_start[], data_end[], data_image[], bss_start[], bss_end[];

typedef float step_function(const damper_damper *damper, damper_state *state, float displacement_m);

static uint32_t digest = 0x811c9dc5U;

static void semihosting(uint32_t operation, uintptr_t argument)
{
    register uint32_t r0 __asm__("r0") = operation;
    register uintptr_t r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
}

static void print(const char *name, uint32_t value)
{
    char digits[] = " 00000000\n";
    unsigned digit;

    for (digit = 0; digit < 8; digit++) {
        digits[8 - digit] = "0123456789abcdef"[value >> 4 * digit & 0xfU];
    }
    semihosting(SYS_WRITE0, (uintptr_t)name);
    semihosting(SYS_WRITE0, (uintptr_t)digits);
}

/* A function of one instruction, its return. */
__attribute__((naked, noinline)) static float nothing(const damper_damper *damper, damper_state *state,
                                                      float displacement_m)
{
    (void)damper;
    (void)state;
    (void)displacement_m;
    __asm__ volatile("bx lr");
}

/* A function of 101 instructions: its measured count shows that the method is right. */
__attribute__((naked, noinline)) static float known(const damper_damper *damper, damper_state *state,
                                                    float displacement_m)
{
    (void)damper;
    (void)state;
    (void)displacement_m;
    __asm__ volatile(".rept 100\n\tnop\n\t.endr\n\tbx lr");
}

static float force;

/* Clock ticks of a call of any of these functions. The instructions of the call itself are the same for each. */
__attribute__((noinline)) static uint32_t timed(step_function *volatile function, const damper_damper *damper,
                                                damper_state *state, float displacement_m)
{
    step_function *called = function;
    const uint32_t start = SYST_CVR;
    const float returned = called(damper, state, displacement_m);
    const uint32_t end = SYST_CVR;

    force = returned;
    return (start - end) & SYST_MASK;
}

/* Adds the bits of the force to the digest: FNV-1a over its bytes. */
static void digest_force(void)
{
    union {
        float real;
        uint32_t bits;
    } word;
    unsigned shift;

    word.real = force;
    for (shift = 0; shift < 32; shift += 8) {
        digest = (digest ^ (word.bits >> shift & 0xffU)) * 0x01000193U;
    }
}

static void measure(void)
{
    damper_damper damper = damper_as_built;
    damper_state state;
    uint32_t least = UINT32_MAX, most = 0, ticks;
    unsigned motion, sample;

    for (motion = 0; motion < MOTIONS; motion++) {
        damper_at_rest(&damper, &state, motions_m[motion][0]);
        for (sample = 0; sample < SAMPLES; sample++) {
            ticks = timed(damper_step, &damper, &state, motions_m[motion][sample]);
            least = ticks < least ? ticks : least;
            most = ticks > most ? ticks : most;
            digest_force();
        }
    }
    print("clock_hz", (uint32_t)(uintptr_t)clock_hz);
    print("call", timed(nothing, &damper, &state, 0));
    print("known", timed(known, &damper, &state, 0));
    print("least", least);
    print("most", most);
    damper_at_rest(&damper, &state, 0);
    print("first", timed(damper_step, &damper, &state, 1.5e-3F));
    digest_force();
    print("held", timed(damper_step, &damper, &state, __builtin_nanf("")));
    digest_force();
    print("limited", timed(damper_step, &damper, &state, 10e-3F));
    digest_force();
    if (damper_set_clearance_m(&damper, 2e-3F) == DAMPER_DONE) {
        print("swapped", timed(damper_step, &damper, &state, 2.5e-3F));
    }
    digest_force();
    print("digest", digest);
    print("kept", damper_digest(&damper_as_built) == DAMPER_DIGEST);
}

void start(void); /* the linker script names this function */
void start(void)
{
    const uint32_t *from = data_image;
    uint32_t *to;

    for (to = data_start; to < data_end; to++) {
        *to = *from++;
    }
    for (to = bss_start; to < bss_end; to++) {
        *to = 0;
    }
    CPACR |= 0xFU << 20; /* switch floating point on */
    __asm__ volatile("dsb\n\tisb" ::: "memory");
    SYST_RVR = SYST_MASK;
    SYST_CVR = 0;
    SYST_CSR = SYST_RUN;
    measure();
    semihosting(SYS_EXIT, STOPPED_BY_EXIT);
    for (;;) {
    }
}

static void unexpected(void)
{
    semihosting(SYS_WRITE0, (uintptr_t)"unexpected exception\n");
    semihosting(SYS_EXIT, STOPPED_BY_EXIT);
}

typedef void (*vector)(void);

/* Vector table: stack, reset, and the fourteen exceptions of the architecture. */
__attribute__((section(".vectors"), used)) static const struct {
    uint32_t *stack;
    vector entries[15];
} vectors = {stack_top,
             {start, unexpected, unexpected, unexpected, unexpected, unexpected, unexpected, unexpected,
              unexpected, unexpected, unexpected, unexpected, unexpected, unexpected, unexpected}};
