//! Stretches of a recording without gaps.

use std::ops::Range;

use crate::GAP_IN_MEDIANS;

/// Returns the median interval of increasing times; `None` for fewer than two times.
pub fn median_interval(times_s: &[f64]) -> Option<f64> {
    let mut intervals: Vec<f64> = times_s.windows(2).map(|pair| pair[1] - pair[0]).collect();
    intervals.sort_unstable_by(f64::total_cmp);
    intervals.get(intervals.len() / 2).copied()
}

/// Returns the index ranges between gaps, which are intervals longer than [`GAP_IN_MEDIANS`] times the median.
pub fn stretches(times_s: &[f64]) -> Vec<Range<usize>> {
    let Some(median) = median_interval(times_s) else {
        return Vec::new();
    };
    let is_gap = |pair: &[f64]| pair[1] - pair[0] > GAP_IN_MEDIANS * median;
    let gaps = times_s
        .windows(2)
        .enumerate()
        .filter(|(_, pair)| is_gap(pair));
    let ends: Vec<usize> = gaps
        .map(|(before, _)| before + 1)
        .chain([times_s.len()])
        .collect();
    let starts = [0].into_iter().chain(ends.iter().copied());
    starts.zip(&ends).map(|(start, end)| start..*end).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stretches_end_at_gaps() {
        let times = [0.0, 1.0, 2.0, 7.5, 8.5, 13.0, 30.0];
        assert_eq!(median_interval(&times), Some(4.5));
        let times = [0.0, 1.0, 2.0, 7.5, 8.5, 9.5, 14.0];
        assert_eq!(stretches(&times), [0..3, 3..7]);
        assert!(stretches(&[1.0]).is_empty());
    }

    #[test]
    fn a_gap_is_longer_than_five_medians() {
        // The median is 0.5 s.
        let before = [0.0, 0.5, 1.0, 1.5];
        let times = |gap_s: f64| [&before[..], &before.map(|t| 1.5 + gap_s + t)].concat();
        assert_eq!(stretches(&times(2.5)).first(), Some(&(0..8)));
        assert_eq!(stretches(&times(2.75)), [0..4, 4..8]);
        assert_eq!(stretches(&times(20.0)), [0..4, 4..8]);
    }
}
