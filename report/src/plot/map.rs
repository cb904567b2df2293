//! Maps of a value over an annular disc, with the scale in the hole.

use std::f64::consts::TAU;

use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::curves::ramp;
use super::sheet::Layout;
use super::style::{Area, FINE, INK, axes, draw, failed, letters};
use crate::DrawError;

/// Number of cells in radial and circumferential direction.
const CELLS: (u32, u32) = (30, 120);
/// Number of shades from zero to the maximum.
const SHADES: usize = 6;

/// Map of a value over an annular disc.
pub struct DiscMap<'a> {
    /// Title above the map.
    pub title: String,
    /// Name and unit of the value, one line each.
    pub value_label: [String; 2],
    /// Inner and outer radius of the disc (mm).
    pub radii_mm: [f64; 2],
    /// Value at a radius (mm) and an angle (rad); zero or positive.
    pub value: Box<dyn Fn(f64, f64) -> f64 + 'a>,
}

/// Draws maps on a sheet and returns the SVG text.
///
/// # Errors
/// Returns an error if the plotting library fails.
pub fn maps(layout: Layout, maps: &[DiscMap<'_>]) -> Result<String, DrawError> {
    let rows = maps.len().div_ceil(layout.columns);
    draw(layout.width, layout.row_height * rows as u32, |area| {
        let cells = area.split_evenly((rows, layout.columns));
        for (cell, map) in cells.iter().zip(maps) {
            draw_map(cell, map)?;
        }
        Ok(())
    })
}

fn draw_map(area: &Area<'_>, map: &DiscMap<'_>) -> Result<(), DrawError> {
    let [inner, outer] = map.radii_mm;
    let (radial, circumferential) = CELLS;
    let radius = |i: f64| inner + (outer - inner) * i / f64::from(radial);
    let angle = |j: f64| TAU * j / f64::from(circumferential);
    let mut values = Vec::new();
    for i in 0..radial {
        for j in 0..circumferential {
            let (i, j) = (f64::from(i), f64::from(j));
            values.push((i, j, (map.value)(radius(i + 0.5), angle(j))));
        }
    }
    let max = values
        .iter()
        .fold(0.0, |max: f64, (.., value)| max.max(*value));
    let step = round_up(max / SHADES as f64);
    let shades = ramp(SHADES);
    let side = 1.05 * outer;
    let [x, y] = ["mm", "mm"];
    let mut chart = axes!(
        area,
        &*map.title,
        -side..side,
        -side..side,
        x,
        y,
        (0_usize, 0_usize)
    );
    let cells = values.into_iter().map(|(i, j, value)| {
        let shade = (value.max(0.0) / step) as usize;
        let at = |i: f64, j: f64| (radius(i) * angle(j).cos(), radius(i) * angle(j).sin());
        let corners = vec![
            at(i, j - 0.5),
            at(i + 1.0, j - 0.5),
            at(i + 1.0, j + 0.5),
            at(i, j + 0.5),
        ];
        Polygon::new(corners, shades[shade.min(SHADES - 1)].filled())
    });
    chart.draw_series(cells).map_err(failed)?;
    draw_scale(&mut chart, map, step, &shades)
}

type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// Draws the scale in the hole: name and unit, then one line per shade, the highest values first.
fn draw_scale(
    chart: &mut Chart<'_, '_>,
    map: &DiscMap<'_>,
    step: f64,
    shades: &[RGBColor],
) -> Result<(), DrawError> {
    let inner = map.radii_mm[0];
    let lines = map.value_label.len() + shades.len();
    let line = 1.3 * inner / lines as f64;
    let height = |row: usize| line * (0.5 * (lines as f64 - 1.0) - row as f64);
    let style = letters(12, &INK).pos(Pos::new(HPos::Center, VPos::Center));
    let names = (map.value_label.iter().enumerate())
        .map(|(row, name)| Text::new(name.clone(), (0.0, height(row)), style.clone()));
    chart.draw_series(names).map_err(failed)?;
    let digits = digits(step);
    for (i, shade) in shades.iter().enumerate() {
        let height = height(lines - 1 - i);
        let corner = |x: f64, y: f64| (x * inner, height + y * line);
        let swatch = Rectangle::new([corner(-0.6, -0.4), corner(-0.4, 0.4)], shade.filled());
        let (from, to) = (step * i as f64, step * (i + 1) as f64);
        let range = format!("{from:.digits$} to {to:.digits$}");
        let range = Text::new(range, corner(0.15, 0.0), style.clone());
        chart.draw_series([swatch]).map_err(failed)?;
        chart.draw_series([range]).map_err(failed)?;
    }
    Ok(())
}

/// Returns the number of decimals that a step with at most two significant digits needs.
fn digits(step: f64) -> usize {
    let digits = (-step.log10().floor()).clamp(0.0, 12.0);
    let last = step * 10_f64.powf(digits);
    let more = (last - last.round()).abs() > 1e-6;
    digits as usize + usize::from(more)
}

/// Rounds up to a number with at most two digits times a power of ten.
fn round_up(value: f64) -> f64 {
    let value = value.max(1e-12);
    let decade = 10_f64.powf(value.log10().floor());
    let round = [1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0].map(|part| part * decade);
    round
        .into_iter()
        .find(|round| *round >= value * (1.0 - 1e-9))
        .unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::{digits, round_up};

    #[test]
    fn shades_have_round_limits() {
        for (value, round) in [
            (0.9, 1.0),
            (1.0, 1.0),
            (1.1, 1.2),
            (2.4, 2.5),
            (2.6e-5, 3e-5),
            (81.0, 100.0),
        ] {
            assert!((round_up(value) / round - 1.0).abs() < 1e-12, "{value}");
        }
        assert!(round_up(0.0) > 0.0);
    }

    #[test]
    fn decimals_follow_the_step() {
        for (step, count) in [(50.0, 0), (2.5, 1), (0.2, 1), (0.25, 2), (0.012, 3)] {
            assert_eq!(digits(step), count, "{step}");
        }
    }
}
