//! Cost of a step on this machine.

use std::hint::black_box;
use std::time::Instant;

use dashpot_core::CheckedParameters;

use crate::commands::failure::Outcome;
use dashpot_realtime::timing::Distribution;
use dashpot_testbench::compiled::Compiled;

/// Number of steps timed together. They take long compared with the clock's resolution, but are short compared with the
/// time between interruptions.
const BLOCK: usize = 500;
/// Minimum number of timed steps.
const STEPS: usize = 200_000;

/// Returns the median time per step over blocks of steps along the motion (ns).
///
/// # Errors
/// The damper cannot be built.
pub(super) fn median_ns_per_step<T: Compiled>(
    parameters: &CheckedParameters,
    step_s: f64,
    displacements_m: &[f64],
) -> Outcome<f64> {
    let damper = T::compiled_build(parameters, step_s)?;
    let motion: Vec<T> = displacements_m.iter().map(|&x| T::from_f64(x)).collect();
    let mut costs = Distribution::new();
    for _ in 0..STEPS.div_ceil(motion.len()) {
        let mut state = damper.at_rest(motion[0]);
        for block in motion.chunks_exact(BLOCK) {
            let start = Instant::now();
            for &x in block {
                black_box(T::compiled_step(
                    black_box(&damper),
                    &mut state,
                    black_box(x),
                ));
            }
            costs.record_ns(start.elapsed().as_secs_f64() * 1e9 / BLOCK as f64);
        }
    }
    Ok(costs.quantile_ns(0.5))
}
