//! Plots of `dashpot shims --fe`: deflection over radius and around the edge, stress over radius and over the disc, and
//! the chart of Ce.

use plotters::prelude::SeriesLabelPosition;
use plotters::style::RGBColor;

use super::Solved;
use super::chart::chart;
use super::panel::panel;
use crate::commands::failure::Outcome;
use crate::commands::shims::capital::capital;
use dashpot_report::plot::curves::Curve;
use dashpot_report::plot::map::{DiscMap, maps};
use dashpot_report::plot::sheet::{Layout, Panel, sheet};
use dashpot_report::plot::style::{BLUE_LINE, GREEN_LINE, PALE, RED_LINE};
use dashpot_testbench::plate::Bending;

/// Number of segments per curve.
const PARTS: u32 = 160;

/// Returns the file name and the SVG text of each plot.
pub(in crate::commands::shims) fn draw(solved: &[Solved]) -> Outcome<Vec<(&'static str, String)>> {
    let row = |panels: Vec<Panel>| sheet(Layout::row(panels.len(), 480, 440), &panels);
    let charts = solved.iter().map(chart).collect::<Outcome<Vec<_>>>()?;
    let charts: Vec<Panel> = charts.into_iter().flatten().collect();
    let columns = Layout {
        width: 1040,
        row_height: 440,
        columns: 2,
    };
    let stresses: Vec<DiscMap<'_>> = solved.iter().map(stress_map).collect();
    Ok(vec![
        (
            "plate-deflection.svg",
            row(solved.iter().map(deflection).collect())?,
        ),
        ("plate-edge.svg", row(solved.iter().map(edge).collect())?),
        (
            "plate-stress.svg",
            row(solved.iter().map(stress).collect())?,
        ),
        (
            "plate-stress-map.svg",
            maps(Layout::row(stresses.len(), 480, 480), &stresses)?,
        ),
        ("correction-factor.svg", sheet(columns, &charts)?),
    ])
}

/// Returns curves of a value over the radius: under uniform pressure, over a boss and between two bosses.
fn over_radius(solved: &Solved, value: impl Fn(&Bending, f64, f64) -> f64) -> Vec<Curve> {
    let (clamp, free) = (solved.stack.clamp_radius_m(), solved.stack.free_radius_m());
    let curve = |name: &str, colour: RGBColor, bending: &Bending, angle: f64| {
        let radii = (0..=PARTS).map(|i| clamp + (free - clamp) * f64::from(i) / f64::from(PARTS));
        let points = radii.map(|r| (r * 1e3, value(bending, r, angle)));
        Curve::new(name, colour, points)
    };
    let mut curves = vec![curve("uniform pressure", BLUE_LINE, &solved.whole, 0.0).dashed()];
    if let Some((_, bending)) = &solved.real {
        if bending.is_axisymmetric() {
            curves.push(curve("on the pressure area", RED_LINE, bending, 0.0));
        } else {
            let between = bending.half_pitch_rad();
            curves.push(curve("over a boss", RED_LINE, bending, 0.0));
            curves.push(curve("between bosses", GREEN_LINE, bending, between));
        }
    }
    curves
}

fn deflection(solved: &Solved) -> Panel {
    let curves = over_radius(solved, |bending, r, angle| {
        bending.deflection_m_per_pa(r, angle) * 1e9
    });
    panel(solved, "radius, mm", "deflection, mm/MPa", curves)
}

/// Returns the von Mises stress per pressure at a radius (m) and an angle.
fn von_mises(solved: &Solved, bending: &Bending, radius_m: f64, angle_rad: f64) -> f64 {
    let curvature = bending.curvature(radius_m, angle_rad);
    solved.stack.surface_stress(curvature).von_mises()
}

fn stress(solved: &Solved) -> Panel {
    let curves = over_radius(solved, |bending, r, angle| {
        von_mises(solved, bending, r, angle)
    });
    Panel {
        legend: Some(SeriesLabelPosition::UpperRight),
        ..panel(
            solved,
            "radius, mm",
            "maximum stress of the discs, MPa/MPa",
            curves,
        )
    }
}

/// Plots the lift around the edge.
fn edge(solved: &Solved) -> Panel {
    let free = solved.stack.free_radius_m();
    let round = |name: &str, colour: RGBColor, lift: &dyn Fn(f64) -> f64| {
        let degrees = (0..=2 * PARTS).map(|i| 180.0 * f64::from(i) / f64::from(PARTS));
        Curve::new(
            name,
            colour,
            degrees.map(|degrees| (degrees, lift(degrees.to_radians()) * 1e9)),
        )
    };
    let uniform = solved.stack.uniform_edge_lift_m_per_pa();
    let mut curves = vec![round("uniform pressure", BLUE_LINE, &|_| uniform).dashed()];
    if let Some((_, bending)) = &solved.real {
        let mean = bending.mean_edge_lift_m_per_pa();
        let name = format!("mean: Ce {:.4}", mean / uniform);
        curves.push(round(&name, PALE, &|_| mean).dashed());
        curves.push(round("on the pressure area", RED_LINE, &|angle| {
            bending.deflection_m_per_pa(free, angle)
        }));
    }
    Panel {
        legend: Some(SeriesLabelPosition::MiddleMiddle),
        ..panel(
            solved,
            "angle from a boss, deg",
            "edge lift, mm/MPa",
            curves,
        )
    }
}

fn stress_map(solved: &Solved) -> DiscMap<'_> {
    DiscMap {
        title: format!("{} valve", capital(solved.location.name)),
        value_label: ["von Mises stress,".into(), "MPa/MPa".into()],
        radii_mm: [
            solved.stack.clamp_radius_m() * 1e3,
            solved.stack.free_radius_m() * 1e3,
        ],
        value: Box::new(|radius_mm, angle_rad| {
            von_mises(solved, solved.bending(), radius_mm * 1e-3, angle_rad)
        }),
    }
}
