//! A measured profile: a text of two columns in mm, checked and smoothed.

mod check;
mod error;

pub use error::ProfileError;

use super::{Body, Profile};

/// Smallest number of points of a usable profile: one each 2 mm over a rail head.
pub const MIN_POINTS: usize = 30;
/// Greatest distance of neighbouring points, mm; over 5 mm a rail corner of R 13 would lose 0.24 mm.
pub const MAX_GAP_MM: f64 = 5.0;
/// Default wavelength whose amplitude the smoothing halves, m: readings rounded to 0.01 mm each
/// 0.5 mm then give positions within 0.005 mm and curvatures within 2 per m RMS.
pub const DEFAULT_SMOOTHING_M: f64 = 0.004;

/// Names of the two columns.
const COLUMNS: [&str; 2] = ["y_mm", "z_mm"];

/// Reads the profile of `body` from `text`.
///
/// The columns `y_mm` and `z_mm` are the lateral position and the depth in mm, positive to the field side and
/// down, separated by comma, semicolon or space. `#` starts a comment; one heading line is allowed.
/// A wheel's origin is its tread datum, a rail's the top of its head. `smoothing_m` is that of [`Profile::through`].
///
/// # Errors
/// A cell that is not a number from -1000 to 1000, fewer than [`MIN_POINTS`] points, a curve that folds back,
/// neighbours further apart than [`MAX_GAP_MM`], a profile upside down or mirrored, a negative smoothing length.
///
/// ```
/// use dashpot_rail::profile::{Body, measured};
/// let mut text = String::from("y_mm,z_mm\n");
/// for y_mm in -36..=36 {
///     let depth_mm = f64::from(y_mm).powi(4) * 2e-5;
///     text += &format!("{y_mm},{depth_mm:.2}\n");
/// }
/// let rail = measured::parse("worn", &text, Body::Rail, measured::DEFAULT_SMOOTHING_M)?;
/// assert!((rail.at(0.020).z_m - 3.2e-3).abs() < 2e-5);
///
/// let error = measured::parse("bad", "0,0\n1,x\n", Body::Rail, 0.0).unwrap_err();
/// assert_eq!(error.cell(), Some((2, "z_mm")));
/// # Ok::<(), measured::ProfileError>(())
/// ```
pub fn parse(
    name: impl Into<String>,
    text: &str,
    body: Body,
    smoothing_m: f64,
) -> Result<Profile, ProfileError> {
    let points_mm = check::checked(body, rows(text)?)?;
    let points_m: Vec<[f64; 2]> = points_mm
        .iter()
        .map(|[y, z]| [y * 1e-3, z * 1e-3])
        .collect();
    Ok(Profile::through(name, &points_m, smoothing_m)?)
}

/// Line number and coordinates in mm of one row.
type Row = (u64, [f64; 2]);

fn rows(text: &str) -> Result<Vec<Row>, ProfileError> {
    let mut rows: Vec<Row> = Vec::new();
    let mut heading_allowed = true;
    for (number, line) in (1..).zip(text.lines()) {
        let content = line.split('#').next().unwrap_or("").trim();
        if content.is_empty() {
            continue;
        }
        let cells: Vec<&str> = content
            .split(|c: char| c == ',' || c == ';' || c.is_whitespace())
            .filter(|cell| !cell.is_empty())
            .collect();
        if std::mem::take(&mut heading_allowed) && cells.iter().all(|c| c.parse::<f64>().is_err()) {
            continue;
        }
        if cells.len() != 2 {
            return Err(ProfileError::Columns {
                line: number,
                found: cells.len(),
            });
        }
        let mut row = [0.0; 2];
        for k in 0..2 {
            row[k] = match cells[k].parse::<f64>() {
                Ok(value) if value.is_finite() && value.abs() <= 1000.0 => value,
                _ => {
                    return Err(ProfileError::Number {
                        line: number,
                        column: COLUMNS[k],
                        text: cells[k].to_owned(),
                    });
                }
            };
        }
        rows.push((number, row));
    }
    Ok(rows)
}
