//! Curves: lines, dashes, points, bands or bars, and their keys in the legend.

use plotters::coord::ranged1d::Ranged;
use plotters::prelude::*;

use super::style::{FINE, failed};
use crate::DrawError;

/// How a curve is drawn.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Stroke {
    /// A solid line.
    Line,
    /// A dashed line.
    Dashes,
    /// Dots without a line.
    Points,
    /// Short strokes on the horizontal axis.
    Marks,
    /// A line over its filled area, down to zero.
    Filled,
    /// The area between a lowest and a highest value.
    Band,
    /// A vertical stroke from the lowest to the highest value.
    Bars,
}

/// One curve: its name in the legend, its colour and its points.
pub struct Curve {
    /// Name in the legend; a curve without a name is not listed.
    pub name: String,
    /// Colour.
    pub colour: RGBColor,
    /// Width of the line in quarters of a pixel.
    pub width: u32,
    /// How the curve is drawn.
    pub stroke: Stroke,
    /// Abscissa, lowest and highest ordinate; these are the same but for bands and bars.
    pub points: Vec<(f64, f64, f64)>,
}

/// A set of axes that curves are drawn on.
type Chart<'a, 'b, X, Y> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<X, Y>>;

impl Curve {
    /// A curve of the usual width; without a name it is not in the legend.
    pub fn new(
        name: impl Into<String>,
        colour: RGBColor,
        points: impl IntoIterator<Item = (f64, f64)>,
    ) -> Self {
        let points = points.into_iter().map(|(x, y)| (x, y, y));
        Self::of(Stroke::Line, name, colour, points)
    }

    /// The area from the lowest to the highest value at each abscissa, `(x, low, high)`: what many runs spread over.
    pub fn band(
        name: impl Into<String>,
        colour: RGBColor,
        points: impl IntoIterator<Item = (f64, f64, f64)>,
    ) -> Self {
        Self::of(Stroke::Band, name, colour, points)
    }

    /// Vertical strokes from the lowest to the highest value at each abscissa, `(x, low, high)`: bars of uncertainty.
    pub fn bars(
        name: impl Into<String>,
        colour: RGBColor,
        points: impl IntoIterator<Item = (f64, f64, f64)>,
    ) -> Self {
        Self::of(Stroke::Bars, name, colour, points)
    }

    fn of(
        stroke: Stroke,
        name: impl Into<String>,
        colour: RGBColor,
        points: impl IntoIterator<Item = (f64, f64, f64)>,
    ) -> Self {
        Self {
            name: name.into(),
            colour,
            width: 2 * FINE,
            stroke,
            points: points.into_iter().collect(),
        }
    }

    /// The same curve drawn `quarters` of a pixel wide.
    pub fn wide(self, quarters: u32) -> Self {
        Self {
            width: quarters,
            ..self
        }
    }

    /// The same curve dashed.
    pub fn dashed(self) -> Self {
        Self {
            stroke: Stroke::Dashes,
            ..self
        }
    }

    /// The same curve as points without a line between them.
    pub fn dotted(self) -> Self {
        Self {
            stroke: Stroke::Points,
            ..self
        }
    }

    /// Marks on the horizontal axis at `abscissas`.
    pub fn marks(colour: RGBColor, abscissas: impl IntoIterator<Item = f64>) -> Self {
        Self {
            stroke: Stroke::Marks,
            ..Self::new("", colour, abscissas.into_iter().map(|x| (x, 0.0)))
        }
    }

    /// The same curve with the area under it filled.
    pub fn filled(self) -> Self {
        Self {
            stroke: Stroke::Filled,
            ..self
        }
    }

    /// Where its points lie along the horizontal axis.
    pub fn abscissas(&self) -> impl Iterator<Item = f64> {
        self.points.iter().map(|(x, ..)| *x)
    }

    /// How high its points lie; marks lie on the axis wherever that is.
    pub fn ordinates(&self) -> impl Iterator<Item = f64> {
        let points = match self.stroke {
            Stroke::Marks => &[],
            _ => &self.points[..],
        };
        points.iter().flat_map(|(_, low, high)| [*low, *high])
    }

    /// Draws it and enters its key into the legend.
    ///
    /// # Errors
    /// The drawing fails.
    pub fn draw<'a, 'b: 'a, X, Y>(&self, chart: &mut Chart<'a, 'b, X, Y>) -> Result<(), DrawError>
    where
        X: Ranged<ValueType = f64> + 'a,
        Y: Ranged<ValueType = f64> + 'a,
    {
        const DASH: i32 = 6 * FINE as i32;
        const KEY: i32 = 22 * FINE as i32;
        const MARK: i32 = 10 * FINE as i32;
        let style = self.colour.stroke_width(self.width);
        let mark = self.colour.filled();
        let radius = 4 * FINE;
        let points = self.points.iter().map(|(x, y, _)| (*x, *y));
        let bottom = chart.y_range().start;
        let drawn = match self.stroke {
            Stroke::Line => chart.draw_series(LineSeries::new(points, style)),
            Stroke::Dashes => chart.draw_series(DashedLineSeries::new(points, DASH, DASH, style)),
            Stroke::Points => chart.draw_series(points.map(|at| Circle::new(at, radius, mark))),
            Stroke::Marks => chart.draw_series(points.map(|(x, _)| {
                EmptyElement::at((x, bottom)) + PathElement::new([(0, 0), (0, -MARK)], style)
            })),
            Stroke::Filled => {
                let area = AreaSeries::new(points, 0.0, self.colour.mix(0.25));
                chart.draw_series(area.border_style(style))
            }
            Stroke::Band => {
                let highs = self.points.iter().rev().map(|(x, _, high)| (*x, *high));
                let outline: Vec<_> = points.chain(highs).collect();
                chart.draw_series([Polygon::new(outline, self.colour.mix(0.25))])
            }
            Stroke::Bars => chart.draw_series(
                (self.points.iter())
                    .map(|(x, low, high)| PathElement::new([(*x, *low), (*x, *high)], style)),
            ),
        }
        .map_err(failed)?;
        if self.name.is_empty() {
            return Ok(());
        }
        drawn.label(&self.name);
        match self.stroke {
            Stroke::Line | Stroke::Filled | Stroke::Marks | Stroke::Bars => {
                drawn.legend(move |(x, y)| PathElement::new([(x, y), (x + KEY, y)], style))
            }
            Stroke::Dashes => drawn.legend(move |at| {
                EmptyElement::at(at)
                    + PathElement::new([(0, 0), (KEY / 2 - DASH / 2, 0)], style)
                    + PathElement::new([(KEY / 2 + DASH / 2, 0), (KEY, 0)], style)
            }),
            Stroke::Points => {
                drawn.legend(move |(x, y)| Circle::new((x + KEY / 2, y), radius, mark))
            }
            Stroke::Band => {
                let pale = self.colour.mix(0.25).filled();
                drawn.legend(move |(x, y)| {
                    Rectangle::new([(x, y - DASH / 2), (x + KEY, y + DASH / 2)], pale)
                })
            }
        };
        Ok(())
    }
}

/// Colours from light to strong for `count` curves of one family.
pub fn ramp(count: usize) -> Vec<RGBColor> {
    let (light, strong) = ([144.0, 190.0, 235.0], [13.0, 58.0, 120.0]);
    (0..count)
        .map(|i| {
            let fraction = i as f64 / (count.max(2) - 1) as f64;
            let mix = |k: usize| (light[k] + fraction * (strong[k] - light[k])) as u8;
            RGBColor(mix(0), mix(1), mix(2))
        })
        .collect()
}
