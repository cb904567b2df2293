//! Checks that the force follows the displacement.
//!
//! While the force is constant within its noise, it determines the travel of the piston. In addition to this travel,
//! the ends can move only by the clearance. If they move more than that, the force is missing: the force channel is
//! dead or stuck, the oil is gone, or the clearance is much larger than estimated.

use super::block::Block;
use super::model::HealthModel;

/// After half a second without contact, the force counts as missing if the ends move beyond the clearance by more than
/// this (m).
const WITHOUT_CONTACT_M: f32 = 0.5e-3;
/// Possible error of the piston's travel due to errors of the law, as a fraction of its path (1).
const LAW_PART: f32 = 0.5;
/// Number of consecutive blocks beyond the limit after which the force is certainly missing.
const CERTAIN: u32 = 3;

/// A run of consecutive blocks in which the force is constant within its noise.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub(crate) struct Follow {
    /// Force at the start of the run (N).
    force: f32,
    /// Travel of the piston since the start of the run (m).
    travel: f32,
    /// Sum of the magnitudes of the travel in each block (m).
    path: f32,
    /// Smallest and largest displacement, after subtraction of the oil column's deflection and the travel (m).
    lowest: f32,
    highest: f32,
    blocks: u32,
    /// Number of consecutive blocks in which the move was too large.
    beyond: u32,
}

impl Follow {
    /// Placeholder: all bits are zero.
    pub(crate) const EMPTY: Self = Self {
        force: 0.0,
        travel: 0.0,
        path: 0.0,
        lowest: 0.0,
        highest: 0.0,
        blocks: 0,
        beyond: 0,
    };

    /// Resets to the state before the first block. No real force is near the force set here, so the first block starts
    /// a run.
    pub(crate) fn begin(&mut self) {
        self.force = f32::MAX;
    }

    /// Takes a block with the present estimates of the flow factor and half the clearance (m).
    #[inline(always)]
    pub(crate) fn take(
        &mut self,
        model: &HealthModel,
        block: &Block,
        [flow, half]: [f32; 2],
        is_idle: bool,
    ) {
        let change = (block.force - self.force).abs();
        self.blocks = self.blocks.wrapping_add(1);
        let stays = change <= model.contact_force_n
            && self.blocks <= 2 * model.max_unmeasured
            && block.lowest >= -model.yield_force_n
            && block.highest <= model.yield_force_n;
        if !stays {
            // An incomplete block has no mean force, so the next block starts a run.
            self.force = if block.is_incomplete() {
                f32::MAX
            } else {
                block.force
            };
            self.travel = 0.0;
            self.path = 0.0;
            self.lowest = block.position;
            self.highest = block.position;
            self.blocks = 0;
            self.beyond = 0;
            return;
        }
        let travel = flow * block.travel;
        self.travel += travel;
        self.path += travel.abs();
        let position = block.position - self.travel;
        self.lowest = if position < self.lowest {
            position
        } else {
            self.lowest
        };
        self.highest = if position > self.highest {
            position
        } else {
            self.highest
        };
        let nominal = model.start[2];
        let half = if half > nominal { half } else { nominal };
        let margin = if is_idle {
            WITHOUT_CONTACT_M
        } else {
            model.missing_m
        };
        let allowed = (half + half) + margin + model.still_m + LAW_PART * self.path;
        let is_beyond = self.highest - self.lowest > allowed;
        self.beyond = if is_beyond {
            self.beyond.saturating_add(1)
        } else {
            0
        };
    }

    /// True if the ends moved further than possible without a change of force.
    #[inline(always)]
    pub(crate) fn is_missing(&self) -> bool {
        self.beyond >= CERTAIN
    }

    /// True if the ends moved at all.
    #[inline(always)]
    pub(crate) fn has_moved(&self, model: &HealthModel) -> bool {
        self.highest - self.lowest > model.still_m
    }
}

#[cfg(test)]
mod tests;
