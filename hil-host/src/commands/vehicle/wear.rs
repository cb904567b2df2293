//! Wear of the wheels over a run: wear.csv, its section of the page, and its lines of the report.

use std::io::{self, Write};
use std::path::Path;

use maud::{Markup, html};

use crate::commands::failure::{Failure, Outcome};
use dashpot_files::output::{cannot_write_rows, write_whole};
use dashpot_report::DrawError;
use dashpot_report::page::{Figure, figure, panel};
use dashpot_report::plot::curves::Curve;
use dashpot_report::plot::sheet::{Panel, with_one_scale};
use dashpot_report::plot::style::{LEFT, RIGHT};
use dashpot_vehicle_run::signals::SIDES;
use dashpot_vehicle_run::wear::{CellWear, PER_DISTANCE_M, WearLaw};
use dashpot_vehicle_run::{WearIndices, WheelWear};

/// Law of the wear.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Law {
    /// Archard's law with the KTH chart over pressure and sliding speed (Jendel 2002).
    Archard,
    /// Wear rate over the friction work per contact area, Sheffield (Braghin et al. 2006).
    TGamma,
}

impl Law {
    pub(super) fn law(self) -> WearLaw {
        match self {
            Self::Archard => WearLaw::default(),
            Self::TGamma => WearLaw::t_gamma(),
        }
    }
}

/// Writes one row per cell of each wheel's profile; without `wear`, only the header.
///
/// # Errors
/// The file cannot be written.
pub(super) fn write(wear: Option<&WearIndices>, to: &Path) -> Outcome<()> {
    write_whole::<_, Failure>(to, |file| {
        let failed = |error: csv::Error| cannot_write_rows(to, error);
        let mut rows = csv::Writer::from_writer(file);
        rows.write_record([
            "wheelset",
            "side",
            "wheel_y_m",
            "wheel_z_m",
            "depth_m",
            "depth_um_per_1000km",
        ])
        .map_err(failed)?;
        for wear in wear.into_iter() {
            for wheel in &wear.wheels {
                for cell in &wheel.profile.cells {
                    let row = (
                        &wheel.wheelset,
                        wheel.side,
                        cell.y_m,
                        cell.z_m,
                        cell.depth_m,
                        um_per_1000km(wear, cell.depth_m),
                    );
                    rows.serialize(row).map_err(failed)?;
                }
            }
        }
        Ok(rows.flush().map_err(|error| failed(error.into()))?)
    })
}

/// A depth over the run as a depth per 1000 km, um.
fn um_per_1000km(wear: &WearIndices, depth_m: f64) -> f64 {
    1e6 * depth_m * PER_DISTANCE_M / wear.distance_m
}

/// Section of the page.
///
/// # Errors
/// The figure cannot be drawn.
pub(super) fn section(wear: &WearIndices) -> Result<Markup, DrawError> {
    let figure_of_all = Figure {
        panels: with_one_scale(of_wheelsets(wear)),
        height: 210,
        cursor_group: None,
    };
    Ok(html! {
        h2 { "Wear of the wheels" }
        (figure(&figure_of_all, &html! {
            "Depth lost along the normal of the profile if the vehicle ran like this for 1000 km; the flange is at "
            "negative positions, the tread datum at 0. " strong { "An estimate" } " by " (wear.law) " (" (wear.source)
            "). " (wear.note)
        })?)
        div.wide { table {
            tr {
                th { "wheel" } th { "wear number, N" } th { "maximum depth, µm per 1000 km" } th { "at, mm" }
                th { "lost area, mm² per 1000 km" }
            }
            @for wheel in &wear.wheels {
                tr {
                    td.text { (wheel.wheelset) ", " (wheel.side) }
                    td { (format!("{:.1}", wheel.wear_number_n)) }
                    td { (format!("{:.1}", wheel.max_depth_um_per_1000km)) }
                    td { (format!("{:.0}", 1e3 * wheel.max_depth_at_m)) }
                    td { (format!("{:.3}", wheel.lost_area_mm2_per_1000km)) }
                }
            }
        } }
    })
}

/// Draws the left and the right wheel of each wheelset.
fn of_wheelsets(wear: &WearIndices) -> Vec<Panel> {
    let mut panels: Vec<Panel> = Vec::new();
    for wheel in &wear.wheels {
        let colour = if wheel.side == SIDES[0] { LEFT } else { RIGHT };
        let curve = Curve::new(wheel.side, colour, touched(wear, wheel)).wide(6);
        match panels.last_mut() {
            Some(panel) if panel.title == wheel.wheelset => panel.curves.push(curve),
            _ => panels.push(Panel {
                title: wheel.wheelset.clone(),
                ..panel(
                    "position on the wheel, mm",
                    "depth per 1000 km, µm",
                    vec![curve],
                )
            }),
        }
    }
    panels
}

/// Depth (um per 1000 km) over position (mm) from the first to the last worn cell, with an unworn one at both ends.
fn touched(wear: &WearIndices, wheel: &WheelWear) -> Vec<(f64, f64)> {
    let cells = &wheel.profile.cells;
    let is_worn = |cell: &CellWear| cell.depth_m > 0.0;
    let (Some(first), Some(last)) = (
        cells.iter().position(is_worn),
        cells.iter().rposition(is_worn),
    ) else {
        return Vec::new();
    };
    let shown = &cells[first.saturating_sub(1)..(last + 2).min(cells.len())];
    shown
        .iter()
        .map(|cell| (1e3 * cell.y_m, um_per_1000km(wear, cell.depth_m)))
        .collect()
}

/// Prints the most worn wheel.
pub(super) fn print(out: &mut dyn Write, wear: &WearIndices) -> io::Result<()> {
    let Some(worst) = wear.worst() else {
        return Ok(());
    };
    writeln!(
        out,
        "wear, an estimate by {}: at most {} um per 1000 km, {}, {} wheel, {:.0} mm from the tread datum",
        wear.law,
        two_digits(worst.max_depth_um_per_1000km),
        worst.wheelset,
        worst.side,
        1e3 * worst.max_depth_at_m
    )
}

/// An estimate has no more digits that mean something: `0.0012`, `5.3`, `26000`.
fn two_digits(value: f64) -> String {
    let rounded: f64 = format!("{value:.1e}").parse().unwrap_or(value);
    format!("{rounded}")
}
