//! A row of a study: what a case is, and what was observed of it.

use super::arithmetic::Arithmetic;
use super::digest::digest_of_cells;
use super::physics::physics;
use super::study::{Study, StudyCase};

/// What was observed of a case.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Number of the case.
    pub case: u64,
    /// How its run ended.
    pub ending: String,
    /// How the processor that ran it computes; the bits of a row depend on it and on nothing else but the case.
    pub arithmetic: Arithmetic,
    /// The observed indices; none of a run that did not come to its end, or was too short.
    pub observed: Vec<Option<f64>>,
}

/// Why a record is no row of a study.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum RowError {
    /// It has too few or too many columns.
    #[error("{found} columns, allowed: {expected}")]
    Columns {
        /// Columns it has.
        found: usize,
        /// Columns of the study.
        expected: usize,
    },
    /// A cell is not what the study has there.
    #[error("column {column}: `{found}`, allowed: {expected}")]
    Cell {
        /// Column.
        column: String,
        /// What is there.
        found: String,
        /// What may be there.
        expected: String,
    },
    /// It is of another study, another version or another behaviour of the model.
    #[error("column {column}: `{found}`, allowed: {expected}; {reason}")]
    Foreign {
        /// Column.
        column: String,
        /// What is there.
        found: String,
        /// What this program's rows have there.
        expected: String,
        /// Why such rows do not mix.
        reason: &'static str,
    },
    /// Its digest is not that of its cells.
    #[error(
        "column {ROW_DIGEST}: `{found}`, but the cells of this row have {computed}: one of them was altered or damaged"
    )]
    Altered {
        /// The digest in the row.
        found: String,
        /// The digest of its cells.
        computed: String,
    },
}

impl RowError {
    /// Whether the row is whole, but of another study, version or behaviour of the model.
    pub fn is_foreign(&self) -> bool {
        matches!(self, Self::Foreign { .. })
    }
}

/// The column with the digest of a row's other cells.
pub const ROW_DIGEST: &str = "row_digest";

/// The version that rows are of.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

impl Study {
    /// Names of the columns of its rows.
    pub fn columns(&self) -> Vec<String> {
        let mut columns = vec!["case".to_owned(), "sweep".to_owned()];
        columns.extend(self.varied.iter().cloned());
        columns.extend(["seed".to_owned(), "ending".to_owned()]);
        columns.extend(self.observed.iter().map(|index| index.name.to_owned()));
        columns
            .extend(["study", "version", "arithmetic", "physics", ROW_DIGEST].map(str::to_owned));
        columns
    }

    /// A row as text, a cell a column.
    pub fn record(&self, case: &StudyCase<'_>, row: &Row) -> Vec<String> {
        let mut record = vec![case.number.to_string(), case.sweep.name.clone()];
        let values = case.values();
        record.extend(self.varied.iter().map(|parameter| {
            let of_axis = |axis: &dashpot_files::study::Axis| axis.parameter == *parameter;
            let axis = case.sweep.axes.iter().position(of_axis);
            axis.map_or_else(String::new, |axis| values[axis].to_string())
        }));
        record.push(case.seed.map_or_else(String::new, |seed| seed.to_string()));
        record.push(row.ending.clone());
        let number =
            |value: &Option<f64>| value.map_or_else(String::new, |value| format!("{value:?}"));
        record.extend(row.observed.iter().map(number));
        let of = [
            self.digest(),
            VERSION,
            row.arithmetic.word(),
            physics(row.arithmetic),
        ];
        record.extend(of.map(str::to_owned));
        record.push(digest_of_cells(record.iter().map(String::as_str)));
        record
    }

    /// The row of a record.
    ///
    /// # Errors
    /// A record that is not one of this study and version.
    pub fn row<'a>(&self, record: impl Iterator<Item = &'a str>) -> Result<Row, RowError> {
        let columns = self.columns();
        let cells: Vec<&str> = record.collect();
        if cells.len() != columns.len() {
            return Err(RowError::Columns {
                found: cells.len(),
                expected: columns.len(),
            });
        }
        let wrong = |column: usize, expected: String| RowError::Cell {
            column: columns[column].clone(),
            found: cells[column].to_owned(),
            expected,
        };
        let arithmetics = [Arithmetic::Fused, Arithmetic::Separate];
        let of_arithmetic = columns.len() - 3;
        let arithmetic = arithmetics
            .into_iter()
            .find(|one| one.word() == cells[of_arithmetic]);
        let arithmetic =
            arithmetic.ok_or_else(|| wrong(of_arithmetic, "fused or separate".into()))?;
        // The rest of a row of another study, version or physics is not compared.
        for (back, expected, reason) in [
            (5, self.digest(), "rows of different studies do not mix"),
            (4, VERSION, "rows of different versions do not mix"),
            (
                2,
                physics(arithmetic),
                "the model behaves differently now, and rows of different physics do not mix",
            ),
        ] {
            let column = columns.len() - back;
            if cells[column] != expected {
                return Err(RowError::Foreign {
                    column: columns[column].clone(),
                    found: cells[column].to_owned(),
                    expected: expected.to_owned(),
                    reason,
                });
            }
        }
        let number = cells[0].parse::<u64>().ok();
        let case = number.and_then(|number| self.case(number));
        let case = case.ok_or_else(|| wrong(0, format!("0 to {}", self.cases() - 1)))?;
        let ending = 3 + self.varied.len();
        let first = ending + 1;
        let mut observed = Vec::with_capacity(self.observed.len());
        let of_indices = cells.iter().enumerate().skip(first);
        for (column, cell) in of_indices.take(self.observed.len()) {
            let value = cell.parse::<f64>().ok();
            match value.filter(|value| value.is_finite()) {
                None if !cell.is_empty() => {
                    return Err(wrong(column, "a finite number or nothing".into()));
                }
                value => observed.push(value),
            }
        }
        let row = Row {
            case: case.number,
            ending: cells[ending].to_owned(),
            arithmetic,
            observed,
        };
        let expected = self.record(&case, &row);
        if let Some(column) = (0..first).find(|column| expected[*column] != cells[*column]) {
            return Err(wrong(column, format!("`{}`", expected[column])));
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
