//! The numbers of a damper beside its table.

use crate::math::Real;
use crate::table::DOUBLINGS;

/// The largest bound (m): no damper's input moves and no damper is stretched farther than from one end of the largest
/// range of displacement to the other. Twice the bits of a number beyond 1.5 would be those of NaN.
pub(crate) const LARGEST_BOUND_M: f64 = 1.45;

/// Numbers of a damper beside its table, in SI units; in the order the step reads them.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Scalars<T> {
    /// Largest credible move of the input in a step (m), by its doubled bits.
    pub(crate) move_bound: T,
    /// Adding and subtracting it rounds a travel to the grid of positions: sums of such travels are
    /// exact, so a piston at rest in its clearance does not drift (m).
    pub(crate) position_rounder: T,
    /// Adding and subtracting it rounds a stretch far below that grid to zero (m).
    pub(crate) rest_rounder: T,
    /// Step (s).
    pub(crate) step_s: T,
    /// Stretch up to which nothing flows (m): half the clearance and the stretch held.
    pub(crate) offset: T,
    /// Where the first piece of either side begins, a power of two (m).
    pub(crate) first_knot: T,
    /// Half the clearance, a (m).
    pub(crate) half_clearance: T,
    /// Half the force at which the element yields (N). A sum is not a signalling NaN, so compilers take the
    /// lesser of it and the force in one instruction.
    pub(crate) half_force_limit: T,
    /// Stretch of the mount under seal friction (m).
    pub(crate) held: T,
    /// Largest displacement from zero (m), by its doubled bits.
    pub(crate) displacement_bound: T,
    /// Largest stretch (m) that a step leaves behind, and that a step looks up within the table, by its doubled bits.
    pub(crate) stretch_bound: T,
}

impl<T: Real> Scalars<T> {
    /// Largest credible move of the input in a step (m).
    pub(crate) fn largest_move(&self) -> T {
        self.move_bound.halved_bits()
    }

    /// Largest displacement from zero (m).
    pub(crate) fn largest_displacement(&self) -> T {
        self.displacement_bound.halved_bits()
    }

    /// Reach beyond the offset at the end of the bins (m); no stage of a sound state looks beyond it.
    pub(crate) fn largest_reach_beyond_offset(&self) -> T {
        T::from_f64(f64::from(1_u32 << DOUBLINGS)) * self.first_knot
    }

    /// What [`Scalars::stretch_bound`] is by the other numbers. From a stretch `u` beyond the offset the stages look at
    /// most `sqrt(2) u` and 1.12 moves far, which must be in the table; nor can a damper be stretched farther than
    /// from one end of its range to the other.
    pub(crate) fn stretch_bound_by_others(&self) -> T {
        let most = self.largest_reach_beyond_offset() - T::from_f64(1.12) * self.largest_move();
        let in_table = self.offset + T::from_f64(0.7) * most;
        let in_range = in_table.max(T::ZERO).min(T::from_f64(LARGEST_BOUND_M));
        in_range.doubled_bits()
    }
}

/// The scalars as an array and back, from one list of their names.
macro_rules! array_of_scalars {
    ($($name:ident),* $(,)?) => {
        /// How many scalars there are.
        pub(crate) const SCALARS: usize = [$(stringify!($name)),*].len();

        impl<T: Copy> Scalars<T> {
            /// The numbers in order of declaration.
            pub(crate) const fn as_array(&self) -> [T; SCALARS] {
                [$(self.$name),*]
            }

            /// The inverse of [`Scalars::as_array`].
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
