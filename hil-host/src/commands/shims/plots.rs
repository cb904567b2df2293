//! Plots of `dashpot shims`: edge lift over pressure, deflection over radius, flow over pressure.

use dashpot_core::characteristic::Characteristic;
use dashpot_core::parameters::Hydraulics;
use plotters::prelude::SeriesLabelPosition;

use super::capital::capital;
use crate::commands::failure::Outcome;
use dashpot_report::plot::curves::{Curve, ramp};
use dashpot_report::plot::sheet::{Layout, Panel, Scale, sheet};
use dashpot_report::plot::style::{BLUE_LINE, GREEN_LINE, RED_LINE};
use dashpot_testbench::published::Deflection;
use dashpot_testbench::shim_report::{ValveReport, radii};
use dashpot_testbench::shim_valves::{VALVE_LOCATIONS, ValveLocation};

/// Number of pressure steps in a curve.
const STEPS: u32 = 200;
/// Returns the plotted pressures (MPa), from zero to the end of the published tables or to twice the preload.
fn pressures_mpa(tables_end_pa: f64, preload_pa: f64) -> impl Iterator<Item = f64> {
    let end_mpa = 1e-6 * tables_end_pa.max(2.0 * preload_pa);
    (0..=STEPS).map(move |i| end_mpa * f64::from(i) / f64::from(STEPS))
}

/// Returns the file name and the SVG text of each plot.
pub(super) fn draw(
    hydraulics: &Hydraulics,
    valves: &[ValveReport],
    characteristic: &Characteristic,
) -> Outcome<Vec<(&'static str, String)>> {
    let pressures_pa = valves.iter().flat_map(|valve| &valve.pressures);
    let tables_end_pa = pressures_pa.fold(0.0, |end: f64, row| end.max(row.pressure_pa));
    let mut lifts = Vec::new();
    let mut deflections = Vec::new();
    let mut flows = Vec::new();
    for (location, report) in VALVE_LOCATIONS.iter().zip(valves) {
        lifts.push(lift(location, report, tables_end_pa));
        deflections.extend(deflection(location, report, hydraulics)?);
        flows.push(flow(location, report, characteristic, tables_end_pa));
    }
    let mut drawings = Vec::new();
    for (name, panels) in [
        ("shim-lift.svg", lifts),
        ("shim-deflection.svg", deflections),
        ("valve-flow.svg", flows),
    ] {
        if !panels.is_empty() {
            let layout = Layout::row(panels.len(), 480, 440);
            drawings.push((name, sheet(layout, &panels)?));
        }
    }
    Ok(drawings)
}

/// Plots edge lift over pressure: disc theory, published table and the lift that the damper model uses.
fn lift(location: &ValveLocation, report: &ValveReport, tables_end_pa: f64) -> Panel {
    let line = |m_per_pa: f64, preload_pa: f64| {
        let lift_mm = move |mpa: f64| (mpa * 1e6 - preload_pa) * m_per_pa * 1e3;
        let pressures = pressures_mpa(tables_end_pa, report.preload_pa);
        // The scale is logarithmic: skip closed valves, and lifts just above opening, which are rounding errors.
        let open = pressures.filter(move |mpa| mpa * 1e6 > 1.01 * preload_pa && *mpa > 0.0);
        open.map(move |mpa| (mpa, lift_mm(mpa)))
    };
    let mut curves = Vec::new();
    if let Some(theory) = report.theory_m_per_pa() {
        let name = format!("disc theory, uniform pressure: {}", rate(theory));
        curves.push(Curve::new(name, BLUE_LINE, line(theory, 0.0)));
    }
    if let Some(published) = report.published() {
        let points = |value: fn(&Deflection) -> f64| {
            let rows = published.iter();
            rows.map(move |row| (row.pressure_mpa, value(row) * 1e3))
        };
        if let Some(row) = published.last() {
            let slope = rate(row.theory_uniform_m() / row.pressure_pa());
            let name = format!("published, uniform pressure: {slope}");
            let uniform: Vec<_> = points(Deflection::theory_uniform_m).collect();
            curves.push(Curve::new(name, RED_LINE, between(&uniform)).dashed());
        }
        let real = points(Deflection::fea_real_m);
        curves.push(Curve::new("published, real pressure (FEA)", RED_LINE, real).dotted());
    }
    let used = report.effective_edge_compliance_m_per_pa;
    let name = format!("used, {} × Ce: {}", report.source(), rate(used));
    curves.push(Curve::new(name, GREEN_LINE, line(used, report.preload_pa)).wide(11));
    let table = match report.published() {
        Some(_) => format!(", published in Table {}", location.table),
        None => String::new(),
    };
    Panel {
        title: format!("{} valve{table}", capital(location.name)),
        x_label: "pressure, MPa".into(),
        y_label: "edge lift, mm".into(),
        legend: Some(SeriesLabelPosition::LowerRight),
        sides: false,
        x_scale: Scale::Linear,
        scale: Scale::Decades,
        keeps_to_values: false,
        y_range: None,
        curves,
    }
}

/// Interpolates linearly between points in ten parts per segment, because a straight line is curved on a logarithmic
/// scale.
fn between(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let parts = points.windows(2).flat_map(|pair| {
        let [(x0, y0), (x1, y1)] = [pair[0], pair[1]];
        (0..10).map(move |i| {
            let fraction = 0.1 * f64::from(i);
            (x0 + fraction * (x1 - x0), y0 + fraction * (y1 - y0))
        })
    });
    parts.chain(points.last().copied()).collect()
}

/// Formats a compliance (m/Pa) in mm/MPa with three significant digits.
fn rate(m_per_pa: f64) -> String {
    let mm_per_mpa = m_per_pa * 1e9;
    let digits = (2.0 - mm_per_mpa.log10().floor()).clamp(0.0, 9.0) as usize;
    format!("{mm_per_mpa:.digits$} mm/MPa")
}

/// Plots deflection over radius by disc theory, one curve per published pressure.
fn deflection(
    location: &ValveLocation,
    report: &ValveReport,
    hydraulics: &Hydraulics,
) -> Outcome<Option<Panel>> {
    let valve = location.valve_of(hydraulics);
    let Some(pack) = location.pack(hydraulics)? else {
        return Ok(None);
    };
    let colours = ramp(report.pressures.len());
    let curves = report.pressures.iter().zip(colours).map(|(row, colour)| {
        let points = radii(valve, 120)
            .map(|r| (r * 1e3, pack.compliance_m_per_pa(r) * row.pressure_pa * 1e3));
        Curve::new(format!("{:.0} MPa", row.pressure_pa * 1e-6), colour, points)
    });
    Ok(Some(Panel {
        title: format!("{} valve, disc theory", capital(location.name)),
        x_label: "radius, mm".into(),
        y_label: "deflection under uniform pressure, mm".into(),
        legend: Some(SeriesLabelPosition::UpperLeft),
        sides: false,
        x_scale: Scale::Linear,
        scale: Scale::Linear,
        keeps_to_values: false,
        y_range: None,
        curves: curves.collect(),
    }))
}

/// Plots flow over pressure with the lift that the damper model uses.
fn flow(
    location: &ValveLocation,
    report: &ValveReport,
    characteristic: &Characteristic,
    tables_end_pa: f64,
) -> Panel {
    let points = pressures_mpa(tables_end_pa, report.preload_pa).map(|mpa| {
        let flow = characteristic.valve_flow_m3_per_s(location.valve, mpa * 1e6);
        (mpa, flow.unwrap_or(0.0) * 1e6)
    });
    let name = format!("with the lift used ({} × Ce)", report.source());
    Panel {
        title: format!("{} valve", capital(location.name)),
        x_label: "pressure, MPa".into(),
        y_label: "flow through the pack, cm³/s".into(),
        legend: Some(SeriesLabelPosition::UpperLeft),
        sides: false,
        x_scale: Scale::Linear,
        scale: Scale::Linear,
        keeps_to_values: false,
        y_range: None,
        curves: vec![Curve::new(name, GREEN_LINE, points).wide(11)],
    }
}
