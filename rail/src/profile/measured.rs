//! A measured profile: two columns in mm as text, read into m and checked.

use super::{Body, Profile};

/// Fewest points of a usable profile: one each 2 mm over a rail head.
pub const FEWEST: usize = 30;
/// Widest distance of neighbours, mm; a rail corner of R 13 would lose 0.24 mm over 5 mm.
pub const WIDEST_GAP_MM: f64 = 5.0;
/// Wavelength halved by the smoothing when none is asked for, m: readings rounded to 0.01 mm each
/// 0.5 mm then give places within 0.005 mm and curvatures within 2 per m RMS.
pub const DEFAULT_SMOOTHING: f64 = 0.004;

/// Why a text is no profile.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ProfileError {
    /// A row has not two columns.
    #[error("line {line}: {found} columns, allowed: 2 (y_mm, z_mm)")]
    Columns {
        /// Line of the text, from 1.
        line: u64,
        /// Columns there.
        found: usize,
    },
    /// A cell is no number of a profile.
    #[error("{text:?} is not a number from -1000 to 1000")]
    Number {
        /// Line of the text, from 1.
        line: u64,
        /// Name of the column.
        column: &'static str,
        /// The cell.
        text: String,
    },
    /// Fewer than [`FEWEST`] points.
    #[error("too few points: {found}, allowed: {FEWEST} or more")]
    TooFewPoints {
        /// Points there.
        found: usize,
    },
    /// The curve turns back.
    #[error("folded back: {y_mm} follows {before_mm}, allowed: one direction throughout")]
    FoldedBack {
        /// Line of the text, from 1.
        line: u64,
        /// Lateral place there, mm.
        y_mm: f64,
        /// Lateral place before it, mm.
        before_mm: f64,
    },
    /// Neighbours further apart than [`WIDEST_GAP_MM`].
    #[error("gap: {gap_mm:.2} mm to its neighbour, allowed: {WIDEST_GAP_MM} mm")]
    Gap {
        /// Line of the text, from 1.
        line: u64,
        /// Distance to the point before, mm.
        gap_mm: f64,
    },
    /// A wheel without a flange.
    #[error("no flange: the profile is {depth_mm:.1} mm deep, allowed: 15 mm or more")]
    NoFlange {
        /// Depth of the profile, mm.
        depth_mm: f64,
    },
    /// A wheel whose flange points up.
    #[error("wrong side up: the flange must point to positive z_mm (down)")]
    FlangeUp,
    /// A wheel whose flange lies at the field side.
    #[error("wrong side: the flange must lie at negative y_mm (towards the track centre)")]
    FlangeOutside,
    /// A rail whose head is not up.
    #[error(
        "wrong side up: the head must be the least z_mm (up), both sides 0.5 mm deeper or more"
    )]
    HeadDown,
    /// The smoothed curve turns back.
    #[error("folded back near y_mm {y_mm:.2} once smoothed: use a shorter smoothing length")]
    FoldedBySmoothing {
        /// Lateral place of the fold, mm.
        y_mm: f64,
    },
}

impl ProfileError {
    /// The line, from 1, and the column that the error is of, where it is of one cell.
    pub fn cell(&self) -> Option<(u64, &'static str)> {
        match *self {
            Self::Number { line, column, .. } => Some((line, column)),
            Self::FoldedBack { line, .. } | Self::Gap { line, .. } => Some((line, NAMES[0])),
            _ => None,
        }
    }
}

const NAMES: [&str; 2] = ["y_mm", "z_mm"];

/// The profile of `body` in `text`: lateral place and depth in mm, field side and down positive
/// (columns `y_mm`, `z_mm`), separated by comma, semicolon or space; `#` starts a comment; one heading line is allowed.
///
/// `smoothing` as in [`Profile::through`]. A wheel's origin is its tread datum, a rail's the top of its head.
///
/// # Errors
/// A cell is not a finite number; fewer than [`FEWEST`] points; the curve folds back; neighbours further
/// apart than [`WIDEST_GAP_MM`]; the wrong side is up.
pub fn parse(
    name: impl Into<String>,
    text: &str,
    body: Body,
    smoothing: f64,
) -> Result<Profile, ProfileError> {
    let places = check(body, rows(text)?)?;
    let places: Vec<[f64; 2]> = places.iter().map(|[y, z]| [y * 1e-3, z * 1e-3]).collect();
    let profile = Profile::through(name, &places, smoothing);
    let steepest = profile.points.iter().find(|point| point.angle.cos() <= 0.0);
    match steepest {
        Some(point) => Err(ProfileError::FoldedBySmoothing {
            y_mm: point.y * 1e3,
        }),
        None => Ok(profile),
    }
}

/// One row of the text with the line it stands on.
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
                        column: NAMES[k],
                        text: cells[k].to_owned(),
                    });
                }
            };
        }
        rows.push((number, row));
    }
    Ok(rows)
}

fn check(body: Body, mut rows: Vec<Row>) -> Result<Vec<[f64; 2]>, ProfileError> {
    if rows.len() < FEWEST {
        return Err(ProfileError::TooFewPoints { found: rows.len() });
    }
    if rows[0].1[0] > rows[rows.len() - 1].1[0] {
        rows.reverse();
    }
    for pair in rows.windows(2) {
        let ((_, [y0, z0]), (line, [y, z])) = (pair[0], pair[1]);
        if y <= y0 {
            return Err(ProfileError::FoldedBack {
                line,
                y_mm: y,
                before_mm: y0,
            });
        }
        let gap = (y - y0).hypot(z - z0);
        if gap > WIDEST_GAP_MM {
            return Err(ProfileError::Gap { line, gap_mm: gap });
        }
    }
    let places: Vec<[f64; 2]> = rows.iter().map(|row| row.1).collect();
    check_upright(body, &places)?;
    Ok(places)
}

/// The flange must point down on the negative side, or the head be up.
fn check_upright(body: Body, places: &[[f64; 2]]) -> Result<(), ProfileError> {
    let depth = |place: &[f64; 2]| place[1];
    let mut depths: Vec<f64> = places.iter().map(depth).collect();
    depths.sort_by(f64::total_cmp);
    match body {
        Body::Wheel => {
            // More than half of a wheel's width is tread, so the middle reading lies on it.
            let tread = depths[depths.len() / 2];
            let away = |place: &&[f64; 2]| (place[1] - tread).abs();
            let Some(flange) = places.iter().max_by(|a, b| away(a).total_cmp(&away(b))) else {
                return Ok(());
            };
            let height = flange[1] - tread;
            if height.abs() < 15.0 {
                return Err(ProfileError::NoFlange {
                    depth_mm: height.abs(),
                });
            }
            if height < 0.0 {
                return Err(ProfileError::FlangeUp);
            }
            if 2.0 * flange[0] > places[0][0] + places[places.len() - 1][0] {
                return Err(ProfileError::FlangeOutside);
            }
        }
        Body::Rail => {
            let highest = depths[0];
            let ends = [places[0][1], places[places.len() - 1][1]];
            if ends.iter().any(|end| end - highest < 0.5) {
                return Err(ProfileError::HeadDown);
            }
        }
    }
    Ok(())
}
