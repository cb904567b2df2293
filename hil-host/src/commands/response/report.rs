//! Report of `dashpot response`.

use std::io::{self, Write};

use serde::Serialize;

use super::ResponseArguments;
use super::family::Member;
use crate::commands::failure::Outcome;
use dashpot_files::output;
use dashpot_files::study::format_number;
use dashpot_testbench::response::{Response, at_amplitude, linearised};
use dashpot_testbench::swept_sine::{self, WINDOW, WINDOW_CYCLES};

/// Method of computing a response.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Kind {
    Harmonic,
    Linearised,
    Swept,
}

impl Kind {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Harmonic => "harmonic",
            Self::Linearised => "linearised",
            Self::Swept => "swept",
        }
    }
}

/// Values at one frequency.
#[derive(Serialize)]
pub(super) struct Row {
    pub(super) frequency_hz: f64,
    pub(super) dynamic_stiffness_n_per_m: f64,
    /// `None` if there is no force.
    pub(super) loss_angle_deg: Option<f64>,
    pub(super) storage_n_per_m: f64,
    pub(super) loss_n_per_m: f64,
    pub(super) damping_n_s_per_m: f64,
    /// Relative difference of a swept value from the harmonic value.
    pub(super) difference: Option<f64>,
}

/// Values over frequency.
#[derive(Serialize)]
pub(super) struct Series {
    pub(super) response: Kind,
    /// Value of the compared parameter.
    pub(super) value: Option<f64>,
    /// Amplitude of the motion; `None` for the linearised damper.
    pub(super) amplitude_m: Option<f64>,
    /// Largest relative difference of swept values from harmonic values.
    pub(super) largest_difference: Option<f64>,
    pub(super) rows: Vec<Row>,
    #[serde(skip)]
    pub(super) responses: Vec<Response>,
}

/// Settings of the sweep.
#[derive(Serialize)]
pub(super) struct SweptSine {
    pub(super) octaves_per_minute: f64,
    pub(super) window: &'static str,
    pub(super) window_cycles: u32,
}

/// The whole report.
#[derive(Serialize)]
pub(super) struct Report {
    pub(super) damper: String,
    pub(super) overrides: Vec<String>,
    /// Key of the compared parameter.
    pub(super) over: Option<String>,
    pub(super) swept_sine: Option<SweptSine>,
    pub(super) series: Vec<Series>,
    files: Vec<String>,
}

impl Series {
    fn new(
        response: Kind,
        value: Option<f64>,
        responses: Vec<Response>,
        harmonic: &[Response],
    ) -> Self {
        let row = |(i, r): (usize, &Response)| Row {
            frequency_hz: r.frequency_hz,
            dynamic_stiffness_n_per_m: r.stiffness_n_per_m(),
            loss_angle_deg: r.loss_angle_deg(),
            storage_n_per_m: r.storage_n_per_m,
            loss_n_per_m: r.loss_n_per_m,
            damping_n_s_per_m: r.damping_n_s_per_m(),
            difference: harmonic.get(i).and_then(|other| r.difference_from(other)),
        };
        let rows: Vec<Row> = responses.iter().enumerate().map(row).collect();
        let amplitude_m = responses.first().map(|response| response.amplitude_m);
        Self {
            response,
            value,
            amplitude_m: amplitude_m.filter(|_| response != Kind::Linearised),
            largest_difference: rows
                .iter()
                .filter_map(|row| row.difference)
                .max_by(f64::total_cmp),
            rows,
            responses,
        }
    }

    /// Returns the label of a curve.
    pub(super) fn name(&self) -> String {
        let amplitude = match self.amplitude_m {
            Some(amplitude_m) => format!("{} mm", format_number(amplitude_m * 1e3)),
            None => self.response.name().to_owned(),
        };
        match self.value {
            Some(value) => format!("{}, {amplitude}", formatted(value)),
            None => amplitude,
        }
    }
}

/// Formats a parameter value, in scientific notation if it is very large or small.
pub(super) fn formatted(value: f64) -> String {
    match value.abs() {
        1e-2..1e4 | 0.0 => format_number(value),
        _ => format!("{value:e}"),
    }
}

impl Report {
    pub(super) fn new(
        arguments: &ResponseArguments,
        dampers: &[Member],
        frequencies_hz: &[f64],
    ) -> Outcome<Self> {
        let amplitudes = arguments.amplitude_m.iter().copied().map(Some);
        let amplitudes: Vec<Option<f64>> = amplitudes.chain([None]).collect();
        let wanted: Vec<(&Member, Option<f64>)> = dampers
            .iter()
            .flat_map(|member| amplitudes.iter().map(move |amplitude| (member, *amplitude)))
            .collect();
        let found = dashpot_workers::map(&wanted, |(Member { value, damper }, amplitude_m)| {
            let Some(amplitude_m) = *amplitude_m else {
                let responses = linearised(damper, frequencies_hz)?;
                return Ok(vec![Series::new(Kind::Linearised, *value, responses, &[])]);
            };
            let harmonic = at_amplitude(damper, amplitude_m, frequencies_hz)?;
            let mut series = Vec::new();
            if arguments.swept {
                let rate = arguments.octaves_per_minute;
                let swept = swept_sine::responses(damper, amplitude_m, frequencies_hz, rate)?;
                series.push(Series::new(Kind::Swept, *value, swept, &harmonic));
            }
            series.insert(0, Series::new(Kind::Harmonic, *value, harmonic, &[]));
            Outcome::Ok(series)
        })?;
        let files = arguments
            .files()
            .map(|path| output::name(path).display().to_string());
        Ok(Self {
            damper: arguments.damper.damper.clone(),
            overrides: arguments.damper.overrides.clone(),
            over: arguments.over.as_ref().map(|family| family.key.clone()),
            swept_sine: arguments.swept.then_some(SweptSine {
                octaves_per_minute: arguments.octaves_per_minute,
                window: WINDOW,
                window_cycles: WINDOW_CYCLES,
            }),
            series: found.into_iter().flatten().collect(),
            files: files.collect(),
        })
    }

    pub(super) fn print(out: &mut dyn Write, report: &Self) -> io::Result<()> {
        let damper = [std::slice::from_ref(&report.damper), &report.overrides].concat();
        writeln!(
            out,
            "{}: ratio of the first harmonics of force and displacement",
            damper.join(" ")
        )?;
        if let Some(key) = &report.over {
            writeln!(out, "for values of {key} and amplitudes of the motion")?;
        }
        writeln!(
            out,
            "\n  {:<24}{:<12}{:>10}{:>18}{:>12}{:>15}",
            "", "response", "frequency", "dynamic stiffness", "loss angle", "damping"
        )?;
        for series in &report.series {
            let last = series.rows.len() - 1;
            for at in [0, last / 2, last] {
                let row = &series.rows[at];
                let (name, kind) = match at {
                    0 if series.response == Kind::Linearised => (
                        series.value.map(formatted).unwrap_or_default(),
                        "linearised",
                    ),
                    0 => (series.name(), series.response.name()),
                    _ => (String::new(), ""),
                };
                let angle = row
                    .loss_angle_deg
                    .map_or("-".into(), |angle| format!("{angle:.2} deg"));
                writeln!(
                    out,
                    "  {name:<24}{kind:<12}{:>7.3} Hz{:>13.4} MN/m{angle:>12}{:>9.3} kN s/m",
                    row.frequency_hz,
                    row.dynamic_stiffness_n_per_m * 1e-6,
                    row.damping_n_s_per_m * 1e-3
                )?;
            }
            if let Some(largest) = series.largest_difference {
                writeln!(
                    out,
                    "  {:<24}differs from harmonic by at most {:.3} %",
                    "",
                    largest * 100.0
                )?;
            }
        }
        if let Some(sweep) = &report.swept_sine {
            writeln!(
                out,
                "\nswept: {} octaves per minute, {} window of {} cycles",
                sweep.octaves_per_minute, sweep.window, sweep.window_cycles
            )?;
        }
        if !report.files.is_empty() {
            writeln!(out, "\nwrote {}", report.files.join(", "))?;
        }
        Ok(())
    }
}
