//! Compression with a pressure in each chamber.

use super::flow::Laws;
use crate::build::root::bracketed_root;

/// Piston velocity [m/s] in compression under the force on the oil [N].
///
/// `A_ext v = Q_piston(P1 - P2)`, `A_rod v = Q_foot(P1 - P_b)`, `F = P1 A_comp - P2 A_ext`. Where P2
/// would fall below the vapour pressure it stays there and the oil flowing into the rod side no
/// longer fills it: `A_comp v = Q_piston(P1 - P_v) + Q_foot(P1 - P_b)`.
pub(super) fn compression_velocity(laws: &Laws, vapour_pressure_pa: f64, force_n: f64) -> f64 {
    let (piston, rod_side) = (laws.piston_area, laws.rod_side_area);
    let rod = piston - rod_side;
    let foot = |pressure: f64| laws.foot.flow(&laws.oil, pressure, laws.back_pressure_pa);
    let through_piston = |difference: f64| {
        laws.paths.flow(&laws.oil, difference) + laws.compression.flow(&laws.oil, difference, 0.0)
    };
    // With F = P1 A_rod + (P1 - P2) A_ext one unknown is left, the pressure difference.
    let base = |difference: f64| (force_n - difference * rod_side) / rod;
    let difference = bracketed_root(0.0, force_n / rod_side, |difference| {
        foot(base(difference)) * rod_side - through_piston(difference) * rod
    });
    let rod_side_pressure = base(difference) - difference;
    if rod_side_pressure >= vapour_pressure_pa {
        return through_piston(difference) / rod_side;
    }
    let pressure = (force_n + vapour_pressure_pa * rod_side) / piston;
    (through_piston(pressure - vapour_pressure_pa) + foot(pressure)) / piston
}

/// Force on the oil [N] at which the piston's pressure difference is `difference` [Pa].
pub(super) fn force_at_difference(laws: &Laws, difference: f64) -> f64 {
    let (piston, rod_side) = (laws.piston_area, laws.rod_side_area);
    let rod = piston - rod_side;
    let through_piston =
        laws.paths.flow(&laws.oil, difference) + laws.compression.flow(&laws.oil, difference, 0.0);
    let through_foot = through_piston * rod / rod_side;
    let base = bracketed_root(0.0, 1e9, |pressure| {
        through_foot - laws.foot.flow(&laws.oil, pressure, laws.back_pressure_pa)
    });
    base * rod + difference * rod_side
}
