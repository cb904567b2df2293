//! Compression with a pressure in each chamber.
//!
//! `A_ext v = Q_piston(P1 - P2)`, `A_rod v = Q_foot(P1 - P_b)`, `F = P1 A_comp - P2 A_ext`. All forces are forces on
//! the oil, without seal friction.

use super::flow::Laws;
use crate::math::root::bracketed_root;

/// Pressure of the piston side P1 and pressure difference P1 - P2 (Pa), if no vapour forms.
fn pressures(laws: &Laws, force_n: f64) -> (f64, f64) {
    let (rod_side, rod) = (laws.rod_side_area, laws.rod_area());
    // With F = P1 A_rod + (P1 - P2) A_ext the pressure difference is the only unknown.
    let upstream = |difference: f64| (force_n - difference * rod_side) / rod;
    let difference = bracketed_root(0.0, force_n / rod_side, |difference| {
        let upstream = upstream(difference);
        laws.through_foot(upstream) * rod_side
            - laws.through_piston(true, difference, upstream) * rod
    });
    (upstream(difference), difference)
}

/// Pressure of the rod side above the vapour pressure (Pa), if no vapour forms.
pub(super) fn above_vapour_pa(laws: &Laws, vapour_pressure_pa: f64, force_n: f64) -> f64 {
    let (upstream, difference) = pressures(laws, force_n);
    upstream - difference - vapour_pressure_pa
}

/// Piston velocity (m/s) in compression under a force (N).
///
/// P2 cannot fall below the vapour pressure. At the vapour pressure the oil no longer fills the rod side, so
/// `A_comp v = Q_piston(P1 - P_v) + Q_foot(P1 - P_b)`.
pub(super) fn compression_velocity(laws: &Laws, vapour_pressure_pa: f64, force_n: f64) -> f64 {
    let (upstream, difference) = pressures(laws, force_n);
    if upstream - difference >= vapour_pressure_pa {
        return laws.through_piston(true, difference, upstream) / laws.rod_side_area;
    }
    let pressure = (force_n + vapour_pressure_pa * laws.rod_side_area) / laws.piston_area;
    (laws.through_piston(true, pressure - vapour_pressure_pa, pressure)
        + laws.through_foot(pressure))
        / laws.piston_area
}

/// Force (N) at which the pressure difference across the piston is `difference` (Pa).
pub(super) fn force_at_difference(laws: &Laws, vapour_pressure_pa: f64, difference: f64) -> f64 {
    let (rod_side, rod) = (laws.rod_side_area, laws.rod_area());
    let upstream = bracketed_root(laws.foot_opening_pa(), 1e9, |pressure| {
        laws.through_piston(true, difference, pressure) * rod
            - laws.through_foot(pressure) * rod_side
    });
    if upstream - difference >= vapour_pressure_pa {
        upstream * rod + difference * rod_side
    } else {
        (difference + vapour_pressure_pa) * laws.piston_area - vapour_pressure_pa * rod_side
    }
}
