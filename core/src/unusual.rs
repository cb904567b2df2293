//! Handles an unusual state or displacement before a step.

use crate::damper::Damper;
use crate::real::Real;
use crate::stages::state_at_force;
use crate::state::DamperState;
use crate::status::Status;

/// Longest time in which the damper may catch up with its input, at its largest rate (s). If the input is farther away,
/// the force falls from its limit to zero in the same time.
const CATCH_UP_S: f64 = 0.01;

/// Smallest decrease of the force in a step, as a fraction of the force limit (1). It is that of the shortest step.
const MIN_FALL: f64 = 1e-4;

/// Makes the state valid for the damper and returns the travel (m) of this step towards the displacement (m).
///
/// - An impossible state restarts at rest; a state of another damper is adopted.
/// - A displacement that is not finite or out of range is held.
/// - A displacement that is too fast is followed at the largest rate if it can be reached within [`CATCH_UP_S`].
/// - A displacement farther away is held while the force falls to zero; then the damper restarts at rest at the
///   displacement.
///
/// The status latches each of these; the last three are counted.
#[inline(never)]
pub(crate) fn travel<T: Real>(
    damper: &Damper<T>,
    state: &mut DamperState<T>,
    displacement: T,
) -> T {
    let known = state.revision == damper.revision;
    if !state.is_marked() || !state.is_finite() || (known && !damper.could_leave(state)) {
        restart(damper, state, displacement, Status::CORRUPTED);
    }
    if state.revision != damper.revision {
        damper.adopt(state);
    }
    if !damper.is_displacement(displacement) {
        return hold(state);
    }
    let travel = displacement - state.displacement;
    let max_move = damper.scalars.max_move();
    if travel.abs() <= max_move {
        return travel;
    }
    let steps = T::from_f64(CATCH_UP_S) / damper.scalars.step_s;
    if travel.abs() <= max_move * steps.max(T::from_f64(2.0)) {
        state.count_rejected_input();
        state.latch(Status::INPUT_LIMITED);
        return travel.max(-max_move).min(max_move);
    }
    let share = (T::from_f64(1.0) / steps).max(T::from_f64(MIN_FALL));
    let fall = damper.force_limit_n() * share.min(T::from_f64(1.0));
    if state.force.abs() <= fall {
        restart(damper, state, displacement, Status::RESTARTED);
        state.count_rejected_input();
        return T::ZERO;
    }
    let force = if state.force < T::ZERO {
        state.force + fall
    } else {
        state.force - fall
    };
    (state.stretch, state.potential) = state_at_force(damper, force);
    hold(state)
}

/// Holds the displacement: counts and latches it and returns a travel of zero (m).
fn hold<T: Real>(state: &mut DamperState<T>) -> T {
    state.count_rejected_input();
    state.latch(Status::INPUT_HELD);
    T::ZERO
}

/// Puts a state at rest at a displacement (m). Status bits and the count remain.
fn restart<T: Real>(
    damper: &Damper<T>,
    state: &mut DamperState<T>,
    displacement: T,
    cause: Status,
) {
    let (status, count) = if state.is_marked() {
        (state.status(), state.rejected_inputs)
    } else {
        (Status::empty(), 0)
    };
    *state = damper.at_rest(displacement);
    // `at_rest` counts a displacement that it rejects, but `hold` counts it too.
    state.rejected_inputs = count;
    state.latch(status | cause);
}
