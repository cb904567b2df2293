//! Handles an unusual state or displacement before a step.

use crate::damper::Damper;
use crate::real::Real;
use crate::stages::state_at_force;
use crate::state::DamperState;
use crate::status::Status;

/// Longest time that the damper may take, at the largest rate, to catch up with its input (s). If the input is farther
/// away, the force falls from its limit to zero in the same time.
const CATCH_UP_S: f64 = 0.01;

/// Smallest decrease of the force in a step, as a fraction of the force limit (1). It is the decrease in a step of the
/// shortest allowed length.
const MIN_FALL: f64 = 1e-4;

/// Makes the state valid for the damper and returns the travel (m) of this step towards the displacement (m).
///
/// - An impossible state restarts at rest; a state of another damper is adopted.
/// - In place of a displacement that is not finite or out of range, the last one is held.
/// - A displacement that is too fast is followed at the largest rate if it can be reached within [`CATCH_UP_S`].
/// - For a displacement farther away, the last one is held while the force falls to zero; then the damper restarts at
///   rest at the new displacement.
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
    // `at_rest` counts a displacement that it rejects, which `hold` counts too. The old count is therefore restored.
    state.rejected_inputs = count;
    state.latch(status | cause);
}

#[cfg(test)]
#[cfg(feature = "builder")]
mod tests {
    use super::travel;
    use crate::damper::Damper;
    use crate::state::DamperState;
    use crate::status::Status;

    const STEP_S: f64 = 1e-3;

    /// A damper of 120 kN s/m and 8 MN/m that yields at 3600 N and follows 2 m/s, so 2 mm in a tick.
    fn damper() -> Damper<f64> {
        crate::example::reduced_vertical()
            .build(STEP_S)
            .expect("a valid damper")
    }

    /// A state of the damper that extended at 0.025 m/s for a second, or compressed if `sign` is negative; 3000 N.
    fn moving(damper: &Damper<f64>, sign: f64) -> DamperState<f64> {
        let mut state = damper.at_rest(0.0);
        for tick in 1..=1000 {
            damper.step(&mut state, sign * 25e-6 * f64::from(tick));
        }
        assert!((state.force_n() - sign * 3000.0).abs() < 0.01);
        state
    }

    #[test]
    fn a_force_falls_by_a_tenth_of_its_limit_per_millisecond_before_a_restart() {
        let damper = damper();
        // With the ends held, the force relaxes with the time constant C/k of 15 ms.
        let relaxation = libm::exp(-STEP_S * 8e6 / 120e3);
        for sign in [1.0, -1.0] {
            let mut state = moving(&damper, sign);
            let held_m = state.displacement_m();
            let mut expected = 3000.0;
            let mut count = 0;
            while expected > 360.0 {
                expected = relaxation * (expected - 360.0);
                count += 1;
                let force = damper.step(&mut state, sign * 0.4);
                assert!((sign * force - expected).abs() < 0.5, "{force} N");
                assert_eq!(state.displacement_m(), held_m);
                assert_eq!(state.status(), Status::INPUT_HELD);
                assert_eq!(state.rejected_inputs(), count);
            }
            assert_eq!(damper.step(&mut state, sign * 0.4), 0.0);
            assert_eq!(state.displacement_m(), sign * 0.4);
            assert_eq!(state.status(), Status::INPUT_HELD | Status::RESTARTED);
            assert_eq!(state.rejected_inputs(), count + 1);
        }
    }

    /// The damper follows 2 mm in a tick and catches up with at most ten times as much.
    #[test]
    fn a_displacement_that_is_too_fast_is_followed_at_the_largest_rate() {
        let damper = damper();
        for (displacement, travel_m) in [(3e-3, 2e-3), (19e-3, 2e-3), (1.5e-3, 1.5e-3)] {
            for sign in [1.0, -1.0] {
                let mut state = damper.at_rest(0.0);
                let found = travel(&damper, &mut state, sign * displacement);
                assert!((found - sign * travel_m).abs() < 1e-15, "{found} m");
                let limited = travel_m < displacement;
                assert_eq!(state.status().contains(Status::INPUT_LIMITED), limited);
                assert_eq!(state.rejected_inputs(), u16::from(limited));
            }
        }
        let mut state = damper.at_rest(0.0);
        assert_eq!(travel(&damper, &mut state, 21e-3), 0.0);
        assert_eq!(state.status(), Status::RESTARTED);
    }

    #[test]
    fn a_second_restart_leaves_the_status_latched() {
        let damper = damper();
        let mut state = damper.at_rest(0.0);
        for displacement in [0.4, -0.4, 0.4] {
            assert_eq!(travel(&damper, &mut state, displacement), 0.0);
            assert_eq!(state.displacement_m(), displacement);
            assert_eq!(state.status(), Status::RESTARTED);
        }
        assert_eq!(state.rejected_inputs(), 3);
    }

    /// Steps a state to a displacement of 1 mm beyond its own; returns the status and the force (N).
    fn stepped(damper: &Damper<f64>, mut state: DamperState<f64>) -> (Status, f64) {
        let force = damper.step(&mut state, 0.026);
        assert_eq!(state.displacement_m(), 0.026);
        assert_eq!(state.revision(), damper.revision());
        (state.status(), force)
    }

    #[test]
    fn an_impossible_state_restarts_at_rest_even_if_it_is_of_another_damper() {
        let damper = damper();
        let sound = moving(&damper, 1.0);
        for number in 0..4 {
            for value in [f64::NAN, f64::INFINITY] {
                let mut numbers = sound.numbers();
                numbers[number] = value;
                let state = DamperState::new(numbers, 1, Status::empty(), 0);
                assert_eq!(stepped(&damper, state), (Status::CORRUPTED, 0.0));
            }
        }
        let mut without_mark = sound;
        without_mark.revision = 1;
        without_mark.latch(Status::from_bits_retain(u16::MAX));
        assert_eq!(stepped(&damper, without_mark), (Status::CORRUPTED, 0.0));
    }

    #[test]
    fn numbers_beyond_the_range_are_impossible_for_the_damper_but_not_for_another() {
        let damper = damper();
        let sound = moving(&damper, 1.0);
        let mut too_long = sound;
        too_long.stretch = 1.0;
        assert_eq!(stepped(&damper, too_long), (Status::CORRUPTED, 0.0));

        let (mut from_other, mut long_from_other) = (sound, too_long);
        from_other.revision = 1;
        long_from_other.revision = 1;
        let adopted = stepped(&damper, from_other);
        assert!(adopted.0.contains(Status::DAMPER_SWAPPED) && adopted.1 >= 3000.0);
        assert_eq!(stepped(&damper, long_from_other), adopted);
    }
}
