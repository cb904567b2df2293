//! The file `rows.study` beside `rows.csv`: the outline of the study and all indices of each case. Indices that the
//! study does not observe are in no row, but may be observed later.
//!
//! A line that cannot be used is left out: what it says can be computed again.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::outline::Outline;
use crate::sweep::digest::digest_of_cells;
use crate::sweep::observed::IndexValues;
use dashpot_files::FileError;
use dashpot_files::output::{cannot_write, write_bytes};

/// First line. A change of the format changes its number.
const FORMAT: &str = "# dashpot study 1";

/// Contents of the file, and the file to which lines are added.
#[derive(Debug, Default)]
pub struct Kept {
    path: PathBuf,
    /// `None` before the first line of this run.
    file: Option<File>,
    outlines: Vec<Outline>,
    /// By case number and digest of the row.
    indices: BTreeMap<(u64, String), IndexValues>,
}

/// Path of the outline and the indices that belong to the rows at `rows`.
///
/// ```
/// use dashpot_study::sweep::extension::path_of;
/// let path = path_of("results/rows-3-of-8.csv".as_ref());
/// assert_eq!(path.as_path(), std::path::Path::new("results/rows-3-of-8.study"));
/// ```
pub fn path_of(rows: &Path) -> PathBuf {
    rows.with_extension("study")
}

impl Kept {
    /// Reads the file beside the rows at `rows`. A missing file, or one of another format, is like an empty one.
    pub fn read(rows: &Path) -> Self {
        let path = path_of(rows);
        let bytes = fs::read(&path).unwrap_or_default();
        let mut kept = Self {
            path,
            ..Self::default()
        };
        if !bytes.starts_with(FORMAT.as_bytes()) {
            return kept;
        }
        let mut reader = csv::ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .comment(Some(b'#'))
            .from_reader(bytes.as_slice());
        for record in reader.records().map_while(Result::ok) {
            kept.take(&record.iter().collect::<Vec<_>>());
        }
        kept
    }

    /// Takes the cells of a line.
    fn take(&mut self, cells: &[&str]) {
        let Some((digest, rest)) = cells.split_last() else {
            return;
        };
        if digest_of_cells(rest.iter().copied()) != **digest {
            return;
        }
        match rest {
            ["study", outline] => self.outlines.extend(serde_json::from_str(outline).ok()),
            ["case", case, row_digest, indices] => {
                if let (Ok(case), Some(indices)) = (case.parse(), parse_indices(indices)) {
                    self.indices
                        .insert((case, (*row_digest).to_owned()), indices);
                }
            }
            _ => {}
        }
    }

    /// Outline of the study with this digest.
    pub fn outline(&self, digest: &str) -> Option<&Outline> {
        self.outlines
            .iter()
            .find(|outline| outline.digest == digest)
    }

    /// Indices of the case whose row has this digest.
    pub fn indices(&self, case: u64, row_digest: &str) -> Option<&IndexValues> {
        self.indices.get(&(case, row_digest.to_owned()))
    }

    /// Adds an outline to the file, which is written again without lines that cannot be used.
    ///
    /// # Errors
    /// Returns an error if the file cannot be written.
    pub fn add_outline(&mut self, outline: Outline) -> Result<(), FileError> {
        if self.outline(&outline.digest).is_none() {
            self.outlines.push(outline);
        }
        self.file = None;
        self.write()
    }

    /// Adds the indices of a case.
    ///
    /// # Errors
    /// Returns an error if the file cannot be written.
    pub fn add(
        &mut self,
        case: u64,
        row_digest: &str,
        indices: IndexValues,
    ) -> Result<(), FileError> {
        let failed = |error: io::Error| cannot_write(&self.path, error);
        let text = line(&case_cells(case, row_digest, &indices)).map_err(failed)?;
        let file = match &mut self.file {
            Some(file) => file,
            slot => {
                let file = File::options().append(true).open(&self.path);
                slot.insert(file.map_err(failed)?)
            }
        };
        file.write_all(&text).map_err(failed)?;
        self.indices.insert((case, row_digest.to_owned()), indices);
        Ok(())
    }

    /// Removes the indices of these cases, which must be in ascending order.
    ///
    /// # Errors
    /// Returns an error if the file cannot be written.
    pub fn remove(&mut self, cases: &[u64]) -> Result<(), FileError> {
        let is_kept = |case: &u64| cases.binary_search(case).is_err();
        self.indices.retain(|(case, _), _| is_kept(case));
        self.file = None;
        self.write()
    }

    /// Writes the file with the outline and these cases only, in the order of the cases.
    ///
    /// # Errors
    /// Returns an error if the file cannot be written.
    pub fn finish(
        mut self,
        outline: Outline,
        cases: impl Iterator<Item = (u64, String, IndexValues)>,
    ) -> Result<(), FileError> {
        self.file = None;
        self.outlines = vec![outline];
        let cases = cases.map(|(case, digest, indices)| ((case, digest), indices));
        self.indices = cases.collect();
        self.write()
    }

    fn write(&self) -> Result<(), FileError> {
        let failed = |error: io::Error| cannot_write(&self.path, error);
        let mut text = format!("{FORMAT}\n").into_bytes();
        for outline in &self.outlines {
            let outline = serde_json::to_string(outline).map_err(io::Error::other);
            let cells = vec!["study".to_owned(), outline.map_err(failed)?];
            text.extend(line(&cells).map_err(failed)?);
        }
        for ((case, digest), indices) in &self.indices {
            text.extend(line(&case_cells(*case, digest, indices)).map_err(failed)?);
        }
        write_bytes(&self.path, &text)
    }
}

fn case_cells(case: u64, row_digest: &str, indices: &IndexValues) -> Vec<String> {
    let indices = indices.iter().map(|(name, value)| match value {
        Some(value) => format!("{name}={value:?}"),
        None => format!("{name}="),
    });
    let indices = indices.collect::<Vec<_>>().join(" ");
    vec![
        "case".into(),
        case.to_string(),
        row_digest.to_owned(),
        indices,
    ]
}

/// Returns `None` if the text is damaged.
fn parse_indices(text: &str) -> Option<IndexValues> {
    let values = text.split_ascii_whitespace().map(|index| {
        let (name, value) = index.split_once('=')?;
        let value = match value {
            "" => None,
            number => Some(number.parse::<f64>().ok()?),
        };
        Some((name.to_owned(), value))
    });
    values.collect()
}

/// Formats a line, which ends in the digest of its cells.
fn line(cells: &[String]) -> io::Result<Vec<u8>> {
    let digest = digest_of_cells(cells.iter().map(String::as_str));
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(cells.iter().chain([&digest]))?;
    writer.into_inner().map_err(|error| error.into_error())
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::{IndexValues, Kept, path_of};
    use crate::sweep::extension::Outline;

    fn outline(digest: &str) -> Outline {
        Outline {
            digest: digest.into(),
            observed: vec!["a, \"b\"".into()],
            sweeps: Vec::new(),
        }
    }

    #[test]
    fn lines_are_read_again_but_for_altered_and_incomplete_ones() {
        let folder = tempfile::tempdir().unwrap();
        let rows = folder.path().join("rows.csv");
        let values = IndexValues::from([("x".into(), Some(0.1 + 0.2)), ("y".into(), None)]);
        let mut kept = Kept::read(&rows);
        kept.add_outline(outline("first")).unwrap();
        for case in 0..3 {
            kept.add(case, "digest", values.clone()).unwrap();
        }
        let text = fs::read_to_string(path_of(&rows)).unwrap();
        let damaged = text.replacen("case,1,", "case,7,", 1);
        fs::write(path_of(&rows), &damaged[..damaged.len() - 4]).unwrap();
        let mut kept = Kept::read(&rows);
        assert_eq!(kept.outline("first"), Some(&outline("first")));
        assert_eq!(kept.indices(0, "digest"), Some(&values));
        for (case, digest) in [(1, "digest"), (7, "digest"), (2, "digest"), (0, "other")] {
            assert_eq!(kept.indices(case, digest), None, "{case} {digest}");
        }
        kept.add_outline(outline("second")).unwrap();
        kept.add(4, "digest", values.clone()).unwrap();
        let kept = Kept::read(&rows);
        assert!(kept.outline("first").is_some() && kept.outline("second").is_some());
        assert!(kept.indices(0, "digest").is_some() && kept.indices(4, "digest").is_some());
    }
}
