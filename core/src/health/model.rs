//! What the estimator takes as known: the nominal laws of a damper, the noise of its sensors, its healthy state.

use zerocopy::{FromBytes, Immutable, IntoBytes};

/// What stands in a model and in an estimate: memory that was never written has other bits.
pub(crate) const MARK: u32 = 0x4d48_4144;

/// Fewest ticks of a block: each stage of the filter takes one.
pub(crate) const FEWEST_TICKS: u32 = 8;

/// Pieces of a side: four to an octave of force, the first from no force.
pub(crate) const PIECES: usize = 64;
/// Bits of a force below those that number a piece.
pub(crate) const PIECE_SHIFT: u32 = 21;

/// The laws over a piece of force magnitude (N), each a line `value + slope F`.
#[derive(Clone, Copy, Debug, Default, PartialEq, FromBytes, Immutable, IntoBytes)]
#[repr(C)]
pub(crate) struct Piece {
    /// Velocity of the piston in the cylinder (m/s).
    pub(crate) velocity: f32,
    /// Its slope (m/(s N)).
    pub(crate) velocity_slope: f32,
    /// Deflection of the oil column (m).
    pub(crate) oil: f32,
    /// Its slope (m/N).
    pub(crate) oil_slope: f32,
}

/// What a damper was when it was healthy, and with which variance that is known.
///
/// Plain numbers to be kept where the damper's other papers are: [`Health::reading`](super::Health::reading) of a run
/// with the new damper gives one, [`HealthModel::set_baseline`] takes it.
#[derive(Clone, Copy, Debug, PartialEq, FromBytes, Immutable, IntoBytes)]
#[repr(C)]
pub struct Baseline {
    /// Flow over nominal flow at the same force (1).
    pub flow_factor: f32,
    /// Compliance of the mount `1/Ke` (m/N).
    pub compliance_m_per_n: f32,
    /// Clearance 2a (m); of a healthy damper without play what air and friction make look like it.
    pub clearance_m: f32,
    /// Standard deviation of the flow factor (1).
    pub flow_factor_sd: f32,
    /// Standard deviation of the compliance (m/N).
    pub compliance_sd_m_per_n: f32,
    /// Standard deviation of the clearance (m).
    pub clearance_sd_m: f32,
}

/// How far an estimate may lie from the baseline before an alarm.
#[derive(Clone, Copy, Debug, PartialEq, FromBytes, Immutable, IntoBytes)]
#[repr(C)]
pub struct HealthLimits {
    /// Change of the flow factor either way (1).
    pub flow_factor: f32,
    /// Change of the compliance either way, over that of the baseline (1): 0.43 is a stiffness fallen by 30 %.
    pub compliance: f32,
    /// Change of the clearance either way (m).
    pub clearance_m: f32,
    /// Standard deviations, of estimate and baseline together, by which it must differ too (1).
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

/// A baseline with a number that is not finite, a flow factor or compliance that is not positive, or a negative
/// standard deviation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "a baseline must be finite, its flow factor and compliance positive, its deviations not negative"
)]
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
/// let damper: Damper<f32> = checked.build(1e-3)?; // here in place of a real one
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
    /// Tells a model from memory that was never written.
    pub(crate) mark: u32,
    /// Half the step (s).
    pub(crate) half_step_s: f32,
    /// Largest credible move of the displacement in a step (m).
    pub(crate) largest_move_m: f32,
    /// Forces beyond this are not credible (N).
    pub(crate) largest_force_n: f32,
    /// Number of the piece before the first in the bits of a force.
    pub(crate) first_piece: u32,
    /// Ticks of a block.
    pub(crate) block_ticks: u32,
    /// One over the ticks of a block.
    pub(crate) per_block: f32,
    /// One over the time of a block (1/s).
    pub(crate) per_block_s: f32,
    /// Half of the ticks of a block less one: the place of its centre.
    pub(crate) block_centre: f32,
    /// What turns the sum of forces times their ticks off the centre into a rate of force (1/s).
    pub(crate) rate_scale_per_s: f32,
    /// Force above which both ends are in contact, whatever the noise (N).
    pub(crate) contact_force_n: f32,
    /// Force above which the element may be yielding (N).
    pub(crate) yield_force_n: f32,
    /// Variance of a block's measurement (m^2).
    pub(crate) measured_variance: f32,
    /// Variance of the piston's travel in a block over the square of the mean slope of the law (N^2 s^2).
    pub(crate) force_travel_variance: f32,
    /// The same over the square of the block's travel, for what the law does not tell (1).
    pub(crate) law_variance: f32,
    /// Growth of the parameters' variance in a block (1).
    pub(crate) growth: f32,
    /// Growth of the lag's variance in a block (1).
    pub(crate) lag_growth: f32,
    /// Blocks without contact after which the position is let go: an offset of the force sensor moves it.
    pub(crate) most_unmeasured: u32,
    /// Measured blocks in a row beyond a limit that make an alarm.
    pub(crate) alarm_blocks: u32,
    /// What an estimate begins with: flow factor, compliance, half clearance, lag; zero of the force and added friction
    /// begin at 0.
    pub(crate) start: [f32; 4],
    /// The variances it begins with and never exceeds, those of the force's zero and of friction last.
    pub(crate) start_variance: [f32; 6],
    /// Mean compliance of the oil column (m/N).
    pub(crate) oil_compliance: f32,
    /// Time of a block (s).
    pub(crate) block_s: f32,
    /// Moves that may be noise (m).
    pub(crate) still_m: f32,
    /// Move beyond the clearance for which the force is missing, whenever contact was seen last (m).
    pub(crate) missing_m: f32,
    /// Zero of the force that is an alarm (N).
    pub(crate) zero_limit_n: f32,
    pub(crate) baseline: Baseline,
    pub(crate) limits: HealthLimits,
    /// Extension, compression.
    pub(crate) pieces: [[Piece; PIECES]; 2],
}

impl HealthModel {
    /// Whether this is a model, and not memory that was never written: for programs that get theirs from elsewhere.
    #[inline]
    pub fn is_marked(&self) -> bool {
        self.mark == MARK
    }

    /// Step (s).
    pub fn step_s(&self) -> f32 {
        2.0 * self.half_step_s
    }

    /// What estimates are compared with: of a model just built the nominal damper.
    pub fn baseline(&self) -> Baseline {
        self.baseline
    }

    /// Sets what estimates are compared with from now on.
    ///
    /// # Errors
    /// [`BaselineError`]; the model stays as it is.
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

    /// How far estimates may lie from the baseline.
    pub fn limits(&self) -> HealthLimits {
        self.limits
    }

    /// Sets how far estimates may lie from the baseline; a limit of infinity or NaN never alarms.
    pub fn set_limits(&mut self, limits: HealthLimits) {
        self.limits = limits;
    }

    /// The piece around a force magnitude (N), extension first. Any bits are safe to look up.
    #[inline(always)]
    pub(crate) fn piece(&self, force: f32) -> &Piece {
        let bits = force.to_bits();
        let number =
            ((bits & 0x7fff_ffff) >> PIECE_SHIFT).saturating_sub(self.first_piece) as usize;
        let number = if number < PIECES { number } else { PIECES - 1 };
        &self.pieces[(bits >> 31) as usize][number]
    }
}
