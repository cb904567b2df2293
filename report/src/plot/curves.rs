//! Curves: lines, dashes, points, bands and bars, with their keys in the legend.

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
    /// Short marks on the horizontal axis.
    Marks,
    /// A line with the area down to zero filled.
    Filled,
    /// The area between low and high ordinates.
    Band,
    /// Vertical strokes from low to high ordinates.
    Bars,
}

/// Point of a curve. Low and high ordinates are equal except for bands and bars.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Abscissa.
    pub x: f64,
    /// Low ordinate.
    pub low: f64,
    /// High ordinate.
    pub high: f64,
}

/// Curve of a panel.
pub struct Curve {
    /// Name in the legend; empty to leave it out. On a page, curves without a name belong to the next curve with one:
    /// they disappear with it.
    pub name: String,
    /// Colour.
    pub colour: RGBColor,
    /// Line width in quarters of a pixel.
    pub width: u32,
    /// How the curve is drawn.
    pub stroke: Stroke,
    /// Points in drawing order.
    pub points: Vec<Point>,
}

/// Axes on which curves are drawn.
type Chart<'a, 'b, X, Y> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<X, Y>>;

impl Curve {
    /// Creates a solid line of the usual width; an empty name leaves it out of the legend.
    pub fn new(
        name: impl Into<String>,
        colour: RGBColor,
        points: impl IntoIterator<Item = (f64, f64)>,
    ) -> Self {
        let points = points.into_iter().map(|(x, y)| (x, y, y));
        Self::with_stroke(Stroke::Line, name, colour, points)
    }

    /// Creates a filled area between two ordinates from points `(x, low, high)`, for example for the spread of many
    /// runs.
    pub fn band(
        name: impl Into<String>,
        colour: RGBColor,
        points: impl IntoIterator<Item = (f64, f64, f64)>,
    ) -> Self {
        Self::with_stroke(Stroke::Band, name, colour, points)
    }

    /// Creates error bars from points `(x, low, high)`.
    pub fn bars(
        name: impl Into<String>,
        colour: RGBColor,
        points: impl IntoIterator<Item = (f64, f64, f64)>,
    ) -> Self {
        Self::with_stroke(Stroke::Bars, name, colour, points)
    }

    fn with_stroke(
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
            points: points
                .into_iter()
                .map(|(x, low, high)| Point { x, low, high })
                .collect(),
        }
    }

    /// Sets the line width to `quarters` of a pixel.
    pub fn wide(self, quarters: u32) -> Self {
        Self {
            width: quarters,
            ..self
        }
    }

    /// Draws the curve dashed.
    pub fn dashed(self) -> Self {
        Self {
            stroke: Stroke::Dashes,
            ..self
        }
    }

    /// Draws the curve as dots without a line.
    pub fn dotted(self) -> Self {
        Self {
            stroke: Stroke::Points,
            ..self
        }
    }

    /// Creates marks on the horizontal axis at `abscissas`.
    pub fn marks(colour: RGBColor, abscissas: impl IntoIterator<Item = f64>) -> Self {
        Self {
            stroke: Stroke::Marks,
            ..Self::new("", colour, abscissas.into_iter().map(|x| (x, 0.0)))
        }
    }

    /// Fills the area between the curve and zero.
    pub fn filled(self) -> Self {
        Self {
            stroke: Stroke::Filled,
            ..self
        }
    }

    /// Returns the abscissas of the points.
    pub fn abscissas(&self) -> impl Iterator<Item = f64> {
        self.points.iter().map(|point| point.x)
    }

    /// Returns the low and high ordinates of the points; none for marks, which are always on the axis.
    pub fn ordinates(&self) -> impl Iterator<Item = f64> {
        let points = match self.stroke {
            Stroke::Marks => &[],
            _ => &self.points[..],
        };
        points.iter().flat_map(|point| [point.low, point.high])
    }

    /// Draws the curve and adds its key to the legend.
    ///
    /// # Errors
    /// Returns an error if the plotting library fails.
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
        let points = self.points.iter().map(|point| (point.x, point.low));
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
                let highs = self.points.iter().rev().map(|point| (point.x, point.high));
                let outline: Vec<_> = points.chain(highs).collect();
                chart.draw_series([Polygon::new(outline, self.colour.mix(0.25))])
            }
            Stroke::Bars => {
                chart.draw_series((self.points.iter()).map(|Point { x, low, high }| {
                    PathElement::new([(*x, *low), (*x, *high)], style)
                }))
            }
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

/// Returns colours from light to dark for `count` curves of one family.
pub fn ramp(count: usize) -> Vec<RGBColor> {
    let (light, dark) = ([144.0, 190.0, 235.0], [13.0, 58.0, 120.0]);
    (0..count)
        .map(|i| {
            let fraction = i as f64 / (count.max(2) - 1) as f64;
            let mix = |k: usize| (light[k] + fraction * (dark[k] - light[k])) as u8;
            RGBColor(mix(0), mix(1), mix(2))
        })
        .collect()
}
