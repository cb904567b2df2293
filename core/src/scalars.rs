//! The numbers of a damper beside its table.

/// Numbers of a damper beside its table, in SI units; in the order the step reads them.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Scalars<T> {
    /// Largest credible move of the input in a step (m).
    pub(crate) largest_move: T,
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
    largest_move,
    position_rounder,
    rest_rounder,
    step_s,
    offset,
    first_knot,
    half_clearance,
    half_force_limit,
    held,
);
