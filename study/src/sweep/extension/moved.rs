//! Rows of an earlier study as rows of the study that extends it.

use std::collections::BTreeMap;
use std::path::Path;

use super::differences::differences;
use super::kept::Kept;
use super::outline::Outline;
use crate::sweep::observed::IndexValues;
use crate::sweep::row::{OF_PHYSICS, OF_VERSION, Row};
use crate::sweep::rows::{self, Rows, RowsError};
use crate::sweep::study::{Study, StudyCase};
use dashpot_files::FileError;
use dashpot_files::study::Axis;

/// Rows that come from an earlier study.
#[derive(Debug, Default)]
pub struct Moved {
    /// New number of the case of a row, by its number and its digest in the earlier study.
    pub cases: BTreeMap<(u64, String), u64>,
    /// Indices of the cases, by new number, of those that are known.
    pub indices: BTreeMap<u64, IndexValues>,
    /// Digests of the earlier studies.
    pub studies: Vec<String>,
    /// Cases that lack an index, by name of the first one.
    pub lacking: BTreeMap<String, Vec<u64>>,
}

/// Reason why rows of an earlier study cannot be used.
#[derive(Debug, thiserror::Error)]
#[error(
    "the rows belong to study {digest}, and the study now differs in more than additional seeds, values, sweeps or \
     indices: {}",
    reasons.join("; ")
)]
pub struct NotAnExtension {
    digest: String,
    reasons: Vec<String>,
}

/// Reads the rows of the file at `path` from its `bytes`. Rows of an earlier study that `kept` outlines become rows of
/// this study if it only has more seeds, values, sweeps or indices; `moved` lists them.
///
/// # Errors
/// Returns an error for a damaged row, a row of another study, version or physics, and a case that occurs twice.
pub fn read_rows(
    study: &Study,
    kept: &Kept,
    (path, bytes): (&Path, &[u8]),
    moved: &mut Moved,
) -> Result<Rows, RowsError> {
    let mut all = Rows::new();
    for (first_line, section) in rows::sections(bytes) {
        if rows::is_header(section) {
            continue;
        }
        let earlier = earlier(study, kept, path, section)?;
        let Some(earlier) = earlier else {
            let read = rows::parse_from(study, path, section, first_line)?;
            all.extend(rows::index_by_case(path, read)?);
            continue;
        };
        let read = rows::parse_from(&earlier, path, section, first_line)?;
        let read = rows::index_by_case(path, read)?;
        if !moved.studies.iter().any(|known| known == earlier.digest()) {
            moved.studies.push(earlier.digest().to_owned());
        }
        for row in read.values() {
            if let Some(row) = moved.take(study, &earlier, kept, row) {
                all.insert(row.case, row);
            }
        }
    }
    Ok(all)
}

/// Earlier study of the rows in `section`; `None` if they are of this study, or if nothing is known about theirs.
fn earlier(
    study: &Study,
    kept: &Kept,
    path: &Path,
    section: &[u8],
) -> Result<Option<Study>, RowsError> {
    let Some([digest, version, physics]) = rows::provenance(section) else {
        return Ok(None);
    };
    let Some(outline) = kept.outline(&digest).filter(|_| digest != study.digest()) else {
        return Ok(None);
    };
    let foreign = |reason: String| RowsError::Foreign(FileError::in_file(path, reason));
    // The outline of another version may have the digest of the same cases computed in another way.
    for (origin, found) in [(OF_VERSION, version), (OF_PHYSICS, physics)] {
        if found != origin.expected {
            return Err(foreign(origin.error(&found).to_string()));
        }
    }
    match restricted(study, outline) {
        Ok(earlier) => Ok(Some(earlier)),
        Err(reasons) => Err(foreign(NotAnExtension { digest, reasons }.to_string())),
    }
}

/// Builds the study of an outline from the files of today.
///
/// # Errors
/// Returns what differs.
fn restricted(study: &Study, outline: &Outline) -> Result<Study, Vec<String>> {
    let parameters = outline.within(study).map_err(|reason| vec![reason])?;
    let earlier = Study::new(parameters).map_err(|error| vec![error.to_string()])?;
    if earlier.digest() == outline.digest {
        return Ok(earlier);
    }
    let now = Outline::of(&earlier).map_err(|error| vec![error.to_string()])?;
    let mut reasons = differences(outline, &now);
    if reasons.is_empty() {
        reasons.push("its cases have another digest now".into());
    }
    Err(reasons)
}

/// Number in `study` of the case with the sweep, values and seed of a case of another study.
fn number_in(study: &Study, case: &StudyCase<'_>) -> Option<u64> {
    let sweep = study.parameters.sweep(&case.sweep.name)?;
    let values = case.values();
    let mut point = 0;
    for axis in &sweep.axes {
        let same = |other: &Axis| other.parameter == axis.parameter;
        let value = values[case.sweep.axes.iter().position(same)?];
        let at = axis.values.iter().position(|other| other == value)?;
        point = point * axis.values.len() as u64 + at as u64;
    }
    let at = match case.seed {
        Some(seed) => sweep.seeds.iter().position(|other| *other == seed)?,
        None => 0,
    };
    Some(study.numbers(sweep, point).start + at as u64)
}

impl Moved {
    /// Takes a row of an earlier study; `None` if it lacks an index of the study.
    fn take(&mut self, study: &Study, earlier: &Study, kept: &Kept, row: &Row) -> Option<Row> {
        let case = earlier.case(row.case)?;
        let number = number_in(study, &case)?;
        let digest = earlier.record(&case, row).pop()?;
        let own = earlier.observed.iter().zip(&row.observed);
        let own = own.map(|(index, value)| (index.name.to_owned(), *value));
        let mut indices = kept.indices(row.case, &digest).cloned().unwrap_or_default();
        indices.extend(own);
        let mut observed = Vec::with_capacity(study.observed.len());
        for index in &study.observed {
            match indices.get(index.name) {
                Some(value) => observed.push(*value),
                None => {
                    let lacking = self.lacking.entry(index.name.to_owned()).or_default();
                    lacking.push(number);
                    return None;
                }
            }
        }
        self.cases.insert((row.case, digest), number);
        self.indices.insert(number, indices);
        Some(Row {
            case: number,
            ending: row.ending.clone(),
            observed,
        })
    }
}
