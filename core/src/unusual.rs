//! What comes before a step when a state or a displacement is not usual.

use crate::damper::Damper;
use crate::math::Real;
use crate::state::DamperState;
use crate::status::Status;
use crate::step::state_at_force;

/// How far the damper may be behind its input: as far as it follows at its largest rate in this time (s). The force
/// falls from its limit to zero in this time too, when the input is farther away.
const CATCH_UP_S: f64 = 0.01;

/// The least share of the force limit that the force falls by in a step: that of the shortest step.
const LEAST_FALL: f64 = 1e-4;

/// The travel (m) to a displacement (m), after the state was made one that the damper can step.
///
/// - A state that no step leaves behind starts over at rest; one that another damper stepped is adopted.
/// - A displacement that is not finite or beyond the range is held.
/// - One that is too fast is followed at the largest rate, while it is no farther away than [`CATCH_UP_S`] at that rate.
/// - One that is farther away is held while the force falls to zero; then the damper restarts at rest there.
///
/// Each is latched, the last three are counted.
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
    let most = damper.scalars.largest_move();
    if travel.abs() <= most {
        return travel;
    }
    let steps = T::from_f64(CATCH_UP_S) / damper.scalars.step_s;
    if travel.abs() <= most * steps.max(T::from_f64(2.0)) {
        state.count_rejected_input();
        state.latch(Status::INPUT_LIMITED);
        return travel.max(-most).min(most);
    }
    let share = (T::from_f64(1.0) / steps).max(T::from_f64(LEAST_FALL));
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

/// The travel (m) of a step whose displacement is held.
fn hold<T: Real>(state: &mut DamperState<T>) -> T {
    state.count_rejected_input();
    state.latch(Status::INPUT_HELD);
    T::ZERO
}

/// Puts a state at rest at a displacement (m); what it had latched and counted stays.
fn restart<T: Real>(
    damper: &Damper<T>,
    state: &mut DamperState<T>,
    displacement: T,
    because: Status,
) {
    let (status, count) = if state.is_marked() {
        (state.status(), state.rejected_inputs)
    } else {
        (Status::empty(), 0)
    };
    *state = damper.at_rest(displacement);
    // A displacement that is held is counted where it is held.
    state.rejected_inputs = count;
    state.latch(status | because);
}
