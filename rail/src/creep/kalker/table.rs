//! Kalker's table as a CSV file: its rows, or the line and column of what is wrong.

/// Why there are no Kalker coefficients.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum KalkerError {
    /// Poisson's ratio is out of bounds.
    #[error("Poisson's ratio: {poisson_ratio}, allowed: 0 to 0.5")]
    PoissonRatio {
        /// Poisson's ratio.
        poisson_ratio: f64,
    },
    /// The text is not CSV.
    #[error("{message}")]
    Csv {
        /// What the CSV reader says.
        message: String,
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
    /// A cell is not a number of the table.
    #[error("line {line}: column {column}: {text:?}, allowed: {allowed}")]
    Cell {
        /// Line of the text, counted from 1.
        line: u64,
        /// Name of the column.
        column: &'static str,
        /// Content of the cell.
        text: String,
        /// What is allowed.
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
    /// The parabola through the three values of `nu` is not positive at the Poisson's ratio asked for.
    #[error("column {column}: not positive at a_over_b {ratio} and nu {poisson_ratio}")]
    NotPositive {
        /// Name of the column.
        column: &'static str,
        /// Ratio of the semi-axes.
        ratio: f64,
        /// Poisson's ratio.
        poisson_ratio: f64,
    },
    /// There are fewer than three ratios, or the last one is not complete.
    #[error("{found} rows, allowed: three for each a_over_b, of which there are three or more")]
    Rows {
        /// Number of rows.
        found: usize,
    },
}

/// Names of the columns.
pub(super) const COLUMNS: [&str; 6] = ["a_over_b", "nu", "C11", "C22", "C23", "C33"];

/// One row: ratio of the semi-axes, Poisson's ratio, the four coefficients.
pub(super) type Row = [f64; 6];

/// The rows of `text`, complete and in order; lines that begin with `#` are comments.
pub(super) fn rows(text: &str) -> Result<Vec<Row>, KalkerError> {
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .flexible(true)
        .has_headers(false)
        .trim(csv::Trim::All)
        .from_reader(text.as_bytes());
    let mut rows: Vec<Row> = Vec::new();
    let mut header = false;
    let mut record = csv::StringRecord::new();
    while reader
        .read_record(&mut record)
        .map_err(|error| KalkerError::Csv {
            message: error.to_string(),
        })?
    {
        // The record's own position is that of the comments before it.
        let end = reader.position().byte() as usize;
        let line = || text[..end].trim_end().lines().count() as u64;
        if !header {
            check_header(&record, line)?;
            header = true;
            continue;
        }
        let row = row(&record, line)?;
        if !in_order(&rows, &row) {
            return Err(KalkerError::Order { line: line() });
        }
        rows.push(row);
    }
    if rows.len() < 9 || !rows.len().is_multiple_of(3) {
        return Err(KalkerError::Rows { found: rows.len() });
    }
    Ok(rows)
}

fn check_header(record: &csv::StringRecord, line: impl Fn() -> u64) -> Result<(), KalkerError> {
    if record.iter().eq(COLUMNS) {
        return Ok(());
    }
    Err(KalkerError::Header {
        line: line(),
        found: record.iter().collect::<Vec<_>>().join(","),
    })
}

fn row(record: &csv::StringRecord, line: impl Fn() -> u64) -> Result<Row, KalkerError> {
    if record.len() != COLUMNS.len() {
        return Err(KalkerError::Cells {
            line: line(),
            found: record.len(),
        });
    }
    let mut row = [0.0; COLUMNS.len()];
    for ((number, text), column) in row.iter_mut().zip(record).zip(COLUMNS) {
        *number = cell(column, text).map_err(|allowed| KalkerError::Cell {
            line: line(),
            column,
            text: text.to_owned(),
            allowed,
        })?;
    }
    Ok(row)
}

/// The number in a cell, or what is allowed there.
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

/// Whether `row` may follow `rows`: by rising Poisson's ratio within a ratio of the semi-axes, then by a rising ratio
/// with the Poisson's ratios of the first.
fn in_order(rows: &[Row], row: &Row) -> bool {
    let Some(previous) = rows.last() else {
        return true;
    };
    let first_of_three = rows.len().is_multiple_of(3);
    let ratio_fits = if first_of_three {
        row[0] > previous[0]
    } else {
        row[0] == previous[0]
    };
    let poisson_fits = match rows.get(rows.len() % 3) {
        Some(first) if rows.len() >= 3 => row[1] == first[1],
        _ => row[1] > previous[1],
    };
    ratio_fits && poisson_fits
}
