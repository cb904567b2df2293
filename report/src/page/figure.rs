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
        let name = if panel.title.is_empty() {
            &panel.y_label
        } else {
            &panel.title
        };
        Ok(html! {
            div.panel {
                div.head {
                    b { (name) }
                    @if !name.contains(&panel.y_label) { span.quantity { (panel.y_label) } }
                    (legend(&panel.curves))
                    button.data type="button" title="Save the numbers as CSV" aria-label=(format!("data of {name}")) {
                        "data"
                    }
                }
                div.plot role="img" tabindex="0" aria-label=(description(panel)) {}
                script type="application/json" { (PreEscaped(data)) }
                span.at {}
            }
        })
    }
}

/// Describes a panel for a screen reader: its title, its axes and its curves.
fn description(panel: &Panel) -> String {
    let mut text = format!("{} over {}", panel.y_label, panel.x_label);
    if !panel.title.is_empty() {
        text = format!("{}: {text}", panel.title);
    }
    let names = panel.curves.iter().map(|curve| curve.name.as_str());
    let names: Vec<&str> = names.filter(|name| !name.is_empty()).collect();
    if !names.is_empty() {
        text = format!("{text}. Curves: {}", names.join(", "));
    }
    text
}

/// Returns the legend: for each named curve, a button that hides it, with its key and its name, and its value at the
/// cursor. Nothing hides the only named curve; a single curve without a name shows its value only.
fn legend(curves: &[Curve]) -> Markup {
    let is_single = curves.iter().filter(|curve| curve.has_values()).count() == 1;
    let named = curves.iter().filter(|curve| !curve.name.is_empty()).count();
    html! {
        ul {
            @for (number, curve) in curves.iter().enumerate() {
                @if !curve.name.is_empty() || is_single && curve.has_values() {
                    li data-curve=(number) {
                        @if named > 1 && !curve.name.is_empty() {
                            button type="button" aria-pressed="true" data-curves=(with_companions(curves, number)) {
                                (key(curve)) (curve.name)
                            }
                        } @else if !curve.name.is_empty() {
                            (key(curve)) (curve.name)
                        }
                        span.value {}
                    }
                }
            }
        }
    }
}

/// Returns the numbers of a named curve and of the curves without a name that belong to it.
fn with_companions(curves: &[Curve], number: usize) -> String {
    let unnamed = curves[..number].iter().rev();
    let unnamed = unnamed.take_while(|curve| curve.name.is_empty()).count();
    let numbers = (number - unnamed..=number).map(|number| number.to_string());
    numbers.collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::page::panel;
    use crate::plot::style::{LEFT, LIMIT, RIGHT};

    fn curve(name: &str) -> Curve {
        Curve::new(name, LEFT, [(0.0, 1.0)])
    }

    fn html_of(curves: Vec<Curve>) -> String {
        let figure = Figure {
            panels: vec![panel("time, s", "force, kN", curves)],
            height: 200,
            cursor_group: None,
        };
        figure.html(&html! {}).unwrap().into_string()
    }

    #[test]
    fn a_legend_has_a_button_for_each_named_curve_that_also_hides_its_companions() {
        let bars = Curve::bars("", RIGHT, [(0.0, 1.0, 2.0)]);
        let limit = Curve::new("limit", LIMIT, [(0.0, 1.0)]).dashed();
        let page = html_of(vec![curve("left"), bars, curve("right"), limit]);
        for (numbers, name) in [("0", "left"), ("1 2", "right"), ("3", "limit")] {
            let button = format!("aria-pressed=\"true\" data-curves=\"{numbers}\">");
            let (_, after) = page.split_once(&button).unwrap();
            let (inside, _) = after.split_once("</button>").unwrap();
            assert!(inside.ends_with(&format!("</svg>{name}")), "{inside}");
        }
        assert_eq!(page.matches("aria-pressed").count(), 3);
    }

    #[test]
    fn a_curve_without_a_name_has_no_key() {
        let marks = Curve {
            name: "fault".into(),
            ..Curve::marks(RIGHT, [0.0])
        };
        let page = html_of(vec![curve(""), marks]);
        assert!(
            page.contains("<li data-curve=\"0\"><span class=\"value\">"),
            "{page}"
        );
        assert!(page.contains("</svg>fault<span"), "{page}");
    }

    #[test]
    fn nothing_hides_the_only_curve() {
        for name in ["", "force"] {
            let page = html_of(vec![curve(name)]);
            assert!(!page.contains("aria-pressed"), "{page}");
            assert!(page.contains("<span class=\"value\">"), "{page}");
        }
    }

    #[test]
    fn a_plot_can_have_the_focus_and_says_what_it_shows() {
        let page = html_of(vec![curve("left"), curve(""), curve("right")]);
        let label = "force, kN over time, s. Curves: left, right";
        let plot =
            format!("<div class=\"plot\" role=\"img\" tabindex=\"0\" aria-label=\"{label}\">");
        assert!(page.contains(&plot), "{page}");
    }
}
