//! Whether the force follows the displacement.
//!
//! While the force stays within its noise of one value, the piston moves as that force says, and the ends may only move
//! by the clearance beside it. Ends that move further have no force between them that the model has: the force channel
//! is dead or stuck, the oil is gone, or the clearance is far beyond what is known of it.

use super::block::Block;
use super::model::HealthModel;

/// Move (m) beyond the clearance for which the force is missing, where no contact was seen for half a second.
const WITHOUT_CONTACT_M: f32 = 0.5e-3;
/// Part of the piston's path that the law may be wrong by.
const LAW_PART: f32 = 0.5;
/// Blocks in a row beyond that which make it certain.
const CERTAIN: u32 = 3;

/// The stretch of blocks in which the force stayed within its noise.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub(crate) struct Follow {
    /// Force (N) at its start.
    force: f32,
    /// Travel of the piston since its start (m).
    travel: f32,
    /// Sum of the travel's magnitudes (m).
    path: f32,
    /// Displacement less oil column and travel: least and greatest (m).
    lowest: f32,
    highest: f32,
    blocks: u32,
    /// Blocks in a row that moved too far.
    beyond: u32,
}

impl Follow {
    /// Of zero bits.
    pub(crate) const EMPTY: Self = Self {
        force: 0.0,
        travel: 0.0,
        path: 0.0,
        lowest: 0.0,
        highest: 0.0,
        blocks: 0,
        beyond: 0,
    };

    /// Before the first block: no force is near this one.
    pub(crate) fn begin(&mut self) {
        self.force = f32::MAX;
    }

    /// Takes a block in, with the flow factor and half the clearance (m) as they are estimated now.
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
            && self.blocks <= 2 * model.most_unmeasured
            && block.lowest >= -model.yield_force_n
            && block.highest <= model.yield_force_n;
        if !stays {
            // A block with samples left out has no mean: the next one begins.
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
        let place = block.position - self.travel;
        self.lowest = if place < self.lowest {
            place
        } else {
            self.lowest
        };
        self.highest = if place > self.highest {
            place
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

    /// Whether the ends moved as they cannot without a change of force.
    #[inline(always)]
    pub(crate) fn is_missing(&self) -> bool {
        self.beyond >= CERTAIN
    }

    /// Whether the ends moved at all.
    #[inline(always)]
    pub(crate) fn has_moved(&self, model: &HealthModel) -> bool {
        self.highest - self.lowest > model.still_m
    }
}
