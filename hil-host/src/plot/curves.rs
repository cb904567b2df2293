//! Panels of curves side by side on one sheet.

use plotters::prelude::*;

use super::style::{Area, FINE, INK, axes, draw, extent, failed, letters};
use crate::failure::Outcome;

/// One curve: its name in the legend, its colour and its points.
pub(crate) struct Curve {
    pub(crate) name: String,
    pub(crate) colour: RGBColor,
    /// Width of the line in quarters of a pixel.
    pub(crate) width: u32,
    pub(crate) points: Vec<(f64, f64)>,
}

impl Curve {
    /// A curve of the usual width.
    pub(crate) fn new(
        name: impl Into<String>,
        colour: RGBColor,
        points: impl IntoIterator<Item = (f64, f64)>,
    ) -> Self {
        Self {
            name: name.into(),
            colour,
            width: 2 * FINE,
            points: points.into_iter().collect(),
        }
    }

    /// The same curve drawn `quarters` of a pixel wide.
    pub(crate) fn wide(self, quarters: u32) -> Self {
        Self {
            width: quarters,
            ..self
        }
    }
}

/// One set of axes with its curves.
pub(crate) struct Panel {
    pub(crate) title: String,
    pub(crate) x_label: String,
    pub(crate) y_label: String,
    /// Where the legend stands, if there is one.
    pub(crate) legend: Option<SeriesLabelPosition>,
    /// Whether the curves keep off the sides, as loops do, or fill the width.
    pub(crate) sides: bool,
    pub(crate) curves: Vec<Curve>,
}

/// Draws panels in one row on a sheet of `width` by `height` pixels.
///
/// # Errors
/// The drawing fails.
pub(crate) fn sheet(width: u32, height: u32, panels: &[Panel]) -> Outcome<String> {
    draw(width, height, |area| {
        for (cell, panel) in area.split_evenly((1, panels.len())).iter().zip(panels) {
            draw_panel(cell, panel)?;
        }
        Ok(())
    })
}

fn draw_panel(area: &Area<'_>, panel: &Panel) -> Outcome<()> {
    let points = || panel.curves.iter().flat_map(|curve| &curve.points);
    let x = if panel.sides {
        extent(points().map(|p| p.0))
    } else {
        points().fold(f64::MAX..f64::MIN, |range, p| {
            range.start.min(p.0)..range.end.max(p.0)
        })
    };
    let mut y = extent(points().map(|p| p.1));
    // A curve that starts at zero, but for rounding, keeps zero at the edge.
    let rounding = 1e-9 * y.end;
    if points().all(|p| p.1 >= -rounding) {
        y.start = 0.0;
    }
    let digits = (digits(&x), digits(&y));
    let mut chart = axes!(
        area,
        &panel.title,
        x,
        y,
        &panel.x_label,
        &panel.y_label,
        digits
    );
    for curve in &panel.curves {
        let style = curve.colour.stroke_width(curve.width);
        chart
            .draw_series(LineSeries::new(curve.points.iter().copied(), style))
            .map_err(failed)?
            .label(&curve.name)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 22 * FINE as i32, y)], style));
    }
    if let Some(place) = &panel.legend {
        chart
            .configure_series_labels()
            .position(place.clone())
            .label_font(letters(14, &INK))
            .legend_area_size(30 * FINE)
            .margin(8 * FINE)
            .background_style(WHITE.mix(0.85))
            .border_style(INK.mix(0.2).stroke_width(FINE))
            .draw()
            .map_err(failed)?;
    }
    Ok(())
}

/// Digits behind the point that tell labels of an axis apart.
fn digits(range: &std::ops::Range<f64>) -> usize {
    let apart = (range.end - range.start).max(1e-12) / 6.0;
    (-apart.log10().floor()).clamp(0.0, 6.0) as usize
}

/// Colours from light to strong for `count` curves of one family.
pub(crate) fn ramp(count: usize) -> Vec<RGBColor> {
    let (light, strong) = ([144.0, 190.0, 235.0], [13.0, 58.0, 120.0]);
    (0..count)
        .map(|i| {
            let share = i as f64 / (count.max(2) - 1) as f64;
            let mix = |k: usize| (light[k] + share * (strong[k] - light[k])) as u8;
            RGBColor(mix(0), mix(1), mix(2))
        })
        .collect()
}
