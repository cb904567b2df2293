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
/// Colour of amber curves.
pub const AMBER_LINE: RGBColor = RGBColor(239, 138, 0);
/// Colour of grey curves in the background.
pub const PALE: RGBColor = RGBColor(160, 168, 176);

// Colours by meaning. Colours that share a panel differ in lightness, so that a grey print tells them apart; limits are
// dashed.

/// What is on the left.
pub const LEFT: RGBColor = RGBColor(11, 61, 145);
/// What is on the right.
pub const RIGHT: RGBColor = RGBColor(224, 123, 0);
/// The first of two curves of the same kind.
pub const FIRST: RGBColor = LEFT;
/// The second of two curves of the same kind.
pub const SECOND: RGBColor = RIGHT;
/// Up to four curves of the same kind.
pub const SEVERAL: [RGBColor; 4] = [FIRST, RGBColor(211, 47, 47), SECOND, RGBColor(90, 190, 190)];
/// What a page is about: a computed force, an estimate, the answer of a target.
pub const RESULT: RGBColor = BLUE_LINE;
/// What a result is compared with: a measurement, a reference solution, the desired motion.
pub const COMPARED: RGBColor = PALE;
/// As before a change or as new, next to a result.
pub const BEFORE: RGBColor = AMBER_LINE;
/// Difference of two curves.
pub const DIFFERENCE: RGBColor = RGBColor(123, 31, 162);
/// Limit of a curve.
pub const LIMIT: RGBColor = RED_LINE;
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative luminance, from 0 for black to 1 for white (WCAG 2).
    fn luminance(RGBColor(red, green, blue): RGBColor) -> f64 {
        let linear = |part: u8| match f64::from(part) / 255.0 {
            part if part <= 0.04045 => part / 12.92,
            part => ((part + 0.055) / 1.055).powf(2.4),
        };
        0.2126 * linear(red) + 0.7152 * linear(green) + 0.0722 * linear(blue)
    }

    fn contrast(a: RGBColor, b: RGBColor) -> f64 {
        let [a, b] = [a, b].map(luminance);
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }

    #[test]
    fn colours_of_one_panel_differ_in_lightness() {
        for (name, a, b) in [
            ("left and right", LEFT, RIGHT),
            ("first and second", FIRST, SECOND),
            ("several", SEVERAL[0], SEVERAL[1]),
            ("result and what it is compared with", RESULT, COMPARED),
            ("result and before", RESULT, BEFORE),
        ] {
            let found = contrast(a, b);
            assert!(found > 1.8, "{name}: {found:.2}");
        }
    }

    #[test]
    fn each_of_several_colours_is_lighter_than_the_one_before() {
        for pair in SEVERAL.windows(2) {
            let found = contrast(pair[0], pair[1]);
            assert!(
                luminance(pair[0]) < luminance(pair[1]) && found > 1.3,
                "{pair:?}: {found:.2}"
            );
        }
    }

    #[test]
    fn colours_of_curves_are_visible_on_paper() {
        for colour in [LEFT, RIGHT, RESULT, COMPARED, DIFFERENCE, LIMIT] {
            let found = contrast(colour, WHITE);
            assert!(found > 2.3, "{colour:?}: {found:.2}");
        }
    }
}
