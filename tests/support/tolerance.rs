//! The one table of tolerances: NRMSE of the fixed step against the reference solver.

/// One damper under one excitation.
pub struct Tolerance {
    /// Name in [`crate::accuracy::DAMPERS`].
    pub damper: &'static str,
    /// Name of the excitation.
    pub excitation: &'static str,
    /// For 1 kHz and 10 kHz the NRMSE allowed in `f64` and in `f32`.
    pub nrmse: [[f64; 2]; 2],
}

/// Rows.
pub const TOLERANCES: [Tolerance; 0] = [];
