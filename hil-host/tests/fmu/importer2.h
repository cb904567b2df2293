/* FMI 2.0 calls used by driver.c. */

#include "fmi2Functions.h"

typedef struct importer {
    void *library;
    fmi2Component instance;
} importer;

#define CALL(function, ...) (((fmi2##function##TYPE *)symbol(of->library, "fmi2" #function))(of->instance, __VA_ARGS__))
#define CALL_PLAIN(function) (((fmi2##function##TYPE *)symbol(of->library, "fmi2" #function))(of->instance))

static void logger(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status, fmi2String category,
                   fmi2String format, ...)
{
    va_list values;

    (void)environment;
    printf("log %s %d %s: ", name, (int)status, category);
    va_start(values, format);
    vprintf(format, values);
    va_end(values);
    printf("\n");
}

static fmi2CallbackFunctions callbacks = {logger, calloc, free, NULL, NULL};

static int instantiate(importer *of, const char *token, const char *resources)
{
    of->instance = ((fmi2InstantiateTYPE *)symbol(of->library, "fmi2Instantiate"))("it", fmi2CoSimulation, token, resources,
                                                                                  &callbacks, fmi2False, fmi2True);
    return of->instance != NULL;
}

static int begin(importer *of, double start_s, double stop_s)
{
    const fmi2Status status = CALL(SetupExperiment, fmi2False, 0, start_s, stop_s > start_s, stop_s);

    return status != fmi2OK ? status : CALL_PLAIN(EnterInitializationMode);
}

static int initialized(importer *of) { return CALL_PLAIN(ExitInitializationMode); }
static int terminate(importer *of) { return CALL_PLAIN(Terminate); }
static int reset(importer *of) { return CALL_PLAIN(Reset); }
static void release(importer *of)
{
    ((fmi2FreeInstanceTYPE *)symbol(of->library, "fmi2FreeInstance"))(of->instance);
}
static int set(importer *of, unsigned variable, double value) { return CALL(SetReal, &variable, 1, &value); }
static int set_two(importer *of, unsigned a, double a_value, unsigned b, double b_value)
{
    const unsigned variables[] = {a, b};
    const double values[] = {a_value, b_value};

    return CALL(SetReal, variables, 2, values);
}
static int get(importer *of, unsigned variable, double *value) { return CALL(GetReal, &variable, 1, value); }
static int get_integer(importer *of, unsigned variable, int *value) { return CALL(GetInteger, &variable, 1, value); }
static int step(importer *of, double at_s, double step_s) { return CALL(DoStep, at_s, step_s, fmi2False); }
static int get_state(importer *of, void **state) { return CALL(GetFMUstate, state); }
static int set_state(importer *of, void *state) { return CALL(SetFMUstate, state); }
static int free_state(importer *of, void **state) { return CALL(FreeFMUstate, state); }
static int state_size(importer *of, void *state, size_t *size) { return CALL(SerializedFMUstateSize, state, size); }
static int serialize(importer *of, void *state, void *bytes, size_t size)
{
    return CALL(SerializeFMUstate, state, bytes, size);
}
static int deserialize(importer *of, const void *bytes, size_t size, void **state)
{
    return CALL(DeSerializeFMUstate, bytes, size, state);
}
static int quiet(importer *of) { return CALL(SetDebugLogging, fmi2False, 0, NULL); }
static int loud(importer *of, const char *category) { return CALL(SetDebugLogging, fmi2True, 1, &category); }

/* Sets the rate of an input through the function of the interface, as importers do: for every input. */
static int set_rate(importer *of, unsigned variable, double value)
{
    const unsigned variables[] = {variable, variable + 1};
    const fmi2Integer orders[] = {1, 1};
    const double values[] = {value, 0};

    return CALL(SetRealInputDerivatives, variables, 2, orders, values);
}
