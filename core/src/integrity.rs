//! A slow check of a damper in memory: a slice at every call, in constant time, so that a bit flipped in
//! constants is found while they are in use.

use crate::damper::Damper;
use crate::encoding::revision;
use crate::math::Real;
use crate::state::DamperState;
use crate::table::ROWS;

/// Constants or a state that no build and no step leaves behind: memory was damaged.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("constants or a state were damaged in memory")]
pub struct Corrupted;

/// How far the check of a damper has come.
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
    /// Rows of the table that `crc` covers; the scalars come after the last.
    row: u32,
    crc: u32,
    /// Checksum the round began with: a damper that was loaded meanwhile begins a new round.
    expected: u32,
}

/// Calls of [`Check::slice`] that check a damper whole.
pub const SLICES: u32 = ROWS as u32 + 1;

impl Check {
    /// Before the first slice.
    pub const START: Self = Self {
        row: 0,
        crc: 0,
        expected: 0,
    };

    /// Whether the next slice is the first of a round.
    pub fn is_at_start(&self) -> bool {
        self.row == 0
    }

    /// Checks the next slice, four numbers of the table or the scalars; after the last begins again.
    ///
    /// Call it from one place at a time, with the same damper every time. One that is loaded or whose clearance
    /// is set between calls is no error.
    ///
    /// # Errors
    /// The constants are not those that were built. Every flipped bit is found within [`SLICES`] calls of the
    /// round that begins after it.
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

    /// Whether a state is one that steps of the damper could leave behind.
    ///
    /// # Errors
    /// It is not: a number is not finite or out of range, or the state was never made.
    pub fn state<T: Real>(damper: &Damper<T>, state: &DamperState<T>) -> Result<(), Corrupted> {
        let other = state.revision != damper.revision;
        if state.is_marked() && (other || damper.could_leave(state)) {
            Ok(())
        } else {
            Err(Corrupted)
        }
    }
}
