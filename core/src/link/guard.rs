//! Looks for damage in memory, a slice a tick: the constants of one damper after the other, and one state.

use super::loaded::Loaded;
use super::message::MOST_DAMPERS;
use crate::integrity::Check;

/// A bit for each damper has room for all of them.
const _: () = assert!(MOST_DAMPERS <= u16::BITS as usize);

/// Where the check stands, and the dampers found damaged: a bit for each.
#[derive(Clone, Debug)]
pub(crate) struct Guard {
    check: Check,
    next_constants: u8,
    next_state: u8,
    constants: u16,
    states: u16,
}

impl Guard {
    pub(crate) const fn new() -> Self {
        Self {
            check: Check::START,
            next_constants: 0,
            next_state: 0,
            constants: 0,
            states: 0,
        }
    }

    /// Checks the next slice of constants and the next state. How many were found damaged that were not known
    /// to be.
    pub(crate) fn check<const N: usize>(&mut self, loaded: &mut Loaded<N>) -> u32 {
        let mut found = 0;
        let damper = self.next_constants;
        if !loaded.check_constants(damper, &mut self.check) {
            found += u32::from(mark(&mut self.constants, damper));
        }
        // A state latches what it met of damaged constants too.
        let damper = self.next_state;
        if !loaded.check_state(damper) && self.constants & bit(damper) == 0 {
            found += u32::from(mark(&mut self.states, damper));
        }
        let next = |damper: u8| {
            if usize::from(damper) + 1 < N {
                damper + 1
            } else {
                0
            }
        };
        if self.check.is_at_start() {
            self.next_constants = next(self.next_constants);
        }
        self.next_state = next(self.next_state);
        found
    }

    /// A damper was loaded. If the old one was damaged, so is what its state came to.
    pub(crate) fn loaded(&mut self, damper: u8) {
        self.states |= self.constants & bit(damper);
        self.constants &= !bit(damper);
    }

    /// Every state was made anew.
    pub(crate) fn new_states(&mut self) {
        self.states = 0;
    }

    /// The first damper whose constants are damaged.
    pub(crate) fn damaged_constants(&self) -> Option<u8> {
        first(self.constants)
    }

    /// The first damper whose constants or state are damaged.
    pub(crate) fn damaged(&self) -> Option<u8> {
        first(self.constants | self.states)
    }
}

fn bit(damper: u8) -> u16 {
    1 << (damper % u16::BITS as u8)
}

/// Whether the damper was not marked before.
fn mark(dampers: &mut u16, damper: u8) -> bool {
    let new = *dampers & bit(damper) == 0;
    *dampers |= bit(damper);
    new
}

fn first(dampers: u16) -> Option<u8> {
    (dampers != 0).then(|| dampers.trailing_zeros() as u8)
}
