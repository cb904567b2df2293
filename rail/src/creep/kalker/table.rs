//! Reader of Kalker's table, a file of comma-separated values.

use super::KalkerCoefficients;

/// Errors from reading Kalker's table, or from an invalid Poisson's ratio.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum KalkerError {
    /// Poisson's ratio is out of bounds.
    #[error("Poisson's ratio: {poisson_ratio}, allowed: 0 to 0.5")]
    PoissonRatio {
        /// Poisson's ratio.
        poisson_ratio: f64,
    },
    /// The first line does not name the columns.
    #[error("line {line}: columns {found:?}, allowed: {}", COLUMNS.join(","))]
    Header {
        /// Line of the text, counted from 1.
        line: u64,
        /// The line's cells, joined by commas.
        found: String,
    },
    /// A row does not have six cells.
    #[error("line {line}: {found} cells, allowed: 6")]
    Cells {
        /// Line of the text, counted from 1.
        line: u64,
        /// Number of cells found.
        found: usize,
    },
    /// A cell is not a number within the bounds of its column.
    #[error("line {line}: column {column}: {text:?}, allowed: {allowed}")]
    Cell {
        /// Line of the text, counted from 1.
        line: u64,
        /// Name of the column.
        column: &'static str,
        /// Content of the cell.
        text: String,
        /// Allowed content.
        allowed: &'static str,
    },
    /// The rows are not in order.
    #[error(
        "line {line}: rows out of order, allowed: rising a_over_b, each with the same three rising nu"
    )]
    Order {
        /// Line of the text, counted from 1.
        line: u64,
    },
    /// The parabola through the three values of `nu` is not positive at the requested Poisson's ratio.
    #[error("column {column}: not positive at a_over_b {ratio} and nu {poisson_ratio}")]
    NotPositive {
        /// Name of the column.
        column: &'static str,
        /// Ratio of the semi-axes.
        ratio: f64,
        /// Poisson's ratio.
        poisson_ratio: f64,
    },
    /// There are fewer than three ratios, or the last one is incomplete.
    #[error(
        "{found} rows, allowed: three for each a_over_b, with three or more values of a_over_b"
    )]
    Rows {
        /// Number of rows.
        found: usize,
    },
}

/// Names of the columns.
pub(super) const COLUMNS: [&str; 6] = ["a_over_b", "nu", "C11", "C22", "C23", "C33"];

/// One row of the table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Row {
    /// Ratio `a/b` of the semi-axes.
    pub ratio: f64,
    pub poisson_ratio: f64,
    pub coefficients: KalkerCoefficients,
}

/// Reads all rows of `text` and checks that they are complete and in order. Lines that begin with `#` are comments.
pub(super) fn rows(text: &str) -> Result<Vec<Row>, KalkerError> {
    let mut rows: Vec<Row> = Vec::new();
    let mut header = false;
    for (line, content) in (1..).zip(text.lines()) {
        if content.trim().is_empty() || content.starts_with('#') {
            continue;
        }
        let cells: Vec<&str> = content.split(',').map(str::trim).collect();
        if !header {
            check_header(line, &cells)?;
            header = true;
            continue;
        }
        let row = row(line, &cells)?;
        if !in_order(&rows, &row) {
            return Err(KalkerError::Order { line });
        }
        rows.push(row);
    }
    if rows.len() < 9 || !rows.len().is_multiple_of(3) {
        return Err(KalkerError::Rows { found: rows.len() });
    }
    Ok(rows)
}

fn check_header(line: u64, cells: &[&str]) -> Result<(), KalkerError> {
    if *cells == COLUMNS {
        return Ok(());
    }
    Err(KalkerError::Header {
        line,
        found: cells.join(","),
    })
}

fn row(line: u64, cells: &[&str]) -> Result<Row, KalkerError> {
    if cells.len() != COLUMNS.len() {
        return Err(KalkerError::Cells {
            line,
            found: cells.len(),
        });
    }
    let mut numbers = [0.0; COLUMNS.len()];
    for ((number, text), column) in numbers.iter_mut().zip(cells).zip(COLUMNS) {
        *number = cell(column, text).map_err(|allowed| KalkerError::Cell {
            line,
            column,
            text: (*text).to_owned(),
            allowed,
        })?;
    }
    let [ratio, poisson_ratio, c11, c22, c23, c33] = numbers;
    Ok(Row {
        ratio,
        poisson_ratio,
        coefficients: KalkerCoefficients { c11, c22, c23, c33 },
    })
}

/// Parses the number in a cell; the error states the allowed values.
fn cell(column: &str, text: &str) -> Result<f64, &'static str> {
    let number = text.parse().ok().filter(|number: &f64| number.is_finite());
    if column == "nu" {
        number
            .filter(|nu| (0.0..=0.5).contains(nu))
            .ok_or("a number from 0 to 0.5")
    } else {
        number
            .filter(|number| *number > 0.0)
            .ok_or("a positive number")
    }
}

/// True if `row` may follow `rows`: `nu` rises within a ratio, the ratios rise, and all have the same values of `nu`.
fn in_order(rows: &[Row], row: &Row) -> bool {
    let Some(previous) = rows.last() else {
        return true;
    };
    let first_of_three = rows.len().is_multiple_of(3);
    let ratio_fits = if first_of_three {
        row.ratio > previous.ratio
    } else {
        row.ratio == previous.ratio
    };
    let poisson_fits = match rows.get(rows.len() % 3) {
        Some(first) if rows.len() >= 3 => row.poisson_ratio == first.poisson_ratio,
        _ => row.poisson_ratio > previous.poisson_ratio,
    };
    ratio_fits && poisson_fits
}
