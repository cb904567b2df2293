//! One loaded contact.

use super::kalker::KalkerCoefficients;

/// One loaded contact, the input of creep laws.
///
/// The fields are complete; none will be added.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadedContact {
    /// Normal load, N.
    pub load_n: f64,
    /// Semi-axis in the rolling direction, m.
    pub a_m: f64,
    /// Semi-axis across, m.
    pub b_m: f64,
    /// Shear modulus, Pa.
    pub shear_modulus_pa: f64,
    /// Kalker's coefficients of the ellipse.
    pub kalker: KalkerCoefficients,
    /// Friction coefficient at the contact's sliding speed, dimensionless.
    pub friction: f64,
}
