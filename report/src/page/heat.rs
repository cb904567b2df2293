//! Heat maps: tables whose cells are shaded by their values. The values are in the cells, so that the shade is not
//! needed to read them.

use maud::{Markup, html};

use crate::plot::style::span;

/// Number of shades; the page's style has a class for each.
const SHADES: usize = 8;

/// Labels and values of an axis of a heat map.
pub struct HeatAxis<'a> {
    /// Quantity and unit.
    pub label: &'a str,
    /// Values as text.
    pub values: Vec<String>,
}

/// Values over two axes.
pub struct HeatMap<'a> {
    /// Quantity and unit of the values.
    pub what: &'a str,
    /// Axis of the rows.
    pub rows: HeatAxis<'a>,
    /// Axis of the columns.
    pub columns: HeatAxis<'a>,
    /// Value of a row and a column; `None` if it is unknown.
    pub value: Box<dyn Fn(usize, usize) -> Option<f64> + 'a>,
}

impl HeatMap<'_> {
    /// Returns the map as a table.
    pub fn html(&self) -> Markup {
        let (rows, columns) = (self.rows.values.len(), self.columns.values.len());
        let all = (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column)));
        let range = span(all.filter_map(|(row, column)| (self.value)(row, column)));
        let shade = |value: f64| {
            let width = range.end - range.start;
            let part = if width > 0.0 {
                (value - range.start) / width
            } else {
                0.0
            };
            ((part * SHADES as f64) as usize).min(SHADES - 1)
        };
        let digits = digits(range.end - range.start);
        html! {
            div.wide { table.heat {
                caption { (self.what) }
                thead {
                    tr { td {} th scope="colgroup" colspan=(columns) { (self.columns.label) } }
                    tr {
                        th scope="col" { (self.rows.label) }
                        @for value in &self.columns.values { th scope="col" { (value) } }
                    }
                }
                tbody {
                    @for (row, name) in self.rows.values.iter().enumerate() {
                        tr {
                            th scope="row" { (name) }
                            @for column in 0..columns {
                                @match (self.value)(row, column) {
                                    Some(value) => td class=(format!("heat-{}", shade(value))) {
                                        (format!("{value:.digits$}").replace('-', "−"))
                                    },
                                    None => td { "–" }
                                }
                            }
                        }
                    }
                }
            } }
        }
    }
}

/// Decimals that resolve a hundredth of a range.
fn digits(width: f64) -> usize {
    match width > 0.0 {
        true => (2.0 - width.log10().floor()).clamp(0.0, 9.0) as usize,
        false => 3,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(value: impl Fn(usize, usize) -> Option<f64> + 'static) -> String {
        let axis = |label, values: [&str; 2]| HeatAxis {
            label,
            values: values.map(String::from).into(),
        };
        let map = HeatMap {
            what: "Y/Q",
            rows: axis("speed, km/h", ["180", "210"]),
            columns: axis("clearance, mm", ["1", "2"]),
            value: Box::new(value),
        };
        map.html().into_string()
    }

    #[test]
    fn the_least_and_the_greatest_value_have_the_outer_shades_and_every_value_is_written() {
        let found = map(|row, column| {
            let value = [[0.5, -1.0], [2.0, f64::NAN]][row][column];
            Some(value).filter(|value| !value.is_nan())
        });
        for cell in [
            "<td class=\"heat-4\">0.50</td><td class=\"heat-0\">−1.00</td>",
            "<td class=\"heat-7\">2.00</td><td>–</td>",
            "<caption>Y/Q</caption>",
            "<th scope=\"row\">210</th>",
            "colspan=\"2\">clearance, mm</th>",
        ] {
            assert!(found.contains(cell), "{cell}: {found}");
        }
    }

    #[test]
    fn a_map_without_contrast_has_one_shade() {
        let found = map(|_, _| Some(7.0));
        assert_eq!(
            found.matches("class=\"heat-0\">7.000<").count(),
            4,
            "{found}"
        );
        assert!(map(|_, _| None).contains("<td>–</td>"));
    }
}
