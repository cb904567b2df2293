//! The two implicit stages of a step.

use crate::damper::Damper;
use crate::math::Lanes;
use crate::real::Real;
use crate::table::{FLOW, POTENTIAL, Piece, STIFFNESS, Table, cubic, locate};

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
        let flow = cubic(pieces.map(|piece| piece[FLOW]), z);
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
        cubic(self.pieces.map(|piece| piece[POTENTIAL]), self.z)
    }

    /// Ratio of the force to the stretch beyond the clearance (N/m).
    #[inline(always)]
    pub(crate) fn stiffness(&self) -> V {
        cubic(self.pieces.map(|piece| piece[STIFFNESS]), self.z)
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

#[cfg(test)]
#[cfg(feature = "builder")]
mod tests {
    use super::{GAMMA, state_at_force};
    use crate::damper::Damper;
    use crate::parameters::{DamperParameters, Mount};

    const DAMPING_N_S_PER_M: f64 = 120e3;
    const STIFFNESS_N_PER_M: f64 = 8e6;
    const STEP_S: f64 = 1e-3;

    /// A linear damper behind a spring, up to its yield force of 3600 N.
    fn linear(clearance_m: f64) -> DamperParameters {
        let mount = Mount::new(STIFFNESS_N_PER_M).clearance_m(clearance_m);
        DamperParameters::reduced(DAMPING_N_S_PER_M, 0.03, mount)
    }

    fn assert_close(found: f64, expected: f64, tolerance: f64) {
        assert!(
            (found - expected).abs() <= tolerance,
            "{found:e} in place of {expected:e}"
        );
    }

    /// Step times the integral of the flow `k u / C` over a stretch `u` beyond the clearance (m^2).
    fn potential(beyond_m: f64) -> f64 {
        STEP_S * STIFFNESS_N_PER_M * beyond_m * beyond_m / (2.0 * DAMPING_N_S_PER_M)
    }

    #[test]
    fn a_force_stretches_half_the_clearance_and_the_spring() {
        let parameters = linear(1e-3);
        let damper: Damper<f64> = parameters.build(STEP_S).expect("a valid damper");
        let single: Damper<f32> = parameters.build(STEP_S).expect("a valid damper");
        for force_n in [1.0, 250.0, 1234.5, 3599.0] {
            for sign in [1.0, -1.0] {
                let beyond_m = force_n / STIFFNESS_N_PER_M;
                let expected = sign * (0.5e-3 + beyond_m);
                let (stretch, area) = state_at_force(&damper, sign * force_n);
                assert_close(stretch, expected, 1e-16);
                assert_close(area, potential(beyond_m), 1e-18);
                let (stretch, area) = state_at_force(&single, (sign * force_n) as f32);
                assert_close(stretch.into(), expected, 2e-10);
                assert_close(area.into(), potential(beyond_m), 1e-12);
            }
        }
    }

    #[test]
    fn a_force_at_its_limit_has_the_stretch_at_which_the_damper_starts_to_yield() {
        let damper: Damper<f64> = linear(1e-3).build(STEP_S).expect("a valid damper");
        let (stretch, _) = state_at_force(&damper, 3600.0);
        assert_close(stretch, 0.5e-3 + 3600.0 / STIFFNESS_N_PER_M, 1e-8);
    }

    /// Without clearance and with a very small force, every halving takes the lower half. The number of halvings
    /// follows from the last reach; it is the number of stages in the documentation of [`Damper::adopt`].
    #[test]
    fn adopting_solves_26_stages_in_f32_and_55_in_f64() {
        let single: Damper<f32> = linear(0.0).build(STEP_S).expect("a valid damper");
        let double: Damper<f64> = linear(0.0).build(STEP_S).expect("a valid damper");
        // A reach is the stretch plus gamma times the flow.
        let reach_per_stretch = 1.0 + GAMMA * STEP_S * STIFFNESS_N_PER_M / DAMPING_N_S_PER_M;
        let reach = f64::from(state_at_force(&single, 1e-30).0) * reach_per_stretch;
        assert_close(
            f64::from(single.max_reach()) / reach / libm::exp2(26.0),
            1.0,
            1e-3,
        );
        let reach = state_at_force(&double, 1e-30).0 * reach_per_stretch;
        assert_close(double.max_reach() / reach / libm::exp2(55.0), 1.0, 1e-3);
    }
}
