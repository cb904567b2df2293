//! Figure of the amplitude-frequency characteristic of a damper for each value of the varied parameter.

use maud::{Markup, html};

use super::words::of_first;
use super::{Drawn, HEIGHT};
use crate::commands::failure::{Failure, Outcome};
use dashpot_files::study::{Sweep, Value};
use dashpot_report::page::{Figure, figure};
use dashpot_report::plot::curves::ramp;
use dashpot_report::plot::response;
use dashpot_report::plot::sheet::Scale;
use dashpot_testbench::response::{at_amplitude, frequencies};

/// Range (Hz) and number of the frequencies.
const BAND_HZ: [f64; 2] = [0.1, 20.0];
const FREQUENCIES: usize = 41;

/// Draws dynamic stiffness and damping over frequency at one amplitude.
///
/// # Errors
/// The force does not become periodic, or the figure cannot be drawn.
pub(super) fn part(
    drawn: &Drawn<'_>,
    sweep: &Sweep,
    values: &[Value],
    (name, amplitude_m): (&str, f64),
    caption: &str,
) -> Outcome<Markup> {
    let [min, max] = BAND_HZ;
    let frequencies = frequencies(min, max, FREQUENCIES);
    let responses = dashpot_workers::map(values, |value| -> Outcome<_> {
        let case = drawn.study.case_with(sweep, Some(value), None)?;
        let damper = case
            .damper(name)
            .ok_or_else(|| Failure::new(format!("sweep {}: no damper `{name}`", sweep.name)))?;
        let checked = damper.clone().check()?;
        Ok(at_amplitude(&checked, amplitude_m, &frequencies)?)
    })?;
    let [mut stiffness, _, mut damping] = response::panels(Scale::Linear);
    let by_value = responses.iter().zip(values).zip(ramp(values.len()));
    for ((responses, value), colour) in by_value {
        let [over_stiffness, _, over_damping] =
            response::of(&of_first(sweep, value), colour, responses, Scale::Linear);
        stiffness.curves.push(over_stiffness);
        damping.curves.push(over_damping);
    }
    let drawing = Figure {
        panels: vec![stiffness, damping],
        height: HEIGHT,
        cursor_group: None,
    };
    Ok(figure(
        &drawing,
        &html! {
            (caption) " Damping is the ratio of force to velocity, in phase with the velocity; amplitude "
            (format!("{}", amplitude_m * 1e3)) " mm."
        },
    )?)
}
