//! Constants of the estimator: nominal laws of a damper, noise of its sensors and its healthy state.

use zerocopy::{FromBytes, Immutable, IntoBytes};

/// Mark that distinguishes a model or an estimate from uninitialised memory.
pub(crate) const MARK: u32 = 0x4d48_4144;

/// Smallest number of ticks of a block: one for each stage of the filter.
pub(crate) const MIN_TICKS: u32 = 8;

/// Number of pieces of a side: four for each octave of force. The first piece starts at zero force.
pub(crate) const PIECES: usize = 64;
/// Number of low bits of a force that do not affect the choice of the piece.
pub(crate) const PIECE_SHIFT: u32 = 21;

/// The laws over one piece of force magnitude F (N), each as a line `value + slope F`.
#[derive(Clone, Copy, Debug, Default, PartialEq, FromBytes, Immutable, IntoBytes)]
#[repr(C)]
pub(crate) struct Piece {
    /// Velocity of the piston in the cylinder (m/s).
    pub(crate) velocity: f32,
    /// Slope of the velocity (m/(s N)).
    pub(crate) velocity_slope: f32,
    /// Deflection of the oil column (m).
    pub(crate) oil: f32,
    /// Slope of the deflection (m/N).
    pub(crate) oil_slope: f32,
}

/// Healthy state of a damper with its uncertainty.
///
/// These are plain numbers, which you can store with the documents of the damper.
/// [`HealthReading::as_baseline`](super::HealthReading::as_baseline) returns the baseline from a run with the damper
/// when it is new; [`HealthModel::set_baseline`] uses it.
#[derive(Clone, Copy, Debug, PartialEq, FromBytes, Immutable, IntoBytes)]
#[non_exhaustive]
#[repr(C)]
pub struct Baseline {
    /// Ratio of the flow to the nominal flow at the same force (1).
    pub flow_factor: f32,
    /// Compliance of the mount `1/Ke` (m/N).
    pub compliance_m_per_n: f32,
    /// Clearance 2a (m). A healthy damper without play also has a small apparent clearance, due to air and friction.
    pub clearance_m: f32,
    /// Standard deviation of the flow factor (1).
    pub flow_factor_sd: f32,
    /// Standard deviation of the compliance (m/N).
    pub compliance_sd_m_per_n: f32,
    /// Standard deviation of the clearance (m).
    pub clearance_sd_m: f32,
}

impl Baseline {
    /// A baseline without uncertainty: flow factor (1), compliance of the mount (m/N), clearance 2a (m).
    ///
    /// Set the standard deviations through their fields.
    pub const fn new(flow_factor: f32, compliance_m_per_n: f32, clearance_m: f32) -> Self {
        Self {
            flow_factor,
            compliance_m_per_n,
            clearance_m,
            flow_factor_sd: 0.0,
            compliance_sd_m_per_n: 0.0,
            clearance_sd_m: 0.0,
        }
    }
}

/// Alarm limits: allowed differences of an estimate from the baseline.
///
/// Start from [`HealthLimits::default`] and change single fields.
#[derive(Clone, Copy, Debug, PartialEq, FromBytes, Immutable, IntoBytes)]
#[non_exhaustive]
#[repr(C)]
pub struct HealthLimits {
    /// Change of the flow factor in either direction (1).
    pub flow_factor: f32,
    /// Change of the compliance in either direction, relative to the baseline (1). 0.43 means 30 % less stiffness.
    pub compliance: f32,
    /// Change of the clearance in either direction (m).
    pub clearance_m: f32,
    /// Smallest significant difference, in combined standard deviations of estimate and baseline (1).
    pub deviations: f32,
}

impl Default for HealthLimits {
    fn default() -> Self {
        Self {
            flow_factor: 0.15,
            compliance: 0.43,
            clearance_m: 0.5e-3,
            deviations: 5.0,
        }
    }
}

/// Invalid baseline: a number is not finite, flow factor or compliance is not positive, or a standard deviation is
/// negative.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "a baseline must be finite, with a positive flow factor, a positive compliance and no negative deviation"
)]
#[non_exhaustive]
pub struct BaselineError;

/// Constants of the estimator for one damper and one step size; shared by any number of [`Health`](super::Health).
///
/// ```
/// # #[cfg(feature = "builder")] {
/// use dashpot_core::health::{Health, HealthSettings};
/// use dashpot_core::parameters::{DamperParameters, Mount};
/// use dashpot_core::Damper;
///
/// let checked = DamperParameters::reduced(120e3, 0.03, Mount::new(8e6)).check()?;
/// let settings = HealthSettings::new(50e-6, 50.0); // noise of the sensors: 50 um, 50 N
/// let model = checked.health_model(&settings, 1e-3)?;
///
/// let damper: Damper<f32> = checked.build(1e-3)?; // here instead of a real damper
/// let mut state = damper.at_rest(0.0);
/// let mut health = Health::new(&model);
/// for tick in 0..20_000 {
///     let t = tick as f32 * 1e-3;
///     let displacement = 1e-3 * (9.0 * t).sin() + 0.5e-3 * (31.0 * t).sin();
///     let force = damper.step(&mut state, displacement);
///     health.tick(&model, displacement, force);
/// }
/// let reading = health.reading(&model);
/// assert!((reading.flow_factor.value - 1.0).abs() < 0.01);
/// assert!((reading.stiffness_n_per_m.value / 8e6 - 1.0).abs() < 0.1);
/// # }
/// # Ok::<(), dashpot_core::BuildError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, FromBytes, Immutable, IntoBytes)]
#[repr(C)]
pub struct HealthModel {
    /// Distinguishes a model from uninitialised memory.
    pub(crate) mark: u32,
    /// Half the step (s).
    pub(crate) half_step_s: f32,
    /// Largest credible move of the displacement in a step (m).
    pub(crate) max_move_m: f32,
    /// Largest credible force (N).
    pub(crate) max_force_n: f32,
    /// Leading bits of the forces in the first piece.
    pub(crate) first_piece: u32,
    /// Number of ticks of a block.
    pub(crate) block_ticks: u32,
    /// Inverse of the number of ticks of a block (1).
    pub(crate) per_block: f32,
    /// Inverse of the duration of a block (1/s).
    pub(crate) per_block_s: f32,
    /// Centre of a block in ticks from its first tick.
    pub(crate) block_centre: f32,
    /// Factor (1/s) that gives the rate of the force from the sum of the forces, each times its distance in ticks from
    /// the centre.
    pub(crate) rate_scale_per_s: f32,
    /// Force above which both ends are in contact in spite of noise (N).
    pub(crate) contact_force_n: f32,
    /// Force above which the element may be yielding (N).
    pub(crate) yield_force_n: f32,
    /// Variance of a block's measurement (m^2).
    pub(crate) measured_variance: f32,
    /// Variance of the piston's travel in a block due to force noise, divided by the square of the law's mean slope
    /// (N^2 s^2).
    pub(crate) force_travel_variance: f32,
    /// Variance of the piston's travel in a block due to errors of the law, divided by the square of the travel (1).
    pub(crate) law_variance: f32,
    /// Growth factor of the parameters' variance in a block (1).
    pub(crate) growth: f32,
    /// Growth factor of the lag's variance in a block (1).
    pub(crate) lag_growth: f32,
    /// Number of blocks without contact after which the position counts as unknown, because it drifts with the force
    /// offset.
    pub(crate) max_unmeasured: u32,
    /// Number of consecutive measured blocks beyond a limit after which there is an alarm.
    pub(crate) alarm_blocks: u32,
    /// Initial flow factor, compliance, half clearance and lag. Force offset and added friction start at 0.
    pub(crate) start: [f32; 4],
    /// Initial variances, which are also the largest: in the order of `start`, then those of force offset and added
    /// friction.
    pub(crate) start_variance: [f32; 6],
    /// Mean compliance of the oil column (m/N).
    pub(crate) oil_compliance: f32,
    /// Duration of a block (s).
    pub(crate) block_s: f32,
    /// Largest move that can be noise (m).
    pub(crate) still_m: f32,
    /// The force counts as missing if the ends move beyond the clearance by more than this, even after recent contact
    /// (m).
    pub(crate) missing_m: f32,
    /// Alarm limit of the force offset (N).
    pub(crate) zero_limit_n: f32,
    pub(crate) baseline: Baseline,
    pub(crate) limits: HealthLimits,
    /// Pieces of extension, then of compression.
    pub(crate) pieces: [[Piece; PIECES]; 2],
}

impl HealthModel {
    /// True for a model, false for uninitialised memory. Use this in programs whose models come from elsewhere, for
    /// example from C.
    #[inline]
    pub fn is_marked(&self) -> bool {
        self.mark == MARK
    }

    /// Step (s).
    pub fn step_s(&self) -> f32 {
        2.0 * self.half_step_s
    }

    /// Baseline of the alarms. In a new model it is the nominal damper.
    pub fn baseline(&self) -> Baseline {
        self.baseline
    }

    /// Sets the baseline of the alarms.
    ///
    /// # Errors
    /// The baseline is invalid; the model is unchanged.
    pub fn set_baseline(&mut self, baseline: Baseline) -> Result<(), BaselineError> {
        let positive = [baseline.flow_factor, baseline.compliance_m_per_n];
        let deviations = [
            baseline.flow_factor_sd,
            baseline.compliance_sd_m_per_n,
            baseline.clearance_sd_m,
        ];
        let fits = positive
            .iter()
            .all(|value| *value > 0.0 && value.is_finite())
            && deviations.iter().all(|sd| *sd >= 0.0 && sd.is_finite())
            && baseline.clearance_m.is_finite();
        if !fits {
            return Err(BaselineError);
        }
        self.baseline = baseline;
        Ok(())
    }

    /// Alarm limits.
    pub fn limits(&self) -> HealthLimits {
        self.limits
    }

    /// Sets the alarm limits. An infinite or NaN limit disables its alarm.
    pub fn set_limits(&mut self, limits: HealthLimits) {
        self.limits = limits;
    }

    /// Finds the piece of a force (N); its sign selects the side. Every bit pattern of the force is safe.
    #[inline(always)]
    pub(crate) fn piece(&self, force: f32) -> &Piece {
        let bits = force.to_bits();
        let number =
            ((bits & 0x7fff_ffff) >> PIECE_SHIFT).saturating_sub(self.first_piece) as usize;
        let number = if number < PIECES { number } else { PIECES - 1 };
        &self.pieces[(bits >> 31) as usize][number]
    }
}

#[cfg(test)]
mod tests;
