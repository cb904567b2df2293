//! The shipped recording on a tick grid.

use serde::Deserialize;

use crate::failure::{Failure, Outcome};

const RIDE: &str = include_str!("../../../data/excitations/ride_made.csv");

#[derive(Deserialize)]
struct Sample {
    time_s: f64,
    displacement_m: f64,
}

/// A recorded motion.
pub struct Recording(Vec<Sample>);

impl Recording {
    /// The shipped ride.
    ///
    /// # Errors
    /// The file in the program is not as it was shipped.
    pub fn shipped() -> Outcome<Self> {
        let samples = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .from_reader(RIDE.trim_start_matches('\u{feff}').as_bytes())
            .deserialize()
            .collect::<Result<Vec<Sample>, _>>()
            .map_err(|error| Failure::new(format!("ride_made.csv: {error}")))?;
        if samples.len() < 2 {
            return Err(Failure::new("ride_made.csv: fewer than two samples"));
        }
        Ok(Self(samples))
    }

    /// Number of samples.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Length [s].
    pub fn duration_s(&self) -> f64 {
        self.0[self.0.len() - 1].time_s - self.0[0].time_s
    }

    /// Times [s] and displacements [m] at ticks of `step_s` from the first sample, linear between samples.
    pub fn at_ticks(&self, step_s: f64) -> (Vec<f64>, Vec<f64>) {
        let start = self.0[0].time_s;
        let ticks = (self.duration_s() / step_s + 1e-9).floor() as usize;
        let mut cell = 0;
        (0..=ticks)
            .map(|tick| {
                let time = tick as f64 * step_s;
                while cell + 2 < self.0.len() && self.0[cell + 1].time_s - start < time {
                    cell += 1;
                }
                let (from, to) = (&self.0[cell], &self.0[cell + 1]);
                let share = (time - (from.time_s - start)) / (to.time_s - from.time_s);
                let x = from.displacement_m + share * (to.displacement_m - from.displacement_m);
                (time, x)
            })
            .unzip()
    }
}
