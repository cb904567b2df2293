//! Colours, fonts, axes and sheets of all plots.

use std::error::Error;
use std::ops::Range;

use plotters::coord::Shift;
use plotters::prelude::*;

use crate::DrawError;

/// Drawing units per pixel. The backend rounds coordinates to whole units, so plots are drawn at this scale to keep
/// curves smooth.
pub const FINE: u32 = 4;
const FONT: &str = "sans-serif";
/// Colour of text and axes.
pub const INK: RGBColor = RGBColor(38, 50, 56);
/// Colour of blue curves.
pub const BLUE_LINE: RGBColor = RGBColor(21, 101, 192);
/// Colour of red curves.
pub const RED_LINE: RGBColor = RGBColor(198, 40, 40);
/// Colour of green curves.
pub const GREEN_LINE: RGBColor = RGBColor(46, 125, 50);
/// Colour of amber curves and of limits.
pub const AMBER_LINE: RGBColor = RGBColor(239, 138, 0);
/// Colour of grey curves in the background.
pub const PALE: RGBColor = RGBColor(160, 168, 176);
/// Usual line width, in drawing units.
pub const LINE: u32 = 2 * FINE;

/// Converts an error of the plotting library.
pub fn failed(error: impl Error + Send + Sync + 'static) -> DrawError {
    DrawError(Box::new(error))
}

/// Drawing area of the SVG backend.
pub type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// Draws on a white sheet of `width` by `height` pixels and returns the SVG text.
///
/// # Errors
/// Returns the error of `paint`, or an error if the plotting library fails.
pub fn draw(
    width: u32,
    height: u32,
    paint: impl FnOnce(&Area<'_>) -> Result<(), DrawError>,
) -> Result<String, DrawError> {
    let mut text = String::new();
    {
        let area =
            SVGBackend::with_string(&mut text, (width * FINE, height * FINE)).into_drawing_area();
        area.fill(&WHITE).map_err(failed)?;
        paint(&area)?;
        area.present().map_err(failed)?;
    }
    let drawn = format!("width=\"{}\" height=\"{}\"", width * FINE, height * FINE);
    Ok(text.replacen(&drawn, &format!("width=\"{width}\" height=\"{height}\""), 1))
}

/// Returns a text style with a font size in pixels.
pub fn letters(size: u32, colour: &'static RGBColor) -> TextStyle<'static> {
    TextStyle::from((FONT, size * FINE).into_font()).color(colour)
}

/// Number of decimals in the labels of an axis.
#[derive(Clone, Copy)]
pub enum Digits {
    /// The same number of decimals for all labels.
    Fixed(usize),
    /// As many decimals as the power of ten of each label needs: 2 for 0.01, none from 1 on.
    OfDecade,
}

impl From<usize> for Digits {
    fn from(digits: usize) -> Self {
        Self::Fixed(digits)
    }
}

/// Formats the label of an axis; zero has no sign.
pub fn label(value: f64, digits: impl Into<Digits>) -> String {
    let digits = match digits.into() {
        Digits::Fixed(digits) => digits,
        Digits::OfDecade => (-value.abs().log10().round()).clamp(0.0, 12.0) as usize,
    };
    let text = format!("{value:.digits$}");
    match text.strip_prefix('-') {
        Some(zero) if zero.chars().all(|c| c == '0' || c == '.') => zero.to_owned(),
        _ => text,
    }
}

/// Draws axes in the common style; `$digits` is a pair: the number of decimals on x and on y.
#[macro_export]
macro_rules! axes {
    ($area:expr, $title:expr, $x:expr, $y:expr, $x_label:expr, $y_label:expr, $digits:expr) => {{
        let title = String::from($title);
        let mut builder = ChartBuilder::on($area);
        if !title.is_empty() {
            builder.caption(
                &title,
                $crate::plot::style::letters(20, &$crate::plot::style::INK),
            );
        }
        let mut chart = builder
            .margin(14 * FINE)
            .x_label_area_size(44 * FINE)
            .y_label_area_size(60 * FINE)
            .build_cartesian_2d($x, $y)
            .map_err(failed)?;
        chart
            .configure_mesh()
            .x_desc($x_label)
            .y_desc($y_label)
            .axis_desc_style(letters(15, &INK))
            .label_style(letters(14, &INK))
            .light_line_style(WHITE)
            .bold_line_style(INK.mix(0.12).stroke_width(FINE))
            .axis_style(INK.mix(0.6).stroke_width(FINE))
            .set_all_tick_mark_size(5 * FINE)
            .x_label_formatter(&|x| $crate::plot::style::label(*x, $digits.0))
            .y_label_formatter(&|y| $crate::plot::style::label(*y, $digits.1))
            // A label is about 40 pixels wide.
            .x_labels((($area.dim_in_pixel().0 / (40 * FINE)) as usize).min(11))
            .y_labels(8)
            .draw()
            .map_err(failed)?;
        chart
    }};
}

pub use axes;

/// Returns the range from the minimum to the maximum of `values`.
pub fn span(values: impl Iterator<Item = f64>) -> Range<f64> {
    values.fold(f64::MAX..f64::MIN, |range, value| {
        range.start.min(value)..range.end.max(value)
    })
}

/// Returns the range of `values`, widened by 5 % at both ends.
pub fn extent(values: impl Iterator<Item = f64>) -> Range<f64> {
    let Range { start, end } = span(values);
    let margin = 0.05 * (end - start).max(1e-6);
    start - margin..end + margin
}
