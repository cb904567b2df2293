//! Report of `dashpot contact`: warnings, equivalent conicity, and contact over the lateral shift of the wheelset.

use std::io::{self, Write};

use dashpot_rail::contact::Pair;
use dashpot_rail::profile::measured::Reading;
use dashpot_study::loaded_wheelset::LoadedShift;
use dashpot_study::profile_ends::{EndContact, Side, end_contacts};
use dashpot_study::wheelset_geometry::{Conicity, Shift, WheelsetGeometry};
use serde::Serialize;

use super::load::{UnderLoad, shortest};
use super::profiles::{Loaded, Profiles};
use super::warnings::{TiltReport, end_contact, tilts};
use super::{Sides, under_load};

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

/// Wheelset under load.
#[derive(Serialize)]
struct LoadedReport {
    load_n: f64,
    speed_m_per_s: f64,
    yaw_rad: f64,
    friction: f64,
    conicity_at_3mm: Option<f64>,
    conicity: Vec<Conicity>,
    shifts: Vec<LoadedShift>,
    #[serde(skip)]
    running: dashpot_study::loaded_wheelset::Running,
}

#[derive(Serialize)]
pub(super) struct Report {
    wheel: String,
    rail: String,
    wheel_file: Option<FileReport>,
    rail_file: Option<FileReport>,
    left_wheel: String,
    left_rail: String,
    left_wheel_file: Option<FileReport>,
    left_rail_file: Option<FileReport>,
    #[serde(skip)]
    title: String,
    /// Names of the profiles that were read from files, with reading details.
    #[serde(skip)]
    readings: Vec<(String, Reading)>,
    gauge_m: f64,
    back_to_back_m: f64,
    wheel_radius_m: f64,
    rail_inclination: f64,
    rail_tilts: Vec<TiltReport>,
    contacts_at_profile_ends: Vec<EndContact>,
    warnings: Vec<String>,
    conicity_at_3mm: Option<f64>,
    conicity: Vec<Conicity>,
    shifts: Vec<Shift>,
    #[serde(skip_serializing_if = "Option::is_none")]
    under_load: Option<LoadedReport>,
    plots: Vec<String>,
}

/// Builds the report with the reading details and the plot files.
pub(super) fn report(
    sides: &Sides,
    profiles: &Profiles,
    geometry: &WheelsetGeometry,
    under_load: Option<UnderLoad>,
    plots: Vec<String>,
) -> Report {
    let installation = sides.right.installation();
    let radius_m = installation.wheel_radius_m;
    let given = [
        Some(&profiles.wheel),
        Some(&profiles.rail),
        profiles.left_wheel.as_ref(),
        profiles.left_rail.as_ref(),
    ];
    let readings = given
        .into_iter()
        .flatten()
        .filter_map(|given| Some((given.profile.name().to_owned(), given.reading?)))
        .collect();
    let file = |given: &Loaded| given.reading.map(FileReport::from);
    let (rail_tilts, tilt_warnings): (Vec<_>, Vec<_>) = tilts(profiles, installation.inclination)
        .into_iter()
        .unzip();
    let loaded = under_load.as_ref().map_or(&[][..], |loaded| &loaded.shifts);
    let ends = end_contacts(sides.pairs(), &geometry.contacts, loaded);
    let end_warnings = ends.iter().filter_map(|contact| {
        // If both sides are equal, the right one speaks for both.
        let is_repeated = sides.are_equal && contact.side == Side::Left;
        (!is_repeated).then(|| end_contact(contact, name_of(sides, contact)))
    });
    let warnings = tilt_warnings.into_iter().flatten().chain(end_warnings);
    Report {
        wheel: sides.right.wheel().name().to_owned(),
        rail: sides.right.rail().name().to_owned(),
        left_wheel: sides.left.wheel().name().to_owned(),
        left_rail: sides.left.rail().name().to_owned(),
        wheel_file: file(&profiles.wheel),
        rail_file: file(&profiles.rail),
        left_wheel_file: file(profiles.left_wheel.as_ref().unwrap_or(&profiles.wheel)),
        left_rail_file: file(profiles.left_rail.as_ref().unwrap_or(&profiles.rail)),
        title: sides.title(),
        readings,
        gauge_m: installation.gauge_m,
        back_to_back_m: installation.back_to_back_m,
        wheel_radius_m: radius_m,
        rail_inclination: installation.inclination,
        rail_tilts,
        warnings: warnings.collect(),
        contacts_at_profile_ends: ends,
        conicity_at_3mm: geometry.rolling.equivalent_conicity(3e-3, radius_m),
        conicity: Conicity::over_amplitude(&geometry.rolling, radius_m),
        // One row per millimetre.
        shifts: geometry
            .contacts
            .iter()
            .step_by(40)
            .map(Shift::from)
            .collect(),
        under_load: under_load.map(|loaded| LoadedReport {
            load_n: loaded.running.load_n,
            speed_m_per_s: loaded.running.speed_m_per_s,
            yaw_rad: loaded.running.yaw_rad,
            friction: loaded.running.friction,
            conicity_at_3mm: loaded.rolling.equivalent_conicity(3e-3, radius_m),
            conicity: Conicity::over_amplitude(&loaded.rolling, radius_m),
            shifts: loaded.shifts,
            running: loaded.running,
        }),
        plots,
    }
}

/// Name of the profile whose end a contact reaches.
fn name_of<'a>(sides: &'a Sides, contact: &EndContact) -> &'a str {
    let pair: &Pair = match contact.side {
        Side::Left => &sides.left,
        Side::Right => &sides.right,
    };
    let profile = if contact.is_wheel {
        pair.wheel()
    } else {
        pair.rail()
    };
    profile.name()
}

/// Prints the report as text.
pub(super) fn print(out: &mut dyn Write, report: &Report) -> io::Result<()> {
    let inclination = if report.rail_inclination == 0.0 {
        let is_from_file = report.rail_file.is_some() || report.left_rail_file.is_some();
        if is_from_file {
            "as in the file"
        } else {
            "upright"
        }
        .to_owned()
    } else {
        format!("1:{:.0}", 1.0 / report.rail_inclination)
    };
    writeln!(
        out,
        "{}, rails {inclination}, gauge {:.1} mm, back to back {:.1} mm, wheel radius {:.1} mm",
        report.title,
        report.gauge_m * 1e3,
        report.back_to_back_m * 1e3,
        report.wheel_radius_m * 1e3
    )?;
    for (name, reading) in &report.readings {
        writeln!(out, "{name}: {reading}")?;
    }
    for warning in &report.warnings {
        writeln!(out, "warning: {warning}")?;
    }
    print_conicity(out, report)?;
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
    if let Some(loaded) = &report.under_load {
        under_load::print(out, &loaded.running, &loaded.shifts)?;
    }
    if !report.plots.is_empty() {
        writeln!(out, "\nplots: {}", report.plots.join(", "))?;
    }
    Ok(())
}

/// Prints the equivalent conicity: rigid, and under load beside it.
fn print_conicity(out: &mut dyn Write, report: &Report) -> io::Result<()> {
    let text = |row: &Conicity| {
        row.equivalent_conicity.map_or_else(
            || "no closed path".to_owned(),
            |value| format!("{value:8.4}"),
        )
    };
    let Some(loaded) = &report.under_load else {
        writeln!(
            out,
            "\nequivalent conicity (EN 15302)\n  amplitude mm   conicity"
        )?;
        for row in &report.conicity {
            writeln!(out, "  {:12.1}   {}", row.amplitude_m * 1e3, text(row))?;
        }
        return Ok(());
    };
    writeln!(
        out,
        "\nequivalent conicity (EN 15302): of the rigid wheelset, and on elastic patches under {} kN per wheel\n  \
         amplitude mm            rigid          elastic",
        shortest(loaded.load_n * 1e-3)
    )?;
    for (rigid, elastic) in report.conicity.iter().zip(&loaded.conicity) {
        writeln!(
            out,
            "  {:12.1}   {:>14}   {:>14}",
            rigid.amplitude_m * 1e3,
            text(rigid),
            text(elastic)
        )?;
    }
    Ok(())
}
