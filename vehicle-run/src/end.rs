//! End of the track's irregularities, beyond which a run is on even rails.

use dashpot_files::case::Case;
use dashpot_rail::track::Track;

use super::warning::{WARN_EVEN_S, Warning};

/// Returns where the irregularities of a track end, m; infinite if it has none.
pub(super) fn irregular_to_m(track: &Track) -> f64 {
    let [start_m, end_m] = track.irregularity().ends_m();
    match end_m > start_m {
        true => end_m,
        false => f64::INFINITY,
    }
}

/// Returns the warning that a run of the case gives if it does not end early and keeps its speed.
pub fn foreseen(case: &Case, track: &Track) -> Option<Warning> {
    let end_m = irregular_to_m(track);
    let even_m = case.start_m + case.speed_m_per_s * case.duration_s - end_m;
    let even_s = (even_m / case.speed_m_per_s).clamp(0.0, case.duration_s);
    (even_s > WARN_EVEN_S).then_some(Warning::IrregularitiesEnd {
        end_m,
        even_s,
        duration_s: case.duration_s,
    })
}
