//! Drawings of `dashpot shims`: deflection over radius, flow over pressure.

use std::path::Path;

use dashpot_core::characteristic::Characteristic;
use dashpot_core::parameters::Hydraulics;
use plotters::prelude::SeriesLabelPosition;

use super::place::{PLACES, radii};
use super::report::ValveReport;
use crate::failure::Outcome;
use crate::output::write_folder;
use crate::plot::curves::{Curve, Panel, ramp, sheet};
use crate::plot::style::BLUE_LINE;

/// Writes the plots into `folder` and tells their paths.
pub(super) fn draw(
    folder: &Path,
    hydraulics: &Hydraulics,
    valves: &[ValveReport],
    characteristic: &Characteristic,
) -> Outcome<Vec<String>> {
    let mut deflections = Vec::new();
    let mut flows = Vec::new();
    for (place, report) in PLACES.iter().zip(valves) {
        let valve = (place.of)(hydraulics);
        if let Some(pack) = place.pack(hydraulics)? {
            let colours = ramp(report.pressures.len());
            let curves = report.pressures.iter().zip(colours).map(|(row, colour)| {
                let points = radii(valve, 120)
                    .map(|r| (r * 1e3, pack.compliance_m_per_pa(r) * row.pressure_pa * 1e3));
                Curve::new(format!("{:.0} MPa", row.pressure_pa * 1e-6), colour, points)
            });
            deflections.push(Panel {
                title: format!("{} valve", capital(place.name)),
                x_label: "radius, mm".into(),
                y_label: "deflection under uniform pressure, mm".into(),
                legend: Some(SeriesLabelPosition::UpperLeft),
                sides: false,
                curves: curves.collect(),
            });
        }
        let points = (0..=200).map(|i| {
            let pressure_mpa = 0.05 * f64::from(i);
            let flow = characteristic.valve_flow_m3_per_s(place.valve, pressure_mpa * 1e6);
            (pressure_mpa, flow.unwrap_or(0.0) * 1e6)
        });
        flows.push(Panel {
            title: format!("{} valve", capital(place.name)),
            x_label: "pressure, MPa".into(),
            y_label: "flow through the pack, cm³/s".into(),
            legend: None,
            sides: false,
            curves: vec![Curve::new(place.name, BLUE_LINE, points)],
        });
    }
    let mut drawings = Vec::new();
    for (name, panels) in [
        ("shim-deflection.svg", deflections),
        ("valve-flow.svg", flows),
    ] {
        if !panels.is_empty() {
            drawings.push((name, sheet(480 * panels.len() as u32, 440, &panels)?));
        }
    }
    write_folder(folder, &drawings)
}

/// `name` with a capital first letter.
fn capital(name: &str) -> String {
    let mut letters = name.chars();
    letters.next().map_or_else(String::new, |first| {
        first.to_uppercase().chain(letters).collect()
    })
}
