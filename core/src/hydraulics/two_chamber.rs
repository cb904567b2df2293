//! Compression with a pressure in each chamber.

use super::flow::Laws;
use crate::build::root::bracketed_root;

/// Piston velocity (m/s) in compression under the force on the oil (N).
///
/// `A_ext v = Q_piston(P1 - P2)`, `A_rod v = Q_foot(P1 - P_b)`, `F = P1 A_comp - P2 A_ext`. Where P2
/// would fall below the vapour pressure it stays there and the oil flowing into the rod side no
/// longer fills it: `A_comp v = Q_piston(P1 - P_v) + Q_foot(P1 - P_b)`.
pub(super) fn compression_velocity(laws: &Laws, vapour_pressure_pa: f64, force_n: f64) -> f64 {
    let (piston, rod_side) = (laws.piston_area, laws.rod_side_area);
    let rod = piston - rod_side;
    // With F = P1 A_rod + (P1 - P2) A_ext one unknown is left, the pressure difference.
    let base = |difference: f64| (force_n - difference * rod_side) / rod;
    let difference = bracketed_root(0.0, force_n / rod_side, |difference| {
        let base = base(difference);
        laws.through_foot(base) * rod_side - laws.through_piston(true, difference, base) * rod
    });
    let upstream = base(difference);
    if upstream - difference >= vapour_pressure_pa {
        return laws.through_piston(true, difference, upstream) / rod_side;
    }
    let pressure = (force_n + vapour_pressure_pa * rod_side) / piston;
    (laws.through_piston(true, pressure - vapour_pressure_pa, pressure)
        + laws.through_foot(pressure))
        / piston
}

/// Force on the oil (N) at which the piston's pressure difference is `difference` (Pa).
pub(super) fn force_at_difference(laws: &Laws, difference: f64) -> f64 {
    let rod_side = laws.rod_side_area;
    let rod = laws.piston_area - rod_side;
    let base = bracketed_root(0.0, 1e9, |pressure| {
        laws.through_piston(true, difference, pressure) * rod
            - laws.through_foot(pressure) * rod_side
    });
    base * rod + difference * rod_side
}
