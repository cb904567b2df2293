//! Report of `dashpot contact`: equivalent conicity, and rigid contact over the lateral shift of the wheelset.

use std::io::{self, Write};

use dashpot_rail::contact::Pair;
use dashpot_rail::profile::measured::Reading;
use serde::Serialize;

use super::profiles::Readings;
use dashpot_study::wheelset_geometry::{Conicity, ForceJump, Shift, WheelsetGeometry};

/// JSON report on reading a profile file.
#[derive(Serialize)]
struct FileReport {
    format: &'static str,
    turned: bool,
    points: usize,
    points_overhanging: usize,
    points_folded: usize,
    widest_fold_m: f64,
}

impl From<Reading> for FileReport {
    fn from(reading: Reading) -> Self {
        Self {
            format: reading.format.name(),
            turned: reading.turned,
            points: reading.points,
            points_overhanging: reading.overhanging,
            points_folded: reading.folded,
            widest_fold_m: reading.widest_fold_mm * 1e-3,
        }
    }
}

#[derive(Serialize)]
pub(super) struct Report {
    wheel: String,
    rail: String,
    wheel_file: Option<FileReport>,
    rail_file: Option<FileReport>,
    #[serde(skip)]
    readings: Readings,
    gauge_m: f64,
    back_to_back_m: f64,
    wheel_radius_m: f64,
    rail_inclination: f64,
    conicity_at_3mm: Option<f64>,
    conicity: Vec<Conicity>,
    shifts: Vec<Shift>,
    /// Reason for rejecting contact tables of the pair; `None` if they are valid.
    force_jump: Option<ForceJump>,
    plots: Vec<String>,
}

/// Builds the report on `pair` with the reading details and the plot files.
pub(super) fn report(
    pair: &Pair,
    readings: Readings,
    geometry: &WheelsetGeometry,
    plots: Vec<String>,
) -> Report {
    let installation = pair.installation();
    Report {
        wheel: pair.wheel().name().to_owned(),
        rail: pair.rail().name().to_owned(),
        wheel_file: readings.wheel.map(FileReport::from),
        rail_file: readings.rail.map(FileReport::from),
        readings,
        gauge_m: installation.gauge_m,
        back_to_back_m: installation.back_to_back_m,
        wheel_radius_m: installation.wheel_radius_m,
        rail_inclination: installation.inclination,
        conicity_at_3mm: geometry
            .rolling
            .equivalent_conicity(3e-3, installation.wheel_radius_m),
        conicity: geometry.conicities(pair),
        // One row per millimetre.
        shifts: geometry
            .contacts
            .iter()
            .step_by(40)
            .map(Shift::from)
            .collect(),
        force_jump: ForceJump::find(pair),
        plots,
    }
}

/// Prints the report as text.
pub(super) fn print(out: &mut dyn Write, report: &Report) -> io::Result<()> {
    let inclination = if report.rail_inclination == 0.0 {
        "upright".to_owned()
    } else {
        format!("1:{:.0}", 1.0 / report.rail_inclination)
    };
    writeln!(
        out,
        "{} on {}, rails {inclination}, gauge {:.1} mm, back to back {:.1} mm, wheel radius {:.1} mm",
        report.wheel,
        report.rail,
        report.gauge_m * 1e3,
        report.back_to_back_m * 1e3,
        report.wheel_radius_m * 1e3
    )?;
    let files = [
        (&report.wheel, report.readings.wheel),
        (&report.rail, report.readings.rail),
    ];
    for (name, reading) in files {
        if let Some(reading) = reading {
            writeln!(out, "{name}: {reading}")?;
        }
    }
    writeln!(
        out,
        "\nequivalent conicity (EN 15302)\n  amplitude mm   conicity"
    )?;
    for row in &report.conicity {
        let value = row.equivalent_conicity.map_or_else(
            || "no closed path".to_owned(),
            |value| format!("{value:8.4}"),
        );
        writeln!(out, "  {:12.1}   {value}", row.amplitude_m * 1e3)?;
    }
    writeln!(
        out,
        "\nrigid wheelset (shift at the top of the rails, positive to the right; y on the wheel from the tread \
         datum)\n  \
         shift mm  radius difference mm  angle left deg  right deg      y left mm  right mm"
    )?;
    for row in &report.shifts {
        writeln!(
            out,
            "  {:8.1}  {:20.3}  {:14.2}  {:9.2}  {:13.2}  {:8.2}",
            row.lateral_shift_m * 1e3,
            row.rolling_radius_difference_m * 1e3,
            row.contact_angle_left_rad.to_degrees(),
            row.contact_angle_right_rad.to_degrees(),
            row.wheel_place_left_m * 1e3,
            row.wheel_place_right_m * 1e3
        )?;
    }
    if let Some(jump) = &report.force_jump {
        writeln!(
            out,
            "\ncontact tables of this pair are rejected: at a lateral shift of {:.6} m of the right wheel over its \
             rail (roll {:.4} rad, yaw {:.4} rad)\nthe contact force jumps by {:.0} N under a load of {:.0} N; the \
             stiffness of the contact explains {:.0} N of the jump",
            jump.lateral_m, jump.roll_rad, jump.yaw_rad, jump.jump_n, jump.load_n, jump.allowed_n
        )?;
    }
    if !report.plots.is_empty() {
        writeln!(out, "\nplots: {}", report.plots.join(", "))?;
    }
    Ok(())
}
