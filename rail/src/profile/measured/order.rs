//! Recognises points that do not follow one another along the curve.

use super::row::Row;
use super::{MAX_GAP_MM, ProfileError};

/// Length of the path through ordered points, relative to the path through the same points in order of `y`, beyond
/// which the surface was measured twice.
const MAX_RELATIVE_LENGTH: f64 = 1.1;

/// Distance between the points with the smallest and the greatest `y`, mm.
pub(super) fn width_mm(rows: &[Row]) -> f64 {
    let y = || rows.iter().map(|row| row.y_mm);
    y().fold(f64::MIN, f64::max) - y().fold(f64::MAX, f64::min)
}

/// The first jump between successive points across a part of the surface that other points cover; `None` if the points
/// are in order, or if sorting them would not close the gaps.
pub(super) fn jump(rows: &[Row]) -> Option<ProfileError> {
    let distance_mm = |pair: &[Row]| {
        let [p, q] = pair else { return 0.0 };
        libm::hypot(q.y_mm - p.y_mm, q.z_mm - p.z_mm)
    };
    let mut sorted = rows.to_vec();
    sorted.sort_by(|p, q| p.y_mm.total_cmp(&q.y_mm));
    if sorted.windows(2).any(|pair| distance_mm(pair) > MAX_GAP_MM) {
        return None;
    }
    let jumps = rows
        .windows(2)
        .filter(|pair| distance_mm(pair) > MAX_GAP_MM);
    let steps = rows.windows(2).map(distance_mm);
    let path_mm: f64 = steps.filter(|step| *step <= MAX_GAP_MM).sum();
    let sorted_mm: f64 = sorted.windows(2).map(distance_mm).sum();
    let are_few = jumps.clone().count() * 10 < rows.len();
    if are_few && path_mm > MAX_RELATIVE_LENGTH * sorted_mm {
        return None;
    }
    let first = jumps.clone().next()?;
    Some(ProfileError::Unsorted {
        line: first[1].line,
        jump_mm: distance_mm(first),
    })
}
