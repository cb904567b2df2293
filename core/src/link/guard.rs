//! Checks memory for damage, damper by damper: at each tick one slice of constants and one state.

use super::limits::MAX_DAMPERS;
use super::loaded::Loaded;
use crate::integrity::Check;

// There is one bit for each damper.
const _: () = assert!(MAX_DAMPERS <= u16::BITS as usize);

/// Progress of the check, damaged dampers (one bit each), and forces from before any damage.
#[derive(Clone, Debug)]
pub(crate) struct Guard<const N: usize> {
    check: Check,
    next_constants: u8,
    next_state: u8,
    constants: u16,
    states: u16,
    /// Force (N) of the damper whose constants are being checked, at the start of its round.
    at_start_n: f32,
    /// Force (N) of each damper at the start of the last round that found its constants sound.
    of_sound_constants_n: [f32; N],
    /// Force (N) of each damper when a check last found its state sound.
    of_sound_states_n: [f32; N],
}

impl<const N: usize> Guard<N> {
    pub(crate) const fn new() -> Self {
        Self {
            check: Check::START,
            next_constants: 0,
            next_state: 0,
            constants: 0,
            states: 0,
            at_start_n: 0.0,
            of_sound_constants_n: [0.0; N],
            of_sound_states_n: [0.0; N],
        }
    }

    /// Checks the next slice of constants and the next state. Returns the number of dampers and states that it newly
    /// found damaged.
    pub(crate) fn check(&mut self, loaded: &mut Loaded<N>) -> u32 {
        let mut found = 0;
        let damper = self.next_constants;
        if self.check.is_at_start() {
            self.at_start_n = force_of(loaded, damper);
        }
        if !loaded.check_constants(damper, &mut self.check) {
            found += u32::from(mark(&mut self.constants, damper));
        } else if self.check.is_at_start() {
            keep(&mut self.of_sound_constants_n, damper, self.at_start_n);
        }
        // Damage to the constants of a damper is also latched in its state, so it is not counted again here.
        let damper = self.next_state;
        if !loaded.check_state(damper) {
            if self.constants & bit(damper) == 0 {
                found += u32::from(mark(&mut self.states, damper));
            }
        } else if self.states & bit(damper) == 0 {
            keep(
                &mut self.of_sound_states_n,
                damper,
                force_of(loaded, damper),
            );
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

    /// Replaces the force (N) of each damaged damper with its last force from before the damage.
    ///
    /// A bit may have flipped at any time since the start of the previous round, so the present force can be wrong.
    pub(crate) fn replace_damaged(&self, forces_n: &mut [f32; N]) {
        let sound = self
            .of_sound_constants_n
            .iter()
            .zip(&self.of_sound_states_n);
        for (damper, (force, (of_constants, of_state))) in (0..).zip(forces_n.iter_mut().zip(sound))
        {
            if self.constants & bit(damper) != 0 {
                *force = *of_constants;
            } else if self.states & bit(damper) != 0 {
                *force = *of_state;
            }
        }
    }

    /// Records a newly loaded damper. If the constants of the old damper were damaged, the state counts as damaged too.
    pub(crate) fn loaded(&mut self, damper: u8) {
        if damper == self.next_constants {
            self.check = Check::START;
        }
        self.states |= self.constants & bit(damper);
        self.constants &= !bit(damper);
    }

    /// Records that all states were reset.
    pub(crate) fn new_states(&mut self) {
        self.states = 0;
        self.at_start_n = 0.0;
        self.of_sound_constants_n = [0.0; N];
        self.of_sound_states_n = [0.0; N];
    }

    /// Index of the first damper with damaged constants.
    pub(crate) fn damaged_constants(&self) -> Option<u8> {
        first(self.constants)
    }

    /// Index of the first damper with damaged constants or a damaged state.
    pub(crate) fn damaged(&self) -> Option<u8> {
        first(self.constants | self.states)
    }
}

/// Force (N) of a damper in the last tick.
fn force_of<const N: usize>(loaded: &Loaded<N>, damper: u8) -> f32 {
    let force = loaded.forces_n().get(usize::from(damper));
    force.copied().unwrap_or_default()
}

fn keep(forces_n: &mut [f32], damper: u8, force_n: f32) {
    if let Some(kept) = forces_n.get_mut(usize::from(damper)) {
        *kept = force_n;
    }
}

fn bit(damper: u8) -> u16 {
    1 << (damper % u16::BITS as u8)
}

/// Marks a damper. Returns true if it was not marked before.
fn mark(dampers: &mut u16, damper: u8) -> bool {
    let new = *dampers & bit(damper) == 0;
    *dampers |= bit(damper);
    new
}

fn first(dampers: u16) -> Option<u8> {
    (dampers != 0).then(|| dampers.trailing_zeros() as u8)
}
