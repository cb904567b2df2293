//! Keys of the rig parameters.

/// Key of the skew: the delay of the recorded force relative to the displacement (s).
pub const SKEW: &str = "sensor_skew_s";

/// Key of the force offset: what the force sensor reads at zero force (N).
pub const FORCE_OFFSET: &str = "force_offset_n";

/// Key of the displacement offset: what the displacement sensor reads at the middle of the motion (m).
///
/// No force of a damper depends on it, so it is reported for each test and never varied.
pub const DISPLACEMENT_OFFSET: &str = "displacement_offset_m";

/// Rig parameters that forces determine.
pub const RIG: [&str; 2] = [SKEW, FORCE_OFFSET];

/// Key of the oil temperature.
pub const TEMPERATURE: &str = "oil.temperature_c";
