//! The constants of a damper outside its table.

use crate::bins::DOUBLINGS;
use crate::real::Real;

/// Largest bound on moves and stretches (m), which covers the longest range of displacement.
///
/// Doubling the bits of a number above 1.5 would give NaN.
pub(crate) const MAX_BOUND_M: f64 = 1.45;

/// Constants of a damper outside its table, in SI units and in the order in which the step reads them.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Scalars<T> {
    /// Largest credible move of the input in a step (m), stored with doubled bits (see
    /// [`doubled_bits`](crate::real::Scalar)).
    pub(crate) move_bound: T,
    /// Adding and then subtracting this number (m) rounds a travel to the grid of positions. Sums of such travels are
    /// exact, so a piston at rest in its clearance does not drift.
    pub(crate) position_rounder: T,
    /// Adding and then subtracting this number (m) rounds a stretch far below the grid to zero.
    pub(crate) rest_rounder: T,
    /// Step (s).
    pub(crate) step_s: T,
    /// Largest stretch without flow (m): half the clearance plus the held stretch.
    pub(crate) offset: T,
    /// Start of the first piece of each side (m), a power of two.
    pub(crate) first_knot: T,
    /// Half the clearance, a (m).
    pub(crate) half_clearance: T,
    /// Half the force at which the element yields (N). The step doubles it, because a sum is never a signalling NaN:
    /// compilers then compute the minimum of the sum and the force in one instruction.
    pub(crate) half_force_limit: T,
    /// Stretch of the mount under seal friction (m).
    pub(crate) held: T,
    /// Largest displacement from zero (m), stored with doubled bits.
    pub(crate) displacement_bound: T,
    /// Largest stretch after a step (m) for which the next step stays within the table; stored with doubled bits.
    pub(crate) stretch_bound: T,
}

impl<T: Real> Scalars<T> {
    /// Largest credible move of the input in a step (m).
    pub(crate) fn max_move(&self) -> T {
        self.move_bound.halved_bits()
    }

    /// Largest displacement from zero (m).
    pub(crate) fn max_displacement(&self) -> T {
        self.displacement_bound.halved_bits()
    }

    /// Reach beyond the offset at the end of the bins (m). No stage of an undamaged state exceeds it.
    pub(crate) fn max_reach_beyond_offset(&self) -> T {
        T::from_f64(f64::from(1_u32 << DOUBLINGS)) * self.first_knot
    }

    /// Computes [`Scalars::stretch_bound`] from the other constants.
    ///
    /// From a stretch of `u` beyond the offset, the stages reach at most `sqrt(2) u` plus 1.12 times the largest move.
    /// This reach must lie within the table. The stretch also cannot exceed the length of the range of displacement.
    pub(crate) fn computed_stretch_bound(&self) -> T {
        let max_reach = self.max_reach_beyond_offset() - T::from_f64(1.12) * self.max_move();
        let in_table = self.offset + T::from_f64(0.7) * max_reach;
        let in_range = in_table.max(T::ZERO).min(T::from_f64(MAX_BOUND_M));
        in_range.doubled_bits()
    }
}

/// Generates the conversions between scalars and array from one list of names.
macro_rules! array_of_scalars {
    ($($name:ident),* $(,)?) => {
        /// Number of scalars.
        pub(crate) const SCALARS: usize = [$(stringify!($name)),*].len();

        impl<T: Copy> Scalars<T> {
            /// Returns the scalars in order of declaration.
            pub(crate) const fn as_array(&self) -> [T; SCALARS] {
                [$(self.$name),*]
            }

            /// Inverse of [`Scalars::as_array`].
            pub(crate) const fn from_array([$($name),*]: [T; SCALARS]) -> Self {
                Self { $($name),* }
            }
        }
    };
}

array_of_scalars!(
    move_bound,
    position_rounder,
    rest_rounder,
    step_s,
    offset,
    first_knot,
    half_clearance,
    half_force_limit,
    held,
    displacement_bound,
    stretch_bound,
);
