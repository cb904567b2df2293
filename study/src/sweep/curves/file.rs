//! Files of curves: text with one curve per line, which names its row by the row's digest and has a digest of its own.
//!
//! The format is documented in docs/studies.md. Reading never fails: curves that cannot be used are reported and left
//! out, because each can be computed again from its case.

use std::collections::BTreeMap;
use std::io::{self, Write};
use std::path::Path;

use dashpot_files::FileError;
use dashpot_files::output::{cannot_write, write_whole};

use super::{Curve, CurveKey, CurveKind, Curves};
use crate::sweep::digest::digest_of_cells;
use crate::sweep::rows::Rows;
use crate::sweep::study::Study;

/// First line. A change of the format changes its number.
const FORMAT: &str = "# dashpot curves 1";

/// Names of the cells of a line.
const COLUMNS: [&str; 7] = [
    "case",
    "row_digest",
    "signal",
    "curve",
    "step_s",
    "values",
    "digest",
];

/// Curves of a file, and what was wrong with the others.
#[derive(Debug, Default)]
pub struct KeptCurves {
    /// Curves that belong to a row.
    pub curves: Curves,
    /// A sentence for each problem: which curves were left out and why.
    pub problems: Vec<String>,
}

/// The first two lines of a file.
pub fn header() -> String {
    format!("{FORMAT}\n{}\n", COLUMNS.join(","))
}

/// Writes one curve as a line; `row_digest` is the digest of its row.
///
/// # Errors
/// The file cannot be written.
pub fn append(
    file: &mut dyn Write,
    row_digest: &str,
    key: &CurveKey,
    curve: &Curve,
) -> io::Result<()> {
    let values: Vec<String> = curve.values.iter().map(|x| format!("{x:?}")).collect();
    let mut cells = vec![
        key.case.to_string(),
        row_digest.to_owned(),
        key.signal.clone(),
        key.kind.name().to_owned(),
        format!("{:?}", curve.step_s),
        values.join(" "),
    ];
    cells.push(digest_of_cells(cells.iter().map(String::as_str)));
    let mut line = cells.join(",");
    line.push('\n');
    file.write_all(line.as_bytes())
}

/// Writes the curves in the order of their cases; curves without a row are left out.
///
/// # Errors
/// The file cannot be written.
pub fn write(study: &Study, rows: &Rows, curves: &Curves, path: &Path) -> Result<(), FileError> {
    write_whole(path, |file| {
        let failed = |error: io::Error| cannot_write(path, error);
        file.write_all(header().as_bytes()).map_err(failed)?;
        for (key, curve) in curves {
            if let Some(digest) = row_digest(study, rows, key.case) {
                append(file, &digest, key, curve).map_err(failed)?;
            }
        }
        Ok(())
    })
}

/// Reads the curves of the file at `path` that belong to `rows`. A missing file has no curves.
pub fn read(study: &Study, rows: &Rows, path: &Path) -> KeptCurves {
    let none = BTreeMap::new();
    KnownRows::new(study, rows, &none).read(path)
}

/// Rows whose curves are read.
#[derive(Clone, Copy)]
pub struct KnownRows<'a> {
    study: &'a Study,
    rows: &'a Rows,
    /// New number of the case of a row of an earlier study, by its number and its digest there.
    moved: &'a BTreeMap<(u64, String), u64>,
}

impl<'a> KnownRows<'a> {
    /// Rows of a study. Some may be `moved` from an earlier study.
    pub fn new(study: &'a Study, rows: &'a Rows, moved: &'a BTreeMap<(u64, String), u64>) -> Self {
        Self { study, rows, moved }
    }

    /// Reads the curves of the file at `path` that belong to these rows. A missing file has no curves.
    pub fn read(&self, path: &Path) -> KeptCurves {
        match std::fs::read(path) {
            Ok(bytes) => self.parse_all(path, &bytes),
            Err(error) if error.kind() == io::ErrorKind::NotFound => KeptCurves::default(),
            Err(error) => KeptCurves {
                curves: Curves::new(),
                problems: vec![FileError::read(path, error).to_string()],
            },
        }
    }

    /// Reads the curves of a file that a study is still adding to; an incomplete last line is being written.
    pub fn read_partial(&self, path: &Path) -> KeptCurves {
        let bytes = std::fs::read(path).unwrap_or_default();
        match bytes.iter().rposition(|byte| *byte == b'\n') {
            Some(end) => self.parse_all(path, &bytes[..=end]),
            None => KeptCurves::default(),
        }
    }

    fn parse_all(&self, path: &Path, bytes: &[u8]) -> KeptCurves {
        let Self { study, rows, .. } = *self;
        let mut kept = KeptCurves::default();
        let mut report = |line: usize, reason: &str| {
            let error = FileError::in_line(path, line as u64, reason);
            kept.problems.push(error.to_string());
        };
        if !bytes.starts_with(header().as_bytes()) {
            report(
                1,
                &format!("not a file of curves of this version, which begins with `{FORMAT}`"),
            );
            return kept;
        }
        for (number, line) in bytes.split(|byte| *byte == b'\n').enumerate().skip(2) {
            if line.is_empty() {
                continue;
            }
            match parse_line(line) {
                None => report(number + 1, "damaged curve"),
                Some(Line { key, digest, curve }) if self.moved_to(&key, digest).is_some() => {
                    if let Some(case) = self.moved_to(&key, digest) {
                        kept.curves.insert(CurveKey { case, ..key }, curve);
                    }
                }
                // The case of a curve without a row runs again, or is another shard's.
                Some(Line { key, .. }) if !rows.contains_key(&key.case) => {}
                Some(Line { key, digest, .. })
                    if row_digest(study, rows, key.case).as_deref() != Some(digest) =>
                {
                    let case = key.case;
                    report(
                        number + 1,
                        &format!("stale curve: it is not of the row of case {case}"),
                    );
                }
                Some(Line { key, curve, .. }) => {
                    kept.curves.insert(key, curve);
                }
            }
        }
        kept
    }

    /// New number of the case of a curve of an earlier study.
    fn moved_to(&self, key: &CurveKey, row_digest: &str) -> Option<u64> {
        let row = (key.case, row_digest.to_owned());
        self.moved.get(&row).copied()
    }
}

/// Digest of the row of a case.
pub fn row_digest(study: &Study, rows: &Rows, case: u64) -> Option<String> {
    study.digest_of(rows.get(&case)?)
}

/// Contents of a line.
struct Line<'a> {
    key: CurveKey,
    digest: &'a str,
    curve: Curve,
}

/// Parses a line; `None` if it is damaged.
fn parse_line(line: &[u8]) -> Option<Line<'_>> {
    let cells: Vec<&str> = std::str::from_utf8(line).ok()?.split(',').collect();
    let [case, digest, signal, kind, step_s, values, own_digest] = cells[..] else {
        return None;
    };
    if digest_of_cells(cells[..6].iter().copied()) != own_digest {
        return None;
    }
    let kind = CurveKind::ALL.into_iter().find(|own| own.name() == kind)?;
    let values: Result<Vec<f64>, _> = values.split_ascii_whitespace().map(str::parse).collect();
    let values = values.ok()?;
    if kind == CurveKind::Spectrum && values.len() % 2 != 0 {
        return None;
    }
    Some(Line {
        key: CurveKey {
            case: case.parse().ok()?,
            signal: signal.to_owned(),
            kind,
        },
        digest,
        curve: Curve {
            step_s: step_s.parse().ok()?,
            values,
        },
    })
}
