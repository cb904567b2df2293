//! Timing of a paced run.

use super::{Length, Run};
use crate::pacing::{Clock, Pacer};

/// Runs `tick` at the ticks of `pacer`. The run ends when the work of a tick takes longer than `stop_above_ns`.
pub fn paced<C: Clock>(
    pacer: Pacer<C>,
    length: Length,
    stop_above_ns: Option<u64>,
    mut tick: impl FnMut(),
) -> Run {
    let mut pacer = pacer.stopping_above_ns(stop_above_ns);
    let ticks = match length {
        Length::Ticks(ticks) => ticks,
        Length::Nanoseconds(run_ns) => (run_ns as f64 * 1e-9 / pacer.step_s()).round() as u64,
    };
    for number in 0..ticks {
        let timing = pacer.wait(number);
        tick();
        pacer.finish(timing);
        if pacer.report().stopped.is_some() {
            break;
        }
    }
    pacer.into_report().into()
}
