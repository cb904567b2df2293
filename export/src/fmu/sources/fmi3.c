/* FMI 3.0 for co-simulation: all functions, on top of component.h. */

#if !defined(FMI3_FUNCTION_PREFIX) && !defined(FMI3_OVERRIDE_FUNCTION_PREFIX)
#define FMI3_FUNCTION_PREFIX MODEL_IDENTIFIER_
#endif
#include "fmi3Functions.h"

#include "component.h"

#define ENTER(phases, function)                              \
    component *const this = instance;                        \
    if (!component_allows(this, phases, "fmi3" #function)) { \
        return fmi3Error;                                    \
    }

static void log_message(const component *this, component_status status, const char *category, const char *message)
{
    const fmi3LogMessageCallback logger = (fmi3LogMessageCallback)this->logger;

    if (logger != NULL) {
        logger(this->environment, (fmi3Status)status, category, message);
    }
}

/* The worse of two statuses. */
static fmi3Status worse(fmi3Status a, component_status b)
{
    return (fmi3Status)b > a ? (fmi3Status)b : a;
}

/* Every variable is a scalar. */
static bool counts(component *this, size_t references, size_t values)
{
    if (references != values) {
        (void)component_tell(this, COMPONENT_ERROR, "%lu values for %lu scalar variables", (unsigned long)values,
                             (unsigned long)references);
    }
    return references == values;
}

const char *fmi3GetVersion(void)
{
    return fmi3Version;
}

fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean loggingOn, size_t nCategories,
                               const fmi3String categories[])
{
    ENTER(ANY_BUT_FAILED | FAILED, SetDebugLogging)
    return (fmi3Status)component_set_logging(this, loggingOn, nCategories, categories);
}

/* Data that an instance gets from its importer. */
static component imported(fmi3String name, fmi3Boolean logs, fmi3InstanceEnvironment environment,
                          fmi3LogMessageCallback logger)
{
    component with = {0};

    with.name = (char *)(size_t)(name == NULL ? "" : name);
    with.logs = logs;
    with.log = log_message;
    with.logger = (void (*)(void))logger;
    with.environment = environment;
    return with;
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String instanceName, fmi3String instantiationToken, fmi3String resourcePath,
                                         fmi3Boolean visible, fmi3Boolean loggingOn, fmi3Boolean eventModeUsed,
                                         fmi3Boolean earlyReturnAllowed,
                                         const fmi3ValueReference requiredIntermediateVariables[],
                                         size_t nRequiredIntermediateVariables,
                                         fmi3InstanceEnvironment instanceEnvironment, fmi3LogMessageCallback logMessage,
                                         fmi3IntermediateUpdateCallback intermediateUpdate)
{
    component with = imported(instanceName, loggingOn, instanceEnvironment, logMessage);

    with.may_return_early = earlyReturnAllowed;
    (void)visible, (void)requiredIntermediateVariables, (void)intermediateUpdate;
    if (eventModeUsed || nRequiredIntermediateVariables > 0) {
        log_message(&with, COMPONENT_ERROR, component_categories[COMPONENT_ERROR],
                    "this FMU has neither events nor intermediate variables");
        return NULL;
    }
    return component_new(&with, instantiationToken, resourcePath);
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String instanceName, fmi3String instantiationToken, fmi3String resourcePath,
                                          fmi3Boolean visible, fmi3Boolean loggingOn,
                                          fmi3InstanceEnvironment instanceEnvironment, fmi3LogMessageCallback logMessage)
{
    const component with = imported(instanceName, loggingOn, instanceEnvironment, logMessage);

    (void)instantiationToken, (void)resourcePath, (void)visible;
    log_message(&with, COMPONENT_ERROR, component_categories[COMPONENT_ERROR], "this FMU is for co-simulation");
    return NULL;
}

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String instanceName, fmi3String instantiationToken,
                                               fmi3String resourcePath, fmi3Boolean visible, fmi3Boolean loggingOn,
                                               fmi3InstanceEnvironment instanceEnvironment,
                                               fmi3LogMessageCallback logMessage, fmi3ClockUpdateCallback clockUpdate,
                                               fmi3LockPreemptionCallback lockPreemption,
                                               fmi3UnlockPreemptionCallback unlockPreemption)
{
    (void)clockUpdate, (void)lockPreemption, (void)unlockPreemption;
    return fmi3InstantiateModelExchange(instanceName, instantiationToken, resourcePath, visible, loggingOn,
                                        instanceEnvironment, logMessage);
}

void fmi3FreeInstance(fmi3Instance instance)
{
    component_free(instance);
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean toleranceDefined, fmi3Float64 tolerance,
                                       fmi3Float64 startTime, fmi3Boolean stopTimeDefined, fmi3Float64 stopTime)
{
    ENTER(INSTANTIATED, EnterInitializationMode)
    (void)toleranceDefined, (void)tolerance;
    if (component_begin(this, startTime, stopTimeDefined, stopTime) != COMPONENT_OK) {
        return fmi3Error;
    }
    this->phase = INITIALIZING;
    return fmi3OK;
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance)
{
    ENTER(INITIALIZING, ExitInitializationMode)
    return (fmi3Status)component_end_initialization(this);
}

fmi3Status fmi3Terminate(fmi3Instance instance)
{
    ENTER(STEPPING, Terminate)
    this->phase = TERMINATED;
    return fmi3OK;
}

fmi3Status fmi3Reset(fmi3Instance instance)
{
    ENTER(ANY_BUT_FAILED | FAILED, Reset)
    return (fmi3Status)component_reset(this);
}

fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                          fmi3Float64 values[], size_t nValues)
{
    fmi3Status status = fmi3OK;
    size_t number;

    ENTER(ANY_BUT_FAILED, GetFloat64)
    if (!counts(this, nValueReferences, nValues)) {
        return fmi3Error;
    }
    for (number = 0; number < nValues && status < fmi3Error; number++) {
        status = worse(status, component_get_real(this, valueReferences[number], &values[number]));
    }
    return status;
}

fmi3Status fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                          const fmi3Float64 values[], size_t nValues)
{
    ENTER(INSTANTIATED | INITIALIZING | STEPPING, SetFloat64)
    if (!counts(this, nValueReferences, nValues)) {
        return fmi3Error;
    }
    return (fmi3Status)component_set_reals(this, valueReferences, nValues, values);
}

fmi3Status fmi3GetInt32(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                        fmi3Int32 values[], size_t nValues)
{
    fmi3Status status = fmi3OK;
    size_t number;

    ENTER(ANY_BUT_FAILED, GetInt32)
    if (!counts(this, nValueReferences, nValues)) {
        return fmi3Error;
    }
    for (number = 0; number < nValues && status < fmi3Error; number++) {
        status = worse(status, component_get_integer(this, valueReferences[number], &values[number]));
    }
    return status;
}

#define NONE(function, values)                                                                                   \
    fmi3Status fmi3##function(fmi3Instance instance, const fmi3ValueReference valueReferences[],                 \
                              size_t nValueReferences, values, size_t nValues)                                   \
    {                                                                                                            \
        (void)values_, (void)nValues;                                                                            \
        return (fmi3Status)component_none(instance, "fmi3" #function, valueReferences, nValueReferences);                              \
    }

NONE(GetFloat32, fmi3Float32 values_[])
NONE(GetInt8, fmi3Int8 values_[])
NONE(GetUInt8, fmi3UInt8 values_[])
NONE(GetInt16, fmi3Int16 values_[])
NONE(GetUInt16, fmi3UInt16 values_[])
NONE(GetUInt32, fmi3UInt32 values_[])
NONE(GetInt64, fmi3Int64 values_[])
NONE(GetUInt64, fmi3UInt64 values_[])
NONE(GetBoolean, fmi3Boolean values_[])
NONE(GetString, fmi3String values_[])
NONE(SetFloat32, const fmi3Float32 values_[])
NONE(SetInt8, const fmi3Int8 values_[])
NONE(SetUInt8, const fmi3UInt8 values_[])
NONE(SetInt16, const fmi3Int16 values_[])
NONE(SetUInt16, const fmi3UInt16 values_[])
NONE(SetInt32, const fmi3Int32 values_[])
NONE(SetUInt32, const fmi3UInt32 values_[])
NONE(SetInt64, const fmi3Int64 values_[])
NONE(SetUInt64, const fmi3UInt64 values_[])
NONE(SetBoolean, const fmi3Boolean values_[])
NONE(SetString, const fmi3String values_[])

fmi3Status fmi3GetBinary(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                         size_t valueSizes[], fmi3Binary values[], size_t nValues)
{
    (void)valueSizes, (void)values, (void)nValues;
    return (fmi3Status)component_none(instance, "fmi3GetBinary", valueReferences, nValueReferences);
}

fmi3Status fmi3SetBinary(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                         const size_t valueSizes[], const fmi3Binary values[], size_t nValues)
{
    (void)valueSizes, (void)values, (void)nValues;
    return (fmi3Status)component_none(instance, "fmi3SetBinary", valueReferences, nValueReferences);
}

fmi3Status fmi3GetClock(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                        fmi3Clock values[])
{
    (void)values;
    return (fmi3Status)component_none(instance, "fmi3GetClock", valueReferences, nValueReferences);
}

fmi3Status fmi3SetClock(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                        const fmi3Clock values[])
{
    (void)values;
    return (fmi3Status)component_none(instance, "fmi3SetClock", valueReferences, nValueReferences);
}

fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState *FMUState)
{
    ENTER(ANY_BUT_FAILED, GetFMUState)
    return (fmi3Status)component_get_state(this, FMUState);
}

fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState FMUState)
{
    ENTER(ANY_BUT_FAILED | FAILED, SetFMUState)
    return (fmi3Status)component_set_state(this, FMUState);
}

fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState *FMUState)
{
    return (fmi3Status)component_free_state(instance, "fmi3FreeFMUState", FMUState);
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState FMUState, size_t *size)
{
    return (fmi3Status)component_state_size(instance, "fmi3SerializedFMUStateSize", FMUState, size);
}

fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState FMUState, fmi3Byte serializedState[], size_t size)
{
    ENTER(ANY_BUT_FAILED, SerializeFMUState)
    return (fmi3Status)component_serialize(this, FMUState, serializedState, size);
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte serializedState[], size_t size,
                                   fmi3FMUState *FMUState)
{
    ENTER(ANY_BUT_FAILED | FAILED, DeserializeFMUState)
    return (fmi3Status)component_deserialize(this, serializedState, size, FMUState);
}

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 currentCommunicationPoint, fmi3Float64 communicationStepSize,
                      fmi3Boolean noSetFMUStatePriorToCurrentPoint, fmi3Boolean *eventHandlingNeeded,
                      fmi3Boolean *terminateSimulation, fmi3Boolean *earlyReturn, fmi3Float64 *lastSuccessfulTime)
{
    component_status status;

    ENTER(STEPPING, DoStep)
    (void)noSetFMUStatePriorToCurrentPoint;
    status = component_step(this, currentCommunicationPoint, communicationStepSize);
    *eventHandlingNeeded = false;
    *terminateSimulation = component_has_ended(this);
    *lastSuccessfulTime = component_time_s(this);
    *earlyReturn = *terminateSimulation && this->may_return_early
                   && *lastSuccessfulTime < currentCommunicationPoint + communicationStepSize - 0.5 * model_step_s;
    return (fmi3Status)status;
}

/* Functions for capabilities or modes that this FMU does not have. */

fmi3Status fmi3EnterEventMode(fmi3Instance instance)
{
    return (fmi3Status)component_unsupported(instance, "fmi3EnterEventMode");
}

fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance instance, fmi3ValueReference valueReference,
                                               size_t *nDependencies)
{
    (void)valueReference, (void)nDependencies;
    return (fmi3Status)component_unsupported(instance, "fmi3GetNumberOfVariableDependencies");
}

fmi3Status fmi3GetVariableDependencies(fmi3Instance instance, fmi3ValueReference dependent,
                                       size_t elementIndicesOfDependent[], fmi3ValueReference independents[],
                                       size_t elementIndicesOfIndependents[], fmi3DependencyKind dependencyKinds[],
                                       size_t nDependencies)
{
    (void)dependent, (void)elementIndicesOfDependent, (void)independents, (void)elementIndicesOfIndependents, (void)dependencyKinds, (void)nDependencies;
    return (fmi3Status)component_unsupported(instance, "fmi3GetVariableDependencies");
}

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[], size_t nUnknowns,
                                        const fmi3ValueReference knowns[], size_t nKnowns, const fmi3Float64 seed[],
                                        size_t nSeed, fmi3Float64 sensitivity[], size_t nSensitivity)
{
    (void)unknowns, (void)nUnknowns, (void)knowns, (void)nKnowns, (void)seed, (void)nSeed, (void)sensitivity, (void)nSensitivity;
    return (fmi3Status)component_unsupported(instance, "fmi3GetDirectionalDerivative");
}

fmi3Status fmi3GetAdjointDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[], size_t nUnknowns,
                                    const fmi3ValueReference knowns[], size_t nKnowns, const fmi3Float64 seed[],
                                    size_t nSeed, fmi3Float64 sensitivity[], size_t nSensitivity)
{
    (void)unknowns, (void)nUnknowns, (void)knowns, (void)nKnowns, (void)seed, (void)nSeed, (void)sensitivity, (void)nSensitivity;
    return (fmi3Status)component_unsupported(instance, "fmi3GetAdjointDerivative");
}

fmi3Status fmi3EnterConfigurationMode(fmi3Instance instance)
{
    return (fmi3Status)component_unsupported(instance, "fmi3EnterConfigurationMode");
}

fmi3Status fmi3ExitConfigurationMode(fmi3Instance instance)
{
    return (fmi3Status)component_unsupported(instance, "fmi3ExitConfigurationMode");
}

fmi3Status fmi3GetIntervalDecimal(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                                  size_t nValueReferences, fmi3Float64 intervals[], fmi3IntervalQualifier qualifiers[])
{
    (void)valueReferences, (void)nValueReferences, (void)intervals, (void)qualifiers;
    return (fmi3Status)component_unsupported(instance, "fmi3GetIntervalDecimal");
}

fmi3Status fmi3GetIntervalFraction(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                                   size_t nValueReferences, fmi3UInt64 counters[], fmi3UInt64 resolutions[],
                                   fmi3IntervalQualifier qualifiers[])
{
    (void)valueReferences, (void)nValueReferences, (void)counters, (void)resolutions, (void)qualifiers;
    return (fmi3Status)component_unsupported(instance, "fmi3GetIntervalFraction");
}

fmi3Status fmi3GetShiftDecimal(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                               size_t nValueReferences, fmi3Float64 shifts[])
{
    (void)valueReferences, (void)nValueReferences, (void)shifts;
    return (fmi3Status)component_unsupported(instance, "fmi3GetShiftDecimal");
}

fmi3Status fmi3GetShiftFraction(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                                size_t nValueReferences, fmi3UInt64 counters[], fmi3UInt64 resolutions[])
{
    (void)valueReferences, (void)nValueReferences, (void)counters, (void)resolutions;
    return (fmi3Status)component_unsupported(instance, "fmi3GetShiftFraction");
}

fmi3Status fmi3SetIntervalDecimal(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                                  size_t nValueReferences, const fmi3Float64 intervals[])
{
    (void)valueReferences, (void)nValueReferences, (void)intervals;
    return (fmi3Status)component_unsupported(instance, "fmi3SetIntervalDecimal");
}

fmi3Status fmi3SetIntervalFraction(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                                   size_t nValueReferences, const fmi3UInt64 counters[], const fmi3UInt64 resolutions[])
{
    (void)valueReferences, (void)nValueReferences, (void)counters, (void)resolutions;
    return (fmi3Status)component_unsupported(instance, "fmi3SetIntervalFraction");
}

fmi3Status fmi3SetShiftDecimal(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                               size_t nValueReferences, const fmi3Float64 shifts[])
{
    (void)valueReferences, (void)nValueReferences, (void)shifts;
    return (fmi3Status)component_unsupported(instance, "fmi3SetShiftDecimal");
}

fmi3Status fmi3SetShiftFraction(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                                size_t nValueReferences, const fmi3UInt64 counters[], const fmi3UInt64 resolutions[])
{
    (void)valueReferences, (void)nValueReferences, (void)counters, (void)resolutions;
    return (fmi3Status)component_unsupported(instance, "fmi3SetShiftFraction");
}

fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance instance)
{
    return (fmi3Status)component_unsupported(instance, "fmi3EvaluateDiscreteStates");
}

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean *discreteStatesNeedUpdate,
                                    fmi3Boolean *terminateSimulation, fmi3Boolean *nominalsOfContinuousStatesChanged,
                                    fmi3Boolean *valuesOfContinuousStatesChanged, fmi3Boolean *nextEventTimeDefined,
                                    fmi3Float64 *nextEventTime)
{
    (void)discreteStatesNeedUpdate, (void)terminateSimulation, (void)nominalsOfContinuousStatesChanged, (void)valuesOfContinuousStatesChanged, (void)nextEventTimeDefined, (void)nextEventTime;
    return (fmi3Status)component_unsupported(instance, "fmi3UpdateDiscreteStates");
}

fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance instance)
{
    return (fmi3Status)component_unsupported(instance, "fmi3EnterContinuousTimeMode");
}

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance instance, fmi3Boolean noSetFMUStatePriorToCurrentPoint,
                                       fmi3Boolean *enterEventMode, fmi3Boolean *terminateSimulation)
{
    (void)noSetFMUStatePriorToCurrentPoint, (void)enterEventMode, (void)terminateSimulation;
    return (fmi3Status)component_unsupported(instance, "fmi3CompletedIntegratorStep");
}

fmi3Status fmi3SetTime(fmi3Instance instance, fmi3Float64 time)
{
    (void)time;
    return (fmi3Status)component_unsupported(instance, "fmi3SetTime");
}

fmi3Status fmi3SetContinuousStates(fmi3Instance instance, const fmi3Float64 continuousStates[],
                                   size_t nContinuousStates)
{
    (void)continuousStates, (void)nContinuousStates;
    return (fmi3Status)component_unsupported(instance, "fmi3SetContinuousStates");
}

fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance instance, fmi3Float64 derivatives[], size_t nContinuousStates)
{
    (void)derivatives, (void)nContinuousStates;
    return (fmi3Status)component_unsupported(instance, "fmi3GetContinuousStateDerivatives");
}

fmi3Status fmi3GetEventIndicators(fmi3Instance instance, fmi3Float64 eventIndicators[], size_t nEventIndicators)
{
    (void)eventIndicators, (void)nEventIndicators;
    return (fmi3Status)component_unsupported(instance, "fmi3GetEventIndicators");
}

fmi3Status fmi3GetContinuousStates(fmi3Instance instance, fmi3Float64 continuousStates[], size_t nContinuousStates)
{
    (void)continuousStates, (void)nContinuousStates;
    return (fmi3Status)component_unsupported(instance, "fmi3GetContinuousStates");
}

fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance instance, fmi3Float64 nominals[], size_t nContinuousStates)
{
    (void)nominals, (void)nContinuousStates;
    return (fmi3Status)component_unsupported(instance, "fmi3GetNominalsOfContinuousStates");
}

fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance instance, size_t *nEventIndicators)
{
    (void)nEventIndicators;
    return (fmi3Status)component_unsupported(instance, "fmi3GetNumberOfEventIndicators");
}

fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance instance, size_t *nContinuousStates)
{
    (void)nContinuousStates;
    return (fmi3Status)component_unsupported(instance, "fmi3GetNumberOfContinuousStates");
}

fmi3Status fmi3EnterStepMode(fmi3Instance instance)
{
    return (fmi3Status)component_unsupported(instance, "fmi3EnterStepMode");
}

fmi3Status fmi3GetOutputDerivatives(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                                    size_t nValueReferences, const fmi3Int32 orders[], fmi3Float64 values[],
                                    size_t nValues)
{
    (void)valueReferences, (void)nValueReferences, (void)orders, (void)values, (void)nValues;
    return (fmi3Status)component_unsupported(instance, "fmi3GetOutputDerivatives");
}

fmi3Status fmi3ActivateModelPartition(fmi3Instance instance, fmi3ValueReference clockReference,
                                      fmi3Float64 activationTime)
{
    (void)clockReference, (void)activationTime;
    return (fmi3Status)component_unsupported(instance, "fmi3ActivateModelPartition");
}
