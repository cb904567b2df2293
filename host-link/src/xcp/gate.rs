//! In virtual time, lets the model step only while a master measures, and only as fast as it reads.

use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// Time between checks whether a waiting model should end.
const CHECK: Duration = Duration::from_millis(20);
/// Largest number of ticks that the model may be ahead of the measurement.
const AHEAD: u64 = 64;

/// Gate before each tick of the model. It is closed until a master starts to measure.
#[derive(Debug, Default)]
pub struct Gate {
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Debug, Default)]
struct State {
    is_open: bool,
    is_waiting: bool,
    /// Ticks of the model.
    passed: u64,
    /// Ticks that the server has taken.
    taken: u64,
}

impl State {
    fn lets_pass(&self) -> bool {
        self.is_open && self.passed - self.taken < AHEAD
    }
}

impl Gate {
    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits until the gate is open, or until `is_unwanted` returns true.
    pub fn pass(&self, is_unwanted: impl Fn() -> bool) {
        let mut state = self.state();
        state.is_waiting = true;
        while !state.lets_pass() && !is_unwanted() {
            let waited = self.changed.wait_timeout(state, CHECK);
            state = waited.unwrap_or_else(PoisonError::into_inner).0;
        }
        state.is_waiting = false;
        state.passed += 1;
    }

    pub(super) fn set_open(&self, is_open: bool) {
        self.state().is_open = is_open;
        self.changed.notify_all();
    }

    /// Counts a tick that the server has taken.
    pub(super) fn take(&self) {
        let mut state = self.state();
        state.taken += 1;
        // The model makes several ticks each time it is woken.
        let is_due = state.is_waiting && state.passed - state.taken <= AHEAD / 2;
        drop(state);
        if is_due {
            self.changed.notify_all();
        }
    }

    /// True if the model waits at the closed gate and the server has taken all of its ticks.
    pub(super) fn is_settled(&self) -> bool {
        let state = self.state();
        !state.is_open && state.is_waiting && state.passed == state.taken
    }
}

#[cfg(test)]
mod tests {
    use super::{AHEAD, Gate};

    #[test]
    fn the_model_is_at_most_so_far_ahead() {
        let gate = Gate::default();
        gate.set_open(true);
        for _ in 0..AHEAD {
            gate.pass(|| panic!("no reason to wait"));
        }
        assert!(!gate.state().lets_pass());
        gate.take();
        assert!(gate.state().lets_pass());
        assert!(!gate.is_settled(), "the gate is open");
    }

    #[test]
    fn an_unwanted_model_passes_a_closed_gate() {
        let gate = Gate::default();
        gate.pass(|| true);
        assert_eq!(gate.state().passed, 1);
    }
}
