//! Tables of a fleet: one row per recording, and one row per damper and parameter.

use dashpot_core::health::{Estimate, HealthReading};
use serde::Serialize;

use super::axis::Axis;
use super::fleet::{DamperTrends, Fleet, Trend};
use super::forecast::Forecast;
use super::parameter::Parameter;
use super::reading::Recorded;

/// Columns of both tables that are text, even if all cells look like numbers.
pub const TEXTS: [&str; 12] = [
    "vehicle",
    "damper",
    "serial_number",
    "kind",
    "date",
    "file",
    "status",
    "used_for",
    "refused_because",
    "parameter",
    "rate_per",
    "verdict",
];

/// A date, or a number of km.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Place {
    /// Date.
    Date(String),
    /// Mileage (km).
    Mileage(f64),
}

/// Row of a recording. Columns of the reading are empty if there is none.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[allow(missing_docs)]
pub struct ReadingRow {
    pub vehicle: String,
    pub damper: String,
    pub serial_number: String,
    pub kind: String,
    pub date: String,
    pub mileage_km: Option<f64>,
    pub temperature_c: Option<f64>,
    pub file: String,
    pub damping_factor: Option<f32>,
    pub damping_factor_sd: Option<f32>,
    pub stiffness_n_per_m: Option<f32>,
    pub stiffness_sd_n_per_m: Option<f32>,
    pub compliance_m_per_n: Option<f32>,
    pub compliance_sd_m_per_n: Option<f32>,
    pub clearance_m: Option<f32>,
    pub clearance_sd_m: Option<f32>,
    pub lag_s: Option<f32>,
    pub force_zero_n: Option<f32>,
    pub samples: Option<u32>,
    pub rejected: Option<u32>,
    /// Status bits of the estimator, separated by spaces.
    pub status: String,
    /// True if no status bit casts doubt on the reading.
    pub trusted: bool,
    /// Parameters whose trends use the reading, separated by spaces.
    pub used_for: String,
    /// Why the reading is not used.
    pub refused_because: String,
}

/// Row of a parameter of a damper, in SI units.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[allow(missing_docs)]
pub struct TrendRow {
    /// 1 for the damper to look at first.
    pub rank: usize,
    pub vehicle: String,
    pub damper: String,
    pub serial_number: String,
    pub kind: &'static str,
    pub installed: bool,
    pub parameter: &'static str,
    /// Number of readings used.
    pub readings: usize,
    /// Number of recordings of the damper that are not used.
    pub refused: usize,
    pub first: Option<Place>,
    pub last: Option<Place>,
    /// Value at the last reading, according to the line.
    pub value: Option<f64>,
    pub value_low: Option<f64>,
    pub value_high: Option<f64>,
    pub rate: Option<f64>,
    pub rate_low: Option<f64>,
    pub rate_high: Option<f64>,
    /// `year` or `100 000 km`.
    pub rate_per: &'static str,
    /// Probability of such a rate if nothing changed.
    pub p_value: Option<f64>,
    /// Standard deviation between recordings.
    pub scatter: Option<f64>,
    pub limit: Option<f64>,
    /// `beyond`, `probably_beyond`, `reached`, `no_wear_seen`, `no_limit` or `too_few_readings`.
    pub verdict: &'static str,
    /// When the line reaches the limit.
    pub limit_at: Option<Place>,
    /// Start of the confidence interval; without wear, the first place at which the limit may be reached.
    pub limit_earliest: Option<Place>,
    pub limit_latest: Option<Place>,
}

impl ReadingRow {
    fn new(recorded: &Recorded) -> Self {
        let listed = &recorded.listed;
        let mut row = Self {
            vehicle: listed.vehicle.clone(),
            damper: listed.damper.clone(),
            serial_number: listed.serial_number.clone(),
            kind: listed.kind.name().into(),
            date: listed
                .date
                .map_or_else(String::new, |date| date.to_string()),
            mileage_km: listed.mileage_km,
            temperature_c: listed.temperature_c,
            file: listed.file.display().to_string(),
            refused_because: recorded
                .refusal
                .as_ref()
                .map_or_else(String::new, |refusal| refusal.reason().into()),
            ..Self::default()
        };
        if let Some((reading, model)) = &recorded.reading {
            row.fill(reading);
            if recorded.refusal.is_none() {
                let known = Parameter::ALL
                    .into_iter()
                    .filter(|parameter| parameter.fitted(reading, model).is_some());
                row.used_for = known.map(Parameter::name).collect::<Vec<_>>().join(" ");
            }
        }
        row
    }

    fn fill(&mut self, reading: &HealthReading) {
        let parts = |estimate: Estimate| (Some(estimate.value), Some(estimate.sd));
        (self.damping_factor, self.damping_factor_sd) = parts(reading.damping_factor());
        (self.stiffness_n_per_m, self.stiffness_sd_n_per_m) = parts(reading.stiffness_n_per_m);
        (self.compliance_m_per_n, self.compliance_sd_m_per_n) = parts(reading.compliance_m_per_n);
        (self.clearance_m, self.clearance_sd_m) = parts(reading.clearance_m);
        self.lag_s = Some(reading.lag_s.value);
        self.force_zero_n = Some(reading.force_zero_n.value);
        self.samples = Some(reading.samples);
        self.rejected = Some(reading.rejected);
        let names = reading
            .status
            .iter_names()
            .map(|(name, _)| name.to_lowercase());
        self.status = names.collect::<Vec<_>>().join(" ");
        self.trusted = reading.is_trusted();
    }
}

impl TrendRow {
    fn new(rank: usize, damper: &DamperTrends, trend: &Trend, axis: Axis) -> Self {
        let place = |x: f64| match axis {
            Axis::Date => Place::Date(axis.label(x)),
            Axis::Mileage => Place::Mileage(x),
        };
        let is_shown = |x: &f64| {
            trend
                .last()
                .is_some_and(|last| *x <= last + axis.horizon().0)
        };
        let shown = |x: Option<f64>| x.filter(is_shown).map(place);
        let (verdict, at, earliest, latest) = match (trend.forecast, trend.line) {
            (None, None) => ("too_few_readings", None, None, None),
            (None, Some(_)) => ("no_limit", None, None, None),
            (Some(forecast), _) => match forecast {
                Forecast::Beyond {
                    since,
                    is_sure: true,
                } => ("beyond", since, None, None),
                Forecast::Beyond { since, .. } => ("probably_beyond", since, None, None),
                Forecast::Reached {
                    at,
                    earliest,
                    latest,
                } => ("reached", Some(at), Some(earliest), Some(latest)),
                Forecast::NotInSight { earliest } => ("no_wear_seen", None, earliest, None),
            },
        };
        let [vehicle, position, serial_number] = damper.name();
        let (now, rate) = (trend.now(), trend.rate(axis));
        // The scatter is that of the fitted quantity; a small one of the parameter is in proportion, as its rate is.
        let scatter = trend.line.and_then(|line| {
            let slope = trend.parameter.shown_rate(
                line.at(trend.last()?).value,
                super::fit::Interval::around(line.scatter, 0.0),
            );
            Some(slope.value.abs())
        });
        Self {
            rank,
            vehicle: vehicle.into(),
            damper: position.into(),
            serial_number: serial_number.into(),
            kind: damper.kind().name(),
            installed: damper.is_installed,
            parameter: trend.parameter.column(),
            readings: trend.points.len(),
            refused: damper.recorded.len() - damper.used(),
            first: trend.points.first().map(|point| place(point.x)),
            last: trend.last().map(place),
            value: now.map(|now| now.value),
            value_low: now.map(|now| now.low),
            value_high: now.map(|now| now.high),
            rate: rate.map(|rate| rate.value),
            rate_low: rate.map(|rate| rate.low),
            rate_high: rate.map(|rate| rate.high),
            rate_per: axis.rate_unit().0,
            p_value: trend.line.map(|line| line.p_value()),
            scatter,
            limit: trend.limit.map(|limit| trend.parameter.shown(limit.value)),
            verdict,
            limit_at: shown(at),
            limit_earliest: shown(earliest),
            limit_latest: shown(latest),
        }
    }
}

impl Fleet {
    /// Returns a row for each recording, damper by damper.
    pub fn reading_rows(&self) -> Vec<ReadingRow> {
        self.recorded().map(ReadingRow::new).collect()
    }

    /// Returns a row for each parameter of each damper, the most urgent damper first. A date or mileage beyond the
    /// horizon is left out.
    pub fn trend_rows(&self) -> Vec<TrendRow> {
        let ranked = self.dampers.iter().zip(1..);
        let rows = ranked.flat_map(|(damper, rank)| {
            damper
                .trends
                .iter()
                .map(move |trend| TrendRow::new(rank, damper, trend, self.axis))
        });
        rows.collect()
    }
}

/// Returns rows as CSV with a header.
///
/// # Errors
/// A row cannot be written.
pub fn csv(rows: &[impl Serialize]) -> Result<Vec<u8>, csv::Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer.serialize(row)?;
    }
    writer
        .into_inner()
        .map_err(|error| error.into_error().into())
}
