//! Profile files of SIMPACK: `.prw` and `.prr`.
//!
//! A file has the sections `header` and `spline`, each from `.begin` to `.end`. Within `spline`, the section `point`
//! has rows of `y`, `z` and an optional weight. `!` or `%` starts a comment.
//!
//! The processing steps are applied in the order in which SIMPACK numbers them in its files: minimum distance, shift,
//! rotation, bounds, mirrors, and finally units (`units.len.f` is the number of file units per metre). The order of the
//! points does not matter here, so `inversion` is ignored. Weights and `approx.smooth` are not used; the options set
//! the smoothing. Points outside the bounds are removed. Bounds are used only if the lower one is below the upper one.
//!
//! Sources: the comments that SIMPACK writes into its files, as in `MBench_S1002_v3.prw` of the Manchester contact
//! benchmark; CONTACT user guide (Vollebregt, Vtech CMCC) and its `read_simpack.m`. After these steps `y` points to the
//! field side and `z` down. CONTACT sets `z` to the bound instead of removing the point, which creates a shelf that
//! does not exist.

use super::ProfileError;
use super::mirror::{Mirror, OrientedRows};
use super::row::{Row, cells, number, numbered};
use crate::profile::Body;

/// Reads the points of `text`, in the axes of a profile.
pub(super) fn read(
    text: &str,
    body: Body,
    mirror: Option<Mirror>,
) -> Result<OrientedRows, ProfileError> {
    let mut rows = Vec::new();
    let mut steps = Steps::default();
    let mut sections: Vec<&str> = Vec::new();
    let mut complete = false;
    for (line, content) in numbered(text) {
        let content = without_comment(content);
        let misplaced = |allowed| ProfileError::Line {
            line,
            text: content.to_owned(),
            allowed,
        };
        if content.is_empty() {
            continue;
        }
        if let Some(section) = content.strip_suffix(".begin") {
            if section == "point" && complete {
                return Err(misplaced("only one section `point`"));
            }
            sections.push(section);
        } else if let Some(section) = content.strip_suffix(".end") {
            if sections.pop() != Some(section) {
                return Err(misplaced("the end of the current section"));
            }
            complete |= section == "point";
        } else if let Some((key, value)) = content.split_once('=') {
            match sections.last() {
                Some(&"header") => check_type(line, key.trim(), value.trim(), body)?,
                Some(&"spline") => steps.set(line, key.trim(), value.trim())?,
                _ => {}
            }
        } else if sections.last() == Some(&"point") {
            rows.push(row(line, content)?);
        } else {
            return Err(misplaced("section.begin, section.end or key = value"));
        }
    }
    if !complete {
        let missing =
            "no complete section `point`, which needs rows y z between point.begin and point.end";
        return Err(ProfileError::CutShort {
            missing: missing.to_owned(),
        });
    }
    let mut rows = steps.apply(rows);
    mirror.unwrap_or_default().apply(&mut rows);
    Ok(OrientedRows {
        rows,
        turned: false,
    })
}

/// Removes the comment from `line`; comment characters within apostrophes are text.
fn without_comment(line: &str) -> &str {
    let mut quoted = false;
    let end = line.find(|c| {
        quoted ^= c == '\'';
        !quoted && (c == '!' || c == '%')
    });
    line[..end.unwrap_or(line.len())].trim()
}

fn row(line: u64, content: &str) -> Result<Row, ProfileError> {
    let cells = cells(content);
    if !(2..=3).contains(&cells.len()) {
        return Err(ProfileError::Columns {
            line,
            found: cells.len(),
            allowed: "2 or 3 (y, z, weight)".to_owned(),
        });
    }
    Ok(Row {
        line,
        y_mm: number(line, "y", cells[0])?,
        z_mm: number(line, "z", cells[1])?,
    })
}

fn check_type(line: u64, key: &str, value: &str, body: Body) -> Result<(), ProfileError> {
    let (expected, allowed) = match body {
        Body::Wheel => ("1", "1, a wheel"),
        Body::Rail => ("0", "0, a rail"),
    };
    if key != "type" || value == expected {
        return Ok(());
    }
    Err(ProfileError::Key {
        line,
        key: "type",
        text: value.to_owned(),
        allowed,
    })
}

/// Processing steps that a file defines for its points, in its own units.
struct Steps {
    min_distance: f64,
    shift: [f64; 2],
    rotation: f64,
    bounds_y: [f64; 2],
    bounds_z: [f64; 2],
    mirror_y: bool,
    mirror_z: bool,
    units_per_m: f64,
    units_per_rad: f64,
}

impl Default for Steps {
    fn default() -> Self {
        Self {
            min_distance: 0.0,
            shift: [0.0; 2],
            rotation: 0.0,
            bounds_y: [0.0; 2],
            bounds_z: [0.0; 2],
            mirror_y: false,
            mirror_z: false,
            units_per_m: 1.0,
            units_per_rad: 1.0,
        }
    }
}

impl Steps {
    fn set(&mut self, line: u64, key: &str, value: &str) -> Result<(), ProfileError> {
        let wrong = |key, allowed| ProfileError::Key {
            line,
            key,
            text: value.to_owned(),
            allowed,
        };
        let real = |key| {
            let value = value.parse::<f64>().ok().filter(|value| value.is_finite());
            value.ok_or_else(|| wrong(key, "a number"))
        };
        let unit = |key| {
            let factor = real(key)?;
            let allowed = (1e-3..=1e6).contains(&factor);
            allowed
                .then_some(factor)
                .ok_or_else(|| wrong(key, "1e-3 to 1e6"))
        };
        let switch = |key| match value {
            "0" => Ok(false),
            "1" => Ok(true),
            _ => Err(wrong(key, "0 or 1")),
        };
        match key {
            "point.dist.min" => self.min_distance = real("point.dist.min")?,
            "shift.y" => self.shift[0] = real("shift.y")?,
            "shift.z" => self.shift[1] = real("shift.z")?,
            "rotate" => self.rotation = real("rotate")?,
            "bound.y.min" => self.bounds_y[0] = real("bound.y.min")?,
            "bound.y.max" => self.bounds_y[1] = real("bound.y.max")?,
            "bound.z.min" => self.bounds_z[0] = real("bound.z.min")?,
            "bound.z.max" => self.bounds_z[1] = real("bound.z.max")?,
            "mirror.y" => self.mirror_y = switch("mirror.y")?,
            "mirror.z" => self.mirror_z = switch("mirror.z")?,
            "units.len.f" => self.units_per_m = unit("units.len.f")?,
            "units.ang.f" => self.units_per_rad = unit("units.ang.f")?,
            _ => {}
        }
        Ok(())
    }

    /// Applies all steps; the result is in mm.
    fn apply(&self, mut rows: Vec<Row>) -> Vec<Row> {
        let distance = |p: &Row, q: &Row| libm::hypot(q.y_mm - p.y_mm, q.z_mm - p.z_mm);
        rows.dedup_by(|row, before| distance(before, row) < self.min_distance);
        let (sin, cos) = libm::sincos(self.rotation / self.units_per_rad);
        for row in &mut rows {
            let [y, z] = [row.y_mm + self.shift[0], row.z_mm + self.shift[1]];
            (row.y_mm, row.z_mm) = (y * cos - z * sin, y * sin + z * cos);
        }
        let within =
            |[low, high]: [f64; 2], value: f64| low >= high || (low..=high).contains(&value);
        rows.retain(|row| within(self.bounds_y, row.y_mm) && within(self.bounds_z, row.z_mm));
        let sign = |mirrored| if mirrored { -1.0 } else { 1.0 };
        let mm = 1e3 / self.units_per_m;
        for row in &mut rows {
            row.y_mm *= sign(self.mirror_y) * mm;
            row.z_mm *= sign(self.mirror_z) * mm;
        }
        rows
    }
}
