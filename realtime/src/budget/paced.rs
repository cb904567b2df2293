//! Timing of a paced run.

use super::{Length, Run, Series, stop};
use crate::pacing::{Clock, Pacer};

/// Runs `tick` at the ticks of `pacer`. The run ends when the work of a tick takes longer than `stop_above_ns`.
pub fn paced<C: Clock>(
    mut pacer: Pacer<C>,
    length: Length,
    stop_above_ns: Option<u64>,
    mut tick: impl FnMut(),
) -> Run {
    let step_s = pacer.step_s();
    let ticks = match length {
        Length::Ticks(ticks) => ticks,
        Length::Nanoseconds(run_ns) => (run_ns as f64 * 1e-9 / step_s).round() as u64,
    };
    let stopped = (0..ticks).find_map(|number| {
        let timing = pacer.wait(number);
        tick();
        let finished = pacer.finish(timing);
        stop(number, step_s, finished.work_ns as f64, stop_above_ns)
    });
    let report = pacer.into_report();
    let series = [
        ("work", report.work),
        ("lateness", report.lateness),
        ("response", report.response),
    ];
    Run {
        ticks: report.ticks,
        missed_deadlines: Some(report.missed_deadlines),
        stopped,
        first_ticks_ns: report.first_work_ns,
        series: series
            .into_iter()
            .map(|(name, spans)| Series {
                name,
                ticks_per_span: 1,
                spans,
            })
            .collect(),
    }
}
