//! SVG plot of the patches of a wheelset under load, on both profiles.

use dashpot_rail::contact::Pair;
use dashpot_study::loaded_wheelset::{LoadedPatch, LoadedShift, LoadedWheel};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::load::{UnderLoad, shortest};
use dashpot_report::DrawError;
use dashpot_report::plot::style::{
    Area, BLUE_LINE, FINE, INK, LINE, RED_LINE, axes, draw, failed, letters,
};

/// Maximum number of shifts that are drawn.
const MAX_ROWS: usize = 4;
/// Height of a panel, and of the title above all panels, pixels.
const PANEL: u32 = 306;
const TITLE: u32 = 62;
/// Lateral range of a panel from the gauge face, and depth below the top of the rail to which it reaches, mm.
const ACROSS_MM: [f64; 2] = [-30.0, 78.0];
const DEPTH_MM: f64 = 31.0;
/// Height above the top of the rail to which a panel reaches, mm.
const ABOVE_MM: f64 = 22.0;
/// Height at which the highest pressure is drawn, mm, if the scale then is within its bounds, mm per GPa.
const HIGHEST_MM: f64 = 12.0;
const SCALES_MM_PER_GPA: [f64; 2] = [3.0, 8.0];

/// Draws the profiles in contact at a few shifts, the left wheel beside the right one, with the pressure over the width
/// of each patch.
///
/// # Errors
/// The drawing fails.
pub(super) fn patches(
    profiles: &str,
    pairs: [&Pair; 2],
    under_load: &UnderLoad,
) -> Result<String, DrawError> {
    let rows = drawn(&under_load.shifts);
    let title = format!(
        "Contact patches under {} kN per wheel: {profiles}",
        shortest(under_load.running.load_n * 1e-3)
    );
    let highest_gpa = rows
        .iter()
        .flat_map(|shift| shift.wheels())
        .flat_map(|(_, wheel)| &wheel.patches)
        .fold(0.0, |max: f64, patch| {
            max.max(1e-9 * patch.peak_pressure_pa)
        });
    let scale = (HIGHEST_MM / highest_gpa).clamp(SCALES_MM_PER_GPA[0], SCALES_MM_PER_GPA[1]);
    let height = TITLE + PANEL * rows.len().max(1) as u32;
    draw(1000, height, |area| {
        let (top, mut rest) = area.split_vertically(TITLE * FINE);
        let centre = Pos::new(HPos::Center, VPos::Top);
        let middle = (500 * FINE) as i32;
        top.draw_text(
            &title,
            &letters(20, &INK).pos(centre),
            (middle, (10 * FINE) as i32),
        )
        .map_err(failed)?;
        let note = format!(
            "red: pressure over the width of the patch, {scale:.1} mm high per GPa; numbers: position on the wheel, \
             peak pressure and normal load"
        );
        top.draw_text(
            &note,
            &letters(14, &INK).pos(centre),
            (middle, (38 * FINE) as i32),
        )
        .map_err(failed)?;
        for shift in rows {
            let (row, below) = rest.split_vertically(PANEL * FINE);
            let (left, right) = row.split_horizontally(500 * FINE);
            for (side, panel) in [left, right].iter().enumerate() {
                draw_wheel(panel, pairs[side], shift, side, scale)?;
            }
            rest = below;
        }
        Ok(())
    })
}

/// The shifts that are drawn: evenly chosen from those with an equilibrium.
fn drawn(shifts: &[LoadedShift]) -> Vec<&LoadedShift> {
    let standing: Vec<&LoadedShift> = shifts
        .iter()
        .filter(|shift| shift.right.is_some())
        .collect();
    let count = standing.len().min(MAX_ROWS);
    (0..count)
        .map(|k| k * (standing.len() - 1) / (count - 1).max(1))
        .map(|k| standing[k])
        .collect()
}

/// Draws one wheel on its rail; `side` is 0 for the left one. The pressures have the height `scale_mm_per_gpa`.
fn draw_wheel(
    area: &Area<'_>,
    pair: &Pair,
    shift: &LoadedShift,
    side: usize,
    scale_mm_per_gpa: f64,
) -> Result<(), DrawError> {
    let (sign, name) = [(-1.0, "left"), (1.0, "right")][side];
    let wheel: Option<&LoadedWheel> = [&shift.left, &shift.right][side].as_ref();
    let Some(wheel) = wheel else { return Ok(()) };
    let gauge_face_mm = 0.5e3 * pair.installation().gauge_m;
    let ends = ACROSS_MM.map(|across| sign * (gauge_face_mm + across));
    let x = ends[0].min(ends[1])..ends[0].max(ends[1]);
    let title = format!(
        "{name} wheel, shift {:.2} mm, Y/Q {:.2}",
        shift.lateral_shift_m * 1e3,
        wheel.derailment_coefficient
    );
    let mut chart = axes!(
        area,
        title,
        x.clone(),
        -DEPTH_MM..ABOVE_MM,
        "lateral position from the track centre, mm",
        "height, mm",
        (0, 0)
    );
    let is_inside =
        |point: &(f64, f64)| x.contains(&point.0) && (-DEPTH_MM..ABOVE_MM).contains(&point.1);
    let rail = pair.rail().points().iter();
    let rail = rail
        .map(|p| (sign * p.y_m * 1e3, -p.z_m * 1e3))
        .filter(is_inside);
    chart
        .draw_series(LineSeries::new(rail, INK.stroke_width(LINE)))
        .map_err(failed)?;
    let wheel_line = wheel_points(pair, shift, sign).filter(is_inside);
    chart
        .draw_series(LineSeries::new(wheel_line, BLUE_LINE.stroke_width(LINE)))
        .map_err(failed)?;
    for (k, patch) in wheel.patches.iter().enumerate() {
        let outline = pressure(pair, patch, sign, scale_mm_per_gpa);
        let fill = Polygon::new(outline.clone(), RED_LINE.mix(0.35).filled());
        chart.draw_series(std::iter::once(fill)).map_err(failed)?;
        chart
            .draw_series(LineSeries::new(outline, RED_LINE.stroke_width(LINE)))
            .map_err(failed)?;
        // The numbers stand above each other in the wheel, where no line crosses them.
        let at = (
            sign * (gauge_face_mm + 0.5 * (ACROSS_MM[0] + ACROSS_MM[1])),
            ABOVE_MM - 1.5 - 5.0 * k as f64,
        );
        let text = format!(
            "y {:.1} mm: {:.0} MPa, {:.1} kN",
            patch.wheel_y_m * 1e3,
            patch.peak_pressure_pa * 1e-6,
            patch.load_n * 1e-3
        );
        let style = letters(14, &RED_LINE).pos(Pos::new(HPos::Center, VPos::Top));
        chart
            .draw_series(std::iter::once(
                EmptyElement::at(at) + Text::new(text, (0, 0), style),
            ))
            .map_err(failed)?;
    }
    Ok(())
}

/// Points of the wheel over the track, mm: lateral position and height. The yaw, which hardly moves them, is left out.
fn wheel_points(pair: &Pair, shift: &LoadedShift, sign: f64) -> impl Iterator<Item = (f64, f64)> {
    let installation = pair.installation();
    let (radius_m, offset_m) = (installation.wheel_radius_m, installation.datum_offset_m());
    let roll_rad = shift.roll_rad.unwrap_or(0.0);
    let depth_m = shift.vertical_shift_m.unwrap_or(0.0);
    let lateral_m = sign * (shift.lateral_shift_m + radius_m * roll_rad.sin());
    let (sin, cos) = (sign * roll_rad).sin_cos();
    pair.wheel().points().iter().map(move |p| {
        let (along, down) = (offset_m + p.y_m, radius_m + p.z_m);
        let y_m = along * cos - down * sin + lateral_m;
        let z_m = along * sin + down * cos + depth_m - radius_m;
        (sign * y_m * 1e3, -z_m * 1e3)
    })
}

/// Outline of the pressure of a patch on the rail, drawn into the wheel as a half-ellipse over its width, mm.
fn pressure(pair: &Pair, patch: &LoadedPatch, sign: f64, scale_mm_per_gpa: f64) -> Vec<(f64, f64)> {
    const POINTS: i32 = 60;
    let highest_m = scale_mm_per_gpa * 1e-12 * patch.peak_pressure_pa;
    let angle = patch.contact_angle_rad;
    let (mut base, mut top) = (Vec::new(), Vec::new());
    for k in -POINTS..=POINTS {
        let part = f64::from(k) / f64::from(POINTS);
        let y_m = patch.track_y_m + part * patch.semi_axis_across_m * angle.cos();
        let z_m = pair.rail().at(y_m).z_m;
        let height_m = highest_m * (1.0 - part * part).sqrt();
        base.push((sign * y_m * 1e3, -z_m * 1e3));
        top.push((
            sign * (y_m - height_m * angle.sin()) * 1e3,
            (height_m * angle.cos() - z_m) * 1e3,
        ));
    }
    top.reverse();
    base.extend(top);
    base.extend(base.first().copied());
    base
}
