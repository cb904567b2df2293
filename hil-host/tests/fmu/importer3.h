/* FMI 3.0 calls used by driver.c. */

#include "fmi3Functions.h"

typedef struct importer {
    void *library;
    fmi3Instance instance;
} importer;

#define CALL(function, ...) (((fmi3##function##TYPE *)symbol(of->library, "fmi3" #function))(of->instance, __VA_ARGS__))
#define CALL_PLAIN(function) (((fmi3##function##TYPE *)symbol(of->library, "fmi3" #function))(of->instance))

static void logger(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message)
{
    (void)environment;
    printf("log it %d %s: %s\n", (int)status, category, message);
}

static int instantiate(importer *of, const char *token, const char *resources)
{
    of->instance = ((fmi3InstantiateCoSimulationTYPE *)symbol(of->library, "fmi3InstantiateCoSimulation"))(
        "it", token, resources, false, true, false, false, NULL, 0, NULL, logger, NULL);
    return of->instance != NULL;
}

static int begin(importer *of, double start_s, double stop_s)
{
    return CALL(EnterInitializationMode, false, 0, start_s, stop_s > start_s, stop_s);
}

static int initialized(importer *of) { return CALL_PLAIN(ExitInitializationMode); }
static int terminate(importer *of) { return CALL_PLAIN(Terminate); }
static int reset(importer *of) { return CALL_PLAIN(Reset); }
static void release(importer *of)
{
    ((fmi3FreeInstanceTYPE *)symbol(of->library, "fmi3FreeInstance"))(of->instance);
}
static int set(importer *of, unsigned variable, double value) { return CALL(SetFloat64, &variable, 1, &value, 1); }
static int set_two(importer *of, unsigned a, double a_value, unsigned b, double b_value)
{
    const unsigned variables[] = {a, b};
    const double values[] = {a_value, b_value};

    return CALL(SetFloat64, variables, 2, values, 2);
}
static int get(importer *of, unsigned variable, double *value) { return CALL(GetFloat64, &variable, 1, value, 1); }
static int get_integer(importer *of, unsigned variable, int *value) { return CALL(GetInt32, &variable, 1, value, 1); }
static int step(importer *of, double at_s, double step_s)
{
    bool event = false, end = false, early = false;
    double reached_s;
    int status = CALL(DoStep, at_s, step_s, false, &event, &end, &early, &reached_s);

    return event || end || early ? 99 : status;
}
static int get_state(importer *of, void **state) { return CALL(GetFMUState, state); }
static int set_state(importer *of, void *state) { return CALL(SetFMUState, state); }
static int free_state(importer *of, void **state) { return CALL(FreeFMUState, state); }
static int state_size(importer *of, void *state, size_t *size) { return CALL(SerializedFMUStateSize, state, size); }
static int serialize(importer *of, void *state, void *bytes, size_t size)
{
    return CALL(SerializeFMUState, state, bytes, size);
}
static int deserialize(importer *of, const void *bytes, size_t size, void **state)
{
    return CALL(DeserializeFMUState, bytes, size, state);
}
static int quiet(importer *of) { return CALL(SetDebugLogging, false, 0, NULL); }
static int loud(importer *of, const char *category) { return CALL(SetDebugLogging, true, 1, &category); }

/* In FMI 3, the velocity is an input of its own. */
static int set_rate(importer *of, unsigned variable, double value) { return set(of, variable + 1, value); }
