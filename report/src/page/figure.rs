//! A figure of a page: panels that are looked at together.

use std::ops::Range;

use maud::{Markup, PreEscaped, html};
use serde::Serialize;

use super::series::{Columns, Series, key};
use crate::DrawError;
use crate::plot::curves::Curve;
use crate::plot::sheet::{Panel, Scale};
use crate::plot::style::failed;

/// Panels that are shown together, side by side on a desk and one below the other on a phone. They share the cursor.
pub struct Figure {
    /// Panels, from left to right.
    pub panels: Vec<Panel>,
    /// Height of a panel on a desk (pixels).
    pub height: u32,
    /// Name of the figures of the page that share the cursor with this one, where their abscissas are the same quantity.
    pub shares: Option<&'static str>,
}

/// A panel whose curves fill the width; those with a name are in its legend.
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
        curves,
    }
}

/// What the page's script draws a panel from.
#[derive(Serialize)]
struct Plot {
    height: u32,
    x: Axis,
    y: Axis,
    columns: Columns,
    curves: Vec<Series>,
}

/// What an axis says and shows.
#[derive(Serialize)]
struct Axis {
    label: String,
    decades: bool,
    range: [f64; 2],
}

impl Axis {
    fn new(label: &str, scale: Scale, Range { start, end }: Range<f64>) -> Self {
        Self {
            label: label.into(),
            decades: scale == Scale::Decades,
            range: [start, end],
        }
    }
}

impl Figure {
    /// The figure in HTML, drawn by the page's script.
    ///
    /// # Errors
    /// A panel cannot be written as JSON.
    pub(super) fn html(&self, caption: &Markup) -> Result<Markup, DrawError> {
        let panels = self.panels.iter().map(|panel| self.panel(panel));
        let panels: Vec<Markup> = panels.collect::<Result<_, _>>()?;
        // Four stand better two by two than three and one.
        let columns = match panels.len() {
            4 => 2,
            count => count.min(3),
        };
        Ok(html! {
            figure data-shares=[self.shares] {
                div class=(format!("panels columns-{columns}")) {
                    @for panel in &panels { (panel) }
                }
                figcaption { (caption) }
            }
        })
    }

    fn panel(&self, panel: &Panel) -> Result<Markup, DrawError> {
        let [x, y] = panel.ranges();
        let mut columns = Columns::default();
        let curves = panel.curves.iter();
        let curves = curves
            .map(|curve| Series::of(curve, &mut columns))
            .collect();
        let plot = Plot {
            height: self.height,
            x: Axis::new(&panel.x_label, panel.x_scale, x),
            y: Axis::new(&panel.y_label, panel.scale, y),
            columns,
            curves,
        };
        // No end tag can be in it.
        let data = serde_json::to_string(&plot).map_err(failed)?;
        let data = data.replace('<', "\\u003c");
        let what = format!("{} over {}", panel.y_label, panel.x_label);
        let title = [&panel.title, &what].map(String::as_str);
        let title = title.into_iter().filter(|text| !text.is_empty());
        Ok(html! {
            div.panel {
                div.head {
                    b { @if panel.title.is_empty() { (panel.y_label) } @else { (panel.title) } }
                    (legend(&panel.curves))
                    span.at {}
                }
                div.plot role="img" aria-label=(title.collect::<Vec<_>>().join(": ")) {}
                script type="application/json" { (PreEscaped(data)) }
            }
        })
    }
}

/// Key, name and place for the value under the cursor of each curve that has a name; of one alone, its value.
fn legend(curves: &[Curve]) -> Markup {
    let is_alone = curves.iter().filter(|curve| curve.has_values()).count() == 1;
    html! {
        ul {
            @for (number, curve) in curves.iter().enumerate() {
                @if !curve.name.is_empty() || is_alone && curve.has_values() {
                    li data-curve=(number) {
                        @if !curve.name.is_empty() { (key(curve)) (curve.name) }
                        span.value {}
                    }
                }
            }
        }
    }
}
