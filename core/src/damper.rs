//! The damper: constants for one step size, and the step.
//!
//! With the stretch `u = x - x_r` of clearance and springs, the chain
//! `x = g + delta(F) + x_r`, `dx_r/dt = v_h(F)` is one equation, `du/dt = dx/dt - f(u)`, with
//! `f = v_h(F(u))` zero in the clearance and rising beyond. A step takes two implicit stages
//! (Alexander's SDIRK2, gamma = 1 - 1/sqrt 2: second order, L-stable, last stage at the tick) and then
//! corrects the flow by the difference between its exact mean along the step's straight path and the
//! stages' quadrature of that path. The correction vanishes for linear f, so stability and order are
//! those of the stages; where f has a root (orifice) or a corner (clearance edge) inside the step it
//! takes away their leading error. See docs/numerics.md.

use crate::math::Real;
use crate::parameters::{LARGEST_CLEARANCE_M, LARGEST_FORCE_N};
use crate::revision;
use crate::state::DamperState;
use crate::status::Status;
use crate::step;
use crate::table::{DOUBLINGS, Table};

/// gamma of the two stages.
pub(crate) const IMPLICIT_SHARE: f64 = 1.0 - core::f64::consts::FRAC_1_SQRT_2;

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

/// A built damper: constants for one step size, shared by any number of states.
///
/// ```
/// # #[cfg(feature = "builder")] {
/// use dashpot_core::parameters::{DamperParameters, Element, Limits, Mount, Reduced};
/// use dashpot_core::Damper;
///
/// let parameters = DamperParameters {
///     element: Element::Reduced(Reduced {
///         damping_n_s_per_m: 120e3,
///         saturation_velocity_m_per_s: 0.03,
///     }),
///     mount: Mount { stiffness_n_per_m: 8e6, seat_stiffness_n_per_m: None, clearance_m: 0.0 },
///     limits: Limits::default(),
/// };
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
    /// CRC-32 of the table as it lies in memory.
    pub(crate) table_check: u32,
    /// In `f32` the table lies 64 bytes on, where each part of it is reached by one instruction.
    pub(crate) padding: [u32; 4],
    /// What an implicit stage finds, over its reach beyond the offset.
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
            table_check: T::table_check(&table),
            padding: [0; 4],
            table,
        }
    }

    /// A state at rest at `displacement` (m), centred in the clearance, no force. A displacement that is
    /// not finite counts as 0.
    pub fn at_rest(&self, displacement: T) -> DamperState<T> {
        let displacement = if displacement.is_finite() {
            displacement
        } else {
            T::ZERO
        };
        let numbers = [displacement, T::ZERO, T::ZERO, T::ZERO];
        DamperState::new(numbers, self.revision, Status::empty(), 0)
    }

    /// Step size (s).
    pub fn step_s(&self) -> T {
        self.scalars.step_s
    }

    /// Number that tells built dampers apart, never 0.
    pub fn revision(&self) -> u32 {
        self.revision
    }

    /// Clearance 2a, the whole play (m).
    pub fn clearance_m(&self) -> T {
        self.scalars.half_clearance + self.scalars.half_clearance
    }

    /// Force at which the element yields (N); no step returns more. At most
    /// [`LARGEST_FORCE_N`], of damaged constants too.
    pub fn force_limit_n(&self) -> T {
        let limit = self.scalars.half_force_limit + self.scalars.half_force_limit;
        let most = T::from_f64(LARGEST_FORCE_N);
        if limit <= most {
            limit.larger(T::ZERO)
        } else {
            most
        }
    }

    /// Sets the clearance 2a (m): a live change for firmware, a few dozen operations, no table touched.
    /// Held to 0 to 0.1 m; a value that is not finite counts as 0.
    pub fn set_clearance_m(&mut self, clearance_m: T) {
        let half = T::from_f64(0.5) * clearance_m;
        let most = T::from_f64(0.5 * LARGEST_CLEARANCE_M);
        let half = if half > T::ZERO && half.is_finite() {
            half.smaller(most)
        } else {
            T::ZERO
        };
        let k = &mut self.scalars;
        k.half_clearance = half;
        k.offset = half + k.held;
        self.revision = revision::of_damper(self.table_revision, k);
    }

    /// Force (N) at this tick for the displacement (m) of the tick; positive when it resists
    /// extension. The displacement is taken as linear since the last tick: no added delay.
    ///
    /// Never fails: bad input is held or limited and latched in the state's status. The force is
    /// finite and at most [`Damper::force_limit_n`] in magnitude, whatever bits the damper and the state
    /// have.
    ///
    /// A state that another damper stepped before is carried over first, its force kept.
    #[inline]
    pub fn step(&self, state: &mut DamperState<T>, displacement: T) -> T {
        let [force] = step::step::<T, T, 1>([self], core::array::from_mut(state), [displacement]);
        force
    }

    /// Reach (m) at the end of the bins; no stage looks beyond it.
    pub(crate) fn largest_reach(&self) -> T {
        let k = &self.scalars;
        let end = T::from_f64(f64::from(1_u32 << DOUBLINGS));
        end * k.first_knot + k.offset
    }

    /// Whether a step of this damper could leave the numbers of a state behind.
    pub(crate) fn could_leave(&self, state: &DamperState<T>) -> bool {
        state.displacement.is_finite()
            && state.potential.is_finite()
            && state.stretch.magnitude() <= self.largest_reach()
            && state.force.magnitude() <= self.force_limit_n()
    }

    /// Carries a state over from another damper: displacement and force stay, the stretch becomes
    /// the one this damper has under that force; without force it stays within the clearance.
    ///
    /// [`Damper::step`] does this by itself when it meets a state of another damper; call it between
    /// ticks to keep that tick at its usual cost. Fixed work: 26 stages in `f32`, 55 in `f64`.
    pub fn adopt(&self, state: &mut DamperState<T>) {
        let a = self.scalars.half_clearance;
        let limit = self.force_limit_n();
        let force = state.force.larger(-limit).smaller(limit);
        (state.stretch, state.potential) = if force == T::ZERO {
            (state.stretch.larger(-a).smaller(a), T::ZERO)
        } else {
            step::settle(self, force)
        };
        if state.revision != 0 {
            state.latch(Status::DAMPER_SWAPPED);
        }
        state.revision = self.revision;
    }
}
