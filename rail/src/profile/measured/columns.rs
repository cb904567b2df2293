//! Two columns in mm: lateral position to the field side, depth down.

use super::ProfileError;
use super::mirror::{Mirror, OrientedRows};
use super::row::{Row, cells, number, numbered};

/// Names of the two columns.
const COLUMNS: [&str; 2] = ["y_mm", "z_mm"];

/// Reads the points of `text`, in the axes of a profile, after mirroring.
pub(super) fn read(text: &str, mirror: Option<Mirror>) -> Result<OrientedRows, ProfileError> {
    let mut rows = rows(text)?;
    mirror.unwrap_or_default().apply(&mut rows);
    Ok(OrientedRows {
        rows,
        turned: false,
    })
}

/// Reads two columns; `#` starts a comment, and one heading line is allowed.
pub(super) fn rows(text: &str) -> Result<Vec<Row>, ProfileError> {
    let mut rows = Vec::new();
    let mut heading_allowed = true;
    for (line, content) in numbered(text) {
        let cells = cells(content.split('#').next().unwrap_or(""));
        if cells.is_empty() {
            continue;
        }
        if std::mem::take(&mut heading_allowed) && cells.iter().all(|c| c.parse::<f64>().is_err()) {
            continue;
        }
        let [y, z] = cells[..] else {
            return Err(ProfileError::Columns {
                line,
                found: cells.len(),
                allowed: format!("2 ({})", COLUMNS.join(", ")),
            });
        };
        rows.push(Row {
            line,
            y_mm: number(line, COLUMNS[0], y)?,
            z_mm: number(line, COLUMNS[1], z)?,
        });
    }
    Ok(rows)
}
