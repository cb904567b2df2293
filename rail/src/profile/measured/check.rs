//! Whether the rows of a measured profile are those of a wheel or a rail.

use super::{MAX_GAP_MM, MIN_POINTS, ProfileError, Row};
use crate::profile::Body;

/// The points of `rows` in mm, with `y` rising, once they are known to be a profile of `body`.
pub(super) fn checked(body: Body, mut rows: Vec<Row>) -> Result<Vec<[f64; 2]>, ProfileError> {
    if rows.len() < MIN_POINTS {
        return Err(ProfileError::TooFewPoints { found: rows.len() });
    }
    if rows[0].1[0] > rows[rows.len() - 1].1[0] {
        rows.reverse();
    }
    for neighbours in rows.windows(2) {
        let ((_, [y0, z0]), (line, [y, z])) = (neighbours[0], neighbours[1]);
        if y <= y0 {
            return Err(ProfileError::FoldedBack {
                line,
                y_mm: y,
                before_mm: y0,
            });
        }
        let gap = (y - y0).hypot(z - z0);
        if gap > MAX_GAP_MM {
            return Err(ProfileError::Gap { line, gap_mm: gap });
        }
    }
    let points: Vec<[f64; 2]> = rows.iter().map(|row| row.1).collect();
    check_orientation(body, &points)?;
    Ok(points)
}

/// Checks that a wheel's flange points down on the negative side and that a rail's head points up.
fn check_orientation(body: Body, points: &[[f64; 2]]) -> Result<(), ProfileError> {
    let depth = |point: &[f64; 2]| point[1];
    let mut depths: Vec<f64> = points.iter().map(depth).collect();
    depths.sort_by(f64::total_cmp);
    match body {
        Body::Wheel => {
            // More than half of a wheel's width is tread, so the median depth is one of the tread.
            let tread = depths[depths.len() / 2];
            let distance = |point: &&[f64; 2]| (point[1] - tread).abs();
            let Some(flange) = points
                .iter()
                .max_by(|a, b| distance(a).total_cmp(&distance(b)))
            else {
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
            if 2.0 * flange[0] > points[0][0] + points[points.len() - 1][0] {
                return Err(ProfileError::FlangeOutside);
            }
        }
        Body::Rail => {
            let highest = depths[0];
            let ends = [points[0][1], points[points.len() - 1][1]];
            if ends.iter().any(|end| end - highest < 0.5) {
                return Err(ProfileError::HeadDown);
            }
        }
    }
    Ok(())
}
