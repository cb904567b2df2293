//! Results of a run from which the observed indices are extracted.

use dashpot_vehicle_run::Indices;

/// Results of a completed run.
#[derive(Debug, Clone, PartialEq)]
pub struct Observation {
    /// Indices of the run.
    pub indices: Indices,
    /// Maximum lateral displacement of a wheelset in the last 3 s, m.
    pub last_lateral_m: f64,
    /// Maximum ratio of a wheel's load to its load at standstill.
    pub wheel_load_over_static: Option<f64>,
    /// Maximum wear depth of all wheels, an estimate, um per 1000 km; `None` if no index needs it.
    pub max_wear_depth_um_per_1000km: Option<f64>,
    /// Longest duration for which a wheel carried no load, s.
    pub wheel_lift_longest_s: f64,
}
