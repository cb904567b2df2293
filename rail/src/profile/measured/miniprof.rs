//! Files of the profile gauge MiniProf (Greenwood Engineering): `.whl` and `.ban`.
//!
//! A file has a header of `Key=Value` lines or, in old files, free text after `MINIPROF`; an empty line; and rows in
//! mm. `ColumnDef` names the columns (default `X,Y`). `XYPoints` is the number of rows.
//!
//! Sources:
//! - CONTACT user guide (Vollebregt, Vtech CMCC), "Inputs regarding wheel and rail profiles": rails have the track
//!   centre at positive `X` and the foot at negative `Y`.
//! - The wheels and rails of CONTACT's test bench, measured with several gauges: wheels have `X` from the back of
//!   the flange to the field side on either side of the vehicle, and `Y` down from the tread at the taper line. Rails
//!   with `Y` down have the track centre at negative `X`, which is the same curve rotated by 180 degrees.
//! - GENSYS, Users Manual for KPF_CONV_MINIPROF2KPF_WHEEL: the running circle is 70 mm from the back of the flange,
//!   the data start after the empty line, and `#` starts a comment.
//!
//! The manufacturer's own description was not available, so the gauge side of a rail is based on these two programs.

use super::mirror::{Mirror, OrientedRows};
use super::orientation::head_up;
use super::row::{Row, cells, number, numbered};
use super::{MIN_POINTS, ProfileError};
use crate::profile::{Body, s1002};

/// Reads the points of `text`, in the axes of a profile.
pub(super) fn read(
    text: &str,
    body: Body,
    mirror: Option<Mirror>,
) -> Result<OrientedRows, ProfileError> {
    let header = Header::read(text)?;
    let mut rows = header.rows(text)?;
    mirror.unwrap_or_default().apply(&mut rows);
    let mut turned = false;
    match body {
        Body::Wheel => shift_wheel(&mut rows, header.taper_line_mm),
        Body::Rail => {
            turned = rows.len() >= MIN_POINTS && !head_up(&rows);
            if turned {
                Mirror::Yz.apply(&mut rows);
            }
        }
    }
    Ok(OrientedRows { rows, turned })
}

/// True if `text` begins with the header of a MiniProf file.
pub(super) fn has_header(text: &str) -> bool {
    const KEYS: [&str; 4] = ["ColumnDef", "XYPoints", "MPTypeNo", "ProgramName"];
    let header = || text.lines().take_while(|line| !line.trim().is_empty());
    let mut keys = header().filter_map(|line| line.trim_matches('"').split_once('='));
    header().take(3).any(is_title) || keys.any(|(key, _)| KEYS.contains(&key.trim()))
}

/// True if `line` is the title of an old file or of a file with several parts.
fn is_title(line: &str) -> bool {
    let line = line.trim_start_matches('#');
    line.starts_with("[FileInfo]") || (line.starts_with("MINI") && line.contains("PROF"))
}

/// Content of the header, and its last line.
struct Header {
    last_line: u64,
    /// Names of the columns, in order.
    columns: Vec<String>,
    points: Option<usize>,
    taper_line_mm: f64,
}

impl Header {
    fn read(text: &str) -> Result<Self, ProfileError> {
        let mut header = Self {
            last_line: 0,
            columns: vec!["X".into(), "Y".into()],
            points: None,
            taper_line_mm: s1002::FLANGE_BACK_TO_DATUM_M * 1e3,
        };
        let is_old = text.lines().take(3).any(is_title);
        for (line, content) in numbered(text) {
            let content = content.trim();
            // Without a header, the data begin with a number.
            let first = cells(content).first().map_or("", |cell| *cell);
            if content.is_empty() || (!is_old && first.parse::<f64>().is_ok()) {
                break;
            }
            header.last_line = line;
            if content.starts_with("[FileInfo]") {
                return Err(ProfileError::Line {
                    line,
                    text: content.to_owned(),
                    allowed: "one profile per file: export the parts one by one as .whl or .ban",
                });
            }
            if is_old || content.starts_with('#') {
                continue;
            }
            let Some((key, value)) = content.trim_matches('"').split_once('=') else {
                return Err(ProfileError::Line {
                    line,
                    text: content.to_owned(),
                    allowed: "Key=Value, up to an empty line",
                });
            };
            header.set(line, key.trim(), value.trim().trim_matches('"').trim())?;
        }
        Ok(header)
    }

    fn set(&mut self, line: u64, key: &str, value: &str) -> Result<(), ProfileError> {
        let wrong = |key, allowed| ProfileError::Key {
            line,
            key,
            text: value.to_owned(),
            allowed,
        };
        match key {
            "ColumnDef" => {
                self.columns = cells(value).into_iter().map(str::to_owned).collect();
                let named = |name: &str| self.columns.iter().any(|column| column == name);
                if !(named("X") && named("Y")) {
                    return Err(wrong(
                        "ColumnDef",
                        "column names that include X and Y, such as X,Y,A,C",
                    ));
                }
            }
            "XYPoints" if !value.is_empty() => {
                let points = value.parse();
                self.points = Some(points.map_err(|_| wrong("XYPoints", "the number of rows"))?);
            }
            "WheelDiameterTaperline" if !value.is_empty() => {
                self.taper_line_mm = value
                    .parse()
                    .ok()
                    .filter(|distance| (40.0..=100.0).contains(distance))
                    .ok_or_else(|| wrong("WheelDiameterTaperline", "40 to 100 mm"))?;
            }
            _ => {}
        }
        Ok(())
    }

    fn rows(&self, text: &str) -> Result<Vec<Row>, ProfileError> {
        let index = |name: &str| self.columns.iter().position(|column| column == name);
        let (x, y) = (index("X").unwrap_or(0), index("Y").unwrap_or(1));
        let mut rows = Vec::new();
        for (line, content) in numbered(text).filter(|(line, _)| *line > self.last_line) {
            let cells = cells(content);
            if cells.is_empty() || content.trim_start().starts_with('#') {
                continue;
            }
            if cells.len() < self.columns.len() {
                return Err(ProfileError::Columns {
                    line,
                    found: cells.len(),
                    allowed: format!("{} ({})", self.columns.len(), self.columns.join(", ")),
                });
            }
            rows.push(Row {
                line,
                y_mm: number(line, "X", cells[x])?,
                z_mm: number(line, "Y", cells[y])?,
            });
        }
        match self.points {
            Some(points) if rows.len() < points => Err(ProfileError::CutShort {
                missing: format!("{} points, but XYPoints states {points}", rows.len()),
            }),
            _ => Ok(rows),
        }
    }
}

/// Moves the origin of `rows` from the back of the flange to the taper line, where the wheel's radius is measured; the
/// depth there becomes zero.
fn shift_wheel(rows: &mut [Row], taper_line_mm: f64) {
    let tread_mm = rows
        .windows(2)
        .map(|pair| (pair[0], pair[1]))
        .find(|(p, q)| (p.y_mm <= taper_line_mm) != (q.y_mm <= taper_line_mm))
        .map_or(0.0, |(p, q)| {
            p.z_mm + (q.z_mm - p.z_mm) * (taper_line_mm - p.y_mm) / (q.y_mm - p.y_mm)
        });
    for row in rows {
        row.y_mm -= taper_line_mm;
        row.z_mm -= tread_mm;
    }
}
