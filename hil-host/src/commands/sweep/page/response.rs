//! Amplitude-frequency characteristic of a damper, by the value of what varies.

use maud::{Markup, html};

use super::signal::label;
use super::{Drawn, HEIGHT};
use crate::commands::failure::{Failure, Outcome};
use dashpot_files::study::{Sweep, Value};
use dashpot_report::page::{Figure, figure};
use dashpot_report::plot::curves::ramp;
use dashpot_report::plot::response;
use dashpot_report::plot::sheet::Scale;
use dashpot_testbench::response::{at_amplitude, frequencies};

/// Frequencies, Hz, and how many.
const BAND_HZ: [f64; 2] = [0.1, 20.0];
const FREQUENCIES: usize = 41;

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
    let frequencies = frequencies(least, greatest, FREQUENCIES);
    let responses = dashpot_workers::map(values, |value| -> Outcome<_> {
        let case = drawn.study.case_with(sweep, Some(value), None)?;
        let damper = case
            .damper(name)
            .ok_or_else(|| Failure::new(format!("sweep {}: no damper `{name}`", sweep.name)))?;
        let checked = damper.clone().check()?;
        Ok(at_amplitude(&checked, amplitude_m, &frequencies)?)
    })?;
    let [mut stiffness, _, mut damping] = response::panels(Scale::Linear);
    let of_values = responses.iter().zip(values).zip(ramp(values.len()));
    for ((responses, value), colour) in of_values {
        let [over_stiffness, _, over_damping] =
            response::of(&label(sweep, value), colour, responses, Scale::Linear);
        stiffness.curves.push(over_stiffness);
        damping.curves.push(over_damping);
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
