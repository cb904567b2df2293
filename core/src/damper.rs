//! The damper: constants for one step size, shared by any number of states.

use crate::parameters::{MAX_CLEARANCE_M, MAX_FORCE_N, Mount};
use crate::real::Real;
use crate::revision;
use crate::scalars::Scalars;
use crate::state::DamperState;
use crate::status::Status;
use crate::table::Table;
#[cfg(feature = "builder")]
use crate::table_check;

/// A built damper: constants for one step size, shared by any number of states.
///
/// ```
/// # #[cfg(feature = "builder")] {
/// use dashpot_core::parameters::{DamperParameters, Mount};
/// use dashpot_core::Damper;
///
/// let parameters = DamperParameters::reduced(120e3, 0.03, Mount::new(8e6));
/// let damper: Damper<f32> = parameters.build(1e-3)?;
/// let mut state = damper.at_rest(0.0);
/// let mut force = 0.0;
/// for tick in 1..=1000 {
///     force = damper.step(&mut state, 0.02e-3 * tick as f32); // 0.02 m/s
/// }
/// assert!((force - 2400.0).abs() < 0.1); // C v
/// # }
/// # Ok::<(), dashpot_core::BuildError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Damper<T> {
    pub(crate) scalars: Scalars<T>,
    pub(crate) revision: u32,
    pub(crate) table_revision: u32,
    /// CRC-32 of the table in memory.
    pub(crate) table_check: u32,
    /// Puts the `f32` table at an offset of 64 bytes, so that one instruction can address each part of it.
    pub(crate) padding: [u32; 2],
    /// Results of an implicit stage as functions of its reach beyond the offset.
    pub(crate) table: Table<T>,
}

impl<T: Real> Damper<T> {
    #[cfg(feature = "builder")]
    pub(crate) fn new(scalars: Scalars<T>, table: Table<T>) -> Self {
        let table_revision = revision::of_table(&table);
        Self {
            scalars,
            revision: revision::of_damper(table_revision, &scalars),
            table_revision,
            table_check: table_check::of(&table),
            padding: [0; 2],
            table,
        }
    }

    /// Returns a state at rest at `displacement` (m), centred in the clearance, without force.
    ///
    /// A displacement that is not finite, or larger than [`Damper::largest_displacement_m`], is rejected, counted and
    /// latched as [`Status::INPUT_HELD`]. The state then starts at an end of the range. The first good displacement is
    /// usually too far from that end to catch up with, so the damper restarts at this displacement without force.
    pub fn at_rest(&self, displacement: T) -> DamperState<T> {
        if self.is_displacement(displacement) {
            let numbers = [displacement, T::ZERO, T::ZERO, T::ZERO];
            return DamperState::new(numbers, self.revision, Status::empty(), 0);
        }
        let end = self.largest_displacement_m();
        let end = if displacement < T::ZERO { -end } else { end };
        let numbers = [end, T::ZERO, T::ZERO, T::ZERO];
        DamperState::new(numbers, self.revision, Status::INPUT_HELD, 1)
    }

    /// Largest displacement from zero that a step follows (m). In place of a larger one, or of one that is not finite,
    /// the step holds the last displacement.
    pub fn largest_displacement_m(&self) -> T {
        self.scalars.max_displacement()
    }

    /// True if a displacement (m) is finite and within the range.
    pub(crate) fn is_displacement(&self, displacement: T) -> bool {
        displacement.all_within([&self.scalars.displacement_bound])
    }

    /// Step size (s).
    pub fn step_s(&self) -> T {
        self.scalars.step_s
    }

    /// Identifier of these constants, never 0. Dampers with different constants have different revisions.
    pub fn revision(&self) -> u32 {
        self.revision
    }

    /// Clearance 2a: the total play (m).
    pub fn clearance_m(&self) -> T {
        self.scalars.half_clearance + self.scalars.half_clearance
    }

    /// Force at which the element yields (N). No step returns more. The limit is at most [`MAX_FORCE_N`], even with
    /// damaged constants.
    pub fn force_limit_n(&self) -> T {
        let limit = self.scalars.half_force_limit + self.scalars.half_force_limit;
        let max = T::from_f64(MAX_FORCE_N);
        if limit <= max {
            limit.max(T::ZERO)
        } else {
            max
        }
    }

    /// Bins of the reach: for each bin, twice the index of the piece at its lower border, in extension and in
    /// compression. The pieces of compression follow those of extension. At most one knot lies within a bin.
    ///
    /// A step in another language needs these bins and [`Damper::to_words`].
    pub fn bins(&self) -> &[[u8; 2]] {
        &self.table.bins
    }

    /// Sets the clearance 2a (m) while the damper runs. This takes a few dozen operations and does not change the
    /// table.
    ///
    /// # Errors
    /// A clearance outside 0 to [`MAX_CLEARANCE_M`]; the damper is unchanged.
    pub fn set_clearance_m(&mut self, clearance_m: T) -> Result<(), ClearanceError> {
        if !(T::ZERO..=T::from_f64(MAX_CLEARANCE_M)).contains(&clearance_m) {
            return Err(ClearanceError);
        }
        let half = T::from_f64(0.5) * clearance_m;
        let k = &mut self.scalars;
        k.half_clearance = half;
        k.offset = half + k.held;
        k.stretch_bound = k.computed_stretch_bound();
        self.revision = revision::of_damper(self.table_revision, k);
        Ok(())
    }

    /// Reach (m) at the end of the bins. No stage exceeds it.
    pub(crate) fn max_reach(&self) -> T {
        self.scalars.max_reach_beyond_offset() + self.scalars.offset
    }

    /// True if every scalar and every number of the table is finite.
    #[cfg(feature = "builder")]
    pub(crate) fn is_finite(&self) -> bool {
        let numbers = self.table.built_numbers();
        let scalars = self.scalars.as_array();
        scalars
            .iter()
            .chain(numbers)
            .all(|number| number.is_finite())
    }

    /// True if the numbers of a state could result from a step of this damper.
    pub(crate) fn could_leave(&self, state: &DamperState<T>) -> bool {
        let k = &self.scalars;
        // Rounding to the grid of positions can move a displacement out of the range, by less than a thousandth of the
        // range.
        let max = T::from_f64(1.001) * k.max_displacement();
        state.displacement.abs() <= max
            && state.potential.is_finite()
            && state.stretch.all_within([&k.stretch_bound])
            && state.force.abs() <= self.force_limit_n()
    }
}

/// A clearance outside 0 to 0.1 m.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("mount.clearance_m must be {}", Mount::RANGES.clearance_m.allowed)]
#[non_exhaustive]
pub struct ClearanceError;

#[cfg(test)]
#[cfg(feature = "builder")]
mod tests {
    use super::Damper;
    use crate::scalars::SCALARS;

    /// Tests the check with which `build` ends.
    #[test]
    fn finds_a_non_finite_number_in_any_word() {
        let built: Damper<f64> = crate::example::reduced_vertical().build(1e-3).unwrap();
        assert!(built.is_finite());
        let words = built.to_words();
        // The two words after the scalars are the revisions.
        for word in (0..words.len()).filter(|word| !(SCALARS..SCALARS + 2).contains(word)) {
            for number in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                let mut damaged = words;
                damaged[word] = number.to_bits();
                assert!(
                    !Damper::<f64>::from_words(&damaged).is_finite(),
                    "word {word}"
                );
            }
        }
    }
}
