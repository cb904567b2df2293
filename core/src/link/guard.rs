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
    constants_place: u8,
    state_place: u8,
    constants: u16,
    states: u16,
}

impl Guard {
    pub(crate) const fn new() -> Self {
        Self {
            check: Check::START,
            constants_place: 0,
            state_place: 0,
            constants: 0,
            states: 0,
        }
    }

    /// Checks the next slice of constants and the next state. How many were found damaged that were not known
    /// to be.
    pub(crate) fn check<const N: usize>(&mut self, loaded: &mut Loaded<N>) -> u32 {
        let mut found = 0;
        let place = self.constants_place;
        if !loaded.check_constants(place, &mut self.check) {
            found += u32::from(mark(&mut self.constants, place));
        }
        // A state latches what it met of damaged constants too.
        let place = self.state_place;
        if !loaded.check_state(place) && self.constants & bit(place) == 0 {
            found += u32::from(mark(&mut self.states, place));
        }
        let next = |place: u8| {
            if usize::from(place) + 1 < N {
                place + 1
            } else {
                0
            }
        };
        if self.check.is_at_start() {
            self.constants_place = next(self.constants_place);
        }
        self.state_place = next(self.state_place);
        found
    }

    /// A damper was loaded in a place. If that was damaged, so is what its state came to.
    pub(crate) fn loaded(&mut self, place: u8) {
        self.states |= self.constants & bit(place);
        self.constants &= !bit(place);
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

fn bit(place: u8) -> u16 {
    1 << (place % u16::BITS as u8)
}

/// Whether the place was not marked before.
fn mark(places: &mut u16, place: u8) -> bool {
    let new = *places & bit(place) == 0;
    *places |= bit(place);
    new
}

fn first(places: u16) -> Option<u8> {
    (places != 0).then(|| places.trailing_zeros() as u8)
}
