//! Checks of the orientation of a wheel or rail profile.

use super::ProfileError;
use super::row::Row;
use crate::profile::Body;

/// Checks that the flange of a wheel points down at negative `y`, and that the head of a rail points up.
///
/// `rows` is not empty and begins at the end with negative `y`.
pub(super) fn check(body: Body, rows: &[Row]) -> Result<(), ProfileError> {
    match body {
        Body::Wheel => check_wheel(rows),
        Body::Rail if head_up(rows) => Ok(()),
        Body::Rail => Err(ProfileError::HeadDown),
    }
}

/// True if both ends of a rail are at least 0.5 mm deeper than its top.
pub(super) fn head_up(rows: &[Row]) -> bool {
    let top = rows
        .iter()
        .map(|row| row.z_mm)
        .fold(f64::INFINITY, f64::min);
    let ends = [rows.first(), rows.last()];
    ends.iter().flatten().all(|end| end.z_mm - top >= 0.5)
}

fn check_wheel(rows: &[Row]) -> Result<(), ProfileError> {
    let mut depths: Vec<f64> = rows.iter().map(|row| row.z_mm).collect();
    depths.sort_by(f64::total_cmp);
    let [min, max] = [depths[0], depths[depths.len() - 1]];
    // More than half of a wheel's width is tread, so the median depth lies on the tread.
    let tread = depths[depths.len() / 2];
    let ends = [rows[0], rows[rows.len() - 1]];
    // The back and the face of a wheel may extend further up than the flange extends down, but only at the ends.
    let below_ends = max - ends[0].z_mm.max(ends[1].z_mm);
    let above_ends = ends[0].z_mm.min(ends[1].z_mm) - min;
    let height_mm = if above_ends > below_ends {
        tread - min
    } else {
        max - tread
    };
    if height_mm < 15.0 {
        return Err(ProfileError::NoFlange {
            depth_mm: height_mm,
        });
    }
    if above_ends > below_ends {
        return Err(ProfileError::FlangeUp);
    }
    let tip_mm = rows
        .iter()
        .max_by(|a, b| a.z_mm.total_cmp(&b.z_mm))
        .map_or(0.0, |tip| tip.y_mm);
    let [from_mm, to_mm] = ends.map(|end| end.y_mm);
    if 2.0 * tip_mm > from_mm + to_mm {
        return Err(ProfileError::FlangeOutside);
    }
    if !(tip_mm < 0.0 && to_mm > 0.0) {
        return Err(ProfileError::DatumOutside {
            from_mm,
            to_mm,
            tip_mm,
        });
    }
    Ok(())
}
