//! One patch of the tables: Hertz constants and Kalker coefficients, stored as `f32`.

use super::hertz::{Hertz, Steel};
use super::pair::Pair;
use super::patches::Patch;
use crate::creep::{KalkerCoefficients, KalkerTable};

/// Minimum transverse curvature of a patch, 1/m. Where the surfaces fit more closely, as in a flange root, the load
/// spreads over the whole width of the fit, which is the width of an ellipse with this curvature.
pub const MIN_CURVATURE_PER_M: f64 = 0.5;

/// Load fraction below which a patch is raised off the rail, so that the step need not evaluate it.
const LIGHT_FRACTION: f64 = 1e-3;
/// Height by which a patch is raised if its load fraction is [`LIGHT_FRACTION`] divided by `e`, m; with each further
/// division by `e` it is raised by this height again.
const LIFT_M: f64 = 0.1e-3;

/// Length of a packed [`PatchNumbers`]: three vectors of four.
pub(super) const NUMBERS: usize = 12;

/// Interpolated quantities of one patch apart from its interpenetration: scalars, vector lanes, or numbers with
/// derivatives.
#[derive(Debug, Clone, Copy)]
pub struct PatchNumbers<T> {
    /// Lateral position on the wheel, m.
    pub wheel_y: T,
    /// Depth on the wheel, m.
    pub wheel_z: T,
    /// `dz/dy` of both surfaces in the rail's axes.
    pub slope: T,
    /// Fraction of the Hertzian load that the patch carries.
    pub load_fraction: T,
    /// Hertzian stiffness, N/m^1.5.
    pub stiffness: T,
    /// Semi-axes divided by the square root of the penetration, m^0.5.
    pub a_factor: T,
    pub b_factor: T,
    pub kalker: KalkerCoefficients<T>,
}

impl<T> PatchNumbers<T> {
    /// Unpacks an array; the last element is padding.
    #[inline(always)]
    pub fn from_array(packed: [T; NUMBERS]) -> Self {
        let [
            wheel_y,
            wheel_z,
            slope,
            load_fraction,
            stiffness,
            a_factor,
            b_factor,
            c11,
            c22,
            c23,
            c33,
            _,
        ] = packed;
        Self {
            wheel_y,
            wheel_z,
            slope,
            load_fraction,
            stiffness,
            a_factor,
            b_factor,
            kalker: KalkerCoefficients { c11, c22, c23, c33 },
        }
    }
}

impl PatchNumbers<f64> {
    /// Packs the numbers into an array, as a node of the tables stores them.
    #[inline]
    pub fn to_array(self) -> [f64; NUMBERS] {
        let KalkerCoefficients { c11, c22, c23, c33 } = self.kalker;
        [
            self.wheel_y,
            self.wheel_z,
            self.slope,
            self.load_fraction,
            self.stiffness,
            self.a_factor,
            self.b_factor,
            c11,
            c22,
            c23,
            c33,
            0.0,
        ]
    }
}

/// One patch, as read from the tables.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct TabulatedPatch {
    /// Depth of the wheel below the rail's surface, see [`Patch::interpenetration_m`], m; reduced if the load fraction
    /// is below 0.001.
    pub interpenetration_m: f64,
    /// Lateral position on the wheel from the tread datum, field side positive, m.
    pub wheel_y_m: f64,
    /// Depth on the wheel, m; the rolling radius is the wheel radius plus this depth.
    pub wheel_z_m: f64,
    /// `dz/dy` of both surfaces across the track: the tangent of the contact angle.
    pub slope: f64,
    /// Fraction of the Hertzian load that the patch carries, 0 to 1.
    pub load_fraction: f64,
    /// Hertzian constants of the contact.
    pub hertz: Hertz,
    /// Kalker's coefficients of the contact ellipse.
    pub kalker: KalkerCoefficients,
}

impl TabulatedPatch {
    /// Computes the Hertz constants and Kalker coefficients of `patch` on a wheel rolled by `roll`, rad. The contact
    /// angle in the wheel's axes is that in track axes minus `roll`.
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

    /// The quantities apart from the interpenetration.
    pub(super) fn to_numbers(self) -> PatchNumbers<f64> {
        PatchNumbers {
            wheel_y: self.wheel_y_m,
            wheel_z: self.wheel_z_m,
            slope: self.slope,
            load_fraction: self.load_fraction,
            stiffness: self.hertz.stiffness_n_per_m_1_5,
            a_factor: self.hertz.a_factor_m_0_5,
            b_factor: self.hertz.b_factor_m_0_5,
            kalker: self.kalker,
        }
    }

    pub(super) fn from_numbers(interpenetration_m: f64, numbers: PatchNumbers<f64>) -> Self {
        Self {
            interpenetration_m,
            wheel_y_m: numbers.wheel_y,
            wheel_z_m: numbers.wheel_z,
            slope: numbers.slope,
            load_fraction: numbers.load_fraction,
            hertz: Hertz {
                stiffness_n_per_m_1_5: numbers.stiffness,
                a_factor_m_0_5: numbers.a_factor,
                b_factor_m_0_5: numbers.b_factor,
            },
            kalker: numbers.kalker,
        }
    }
}
