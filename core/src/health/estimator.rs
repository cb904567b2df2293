//! The estimator: a tick takes a sample of displacement and force; samples are gathered to blocks, and the filter's
//! work on a block is spread over the ticks of the next one, so that no tick is much dearer than another.

use super::filter::{Filter, Prepared, STATES};
use super::model::{HealthModel, MARK};
use super::reading::{Estimate, HealthReading, HealthStatus};

/// Variance (m^2) of a position of which nothing is known.
const UNKNOWN: f32 = 1.0;
/// Innovations beyond this many times their standard deviation, squared, are left out.
const OUTLIER: f32 = 900.0;
/// Blocks left out one after the other before the estimate begins anew.
const MOST_OUTLIERS: u16 = 25;
/// Blocks over which the innovations' variance is averaged, inverted.
const SCALE_RATE: f32 = 1.0 / 256.0;
/// Share of a block's information, in its forgetting, below which nothing is forgotten.
const LEAST_TOLD: f32 = 0.25;
/// Part of an alarm's limit within which a parameter must be known, else there is little excitation.
const KNOWN: f32 = 0.5;

/// What changes from tick to tick of one damper under watch; plain data, saved and restored by copying.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Health {
    gathered: Gathered,
    mark: u32,
    stage: u32,
    block: Block,
    prepared: Prepared,
    filter: Filter,
    /// Mean of the squared innovation over its variance.
    scale: f32,
    /// Blocks since the last that measured something.
    unmeasured: u32,
    /// How much the next forgetting is of the usual one; 0 where the last block told nothing.
    forgetting: f32,
    /// Measured blocks in a row with each parameter beyond its limit.
    beyond: [u32; 3],
    outliers: u16,
    status: HealthStatus,
    samples: u32,
    rejected: u32,
}

/// What is left to be done for the last block; a number, so that any bits are an estimate.
mod stage {
    pub(super) const DONE: u32 = 0;
    pub(super) const PREDICT: u32 = 1;
    pub(super) const UPDATE: u32 = 2;
    pub(super) const WATCH: u32 = 3;
    pub(super) const WATCH_MEASURED: u32 = 4;
    pub(super) const LEAVE_OUT: u32 = 5;
}

/// Sums over the samples of a block so far.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
struct Gathered {
    /// Displacement of the last sample (m).
    displacement: f32,
    /// Nominal velocity at the last sample (m/s).
    velocity: f32,
    /// Nominal travel since the block before (m).
    travel: f32,
    travels: f32,
    positions: f32,
    forces: f32,
    /// Forces times their ticks off the centre (N).
    moment: f32,
    slopes: f32,
    lowest: f32,
    highest: f32,
    /// Tick of the next sample off the centre.
    offset: f32,
    ticks_left: u32,
}

/// A block of samples as one measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
struct Block {
    /// Nominal travel of the piston (m).
    travel: f32,
    /// Its part up to the block's centre (m).
    centre: f32,
    /// Mean displacement less that of the oil column (m).
    position: f32,
    /// Mean force (N).
    force: f32,
    /// Mean nominal velocity (m/s).
    velocity: f32,
    /// Mean rate of the force (N/s).
    rate: f32,
    /// Mean slope of the velocity law (m/(s N)).
    slope: f32,
    lowest: f32,
    highest: f32,
}

impl Gathered {
    /// Begins a block; last displacement and velocity stay.
    #[inline(always)]
    fn begin(&mut self, model: &HealthModel) {
        self.travel = 0.0;
        self.travels = 0.0;
        self.positions = 0.0;
        self.forces = 0.0;
        self.moment = 0.0;
        self.slopes = 0.0;
        self.lowest = f32::MAX;
        self.highest = -f32::MAX;
        self.offset = -model.block_centre;
        self.ticks_left = model.block_ticks;
    }
}

impl Health {
    /// No estimate: of zero bits, not marked.
    pub(crate) const EMPTY: Self = Self {
        gathered: Gathered {
            displacement: 0.0,
            velocity: 0.0,
            travel: 0.0,
            travels: 0.0,
            positions: 0.0,
            forces: 0.0,
            moment: 0.0,
            slopes: 0.0,
            lowest: 0.0,
            highest: 0.0,
            offset: 0.0,
            ticks_left: 0,
        },
        mark: 0,
        stage: stage::DONE,
        block: Block {
            travel: 0.0,
            centre: 0.0,
            position: 0.0,
            force: 0.0,
            velocity: 0.0,
            rate: 0.0,
            slope: 0.0,
            lowest: 0.0,
            highest: 0.0,
        },
        prepared: Prepared::NONE,
        filter: Filter::new([0.0; STATES], [0.0; STATES]),
        scale: 0.0,
        unmeasured: 0,
        forgetting: 0.0,
        beyond: [0; 3],
        outliers: 0,
        status: HealthStatus::empty(),
        samples: 0,
        rejected: 0,
    };

    /// Before the first sample.
    pub fn new(model: &HealthModel) -> Self {
        let mut health = Self {
            mark: MARK,
            filter: Self::start(model),
            scale: 1.0,
            ..Self::EMPTY
        };
        // No sample is near it: the first one is taken without a count.
        health.gathered.displacement = f32::NAN;
        health.gathered.begin(model);
        health
    }

    fn start(model: &HealthModel) -> Filter {
        let [flow, compliance, half, lag] = model.start;
        let [d1, d2, d3, d4] = model.start_variance;
        Filter::new(
            [0.0, flow, compliance, half, lag],
            [UNKNOWN, d1, d2, d3, d4],
        )
    }

    /// Takes the sample of a tick: measured displacement (m), positive in extension, and force (N), positive when it
    /// resists extension. Never fails: a sample that is not finite or not credible is left out and counted.
    #[inline]
    pub fn tick(&mut self, model: &HealthModel, displacement: f32, force: f32) {
        let gathered = &mut self.gathered;
        let credible = (displacement - gathered.displacement).abs() <= model.largest_move_m
            && force.abs() <= model.largest_force_n;
        if credible {
            let piece = model.piece(force);
            let magnitude = force.abs();
            let velocity = (piece.velocity + piece.velocity_slope * magnitude).copysign(force);
            let oil = (piece.oil + piece.oil_slope * magnitude).copysign(force);
            gathered.displacement = displacement;
            gathered.travel += model.half_step_s * (velocity + gathered.velocity);
            gathered.velocity = velocity;
            gathered.travels += gathered.travel;
            gathered.positions += displacement - oil;
            gathered.forces += force;
            gathered.moment += gathered.offset * force;
            gathered.slopes += piece.velocity_slope;
            gathered.lowest = if force < gathered.lowest {
                force
            } else {
                gathered.lowest
            };
            gathered.highest = if force > gathered.highest {
                force
            } else {
                gathered.highest
            };
            gathered.offset += 1.0;
        } else {
            self.reject(displacement, model);
        }
        self.gathered.ticks_left = self.gathered.ticks_left.wrapping_sub(1);
        if self.gathered.ticks_left == 0 {
            self.end_block(model);
            return;
        }
        match self.stage {
            stage::PREDICT => self.predict(model),
            stage::UPDATE => {
                self.filter.update(&self.prepared);
                self.stage = stage::WATCH_MEASURED;
            }
            stage::LEAVE_OUT => self.leave_out(model),
            stage::WATCH | stage::WATCH_MEASURED => self.watch(model),
            _ => {}
        }
    }

    /// Leaves a sample out; its block measures nothing.
    #[cold]
    #[inline(never)]
    fn reject(&mut self, displacement: f32, model: &HealthModel) {
        let gathered = &mut self.gathered;
        let first = gathered.displacement.is_nan();
        // Of a block without any sample it is not known how far the piston went.
        if gathered.ticks_left == 1 && gathered.offset <= -model.block_centre {
            gathered.velocity = 0.0;
            self.unmeasured = model.most_unmeasured;
        }
        gathered.travel += 2.0 * model.half_step_s * gathered.velocity;
        gathered.lowest = -f32::MAX;
        gathered.highest = f32::MAX;
        if displacement.is_finite() && displacement.abs() <= 1e3 {
            gathered.displacement = displacement;
        }
        if !first {
            self.status |= HealthStatus::INPUT_REJECTED;
            self.rejected = self.rejected.saturating_add(1);
        }
    }

    #[inline(always)]
    fn end_block(&mut self, model: &HealthModel) {
        let gathered = &self.gathered;
        self.block = Block {
            travel: gathered.travel,
            centre: gathered.travels * model.per_block,
            position: gathered.positions * model.per_block,
            force: gathered.forces * model.per_block,
            velocity: gathered.travel * model.per_block_s,
            rate: gathered.moment * model.rate_scale_per_s,
            slope: gathered.slopes * model.per_block,
            lowest: gathered.lowest,
            highest: gathered.highest,
        };
        self.stage = stage::PREDICT;
        self.gathered.begin(model);
    }

    /// Moves the position over the block and prepares its measurement, where it is one.
    #[inline(always)]
    fn predict(&mut self, model: &HealthModel) {
        let block = &self.block;
        let variance = model.force_travel_variance * (block.slope * block.slope)
            + model.law_variance * (block.travel * block.travel);
        self.filter.travel(block.travel, variance);
        self.stage = stage::WATCH;
        self.unmeasured = self.unmeasured.saturating_add(1);
        let yields = block.lowest < -model.yield_force_n || block.highest > model.yield_force_n;
        if yields || self.unmeasured > model.most_unmeasured {
            self.filter.let_go(UNKNOWN);
        }
        if yields {
            return;
        }
        let sign = if block.lowest > model.contact_force_n {
            1.0
        } else if block.highest < -model.contact_force_n {
            -1.0
        } else {
            return;
        };
        let [_, flow, compliance, _, _] = self.filter.state;
        let velocity = flow * block.velocity + compliance * block.rate;
        let h = [block.centre - block.travel, block.force, sign, velocity];
        let prepared = self
            .filter
            .prepare(block.position, h, model.measured_variance);
        let ratio = prepared.innovation * prepared.innovation / prepared.variance;
        self.prepared = prepared;
        let is_expected = ratio < OUTLIER; // not so of NaN
        if !is_expected {
            self.stage = stage::LEAVE_OUT;
            return;
        }
        self.stage = stage::UPDATE;
        self.outliers = 0;
        self.unmeasured = 0;
        self.samples = self.samples.saturating_add(model.block_ticks);
        let bounded = if ratio < 9.0 { ratio } else { 9.0 };
        self.scale += (bounded - self.scale) * SCALE_RATE;
        let tells = prepared.told > LEAST_TOLD * (model.growth - 1.0) * prepared.variance;
        let surprise = if bounded > 1.0 { bounded } else { 1.0 };
        self.forgetting = if tells { surprise } else { 0.0 };
    }

    /// Lets the parameters' variances grow, the more the less the last block was expected, up to where they began.
    #[inline(always)]
    fn forget(&mut self, model: &HealthModel) {
        let growth = 1.0 + (model.growth - 1.0) * self.forgetting;
        let lag_growth = 1.0 + (model.lag_growth - 1.0) * self.forgetting;
        self.forgetting = 0.0;
        for (place, most) in (1..STATES).zip(model.start_variance) {
            let factor = if place + 1 < STATES {
                growth
            } else {
                lag_growth
            };
            let grown = self.filter.diagonal[place] * factor;
            self.filter.diagonal[place] = if grown < most { grown } else { most };
        }
    }

    #[cold]
    #[inline(never)]
    fn leave_out(&mut self, model: &HealthModel) {
        self.stage = stage::WATCH;
        self.outliers = self.outliers.saturating_add(1);
        let damaged = !self.filter.state.iter().all(|number| number.is_finite())
            || !self.prepared.variance.is_finite();
        if damaged || self.outliers > MOST_OUTLIERS {
            self.filter = Self::start(model);
            self.outliers = 0;
            self.scale = 1.0;
            self.status |= HealthStatus::RESTARTED;
        }
    }

    /// Compares the estimate with the baseline.
    #[inline(always)]
    fn watch(&mut self, model: &HealthModel) {
        let measured = u32::from(self.stage == stage::WATCH_MEASURED);
        self.stage = stage::DONE;
        let (baseline, limits) = (&model.baseline, &model.limits);
        let [_, flow, compliance, half, _] = self.filter.state;
        let scale = self.scale();
        let deviations = limits.deviations * limits.deviations;
        let (mut little, mut alarms) = (false, HealthStatus::empty());
        let [flow_blocks, stiffness_blocks, clearance_blocks] = &mut self.beyond;
        let mut compare = |bit: HealthStatus,
                           blocks: &mut u32,
                           change: f32,
                           limit: f32,
                           variance: f32,
                           sd: f32| {
            let square = limit * limit;
            little |= variance > (KNOWN * KNOWN) * square;
            let differs = change * change > deviations * (variance + sd * sd);
            *blocks = if change * change > square && differs {
                *blocks + measured
            } else {
                0
            };
            if *blocks > model.alarm_blocks {
                *blocks = model.alarm_blocks;
                alarms |= bit;
            }
        };
        compare(
            HealthStatus::FLOW,
            flow_blocks,
            flow - baseline.flow_factor,
            limits.flow_factor,
            scale * self.filter.variance(1),
            baseline.flow_factor_sd,
        );
        compare(
            HealthStatus::STIFFNESS,
            stiffness_blocks,
            compliance - baseline.compliance_m_per_n,
            limits.compliance * baseline.compliance_m_per_n,
            scale * self.filter.variance(2),
            baseline.compliance_sd_m_per_n,
        );
        compare(
            HealthStatus::CLEARANCE,
            clearance_blocks,
            (half + half) - baseline.clearance_m,
            limits.clearance_m,
            4.0 * scale * self.filter.variance(3),
            baseline.clearance_sd_m,
        );
        self.status |= alarms;
        self.status.set(HealthStatus::LITTLE_EXCITATION, little);
        self.forget(model);
    }

    /// By what variances are multiplied: more than 1 where the samples scatter more than the model says.
    #[inline(always)]
    fn scale(&self) -> f32 {
        if self.scale > 1.0 { self.scale } else { 1.0 }
    }

    /// What is known now. Square roots and divisions: not for every tick.
    pub fn reading(&self, model: &HealthModel) -> HealthReading {
        let [_, flow, compliance, half, lag] = self.filter.state;
        let sd = |row| libm::sqrtf(self.filter.variance(row) * self.scale());
        // A compliance within its noise of none is a stiffness without bound.
        let least = 1e-3 * model.start[1];
        let bounded = if compliance > least {
            compliance
        } else {
            least
        };
        let stiffness = 1.0 / bounded;
        let estimate = |value, sd| Estimate { value, sd };
        HealthReading {
            flow_factor: estimate(flow, sd(1)),
            stiffness_n_per_m: estimate(stiffness, sd(2) * stiffness * stiffness),
            clearance_m: estimate(2.0 * half, 2.0 * sd(3)),
            lag_s: estimate(lag, sd(4)),
            compliance_m_per_n: estimate(compliance, sd(2)),
            samples: self.samples,
            rejected: self.rejected,
            status: self.status,
        }
    }

    /// Whether this is an estimate, and not memory that was never written.
    #[inline]
    pub fn is_marked(&self) -> bool {
        self.mark == MARK
    }

    /// Status bits.
    pub fn status(&self) -> HealthStatus {
        self.status
    }

    /// Clears the status bits and the count of rejected samples; alarms whose cause stays come back.
    pub fn clear_status(&mut self) {
        self.status = HealthStatus::empty();
        self.rejected = 0;
    }
}
