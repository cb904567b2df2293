//! Figure of a signal over time and its spectrum for each value of the varied parameter.

use maud::{Markup, html};

use super::words::of_first;
use super::{Drawn, HEIGHT};
use crate::commands::failure::Outcome;
use crate::commands::raw_name::in_words;
use dashpot_files::study::{Sweep, Value};
use dashpot_report::page::{Figure, figure, panel};
use dashpot_report::plot::curves::{Curve, ramp};
use dashpot_report::plot::envelope::thinned;
use dashpot_report::plot::sheet::{Panel, Scale};
use dashpot_vehicle_run::spectra::WINDOW_S;

/// Draws the signal over time for the first seed, and the mean spectrum of all seeds with the band from minimum to
/// maximum.
///
/// # Errors
/// A curve is missing, or the figure cannot be drawn.
pub(super) fn part(
    drawn: &Drawn<'_>,
    sweep: &Sweep,
    values: &[Value],
    signal: &str,
    caption: &str,
) -> Outcome<Markup> {
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
    for (value, colour) in values.iter().zip(ramp(values.len())) {
        let name = of_first(sweep, value);
        let history = drawn.curve(&drawn.study.history_key(sweep, value, signal))?;
        let points = thinned(history.values.iter().copied(), history.step_s);
        let curve = Curve::new(name.clone(), colour, points).wide(4);
        time_panel.curves.push(curve);
        let spectra = drawn.study.spectrum_keys(sweep, value, signal);
        let spectra = spectra.map(|key| Ok(&drawn.curve(&key)?.values[..]));
        let (mean, band) = densities(&spectra.collect::<Outcome<Vec<_>>>()?);
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
    let spread = match &sweep.seeds[..] {
        [] | [_] => String::new(),
        [first, ..] => format!(
            "Over time: seed {first}. Spectra (Welch, windows of {WINDOW_S} s): mean of {} seeds with the band from \
             minimum to maximum.",
            sweep.seeds.len()
        ),
    };
    Ok(figure(&drawing, &html! { (caption) " " (spread) })?)
}

type Mean = Vec<(f64, f64)>;
type Band = Vec<(f64, f64, f64)>;

/// Returns the mean density over the spectra, with its minimum and maximum.
fn densities(spectra: &[&[f64]]) -> (Mean, Band) {
    let lines = spectra.iter().map(|spectrum| spectrum.len() / 2).min();
    let (mut mean, mut band) = (Mean::new(), Band::new());
    for line in 0..lines.unwrap_or(0) {
        let frequency_hz = spectra[0][2 * line];
        let here = || spectra.iter().map(|spectrum| spectrum[2 * line + 1]);
        let min = here().fold(f64::INFINITY, f64::min);
        if frequency_hz > 0.0 && min > 0.0 {
            mean.push((frequency_hz, here().sum::<f64>() / spectra.len() as f64));
            band.push((frequency_hz, min, here().fold(0.0, f64::max)));
        }
    }
    (mean, band)
}
