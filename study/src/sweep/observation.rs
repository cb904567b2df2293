//! Results of a run that indices are taken from.

use dashpot_vehicle_run::Indices;

/// What indices are taken of.
#[derive(Debug, Clone, PartialEq)]
pub struct Observation {
    /// Indices of the run.
    pub indices: Indices,
    /// Greatest lateral displacement of a wheelset in the last 3 s, m.
    pub last_lateral_m: f64,
    /// Greatest load of a wheel over its load at standstill.
    pub wheel_load_over_static: Option<f64>,
    /// Longest time for which a wheel carried no load, s.
    pub wheel_lift_longest_s: f64,
}
