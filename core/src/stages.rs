//! The two implicit stages of a step.

use crate::damper::Damper;
use crate::math::Lanes;
use crate::real::Real;
use crate::table::{Piece, Table, cubic, locate};

/// Coefficient gamma, the weight of the implicit part of each stage.
pub(crate) const GAMMA: f64 = 1.0 - core::f64::consts::FRAC_1_SQRT_2;

/// Constants of the implicit stages.
pub(crate) struct Stages<'a, T, V, const L: usize> {
    tables: [&'a Table<T>; L],
    offset: V,
    first_knot: V,
    half_clearance: V,
    pub(crate) force_limit: V,
}

/// A solved stage.
pub(crate) struct Stage<'a, T, V, const L: usize> {
    /// Flow `v_h` times the step (m).
    pub(crate) flow: V,
    pieces: [&'a Piece<T>; L],
    z: V,
}

impl<'a, T: Real, V: Lanes<T, L>, const L: usize> Stages<'a, T, V, L> {
    #[inline(always)]
    pub(crate) fn new(dampers: [&'a Damper<T>; L]) -> Self {
        let [offset, first_knot, half_clearance, half_limit] =
            V::transpose(dampers.map(|damper| {
                let k = &damper.scalars;
                [k.offset, k.first_knot, k.half_clearance, k.half_force_limit]
            }));
        Self {
            tables: dampers.map(|damper| &damper.table),
            offset,
            first_knot,
            half_clearance,
            force_limit: half_limit + half_limit,
        }
    }

    /// Solves the stage whose stretch plus gamma times its flow is `reach` (m).
    #[inline(always)]
    pub(crate) fn solve(&self, reach: V) -> Stage<'a, T, V, L> {
        // The maximum with a constant takes one instruction with every compiler; with a variable it can take eight.
        let beyond = (reach.abs() - self.offset).max(V::splat(0.0));
        let (pieces, z) = locate(self.tables, beyond + self.first_knot, reach);
        let flow = cubic(pieces.map(|piece| piece.flow), z);
        Stage { flow, pieces, z }
    }

    /// Force magnitude (N) at a stretch (m), from the stiffness of the stage that ended there. It can exceed the limit.
    #[inline(always)]
    pub(crate) fn force(&self, stretch: V, stiffness: V) -> V {
        let beyond = (stretch.abs() - self.half_clearance).max(V::splat(0.0));
        beyond * stiffness
    }
}

impl<T: Real, V: Lanes<T, L>, const L: usize> Stage<'_, T, V, L> {
    /// Flow potential times the step (m^2).
    #[inline(always)]
    pub(crate) fn potential(&self) -> V {
        cubic(self.pieces.map(|piece| piece.potential), self.z)
    }

    /// Ratio of the force to the stretch beyond the clearance (N/m).
    #[inline(always)]
    pub(crate) fn stiffness(&self) -> V {
        cubic(self.pieces.map(|piece| piece.stiffness), self.z)
    }
}

/// Finds the stretch (m) and the flow potential (m^2) at which `damper` has a force (N), by bisection over the reach.
pub(crate) fn state_at_force<T: Real>(damper: &Damper<T>, force: T) -> (T, T) {
    let stages: Stages<'_, T, T, 1> = Stages::new([damper]);
    let signed = |value: T| if force < T::ZERO { -value } else { value };
    let mut low = damper.scalars.half_clearance;
    let mut high = damper.max_reach();
    let mut found = (T::ZERO, T::ZERO);
    for _ in 0..T::MANTISSA_DIGITS + 2 {
        let middle = T::from_f64(0.5) * (low + high);
        let reach = signed(middle);
        let stage = stages.solve(reach);
        let stretch = reach - T::from_f64(GAMMA) * stage.flow;
        let reached = stages.force(stretch, stage.stiffness());
        found = (stretch, stage.potential());
        if reached < force.abs() {
            low = middle;
        } else {
            high = middle;
        }
    }
    found
}
