//! Panels of curves in rows on one sheet.

use std::ops::Range;

use plotters::prelude::*;

use super::curves::Curve;
use super::style::{Area, Digits, FINE, INK, axes, draw, extent, failed, letters, span};
use crate::report::DrawError;

/// Margin above and below the curves on a scale of decades, as a ratio.
const DECADE_MARGIN: f64 = 1.6;

/// How a panel's vertical axis is divided.
#[derive(Clone, Copy)]
pub(crate) enum Scale {
    /// Equal lengths are equal differences.
    Linear,
    /// Equal lengths are equal ratios, for values above zero.
    Decades,
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
    pub(crate) scale: Scale,
    pub(crate) curves: Vec<Curve>,
}

/// How panels lie on a sheet.
#[derive(Clone, Copy)]
pub(crate) struct Layout {
    /// Width of the sheet (pixels).
    pub(crate) width: u32,
    /// Height of a row (pixels).
    pub(crate) row_height: u32,
    /// Panels side by side.
    pub(crate) columns: usize,
}

impl Layout {
    /// So many panels in one row, each `width` by `height` pixels.
    pub(crate) fn row(panels: usize, width: u32, height: u32) -> Self {
        Self {
            width: width * panels as u32,
            row_height: height,
            columns: panels,
        }
    }

    /// One panel a row, each `width` by `height` pixels.
    pub(crate) fn column(width: u32, height: u32) -> Self {
        Self {
            width,
            row_height: height,
            columns: 1,
        }
    }
}

/// Draws panels on a sheet.
///
/// # Errors
/// The drawing fails.
pub(crate) fn sheet(layout: Layout, panels: &[Panel]) -> Result<String, DrawError> {
    let rows = panels.len().div_ceil(layout.columns);
    draw(layout.width, layout.row_height * rows as u32, |area| {
        let cells = area.split_evenly((rows, layout.columns));
        for (cell, panel) in cells.iter().zip(panels) {
            draw_panel(cell, panel)?;
        }
        Ok(())
    })
}

/// The curves on axes of the panel's scale, and the legend.
macro_rules! draw_on {
    ($area:expr, $panel:expr, $x:expr, $y:expr, $digits:expr) => {{
        let Panel {
            title,
            x_label,
            y_label,
            ..
        } = $panel;
        let mut chart = axes!($area, title, $x, $y, x_label, y_label, $digits);
        for curve in &$panel.curves {
            curve.draw(&mut chart)?;
        }
        if let Some(position) = &$panel.legend {
            chart
                .configure_series_labels()
                .position(position.clone())
                .label_font(letters(14, &INK))
                .legend_area_size(30 * FINE)
                .margin(8 * FINE)
                .background_style(WHITE.mix(0.85))
                .border_style(INK.mix(0.2).stroke_width(FINE))
                .draw()
                .map_err(failed)?;
        }
    }};
}

fn draw_panel(area: &Area<'_>, panel: &Panel) -> Result<(), DrawError> {
    let abscissas = panel.curves.iter().flat_map(Curve::abscissas);
    let ordinates = || panel.curves.iter().flat_map(Curve::ordinates);
    let x = if panel.sides {
        extent(abscissas)
    } else {
        from_zero(span(abscissas))
    };
    let x_digits = digits(&x);
    match panel.scale {
        Scale::Linear => {
            let mut y = extent(ordinates());
            // A curve that starts at zero, but for rounding, keeps zero at the edge.
            let rounding = 1e-9 * y.end;
            if ordinates().all(|y| y >= -rounding) {
                y.start = 0.0;
            }
            let y_digits = digits(&y);
            draw_on!(area, panel, x, y, (x_digits, y_digits));
        }
        Scale::Decades => {
            let y = span(ordinates());
            let y = y.start / DECADE_MARGIN..y.end * DECADE_MARGIN;
            draw_on!(area, panel, x, y.log_scale(), (x_digits, Digits::OfDecade));
        }
    }
    Ok(())
}

/// An axis that nearly begins at zero begins there.
fn from_zero(range: Range<f64>) -> Range<f64> {
    let nearly = (0.0..0.05 * range.end).contains(&range.start);
    if nearly { 0.0..range.end } else { range }
}

/// Digits behind the point that make the labels of an axis differ.
fn digits(range: &Range<f64>) -> Digits {
    let apart = (range.end - range.start).max(1e-12) / 6.0;
    Digits::Behind((-apart.log10().floor()).clamp(0.0, 6.0) as usize)
}
