/* An instance of the model: what FMI 2 and 3 have in common. */

#ifndef DASHPOT_COMPONENT_H
#define DASHPOT_COMPONENT_H

#include <stdbool.h>

#include "model.h"

/* Numbers of fmi2Status and fmi3Status. */
typedef enum component_status {
    COMPONENT_OK,
    COMPONENT_WARNING,
    COMPONENT_DISCARD,  /* rejected; nothing changed */
    COMPONENT_ERROR     /* from now on, only reset, restoring a state and freeing are allowed */
} component_status;

typedef enum component_phase {
    INSTANTIATED = 1,
    INITIALIZING = 2,
    STEPPING = 4,
    TERMINATED = 8,
    FAILED = 16
} component_phase;

enum { ANY_BUT_FAILED = INSTANTIATED | INITIALIZING | STEPPING | TERMINATED };

typedef struct component component;

/* Passes a message to the importer. */
typedef void component_log(const component *this, component_status status, const char *category, const char *message);

struct component {
    model *model;
    char *name;
    component_phase phase;
    double start_s;
    double stop_s;      /* HUGE_VAL if not set */
    uint64_t steps;     /* internal steps since the start */
    double refused_at_s; /* the step that was refused last; HUGE_VAL if none */
    double refused_step_s;
    bool logs;
    bool may_return_early;
    unsigned categories;
    component_log *log;
    void (*logger)(void);  /* belongs to the importer; of any type */
    void *environment;
};

/* Creates an instance; `name` is copied. On failure returns NULL and logs the reason to `log`. */
component *component_new(const component *with, const char *token, const char *resources);
void component_free(component *this);

/* Logs a message if its category is enabled, and returns the status. */
component_status component_tell(component *this, component_status status, const char *format, ...);

/* True if a function may be called in this phase; otherwise logs an error. */
bool component_allows(component *this, unsigned phases, const char *function);

/* Sets the categories that are logged; without names, all of them. */
component_status component_set_logging(component *this, bool logs, size_t count, const char *const categories[]);
extern const char *const component_categories[COMPONENT_ERROR + 1];

double component_time_s(const component *this);
component_status component_begin(component *this, double start_s, bool stops, double stop_s);
component_status component_end_initialization(component *this);
component_status component_reset(component *this);

component_status component_get_real(component *this, uint32_t variable, double *value);
/* Sets all values, or none if one is refused. */
component_status component_set_reals(component *this, const uint32_t variables[], size_t count, const double values[]);
component_status component_get_integer(component *this, uint32_t variable, int32_t *value);
component_status component_no_variable(component *this, uint32_t variable);

/* For types that have no variables here: a request for no variables is not an error. */
component_status component_none(component *this, const char *function, const uint32_t variables[], size_t count);

/* Logs the error of a function for a capability or mode that this FMU does not have. */
component_status component_unsupported(component *this, const char *function);

/* Steps to `at_s + step_s`. Refuses a step that is not a multiple of the internal step or does not start at the end
 * of the last one. The step is shorter if the model ends. */
component_status component_step(component *this, double at_s, double step_s);
bool component_has_ended(const component *this);

/* Copy of a whole instance. Serialization writes the same bytes. A state is NULL if there is no memory for it. */
typedef struct component_state {
    size_t bytes;
    uint8_t content[];
} component_state;

component_status component_get_state(component *this, void **state);
component_status component_set_state(component *this, const component_state *state);
component_status component_free_state(component *this, const char *function, void **state);
component_status component_state_size(component *this, const char *function, const component_state *state, size_t *size);
component_status component_serialize(component *this, const component_state *state, uint8_t *bytes, size_t count);
component_status component_deserialize(component *this, const uint8_t *bytes, size_t count, void **state);

#endif
