/* Importer of one FMU: driver LIBRARY TOKEN RESOURCES TASK [NUMBER]. */

#define _POSIX_C_SOURCE 200809L

#if defined(_WIN32)
#include <windows.h>
#define dlopen(name, mode) ((void *)LoadLibraryA(name))
#define dlsym(library, name) ((void *)GetProcAddress((HMODULE)(library), name))
#define dlerror() "the library cannot be loaded"
#define dlclose(library) FreeLibrary((HMODULE)(library))
#else
#include <dlfcn.h>
#endif
#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Returns a function of the library; ends the program if it is missing. */
static void *symbol(void *library, const char *name)
{
    void *found = dlsym(library, name);

    if (found == NULL) {
        printf("no function %s\n", name);
        exit(1);
    }
    return found;
}

#if FMI == 2
#include "importer2.h"
#else
#include "importer3.h"
#endif

enum { DISPLACEMENT = 1, VELOCITY, FORCE, CLEARANCE, STATUS, REJECTED };

static const double internal_s = 1e-3;

static void check(const char *what, int status, int expected)
{
    if (status != expected) {
        printf("%s: status %d, not %d\n", what, status, expected);
        exit(1);
    }
}

static double force(importer *of)
{
    double value;

    check("get", get(of, FORCE, &value), 0);
    return value;
}

static void start(importer *of)
{
    check("begin", begin(of, 0, 0), 0);
    check("initialized", initialized(of), 0);
}

/* Prints the forces for the displacements on standard input, one per communication step of several internal steps. */
static void run(importer *of, unsigned steps)
{
    const double step_s = steps * internal_s;
    double displacement;
    unsigned number;

    check("begin", begin(of, 0, 0), 0);
    for (number = 0; scanf("%lf", &displacement) == 1; number++) {
        check("set", set(of, DISPLACEMENT, displacement), 0);
        if (number == 0) {
            check("initialized", initialized(of), 0);
        }
        /* A warning is logged; the call still succeeds. */
        check("step", step(of, number * step_s, step_s) & ~1, 0);
        printf("%a\n", force(of));
    }
    check("terminate", terminate(of), 0);
}

/* Like run, for a sine with its velocity: prints the forces at the ends of the steps. */
static void rate(importer *of, unsigned steps)
{
    const double step_s = steps * internal_s, amplitude = 5e-3, omega = 10;
    unsigned number;

    start(of);
    for (number = 0; number < 2000 / steps; number++) {
        const double t = number * step_s;

        check("set", set(of, DISPLACEMENT, amplitude * sin(omega * t)), 0);
        check("rate", set_rate(of, DISPLACEMENT, amplitude * omega * cos(omega * t)), 0);
        check("step", step(of, t, step_s), 0);
        printf("%a\n", force(of));
    }
}

/* Makes every call that must be rejected, prints the messages, and checks that nothing has changed. */
static void refuse(importer *of)
{
    double value;
    int bits;

    printf("step before the start: %d\n", step(of, 0, internal_s));
    printf("reset: %d\n", reset(of));
    printf("end of no initialization: %d\n", initialized(of));
    check("reset", reset(of), 0);
    check("begin", begin(of, 0, 10), 0);
    check("initialized", initialized(of), 0);
    check("step", step(of, 0, internal_s), 0);
    printf("half a step: %d\n", step(of, 1e-3, 0.5e-3));
    printf("one and a half: %d\n", step(of, 1e-3, 1.5e-3));
    printf("no step: %d\n", step(of, 1e-3, 0));
    printf("a step back: %d\n", step(of, 1e-3, -1e-3));
    printf("no number: %d\n", step(of, 1e-3, NAN));
    printf("from elsewhere: %d\n", step(of, 2e-3, 1e-3));
    printf("too many: %d\n", step(of, 1e-3, 1e7));
    printf("clearance: %d\n", set(of, CLEARANCE, 0.2));
    printf("clearance: %d\n", set(of, CLEARANCE, NAN));
    check("time", get(of, 0, &value), 0);
    printf("time still %g s\n", value);
    check("clearance", get(of, CLEARANCE, &value), 0);
    printf("clearance still %.6f m\n", value);
    check("step", step(of, 1e-3, 1e-3 + 1e-12), 0);
    check("set", set(of, DISPLACEMENT, NAN), 0);
    printf("NaN: %d\n", step(of, 2e-3, 1e-3));
    printf("NaN again: %d\n", step(of, 3e-3, 1e-3));
    check("set", set(of, DISPLACEMENT, 1e300), 0);
    printf("1e300: %d\n", step(of, 4e-3, 1e-3));
    check("set", set(of, DISPLACEMENT, 0.012), 0);
    printf("12 mm: %d\n", step(of, 5e-3, 1e-3));
    check("status", get_integer(of, STATUS, &bits), 0);
    printf("status %d, ", bits);
    check("rejected", get_integer(of, REJECTED, &bits), 0);
    printf("rejected %d, force finite %d\n", bits, isfinite(force(of)) != 0);
    check("quiet", quiet(of), 0);
    printf("quiet: %d\n", step(of, 8, 1e-3));
    check("loud", loud(of, "logStatusDiscard"), 0);
    printf("loud: %d\n", step(of, 9, 1e-3));
    printf("no such category: %d\n", loud(of, "logEvents"));
    printf("no variable: %d\n", get(of, 77, &value));
    printf("after an error: %d\n", get(of, FORCE, &value));
    check("reset", reset(of), 0);
    printf("set an output: %d\n", set(of, FORCE, 1));
    check("reset", reset(of), 0);
    printf("a start that no step can be told from: %d\n", begin(of, 1e15, 0));
    check("reset", reset(of), 0);
    check("set", set(of, DISPLACEMENT, NAN), 0);
    check("clearance", set(of, CLEARANCE, 0.1), 0);
    check("clearance", get(of, CLEARANCE, &value), 0);
    check("clearance as it is told", set(of, CLEARANCE, value), 0);
    check("begin", begin(of, 0, 0.01), 0);
    printf("a start at NaN: %d\n", initialized(of));
    check("status", get_integer(of, STATUS, &bits), 0);
    printf("status %d\n", bits);
    printf("beyond the end: %d\n", step(of, 0, 0.02));
    check("reset", reset(of), 0);
    printf("some and one out of range: %d, ", set_two(of, DISPLACEMENT, 0.01, CLEARANCE, 9));
    check("displacement", get(of, DISPLACEMENT, &value), 0);
    printf("displacement still %g\n", value);
}

/* Steps to times that are summed as in an importer, with their rounding errors. */
static void added(importer *of, unsigned count)
{
    double at_s = 0, time_s;
    unsigned number;

    start(of);
    for (number = 0; number < count; number++) {
        check("step", step(of, at_s, internal_s), 0);
        at_s += internal_s;
    }
    check("time", get(of, 0, &time_s), 0);
    printf("%.17g s added up, time %.17g s\n", at_s, time_s);
}

static double wave(unsigned number)
{
    return 4e-3 * sin(0.02 * number);
}

static void steps(importer *of, unsigned from, unsigned to)
{
    for (; from < to; from++) {
        check("set", set(of, DISPLACEMENT, wave(from)), 0);
        check("step", step(of, from * internal_s, internal_s), 0);
    }
}

/* Saves, restores, serializes and deserializes states. */
static void states(importer *of)
{
    void *state = NULL, *again = NULL;
    uint8_t bytes[4096];
    size_t size;
    double first, second, clearance;

    start(of);
    steps(of, 0, 300);
    check("clearance", set(of, CLEARANCE, 2e-3), 0);
    check("get state", get_state(of, &state), 0);
    steps(of, 300, 700);
    first = force(of);
    check("clearance", set(of, CLEARANCE, 0), 0);
    check("set state", set_state(of, state), 0);
    steps(of, 300, 700);
    second = force(of);
    check("clearance", get(of, CLEARANCE, &clearance), 0);
    printf("put back: %s, clearance %.4f m\n", memcmp(&first, &second, sizeof first) == 0 ? "equal" : "other", clearance);

    check("size", state_size(of, state, &size), 0);
    check("serialize", serialize(of, state, bytes, sizeof bytes), 0);
    printf("short memory: %d\n", serialize(of, state, bytes, size - 1));
    check("free", free_state(of, &state), 0);
    printf("freed: %d\n", state == NULL);
    check("reset", reset(of), 0);
    check("deserialize", deserialize(of, bytes, size, &again), 0);
    check("set state", set_state(of, again), 0);
    steps(of, 300, 700);
    second = force(of);
    printf("of bytes, after a reset: %s\n", memcmp(&first, &second, sizeof first) == 0 ? "equal" : "other");
    check("free", free_state(of, &again), 0);

    bytes[size / 2] ^= 1;
    printf("damaged: %d\n", deserialize(of, bytes, size, &again));
    printf("short: %d\n", deserialize(of, bytes, 10, &again));
    printf("no state: %d\n", set_state(of, NULL));
    second = force(of);
    printf("then: %s\n", memcmp(&first, &second, sizeof first) == 0 ? "equal" : "other");
}

/* Steps while instances and states are created and freed. */
static void many(importer *of, unsigned count, const char *token, const char *resources)
{
    unsigned number;

    start(of);
    for (number = 0; number < count; number++) {
        check("set", set(of, DISPLACEMENT, wave(number)), 0);
        check("step", step(of, number * internal_s, internal_s), 0);
        if (number % 1000 == 999) {
            importer other = *of;
            void *state = NULL;

            check("get state", get_state(of, &state), 0);
            check("get state again", get_state(of, &state), 0);
            check("set state", set_state(of, state), 0);
            check("free", free_state(of, &state), 0);
            check("free", free_state(of, &state), 0);
            check("instantiate", instantiate(&other, token, resources), 1);
            start(&other);
            steps(&other, 0, 3);
            release(&other);
            check("instantiate", instantiate(&other, "another", resources), 0);
        }
    }
    printf("%a\n", force(of));
}

int main(int count, char **arguments)
{
    importer it;
    const char *task = count > 4 ? arguments[4] : "";
    const unsigned number = count > 5 ? (unsigned)strtoul(arguments[5], NULL, 10) : 1;

    if (count < 5) {
        return 2;
    }
    it.library = dlopen(arguments[1], RTLD_NOW | RTLD_LOCAL);
    if (it.library == NULL) {
        printf("%s\n", dlerror());
        return 1;
    }
    if (strcmp(task, "functions") == 0) {
        char name[64];

        while (scanf("%63s", name) == 1) {
            (void)symbol(it.library, name);
        }
        printf("all there\n");
        return 0;
    }
    if (!instantiate(&it, arguments[2], arguments[3])) {
        printf("no instance\n");
        return 0;
    }
    if (strcmp(task, "run") == 0) {
        run(&it, number);
    } else if (strcmp(task, "rate") == 0) {
        rate(&it, number);
    } else if (strcmp(task, "added") == 0) {
        added(&it, number);
    } else if (strcmp(task, "refuse") == 0) {
        refuse(&it);
    } else if (strcmp(task, "states") == 0) {
        states(&it);
    } else if (strcmp(task, "many") == 0) {
        many(&it, number, arguments[2], arguments[3]);
    }
    release(&it);
    (void)dlclose(it.library);
    return 0;
}
