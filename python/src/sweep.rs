//! Studies: numbered cases of a vehicle, with one row of indices each.

use dashpot_files::study::{StudyParameters, Value};
use dashpot_study::sweep::{self, Row, Shard};
use numpy::PyArray1;
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::error::{Outcome, Refusal, refuse};
use crate::interruption::{run_cancellable, run_in_thread};
use crate::overrides::path;
use crate::pickled::{Pickled, pickled};
use crate::vehicle::SHARED;
use crate::whole::Whole;

/// A shipped study or a TOML file. Cases are numbered from 0. Each row depends only on its case: its bits are the same
/// in any order and on any number of threads and machines.
///
/// `seeds` replaces the seeds of every sweep that has seeds by 1 to `seeds`. Pickling transfers a study to another
/// process by name; unpickling checks that the files are the same there.
///
/// >>> import dashpot
/// >>> study = dashpot.Study("paper", seeds=1)
/// >>> len(study), study.columns[:3]
/// (67, ['case', 'sweep', 'vertical.reduced.damping_n_s_per_m'])
#[pyclass(module = "dashpot", frozen)]
pub struct Study {
    name: String,
    text: Option<String>,
    seeds: Option<u64>,
    study: sweep::Study,
}

impl Study {
    fn read(name: String, text: Option<String>, seeds: Option<u64>) -> Outcome<Self> {
        let parameters = match &text {
            Some(text) => StudyParameters::parse(&name, text)?,
            None => StudyParameters::load(&name)?,
        };
        let parameters = match seeds {
            Some(seeds) => parameters.with_seeds(seeds),
            None => parameters,
        };
        Ok(Self {
            study: sweep::Study::new(parameters)?,
            name,
            text,
            seeds,
        })
    }

    /// Error for a case number out of range: an `IndexError`, as for Python's own lists.
    fn no_case(&self, number: &Whole) -> Refusal {
        let last = self.study.cases().saturating_sub(1);
        PyIndexError::new_err(format!("case {number}, allowed: 0 to {last}")).into()
    }

    /// A row as a dictionary by column.
    fn in_python<'py>(&self, py: Python<'py>, row: &Row) -> Outcome<Bound<'py, PyDict>> {
        let Some(case) = self.study.case(row.case) else {
            return refuse(format!("case {}: not in this study", row.case));
        };
        let cells = PyDict::new(py);
        for (name, cell) in self
            .study
            .columns()
            .iter()
            .zip(self.study.record(&case, row))
        {
            cells.set_item(name, (!cell.is_empty()).then_some(cell))?;
        }
        cells.set_item("case", row.case)?;
        cells.set_item("seed", case.seed)?;
        for (axis, value) in case.sweep.axes.iter().zip(case.values()) {
            match value {
                Value::Number(number) => cells.set_item(&axis.parameter, number)?,
                Value::Word(word) => cells.set_item(&axis.parameter, word)?,
            }
        }
        for (index, value) in self.study.observed.iter().zip(&row.observed) {
            cells.set_item(index.name, value)?;
        }
        Ok(cells)
    }

    /// Columns of rows: numeric columns as arrays, with NaN for missing values; all others as lists.
    fn columns_of<'py>(&self, py: Python<'py>, rows: &[Row]) -> Outcome<Bound<'py, PyDict>> {
        let dictionaries: Vec<Bound<'py, PyDict>> = rows
            .iter()
            .map(|row| self.in_python(py, row))
            .collect::<Outcome<_>>()?;
        let columns = PyDict::new(py);
        for name in self.study.columns() {
            let cells: Vec<Option<Bound<'py, PyAny>>> = dictionaries
                .iter()
                .map(|row| row.get_item(&name))
                .collect::<PyResult<_>>()?;
            let cells = PyList::new(py, cells)?;
            let is_observed = self.study.observed.iter().any(|index| index.name == name);
            let is_varied = self.study.varied.contains(&name);
            let numbers = cells.extract::<Vec<Option<f64>>>();
            match numbers {
                Ok(numbers) if is_observed || is_varied => {
                    let numbers = numbers.into_iter().map(|number| number.unwrap_or(f64::NAN));
                    columns.set_item(name, PyArray1::from_iter(py, numbers))?;
                }
                _ if name == "case" => {
                    let numbers = rows.iter().map(|row| row.case as i64);
                    columns.set_item(name, PyArray1::from_iter(py, numbers))?;
                }
                _ => columns.set_item(name, cells)?,
            }
        }
        Ok(columns)
    }
}

/// Everything that must match in the receiving process: cases, version and physics.
fn identity(study: &sweep::Study) -> String {
    [study.digest(), sweep::VERSION, sweep::PHYSICS].join(" ")
}

/// Requested number of seeds.
fn seeds_of(seeds: Option<Whole>) -> Outcome<Option<u64>> {
    seeds
        .map(|seeds| seeds.within("seeds", 1..=100_000))
        .transpose()
}

#[pymethods]
impl Study {
    #[new]
    #[pyo3(signature = (name, seeds=None))]
    fn new(py: Python<'_>, name: &Bound<'_, PyAny>, seeds: Option<Whole>) -> Outcome<Self> {
        let (name, seeds) = (path(name)?, seeds_of(seeds)?);
        py.detach(|| Self::read(name, None, seeds))
    }

    /// Reads the study from `text`, the contents of a study file. Errors call it `name`, and files that it names are
    /// relative to the working folder.
    ///
    /// >>> import dashpot
    /// >>> study = dashpot.Study.from_toml('''
    /// ... name = "clearance"
    /// ... observed = ["sperling_vertical"]
    /// ... [[sweep]]
    /// ... name = "clearance"
    /// ... case = "straight-180"
    /// ... seeds = [1, 2]
    /// ... vary = [{ parameter = "vertical.mount.clearance_m", values = [1e-3, 2e-3, 3e-3] }]
    /// ... ''')
    /// >>> len(study)
    /// 6
    #[staticmethod]
    #[pyo3(signature = (text, seeds=None, name="study"))]
    fn from_toml(py: Python<'_>, text: String, seeds: Option<Whole>, name: &str) -> Outcome<Self> {
        let (name, seeds) = (name.to_owned(), seeds_of(seeds)?);
        py.detach(|| Self::read(name, Some(text), seeds))
    }

    /// Names of the columns of a row, as in the command's rows.csv.
    #[getter]
    fn columns(&self) -> Vec<String> {
        self.study.columns()
    }

    /// Digest of the cases: rows of studies with the same digest and version belong together.
    #[getter]
    fn digest(&self) -> &str {
        self.study.digest()
    }

    fn __len__(&self) -> Outcome<usize> {
        match usize::try_from(self.study.cases()) {
            Ok(cases) => Ok(cases),
            Err(error) => refuse(error),
        }
    }

    /// Runs the case with this number and returns its row by column; missing values are `None`. To share a study
    /// between machines, map this over `range(len(study))`, as Dask's `client.map` does. Ctrl-C cancels the run.
    ///
    /// >>> import dashpot
    /// >>> study = dashpot.Study.from_toml('''
    /// ... name = "short"
    /// ... observed = ["derailment_rms"]
    /// ... [[sweep]]
    /// ... name = "short"
    /// ... case = "straight-180"
    /// ... duration_s = 0.2
    /// ... vary = [{ parameter = "speed_km_h", values = [100, 160] }]
    /// ... ''')
    /// >>> row = study.row(1)
    /// >>> row["speed_km_h"], row["ending"]
    /// (160.0, 'completed')
    fn row<'py>(&self, py: Python<'py>, number: Whole) -> Outcome<Bound<'py, PyDict>> {
        let Whole::Count(number) = number else {
            return Err(self.no_case(&number));
        };
        let run =
            |is_unwanted: &dyn Fn() -> bool| sweep::row(&self.study, number, &SHARED, is_unwanted);
        match py.detach(|| run_cancellable(run))?? {
            Some(row) => self.in_python(py, &row),
            None => Err(self.no_case(&Whole::Count(number))),
        }
    }

    /// Runs the cases on `threads` threads, by default one per core, and returns their columns in the order of the
    /// cases, as `pandas.DataFrame` accepts them. `shard` is a pair of a shard's number, from 0, and the number of
    /// shards; only that shard is run. Ctrl-C cancels the run.
    #[pyo3(signature = (*, shard=None, threads=None))]
    fn run<'py>(
        &self,
        py: Python<'py>,
        shard: Option<(Whole, Whole)>,
        threads: Option<Whole>,
    ) -> Outcome<Bound<'py, PyDict>> {
        let shard = match shard {
            Some((Whole::Count(number), Whole::Count(of))) if number < of => {
                Some(Shard { number, count: of })
            }
            Some((number, of)) => {
                return refuse(format!(
                    "shard: {number} of {of}, allowed: 0 to one less than the number of shards"
                ));
            }
            None => None,
        };
        let threads = match threads {
            Some(threads) => threads.within("threads", 1..=1024)? as usize,
            None => dashpot_workers::threads(),
        };
        let rows = py.detach(|| {
            let numbers: Vec<u64> = self.study.part(shard).collect();
            run_in_thread(|is_unwanted| {
                let mut rows = Vec::new();
                let take = |row: Row| -> Outcome<()> {
                    rows.push(row);
                    Ok(())
                };
                sweep::run_with(&self.study, &SHARED, &numbers, threads, is_unwanted, take)?;
                rows.sort_by_key(|row| row.case);
                Ok::<_, Refusal>(rows)
            })
        })??;
        self.columns_of(py, &rows)
    }

    fn __repr__(&self) -> String {
        format!("<Study '{}', {} cases>", self.name, self.study.cases())
    }

    #[staticmethod]
    #[pyo3(name = "_restore")]
    fn restore(
        py: Python<'_>,
        name: String,
        text: Option<String>,
        seeds: Option<Whole>,
        digest: &str,
    ) -> Outcome<Self> {
        let seeds = seeds_of(seeds)?;
        let study = py.detach(|| Self::read(name, text, seeds))?;
        if identity(&study.study) == digest {
            return Ok(study);
        }
        refuse(format!(
            "{}: its files or the version of the package differ from those with which the study was read; install the \
             same package and the same files on every machine",
            study.name
        ))
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> Outcome<Pickled<'py>> {
        let Self {
            name,
            text,
            seeds,
            study,
        } = slf.get();
        let digest = identity(study);
        let arguments = (name.clone(), text.clone(), *seeds, digest);
        pickled(slf.get_type().getattr("_restore")?, arguments)
    }
}
