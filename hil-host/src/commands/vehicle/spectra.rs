//! Spectra of a run: spectra.csv and its figures.

use std::path::Path;

use maud::{Markup, html};

use crate::commands::failure::{Failure, Outcome};
use dashpot_files::FileError;
use dashpot_files::case::Case;
use dashpot_files::output::{cannot_write_rows, write_whole};
use dashpot_report::DrawError;
use dashpot_report::page::{Figure, figure, panel};
use dashpot_report::plot::curves::{Curve, ramp};
use dashpot_report::plot::sheet::{Panel, Scale};
use dashpot_report::plot::style::{LEFT, RIGHT};
use dashpot_vehicle_run::signals::SIDES;
use dashpot_vehicle_run::spectra::{SHOWN_HZ, Spectrum, WINDOW_S, signals};

/// Creates empty spectra for a case.
///
/// # Errors
/// The step does not allow spectra.
pub(super) fn of_case(case: &Case) -> Outcome<Vec<Spectrum>> {
    let signals = signals(&case.vehicle).into_iter();
    let spectra = signals.map(|signal| Spectrum::new(signal, case.step_s));
    spectra
        .collect::<Result<_, _>>()
        .map_err(|error| Failure::new(error.to_string()))
}

/// Adds the history at `from`. It is read after the run, so that no tick waits for a transform.
///
/// # Errors
/// The file cannot be read.
pub(super) fn add_history(spectra: &mut [Spectrum], from: &Path) -> Outcome<()> {
    let unreadable = |error: csv::Error| FileError::in_file(from, error);
    let mut rows = csv::Reader::from_path(from).map_err(unreadable)?;
    let header = rows.headers().map_err(unreadable)?;
    let column = |spectrum: &Spectrum| header.iter().position(|name| name == spectrum.signal());
    let columns: Vec<Option<usize>> = spectra.iter().map(column).collect();
    let mut row = csv::StringRecord::new();
    while rows.read_record(&mut row).map_err(unreadable)? {
        for (spectrum, column) in spectra.iter_mut().zip(&columns) {
            let cell = column.and_then(|column| row.get(column));
            let number = cell.unwrap_or_default().parse::<f64>();
            spectrum.add(number.map_err(|error| FileError::in_file(from, error))?);
        }
    }
    Ok(())
}

/// Writes one row per frequency.
///
/// # Errors
/// The file cannot be written.
pub(super) fn write(spectra: &[Spectrum], to: &Path) -> Outcome<()> {
    let densities: Vec<_> = spectra.iter().map(Spectrum::density).collect();
    write_whole::<_, Failure>(to, |file| {
        let failed = |error: csv::Error| cannot_write_rows(to, error);
        let mut rows = csv::Writer::from_writer(file);
        let names = spectra.iter().map(Spectrum::name);
        rows.write_record(std::iter::once("frequency_hz".to_owned()).chain(names))
            .map_err(failed)?;
        let lines = densities.first().map_or(0, Vec::len);
        for line in 0..lines {
            let frequency_hz = densities[0][line][0];
            let densities_here = densities.iter().map(|density| density[line][1]);
            let row: Vec<f64> = std::iter::once(frequency_hz)
                .chain(densities_here)
                .collect();
            rows.serialize(row).map_err(failed)?;
        }
        Ok(rows.flush().map_err(|error| failed(error.into()))?)
    })
}

/// Returns the section of the page with the spectra; empty for a run without spectra.
///
/// # Errors
/// A figure cannot be drawn.
pub(super) fn section(spectra: &[Spectrum]) -> Result<Markup, DrawError> {
    let is_nonzero =
        |spectrum: &Spectrum| spectrum.density().iter().any(|[_, density]| *density > 0.0);
    // On an ideal track nothing moves, and zero cannot be drawn on a logarithmic scale.
    if spectra.is_empty() || !spectra.iter().all(is_nonzero) {
        return Ok(html! {});
    }
    let windows = format!("Welch's mean of Hann windows of {WINDOW_S} s that overlap by half.");
    Ok(html! {
        h2 { "Spectra" }
        (figure(&accelerations(spectra), &html! {
            "Power spectral density of the accelerations at the ride points; points further down in their table are "
            "drawn darker. " (windows)
        })?)
        (figure(&derailment(spectra), &html! {
            "Power spectral density of Y/Q of the leading wheels. " (windows)
        })?)
    })
}

/// Densities of the lateral and vertical accelerations at the ride points.
fn accelerations(spectra: &[Spectrum]) -> Figure {
    let one = |direction: &str| {
        let what = format!("_{direction}_acceleration_m_per_s2");
        let axis = format!("{direction}, 10⁻³ (m/s²)²/Hz");
        curves(spectra, &what, 1e3, &axis)
    };
    panels(vec![one("lateral"), one("vertical")])
}

/// Densities of `Y/Q` of the leading wheels, a panel for each wheelset.
fn derailment(spectra: &[Spectrum]) -> Figure {
    let ending = |side: &str| format!("_{side}_derailment");
    let [left, right] = SIDES.map(ending);
    let names = spectra.iter();
    let names = names.filter_map(|spectrum| spectrum.signal().strip_suffix(&*left));
    let of_wheelset = |name: &str| {
        let sides = [(SIDES[0], &left, LEFT), (SIDES[1], &right, RIGHT)];
        let curves = sides.into_iter().filter_map(|(side, ending, colour)| {
            let signal = format!("{name}{ending}");
            let spectrum = spectra
                .iter()
                .find(|spectrum| spectrum.signal() == signal)?;
            Some(Curve::new(side, colour, shown(spectrum, 1e3)).wide(6))
        });
        Panel {
            title: name.replace('_', " "),
            ..panel_of("Y/Q, 10⁻³/Hz", curves.collect())
        }
    };
    panels(names.map(of_wheelset).collect())
}

fn panels(panels: Vec<Panel>) -> Figure {
    Figure {
        panels,
        height: 300,
        cursor_group: None,
    }
}

/// Draws the spectra whose signal name ends in `ending`, multiplied by `factor`.
fn curves(spectra: &[Spectrum], ending: &str, factor: f64, y: &str) -> Panel {
    let chosen: Vec<_> = spectra
        .iter()
        .filter_map(|spectrum| Some((spectrum, spectrum.signal().strip_suffix(ending)?)))
        .collect();
    let colours = ramp(chosen.len());
    let curves = chosen
        .iter()
        .zip(colours)
        .map(|((spectrum, name), colour)| {
            Curve::new(name.replace('_', " "), colour, shown(spectrum, factor)).wide(5)
        });
    panel_of(y, curves.collect())
}

/// Density of a spectrum, multiplied by `factor`, without the mean, which is removed, and without zeros, which a
/// logarithmic scale cannot show.
fn shown(spectrum: &Spectrum, factor: f64) -> Vec<(f64, f64)> {
    let density = spectrum.density().into_iter();
    density
        .filter(|[f, density]| *f > 0.0 && *f <= SHOWN_HZ && *density > 0.0)
        .map(|[f, density]| (f, factor * density))
        .collect()
}

fn panel_of(y: &str, curves: Vec<Curve>) -> Panel {
    Panel {
        x_scale: Scale::Decades,
        scale: Scale::Decades,
        ..panel("frequency, Hz", y, curves)
    }
}
