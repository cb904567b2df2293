//! One patch as the tables hold it: Hertz and Kalker of a contact patch, stored as `f32`.

use crate::contact::hertz::{Hertz, Steel};
use crate::contact::pair::Pair;
use crate::contact::patches::Patch;
use crate::creep::{KalkerCoefficients, KalkerTable};

/// Smallest transverse curvature of a patch, 1/m: a closer fit, as in a flange root, spreads its load over its
/// whole width, which is that of an ellipse of this curvature.
pub const MIN_CURVATURE_PER_M: f64 = 0.5;

/// Numbers stored of one patch.
pub(super) const NUMBERS: usize = 12;

/// One patch as read from the tables.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct TabulatedPatch {
    /// As [`Patch::interpenetration_m`], m.
    pub interpenetration_m: f64,
    /// As [`Patch::wheel_y_m`], m.
    pub wheel_y_m: f64,
    /// As [`Patch::wheel_z_m`], m.
    pub wheel_z_m: f64,
    /// As [`Patch::slope`].
    pub slope: f64,
    /// As [`Patch::load_fraction`].
    pub load_fraction: f64,
    /// Hertz contact of the patch for its fraction of the load.
    pub hertz: Hertz,
    /// Kalker's coefficients of the ellipse.
    pub kalker: KalkerCoefficients,
}

impl TabulatedPatch {
    /// Hertz and Kalker of `patch` on a wheel that is rolled by `roll`, which turns the slope back into the
    /// wheel's axes.
    pub(super) fn new(
        pair: &Pair,
        steel: &Steel,
        kalker: &KalkerTable,
        patch: &Patch,
        roll: f64,
    ) -> Self {
        let radius = pair.installation().wheel_radius_m + patch.wheel_z_m;
        let rolling = (patch.slope.atan() - roll).cos().max(0.01) / radius;
        let hertz = Hertz::new(
            steel,
            rolling,
            patch.curvature_per_m.max(MIN_CURVATURE_PER_M),
        );
        // Numbers below the normal range of f32 would slow the step; a millionth of a load is negligible.
        let load_fraction = if patch.load_fraction < 1e-6 {
            0.0
        } else {
            patch.load_fraction
        };
        let axis_factor = load_fraction.cbrt();
        Self {
            interpenetration_m: patch.interpenetration_m,
            wheel_y_m: patch.wheel_y_m,
            wheel_z_m: patch.wheel_z_m,
            slope: patch.slope,
            load_fraction,
            hertz: Hertz {
                stiffness_n_per_m_1_5: hertz.stiffness_n_per_m_1_5 * load_fraction,
                a_factor_m_0_5: hertz.a_factor_m_0_5 * axis_factor,
                b_factor_m_0_5: hertz.b_factor_m_0_5 * axis_factor,
            },
            kalker: kalker.at(hertz.a_factor_m_0_5 / hertz.b_factor_m_0_5),
        }
    }

    pub(super) fn to_numbers(self) -> [f32; NUMBERS] {
        [
            self.interpenetration_m,
            self.wheel_y_m,
            self.wheel_z_m,
            self.slope,
            self.load_fraction,
            self.hertz.stiffness_n_per_m_1_5,
            self.hertz.a_factor_m_0_5,
            self.hertz.b_factor_m_0_5,
            self.kalker.c11,
            self.kalker.c22,
            self.kalker.c23,
            self.kalker.c33,
        ]
        .map(|number| number as f32)
    }

    #[inline]
    pub(super) fn from_numbers(numbers: &[f32]) -> Self {
        let number = |i: usize| f64::from(numbers[i]);
        Self {
            interpenetration_m: number(0),
            wheel_y_m: number(1),
            wheel_z_m: number(2),
            slope: number(3),
            load_fraction: number(4),
            hertz: Hertz {
                stiffness_n_per_m_1_5: number(5),
                a_factor_m_0_5: number(6),
                b_factor_m_0_5: number(7),
            },
            kalker: KalkerCoefficients {
                c11: number(8),
                c22: number(9),
                c23: number(10),
                c33: number(11),
            },
        }
    }
}
