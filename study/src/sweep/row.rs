//! Row of a study: the values of a case and its observed indices.

use super::digest::digest_of_cells;
use super::physics::PHYSICS;
use super::study::{Study, StudyCase};

/// Result of a case; the same bits on every processor.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Number of the case.
    pub case: u64,
    /// Ending of the run, as text.
    pub ending: String,
    /// Observed indices; an index is `None` if the run did not complete or was too short.
    pub observed: Vec<Option<f64>>,
}

/// Error from parsing a record as a row of a study.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum RowError {
    /// Wrong number of columns.
    #[error("{found} columns, allowed: {expected}")]
    Columns {
        /// Number of columns found.
        found: usize,
        /// Number of columns of the study.
        expected: usize,
    },
    /// Invalid cell.
    #[error("column {column}: `{found}`, allowed: {expected}")]
    Cell {
        /// Name of the column.
        column: String,
        /// Content of the cell.
        found: String,
        /// Allowed content.
        expected: String,
    },
    /// The row belongs to another study, version or behaviour of the model.
    #[error("column {column}: `{found}`, allowed: {expected}; {reason}")]
    Foreign {
        /// Name of the column.
        column: String,
        /// Content of the cell.
        found: String,
        /// Content that this program writes.
        expected: String,
        /// Reason why such rows cannot be mixed.
        reason: &'static str,
    },
    /// The digest does not match the cells.
    #[error(
        "column {ROW_DIGEST}: `{found}`, but the digest of this row's cells is {computed}: a cell was \
         altered or damaged"
    )]
    Altered {
        /// Digest that the row contains.
        found: String,
        /// Digest computed from the cells.
        computed: String,
    },
}

impl RowError {
    /// True if the row is intact but belongs to another study, version or behaviour of the model.
    pub fn is_foreign(&self) -> bool {
        matches!(self, Self::Foreign { .. })
    }
}

/// Name of the column that contains the digest of the other cells.
pub const ROW_DIGEST: &str = "row_digest";

/// Version that this program writes into rows.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Column that says where a row comes from.
#[derive(Debug, Clone, Copy)]
pub(super) struct Origin<'a> {
    column: &'static str,
    /// Content that this program writes.
    pub expected: &'a str,
    /// Reason why rows of other origins cannot be mixed.
    reason: &'static str,
}

/// Version of the program.
pub(super) const OF_VERSION: Origin<'static> = Origin {
    column: "version",
    expected: VERSION,
    reason: "rows of different versions cannot be mixed",
};

/// Behaviour of the model.
pub(super) const OF_PHYSICS: Origin<'static> = Origin {
    column: "physics",
    expected: PHYSICS,
    reason: "the model behaves differently now, and rows of different physics cannot be mixed",
};

impl Origin<'_> {
    /// Error for a row of another origin.
    pub fn error(self, found: &str) -> RowError {
        RowError::Foreign {
            column: self.column.to_owned(),
            found: found.to_owned(),
            expected: self.expected.to_owned(),
            reason: self.reason,
        }
    }
}

impl Study {
    /// Returns the names of the columns of a row.
    pub fn columns(&self) -> Vec<String> {
        let mut columns = vec!["case".to_owned(), "sweep".to_owned()];
        columns.extend(self.varied.iter().cloned());
        columns.extend(["seed".to_owned(), "ending".to_owned()]);
        columns.extend(self.observed.iter().map(|index| index.name.to_owned()));
        columns.extend(["study", "version", "physics", ROW_DIGEST].map(str::to_owned));
        columns
    }

    /// Formats a row, one cell per column.
    pub fn record(&self, case: &StudyCase<'_>, row: &Row) -> Vec<String> {
        let mut record = vec![case.number.to_string(), case.sweep.name.clone()];
        let values = case.values();
        record.extend(self.varied.iter().map(|parameter| {
            let varies = |axis: &dashpot_files::study::Axis| axis.parameter == *parameter;
            let axis = case.sweep.axes.iter().position(varies);
            axis.map_or_else(String::new, |axis| values[axis].to_string())
        }));
        record.push(case.seed.map_or_else(String::new, |seed| seed.to_string()));
        record.push(row.ending.clone());
        let number =
            |value: &Option<f64>| value.map_or_else(String::new, |value| format!("{value:?}"));
        record.extend(row.observed.iter().map(number));
        let provenance = [self.digest(), VERSION, PHYSICS];
        record.extend(provenance.map(str::to_owned));
        record.push(digest_of_cells(record.iter().map(String::as_str)));
        record
    }

    /// Digest of a row; `None` if the study does not have its case.
    pub fn digest_of(&self, row: &Row) -> Option<String> {
        self.record(&self.case(row.case)?, row).pop()
    }

    /// Parses a record as a row.
    ///
    /// # Errors
    /// Returns an error for an invalid record, or for a record of another study or version.
    pub fn row<'a>(&self, record: impl Iterator<Item = &'a str>) -> Result<Row, RowError> {
        let columns = self.columns();
        let cells: Vec<&str> = record.collect();
        if cells.len() != columns.len() {
            return Err(RowError::Columns {
                found: cells.len(),
                expected: columns.len(),
            });
        }
        let invalid = |column: usize, expected: String| RowError::Cell {
            column: columns[column].clone(),
            found: cells[column].to_owned(),
            expected,
        };
        // The other cells of a row of another study, version or physics are not compared.
        let study = Origin {
            column: "study",
            expected: self.digest(),
            reason: "rows of different studies cannot be mixed",
        };
        for (back, origin) in [(4, study), (3, OF_VERSION), (2, OF_PHYSICS)] {
            let found = cells[columns.len() - back];
            if found != origin.expected {
                return Err(origin.error(found));
            }
        }
        let number = cells[0].parse::<u64>().ok();
        let case = number.and_then(|number| self.case(number));
        let case = case.ok_or_else(|| invalid(0, format!("0 to {}", self.cases() - 1)))?;
        let ending = 3 + self.varied.len();
        let first = ending + 1;
        let mut observed = Vec::with_capacity(self.observed.len());
        let index_cells = cells.iter().enumerate().skip(first);
        for (column, cell) in index_cells.take(self.observed.len()) {
            let value = cell.parse::<f64>().ok();
            match value.filter(|value| value.is_finite()) {
                None if !cell.is_empty() => {
                    return Err(invalid(column, "a finite number or an empty cell".into()));
                }
                value => observed.push(value),
            }
        }
        let row = Row {
            case: case.number,
            ending: cells[ending].to_owned(),
            observed,
        };
        let expected = self.record(&case, &row);
        if let Some(column) = (0..first).find(|column| expected[*column] != cells[*column]) {
            return Err(invalid(column, format!("`{}`", expected[column])));
        }
        let last = columns.len() - 1;
        let computed = digest_of_cells(cells[..last].iter().copied());
        if cells[last] != computed {
            return Err(RowError::Altered {
                found: cells[last].to_owned(),
                computed,
            });
        }
        Ok(row)
    }
}
