//! Maps of a value over a round disc, its scale in the hole.

use std::f64::consts::TAU;

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::curves::ramp;
use super::sheet::Layout;
use super::style::{Area, FINE, INK, axes, draw, failed, letters};
use crate::report::DrawError;

/// Division of a disc, outwards and round.
const CELLS: (u32, u32) = (30, 120);
/// Shades from nothing to the greatest value.
const SHADES: usize = 6;

/// A value over a disc.
pub(crate) struct DiscMap<'a> {
    pub(crate) title: String,
    /// Name and unit of the value, on lines of their own.
    pub(crate) value_label: [String; 2],
    /// Radii of the disc (mm).
    pub(crate) radii_mm: [f64; 2],
    /// The value, from zero, at a radius (mm) and an angle (rad).
    pub(crate) value: Box<dyn Fn(f64, f64) -> f64 + 'a>,
}

/// Draws maps on a sheet.
///
/// # Errors
/// The drawing fails.
pub(crate) fn maps(layout: Layout, maps: &[DiscMap<'_>]) -> Result<String, DrawError> {
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
    let (out, round) = CELLS;
    let radius = |i: f64| inner + (outer - inner) * i / f64::from(out);
    let angle = |j: f64| TAU * j / f64::from(round);
    let mut values = Vec::new();
    for i in 0..out {
        for j in 0..round {
            let (i, j) = (f64::from(i), f64::from(j));
            values.push((i, j, (map.value)(radius(i + 0.5), angle(j))));
        }
    }
    let greatest = values
        .iter()
        .fold(0.0, |most: f64, (.., value)| most.max(*value));
    let step = round_up(greatest / SHADES as f64);
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
    // The scale stands in the hole, the highest shade above.
    let line = 1.3 * inner / (SHADES + 2) as f64;
    let style = letters(12, &INK).pos(Pos::new(HPos::Center, VPos::Center));
    let mut texts = vec![];
    for (row, text) in map.value_label.iter().enumerate() {
        texts.push((
            0.5 * line * (SHADES as f64 + 1.0) - line * row as f64,
            text.clone(),
        ));
    }
    let digits = (-step.log10().floor()).max(0.0) as usize;
    for (i, shade) in shades.iter().enumerate() {
        let height = 0.5 * line * (SHADES as f64 + 1.0) - line * (1 + SHADES - i) as f64;
        let box_of = [
            (-0.6 * inner, height - 0.4 * line),
            (-0.4 * inner, height + 0.4 * line),
        ];
        chart
            .draw_series([Rectangle::new(box_of, shade.filled())])
            .map_err(failed)?;
        let (from, to) = (step * i as f64, step * (i + 1) as f64);
        texts.push((height, format!("{from:.digits$} to {to:.digits$}")));
    }
    let texts = texts.into_iter().map(|(height, text)| {
        let middle = if text.contains(" to ") {
            0.15 * inner
        } else {
            0.0
        };
        Text::new(text, (middle, height), style.clone())
    });
    chart.draw_series(texts).map_err(failed)?;
    Ok(())
}

/// The next of 1, 2, 2.5 or 5 times a power of ten.
fn round_up(value: f64) -> f64 {
    let value = value.max(1e-12);
    let decade = 10_f64.powf(value.log10().floor());
    let round = [1.0, 2.0, 2.5, 5.0, 10.0].map(|part| part * decade);
    round
        .into_iter()
        .find(|round| *round >= value * (1.0 - 1e-9))
        .unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::round_up;

    #[test]
    fn shades_are_round_numbers() {
        for (value, round) in [
            (0.9, 1.0),
            (1.0, 1.0),
            (1.1, 2.0),
            (2.4, 2.5),
            (3e-5, 5e-5),
            (70.0, 100.0),
        ] {
            assert!((round_up(value) / round - 1.0).abs() < 1e-12, "{value}");
        }
        assert!(round_up(0.0) > 0.0);
    }
}
