//! Compression with a pressure in each chamber.
//!
//! `A_ext v = Q_piston(P1 - P2)`, `A_rod v = Q_foot(P1 - P_b)`, `F = P1 A_comp - P2 A_ext`. All forces are forces on
//! the oil, without seal friction.

use super::flow::Laws;
use crate::math::root::bracketed_root;
use crate::math::roots::bracketed_roots;

/// Equation for the pressure difference P1 - P2 (Pa), if no vapour forms.
///
/// With `F = P1 A_rod + (P1 - P2) A_ext` the pressure difference is the only unknown.
struct Chambers<'a> {
    laws: &'a Laws,
    rod_side: f64,
    rod: f64,
}

impl<'a> Chambers<'a> {
    fn new(laws: &'a Laws) -> Self {
        Self {
            laws,
            rod_side: laws.rod_side_area,
            rod: laws.rod_area(),
        }
    }

    /// Pressure of the piston side P1 (Pa).
    #[inline(always)]
    fn upstream(&self, force_n: f64, difference: f64) -> f64 {
        (force_n - difference * self.rod_side) / self.rod
    }

    /// Pressure of the rod side P2 (Pa). It decreases with the difference, also when rounded.
    #[inline(always)]
    fn downstream(&self, force_n: f64, difference: f64) -> f64 {
        self.upstream(force_n, difference) - difference
    }

    /// Residuals of the equations, zero at the pressure differences of the forces.
    #[inline(always)]
    fn residuals<const N: usize>(&self, forces_n: [f64; N], differences: [f64; N]) -> [f64; N] {
        let upstream: [f64; N] =
            core::array::from_fn(|lane| self.upstream(forces_n[lane], differences[lane]));
        let densities = upstream.map(|pressure| self.laws.density.at(pressure));
        let foot = self.laws.through_foot(upstream, densities);
        let piston = self.laws.through_piston(true, differences, densities);
        core::array::from_fn(|lane| foot[lane] * self.rod_side - piston[lane] * self.rod)
    }

    /// Pressure differences (Pa) of several forces. The search for a difference ends early, within its bracket, if
    /// `is_enough` is true for the index of the force and the bracket.
    #[inline(always)]
    fn differences<const N: usize>(
        &self,
        forces_n: [f64; N],
        is_enough: impl Fn(usize, f64, f64) -> bool,
    ) -> [f64; N] {
        bracketed_roots(
            forces_n.map(|force| force / self.rod_side),
            |differences| self.residuals(forces_n, differences),
            is_enough,
        )
    }
}

/// Pressure of the rod side above the vapour pressure (Pa), if no vapour forms.
pub(super) fn above_vapour_pa(laws: &Laws, vapour_pressure_pa: f64, force_n: f64) -> f64 {
    let chambers = Chambers::new(laws);
    let [difference] = chambers.differences([force_n], |_, _, _| false);
    chambers.downstream(force_n, difference) - vapour_pressure_pa
}

/// Values with the signs of [`above_vapour_pa`], zero included, for several forces.
pub(super) fn signs_above_vapour<const N: usize>(
    laws: &Laws,
    vapour_pressure_pa: f64,
    forces_n: [f64; N],
) -> [f64; N] {
    let chambers = Chambers::new(laws);
    let above = |lane: usize, difference: f64| {
        chambers.downstream(forces_n[lane], difference) - vapour_pressure_pa
    };
    // The pressure is largest at the lower end of a bracket, and smallest at its upper end.
    let is_enough = |lane, a, b| above(lane, a) < 0.0 || above(lane, b) > 0.0;
    let differences = chambers.differences(forces_n, is_enough);
    core::array::from_fn(|lane| above(lane, differences[lane]))
}

/// Piston velocities (m/s) in compression under several forces (N).
///
/// P2 cannot fall below the vapour pressure. At the vapour pressure the oil no longer fills the rod side, so
/// `A_comp v = Q_piston(P1 - P_v) + Q_foot(P1 - P_b)`.
pub(super) fn compression_velocities<const N: usize>(
    laws: &Laws,
    vapour_pressure_pa: f64,
    forces_n: [f64; N],
) -> [f64; N] {
    let chambers = Chambers::new(laws);
    // With vapour, the pressure difference does not matter.
    let has_vapour = |lane: usize, difference: f64| {
        chambers.downstream(forces_n[lane], difference) < vapour_pressure_pa
    };
    // A lower bound of the difference at which vapour forms saves the division of `has_vapour`.
    let bounds = forces_n.map(|force| {
        let at_vapour = (force - vapour_pressure_pa * chambers.rod) / laws.piston_area;
        (1.0 - 1e-12) * at_vapour
    });
    let differences = chambers.differences(forces_n, |lane, a, _| {
        a >= bounds[lane] && has_vapour(lane, a)
    });
    core::array::from_fn(|lane| {
        let (force, difference) = (forces_n[lane], differences[lane]);
        if !has_vapour(lane, difference) {
            let density = laws.density.at(chambers.upstream(force, difference));
            let [piston] = laws.through_piston(true, [difference], [density]);
            return piston / laws.rod_side_area;
        }
        let pressure = (force + vapour_pressure_pa * laws.rod_side_area) / laws.piston_area;
        let density = laws.density.at(pressure);
        let [piston] = laws.through_piston(true, [pressure - vapour_pressure_pa], [density]);
        let [foot] = laws.through_foot([pressure], [density]);
        (piston + foot) / laws.piston_area
    })
}

/// Force (N) at which the pressure difference across the piston is `difference` (Pa).
pub(super) fn force_at_difference(laws: &Laws, vapour_pressure_pa: f64, difference: f64) -> f64 {
    let (rod_side, rod) = (laws.rod_side_area, laws.rod_area());
    let upstream = bracketed_root(laws.foot_opening_pa(), 1e9, |pressure| {
        let density = laws.density.at(pressure);
        let [piston] = laws.through_piston(true, [difference], [density]);
        let [foot] = laws.through_foot([pressure], [density]);
        piston * rod - foot * rod_side
    });
    if upstream - difference >= vapour_pressure_pa {
        upstream * rod + difference * rod_side
    } else {
        (difference + vapour_pressure_pa) * laws.piston_area - vapour_pressure_pa * rod_side
    }
}
