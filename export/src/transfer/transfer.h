#ifndef DASHPOT_TRANSFER_PREFIX_H
#define DASHPOT_TRANSFER_PREFIX_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Units are SI. Displacement is positive in extension, force when it resists extension. No function accepts a null
 * pointer, but where it says so. All are reentrant: they use no global variable, no lock, no heap and no library. */

/* Status bits, latched until prefix_clear. Any bit ends the test, except the first two. */
#define PREFIX_COMMAND_LIMITED 1U  /* the command would have moved faster than its rate limit, and was limited */
#define PREFIX_MEASUREMENT_MISSED 2U  /* at least one tick had no valid measurement */
#define PREFIX_STROKE 4U  /* desired displacement or compensator's command not a number, or beyond the stroke */
#define PREFIX_VELOCITY 8U  /* the command was limited for too long */
#define PREFIX_FORCE 16U  /* the measured force was beyond its limit */
#define PREFIX_TRACKING 32U  /* measured and desired displacement too far apart for too long, or for the motion */
#define PREFIX_AGE 64U  /* measured values were too old */
#define PREFIX_IMPLAUSIBLE 128U  /* a measured value jumped, was not a number, or stayed while the command moved */
#define PREFIX_SIGN 256U  /* the force pushed in the direction of the motion: a wrong sign, or a driven specimen */
#define PREFIX_ENERGY 512U  /* the actuator added too much energy to the vehicle */
#define PREFIX_REQUESTED 1024U  /* prefix_end was called */
#define PREFIX_NO_FORCE 2048U  /* the specimen moved far without a force: it is broken, or not connected */

/* Phase of a test. */
#define PREFIX_APPROACHING 0U  /* the command moves slowly to the desired displacement */
#define PREFIX_RUNNING 1U  /* the command follows the wanted one */
#define PREFIX_ENDING 2U  /* the test has ended, and the command comes to rest */
#define PREFIX_HELD 3U  /* the test has ended, and the command stays */

/* How a test ends. */
#define PREFIX_HOLD 0U  /* stop, and hold the displacement */
#define PREFIX_ZERO_FORCE 1U  /* stop, and move back by the measured force divided by the stiffness of the specimen */

/* Desired motion of a tick. */
typedef struct prefix_motion {
    float displacement_m;
    float velocity_m_per_s;
    float acceleration_m_per_s2;
    float jerk_m_per_s3;
} prefix_motion;

/* Measured values of a tick. */
typedef struct prefix_measured {
    float displacement_m;
    float force_n;
} prefix_measured;

/* Result of a tick. */
typedef struct prefix_command {
    float command_m;  /* command of the actuator */
    float force_n;    /* force for the vehicle: the last valid measured one; after the end of a test it fades to 0 */
    uint16_t status;  /* latched PREFIX_... bits */
    uint16_t phase;   /* phase after the tick */
} prefix_command;

/* Settings. Fill them with prefix_default_settings, then change what differs. */
typedef struct prefix_settings {
    /* Compensator: u = a0 x + a1 x' + a2 x'' + a3 x'''. With all of `largest_change` 0 it does not adapt, and with the
     * coefficients 1, 0, 0, 0 it does nothing. */
    float nominal[4];         /* coefficients at the start, 1 to s^3 */
    float largest_change[4];  /* largest change of each coefficient in either direction; 0 keeps it */
    float noise_m;            /* misfit of command and measurement that says nothing about the coefficients, rms */
    float least_motion_m;     /* motion below which the coefficients are frozen: velocity over the pole */
    float pole_hz;            /* pole of the low-pass filters before the comparison */
    float memory_s;           /* time after which a past motion counts 1/e */
    float change_s;           /* shortest time for the largest change of a coefficient */
    /* Guard. */
    float stroke_m;           /* largest magnitude of the command */
    float velocity_m_per_s;   /* largest rate of the command; a faster command is limited */
    float limited_s;          /* time for which the command may be limited without a break */
    float force_n;            /* largest magnitude of the measured force */
    float error_m;            /* largest difference between measured and desired displacement */
    float error_s;            /* time for which the difference may be larger */
    float age_s;              /* longest time without a valid measurement */
    float plausible_m_per_s;  /* largest plausible rate of a measured displacement */
    float plausible_n_per_s;  /* largest plausible rate of a measured force */
    float stuck_travel_m;     /* travel of the command during which a measured value may stay the same */
    float least_force_n;      /* force below which the specimen counts as one without force; 0: no check */
    float without_force_m;    /* travel of the command during which the specimen may be without force */
    float ramp_s;             /* time in which the command comes to rest */
    float approach_m_per_s;   /* rate at which the command approaches the desired displacement at the start */
    float stiffness_n_per_m;  /* stiffness of the specimen, for PREFIX_ZERO_FORCE */
    uint32_t action;          /* PREFIX_HOLD or PREFIX_ZERO_FORCE */
    /* Added energy and tracking. */
    float energy_window_s;    /* time after which past energy counts 1/e */
    float largest_share;      /* added energy that is an alarm, as a share of the exchanged energy */
    float least_power_w;      /* mean exchanged power below which there is no alarm */
    float energy_pole_hz;     /* pole of the low-pass filters of displacement and force */
    float tracking_window_s;  /* time after which past motion counts 1/e in the tracking */
    float tracking_error;     /* error of the tracking that ends a test, relative to the desired motion */
} prefix_settings;

/* A chain of low-pass filters. */
typedef struct prefix_chain {
    float memory[3];
    float gain;
} prefix_chain;

/* Estimates the motion from displacements. */
typedef struct prefix_motion_filter {
    prefix_chain chain;
    float pole_per_s;
} prefix_motion_filter;

/* A transfer system: plain data that you can save by copying. Do not write the members. */
typedef struct prefix_system {
    /* Settings as used in a tick. */
    prefix_settings settings;
    float step_s;
    float scaled_nominal[4];
    float sensitivity[4];
    float noise_per_m;
    float least_square;
    float fading;
    float largest_move;
    float tracking_fading;
    float energy_fading;
    float energy_pole_per_s;
    float share_of_tick;
    float least_error_m;
    uint32_t most_age;
    uint32_t most_limited;
    uint32_t most_off;
    uint32_t window_ticks;
    uint32_t fading_ticks;
    uint32_t tracking_ticks;
    /* Compensator. */
    prefix_chain commands;
    prefix_chain measurements;
    float products[4][4];
    float misfits[4];
    float shares[4];
    float motion_square;
    uint32_t turn;
    bool is_frozen;
    /* Tracking: means over the fading past. */
    float desired_mean;
    float velocity_mean;
    float error_mean;
    float desired_square;
    float velocity_square;
    float crossed;
    float with_desired;
    float with_velocity;
    float error_square;
    /* Energy. */
    prefix_chain desired;
    prefix_chain errors;
    prefix_chain forces;
    float added_j;
    float added_w;
    float exchanged_w;
    float given_w;
    uint32_t ticks_left;
    /* Guard. */
    uint32_t phase;
    uint32_t status;
    uint32_t age;
    uint32_t limited;
    uint32_t off;
    float command_m;
    float change_m;
    float displacement_m;
    float force_n;
    float vehicle_force_n;
    float displacement_same_m;
    float force_same_m;
    float without_force_m;
    float from_m;
    float from_change_m;
    float release_m;
    float ending_s;
    float duration_s;
    uint32_t fading_left;
    bool was_running;
    uint32_t tracking_left;
} prefix_system;

/* Tracking and energy. */
typedef struct prefix_reading {
    float delay_s;          /* time by which the measured displacement is late; negative if it is early */
    float amplitude;        /* of the measured displacement relative to the desired one (1) */
    float relative_error;   /* root mean square of the error, relative to that of the desired displacement (1) */
    float error_m;          /* root mean square of measured minus desired displacement */
    float added_j;          /* energy added to the vehicle since the start; negative if taken away */
    float added_share;      /* share of the exchanged energy that was added over the fading past (1) */
    float coefficients[4];  /* present coefficients, 1 to s^3 */
    bool is_frozen;         /* true if the last motion was too small to learn from */
} prefix_reading;

/* Fills in defaults for an actuator with this stroke (m), velocity (m/s) and force (N), without compensation. */
void prefix_default_settings(prefix_settings *settings, float stroke_m, float velocity_m_per_s, float force_n);

/* Sets the compensator for an actuator with this delay (s), which may differ by `delay_error_s` (s). */
void prefix_set_delay(prefix_settings *settings, float delay_s, float delay_error_s);

/* Initialises a system at rest at 0 for ticks of `step_s` (s). Returns NULL, or a text that names the refused setting
 * and what is allowed; then the system does not change. */
const char *prefix_init(prefix_system *system, const prefix_settings *settings, float step_s);

/* Places a system that has not ended a test at the actuator's present displacement (m), from which the command
 * approaches the desired one. */
void prefix_place(prefix_system *system, float displacement_m);

/* Takes the desired motion and the measured values of a tick, NULL if none came. It never fails: invalid numbers are
 * left out and latched in the status. The command never moves by more than the velocity limit times the step, and all
 * results are finite. */
prefix_command prefix_tick(prefix_system *system, const prefix_motion *desired, const prefix_measured *measured);

/* Ends the test: the command comes to rest. */
void prefix_end(prefix_system *system);

/* Clears the status. A test that has come to rest starts again. While the command is still coming to rest, nothing is
 * cleared and the result is false. */
bool prefix_clear(prefix_system *system);

/* Reads tracking, energy and coefficients. Not for every tick: it needs square roots and an arc tangent. */
prefix_reading prefix_read(const prefix_system *system);

/* Initialises a motion filter at rest at 0 with its pole (Hz), 1 to a quarter of the rate of the ticks. Returns as
 * prefix_init. */
const char *prefix_motion_filter_init(prefix_motion_filter *filter, float pole_hz, float step_s);

/* Puts a filter at rest at a displacement (m): at the start, and after a displacement that was not finite. */
void prefix_motion_filter_rest_at(prefix_motion_filter *filter, float displacement_m);

/* Takes the displacement (m) of a tick and returns its motion. */
prefix_motion prefix_motion_filter_push(prefix_motion_filter *filter, float displacement_m);

/* Hash of the results of a built-in test. If it is not PREFIX_DIGEST, the compiler, its options or the mode of the
 * floating-point unit change the results. */
uint32_t prefix_digest(void);
