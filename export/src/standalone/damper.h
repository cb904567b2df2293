#ifndef DASHPOT_STANDALONE_PREFIX_H
#define DASHPOT_STANDALONE_PREFIX_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The number of the step, and its bits. */
typedef SCALAR_TYPE prefix_real;
typedef SCALAR_WORD prefix_bits;

/* Status bits, latched in a state until prefix_clear_status. */
enum {
    PREFIX_INPUT_HELD = 1,      /* a displacement was not finite, out of range, or too far to catch up with; held */
    PREFIX_INPUT_LIMITED = 2,   /* a displacement moved faster than the largest rate; followed at that rate */
    PREFIX_SATURATED = 4,       /* the element yielded: saturation force or force limit reached */
    PREFIX_DAMPER_SWAPPED = 8,  /* a different damper stepped the state; the force was carried over */
    PREFIX_CORRUPTED = 16,      /* memory was damaged: a state that no step could produce restarted at rest */
    PREFIX_RESTARTED = 32       /* a displacement was too far to catch up with: restarted at rest there */
};

/* What a function that can refuse returns. */
typedef enum prefix_result {
    PREFIX_DONE = 0,
    PREFIX_CLEARANCE_REFUSED = 1,  /* a clearance that is not 0 to 0.1 m */
    PREFIX_OTHER_DAMPER = 2,       /* saved bytes of another damper, or of another clearance */
    PREFIX_IMPOSSIBLE_VALUES = 3   /* saved bytes with numbers that no step of this damper leaves behind */
} prefix_result;

/* Piece of the table, in flash. */
typedef struct prefix_piece prefix_piece;

/* A damper for one step size, shared by any number of states. Its numbers change with the clearance only. */
typedef struct prefix_damper {
    prefix_bits move_bound;          /* largest credible move of the input in a step: its bits (m), doubled */
    prefix_real position_rounder_m;  /* adding and subtracting it rounds a travel to the grid of positions */
    prefix_real rest_rounder_m;      /* the same for a stretch far below that grid, to zero */
    prefix_real step_s;
    prefix_real offset_m;            /* stretch up to which nothing flows: half the clearance and `held_m` */
    prefix_real first_knot_m;        /* where the first piece of either side begins, a power of two */
    prefix_real half_clearance_m;
    prefix_real force_limit_n;       /* force at which the element yields */
    prefix_real held_m;              /* stretch of the mount under seal friction */
    prefix_bits displacement_bound;  /* largest displacement from zero: its bits (m), doubled */
    prefix_bits stretch_bound;       /* largest stretch that a step leaves behind: its bits (m), doubled */
    uint32_t revision;               /* identifies the damper */
    uint32_t table_revision;
    const prefix_piece *pieces;      /* of extension, then of compression */
    const uint8_t (*bins)[2];        /* the piece at a bin's lower border, of either side */
} prefix_damper;

/* State of one damper: plain data, saved and restored by copying. Read it, but let functions write it. */
typedef struct prefix_state {
    prefix_real displacement_m;      /* last displacement, positive in extension */
    prefix_real stretch_m;           /* of clearance and series springs; displacement less stretch is the piston's */
    prefix_real potential_m2;        /* flow potential at the stretch, times the step */
    prefix_real force_n;             /* last force, positive when it resists extension */
    uint32_t revision;               /* of the damper that stepped last */
    uint16_t status_word;            /* marker and status; see prefix_status */
    uint16_t rejected_inputs;        /* ticks held, limited or restarted, up to 65535 */
} prefix_state;

enum { PREFIX_STATE_BYTES = 4 * sizeof(prefix_real) + 8 };

/* No function takes a null pointer. Each is reentrant: no global variable, no lock, no heap. */

/* Puts a state at rest at a displacement (m), centred in the clearance, without force. A displacement that is
 * not finite or out of range is rejected, latched and counted; the state waits at an end of the range, and the first
 * good displacement restarts it there without force. */
void prefix_at_rest(const prefix_damper *damper, prefix_state *state, prefix_real displacement_m);

/* Force (N) at this tick for the displacement (m) of the tick; positive when it resists extension. Call it every
 * `step_s`. Never fails: bad input is held or limited and latched in the status; the force is finite and within
 * the force limit whatever the bits of input and state. A state that no step leaves behind starts over at rest and says
 * so. One cost, but for bad input, damaged states and swapped dampers. */
prefix_real prefix_step(const prefix_damper *damper, prefix_state *state, prefix_real displacement_m);

/* Sets the clearance 2a (m), the whole play, between two steps: states follow at their next step, their force kept.
 * The damper must lie in RAM. Refused, it stays as it is. */
prefix_result prefix_set_clearance_m(prefix_damper *damper, prefix_real clearance_m);

/* Carries a state over to a damper: what the first step with it does by itself, at some ten times the cost of a
 * step. Call it between ticks where that tick must keep its usual cost. */
void prefix_adopt(const prefix_damper *damper, prefix_state *state);

/* Status bits of a state, and all of them cleared with the counter. */
unsigned prefix_status(const prefix_state *state);
void prefix_clear_status(prefix_state *state);

/* Clearance 2a (m), the largest displacement (m) from zero that a step follows, and the force (N) that none exceeds. */
prefix_real prefix_clearance_m(const prefix_damper *damper);
prefix_real prefix_largest_displacement_m(const prefix_damper *damper);
prefix_real prefix_force_limit_n(const prefix_damper *damper);

/* A state as bytes, little-endian on any processor and the same in Rust (DamperState::to_bytes). They have no
 * checksum: where they may be damaged, add one. */
void prefix_save(const prefix_state *state, uint8_t bytes[PREFIX_STATE_BYTES]);

/* The state that was saved, to the bit. Refused, `state` stays as it is. */
prefix_result prefix_restore(const prefix_damper *damper, prefix_state *state,
                             const uint8_t bytes[PREFIX_STATE_BYTES]);

/* Hash of a damper's states over a built-in motion of PREFIX_DIGEST_STEPS steps. Where it is not that of the
 * damper as built in Rust, a compiler, its options or the mode of the floating-point unit change the forces. */
uint32_t prefix_digest(const prefix_damper *damper);

enum { PREFIX_DIGEST_STEPS = 2048 };

