//! One patch as the tables hold it: Hertz and Kalker of a contact patch, stored as `f32`.

use crate::contact::hertz::{Hertz, Steel};
use crate::contact::pair::Pair;
use crate::contact::patches::Patch;
use crate::creep::{KalkerCoefficients, KalkerTable};

/// Smallest transverse curvature of a patch, 1/m: a closer fit, as in a flange root, spreads its load over its
/// whole width, which is that of an ellipse of this curvature.
pub const MIN_CURVATURE_PER_M: f64 = 0.5;

/// Load fraction below which a patch is lifted, by so many m for each factor of e, so that the step need not evaluate it.
const LIGHT_FRACTION: f64 = 1e-3;
const LIFT_M: f64 = 0.1e-3;

/// Numbers stored of one patch beside its interpenetration.
pub(in crate::contact) const NUMBERS: usize = 12;

/// Place of the load fraction among them.
pub(in crate::contact) const LOAD_FRACTION: usize = 3;

/// One patch as read from the tables.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct TabulatedPatch {
    /// As [`Patch::interpenetration_m`], m; less where the patch carries under a thousandth of a load.
    pub interpenetration_m: f64,
    /// As [`Patch::wheel_y_m`], m.
    pub wheel_y_m: f64,
    /// As [`Patch::wheel_z_m`], m.
    pub wheel_z_m: f64,
    /// As [`Patch::slope`].
    pub slope: f64,
    /// As [`Patch::load_fraction`].
    pub load_fraction: f64,
    /// Hertz contact whose load the patch carries a fraction of.
    pub hertz: Hertz,
    /// Kalker's coefficients of the ellipse.
    pub kalker: KalkerCoefficients,
}

impl TabulatedPatch {
    /// Hertz and Kalker of `patch` on a wheel that is rolled by `roll`, which turns the slope back into the
    /// wheel's axes.
    pub(in crate::contact) fn new(
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
        let load_fraction = patch.load_fraction.max(1e-30);
        let lift = LIFT_M * (load_fraction / LIGHT_FRACTION).ln().min(0.0);
        Self {
            interpenetration_m: patch.interpenetration_m + lift,
            wheel_y_m: patch.wheel_y_m,
            wheel_z_m: patch.wheel_z_m,
            slope: patch.slope,
            load_fraction,
            hertz,
            kalker: kalker.at(hertz.a_factor_m_0_5 / hertz.b_factor_m_0_5),
        }
    }

    /// Every number but the interpenetration, in the order of [`TabulatedPatch::from_numbers`].
    pub(in crate::contact) fn to_numbers(self) -> [f64; NUMBERS] {
        [
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
            0.0,
        ]
    }

    #[inline]
    pub(in crate::contact) fn from_numbers(
        interpenetration_m: f64,
        numbers: [f64; NUMBERS],
    ) -> Self {
        let [
            y,
            z,
            slope,
            load_fraction,
            stiffness,
            a,
            b,
            c11,
            c22,
            c23,
            c33,
            _,
        ] = numbers;
        Self {
            interpenetration_m,
            wheel_y_m: y,
            wheel_z_m: z,
            slope,
            load_fraction,
            hertz: Hertz {
                stiffness_n_per_m_1_5: stiffness,
                a_factor_m_0_5: a,
                b_factor_m_0_5: b,
            },
            kalker: KalkerCoefficients { c11, c22, c23, c33 },
        }
    }
}
