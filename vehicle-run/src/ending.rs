//! How a run ends, and the numbers that led there.

use std::fmt;

use super::outside_loss::OutsideLoss;
use super::validity::END_LOAD_RATIO;

/// Time and place at which a run ended.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Place {
    /// Time since the start, s.
    pub time_s: f64,
    /// Position of the vehicle's middle along the track, m.
    pub distance_m: f64,
}

/// Reason why a run ended.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
#[serde(rename_all = "snake_case", tag = "reason")]
pub enum Ending {
    /// The whole duration was simulated.
    Completed,
    /// The vehicle tipped over to one side: the wheels on the other side lifted off the rail and the wheelsets tilted.
    Overturned {
        /// Side to which it fell, `left` or `right`.
        side: &'static str,
        /// Number of unloaded wheels on the other side.
        unloaded_wheels: usize,
        /// Number of wheels on that side.
        wheels: usize,
        /// Name of the most tilted wheelset.
        wheelset: String,
        /// Roll of that wheelset, positive with the right side down, rad.
        roll_rad: f64,
        /// Time and place.
        #[serde(flatten)]
        place: Place,
    },
    /// The flange of a wheel climbed over the top of the rail: the vehicle derailed.
    Climbed {
        /// Name of the wheelset.
        wheelset: String,
        /// Side of the wheel, `left` or `right`.
        side: &'static str,
        /// `Y/Q` of the wheel, dimensionless.
        derailment: f64,
        /// Load of the wheel, N.
        load_n: f64,
        /// Lateral displacement of the wheelset, m.
        lateral_m: f64,
        /// Yaw of the wheelset, rad.
        yaw_rad: f64,
        /// Time and place.
        #[serde(flatten)]
        place: Place,
    },
    /// A wheelset moved outside the range of the contact tables.
    OutsideTables {
        /// Name of the wheelset.
        wheelset: String,
        /// Side of the wheel, `left` or `right`.
        side: &'static str,
        /// Lateral displacement of the wheelset, m.
        lateral_m: f64,
        /// Roll of the wheelset, rad.
        roll_rad: f64,
        /// Yaw of the wheelset, rad.
        yaw_rad: f64,
        /// Time and place.
        #[serde(flatten)]
        place: Place,
    },
    /// A wheel load was far outside the validity of the contact model; see [`END_LOAD_RATIO`].
    BeyondModel {
        /// Name of the wheelset.
        wheelset: String,
        /// Side of the wheel, `left` or `right`.
        side: &'static str,
        /// Load, N.
        load_n: f64,
        /// Load of this wheel at standstill, N.
        load_static_n: f64,
        /// Time and place.
        #[serde(flatten)]
        place: Place,
    },
    /// A displacement exceeded all bounds.
    Diverged {
        /// Name of the body or wheelset.
        body: String,
        /// Its coordinate.
        coordinate: &'static str,
        /// Value of the coordinate, m or rad; `None` if it is no finite number.
        value: Option<f64>,
        /// Time and place.
        #[serde(flatten)]
        place: Place,
    },
    /// The run ended as `apparent` says, but not with shorter steps: a fault of the integration, not of the vehicle.
    Numerical {
        /// How the run seemed to end.
        apparent: Box<Self>,
        /// Tick with which it goes on, s.
        shorter_step_s: f64,
    },
    /// An external damper stopped delivering forces.
    OutsideLost {
        /// Which dampers, why, since when, and the forces used meanwhile.
        #[serde(flatten)]
        loss: OutsideLoss,
        /// Time and place.
        #[serde(flatten)]
        place: Place,
    },
    /// The guard of a hybrid test ended it, and the command of the actuator has come to rest.
    GuardEnded {
        /// Name of the damper on the rig.
        damper: String,
        /// What the guard saw.
        reasons: Vec<String>,
        /// Time at which the guard acted, s.
        guarded_s: f64,
        /// Time and place at which the command had come to rest.
        #[serde(flatten)]
        place: Place,
    },
    /// The work of a tick took longer than allowed in real time.
    SlowTick {
        /// Number of the tick, from 0.
        tick: u64,
        /// Duration of its work, ns.
        work_ns: f64,
        /// Limit for the duration, ns.
        limit_ns: u64,
        /// Time and place.
        #[serde(flatten)]
        place: Place,
    },
    /// Interrupted by the user.
    Interrupted {
        /// Time and place.
        #[serde(flatten)]
        place: Place,
    },
}

impl Ending {
    /// True if the run has indices. A run that climbed, overturned, diverged, left the tables or went beyond the model
    /// has none.
    pub fn has_indices(&self) -> bool {
        matches!(
            self,
            Self::Completed
                | Self::Interrupted { .. }
                | Self::OutsideLost { .. }
                | Self::GuardEnded { .. }
                | Self::SlowTick { .. }
        )
    }

    /// Time and place of the ending; `None` if the run completed.
    pub fn place(&self) -> Option<Place> {
        match self {
            Self::Completed => None,
            Self::Numerical { apparent, .. } => apparent.place(),
            Self::Overturned { place, .. }
            | Self::Climbed { place, .. }
            | Self::OutsideTables { place, .. }
            | Self::BeyondModel { place, .. }
            | Self::Diverged { place, .. }
            | Self::OutsideLost { place, .. }
            | Self::GuardEnded { place, .. }
            | Self::SlowTick { place, .. }
            | Self::Interrupted { place } => Some(*place),
        }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { time_s, distance_m } = self;
        write!(f, "at {time_s:.3} s, {distance_m:.1} m along the track")
    }
}

impl fmt::Display for Ending {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Completed => write!(f, "completed"),
            Self::Overturned {
                side,
                unloaded_wheels,
                wheels,
                wheelset,
                roll_rad,
                place,
            } => write!(
                f,
                "overturned to the {side} {place}: {unloaded_wheels} of {wheels} wheels on the other side carry no \
                 load, {wheelset} is tilted by {:.0} mrad",
                1e3 * roll_rad.abs()
            ),
            Self::Climbed {
                wheelset,
                side,
                derailment,
                load_n,
                lateral_m,
                yaw_rad,
                place,
            } => write!(
                f,
                "derailed {place}: the flange of {wheelset}, {side}, climbed over the rail with Y/Q {derailment:.2}, \
                 load {:.0} kN, lateral {:.1} mm and yaw {:.1} mrad",
                1e-3 * load_n,
                1e3 * lateral_m,
                1e3 * yaw_rad
            ),
            Self::OutsideTables {
                wheelset,
                side,
                lateral_m,
                roll_rad,
                yaw_rad,
                place,
            } => write!(
                f,
                "left the tables of the contact {place}: {wheelset}, {side} wheel, with lateral {:.1} mm, roll {:.1} \
                 mrad and yaw {:.1} mrad",
                1e3 * lateral_m,
                1e3 * roll_rad,
                1e3 * yaw_rad
            ),
            Self::BeyondModel {
                wheelset,
                side,
                load_n,
                load_static_n,
                place,
            } => write!(
                f,
                "beyond the model {place}: {wheelset}, {side} wheel: load {:.0} kN, {:.0} times the static load; \
                 allowed: {END_LOAD_RATIO:.0} times",
                1e-3 * load_n,
                load_n / load_static_n
            ),
            Self::Diverged {
                body,
                coordinate,
                value,
                place,
            } => {
                write!(f, "diverged {place}: {body}, {coordinate} ")?;
                match value {
                    Some(value) => write!(f, "{value:.3e}"),
                    None => write!(f, "not a number"),
                }
            }
            Self::Numerical {
                apparent,
                shorter_step_s,
            } => write!(
                f,
                "numerically diverged: with a step of {:.0} us the run goes on; use a shorter step. It seemed to end \
                 like this: {apparent}",
                1e6 * shorter_step_s
            ),
            Self::OutsideLost { loss, place } => {
                write!(f, "an external damper was lost {place}: {loss}")
            }
            Self::GuardEnded {
                damper,
                reasons,
                guarded_s,
                place,
            } => write!(
                f,
                "the guard of {damper} ended the test at {guarded_s:.3} s, and the command came to rest {place}: {}",
                reasons.join("; ")
            ),
            Self::SlowTick {
                tick,
                work_ns,
                limit_ns,
                place,
            } => write!(
                f,
                "stopped {place}: the work of tick {tick} took {:.1} us; allowed: {:.1} us",
                1e-3 * work_ns,
                1e-3 * *limit_ns as f64
            ),
            Self::Interrupted { place } => write!(f, "interrupted {place}"),
        }
    }
}
