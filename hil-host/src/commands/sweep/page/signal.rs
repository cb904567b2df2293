//! Figure of a signal over time and its spectrum for each value of the varied parameter.

use maud::{Markup, html};

use super::{Drawn, HEIGHT, failed};
use crate::commands::failure::{Failure, Outcome};
use dashpot_files::study::{Sweep, Value, format_number};
use dashpot_report::page::{Figure, figure, panel};
use dashpot_report::plot::curves::{Curve, ramp};
use dashpot_report::plot::envelope::thinned;
use dashpot_report::plot::sheet::{Panel, Scale};
use dashpot_study::sweep::{History, RunError, record};
use dashpot_vehicle_run::spectra::{SHOWN_HZ, Spectrum, WINDOW_S};

/// Draws the signal over time for the first seed, and the mean spectrum of all seeds with the band from minimum to
/// maximum.
///
/// # Errors
/// A case cannot be run, or the figure cannot be drawn.
pub(super) fn part(
    drawn: &Drawn<'_>,
    sweep: &Sweep,
    values: &[Value],
    signal: &str,
    caption: &str,
) -> Outcome<Markup> {
    let seeds: Vec<Option<u64>> = match &sweep.seeds[..] {
        [] => vec![None],
        seeds => seeds.iter().copied().map(Some).collect(),
    };
    let with_seeds = |value: &Value| {
        seeds
            .iter()
            .map(|seed| (value.clone(), *seed))
            .collect::<Vec<_>>()
    };
    let cases: Vec<(Value, Option<u64>)> = values.iter().flat_map(with_seeds).collect();
    let names = [signal.to_owned()];
    let histories = dashpot_workers::map(&cases, |(value, seed)| -> Result<History, RunError> {
        let case = drawn.study.case_with(sweep, Some(value), *seed)?;
        record(&case, &names, &drawn.shared).map_err(failed(sweep))
    })?;
    let what = in_words(signal);
    let mut time_panel = panel("time, s", &what, Vec::new());
    let mut frequency_panel = Panel {
        x_scale: Scale::Decades,
        scale: Scale::Decades,
        ..panel(
            "frequency, Hz",
            "power spectral density, unit squared per Hz",
            Vec::new(),
        )
    };
    let by_value = histories.chunks_exact(seeds.len()).zip(values);
    for ((histories, value), colour) in by_value.zip(ramp(values.len())) {
        let name = label(sweep, value);
        let [first, ..] = histories else { continue };
        let values = first.signals[0].iter().copied();
        let curve = Curve::new(name.clone(), colour, thinned(values, first.step_s)).wide(4);
        time_panel.curves.push(curve);
        let (mean, band) = densities(signal, histories)?;
        if mean.is_empty() {
            continue;
        }
        frequency_panel.curves.push(Curve::band("", colour, band));
        frequency_panel
            .curves
            .push(Curve::new(name, colour, mean).wide(6));
    }
    let panels = if frequency_panel.curves.is_empty() {
        vec![time_panel]
    } else {
        vec![time_panel, frequency_panel]
    };
    let drawing = Figure {
        panels,
        height: HEIGHT,
        cursor_group: None,
    };
    let spread = match seeds.len() {
        1 => String::new(),
        count => format!(
            "Over time: seed {}. Spectra (Welch, windows of {WINDOW_S} s): mean of {count} seeds with the band from \
             minimum to maximum.",
            seeds[0].unwrap_or_default()
        ),
    };
    Ok(figure(&drawing, &html! { (caption) " " (spread) })?)
}

/// Formats a signal name with its unit.
fn in_words(signal: &str) -> String {
    let units = [
        ("_m_per_s2", ", m/s²"),
        ("_rad", ", rad"),
        ("_m", ", m"),
        ("_n", ", N"),
        ("_derailment", " Y/Q"),
    ];
    let found = units
        .into_iter()
        .find_map(|(ending, unit)| Some((signal.strip_suffix(ending)?, unit)));
    let (name, unit) = found.unwrap_or((signal, ""));
    name.replace('_', " ") + unit
}

/// Formats a value as a curve label.
pub(super) fn label(sweep: &Sweep, value: &Value) -> String {
    match (value, sweep.axes.first()) {
        (Value::Number(number), Some(axis)) => {
            let scaled = format_number(number * axis.factor);
            let (what, unit) = axis.label.rsplit_once(", ").unwrap_or((&axis.label, ""));
            let symbol = what.rsplit(' ').next().unwrap_or(what);
            format!("{symbol} = {scaled} {unit}").trim_end().to_owned()
        }
        _ => value.to_string(),
    }
}

type Mean = Vec<(f64, f64)>;
type Band = Vec<(f64, f64, f64)>;

/// Returns the mean density over the histories, with its minimum and maximum.
fn densities(signal: &str, histories: &[History]) -> Outcome<(Mean, Band)> {
    let mut all = Vec::new();
    for history in histories {
        let spectrum = Spectrum::new(signal.to_owned(), history.step_s);
        let mut spectrum = spectrum.map_err(|error| Failure::new(error.to_string()))?;
        history.signals[0]
            .iter()
            .for_each(|value| spectrum.add(*value));
        all.push(spectrum.density());
    }
    let lines = all.iter().map(Vec::len).min().unwrap_or(0);
    let (mut mean, mut band) = (Mean::new(), Band::new());
    for line in 0..lines {
        let frequency_hz = all[0][line][0];
        let here = || all.iter().map(|density| density[line][1]);
        let min = here().fold(f64::INFINITY, f64::min);
        if frequency_hz > 0.0 && frequency_hz <= SHOWN_HZ && min > 0.0 {
            mean.push((frequency_hz, here().sum::<f64>() / all.len() as f64));
            band.push((frequency_hz, min, here().fold(0.0, f64::max)));
        }
    }
    Ok((mean, band))
}
