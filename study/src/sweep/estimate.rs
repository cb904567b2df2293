//! Estimate of the time that a study takes on this machine, from a short run of its longest case.

use std::time::Duration;

use serde::Serialize;

use super::curves::Recorder;
use super::plan::Plan;
use super::run::{RunError, observe_run};
use super::shared::Shared;

/// Time after which the probe ends.
pub const PROBE: Duration = Duration::from_millis(300);

/// Estimated time of the simulations of a plan, and what it is based on.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct TimeEstimate {
    /// Estimated time of all simulations, s.
    pub takes_s: f64,
    /// Number of threads. All ran the probe at the same time.
    pub threads: usize,
    /// Number of the case that was run as a probe.
    pub probe_case: u64,
    /// Simulated time of the probe on all threads together, s.
    pub probe_simulated_s: f64,
    /// Time that the probe took, s.
    pub probe_took_s: f64,
}

/// Part of a case that one thread ran.
struct Probed {
    ticks: u64,
    step_s: f64,
    /// Work per tick, in the unit of [`Plan::work`].
    work_per_tick: f64,
    took: Duration,
}

impl Plan<'_> {
    /// Runs the beginning of the longest case on every thread for the time [`PROBE`] of `clock`, and extrapolates to
    /// all simulations. Returns `None` if there are none. Contacts and the track of the case are built before and kept
    /// in `shared`.
    ///
    /// # Errors
    /// The case is invalid or cannot be run.
    pub fn estimate(
        &self,
        shared: &Shared,
        clock: &(dyn Fn() -> Duration + Sync),
    ) -> Result<Option<TimeEstimate>, RunError> {
        let Some((number, longest_work)) = self.longest() else {
            return Ok(None);
        };
        let study = self.study();
        let Some(studied) = study.case(number) else {
            return Ok(None);
        };
        let case = study.build(&studied)?;
        let failed = |source| RunError::in_sweep(studied.sweep, source);
        drop(shared.run(&case).map_err(failed)?);
        let threads = self.threads();
        let places: Vec<usize> = (0..threads).collect();
        let mut probed = Vec::with_capacity(threads);
        let probe = |_: &usize, _: &dyn Fn() -> bool| -> Result<Probed, RunError> {
            let mut run = shared.run(&case).map_err(failed)?;
            let mut recorder = Recorder::new(&run, std::iter::empty());
            let start = clock();
            let is_over = || clock().saturating_sub(start) >= PROBE;
            observe_run(&case, &mut run, &study.observed, &mut recorder, &is_over)
                .map_err(failed)?;
            Ok(Probed {
                ticks: run.state().ticks(),
                step_s: case.step_s,
                work_per_tick: case.vehicle.wheelsets.len() as f64,
                took: clock().saturating_sub(start),
            })
        };
        dashpot_workers::in_parallel(&places, threads, probe, |_, result| {
            probed.push(result?);
            Ok::<(), RunError>(())
        })?;
        let rate: f64 = probed.iter().map(Probed::rate).sum();
        let simulated = |probed: &Probed| probed.ticks as f64 * probed.step_s;
        let took = probed.iter().map(|probed| probed.took).max();
        // No case runs on more than one thread.
        let shared_work = (self.work() / rate).max(longest_work * threads as f64 / rate);
        Ok(Some(TimeEstimate {
            takes_s: shared_work,
            threads,
            probe_case: number,
            probe_simulated_s: probed.iter().map(simulated).sum(),
            probe_took_s: took.unwrap_or_default().as_secs_f64(),
        }))
    }
}

impl Probed {
    /// Work per second.
    fn rate(&self) -> f64 {
        let seconds = self.took.as_secs_f64().max(1e-9);
        self.ticks.max(1) as f64 * self.work_per_tick / seconds
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicU64, Ordering};
    use std::time::Duration;

    use crate::sweep::{Plan, Shared, Study};
    use dashpot_files::study::StudyParameters;

    #[test]
    fn the_estimate_is_the_work_of_all_simulations_at_the_rate_of_the_probe() {
        let text = r#"
            name = "two lengths"
            observed = ["derailment_rms"]
            [[sweep]]
            name = "lengths"
            track = "straight"
            speed_km_h = 120
            vary = [{ parameter = "duration_s", values = [1.5, 4] }]
            [[sweep]]
            name = "the longer again"
            track = "straight"
            speed_km_h = 120
            duration_s = 4"#;
        let study = Study::new(StudyParameters::parse("study", text).unwrap()).unwrap();
        let plan = Plan::new(&study, &[0, 1, 2], 1).unwrap();
        // Each look at the clock takes 100 ms: the start, two of the run, the third, which ends it, and the last.
        let looks = AtomicU64::new(0);
        let clock = || Duration::from_millis(100 * looks.fetch_add(1, Ordering::Relaxed));
        let estimate = plan.estimate(&Shared::default(), &clock).unwrap().unwrap();
        assert_eq!(estimate.probe_case, 1);
        assert_eq!(estimate.probe_took_s, 0.4);
        assert_eq!(estimate.probe_simulated_s, 3.0 * 1.024);
        // The two equal cases are simulated once.
        let expected_s = (1.5 + 4.0) / estimate.probe_simulated_s * 0.4;
        assert!((estimate.takes_s - expected_s).abs() < 1e-9, "{estimate:?}");
        let none = Plan::new(&study, &[], 1).unwrap();
        assert_eq!(none.estimate(&Shared::default(), &clock).unwrap(), None);
    }
}
