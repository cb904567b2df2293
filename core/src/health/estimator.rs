//! The estimator. Each tick takes a sample of displacement and force, and a block of samples forms one measurement. The
//! filter's work on a block is spread over the ticks of the next block, so that all ticks cost about the same.

use super::block::{Block, Gathered};
use super::filter::{
    CLEARANCE, COMPLIANCE, FLOW, FRICTION, Filter, LAG, POSITION, Prepared, STATES, ZERO,
};
use super::follow::Follow;
use super::model::{HealthModel, MARK};
use super::reading::{Estimate, HealthReading, HealthStatus};
use super::watch::Watch;

/// Variance of an unknown position (m^2).
const UNKNOWN: f32 = 1.0;
/// Ratio of the squared innovation to its variance, above which a measurement is an outlier (1).
const OUTLIER: f32 = 900.0;
/// Forgetting after an outlier, as a multiple of the forgetting after a usual block (1). It lets the estimate follow a
/// change quickly.
const OUTLIER_SURPRISE: f32 = 25.0;
/// Largest number of consecutive outliers. One more restarts the estimate.
const MAX_OUTLIERS: u16 = 12;
/// The filter forgets only after an informative block: the share of its expected variance that is due to the parameters
/// exceeds this multiple of the usual growth of their variances (1).
const MIN_INFORMATION_SHARE: f32 = 0.25;
/// Contact is certain if the squared excess of the force over the contact threshold is at least this multiple of the
/// variance of the force offset (1).
const SURE_CONTACT: f32 = 9.0;

/// Health estimate of one damper, which changes at each tick. It is plain data: copy it to save or restore it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Health {
    gathered: Gathered,
    mark: u32,
    stage: u32,
    block: Block,
    prepared: Prepared,
    follow: Follow,
    filter: Filter,
    watch: Watch,
    /// Number of blocks since the last measurement.
    unmeasured: u32,
    /// Next forgetting as a multiple of the usual forgetting (1); 0 if the last block contained no information.
    forgetting: f32,
    outliers: u16,
    status: HealthStatus,
    samples: u32,
    rejected: u32,
}

/// Next stage of the work on the last block. It is a plain number instead of an enum, so that every bit pattern is
/// valid.
mod stage {
    pub(super) const DONE: u32 = 0;
    pub(super) const PREDICT: u32 = 1;
    pub(super) const PREPARE: u32 = 2;
    pub(super) const UPDATE_FIRST: u32 = 3;
    pub(super) const UPDATE_SECOND: u32 = 4;
    pub(super) const LEAVE_OUT: u32 = 5;
    pub(super) const FOLLOW: u32 = 6;
    pub(super) const COMPARE_FIRST: u32 = 7;
    pub(super) const COMPARE_SECOND: u32 = 8;
    pub(super) const FORGET: u32 = 9;
}

impl Health {
    /// Placeholder before an estimate starts: all bits are zero.
    pub(crate) const EMPTY: Self = Self {
        gathered: Gathered::EMPTY,
        mark: 0,
        stage: stage::DONE,
        block: Block::NONE,
        prepared: Prepared::NONE,
        follow: Follow::EMPTY,
        filter: Filter::new([0.0; STATES], [0.0; STATES]),
        watch: Watch::EMPTY,
        unmeasured: 0,
        forgetting: 0.0,
        outliers: 0,
        status: HealthStatus::empty(),
        samples: 0,
        rejected: 0,
    };

    /// An estimate before the first sample.
    pub fn new(model: &HealthModel) -> Self {
        let mut health = Self {
            mark: MARK,
            filter: Self::start(model),
            ..Self::EMPTY
        };
        health.watch.begin();
        health.follow.begin();
        // NaN marks that there is no sample yet: the first sample is then never credible, but is not counted as
        // rejected.
        health.gathered.displacement = f32::NAN;
        health.gathered.begin(model);
        health
    }

    fn start(model: &HealthModel) -> Filter {
        let [flow, compliance, half, lag] = model.start;
        let [d1, d2, d3, d4, d5, d6] = model.start_variance;
        Filter::new(
            [0.0, flow, compliance, half, lag, 0.0, 0.0],
            [UNKNOWN, d1, d2, d3, d4, d5, d6],
        )
    }

    /// Takes the sample of a tick: displacement (m), positive in extension, and force (N), positive when it resists
    /// extension.
    ///
    /// Never fails: a sample that is not finite or not credible is left out and counted.
    #[inline]
    pub fn tick(&mut self, model: &HealthModel, displacement: f32, force: f32) {
        let gathered = &mut self.gathered;
        let credible = (displacement - gathered.displacement).abs() <= model.max_move_m
            && force.abs() <= model.max_force_n;
        if credible {
            gathered.add(model, displacement, force);
        } else {
            self.reject(displacement, model);
        }
        self.gathered.ticks_left = self.gathered.ticks_left.wrapping_sub(1);
        match self.stage {
            stage::PREDICT => self.predict(model),
            stage::PREPARE => self.prepare(model),
            stage::UPDATE_FIRST => {
                self.filter.update_first(&mut self.prepared);
                self.watch.correlate(&self.prepared);
                self.stage = stage::UPDATE_SECOND;
            }
            stage::UPDATE_SECOND => {
                self.filter.update_second(&mut self.prepared);
                self.stage = stage::FOLLOW;
            }
            stage::LEAVE_OUT => self.leave_out(model),
            stage::FOLLOW => {
                let [_, flow, _, half, ..] = self.filter.state;
                let is_idle = self.unmeasured > model.max_unmeasured;
                self.follow.take(model, &self.block, [flow, half], is_idle);
                self.stage = stage::COMPARE_FIRST;
            }
            stage::COMPARE_FIRST => {
                let measured = self.unmeasured == 0;
                self.watch.compare_first(model, &self.filter, measured);
                self.stage = stage::COMPARE_SECOND;
            }
            stage::COMPARE_SECOND => {
                let (measured, is_missing) = (self.unmeasured == 0, self.follow.is_missing());
                let watch = &mut self.watch;
                self.status =
                    watch.compare_second(model, &self.filter, measured, is_missing, self.status);
                self.stage = stage::FORGET;
            }
            stage::FORGET => self.forget(model),
            _ => {}
        }
        if self.gathered.ticks_left == 0 {
            self.end_block(model);
        }
    }

    /// Leaves out a sample; the block of this sample gives no measurement.
    #[cold]
    #[inline(never)]
    fn reject(&mut self, displacement: f32, model: &HealthModel) {
        let first = self.gathered.displacement.is_nan();
        if self.gathered.leave_out(model, displacement) {
            self.unmeasured = model.max_unmeasured;
        }
        if !first {
            self.status |= HealthStatus::INPUT_REJECTED;
            self.rejected = self.rejected.saturating_add(1);
        }
    }

    #[inline(always)]
    fn end_block(&mut self, model: &HealthModel) {
        self.block = self.gathered.block(model);
        self.stage = stage::PREDICT;
        self.gathered
            .correct(self.filter.state[ZERO], self.filter.state[FRICTION]);
        self.gathered.begin(model);
    }

    /// Advances the position by the travel of the block. Computes the measurement if both ends were in contact.
    #[inline(always)]
    fn predict(&mut self, model: &HealthModel) {
        let block = &self.block;
        let [_, flow, compliance, .., zero, friction] = self.filter.state;
        let variance = model.force_travel_variance * (block.slope * block.slope)
            + model.law_variance * (block.travel * block.travel);
        let zero_slip = flow * (block.slope * model.block_s);
        let friction_slip = zero_slip.copysign(block.force);
        // The block was already corrected with the estimates at its start, so only their changes since then count.
        let (zero, friction) = (zero - block.zero, friction - block.friction);
        self.filter
            .travel(block.travel, [zero_slip, friction_slip], variance);
        self.filter.state[POSITION] -= zero_slip * zero + friction_slip * friction;
        self.unmeasured = self.unmeasured.saturating_add(1);
        let yields = block.lowest < -model.yield_force_n || block.highest > model.yield_force_n;
        if yields || self.unmeasured > model.max_unmeasured {
            self.filter.forget_position(UNKNOWN);
        }
        self.stage = stage::FOLLOW;
        let (sign, beyond) = if block.lowest > model.contact_force_n {
            (1.0, block.lowest - model.contact_force_n)
        } else if block.highest < -model.contact_force_n {
            (-1.0, block.highest + model.contact_force_n)
        } else {
            return;
        };
        if yields || beyond * beyond < SURE_CONTACT * self.filter.variance(ZERO) {
            return;
        }
        let zero_part = 0.5 * zero_slip - (compliance + model.oil_compliance);
        let friction_part = 0.5 * friction_slip;
        self.prepared.measured = block.position - zero_part * zero - friction_part * friction;
        self.prepared.parts = [
            block.centre - block.travel,
            block.force,
            sign,
            flow * block.velocity + compliance * block.rate,
            zero_part,
            friction_part,
        ];
        self.stage = stage::PREPARE;
    }

    /// Prepares the measurement for the filter.
    #[inline(always)]
    fn prepare(&mut self, model: &HealthModel) {
        self.filter
            .prepare(&mut self.prepared, model.measured_variance);
        let prepared = &self.prepared;
        let ratio = prepared.innovation * prepared.innovation / prepared.variance;
        let is_expected = ratio < OUTLIER; // false for NaN
        if !is_expected {
            self.stage = stage::LEAVE_OUT;
            return;
        }
        self.stage = stage::UPDATE_FIRST;
        self.outliers = 0;
        self.unmeasured = 0;
        self.samples = self.samples.saturating_add(model.block_ticks);
        let bounded = self.watch.average_square(ratio);
        let is_informative =
            prepared.information > MIN_INFORMATION_SHARE * (model.growth - 1.0) * prepared.variance;
        let surprise = if bounded > 1.0 { bounded } else { 1.0 };
        self.forgetting = if is_informative { surprise } else { 0.0 };
    }

    /// Increases the variances of the parameters, at most to their initial values. They increase more after an
    /// unexpected block. They also increase during a long motion without contact, because the estimates become
    /// outdated.
    #[inline(always)]
    fn forget(&mut self, model: &HealthModel) {
        self.stage = stage::DONE;
        if self.unmeasured > model.max_unmeasured && self.follow.has_moved(model) {
            self.forgetting = 1.0;
        }
        let growth = 1.0 + (model.growth - 1.0) * self.forgetting;
        // The lag can be wrong too if the model does not fit.
        let lag_growth = if self.watch.is_converging() {
            growth
        } else {
            1.0 + (model.lag_growth - 1.0) * self.forgetting
        };
        self.forgetting = 0.0;
        for (row, max) in (1..STATES).zip(model.start_variance) {
            let factor = if row == LAG { lag_growth } else { growth };
            let grown = self.filter.diagonal[row] * factor;
            self.filter.diagonal[row] = if grown < max { grown } else { max };
        }
    }

    #[cold]
    #[inline(never)]
    fn leave_out(&mut self, model: &HealthModel) {
        self.stage = stage::FOLLOW;
        self.outliers = self.outliers.saturating_add(1);
        self.forgetting = OUTLIER_SURPRISE;
        let damaged = !self.filter.state.iter().all(|number| number.is_finite())
            || !self.prepared.variance.is_finite();
        if damaged || self.outliers > MAX_OUTLIERS {
            self.filter = Self::start(model);
            self.outliers = 0;
            self.watch.begin();
            self.status |= HealthStatus::RESTARTED;
        }
    }

    /// Returns the present reading. This takes square roots and divisions, so do not call it in every tick.
    pub fn reading(&self, model: &HealthModel) -> HealthReading {
        let [_, flow, compliance, half, lag, zero, friction] = self.filter.state;
        let scale = self.watch.scale();
        let sd = |row| libm::sqrtf(self.filter.variance(row) * scale);
        // A compliance near zero would give an unbounded stiffness.
        let min = 1e-3 * model.start[1];
        let bounded = if compliance > min { compliance } else { min };
        let stiffness = 1.0 / bounded;
        // A damper never drives its piston, so a negative flow factor means that the sign of a sensor is reversed.
        let mut status = self.status;
        if flow <= 0.0 {
            status |= HealthStatus::MISFIT;
        }
        let estimate = |value, sd| Estimate { value, sd };
        HealthReading {
            flow_factor: estimate(flow, sd(FLOW)),
            stiffness_n_per_m: estimate(stiffness, sd(COMPLIANCE) * stiffness * stiffness),
            clearance_m: estimate(2.0 * half, 2.0 * sd(CLEARANCE)),
            lag_s: estimate(lag, sd(LAG)),
            compliance_m_per_n: estimate(compliance, sd(COMPLIANCE)),
            samples: self.samples,
            rejected: self.rejected,
            status,
            force_zero_n: estimate(zero, sd(ZERO)),
            added_friction_n: estimate(friction, sd(FRICTION)),
        }
    }

    /// True for an estimate, false for uninitialised memory.
    #[inline]
    pub fn is_marked(&self) -> bool {
        self.mark == MARK
    }

    /// Status bits.
    pub fn status(&self) -> HealthStatus {
        self.status
    }

    /// Clears the status bits and the count of rejected samples. Alarms return if their cause remains.
    pub fn clear_status(&mut self) {
        self.status = HealthStatus::empty();
        self.rejected = 0;
    }
}

#[cfg(test)]
mod tests;
