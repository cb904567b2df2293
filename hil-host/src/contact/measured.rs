//! A profile from a file: two columns in mm, read into m and checked.

use std::path::Path;

use super::profile::{Body, Profile};
use crate::failure::{Failure, Outcome};
use crate::input;

/// Fewest points of a usable profile: one each 2 mm over a rail head.
pub const FEWEST: usize = 30;
/// Widest distance of neighbours, mm; a rail corner of R 13 would lose 0.24 mm over 5 mm.
pub const WIDEST_GAP_MM: f64 = 5.0;
/// Wavelength halved by the smoothing when none is asked for, m: readings rounded to 0.01 mm each
/// 0.5 mm then give places within 0.005 mm and curvatures within 2 per m RMS.
pub const DEFAULT_SMOOTHING: f64 = 0.004;

/// Reads the profile of `body` at `path`: lateral place and depth in mm, field side and down positive
/// (columns `y_mm`, `z_mm`), separated by comma, semicolon or space; `#` starts a comment; one heading line is allowed.
///
/// `smoothing` as in [`Profile::through`]. A wheel's origin is its tread datum, a rail's the top of its head.
///
/// # Errors
/// The file cannot be read; a cell is not a finite number; fewer than [`FEWEST`] points; the curve
/// folds back; neighbours further apart than [`WIDEST_GAP_MM`]; the wrong side is up.
pub fn read(path: &Path, body: Body, smoothing: f64) -> Outcome<Profile> {
    let text = input::read_text(path)?;
    let path = &*input::name(path);
    let name = path
        .file_stem()
        .map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    let places = check(path, body, parse(path, &text)?)?;
    let places: Vec<[f64; 2]> = places.iter().map(|[y, z]| [y * 1e-3, z * 1e-3]).collect();
    let profile = Profile::through(name, &places, smoothing);
    let steepest = profile.points.iter().find(|point| point.angle.cos() <= 0.0);
    match steepest {
        Some(point) => Err(Failure::in_file(
            path,
            format!(
                "folded back near y_mm {:.2} once smoothed: use a shorter smoothing length",
                point.y * 1e3
            ),
        )),
        None => Ok(profile),
    }
}

/// One row of the file with the line it stands on.
type Row = (u64, [f64; 2]);

fn parse(path: &Path, text: &str) -> Outcome<Vec<Row>> {
    const NAMES: [&str; 2] = ["y_mm", "z_mm"];
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
            return Err(Failure::in_file(
                path,
                format!(
                    "line {number}: {} columns, allowed: 2 (y_mm, z_mm)",
                    cells.len()
                ),
            ));
        }
        let mut row = [0.0; 2];
        for k in 0..2 {
            row[k] = match cells[k].parse::<f64>() {
                Ok(value) if value.is_finite() && value.abs() <= 1000.0 => value,
                _ => {
                    return Err(Failure::in_cell(
                        path,
                        number,
                        NAMES[k],
                        format!("{:?} is not a number from -1000 to 1000", cells[k]),
                    ));
                }
            };
        }
        rows.push((number, row));
    }
    Ok(rows)
}

fn check(path: &Path, body: Body, mut rows: Vec<Row>) -> Outcome<Vec<[f64; 2]>> {
    if rows.len() < FEWEST {
        return Err(Failure::in_file(
            path,
            format!("too few points: {}, allowed: {FEWEST} or more", rows.len()),
        ));
    }
    if rows[0].1[0] > rows[rows.len() - 1].1[0] {
        rows.reverse();
    }
    for pair in rows.windows(2) {
        let ((_, [y0, z0]), (line, [y, z])) = (pair[0], pair[1]);
        if y <= y0 {
            return Err(Failure::in_cell(
                path,
                line,
                "y_mm",
                format!("folded back: {y} follows {y0}, allowed: one direction throughout"),
            ));
        }
        let gap = (y - y0).hypot(z - z0);
        if gap > WIDEST_GAP_MM {
            return Err(Failure::in_cell(
                path,
                line,
                "y_mm",
                format!("gap: {gap:.2} mm to its neighbour, allowed: {WIDEST_GAP_MM} mm"),
            ));
        }
    }
    let places: Vec<[f64; 2]> = rows.iter().map(|row| row.1).collect();
    match upright(body, &places) {
        Ok(()) => Ok(places),
        Err(message) => Err(Failure::in_file(path, message)),
    }
}

/// Whether the flange points down on the negative side, or the head is up.
fn upright(body: Body, places: &[[f64; 2]]) -> Result<(), String> {
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
                return Err(format!(
                    "no flange: the profile is {:.1} mm deep, allowed: 15 mm or more",
                    height.abs()
                ));
            }
            if height < 0.0 {
                return Err("wrong side up: the flange must point to positive z_mm (down)".into());
            }
            if 2.0 * flange[0] > places[0][0] + places[places.len() - 1][0] {
                return Err(
                    "wrong side: the flange must lie at negative y_mm (towards the track centre)"
                        .into(),
                );
            }
        }
        Body::Rail => {
            let highest = depths[0];
            let ends = [places[0][1], places[places.len() - 1][1]];
            if ends.iter().any(|end| end - highest < 0.5) {
                return Err(
                    "wrong side up: the head must be the least z_mm (up), both sides 0.5 mm deeper or more"
                        .into(),
                );
            }
        }
    }
    Ok(())
}
