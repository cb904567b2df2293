//! The estimator: a tick takes a sample of displacement and force; samples are gathered to blocks, and the filter's
//! work on a block is spread over the ticks of the next one, so that no tick is much dearer than another.

use super::block::{Block, Gathered};
use super::filter::{
    CLEARANCE, COMPLIANCE, FLOW, FRICTION, Filter, LAG, POSITION, Prepared, STATES, ZERO,
};
use super::follow::Follow;
use super::model::{HealthModel, MARK};
use super::reading::{Estimate, HealthReading, HealthStatus};
use super::watch::Watch;

/// Variance (m^2) of a position of which nothing is known.
const UNKNOWN: f32 = 1.0;
/// Innovations beyond this many times their standard deviation, squared, are left out.
const OUTLIER: f32 = 900.0;
/// How many usual blocks one that is left out makes forget: what has changed is then followed soon.
const OUTLIER_SURPRISE: f32 = 25.0;
/// Blocks left out one after the other before the estimate begins anew.
const MOST_OUTLIERS: u16 = 12;
/// Share of a block's information, in its forgetting, below which nothing is forgotten.
const LEAST_TOLD: f32 = 0.25;
/// Standard deviations of the force's zero, squared, by which a force must be beyond the contact's threshold.
const SURE_CONTACT: f32 = 9.0;

/// What changes from tick to tick of one damper under watch; plain data, saved and restored by copying.
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
    /// Blocks since the last that measured something.
    unmeasured: u32,
    /// How much the next forgetting is of the usual one; 0 where the last block told nothing.
    forgetting: f32,
    outliers: u16,
    status: HealthStatus,
    samples: u32,
    rejected: u32,
}

/// What is left to be done for the last block; a number, so that any bits are an estimate.
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
    /// No estimate: of zero bits, not marked.
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

    /// Before the first sample.
    pub fn new(model: &HealthModel) -> Self {
        let mut health = Self {
            mark: MARK,
            filter: Self::start(model),
            ..Self::EMPTY
        };
        health.watch.begin();
        health.follow.begin();
        // No sample is near it: the first one is taken without a count.
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

    /// Takes the sample of a tick: measured displacement (m), positive in extension, and force (N), positive when it
    /// resists extension. Never fails: a sample that is not finite or not credible is left out and counted.
    #[inline]
    pub fn tick(&mut self, model: &HealthModel, displacement: f32, force: f32) {
        let gathered = &mut self.gathered;
        let credible = (displacement - gathered.displacement).abs() <= model.largest_move_m
            && force.abs() <= model.largest_force_n;
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
                let is_idle = self.unmeasured > model.most_unmeasured;
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

    /// Leaves a sample out; its block measures nothing.
    #[cold]
    #[inline(never)]
    fn reject(&mut self, displacement: f32, model: &HealthModel) {
        let first = self.gathered.displacement.is_nan();
        if self.gathered.leave_out(model, displacement) {
            self.unmeasured = model.most_unmeasured;
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

    /// Moves the position over the block, and makes a measurement of it where both ends were in contact.
    #[inline(always)]
    fn predict(&mut self, model: &HealthModel) {
        let block = &self.block;
        let [_, flow, compliance, .., zero, friction] = self.filter.state;
        let variance = model.force_travel_variance * (block.slope * block.slope)
            + model.law_variance * (block.travel * block.travel);
        let zero_slip = flow * (block.slope * model.block_s);
        let friction_slip = zero_slip.copysign(block.force);
        // The block was corrected by what was known when it began.
        let (zero, friction) = (zero - block.zero, friction - block.friction);
        self.filter
            .travel(block.travel, [zero_slip, friction_slip], variance);
        self.filter.state[POSITION] -= zero_slip * zero + friction_slip * friction;
        self.unmeasured = self.unmeasured.saturating_add(1);
        let yields = block.lowest < -model.yield_force_n || block.highest > model.yield_force_n;
        if yields || self.unmeasured > model.most_unmeasured {
            self.filter.let_go(UNKNOWN);
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
        let is_expected = ratio < OUTLIER; // not so of NaN
        if !is_expected {
            self.stage = stage::LEAVE_OUT;
            return;
        }
        self.stage = stage::UPDATE_FIRST;
        self.outliers = 0;
        self.unmeasured = 0;
        self.samples = self.samples.saturating_add(model.block_ticks);
        let bounded = self.watch.expect(ratio);
        let tells = prepared.told > LEAST_TOLD * (model.growth - 1.0) * prepared.variance;
        let surprise = if bounded > 1.0 { bounded } else { 1.0 };
        self.forgetting = if tells { surprise } else { 0.0 };
    }

    /// Lets the parameters' variances grow, the more the less the last block was expected, up to where they began; also
    /// where the ends have moved for long without contact, for what was known grows old.
    #[inline(always)]
    fn forget(&mut self, model: &HealthModel) {
        self.stage = stage::DONE;
        if self.unmeasured > model.most_unmeasured && self.follow.has_moved(model) {
            self.forgetting = 1.0;
        }
        let growth = 1.0 + (model.growth - 1.0) * self.forgetting;
        // The lag may be wrong too where nothing fits.
        let lag_growth = if self.watch.is_on_its_way() {
            growth
        } else {
            1.0 + (model.lag_growth - 1.0) * self.forgetting
        };
        self.forgetting = 0.0;
        for (place, most) in (1..STATES).zip(model.start_variance) {
            let factor = if place == LAG { lag_growth } else { growth };
            let grown = self.filter.diagonal[place] * factor;
            self.filter.diagonal[place] = if grown < most { grown } else { most };
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
        if damaged || self.outliers > MOST_OUTLIERS {
            self.filter = Self::start(model);
            self.outliers = 0;
            self.watch.begin();
            self.status |= HealthStatus::RESTARTED;
        }
    }

    /// What is known now. Square roots and divisions: not for every tick.
    pub fn reading(&self, model: &HealthModel) -> HealthReading {
        let [_, flow, compliance, half, lag, zero, friction] = self.filter.state;
        let scale = self.watch.scale();
        let sd = |row| libm::sqrtf(self.filter.variance(row) * scale);
        // A compliance within its noise of none is a stiffness without bound.
        let least = 1e-3 * model.start[1];
        let bounded = if compliance > least {
            compliance
        } else {
            least
        };
        let stiffness = 1.0 / bounded;
        // No damper drives its piston: a reversed sign does.
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
