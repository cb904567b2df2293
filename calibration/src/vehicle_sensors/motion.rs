//! Motion of the body and its bogies, from readings integrated twice without delay.

use dashpot_rail::vehicle::GRAVITY_M_PER_S2;

use super::rigid::{BodySensors, Sensors};
use super::transform::Spectrum;

/// Corner of the high pass (Hz), below which errors of the sensors dominate.
const HIGH_PASS_HZ: f64 = 0.3;
/// Ramps of the window (s).
const RAMP_S: f64 = 2.0;

/// Motion of one body.
pub(super) struct Rigid {
    /// Lateral reading at the centre of gravity: acceleration less `g` times roll (m/s^2).
    pub reading: Spectrum,
    /// Lateral displacement of the centre of gravity (m).
    pub lateral: Spectrum,
    /// Roll (rad).
    pub roll: Spectrum,
    /// Yaw acceleration (rad/s^2).
    pub yaw_acceleration: Spectrum,
    /// Yaw (rad).
    pub yaw: Spectrum,
}

/// Returns the motion of the body, the front and the rear bogie over one piece of a recording.
pub(super) fn motion(
    sensors: &Sensors,
    duration_s: f64,
    columns: &[&[f64]],
    has_gravity: bool,
) -> [Rigid; 3] {
    let spectra: Vec<Spectrum> = columns
        .iter()
        .map(|values| windowed(values, duration_s))
        .collect();
    sensors
        .bodies
        .each_ref()
        .map(|body| rigid(body, &spectra, has_gravity))
}

/// Returns the spectrum of the readings without their mean, with ramps at both ends and without low frequencies.
fn windowed(values: &[f64], duration_s: f64) -> Spectrum {
    let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
    let ramp = RAMP_S / duration_s * values.len() as f64;
    let weight = |row: usize| {
        let from_end = row.min(values.len() - 1 - row) as f64;
        match from_end < ramp {
            true => 0.5 - 0.5 * (std::f64::consts::PI * from_end / ramp).cos(),
            false => 1.0,
        }
    };
    let signal = values
        .iter()
        .enumerate()
        .map(|(row, value)| weight(row) * (value - mean));
    Spectrum::of(signal.collect(), duration_s).scaled(high_pass)
}

fn high_pass(w: f64) -> f64 {
    let ratio = std::f64::consts::TAU * HIGH_PASS_HZ / w.max(1e-9);
    1.0 / (1.0 + ratio.powi(4))
}

/// Response of two integrations.
fn twice(w: f64) -> f64 {
    -1.0 / w.max(1e-9).powi(2)
}

fn rigid(sensors: &BodySensors, spectra: &[Spectrum], has_gravity: bool) -> Rigid {
    let weighted = |weights: &[(f64, &Spectrum)]| match weights {
        [(own, first), others @ ..] => first.sum(*own, others),
        [] => Spectrum::of(Vec::new(), 1.0),
    };
    let vertical: Vec<_> = sensors
        .roll
        .iter()
        .map(|(column, weight)| (*weight, &spectra[*column]))
        .collect();
    let roll_acceleration = weighted(&vertical);
    let level = |sensor: &super::rigid::LateralSensor| {
        spectra[sensor.column].sum(1.0, &[(-sensor.above_m, &roll_acceleration)])
    };
    let levelled: Vec<_> = sensors.lateral.iter().map(level).collect();
    let lateral = |weight: fn(&super::rigid::LateralSensor) -> f64| {
        let weights: Vec<_> = sensors.lateral.iter().map(weight).zip(&levelled).collect();
        weighted(&weights)
    };
    let (reading, yaw_acceleration) = (
        lateral(|sensor| sensor.middle),
        lateral(|sensor| sensor.yaw),
    );
    let roll = roll_acceleration.scaled(twice);
    // The high pass acts on the roll once more, because the lateral acceleration is integrated twice again.
    let gravity = roll.scaled(|w| GRAVITY_M_PER_S2 * high_pass(w));
    let (reading, lateral) = match has_gravity {
        true => (reading.clone(), reading.sum(1.0, &[(1.0, &gravity)])),
        false => (reading.sum(1.0, &[(-GRAVITY_M_PER_S2, &roll)]), reading),
    };
    Rigid {
        lateral: lateral.scaled(twice),
        yaw: yaw_acceleration.scaled(twice),
        reading,
        roll,
        yaw_acceleration,
    }
}
