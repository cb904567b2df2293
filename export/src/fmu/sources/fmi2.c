/* FMI 2.0 for co-simulation: all functions, on top of component.h. */

#if !defined(FMI2_FUNCTION_PREFIX) && !defined(FMI2_OVERRIDE_FUNCTION_PREFIX)
#define FMI2_FUNCTION_PREFIX MODEL_IDENTIFIER_
#endif
#include "fmi2Functions.h"

#include "component.h"

#define ENTER(phases, function)                              \
    component *const this = c;                               \
    if (!component_allows(this, phases, "fmi2" #function)) { \
        return fmi2Error;                                    \
    }

static void log_message(const component *this, component_status status, const char *category, const char *message)
{
    const fmi2CallbackLogger logger = (fmi2CallbackLogger)this->logger;

    if (logger != NULL) {
        logger(this->environment, this->name, (fmi2Status)status, category, "%s", message);
    }
}

/* The worse of two statuses. */
static fmi2Status worse(fmi2Status a, component_status b)
{
    return (fmi2Status)b > a ? (fmi2Status)b : a;
}

const char *fmi2GetTypesPlatform(void)
{
    return fmi2TypesPlatform;
}

const char *fmi2GetVersion(void)
{
    return fmi2Version;
}

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean loggingOn, size_t nCategories, const fmi2String categories[])
{
    ENTER(ANY_BUT_FAILED | FAILED, SetDebugLogging)
    return (fmi2Status)component_set_logging(this, loggingOn != fmi2False, nCategories, categories);
}

static int hexadecimal(char digit)
{
    return digit >= '0' && digit <= '9'   ? digit - '0'
           : digit >= 'a' && digit <= 'f' ? digit - 'a' + 10
           : digit >= 'A' && digit <= 'F' ? digit - 'A' + 10
                                          : -1;
}

/* The folder of a URI: `file:///a%20b` is /a b, `file:///C:/a` is C:/a. False if the URI is not a usable folder. */
static bool folder_of(const char *uri, char *folder, size_t bytes)
{
    static const char scheme[] = "file:";
    size_t at = 0;

    while (at < sizeof scheme - 1 && uri[at] == scheme[at]) {
        at++;
    }
    uri += at == sizeof scheme - 1 ? at : 0;
    if (uri[0] == '/' && uri[1] == '/') {
        uri += 2;
        while (*uri != '\0' && *uri != '/') {
            uri++;
        }
    }
#if defined(_WIN32)
    if (uri[0] == '/' && uri[1] != '\0' && uri[2] == ':') {
        uri++;
    }
#endif
    for (; *uri != '\0' && bytes > 1; bytes--) {
        const int high = uri[0] == '%' ? hexadecimal(uri[1]) : -1;
        const int low = high >= 0 ? hexadecimal(uri[2]) : -1;

        if (low == 0 && high == 0) {
            return false;
        }
        *folder++ = low >= 0 ? (char)(16 * high + low) : *uri;
        uri += low >= 0 ? 3 : 1;
    }
    *folder = '\0';
    return *uri == '\0';
}

fmi2Component fmi2Instantiate(fmi2String instanceName, fmi2Type fmuType, fmi2String fmuGUID, fmi2String fmuResourceLocation,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible, fmi2Boolean loggingOn)
{
    char folder[4096];
    component with = {0};

    (void)visible;
    if (functions == NULL) {
        return NULL;
    }
    with.name = (char *)(size_t)(instanceName == NULL ? "" : instanceName);
    with.logs = loggingOn != fmi2False;
    with.log = log_message;
    with.logger = (void (*)(void))functions->logger;
    with.environment = functions->componentEnvironment;
    if (fmuType != fmi2CoSimulation) {
        log_message(&with, COMPONENT_ERROR, component_categories[COMPONENT_ERROR], "this FMU is for co-simulation");
        return NULL;
    }
    if (fmuResourceLocation != NULL && !folder_of(fmuResourceLocation, folder, sizeof folder)) {
        log_message(&with, COMPONENT_ERROR, component_categories[COMPONENT_ERROR], "the URI of the resources is too long or not a path");
        return NULL;
    }
    return component_new(&with, fmuGUID, fmuResourceLocation == NULL ? NULL : folder);
}

void fmi2FreeInstance(fmi2Component c)
{
    component_free(c);
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean toleranceDefined, fmi2Real tolerance, fmi2Real startTime,
                               fmi2Boolean stopTimeDefined, fmi2Real stopTime)
{
    ENTER(INSTANTIATED, SetupExperiment)
    (void)toleranceDefined;
    (void)tolerance;
    return (fmi2Status)component_begin(this, startTime, stopTimeDefined != fmi2False, stopTime);
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c)
{
    ENTER(INSTANTIATED, EnterInitializationMode)
    this->phase = INITIALIZING;
    return fmi2OK;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c)
{
    ENTER(INITIALIZING, ExitInitializationMode)
    return (fmi2Status)component_end_initialization(this);
}

fmi2Status fmi2Terminate(fmi2Component c)
{
    ENTER(STEPPING, Terminate)
    this->phase = TERMINATED;
    return fmi2OK;
}

fmi2Status fmi2Reset(fmi2Component c)
{
    ENTER(ANY_BUT_FAILED | FAILED, Reset)
    return (fmi2Status)component_reset(this);
}

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Real value[])
{
    fmi2Status status = fmi2OK;
    size_t number;

    ENTER(ANY_BUT_FAILED, GetReal)
    for (number = 0; number < nvr && status < fmi2Error; number++) {
        status = worse(status, component_get_real(this, vr[number], &value[number]));
    }
    return status;
}

fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Integer value[])
{
    fmi2Status status = fmi2OK;
    size_t number;

    ENTER(ANY_BUT_FAILED, GetInteger)
    for (number = 0; number < nvr && status < fmi2Error; number++) {
        int32_t integer = 0;

        status = worse(status, component_get_integer(this, vr[number], &integer));
        value[number] = integer;
    }
    return status;
}

fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Boolean value[])
{
    (void)value;
    return (fmi2Status)component_none(c, "fmi2GetBoolean", vr, nvr);
}

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2String value[])
{
    (void)value;
    return (fmi2Status)component_none(c, "fmi2GetString", vr, nvr);
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Real value[])
{
    ENTER(INSTANTIATED | INITIALIZING | STEPPING, SetReal)
    return (fmi2Status)component_set_reals(this, vr, nvr, value);
}

fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Integer value[])
{
    (void)value;
    return (fmi2Status)component_none(c, "fmi2SetInteger", vr, nvr);
}

fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Boolean value[])
{
    (void)value;
    return (fmi2Status)component_none(c, "fmi2SetBoolean", vr, nvr);
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2String value[])
{
    (void)value;
    return (fmi2Status)component_none(c, "fmi2SetString", vr, nvr);
}

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *FMUstate)
{
    ENTER(ANY_BUT_FAILED, GetFMUstate)
    return (fmi2Status)component_get_state(this, FMUstate);
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate FMUstate)
{
    ENTER(ANY_BUT_FAILED | FAILED, SetFMUstate)
    return (fmi2Status)component_set_state(this, FMUstate);
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *FMUstate)
{
    return (fmi2Status)component_free_state(c, "fmi2FreeFMUstate", FMUstate);
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate FMUstate, size_t *size)
{
    return (fmi2Status)component_state_size(c, "fmi2SerializedFMUstateSize", FMUstate, size);
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate FMUstate, fmi2Byte serializedState[], size_t size)
{
    ENTER(ANY_BUT_FAILED, SerializeFMUstate)
    return (fmi2Status)component_serialize(this, FMUstate, (uint8_t *)serializedState, size);
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte serializedState[], size_t size, fmi2FMUstate *FMUstate)
{
    ENTER(ANY_BUT_FAILED | FAILED, DeSerializeFMUstate)
    return (fmi2Status)component_deserialize(this, (const uint8_t *)serializedState, size, FMUstate);
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference vUnknown_ref[], size_t nUnknown,
                                        const fmi2ValueReference vKnown_ref[], size_t nKnown, const fmi2Real dvKnown[],
                                        fmi2Real dvUnknown[])
{
    (void)vUnknown_ref, (void)nUnknown, (void)vKnown_ref, (void)nKnown, (void)dvKnown, (void)dvUnknown;
    return (fmi2Status)component_unsupported(c, "fmi2GetDirectionalDerivative");
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Integer order[],
                                       const fmi2Real value[])
{
    size_t number;

    ENTER(INSTANTIATED | INITIALIZING | STEPPING, SetRealInputDerivatives)
    for (number = 0; number < nvr; number++) {
        if (order[number] != 1) {
            return (fmi2Status)component_tell(this, COMPONENT_DISCARD, "a derivative of order %d, allowed: 1", order[number]);
        }
        if (model_set_derivative(this->model, vr[number], value[number]) != MODEL_DONE) {
            return (fmi2Status)component_no_variable(this, vr[number]);
        }
    }
    return fmi2OK;
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                                        const fmi2Integer order[], fmi2Real value[])
{
    (void)vr, (void)nvr, (void)order, (void)value;
    return (fmi2Status)component_unsupported(c, "fmi2GetRealOutputDerivatives");
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real currentCommunicationPoint, fmi2Real communicationStepSize,
                      fmi2Boolean noSetFMUStatePriorToCurrentPoint)
{
    component_status status;

    ENTER(STEPPING, DoStep)
    (void)noSetFMUStatePriorToCurrentPoint;
    status = component_step(this, currentCommunicationPoint, communicationStepSize);
    /* FMI 2.0.4, 4.2.2: requests the end of the simulation; fmi2GetBooleanStatus then reports it. */
    return status < COMPONENT_DISCARD && component_has_ended(this) ? fmi2Discard : (fmi2Status)status;
}

fmi2Status fmi2CancelStep(fmi2Component c)
{
    return (fmi2Status)component_unsupported(c, "fmi2CancelStep");
}

/* A step is complete when fmi2DoStep returns, so only the time can be reported. */
static fmi2Status no_status(fmi2Component c, const char *function)
{
    component *const this = c;

    if (!component_allows(this, ANY_BUT_FAILED | FAILED, function)) {
        return fmi2Error;
    }
    return (fmi2Status)component_tell(this, COMPONENT_DISCARD, "%s: no step is under way", function);
}

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind s, fmi2Status *value)
{
    (void)s, (void)value;
    return no_status(c, "fmi2GetStatus");
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind s, fmi2Real *value)
{
    ENTER(ANY_BUT_FAILED | FAILED, GetRealStatus)
    if (s != fmi2LastSuccessfulTime) {
        return no_status(c, "fmi2GetRealStatus");
    }
    *value = component_time_s(this);
    return fmi2OK;
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind s, fmi2Integer *value)
{
    (void)s, (void)value;
    return no_status(c, "fmi2GetIntegerStatus");
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind s, fmi2Boolean *value)
{
    ENTER(ANY_BUT_FAILED | FAILED, GetBooleanStatus)
    if (s != fmi2Terminated) {
        return no_status(c, "fmi2GetBooleanStatus");
    }
    *value = component_has_ended(this);
    return fmi2OK;
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind s, fmi2String *value)
{
    (void)s, (void)value;
    return no_status(c, "fmi2GetStringStatus");
}
