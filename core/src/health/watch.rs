//! What an estimate means: whether the model fits the samples, which parameter has changed, what cannot be trusted.

use super::filter::{CLEARANCE, COMPLIANCE, FLOW, Filter, LAG, Prepared, ZERO};
use super::model::HealthModel;
use super::reading::HealthStatus;

/// Blocks over which innovations are averaged, inverted.
const RATE: f32 = 1.0 / 128.0;
/// Largest square of an innovation over its variance in the averages.
const MOST: f32 = 9.0;
/// Largest product of neighbouring innovations over their variance in the averages.
const MOST_PRODUCT: f32 = 3.0;
/// Mean product of neighbouring innovations over their variance above which the model does not fit.
const MISFIT: f32 = 0.5;
/// The same below which it fits again.
const FITS_AGAIN: f32 = 0.2;
/// The same above which changes are no alarm yet: the estimate is on its way.
const ON_ITS_WAY: f32 = 1.0;
/// The same that is chance.
const CHANCE: f32 = 0.1;
/// By how much the rest makes variances greater: errors that repeat do not average out.
const REPEATED: f32 = 6.0;
/// Part of an alarm's limit within which a parameter must be known, else there is little excitation.
const KNOWN: f32 = 0.5;
/// Part of an alarm's limit by which a parameter has changed at all.
const CHANGED: f32 = 1.0 / 6.0;
/// Standard deviations, squared, by which it has changed then.
const SURELY: f32 = 9.0;
/// Standard deviations, squared, by which a lag differs from what is known of it beforehand.
const LATE: f32 = 2.25;

/// Averages over the innovations, and how long each parameter has been beyond its limit.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub(crate) struct Watch {
    /// Mean of the squared innovation over its variance.
    scatter: f32,
    /// Mean of the product of neighbouring innovations over their variance: 0 where the model fits.
    correlation: f32,
    last: f32,
    /// Measured blocks in a row with flow, compliance, clearance and the force's zero beyond its limit.
    beyond: [u32; 4],
    /// Status bits found in this block so far.
    found: u32,
    /// Parameters that have changed, of those compared in this block so far.
    changed: u32,
}

fn square(number: f32) -> f32 {
    number * number
}

/// A parameter against what it is compared with.
struct Change {
    change: f32,
    limit: f32,
    variance: f32,
}

impl Watch {
    /// Of zero bits.
    pub(crate) const EMPTY: Self = Self {
        scatter: 0.0,
        correlation: 0.0,
        last: 0.0,
        beyond: [0; 4],
        found: 0,
        changed: 0,
    };

    /// Begins the averages as where the model fits.
    pub(crate) fn begin(&mut self) {
        self.scatter = 1.0;
        self.correlation = 0.0;
        self.last = 0.0;
    }

    /// Takes in the square of a measured block's innovation over its variance. Returns it, bounded.
    #[inline(always)]
    pub(crate) fn expect(&mut self, ratio: f32) -> f32 {
        let bounded = if ratio < MOST { ratio } else { MOST };
        self.scatter += (bounded - self.scatter) * RATE;
        bounded
    }

    /// Takes in the product of a measured block's innovation and the one before.
    #[inline(always)]
    pub(crate) fn correlate(&mut self, prepared: &Prepared) {
        let product = self.last * prepared.innovation / prepared.variance;
        let product = if product < MOST_PRODUCT {
            product
        } else {
            MOST_PRODUCT
        };
        let product = if product > -MOST_PRODUCT {
            product
        } else {
            -MOST_PRODUCT
        };
        self.correlation += (product - self.correlation) * RATE;
        self.last = prepared.innovation;
    }

    /// Whether the model fits so badly that the estimate is on its way after a change, or none is right.
    #[inline(always)]
    pub(crate) fn is_on_its_way(&self) -> bool {
        self.correlation >= ON_ITS_WAY
    }

    /// Variance inflation factor: above 1 where innovations scatter more than the model says, or repeat.
    #[inline(always)]
    pub(crate) fn scale(&self) -> f32 {
        let repeated = self.correlation - CHANCE;
        let repeated = if repeated > 0.0 { repeated } else { 0.0 };
        let scale = self.scatter + REPEATED * repeated;
        if scale > 1.0 { scale } else { 1.0 }
    }

    /// Compares flow and stiffness with the baseline.
    #[inline(always)]
    pub(crate) fn compare_first(&mut self, model: &HealthModel, filter: &Filter, measured: bool) {
        self.found = 0;
        self.changed = 0;
        let (baseline, limits) = (&model.baseline, &model.limits);
        let scale = self.scale();
        let flow = Change {
            change: filter.state[FLOW] - baseline.flow_factor,
            limit: limits.flow_factor,
            variance: scale * filter.variance(FLOW) + square(baseline.flow_factor_sd),
        };
        let compliance = Change {
            change: filter.state[COMPLIANCE] - baseline.compliance_m_per_n,
            limit: limits.compliance * baseline.compliance_m_per_n,
            variance: scale * filter.variance(COMPLIANCE) + square(baseline.compliance_sd_m_per_n),
        };
        self.compare(model, 0, &flow, measured, HealthStatus::FLOW);
        self.compare(model, 1, &compliance, measured, HealthStatus::STIFFNESS);
    }

    /// Compares the clearance with the baseline, the force's zero and the lag with what they should be; returns the
    /// status with everything found.
    #[inline(always)]
    pub(crate) fn compare_second(
        &mut self,
        model: &HealthModel,
        filter: &Filter,
        measured: bool,
        is_missing: bool,
        status: HealthStatus,
    ) -> HealthStatus {
        let (baseline, limits) = (&model.baseline, &model.limits);
        let scale = self.scale();
        let half = filter.state[CLEARANCE];
        let clearance = Change {
            change: (half + half) - baseline.clearance_m,
            limit: limits.clearance_m,
            variance: 4.0 * scale * filter.variance(CLEARANCE) + square(baseline.clearance_sd_m),
        };
        self.compare(model, 2, &clearance, measured, HealthStatus::CLEARANCE);
        let several = self.changed > 1;
        let now = self.found;
        let zero = Change {
            change: filter.state[ZERO],
            limit: model.zero_limit_n,
            variance: scale * filter.variance(ZERO),
        };
        self.compare(model, 3, &zero, measured, HealthStatus::FORCE_ZERO);
        let late = square(filter.state[LAG] - model.start[LAG - 1]);
        let is_late = late > LATE * model.start_variance[LAG - 1];
        let little = HealthStatus::LITTLE_EXCITATION;
        let mut status = status | (HealthStatus::from_bits_retain(self.found as u16) - little);
        status.set(little, now & u32::from(little.bits()) != 0);
        status.set(HealthStatus::SEVERAL_CHANGED, several);
        status.set(HealthStatus::LATE, is_late);
        let limit = if status.contains(HealthStatus::MISFIT) {
            FITS_AGAIN
        } else {
            MISFIT
        };
        status.set(HealthStatus::MISFIT, self.correlation > limit);
        if is_missing {
            status |= HealthStatus::NO_FORCE;
        }
        status
    }

    #[inline(always)]
    fn compare(
        &mut self,
        model: &HealthModel,
        place: usize,
        Change {
            change,
            limit,
            variance,
        }: &Change,
        measured: bool,
        alarm: HealthStatus,
    ) {
        let (change, limit, variance) = (square(*change), square(*limit), *variance);
        let counted = u32::from(measured && !self.is_on_its_way());
        let is_beyond = change > limit && change > square(model.limits.deviations) * variance;
        let blocks = if is_beyond {
            self.beyond[place] + counted
        } else {
            0
        };
        let certain = blocks > model.alarm_blocks;
        self.beyond[place] = if certain { model.alarm_blocks } else { blocks };
        if certain {
            self.found |= u32::from(alarm.bits());
        }
        if variance > square(KNOWN) * limit {
            self.found |= u32::from(HealthStatus::LITTLE_EXCITATION.bits());
        }
        let has_changed = change > square(CHANGED) * limit && change > SURELY * variance;
        self.changed += u32::from(has_changed);
    }
}
