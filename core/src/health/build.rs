//! Computes the constants of the estimator from the parameters of a damper.

use super::model::{
    Baseline, HealthLimits, HealthModel, MARK, MIN_TICKS, PIECE_SHIFT, PIECES, Piece,
};
use crate::build::CheckedParameters;
use crate::error::BuildError;
use crate::parameters::Element;

/// Duration of a block, whose samples form one measurement (s). It is short compared with the motion of a vehicle. At
/// 1 kHz a block has eight ticks, one for each part of the filter's work.
const BLOCK_S: f64 = 8e-3;
/// Longest crossing of the clearance, without contact, that the estimate still uses (s).
const MAX_CROSSING_S: f64 = 0.5;
/// Force above which the ends are in contact, in standard deviations of the force noise (1).
const CONTACT_DEVIATIONS: f64 = 4.0;
/// Fraction of the yield force below which the element certainly does not yield (1).
const UNYIELDING: f64 = 0.98;
/// The lag is remembered longer than the other parameters by this factor (1), because it hardly changes with age.
const LAG_MEMORY: f64 = 20.0;

/// Prior standard deviation of the force offset (N).
const ZERO_SD_N: f64 = 500.0;
/// Smallest alarm limit of the force offset (N).
const MIN_ZERO_LIMIT_N: f64 = 100.0;
/// Prior standard deviation of the seal friction as a fraction of the yield force (1).
const FRICTION_PART: f64 = 0.01;
/// Largest prior standard deviation of the seal friction (N).
const MAX_FRICTION_SD_N: f64 = 200.0;
/// Smallest move that is not noise, in standard deviations of a block's position (1).
const STILL_DEVIATIONS: f64 = 8.0;
/// The force counts as missing if the ends move beyond the clearance by more than this (m). A clearance cannot grow by
/// so much at once.
const MISSING_M: f64 = 2e-3;

/// Properties of the sensors and settings of the estimator.
///
/// ```
/// use dashpot_core::health::HealthSettings;
///
/// const SETTINGS: HealthSettings = HealthSettings::new(50e-6, 50.0).memory_s(10.0);
/// assert_eq!(SETTINGS.memory_s, 10.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct HealthSettings {
    /// Standard deviation of a sample's displacement (m), 1e-9 to 1e-2.
    pub displacement_noise_m: f64,
    /// Standard deviation of a sample's force (N), 1e-3 to 1e6.
    pub force_noise_n: f64,
    /// Time in contact after which the weight of a sample is 1/e (s), 0.1 to 1e5.
    pub memory_s: f64,
    /// Relative error of a healthy damper's law within a stroke (1), 0 to 1.
    pub law_deviation: f64,
    /// Lag of the measured force behind the measured displacement (s), -5e-3 to 5e-3.
    pub lag_s: f64,
    /// Standard deviation of the lag (s), 0 to 5e-3; 0 keeps it constant.
    pub lag_sd_s: f64,
}

impl HealthSettings {
    /// Settings for sensors with this noise (m, N): memory 1 s, law deviation 5 %, lag 0 with a standard deviation of 1
    /// ms.
    pub const fn new(displacement_noise_m: f64, force_noise_n: f64) -> Self {
        Self {
            displacement_noise_m,
            force_noise_n,
            memory_s: 1.0,
            law_deviation: 0.05,
            lag_s: 0.0,
            lag_sd_s: 1e-3,
        }
    }

    /// Sets [`memory_s`](field@Self::memory_s).
    #[must_use]
    pub const fn memory_s(mut self, memory_s: f64) -> Self {
        self.memory_s = memory_s;
        self
    }

    /// Sets [`law_deviation`](field@Self::law_deviation).
    #[must_use]
    pub const fn law_deviation(mut self, law_deviation: f64) -> Self {
        self.law_deviation = law_deviation;
        self
    }

    /// Sets the lag and its standard deviation (s).
    #[must_use]
    pub const fn lag(mut self, lag_s: f64, lag_sd_s: f64) -> Self {
        self.lag_s = lag_s;
        self.lag_sd_s = lag_sd_s;
        self
    }

    fn check(&self) -> Result<(), BuildError> {
        let ranges = [
            (
                "displacement_noise_m",
                self.displacement_noise_m,
                1e-9,
                1e-2,
                "1e-9 to 1e-2 m",
            ),
            (
                "force_noise_n",
                self.force_noise_n,
                1e-3,
                1e6,
                "1e-3 to 1e6 N",
            ),
            ("memory_s", self.memory_s, 0.1, 1e5, "0.1 to 1e5 s"),
            ("law_deviation", self.law_deviation, 0.0, 1.0, "0 to 1"),
            ("lag_s", self.lag_s, -5e-3, 5e-3, "-5e-3 to 5e-3 s"),
            ("lag_sd_s", self.lag_sd_s, 0.0, 5e-3, "0 to 5e-3 s"),
        ];
        for (field, value, min, max, allowed) in ranges {
            if !(min..=max).contains(&value) {
                return Err(BuildError::new("health", field, value, allowed));
            }
        }
        Ok(())
    }
}

impl CheckedParameters {
    /// Builds the constants for [`Health`](crate::health::Health) of a damper with these parameters, sampled at each
    /// step (s).
    ///
    /// # Errors
    /// A setting is out of range, or the step is outside 1e-5 to 2e-3 s.
    pub fn health_model(
        &self,
        settings: &HealthSettings,
        step_s: f64,
    ) -> Result<HealthModel, BuildError> {
        settings.check()?;
        if !(1e-5..=2e-3).contains(&step_s) {
            let allowed = "1e-5 to 2e-3 s for a health estimate";
            return Err(BuildError::new("step", "step_s", step_s, allowed));
        }
        let branches = self.branches();
        let yields = branches[0].force_limit.min(branches[1].force_limit);
        let last = (yields as f32).to_bits() >> PIECE_SHIFT;
        let first_piece = last.saturating_sub(PIECES as u32 - 2);
        let pieces = branches.each_ref().map(|branch| {
            core::array::from_fn(|number| {
                let border = |number: u32| f64::from(f32::from_bits(number << PIECE_SHIFT));
                let number = first_piece + number as u32;
                let from = if number == first_piece {
                    0.0
                } else {
                    border(number)
                };
                let to = border(number + 1).min(branch.force_limit);
                let line = |law: &dyn Fn(f64) -> f64| line(law, from, to.max(1.001 * from));
                let (velocity, velocity_slope) = line(&|force| branch.velocity(force));
                let spring = |force| branch.deflection(force) - force * branch.mount_compliance;
                let (oil, oil_slope) = line(&spring);
                Piece {
                    velocity,
                    velocity_slope,
                    oil,
                    oil_slope,
                }
            })
        });

        let ticks = libm::round(BLOCK_S / step_s).max(f64::from(MIN_TICKS));
        let block_s = ticks * step_s;
        // The reduced law has no friction, so none is estimated. The estimator could hardly distinguish a linear law
        // with friction from another linear law.
        let friction_sd = match self.element {
            Element::Physical(_) => (FRICTION_PART * yields).min(MAX_FRICTION_SD_N),
            Element::Reduced(_) => 0.0,
        };
        let compliance = self.mount.compliance_m_per_n();
        let force_noise = settings.force_noise_n;
        let position_variance = settings.displacement_noise_m * settings.displacement_noise_m
            + force_noise * force_noise * compliance * compliance;
        // Sum of (k - centre)^2 over a block's ticks.
        let spread = ticks * (ticks * ticks - 1.0) / 12.0;
        let growth = |memory_s: f64| 1.0 / (1.0 - block_s / (memory_s + block_s));
        let square = |value: f64| (value * value) as f32;
        Ok(HealthModel {
            mark: MARK,
            half_step_s: (0.5 * step_s) as f32,
            max_move_m: (self.limits.rate_m_per_s * step_s + 8.0 * settings.displacement_noise_m)
                as f32,
            max_force_n: (2.0 * self.limits.force_n + 8.0 * force_noise) as f32,
            first_piece,
            block_ticks: ticks as u32,
            per_block: (1.0 / ticks) as f32,
            per_block_s: (1.0 / block_s) as f32,
            block_centre: (0.5 * (ticks - 1.0)) as f32,
            rate_scale_per_s: (1.0 / (spread * step_s)) as f32,
            contact_force_n: (CONTACT_DEVIATIONS * force_noise) as f32,
            yield_force_n: (UNYIELDING * yields - CONTACT_DEVIATIONS * force_noise) as f32,
            measured_variance: (position_variance / ticks) as f32,
            force_travel_variance: (step_s * step_s * force_noise * force_noise * ticks) as f32,
            law_variance: square(settings.law_deviation) / ticks as f32,
            growth: growth(settings.memory_s) as f32,
            lag_growth: growth(LAG_MEMORY * settings.memory_s) as f32,
            max_unmeasured: (MAX_CROSSING_S / block_s) as u32,
            alarm_blocks: (settings.memory_s / block_s) as u32,
            start: [
                1.0,
                compliance as f32,
                (0.5 * self.mount.clearance_m) as f32,
                settings.lag_s as f32,
            ],
            start_variance: [
                square(0.3),
                square(compliance),
                square(1e-3),
                square(settings.lag_sd_s),
                square(ZERO_SD_N),
                square(friction_sd),
            ],
            oil_compliance: (branches[0].deflection(0.25 * yields) / (0.25 * yields) - compliance)
                as f32,
            block_s: block_s as f32,
            still_m: (STILL_DEVIATIONS * libm::sqrt(position_variance / ticks)) as f32,
            missing_m: MISSING_M as f32,
            zero_limit_n: (CONTACT_DEVIATIONS * force_noise).max(MIN_ZERO_LIMIT_N) as f32,
            baseline: Baseline {
                flow_factor: 1.0,
                compliance_m_per_n: compliance as f32,
                clearance_m: self.mount.clearance_m as f32,
                flow_factor_sd: 0.0,
                compliance_sd_m_per_n: 0.0,
                clearance_sd_m: 0.0,
            },
            limits: HealthLimits::default(),
            pieces,
        })
    }
}

/// Fits a line to a law over a piece and returns its value at zero force and its slope.
///
/// The slope is that of the chord between the two ends of the piece. The mean of the line over the piece equals the
/// mean of the law (Simpson's rule), so errors cancel in the summed travel.
fn line(law: &dyn Fn(f64) -> f64, from: f64, to: f64) -> (f32, f32) {
    let (first, last) = (law(from), law(to));
    let middle = law(0.5 * (from + to));
    let slope = (last - first) / (to - from);
    let moved = (2.0 / 3.0) * (middle - 0.5 * (first + last));
    ((first - slope * from + moved) as f32, slope as f32)
}

#[cfg(test)]
mod tests;
