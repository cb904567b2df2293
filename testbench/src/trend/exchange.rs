//! Signs of an exchanged damper: readings that jump back from the limit.

use super::fit::Point;
use super::forecast::Limit;

/// Readings before and after a jump that are compared, at most.
const NEIGHBOURS: usize = 3;
/// Smallest jump, in deviations of the difference.
const MIN_DEVIATIONS: f64 = 5.0;
/// Smallest jump, as a fraction of the distance from the new readings to the limit.
const MIN_SHARE: f64 = 0.3;

/// Returns the abscissa of the first reading after the largest jump away from the limit that no scatter explains: the
/// damper may have been exchanged there.
pub fn steps_back(points: &[Point], limit: Limit) -> Option<f64> {
    let mut found: Option<(f64, f64)> = None;
    for at in 2..points.len().saturating_sub(1) {
        let (before, after) = points.split_at(at);
        let before = &before[before.len().saturating_sub(NEIGHBOURS)..];
        let after = &after[..after.len().min(NEIGHBOURS)];
        let [(old, old_sd), (new, new_sd)] = [mean(before), mean(after)];
        let back = if limit.is_upper { old - new } else { new - old };
        let enough =
            (MIN_DEVIATIONS * old_sd.hypot(new_sd)).max(MIN_SHARE * (limit.value - new).abs());
        let largest = found.map_or(0.0, |(_, largest)| largest);
        if back > enough && back > largest {
            found = after.first().map(|first| (first.x, back));
        }
    }
    found.map(|(x, _)| x)
}

/// Mean of readings, and its deviation: from the readings' own or from their scatter, whichever is larger.
fn mean(points: &[Point]) -> (f64, f64) {
    let count = points.len() as f64;
    let mean = points.iter().map(|point| point.y).sum::<f64>() / count;
    let own = points.iter().map(|point| point.sd * point.sd).sum::<f64>() / count;
    let scatter = points
        .iter()
        .map(|point| (point.y - mean).powi(2))
        .sum::<f64>()
        / (count - 1.0).max(1.0);
    (mean, (own.max(scatter) / count).sqrt())
}
