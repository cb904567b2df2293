//! Start of a run on track that is not ideal, which causes a transient.

use dashpot_files::case::Case;
use dashpot_rail::track::Track;

use super::signals::SIDES;
use super::warning::{WARN_START_DEVIATION_M, WARN_START_RATE_M_PER_S, Warning};

/// Returns a warning for the first wheelset that starts in a curve or on irregular rails.
pub(super) fn warning(case: &Case, track: &Track) -> Option<Warning> {
    case.vehicle.wheelsets.iter().find_map(|wheelset| {
        let distance_m = case.start_m + wheelset.x_m;
        let point = track.at(distance_m);
        let (curvature_per_m, cant_m) = (point.alignment.curvature_per_m, point.alignment.cant_m);
        if curvature_per_m != 0.0 || cant_m != 0.0 {
            return Some(Warning::StartInCurve {
                wheelset: wheelset.name.clone(),
                distance_m,
                curvature_per_m,
                cant_m,
            });
        }
        // A gauge that deviates alike on both sides pushes nothing.
        let [left, right] = point.rails;
        let lateral_m = 0.5 * (left.lateral_m + right.lateral_m);
        let lateral_slope = 0.5 * (left.lateral_slope + right.lateral_slope);
        let rails = point.rails.iter().zip(SIDES);
        let mut rails = rails.map(|(rail, side)| {
            let deviation_m = rail.vertical_m.abs().max(lateral_m.abs());
            let slope = rail.vertical_slope.abs().max(lateral_slope.abs());
            (side, deviation_m, slope * case.speed_m_per_s)
        });
        let (side, deviation_m, rate_m_per_s) = rails.find(|(_, deviation_m, rate_m_per_s)| {
            *deviation_m > WARN_START_DEVIATION_M || *rate_m_per_s > WARN_START_RATE_M_PER_S
        })?;
        Some(Warning::StartOnIrregularity {
            wheelset: wheelset.name.clone(),
            side,
            distance_m,
            deviation_m,
            rate_m_per_s,
        })
    })
}
