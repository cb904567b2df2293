//! Interprets an estimate: quality of the fit, changed parameters and doubtful results.

use super::filter::{CLEARANCE, COMPLIANCE, FLOW, Filter, LAG, Prepared, ZERO};
use super::model::HealthModel;
use super::reading::HealthStatus;

/// Inverse of the number of blocks over which innovations are averaged (1).
const RATE: f32 = 1.0 / 128.0;
/// Upper bound on the ratio of the squared innovation to its variance, applied before averaging (1).
const MAX_SQUARE: f32 = 9.0;
/// Bound on the product of successive innovations divided by their variance, applied before averaging (1).
const MAX_PRODUCT: f32 = 3.0;
/// Correlation of successive innovations above which the model does not fit (1).
const MISFIT: f32 = 0.5;
/// Correlation below which the model fits again (1).
const FITS_AGAIN: f32 = 0.2;
/// Correlation above which the estimate is still converging, so that changes cause no alarm (1).
const CONVERGING: f32 = 1.0;
/// Correlation that occurs by chance (1).
const CHANCE: f32 = 0.1;
/// Increase of the variance inflation per unit of correlation above chance (1), because correlated errors do not
/// average out.
const REPEATED: f32 = 6.0;
/// Largest ratio of a standard deviation to its alarm limit (1). Above it, there is too little excitation.
const KNOWN: f32 = 0.5;
/// Smallest ratio of a change to its alarm limit at which a parameter counts as changed (1).
const CHANGED: f32 = 1.0 / 6.0;
/// Smallest ratio of a squared change to its variance at which a parameter counts as changed (1).
const SURELY: f32 = 9.0;
/// Squared difference of the lag from its prior, divided by the prior variance, above which the lag is too large (1).
const LATE: f32 = 2.25;

/// Averages of the innovations, and the time each parameter has been beyond its limit.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub(crate) struct Watch {
    /// Mean of the squared innovation divided by its variance.
    scatter: f32,
    /// Mean of the product of successive innovations divided by their variance: 0 if the model fits.
    correlation: f32,
    last: f32,
    /// For each of flow, compliance, clearance and force offset, the number of consecutive measured blocks beyond its
    /// limit.
    beyond: [u32; 4],
    /// Status bits found so far in this block.
    found: u32,
    /// Number of changed parameters among those compared so far in this block.
    changed: u32,
}

fn square(number: f32) -> f32 {
    number * number
}

/// Change of a parameter from its reference value, with limit and variance.
struct Change {
    change: f32,
    limit: f32,
    variance: f32,
}

impl Watch {
    /// Placeholder: all bits are zero.
    pub(crate) const EMPTY: Self = Self {
        scatter: 0.0,
        correlation: 0.0,
        last: 0.0,
        beyond: [0; 4],
        found: 0,
        changed: 0,
    };

    /// Resets the averages to those of a model that fits.
    pub(crate) fn begin(&mut self) {
        self.scatter = 1.0;
        self.correlation = 0.0;
        self.last = 0.0;
    }

    /// Adds the squared innovation of a measured block, divided by its variance, to the average. Returns this ratio,
    /// limited to its bound.
    #[inline(always)]
    pub(crate) fn average_square(&mut self, ratio: f32) -> f32 {
        let bounded = if ratio < MAX_SQUARE {
            ratio
        } else {
            MAX_SQUARE
        };
        self.scatter += (bounded - self.scatter) * RATE;
        bounded
    }

    /// Adds the product of the innovations of a measured block and the previous one to the average.
    #[inline(always)]
    pub(crate) fn correlate(&mut self, prepared: &Prepared) {
        let product = self.last * prepared.innovation / prepared.variance;
        let product = if product < MAX_PRODUCT {
            product
        } else {
            MAX_PRODUCT
        };
        let product = if product > -MAX_PRODUCT {
            product
        } else {
            -MAX_PRODUCT
        };
        self.correlation += (product - self.correlation) * RATE;
        self.last = prepared.innovation;
    }

    /// True if the model fits badly: the estimate is still converging after a change, or no parameters fit.
    #[inline(always)]
    pub(crate) fn is_converging(&self) -> bool {
        self.correlation >= CONVERGING
    }

    /// Variance inflation factor: above 1 if innovations have a larger variance than expected or are correlated.
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

    /// Compares clearance, force offset and lag with their reference values. Returns the status with all findings.
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
        index: usize,
        Change {
            change,
            limit,
            variance,
        }: &Change,
        measured: bool,
        alarm: HealthStatus,
    ) {
        let (change, limit, variance) = (square(*change), square(*limit), *variance);
        let counted = u32::from(measured && !self.is_converging());
        let is_beyond = change > limit && change > square(model.limits.deviations) * variance;
        let blocks = if is_beyond {
            self.beyond[index] + counted
        } else {
            0
        };
        let certain = blocks > model.alarm_blocks;
        self.beyond[index] = if certain { model.alarm_blocks } else { blocks };
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

#[cfg(test)]
mod tests;
