//! Figures of a page: groups of panels.

use std::ops::Range;

use maud::{Markup, PreEscaped, html};
use serde::Serialize;

use super::series::{Columns, Series, key};
use crate::DrawError;
use crate::plot::curves::Curve;
use crate::plot::sheet::{Panel, Scale};
use crate::plot::style::failed;

/// Panels shown together: side by side on a desktop screen, below each other on a phone. They share the cursor.
pub struct Figure {
    /// Panels, from left to right.
    pub panels: Vec<Panel>,
    /// Height of a panel on a desktop screen (pixels).
    pub height: u32,
    /// Name of a group of figures with the same abscissa, which share the cursor across the page; `None` to share it
    /// only within this figure.
    pub cursor_group: Option<&'static str>,
}

/// Data of a panel for the page's script.
#[derive(Serialize)]
struct Plot {
    height: u32,
    x: Axis,
    y: Axis,
    columns: Columns,
    curves: Vec<Series>,
}

/// Data of an axis for the page's script.
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
    /// Returns the figure as HTML; the page's script draws it.
    ///
    /// # Errors
    /// Returns an error if a panel cannot be written as JSON.
    pub(super) fn html(&self, caption: &Markup) -> Result<Markup, DrawError> {
        let panels = self.panels.iter().map(|panel| self.panel(panel));
        let panels: Vec<Markup> = panels.collect::<Result<_, _>>()?;
        // Four panels look better in two rows of two than as three and one.
        let columns = match panels.len() {
            4 => 2,
            count => count.min(3),
        };
        Ok(html! {
            figure data-cursor-group=[self.cursor_group] {
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
            .map(|curve| Series::new(curve, &mut columns))
            .collect();
        let plot = Plot {
            height: self.height,
            x: Axis::new(&panel.x_label, panel.x_scale, x),
            y: Axis::new(&panel.y_label, panel.scale, y),
            columns,
            curves,
        };
        // Escape `<` so that the data cannot contain an end tag.
        let data = serde_json::to_string(&plot).map_err(failed)?;
        let data = data.replace('<', "\\u003c");
        let axes = format!("{} over {}", panel.y_label, panel.x_label);
        let title = [&panel.title, &axes].map(String::as_str);
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

/// Returns the legend: for each named curve, its key, its name and its value at the cursor. A single curve without a
/// name shows its value only.
fn legend(curves: &[Curve]) -> Markup {
    let is_single = curves.iter().filter(|curve| curve.has_values()).count() == 1;
    html! {
        ul {
            @for (number, curve) in curves.iter().enumerate() {
                @if !curve.name.is_empty() || is_single && curve.has_values() {
                    li data-curve=(number) {
                        @if !curve.name.is_empty() { (key(curve)) (curve.name) }
                        span.value {}
                    }
                }
            }
        }
    }
}
