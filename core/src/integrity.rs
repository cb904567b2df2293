//! A slow check that finds flipped bits in the constants of a damper while the damper runs. Each call checks one slice
//! in constant time.

use crate::damper::Damper;
use crate::real::Real;
use crate::revision;
use crate::state::DamperState;
use crate::table::ROWS;

/// Damaged memory: constants that no build produces, or a state that no step produces.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("constants or a state were damaged in memory")]
#[non_exhaustive]
pub struct Corrupted;

/// Progress of the check of a damper.
///
/// ```
/// # #[cfg(feature = "builder")] {
/// use dashpot_core::integrity::{Check, SLICES};
/// use dashpot_core::parameters::{DamperParameters, Mount};
/// use dashpot_core::Damper;
///
/// let parameters = DamperParameters::reduced(120e3, 0.03, Mount::new(8e6));
/// let damper: Damper<f32> = parameters.build(1e-3)?;
/// let mut check = Check::default();
/// for _tick in 0..3 * SLICES {
///     assert_eq!(check.slice(&damper), Ok(()));
/// }
/// # }
/// # Ok::<(), dashpot_core::BuildError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(C)]
pub struct Check {
    /// Number of rows of the table that `crc` covers. The scalars come after the last row.
    row: u32,
    crc: u32,
    /// Checksum of the table at the start of the round. If it changes, another damper was loaded, and a new round
    /// starts.
    expected: u32,
}

/// Number of calls of [`Check::slice`] that check a whole damper.
pub const SLICES: u32 = ROWS as u32 + 1;

impl Check {
    /// The check before the first slice.
    pub const START: Self = Self {
        row: 0,
        crc: 0,
        expected: 0,
    };

    /// True if the next slice is the first of a round.
    pub fn is_at_start(&self) -> bool {
        self.row == 0
    }

    /// Checks the next slice: one row of the table, or the scalars. After the last slice a new round starts.
    ///
    /// Use one `Check` for each damper. Loading the damper or setting its clearance between two calls is allowed.
    ///
    /// # Errors
    /// The constants have changed since they were built. Every flipped bit is found within the [`SLICES`] calls of the
    /// next round.
    pub fn slice<T: Real>(&mut self, damper: &Damper<T>) -> Result<(), Corrupted> {
        if self.row == 0 || self.expected != damper.table_check {
            *self = Self {
                expected: damper.table_check,
                ..Self::START
            };
        }
        if (self.row as usize) < ROWS {
            self.crc = T::check_row(&damper.table, self.row as usize, self.crc);
            self.row += 1;
            return Ok(());
        }
        let crc = self.crc;
        *self = Self::START;
        let revision = revision::of_damper(damper.table_revision, &damper.scalars);
        if crc == damper.table_check && revision == damper.revision {
            Ok(())
        } else {
            Err(Corrupted)
        }
    }

    /// Checks that a state could result from steps of the damper.
    ///
    /// # Errors
    /// A number is not finite or is out of range, or the memory was never initialised.
    pub fn state<T: Real>(damper: &Damper<T>, state: &DamperState<T>) -> Result<(), Corrupted> {
        let is_from_other = state.revision != damper.revision;
        if state.is_marked() && (is_from_other || damper.could_leave(state)) {
            Ok(())
        } else {
            Err(Corrupted)
        }
    }
}

#[cfg(test)]
#[cfg(feature = "builder")]
mod tests {
    use super::{Check, Corrupted, SLICES};
    use crate::damper::Damper;
    use crate::status::Status;
    use crate::table::FLOW;

    fn damper() -> Damper<f32> {
        crate::example::reduced_vertical()
            .build(1e-3)
            .expect("a valid damper")
    }

    #[test]
    fn a_round_starts_before_its_first_slice_and_after_its_last() {
        let damper = damper();
        let mut check = Check::START;
        for call in 0..=2 * SLICES {
            assert_eq!(check.is_at_start(), call % SLICES == 0, "call {call}");
            assert_eq!(check.slice(&damper), Ok(()));
        }
    }

    #[test]
    fn a_damper_loaded_within_a_round_starts_a_new_round() {
        let first = damper();
        let second: Damper<f32> = crate::example::reduced_vertical()
            .build(0.5e-3)
            .expect("a valid damper");
        let mut check = Check::START;
        for _ in 0..SLICES / 2 {
            assert_eq!(check.slice(&first), Ok(()));
        }
        for _ in 0..SLICES {
            assert_eq!(check.slice(&second), Ok(()));
        }
        assert!(check.is_at_start());
    }

    #[test]
    fn a_round_finds_a_change_of_the_table_or_of_the_scalars() {
        let mut table = damper();
        let slope = &mut table.table.pieces[9][FLOW][1];
        *slope = f32::from_bits(slope.to_bits() ^ 1);
        let mut scalars = damper();
        let offset = &mut scalars.scalars.offset;
        *offset = f32::from_bits(offset.to_bits() ^ 1);
        for (damper, what) in [(table, "table"), (scalars, "scalars")] {
            let mut check = Check::START;
            for _ in 1..SLICES {
                assert_eq!(check.slice(&damper), Ok(()));
            }
            assert_eq!(check.slice(&damper), Err(Corrupted), "{what}");
        }
    }

    #[test]
    fn a_damper_checks_the_numbers_of_its_own_states_only() {
        let damper = damper();
        let mut own = damper.at_rest(0.0);
        damper.step(&mut own, 1e-3);
        let mut own_too_long = own;
        own_too_long.stretch = 1.0;
        // The step adopts this state, whatever its stretch.
        let mut from_other = own_too_long;
        from_other.revision = damper.revision().wrapping_add(1);
        let states = [
            (own, Ok(())),
            (own_too_long, Err(Corrupted)),
            (from_other, Ok(())),
        ];
        for (mut state, expected) in states {
            assert_eq!(Check::state(&damper, &state), expected, "{state:?}");
            // With every bit set, the status word has no mark.
            state.latch(Status::from_bits_retain(u16::MAX));
            assert_eq!(Check::state(&damper, &state), Err(Corrupted), "no mark");
        }
    }
}
