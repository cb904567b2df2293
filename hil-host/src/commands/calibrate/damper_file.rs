//! The calibrated damper as a TOML file; comments at the top list the tests.

use dashpot_core::CheckedParameters;

use super::digits::digits;
use super::report::Report;
use crate::commands::failure::Outcome;
use dashpot_calibration::RIG;
use dashpot_files::damper;

/// Returns the text of the file.
///
/// # Errors
/// The damper cannot be written.
pub(super) fn text(report: &Report, found: &CheckedParameters) -> Outcome<String> {
    let mut lines = vec![format!(
        "Calibrated by dashpot {} from {}:",
        env!("CARGO_PKG_VERSION"),
        report.before()
    )];
    for row in &report.loops {
        lines.push(format!(
            "  {}: +-{:.2} mm, {:.3} m/s, residual {:.0} N at a peak force of {:.0} N",
            row.test,
            row.amplitude_m * 1e3,
            row.peak_velocity_m_per_s,
            row.missed_after_n,
            row.peak_force_n
        ));
    }
    for row in &report.indices {
        let motion = &row.measured;
        for (name, measured, _, after) in row.lines() {
            lines.push(format!(
                "  +-{:.3} mm at {} Hz, {name}: {after:.1} here, test {measured}",
                motion.amplitude_m * 1e3,
                motion.frequency_hz
            ));
        }
    }
    lines.push("Found, with 95 % intervals:".into());
    for number in &report.numbers {
        let end = |end: Option<f64>| end.map_or_else(|| "its bound".into(), digits);
        let rig = if RIG.contains(&number.key.as_str()) {
            " (parameter of the rig, not of the damper)"
        } else {
            ""
        };
        let prior = number.prior.filter(|_| !number.by_tests).map(|prior| {
            format!(
                "; prior: {} +- {}",
                digits(prior.mean),
                digits(prior.standard_deviation)
            )
        });
        lines.push(format!(
            "  {}: {} ({} to {}), before {}{}{rig}",
            number.key,
            digits(number.found),
            end(number.least),
            end(number.greatest),
            digits(number.before),
            prior.unwrap_or_default()
        ));
    }
    for influence in &report.influences {
        lines.push(format!("Assumed: {}", influence.words(&report.numbers)));
    }
    lines.extend(report.warnings.iter().map(|warning| warning.words.clone()));
    let head = lines.iter().map(|line| format!("# {line}\n"));
    Ok(head.collect::<String>() + "\n" + &damper::text(found)?)
}
