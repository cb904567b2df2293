//! Limits for measured figures, with one column for each way to measure them.

use std::fmt::Write;

use crate::document;

/// A limit fails as too loose if the measured figure is below this fraction of it.
const MIN_USE: f64 = 0.8;

/// Measured figures by name.
pub type Figures = Vec<(String, f64)>;

/// A table of limits: `figure; column; ...`, one row per figure.
#[derive(Clone, Debug, PartialEq)]
pub struct Budget {
    path: &'static str,
    columns: Vec<String>,
    rows: Vec<(String, Vec<f64>)>,
}

impl Budget {
    /// The budget in a file of the repository.
    pub fn read(path: &'static str) -> Self {
        Self::parse(path, &document::read(path))
    }

    /// The budget of a file's text.
    pub fn parse(path: &'static str, text: &str) -> Self {
        let mut lines = text.lines().map(|line| line.split(';').map(str::trim));
        let header = lines.next().into_iter().flatten().skip(1);
        let columns: Vec<String> = header.map(str::to_owned).collect();
        let rows = lines.map(|mut cells| {
            let name = cells.next().unwrap_or_default().to_owned();
            let numbers = cells.map(|cell| {
                cell.parse()
                    .unwrap_or_else(|error| panic!("{path}: {name}: `{cell}`: {error}"))
            });
            let numbers: Vec<f64> = numbers.collect();
            assert_eq!(
                numbers.len(),
                columns.len(),
                "{path}: {name}: one limit per column"
            );
            (name, numbers)
        });
        let rows = rows.collect();
        Self {
            path,
            columns,
            rows,
        }
    }

    /// Problems with the figures of a column: figures above the limit, far below it or without a row, and rows without
    /// a figure.
    pub fn complaints(&self, column: &str, figures: &[(String, f64)]) -> Vec<String> {
        let Some(column) = self.columns.iter().position(|name| name == column) else {
            return vec![format!("{}: no column {column}", self.path)];
        };
        let mut found = Vec::new();
        for (name, value) in figures {
            let path = self.path;
            match self.rows.iter().find(|(row, _)| row == name) {
                None => found.push(format!("{name}: {value} has no row in {path}")),
                Some((_, limits)) => {
                    let limit = limits[column];
                    if *value > limit {
                        found.push(format!(
                            "{column}: {name}: {value} is above the allowed {limit}"
                        ));
                    } else if *value < MIN_USE * limit {
                        found.push(format!(
                            "{column}: {name}: {value} is far below the allowed {limit}; tighten {path}"
                        ));
                    }
                }
            }
        }
        for (row, _) in &self.rows {
            if !figures.iter().any(|(name, _)| name == row) {
                found.push(format!("{row} in {} is not a measured figure", self.path));
            }
        }
        found
    }

    /// Replaces every limit of a column that is exceeded or far too loose by the figure, rounded up to two digits.
    pub fn adapt(&mut self, column: &str, figures: &[(String, f64)]) {
        let Some(column) = self.columns.iter().position(|name| name == column) else {
            return;
        };
        self.rows
            .retain(|(row, _)| figures.iter().any(|(name, _)| name == row));
        for (name, value) in figures {
            let limit = rounded_up(*value);
            match self.rows.iter_mut().find(|(row, _)| row == name) {
                None => self
                    .rows
                    .push((name.clone(), vec![limit; self.columns.len()])),
                Some((_, limits))
                    if *value > limits[column] || *value < MIN_USE * limits[column] =>
                {
                    limits[column] = limit;
                }
                Some(_) => {}
            }
        }
    }

    /// The text of the file.
    pub fn text(&self) -> String {
        let mut text = format!("figure; {}\n", self.columns.join("; "));
        for (name, limits) in &self.rows {
            let limits: Vec<String> = limits.iter().map(f64::to_string).collect();
            writeln!(text, "{name}; {}", limits.join("; ")).expect("text grows");
        }
        text
    }
}

/// Rounds up to two digits.
fn rounded_up(value: f64) -> f64 {
    let unit = 10_f64.powi((value.max(1.0).log10().floor() as i32 - 1).max(0));
    (value / unit).ceil() * unit
}

#[cfg(test)]
mod tests {
    use super::Budget;

    const TEXT: &str = "figure; m7; m4\nstep; 150; 180\nstack; 120; 120\n";

    fn figures(step: f64) -> [(String, f64); 2] {
        [("step".into(), step), ("stack".into(), 100.0)]
    }

    #[test]
    fn a_budget_is_neither_exceeded_nor_far_too_large() {
        let budget = Budget::parse("budget.csv", TEXT);
        assert_eq!(budget.complaints("m7", &figures(146.0)), [""; 0]);
        let complaint = |step| budget.complaints("m7", &figures(step)).join("\n");
        assert!(
            complaint(151.0).contains("above the allowed 150"),
            "{}",
            complaint(151.0)
        );
        assert!(
            complaint(119.0).contains("far below"),
            "{}",
            complaint(119.0)
        );
        assert_eq!(budget.complaints("m4", &figures(151.0)), [""; 0]);
        let other = budget.complaints("m7", &[("other".into(), 1.0)]).join("\n");
        assert!(
            other.contains("has no row")
                && other.contains("step in budget.csv is not a measured figure")
        );
    }

    #[test]
    fn an_adapted_budget_holds_and_keeps_valid_limits() {
        let mut budget = Budget::parse("budget.csv", TEXT);
        budget.adapt("m7", &figures(1578.0));
        assert_eq!(budget.complaints("m7", &figures(1578.0)), [""; 0]);
        assert_eq!(
            budget.text(),
            "figure; m7; m4\nstep; 1600; 180\nstack; 120; 120\n"
        );
    }
}
