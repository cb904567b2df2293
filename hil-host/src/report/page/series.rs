//! A curve as the page's script reads it, and its key in the legend.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use maud::{Markup, html};
use serde::Serialize;

use super::colour::Colour;
use crate::report::plot::curves::{Curve, Stroke};
use crate::report::plot::style::FINE;

/// A curve in JSON.
#[derive(Serialize)]
pub(super) struct Series {
    stroke: &'static str,
    /// Width of its line (pixels).
    width: f64,
    /// Colour on a light and on a dark screen.
    colours: [String; 2],
    /// Whether its abscissas never fall: it is a history, else a loop.
    rises: bool,
    /// Columns of abscissas, lowest and, where they differ from these, highest ordinates: little-endian `f32` in base64.
    columns: Vec<String>,
}

impl Series {
    pub(super) fn of(curve: &Curve) -> Self {
        let points = &curve.points;
        let mut columns = vec![
            column(points.iter().map(|point| point.0)),
            column(points.iter().map(|point| point.1)),
        ];
        if matches!(curve.stroke, Stroke::Band | Stroke::Bars) {
            columns.push(column(points.iter().map(|point| point.2)));
        }
        Self {
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
            columns,
        }
    }
}

/// Numbers as little-endian `f32` in base64.
fn column(values: impl Iterator<Item = f64>) -> String {
    let bytes = values.flat_map(|value| (value as f32).to_le_bytes());
    let bytes: Vec<u8> = bytes.collect();
    BASE64_STANDARD.encode(bytes)
}

impl Curve {
    /// Its colours on a light and on a dark screen.
    fn colours(&self) -> [String; 2] {
        let colour = Colour::from(self.colour);
        [colour, colour.on_dark()].map(|colour| colour.to_string())
    }

    /// Whether it has a value at an abscissa.
    pub(super) fn has_values(&self) -> bool {
        self.stroke != Stroke::Marks
    }
}

/// The key of a curve in the legend; the page's script gives it the colour of the screen.
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
                    path d="M0 6H22" stroke="currentColor" stroke-width=(width.clamp(2.0, 6.0)) stroke-dasharray=[dashes] {}
                }
            }
        }
    }
}
