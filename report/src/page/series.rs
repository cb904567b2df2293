//! Curves as JSON for the page's script, and their keys in the legend.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use maud::{Markup, html};
use serde::Serialize;

use super::colour::Colour;
use crate::plot::curves::{Curve, Stroke};
use crate::plot::style::FINE;

/// Curve as JSON.
#[derive(Serialize)]
pub(super) struct Series {
    name: String,
    stroke: &'static str,
    /// Line width (pixels).
    width: f64,
    /// Colours on a light and on a dark screen.
    colours: [String; 2],
    /// True if the abscissas never decrease (a history), false for a loop.
    rises: bool,
    /// Indices of the panel's columns: abscissas, low ordinates and, for bands and bars, high ordinates.
    columns: Vec<usize>,
}

/// Distinct columns of a panel: little-endian `f32` in base64.
#[derive(Default, Serialize)]
pub(super) struct Columns(Vec<String>);

impl Columns {
    /// Returns the index of the column with these values; adds the column if it does not exist.
    fn index_of(&mut self, values: impl Iterator<Item = f64>) -> usize {
        let bytes = values.flat_map(|value| (value as f32).to_le_bytes());
        let text = BASE64_STANDARD.encode(bytes.collect::<Vec<u8>>());
        let existing = self.0.iter().position(|other| *other == text);
        existing.unwrap_or_else(|| {
            self.0.push(text);
            self.0.len() - 1
        })
    }
}

impl Series {
    pub(super) fn new(curve: &Curve, columns: &mut Columns) -> Self {
        let points = &curve.points;
        let mut indices = vec![
            columns.index_of(points.iter().map(|point| point.x)),
            columns.index_of(points.iter().map(|point| point.low)),
        ];
        if matches!(curve.stroke, Stroke::Band | Stroke::Bars) {
            indices.push(columns.index_of(points.iter().map(|point| point.high)));
        }
        Self {
            name: curve.name.clone(),
            stroke: match curve.stroke {
                Stroke::Line => "line",
                Stroke::Filled => "filled",
                Stroke::Dashes => "dashes",
                Stroke::Points => "points",
                Stroke::Marks => "marks",
                Stroke::Band => "band",
                Stroke::Bars => "bars",
            },
            width: f64::from(curve.width) / f64::from(FINE),
            colours: curve.colours(),
            rises: curve.abscissas().is_sorted(),
            columns: indices,
        }
    }
}

impl Curve {
    /// Returns the colours on a light and on a dark screen.
    fn colours(&self) -> [String; 2] {
        let colour = Colour::from(self.colour);
        [colour, colour.on_dark()].map(|colour| colour.to_string())
    }

    /// True if the curve has a value at each abscissa.
    pub(super) fn has_values(&self) -> bool {
        self.stroke != Stroke::Marks
    }
}

/// Returns the key of a curve in the legend; the page's script sets its colour.
pub(super) fn key(curve: &Curve) -> Markup {
    let width = f64::from(curve.width) / f64::from(FINE);
    let dashes = (curve.stroke == Stroke::Dashes).then_some("7 5");
    html! {
        svg.key viewBox="0 0 22 12" aria-hidden="true" {
            @match curve.stroke {
                Stroke::Points => circle cx="11" cy="6" r="3.5" fill="currentColor" {},
                Stroke::Band => rect width="22" height="12" fill="currentColor" fill-opacity="0.25" {},
                Stroke::Bars => path d="M5 1V11M11 3V9M17 1V11" stroke="currentColor" stroke-width=(width) {},
                Stroke::Line | Stroke::Dashes | Stroke::Marks | Stroke::Filled => {
                    path d="M0 6H22" stroke="currentColor" stroke-width=(width.clamp(2.0, 6.0))
                        stroke-dasharray=[dashes] {}
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use plotters::style::RGBColor;

    use super::*;

    fn as_json(curve: &Curve, columns: &mut Columns) -> serde_json::Value {
        serde_json::to_value(Series::new(curve, columns)).unwrap()
    }

    #[test]
    fn curves_share_their_abscissas_and_bands_have_two_ordinates() {
        let mut columns = Columns::default();
        let grey = RGBColor(9, 9, 9);
        let times = [0.0, 0.5, 1.0];
        let line = Curve::new("mean", grey, times.map(|x| (x, 2.0 * x)));
        let line = as_json(&line, &mut columns);
        let spread = times.map(|x| (x, x, 3.0 * x));
        let band = as_json(&Curve::band("spread", grey, spread), &mut columns);
        let bars = as_json(&Curve::bars("", grey, spread), &mut columns);
        assert_eq!(line["columns"], serde_json::json!([0, 1]));
        // The low ordinates of the band equal its abscissas.
        assert_eq!(band["columns"], serde_json::json!([0, 0, 2]));
        assert_eq!(bars["columns"], band["columns"]);
        assert_eq!(
            (&band["stroke"], &bars["stroke"]),
            (&"band".into(), &"bars".into())
        );
        // 0, 0.5 and 1 are 0x00000000, 0x3f000000 and 0x3f800000.
        assert_eq!(columns.0[0], "AAAAAAAAAD8AAIA/");
    }

    #[test]
    fn a_curve_with_decreasing_abscissas_is_a_loop() {
        let mut columns = Columns::default();
        let mut rises = |abscissas: [f64; 3]| {
            let points = abscissas.map(|x| (x, 0.0));
            let curve = Curve::new("", RGBColor(0, 0, 0), points);
            as_json(&curve, &mut columns)["rises"] == true
        };
        assert!(rises([0.0, 1.0, 1.0]) && !rises([0.0, 1.0, 0.5]));
    }
}
