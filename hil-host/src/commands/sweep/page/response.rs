//! Amplitude-frequency characteristic of a damper, by the value of what varies.

use maud::{Markup, html};

use super::signal::label;
use super::{Drawn, HEIGHT};
use crate::commands::failure::{Failure, Outcome};
use crate::files::study::{Sweep, Value};
use crate::report::page::{Figure, figure, panel};
use crate::report::plot::curves::{Curve, ramp};
use crate::report::plot::sheet::{Panel, Scale};
use crate::study::response::at_amplitude;
use crate::study::workers;

/// Frequencies, Hz, and how many.
const BAND_HZ: [f64; 2] = [0.1, 20.0];
const FREQUENCIES: i32 = 41;

/// Dynamic stiffness and damping over frequency, at an amplitude.
///
/// # Errors
/// The damper does not come to a periodic force, or the figure cannot be drawn.
pub(super) fn part(
    drawn: &Drawn<'_>,
    sweep: &Sweep,
    values: &[Value],
    (name, amplitude_m): (&str, f64),
    caption: &str,
) -> Outcome<Markup> {
    let [least, greatest] = BAND_HZ;
    let ratio = (greatest / least).ln() / f64::from(FREQUENCIES - 1);
    let frequency = |i: i32| least * (ratio * f64::from(i)).exp();
    let frequencies: Vec<f64> = (0..FREQUENCIES).map(frequency).collect();
    let responses = workers::map(values, |value| -> Outcome<_> {
        let case = drawn.study.case_with(sweep, Some(value), None)?;
        let damper = case
            .damper(name)
            .ok_or_else(|| Failure::new(format!("sweep {}: no damper `{name}`", sweep.name)))?;
        let checked = damper.clone().check()?;
        Ok(at_amplitude(&checked, amplitude_m, &frequencies)?)
    })?;
    let axes = |y: &str| Panel {
        x_scale: Scale::Decades,
        ..panel("frequency, Hz", y, Vec::new())
    };
    let mut stiffness = axes("force over displacement, MN/m");
    let mut damping = axes("damping, kN s/m");
    let of_values = responses.iter().zip(values).zip(ramp(values.len()));
    for ((responses, value), colour) in of_values {
        let name = label(sweep, value);
        let over = responses
            .iter()
            .map(|r| (r.frequency_hz, r.stiffness_n_per_m() * 1e-6));
        stiffness
            .curves
            .push(Curve::new(name.clone(), colour, over));
        let over = responses
            .iter()
            .map(|r| (r.frequency_hz, r.damping_n_s_per_m() * 1e-3));
        damping.curves.push(Curve::new(name, colour, over));
    }
    let of_panels = Figure {
        panels: vec![stiffness, damping],
        height: HEIGHT,
        shares: None,
    };
    Ok(figure(
        &of_panels,
        &html! {
            (caption) " Damping is the part of force over velocity in phase with the velocity; amplitude "
            (format!("{}", amplitude_m * 1e3)) " mm."
        },
    )?)
}
