//! Errors of a fixed step against the reference on one motion.

use super::motion::Motion;

/// Lower bound on the root mean square force in an NRMSE, as a fraction of the force limit.
pub const MIN_RMS_FORCE_RATIO: f64 = 0.01;

/// Errors of one fixed step on one motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MotionErrors {
    /// Largest error at a tick (N).
    pub largest_n: f64,
    /// Tick of the largest error.
    pub tick: usize,
    /// RMS error over RMS force (1); the divisor is at least [`MIN_RMS_FORCE_RATIO`] of the force limit.
    ///
    /// For a motion in parts, this is the largest NRMSE of any part: no motion that joins and repeats these parts
    /// exceeds it.
    pub nrmse: f64,
    /// Largest force of the reference in extension and in compression (N).
    pub reference_peak_n: [f64; 2],
    /// Largest force at a tick where the reference force is zero or has the opposite sign (N).
    pub wrong_sign_n: f64,
}

impl MotionErrors {
    /// Compares `forces` (N), one per tick, with the reference at the compared ticks.
    pub(super) fn new(motion: &Motion, forces: &[f64], reference: &[f64], limit_n: f64) -> Self {
        let mut found = Self::default();
        let mut part = Part::default();
        let mut ends = motion.part_ends.iter().peekable();
        let mut before = 0;
        for (&tick, &expected) in motion.compared.iter().zip(reference) {
            let actual = forces.get(tick).copied().unwrap_or(f64::NAN);
            let error = (actual - expected).abs();
            // NaN counts as larger than any number.
            if error.is_nan() || error > found.largest_n {
                (found.largest_n, found.tick) = (error, tick);
            }
            let peak = &mut found.reference_peak_n[usize::from(expected < 0.0)];
            *peak = peak.max(expected.abs());
            if actual * expected <= 0.0 {
                found.wrong_sign_n = found.wrong_sign_n.max(actual.abs());
            }
            // Within a rest, a compared tick also represents the skipped ticks before it.
            let weight = (tick - before).max(1) as f64;
            part.squares += weight * error * error;
            part.force_squares += weight * expected * expected;
            part.ticks += weight;
            before = tick;
            if ends.next_if(|end| **end <= tick).is_some() {
                found.add(&part, limit_n);
                part = Part::default();
            }
        }
        found.add(&part, limit_n);
        found
    }

    /// Raises the NRMSE to the NRMSE of a part if that is larger.
    fn add(&mut self, part: &Part, limit_n: f64) {
        let rms = |sum: f64| (sum / f64::max(part.ticks, 1.0)).sqrt();
        let min_rms = MIN_RMS_FORCE_RATIO * limit_n;
        let nrmse = rms(part.squares) / rms(part.force_squares).max(min_rms);
        if self.nrmse.total_cmp(&nrmse).is_lt() {
            self.nrmse = nrmse;
        }
    }
}

/// Sums over the ticks of a part of a motion.
#[derive(Default)]
struct Part {
    squares: f64,
    force_squares: f64,
    ticks: f64,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::probing::Kind;

    #[test]
    fn errors_of_forces_that_are_known() {
        let motion = Motion::new(Kind::Other, 1.0, vec![0.0, 1.0, 2.0, 1.0]);
        let reference = [0.0, 10.0, 10.0, -10.0];
        let found = MotionErrors::new(&motion, &[0.0, 10.0, 13.0, 2.0], &reference, 100.0);
        assert_eq!((found.largest_n, found.tick), (12.0, 3));
        assert_eq!(found.wrong_sign_n, 2.0);
        assert!((found.nrmse - (153.0_f64 / 300.0).sqrt()).abs() < 1e-12);
        let lost = MotionErrors::new(&motion, &[0.0, f64::NAN, 0.0, 0.0], &reference, 100.0);
        assert!(lost.largest_n.is_nan() && lost.nrmse.is_nan());
    }

    #[test]
    fn a_small_force_counts_as_a_hundredth_of_the_limit() {
        let motion = Motion::new(Kind::Other, 1.0, vec![0.0, 1.0]);
        let found = MotionErrors::new(&motion, &[0.0, 2f64.sqrt()], &[0.0, 0.0], 100.0);
        assert!((found.nrmse - 1.0).abs() < 1e-12);
    }
}
