//! Warnings: results that the model does not stand behind, and the values from which on they are given.

use std::fmt;

use serde::Serialize;

/// Wheel load, as a multiple of the load at standstill, above which a warning is given: the model's contact and track
/// are elastic, and its normal damping was measured at small impacts.
pub const WARN_LOAD_RATIO: f64 = 10.0;

/// Duration of wheel lift above which a warning is given, s.
pub const WARN_LIFT_S: f64 = 0.05;

/// Deviation of a rail at the start above which a warning is given, m. The default rails answer it with 6 kN.
pub const WARN_START_DEVIATION_M: f64 = 1e-4;

/// Velocity of this deviation above which a warning is given, m/s.
pub const WARN_START_RATE_M_PER_S: f64 = 0.02;

/// Time that a run may spend beyond its track's irregularities before a warning is given, s.
pub const WARN_EVEN_S: f64 = 0.5;

/// Result that the model does not stand behind.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "snake_case", tag = "kind")]
pub enum Warning {
    /// A wheel carried more than [`WARN_LOAD_RATIO`] times its load at standstill.
    WheelLoad {
        /// Name of the wheelset.
        wheelset: String,
        /// Side of the wheel, `left` or `right`.
        side: &'static str,
        /// Maximum load, N.
        load_n: f64,
        /// Load of this wheel at standstill, N.
        load_static_n: f64,
        /// Time of the maximum load, s.
        time_s: f64,
        /// Position of the wheelset along the track at that time, m.
        distance_m: f64,
        /// Number of ticks with a load above the limit.
        ticks: u64,
    },
    /// A wheel carried no load for longer than [`WARN_LIFT_S`].
    WheelLift {
        /// Name of the wheelset.
        wheelset: String,
        /// Side of the wheel, `left` or `right`.
        side: &'static str,
        /// Longest duration without load, s.
        duration_s: f64,
        /// Start of the longest lift, s.
        time_s: f64,
        /// Position of the wheelset along the track at that time, m.
        distance_m: f64,
        /// Number of lifts longer than the limit.
        times: u64,
    },
    /// The run starts on irregular rails, so the first wheel loads are those of a step that no track has.
    StartOnIrregularity {
        /// Name of the first such wheelset.
        wheelset: String,
        /// Side of the rail, `left` or `right`.
        side: &'static str,
        /// Position of the wheelset along the track, m.
        distance_m: f64,
        /// Deviation of the rail there, m.
        deviation_m: f64,
        /// Change of the deviation at the speed of the start, m/s.
        rate_m_per_s: f64,
    },
    /// The run starts in a curve, for which the vehicle is not yet in equilibrium.
    StartInCurve {
        /// Name of the first such wheelset.
        wheelset: String,
        /// Position of the wheelset along the track, m.
        distance_m: f64,
        /// Curvature there, 1/m.
        curvature_per_m: f64,
        /// Cant there, m.
        cant_m: f64,
    },
    /// The run went on for longer than [`WARN_EVEN_S`] where the track's irregularities have ended.
    IrregularitiesEnd {
        /// End of the irregularities along the track, m.
        end_m: f64,
        /// Time of the run beyond it, s.
        even_s: f64,
        /// Time of the whole run, s.
        duration_s: f64,
    },
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::WheelLoad {
                wheelset,
                side,
                load_n,
                load_static_n,
                time_s,
                distance_m,
                ticks,
            } => write!(
                f,
                "{wheelset}, {side} wheel: the load reached {:.0} kN, {:.1} times the static load, at {time_s:.3} s, \
                 {distance_m:.1} m along the track; it exceeded {WARN_LOAD_RATIO:.0} times the static load in {}, \
                 which is outside the validity of the contact model",
                1e-3 * load_n,
                load_n / load_static_n,
                counted(*ticks, "tick")
            ),
            Self::WheelLift {
                wheelset,
                side,
                duration_s,
                time_s,
                distance_m,
                times,
            } => write!(
                f,
                "{wheelset}, {side} wheel: no load for {duration_s:.3} s from {time_s:.3} s on, {distance_m:.1} m \
                 along the track; in all {} of more than {WARN_LIFT_S} s, so the vehicle was near derailment",
                counted(*times, "lift")
            ),
            Self::StartOnIrregularity {
                wheelset,
                side,
                distance_m,
                deviation_m,
                rate_m_per_s,
            } => write!(
                f,
                "{wheelset} starts {distance_m:.1} m along the track, where the {side} rail deviates by {:.2} mm and \
                 by {:.0} mm/s; the vehicle starts as on ideal track, so the first forces include those of a step that \
                 the track does not have. Start earlier (start_m)",
                1e3 * deviation_m,
                1e3 * rate_m_per_s,
            ),
            Self::StartInCurve {
                wheelset,
                distance_m,
                curvature_per_m,
                cant_m,
            } => write!(
                f,
                "{wheelset} starts {distance_m:.1} m along the track, where the curvature is {curvature_per_m:.5} 1/m \
                 and the cant {:.0} mm; the vehicle starts as on straight track, so the first forces include those of \
                 a step that the track does not have. Start earlier (start_m)",
                1e3 * cant_m,
            ),
            Self::IrregularitiesEnd {
                end_m,
                even_s,
                duration_s,
            } => write!(
                f,
                "the irregularities of the track end at {end_m:.0} m, and {even_s:.1} of the {duration_s:.1} s of the \
                 run are beyond, on even rails; means, root mean squares and ride indices are those of both parts. \
                 Make the run shorter, or the irregularities longer (length_m of the track)"
            ),
        }
    }
}

fn counted(count: u64, noun: &str) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {noun}{plural}")
}
