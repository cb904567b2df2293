//! Whether a profile lies as a wheel or a rail must.

use super::ProfileError;
use super::row::Row;
use crate::profile::Body;

/// Checks that a wheel's flange points down on the negative side of its datum and that a rail's head points up.
///
/// `rows` is not empty and begins at its negative end.
pub(super) fn check(body: Body, rows: &[Row]) -> Result<(), ProfileError> {
    match body {
        Body::Wheel => check_wheel(rows),
        Body::Rail if head_up(rows) => Ok(()),
        Body::Rail => Err(ProfileError::HeadDown),
    }
}

/// Whether the top of a rail is the least depth and both ends lie deeper.
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
    let [least, greatest] = [depths[0], depths[depths.len() - 1]];
    // More than half of a wheel's width is tread, so the median depth is one of the tread.
    let tread = depths[depths.len() / 2];
    let ends = [rows[0], rows[rows.len() - 1]];
    // Back and face of a wheel may reach further up than its flange down, but only at the ends of the curve.
    let below_ends = greatest - ends[0].z_mm.max(ends[1].z_mm);
    let above_ends = ends[0].z_mm.min(ends[1].z_mm) - least;
    let height_mm = if above_ends > below_ends {
        tread - least
    } else {
        greatest - tread
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
