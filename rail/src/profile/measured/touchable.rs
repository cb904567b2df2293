//! The part of a measured curve that can be in contact.

use std::iter;

use super::row::Row;
use super::{MAX_FOLD_MM, MAX_GAP_MM, ProfileError, REACH_MM};
use crate::profile::Body;

/// A curve with rising `y`, and the numbers of points removed.
#[derive(Debug, Default)]
pub(super) struct Touchable {
    pub points_mm: Vec<[f64; 2]>,
    /// Number of points removed at the ends.
    pub overhanging: usize,
    /// Number of points removed in between.
    pub folded: usize,
    pub widest_fold_mm: f64,
}

/// Returns the outer envelope of `rows`, which are not empty and begin at the end with negative `y`.
///
/// Seen from the top of a rail or the tip of a flange, a point is kept if it lies further out than all previous points.
/// The other points are hidden: at the end of the curve they overhang, in between they form a fold.
pub(super) fn touchable(body: Body, rows: &[Row]) -> Result<Touchable, ProfileError> {
    let sign = match body {
        Body::Wheel => -1.0,
        Body::Rail => 1.0,
    };
    let into_material = |row: &Row| sign * row.z_mm;
    let apex = (0..rows.len())
        .min_by(|&i, &j| into_material(&rows[i]).total_cmp(&into_material(&rows[j])))
        .unwrap_or(0);
    let mut part = Touchable::default();
    let inner = part.walk(rows[..=apex].iter().rev(), -1.0, into_material)?;
    let outer = part.walk(rows[apex..].iter(), 1.0, into_material)?;
    part.points_mm = inner
        .into_iter()
        .rev()
        .chain(outer.into_iter().skip(1))
        .collect();
    Ok(part)
}

impl Touchable {
    /// Returns the points of `rows`, from the apex outwards, that lie further in `direction` than all previous points.
    fn walk<'a>(
        &mut self,
        mut rows: impl ExactSizeIterator<Item = &'a Row> + Clone,
        direction: f64,
        into_material: impl Fn(&Row) -> f64,
    ) -> Result<Vec<[f64; 2]>, ProfileError> {
        let mut kept = Vec::new();
        let Some(apex) = rows.next() else {
            return Ok(kept);
        };
        kept.push([apex.y_mm, apex.z_mm]);
        let in_reach = |row: &Row| into_material(row) - into_material(apex) <= REACH_MM;
        let (mut outermost, mut before) = (apex, apex);
        // Number of points since `outermost`, and the maximum distance of one of them behind it.
        let (mut hidden, mut fold_mm) = (0, 0.0_f64);
        while let Some(row) = rows.next() {
            if !in_reach(row) {
                hidden += 1 + rows.len();
                break;
            }
            let gap_mm = libm::hypot(row.y_mm - before.y_mm, row.z_mm - before.z_mm);
            if gap_mm > MAX_GAP_MM {
                // A gap on a vertical side is harmless: nothing further out is missing.
                let beyond = iter::once(row)
                    .chain(rows.clone())
                    .take_while(|row| in_reach(row))
                    .any(|row| direction * (row.y_mm - outermost.y_mm) > MAX_FOLD_MM);
                if beyond {
                    let line = row.line.max(before.line);
                    return Err(ProfileError::Gap { line, gap_mm });
                }
                hidden += 1 + rows.len();
                break;
            }
            before = row;
            let beyond_mm = direction * (row.y_mm - outermost.y_mm);
            let comes_out = beyond_mm > 0.0;
            let over_the_surface =
                into_material(row) < into_material(outermost) - MAX_FOLD_MM && !comes_out;
            fold_mm = fold_mm.max(-beyond_mm);
            if fold_mm > MAX_FOLD_MM && (comes_out || over_the_surface) {
                return Err(ProfileError::FoldedBack {
                    line: row.line,
                    y_mm: outermost.y_mm,
                    fold_mm,
                });
            }
            if comes_out {
                kept.push([row.y_mm, row.z_mm]);
                outermost = row;
                self.folded += hidden;
                self.widest_fold_mm = self.widest_fold_mm.max(fold_mm);
                (hidden, fold_mm) = (0, 0.0);
            } else {
                hidden += 1;
            }
        }
        self.overhanging += hidden;
        Ok(kept)
    }
}
