//! Motion of a rigid body from its accelerometers.

use dashpot_rail::vehicle::Body;
use nalgebra::{DMatrix, DVector, SymmetricEigen};

use super::error::SensorsError;
use super::layout::Layout;
use super::readings::{Axis, Readings};

/// Share of another motion that may pass for the wanted one.
const MAX_MIXED: f64 = 1e-6;
/// Minimum eigenvalue of the normal equations, as a share of the largest.
const MIN_EIGENVALUE: f64 = 1e-12;

/// Weights by which readings become the motion of the three bodies.
pub(super) struct Sensors {
    /// Names of the sensors used.
    pub names: Vec<String>,
    pub bodies: [BodySensors; 3],
}

/// Weights of one body's sensors.
pub(super) struct BodySensors {
    /// Vertical sensors, by their column, and their weight in the roll acceleration (1/m).
    pub roll: Vec<(usize, f64)>,
    pub lateral: Vec<LateralSensor>,
}

/// A lateral sensor.
pub(super) struct LateralSensor {
    pub column: usize,
    /// Height above the centre of gravity (m).
    pub above_m: f64,
    /// Weight in the reading at the centre of gravity.
    pub middle: f64,
    /// Weight in the yaw acceleration (1/m).
    pub yaw: f64,
}

impl Sensors {
    /// Finds the sensors of the body and both bogies among the readings.
    pub fn of(layout: &Layout, readings: &Readings) -> Result<Self, SensorsError> {
        let too_few = |body: &Body, motion: &'static str| SensorsError::TooFew {
            recording: readings.name.clone(),
            body: body.name.clone(),
            motion,
        };
        let mut names = Vec::new();
        let mut of_body = |body: &Body| {
            let mut places = [Vec::new(), Vec::new()];
            for (column, sensor) in readings.sensors.iter().enumerate() {
                let is_it = |point: &&dashpot_rail::vehicle::RidePoint| {
                    point.name == sensor.point && point.on == body.name
                };
                if let Some(point) = layout.ride_points.iter().find(is_it) {
                    let [x, y, height] = point.at_m;
                    let at = [x - body.x_m, y, height - body.height_m];
                    places[usize::from(sensor.axis == Axis::Vertical)].push((column, at));
                    names.push(sensor.name());
                }
            }
            let [lateral, vertical] = places;
            // Readings: vertical + roll y - pitch x, and lateral + yaw x.
            let roll = weights(&vertical, |[x, y, _]| vec![1.0, -x, y], 2);
            let middle = weights(&lateral, |[x, _, _]| vec![1.0, x], 0);
            let yaw = weights(&lateral, |[x, _, _]| vec![1.0, x], 1);
            let roll = roll.ok_or_else(|| too_few(body, "roll"))?;
            let middle = middle.ok_or_else(|| too_few(body, "lateral motion"))?;
            let yaw = yaw.ok_or_else(|| too_few(body, "yaw"))?;
            let lateral = lateral.iter().zip(middle).zip(yaw);
            let lateral = lateral.map(|(((column, at), middle), yaw)| LateralSensor {
                column: *column,
                above_m: at[2],
                middle,
                yaw,
            });
            Ok(BodySensors {
                roll: vertical
                    .iter()
                    .map(|(column, _)| *column)
                    .zip(roll)
                    .collect(),
                lateral: lateral.collect(),
            })
        };
        let [body, front, rear] = layout.bodies.each_ref().map(&mut of_body);
        let bodies = [body?, front?, rear?];
        Ok(Self { names, bodies })
    }
}

/// Returns the weight of each reading in one unknown by least squares; `None` if the readings do not determine it.
fn weights(
    sensors: &[(usize, [f64; 3])],
    row: impl Fn([f64; 3]) -> Vec<f64>,
    unknown: usize,
) -> Option<Vec<f64>> {
    let rows: Vec<_> = sensors
        .iter()
        .map(|(_, at)| DVector::from_vec(row(*at)).transpose())
        .collect();
    if rows.is_empty() {
        return None;
    }
    let matrix = DMatrix::from_rows(&rows);
    // The pseudo-inverse from the eigenvalues of the normal equations; those near zero are omitted.
    let mut eigen = SymmetricEigen::new(matrix.transpose() * &matrix);
    let least = MIN_EIGENVALUE * eigen.eigenvalues.amax();
    for value in eigen.eigenvalues.iter_mut() {
        *value = if *value > least { value.recip() } else { 0.0 };
    }
    let inverse = eigen.recompose() * matrix.transpose();
    let weights = inverse.row(unknown);
    let mut passed = weights * &matrix;
    passed[unknown] -= 1.0;
    (passed.amax() < MAX_MIXED).then(|| weights.iter().copied().collect())
}

#[cfg(test)]
mod tests {
    use super::weights;

    #[test]
    fn roll_needs_sensors_that_pitch_does_not_move() {
        let roll = |places: &[[f64; 2]]| {
            let sensors: Vec<_> = places.iter().map(|[x, y]| (0, [*x, *y, 0.0])).collect();
            weights(&sensors, |[x, y, _]| vec![1.0, -x, y], 2)
        };
        let close = |one: Option<Vec<f64>>, other: &[f64]| {
            let one = one.unwrap();
            assert!(
                one.iter()
                    .zip(other)
                    .all(|(one, other)| (one - other).abs() < 1e-12),
                "{one:?}"
            );
        };
        close(roll(&[[0.0, -1.2], [0.0, 1.2]]), &[-1.0 / 2.4, 1.0 / 2.4]);
        assert_eq!(roll(&[[-1.0, -1.2], [1.0, 1.2]]), None);
        close(
            roll(&[[-1.0, -1.2], [1.0, 1.2], [-1.0, 1.2]]),
            &[-1.0 / 2.4, 0.0, 1.0 / 2.4],
        );
        assert_eq!(roll(&[]), None);
    }
}
