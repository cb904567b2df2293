//! Errors of the evaluation of a vehicle's sensors.

use thiserror::Error;

use super::limits::{MAX_UNEXPLAINED, MIN_DURATION_S, MIN_RATE_HZ, MIN_SECONDS, MIN_SPARE_SECONDS};

/// Why the sensors of a vehicle cannot be evaluated.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SensorsError {
    /// The vehicle is not one body on two bogies with lateral dampers between them.
    #[error("{found}; allowed: lateral dampers between one body and two bogies")]
    Vehicle {
        /// What was found.
        found: String,
    },
    /// A body's sensors do not determine its motion.
    #[error(
        "{recording}: the sensors on {body} do not determine its {motion}; needed: two lateral sensors at different x, \
         and two vertical ones at the same x and different y, on the body and on each bogie"
    )]
    TooFew {
        /// Name of the recording.
        recording: String,
        /// Name of the body.
        body: String,
        /// The motion that is not determined.
        motion: &'static str,
    },
    /// A sensor always reads the same.
    #[error("{recording}: {sensor} always reads {value} m/s^2; allowed: a working sensor")]
    Dead {
        /// Name of the recording.
        recording: String,
        /// Name of the sensor.
        sensor: String,
        /// The reading (m/s^2).
        value: f64,
    },
    /// A reading is missing.
    #[error("{recording}: {sensor} has no reading at {time_s} s; allowed: readings without gaps")]
    Missing {
        /// Name of the recording.
        recording: String,
        /// Name of the sensor.
        sensor: String,
        /// Time (s).
        time_s: f64,
    },
    /// Times are not equally spaced.
    #[error(
        "{recording}: {step_s:.6} s between two rows at {time_s:.6} s; allowed: equal steps, here {usual_s:.6} s"
    )]
    Steps {
        /// Name of the recording.
        recording: String,
        /// Time (s).
        time_s: f64,
        /// Step there (s).
        step_s: f64,
        /// Usual step (s).
        usual_s: f64,
    },
    /// The rate of the readings is too low.
    #[error("{recording}: {rate_hz:.1} rows per second; allowed: at least {MIN_RATE_HZ}")]
    Rate {
        /// Name of the recording.
        recording: String,
        /// Rate (Hz).
        rate_hz: f64,
    },
    /// A recording is too short.
    #[error("{recording}: {duration_s:.1} s; allowed: at least {MIN_DURATION_S} s of ride")]
    Short {
        /// Name of the recording.
        recording: String,
        /// Duration (s).
        duration_s: f64,
    },
    /// Recordings have different sensors.
    #[error("{recording} has the sensors {}, and the others have {}; allowed: the same sensors", sensors.join(", "),
        others.join(", "))]
    OtherSensors {
        /// Name of the recording.
        recording: String,
        /// Its sensors.
        sensors: Vec<String>,
        /// Sensors of the other recordings.
        others: Vec<String>,
    },
    /// A damper's parameters are invalid at the step of the evaluation.
    #[error("{damper}: {reason}")]
    Damper {
        /// Name of the damper.
        damper: String,
        /// The reason.
        reason: String,
    },
    /// There are too few seconds of ride.
    #[error(
        "{blocks} usable seconds, and {at_stop} with the body at a lateral stop; allowed: at least {} usable ones",
        MIN_SECONDS.max(*factors + MIN_SPARE_SECONDS)
    )]
    TooFewSeconds {
        /// Seconds of ride that can be used.
        blocks: usize,
        /// Number of factors.
        factors: usize,
        /// Seconds left out because the body reached a lateral stop.
        at_stop: usize,
    },
    /// The ride does not determine the factors.
    #[error(
        "the ride does not determine the factor of {factor}; allowed: a ride that moves the body on its bogies"
    )]
    Undetermined {
        /// Name of the factor.
        factor: String,
    },
    /// The balance does not explain the runs of the baseline.
    #[error(
        "the balance of forces leaves {:.1} % unexplained; allowed in a baseline: {:.0} %: check the vehicle file, and \
         the places, signs and times of the sensors",
        100.0 * unexplained,
        100.0 * MAX_UNEXPLAINED
    )]
    Unexplained {
        /// Share of the squares that is left.
        unexplained: f64,
    },
    /// A factor of the baseline is not positive.
    #[error(
        "the factor of {factor} is {value:.2}; allowed in a baseline: above 0: check the vehicle file and the sensors"
    )]
    NotPositive {
        /// Name of the factor.
        factor: String,
        /// Its value.
        value: f64,
    },
    /// The baseline is not a valid one.
    #[error("the baseline is damaged: {what}")]
    Damaged {
        /// What is wrong.
        what: &'static str,
    },
    /// The baseline belongs to another vehicle or other sensors.
    #[error(
        "the baseline has another {what}: {baseline}, not {now}; allowed: the same vehicle file and sensors"
    )]
    OtherBaseline {
        /// What differs.
        what: &'static str,
        /// In the baseline.
        baseline: String,
        /// In the recordings.
        now: String,
    },
}
