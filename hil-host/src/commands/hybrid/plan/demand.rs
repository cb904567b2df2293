//! What a case asks of an actuator.

use dashpot_files::actuator::ActuatorParameters;
use dashpot_files::case::Case;
use dashpot_rail::indices::Welch;
use dashpot_vehicle_run::Run;
use serde::Serialize;

use crate::commands::failure::{Failure, Outcome};
use crate::commands::progress;

/// Length of the windows of the spectrum, s.
const WINDOW_S: f64 = 2.0;
/// Share of the power of the velocity below the bandwidth.
const SHARE: f64 = 0.99;

/// Motion and force of a damper in a case.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Demand {
    pub(super) stroke_m: f64,
    pub(super) velocity_m_per_s: f64,
    pub(super) force_n: f64,
    /// Frequency below which 99 % of the power of the velocity lie, Hz; `None` if the run is shorter than 2 s.
    pub(super) bandwidth_hz: Option<f64>,
}

impl Demand {
    /// Runs the case with all dampers inside; returns the demand of each of `dampers`.
    ///
    /// # Errors
    /// The case cannot run, or ends early.
    pub(super) fn of_case(case: &Case, dampers: &[usize]) -> Outcome<Vec<Self>> {
        let refused = |error: String| Failure::new(format!("{}: {error}", case.name));
        let mut run = Run::new(case).map_err(|error| refused(error.to_string()))?;
        let mut found = vec![[0.0_f64; 3]; dampers.len()];
        let mut spectra = Vec::new();
        for _ in dampers {
            let spectrum = Welch::new(1.0 / case.step_s, WINDOW_S);
            spectra.push(spectrum.map_err(|error| refused(error.to_string()))?);
        }
        let bar = progress::bar(run.ticks(), "vehicle");
        while !run.is_over() {
            let ended = run.step().map_err(|error| refused(error.to_string()))?;
            if let Some(ending) = ended {
                return Err(refused(ending.to_string()));
            }
            let state = run.state();
            for ((most, spectrum), damper) in found.iter_mut().zip(&mut spectra).zip(dampers) {
                let velocity = state.damper_velocities_m_per_s()[*damper];
                for (most, value) in most.iter_mut().zip([
                    state.damper_displacements_m()[*damper],
                    velocity,
                    state.damper_forces_n()[*damper],
                ]) {
                    *most = most.max(value.abs());
                }
                spectrum.add(velocity);
            }
            bar.inc(1);
        }
        bar.finish_and_clear();
        let demands = found.into_iter().zip(&spectra).map(|(most, spectrum)| {
            let [stroke_m, velocity_m_per_s, force_n] = most;
            Self {
                stroke_m,
                velocity_m_per_s,
                force_n,
                bandwidth_hz: (spectrum.windows() > 0).then(|| bandwidth_hz(&spectrum.density())),
            }
        });
        Ok(demands.collect())
    }

    /// Returns what the actuator cannot give.
    pub(super) fn exceeded(&self, actuator: &ActuatorParameters) -> Vec<String> {
        let limits = actuator.limits;
        let checks = [
            ("stroke", 1e3, "mm", self.stroke_m, limits.stroke_m),
            (
                "velocity",
                1.0,
                "m/s",
                self.velocity_m_per_s,
                limits.velocity_m_per_s,
            ),
            ("force", 1e-3, "kN", self.force_n, limits.force_n),
        ];
        let exceeded = checks
            .into_iter()
            .filter(|(.., value, limit)| value > limit);
        let texts = exceeded.map(|(name, factor, unit, value, limit)| {
            format!(
                "{name} {:.3} {unit}, the actuator has {:.3} {unit}",
                factor * value,
                factor * limit
            )
        });
        texts.collect()
    }
}

/// Frequency below which most of the power lies.
fn bandwidth_hz(density: &[[f64; 2]]) -> f64 {
    let total: f64 = density.iter().map(|[_, power]| power).sum();
    let mut below = 0.0;
    for [frequency_hz, power] in density {
        below += power;
        if below >= SHARE * total {
            return *frequency_hz;
        }
    }
    0.0
}
