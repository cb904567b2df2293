//! Reads measured tracks from CSV files.
//!
//! The first row names the columns, in any order: `distance_m`, and one or more of `vertical`, `lateral`, `cross_level`
//! and `gauge`, each with the unit `_m` or `_mm`. Signs are those of [`Channels`](super::Channels): vertical positive
//! downward, lateral to the right, cross level with the left rail higher, gauge wider. A line that starts with `#` is a
//! comment. Distances must rise; intervals need not be equal.

mod error;
mod rows;

pub use error::MeasuredTrackError;

use super::MAX_SAMPLES;
use super::error::{Place, TrackError, within};
use super::irregularity::Irregularity;
use crate::math::spline::Spline;

/// Minimum number of rows.
pub const MIN_ROWS: usize = 8;
/// Minimum distance between neighbouring rows, m.
pub const MIN_INTERVAL_M: f64 = 0.01;
/// Maximum distance between neighbouring rows, m. Rows further apart do not resolve the wavelengths that excite a
/// vehicle.
pub const MAX_INTERVAL_M: f64 = 5.0;

/// Options for reading a file.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// Distance added to all distances of the file, m.
    pub shift_m: f64,
    /// Length of the ramp at each end, m, as in [`Generation`](super::Generation).
    pub ramp_m: f64,
    /// Distance between samples, m. `None` selects the shortest interval of the file.
    pub spacing_m: Option<f64>,
}

impl Default for Options {
    /// Keeps the distances and intervals of the file, and sets ramps of 10 m.
    fn default() -> Self {
        Self {
            shift_m: 0.0,
            ramp_m: 10.0,
            spacing_m: None,
        }
    }
}

impl Options {
    /// Sets the distance added to all distances of the file, m.
    #[must_use]
    pub const fn with_shift_m(mut self, shift_m: f64) -> Self {
        self.shift_m = shift_m;
        self
    }

    /// Sets the length of the ramp at each end, m.
    #[must_use]
    pub const fn with_ramp_m(mut self, ramp_m: f64) -> Self {
        self.ramp_m = ramp_m;
        self
    }

    /// Sets the distance between samples, m; `None` selects the shortest interval of the file.
    #[must_use]
    pub const fn with_spacing_m(mut self, spacing_m: Option<f64>) -> Self {
        self.spacing_m = spacing_m;
        self
    }
}

/// Contents of a file.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Reading {
    /// Number of data rows.
    pub rows: usize,
    /// First and last distance in the file, m.
    pub distances_m: [f64; 2],
    /// Channels in the file. The others are zero.
    pub channels: ChannelsRead,
}

/// Channels that a file contains.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct ChannelsRead {
    /// True if the file has the vertical profile.
    pub vertical: bool,
    /// True if the file has the alignment.
    pub lateral: bool,
    /// True if the file has the cross level.
    pub cross_level: bool,
    /// True if the file has the gauge.
    pub gauge: bool,
}

/// Reads the deviations of a track from the `text` of a file.
///
/// A natural cubic spline through the rows is sampled at equal distances. The result is ramped at both ends and zero
/// beyond them.
///
/// # Errors
/// - a missing, unknown or duplicate column, or a row with the wrong number of cells;
/// - a cell that is not a number, or a deviation above 0.5 m;
/// - fewer than [`MIN_ROWS`] rows, or an interval outside [`MIN_INTERVAL_M`] to [`MAX_INTERVAL_M`];
/// - a spacing outside these bounds, or a ramp shorter than the spacing or longer than half the file.
///
/// ```
/// use dashpot_rail::track::measured::{self, Options};
/// let mut text = String::from("distance_m,vertical_mm,cross_level_mm\n");
/// for i in 0..400 {
///     let distance_m = 1200.0 + 0.25 * f64::from(i);
///     text += &format!("{distance_m},{:.3},1.5\n", 4.0 * (0.5 * distance_m).sin());
/// }
/// let (irregularity, reading) = measured::parse(&text, &Options::default())?;
/// assert_eq!(reading.rows, 400);
/// assert!(reading.channels.cross_level && !reading.channels.gauge);
/// let [left, right] = irregularity.at(1250.1);
/// let middle_m = 4e-3 * (0.5_f64 * 1250.1).sin();
/// assert!((left.vertical_m - (middle_m - 0.75e-3)).abs() < 2e-6);
/// assert!((right.vertical_m - (middle_m + 0.75e-3)).abs() < 2e-6);
///
/// let error = measured::parse("distance_m,gauge_m\n0,1\n", &Options::default()).unwrap_err();
/// assert_eq!((error.line(), error.column()), (Some(2), Some("gauge_m")));
/// # Ok::<(), measured::MeasuredTrackError>(())
/// ```
pub fn parse(text: &str, options: &Options) -> Result<(Irregularity, Reading), MeasuredTrackError> {
    let (rows, channels) = rows::read(text.trim_start_matches('\u{feff}'))?;
    let mut min_m = MAX_INTERVAL_M;
    for pair in rows.windows(2) {
        let interval_m = pair[1].distance_m - pair[0].distance_m;
        // The tolerance allows for the rounding of decimal distances.
        if !(MIN_INTERVAL_M - 1e-8..=MAX_INTERVAL_M + 1e-8).contains(&interval_m) {
            return Err(MeasuredTrackError::Interval {
                line: pair[1].line,
                interval_m,
            });
        }
        min_m = min_m.min(interval_m);
    }
    if rows.len() < MIN_ROWS {
        return Err(MeasuredTrackError::TooFewRows { found: rows.len() });
    }
    let first_m = rows[0].distance_m;
    let length_m = rows[rows.len() - 1].distance_m - first_m;
    let place = Place::Irregularity;
    within(place, "shift_m", options.shift_m, [-1e7, 1e7])?;
    let spacing_m = options.spacing_m.unwrap_or(min_m.max(MIN_INTERVAL_M));
    within(
        place,
        "spacing_m",
        spacing_m,
        [MIN_INTERVAL_M, MAX_INTERVAL_M],
    )?;
    within(place, "ramp_m", options.ramp_m, [spacing_m, 0.5 * length_m])?;
    // A whole number of intervals, so that the last sample is the last row.
    let intervals = (length_m / spacing_m).round().max(1.0);
    if intervals >= MAX_SAMPLES as f64 {
        let samples = intervals + 1.0;
        return Err(TrackError::TooManySamples { place, samples }.into());
    }
    let spacing_m = length_m / intervals;
    let mut samples = vec![[0.0; 4]; intervals as usize + 1];
    let knots: Vec<f64> = rows.iter().map(|row| row.distance_m - first_m).collect();
    for channel in (0..4).filter(|channel| channels[*channel]) {
        let values: Vec<f64> = rows.iter().map(|row| row.deviations_m[channel]).collect();
        let spline = Spline::fit(&knots, &values, 0.0);
        for (i, sample) in samples.iter_mut().enumerate() {
            sample[channel] = spline.at(spacing_m * i as f64)[0];
        }
    }
    let start_m = first_m + options.shift_m;
    let irregularity = Irregularity::through(start_m, spacing_m, options.ramp_m, &samples);
    let [vertical, lateral, cross_level, gauge] = channels;
    let reading = Reading {
        rows: rows.len(),
        distances_m: [first_m, first_m + length_m],
        channels: ChannelsRead {
            vertical,
            lateral,
            cross_level,
            gauge,
        },
    };
    Ok((irregularity, reading))
}
