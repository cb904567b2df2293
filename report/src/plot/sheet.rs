//! Sheets: panels of curves in rows.

use std::ops::Range;

use plotters::prelude::*;

use super::curves::Curve;
use super::style::{Area, Digits, FINE, INK, axes, draw, extent, failed, letters, span};
use crate::DrawError;

/// Margin above and below the curves on a logarithmic scale, as a ratio.
const DECADE_MARGIN: f64 = 1.6;

/// Scale of an axis.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// Linear.
    Linear,
    /// Logarithmic, for values above zero.
    Decades,
}

/// Axes with their curves.
pub struct Panel {
    /// Title above the axes.
    pub title: String,
    /// Quantity and unit of the horizontal axis.
    pub x_label: String,
    /// Quantity and unit of the vertical axis.
    pub y_label: String,
    /// Position of the legend on a sheet, if any; on a page the legend is above the curves.
    pub legend: Option<SeriesLabelPosition>,
    /// True to leave margins on the left and right, as for loops; false to fill the width.
    pub sides: bool,
    /// Scale of the horizontal axis.
    pub x_scale: Scale,
    /// Scale of the vertical axis.
    pub scale: Scale,
    /// True if a linear vertical axis covers only the range of its values; false to start it at zero if no value is
    /// negative.
    pub keeps_to_values: bool,
    /// Range of the vertical axis; `None` to find it from the curves.
    pub y_range: Option<Range<f64>>,
    /// Curves, from back to front.
    pub curves: Vec<Curve>,
}

/// Returns a linear panel whose curves fill the width. Curves with a name appear in the legend.
pub fn panel(x: &str, y: &str, curves: Vec<Curve>) -> Panel {
    Panel {
        title: String::new(),
        x_label: x.into(),
        y_label: y.into(),
        legend: None,
        sides: false,
        x_scale: Scale::Linear,
        scale: Scale::Linear,
        keeps_to_values: false,
        y_range: None,
        curves,
    }
}

impl Panel {
    /// Returns the ranges of the horizontal and the vertical axis.
    pub fn ranges(&self) -> [Range<f64>; 2] {
        let on = |scale: Scale| move |value: &f64| scale == Scale::Linear || *value > 0.0;
        let abscissas = self.curves.iter().flat_map(Curve::abscissas);
        let abscissas = abscissas.filter(on(self.x_scale));
        let x = match (self.x_scale, self.sides) {
            (Scale::Linear, true) => extent(abscissas),
            (Scale::Linear, false) => from_zero(span(abscissas)),
            (Scale::Decades, true) => widened(span(abscissas)),
            (Scale::Decades, false) => span(abscissas),
        };
        let ordinates = || self.curves.iter().flat_map(Curve::ordinates);
        let y = match (&self.y_range, self.scale) {
            (Some(range), _) => range.clone(),
            (None, Scale::Linear) => {
                let mut y = extent(ordinates());
                // If no value is below zero, apart from rounding, the axis starts at zero.
                let rounding = 1e-9 * y.end;
                if !self.keeps_to_values && ordinates().all(|y| y >= -rounding) {
                    y.start = 0.0;
                }
                y
            }
            (None, Scale::Decades) => widened(span(ordinates().filter(on(self.scale)))),
        };
        [non_empty(x, self.x_scale), non_empty(y, self.scale)]
    }
}

/// Gives all panels the same vertical axis, so that they can be compared.
pub fn with_one_scale(mut panels: Vec<Panel>) -> Vec<Panel> {
    let own = panels.iter().map(|panel| {
        let [_, y] = panel.ranges();
        y
    });
    let all = own.reduce(|all, one| all.start.min(one.start)..all.end.max(one.end));
    for panel in &mut panels {
        panel.y_range.clone_from(&all);
    }
    panels
}

/// Arrangement of panels on a sheet.
#[derive(Clone, Copy)]
pub struct Layout {
    /// Width of the sheet (pixels).
    pub width: u32,
    /// Height of a row (pixels).
    pub row_height: u32,
    /// Number of panels side by side.
    pub columns: usize,
}

impl Layout {
    /// Creates a layout with one row of panels, each `width` by `height` pixels.
    pub fn row(panels: usize, width: u32, height: u32) -> Self {
        Self {
            width: width * panels as u32,
            row_height: height,
            columns: panels,
        }
    }
}

/// Draws panels on a sheet and returns the SVG text.
///
/// # Errors
/// Returns an error if the plotting library fails.
pub fn sheet(layout: Layout, panels: &[Panel]) -> Result<String, DrawError> {
    let rows = panels.len().div_ceil(layout.columns);
    draw(layout.width, layout.row_height * rows as u32, |area| {
        let cells = area.split_evenly((rows, layout.columns));
        for (cell, panel) in cells.iter().zip(panels) {
            draw_panel(cell, panel)?;
        }
        Ok(())
    })
}

/// Draws curves and legend on axes of the panel's scale.
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
    let [x, y] = panel.ranges();
    let digits = (digits(&x, panel.x_scale), digits(&y, panel.scale));
    match (panel.x_scale, panel.scale) {
        (Scale::Linear, Scale::Linear) => draw_on!(area, panel, x, y, digits),
        (Scale::Linear, Scale::Decades) => draw_on!(area, panel, x, y.log_scale(), digits),
        (Scale::Decades, Scale::Linear) => draw_on!(area, panel, x.log_scale(), y, digits),
        (Scale::Decades, Scale::Decades) => {
            draw_on!(area, panel, x.log_scale(), y.log_scale(), digits)
        }
    }
    Ok(())
}

/// Returns the range, widened if it is a single value; a default range if it has no values.
fn non_empty(range: Range<f64>, scale: Scale) -> Range<f64> {
    let is_single_value = range.start == range.end;
    match scale {
        _ if range.start < range.end => range,
        Scale::Linear if is_single_value => range.start - 0.5..range.end + 0.5,
        Scale::Decades if is_single_value => widened(range),
        Scale::Linear => 0.0..1.0,
        Scale::Decades => 1.0..10.0,
    }
}

/// Adds margins to the range of a logarithmic axis.
fn widened(range: Range<f64>) -> Range<f64> {
    range.start / DECADE_MARGIN..range.end * DECADE_MARGIN
}

/// Moves the start of a range to zero if it is just above zero.
fn from_zero(range: Range<f64>) -> Range<f64> {
    let is_near_zero = (0.0..0.05 * range.end).contains(&range.start);
    if is_near_zero { 0.0..range.end } else { range }
}

/// Returns the number of decimals at which the labels of an axis differ.
fn digits(range: &Range<f64>, scale: Scale) -> Digits {
    if scale == Scale::Decades {
        return Digits::OfDecade;
    }
    let spacing = (range.end - range.start).max(1e-12) / 6.0;
    Digits::Fixed((-spacing.log10().floor()).clamp(0.0, 6.0) as usize)
}

#[cfg(test)]
mod tests {
    use super::super::style::INK;
    use super::*;

    fn ranges(scale: Scale, points: &[(f64, f64)]) -> [Range<f64>; 2] {
        let panel = Panel {
            title: String::new(),
            x_label: String::new(),
            y_label: String::new(),
            legend: None,
            sides: false,
            x_scale: scale,
            scale,
            keeps_to_values: false,
            y_range: None,
            curves: vec![Curve::new("", INK, points.iter().copied())],
        };
        panel.ranges()
    }

    #[test]
    fn logarithmic_axes_ignore_values_up_to_zero() {
        let [x, y] = ranges(Scale::Decades, &[(0.0, 3.0), (2.0, -1.0), (50.0, 40.0)]);
        assert_eq!(x, 2.0..50.0);
        assert!(y.start > 1.0 && y.start < 3.0 && y.end > 40.0);
    }

    #[test]
    fn panels_with_one_scale_show_the_values_of_all() {
        let flat = |y: f64| panel("", "", vec![Curve::new("", INK, [(0.0, -y), (1.0, y)])]);
        let panels = with_one_scale(vec![flat(1.0), flat(3.0), flat(2.0)]);
        for panel in &panels {
            let [_, y] = panel.ranges();
            assert!(y.start < -3.0 && y.end > 3.0 && y.end < 3.5, "{y:?}");
        }
        assert!(with_one_scale(Vec::new()).is_empty());
    }

    #[test]
    fn axes_are_never_empty() {
        for scale in [Scale::Linear, Scale::Decades] {
            for points in [&[][..], &[(7.0, 7.0)], &[(0.0, 0.0)], &[(-1.0, f64::NAN)]] {
                for range in ranges(scale, points) {
                    assert!(range.start < range.end, "{points:?}: {range:?}");
                    assert!(range.start.is_finite() && range.end.is_finite());
                    assert!(scale == Scale::Linear || range.start > 0.0, "{range:?}");
                }
            }
        }
    }
}
