#ifndef DASHPOT_STANDALONE_PREFIX_H
#define DASHPOT_STANDALONE_PREFIX_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Floating-point type of the step, and an integer type for its bits. */
typedef SCALAR_TYPE prefix_real;
typedef SCALAR_WORD prefix_bits;

/* Status bits, latched in a state until prefix_clear_status. */
#define PREFIX_INPUT_HELD 1U      /* a displacement was not finite, out of range, or too far to catch up with: held */
#define PREFIX_INPUT_LIMITED 2U   /* a displacement moved faster than the largest rate: followed at that rate */
#define PREFIX_SATURATED 4U       /* the element yielded: it reached the saturation force or the force limit */
#define PREFIX_DAMPER_SWAPPED 8U  /* a different damper stepped the state; the force was carried over */
#define PREFIX_CORRUPTED 16U      /* memory was damaged: no step could produce the state, which restarted at rest */
#define PREFIX_RESTARTED 32U      /* a displacement was too far to catch up with: restarted at rest there */

/* Result of a function that can reject its arguments. */
typedef enum prefix_result {
    PREFIX_DONE = 0,
    PREFIX_CLEARANCE_REFUSED = 1,  /* the clearance is outside 0 to 0.1 m */
    PREFIX_OTHER_DAMPER = 2,       /* the saved bytes belong to another damper or another clearance */
    PREFIX_IMPOSSIBLE_VALUES = 3   /* the saved bytes contain numbers that no step of this damper could produce */
} prefix_result;

/* Four numbers of the table, stored in flash. */
typedef struct prefix_row prefix_row;

/* A damper for one step size, shared by any number of states. Only a change of the clearance changes it. */
typedef struct prefix_damper {
    prefix_bits move_bound;          /* largest credible move of the input in a step: its bits (m), doubled */
    prefix_real position_rounder_m;  /* adding and subtracting this rounds a travel to the grid of positions */
    prefix_real rest_rounder_m;      /* adding and subtracting this rounds a stretch far below that grid to zero */
    prefix_real step_s;
    prefix_real offset_m;            /* maximum stretch without flow: half the clearance plus `held_m` */
    prefix_real first_knot_m;        /* where the first piece of each side begins; a power of two */
    prefix_real half_clearance_m;
    prefix_real force_limit_n;       /* force at which the element yields */
    prefix_real held_m;              /* stretch of the mount under seal friction */
    prefix_bits displacement_bound;  /* largest displacement from zero: its bits (m), doubled */
    prefix_bits stretch_bound;       /* largest stretch after a step: its bits (m), doubled */
    uint32_t revision;               /* identifies the damper */
    uint32_t table_revision;
    const prefix_row *rows;          /* four rows a piece: pieces of extension, then of compression */
    const uint8_t (*bins)[2];        /* twice the index of the piece at the lower border of each bin, for both sides */
} prefix_damper;

/* State of one damper: plain data that you can save and restore by copying. Read the members, but do not write them. */
typedef struct prefix_state {
    prefix_real displacement_m;      /* last displacement, positive in extension */
    prefix_real stretch_m;           /* of clearance and series springs; the piston is at displacement minus stretch */
    prefix_real potential_m2;        /* flow potential at the stretch, times the step */
    prefix_real force_n;             /* last force, positive when it resists extension */
    uint32_t revision;               /* revision of the damper that last stepped the state */
    uint16_t status_word;            /* marker and status; see prefix_status */
    uint16_t rejected_inputs;        /* number of ticks held, limited or restarted, at most 65535 */
} prefix_state;

#define PREFIX_STATE_BYTES ((4U * sizeof(prefix_real)) + 8U)

/* Do not pass null pointers. All functions are reentrant: they use no global variable, no lock and no heap. */

/* Puts a state at rest at a displacement (m), centred in the clearance, without force. A displacement that is not
 * finite or is out of range is rejected, latched and counted: the state then waits at an end of the range, and restarts
 * without force at the first valid displacement. */
void prefix_at_rest(const prefix_damper *damper, prefix_state *state, prefix_real displacement_m);

/* Steps one tick and returns the force (N) at the displacement (m) of this tick; the force is positive when it resists
 * extension. Call it every `step_s`. It never fails: it holds or limits invalid input and latches that in the status.
 * The force is always finite and within the force limit, whatever the bits of input and state. A state that no step
 * could produce restarts at rest, and the status reports it. Each step has the same cost, except for invalid input,
 * damaged states and swapped dampers. */
prefix_real prefix_step(const prefix_damper *damper, prefix_state *state, prefix_real displacement_m);

/* Sets the clearance 2a (m), the total play, between two steps. States adapt at their next step and keep their force.
 * The damper must be in RAM. If the clearance is rejected, the damper does not change. */
prefix_result prefix_set_clearance_m(prefix_damper *damper, prefix_real clearance_m);

/* Adapts a state to another damper. The first step with that damper would do the same, at about ten times the usual
 * cost of a step. To keep the usual cost in every tick, call this function between two ticks. */
void prefix_adopt(const prefix_damper *damper, prefix_state *state);

/* The first function returns the status bits of a state; the second clears them and the counter. */
unsigned prefix_status(const prefix_state *state);
void prefix_clear_status(prefix_state *state);

/* Clearance 2a (m), largest displacement (m) from zero that a step follows, and maximum magnitude of the force (N). */
prefix_real prefix_clearance_m(const prefix_damper *damper);
prefix_real prefix_largest_displacement_m(const prefix_damper *damper);
prefix_real prefix_force_limit_n(const prefix_damper *damper);

/* Writes a state as bytes: little-endian on any processor, and the same as DamperState::to_bytes in Rust. The bytes
 * have no checksum: add one if they could be damaged. */
void prefix_save(const prefix_state *state, uint8_t bytes[PREFIX_STATE_BYTES]);

/* Restores a saved state, bit for bit. If the bytes are rejected, `state` does not change. */
prefix_result prefix_restore(const prefix_damper *damper, prefix_state *state,
                             const uint8_t bytes[PREFIX_STATE_BYTES]);

/* Hash of a damper's states during a built-in motion of PREFIX_DIGEST_STEPS steps. If it differs from that of the
 * damper as built in Rust, the compiler, its options or the mode of the floating-point unit change the forces. */
uint32_t prefix_digest(const prefix_damper *damper);

#define PREFIX_DIGEST_STEPS 2048U

