//! Blocks of samples: sums that each tick updates, and a block as one measurement.

use super::model::HealthModel;

/// Sums over the samples of the present block.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub(crate) struct Gathered {
    /// Displacement of the last sample (m).
    pub(crate) displacement: f32,
    /// Nominal velocity at the last sample (m/s).
    velocity: f32,
    /// Nominal travel since the previous block (m).
    travel: f32,
    travels: f32,
    positions: f32,
    forces: f32,
    /// Sum of the forces, each times its distance in ticks from the centre of the block (N).
    moment: f32,
    slopes: f32,
    lowest: f32,
    highest: f32,
    /// Ticks from the centre of the block to the next sample.
    offset: f32,
    pub(crate) ticks_left: u32,
    /// Force offset, subtracted from the forces of this block (N).
    zero: f32,
    /// Added friction, subtracted from each force magnitude before the laws are evaluated in this block (N).
    friction: f32,
}

/// A block of samples as one measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub(crate) struct Block {
    /// Nominal travel of the piston (m).
    pub(crate) travel: f32,
    /// Nominal travel up to the centre of the block (m).
    pub(crate) centre: f32,
    /// Mean displacement minus the deflection of the oil column (m).
    pub(crate) position: f32,
    /// Mean force (N).
    pub(crate) force: f32,
    /// Mean nominal velocity (m/s).
    pub(crate) velocity: f32,
    /// Mean rate of the force (N/s).
    pub(crate) rate: f32,
    /// Mean slope of the velocity law (m/(s N)).
    pub(crate) slope: f32,
    pub(crate) lowest: f32,
    pub(crate) highest: f32,
    /// Force offset, subtracted from the forces (N).
    pub(crate) zero: f32,
    /// Added friction, subtracted from each force magnitude before the laws are evaluated (N).
    pub(crate) friction: f32,
}

impl Block {
    /// A block of zeros.
    pub(crate) const NONE: Self = Self {
        travel: 0.0,
        centre: 0.0,
        position: 0.0,
        force: 0.0,
        velocity: 0.0,
        rate: 0.0,
        slope: 0.0,
        lowest: 0.0,
        highest: 0.0,
        zero: 0.0,
        friction: 0.0,
    };

    /// True if a sample was left out.
    #[inline(always)]
    pub(crate) fn is_incomplete(&self) -> bool {
        self.lowest < -1e30
    }
}

impl Gathered {
    /// Placeholder: all bits are zero.
    pub(crate) const EMPTY: Self = Self {
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
        zero: 0.0,
        friction: 0.0,
    };

    /// Starts a block. The last displacement, the last velocity and the corrections remain.
    #[inline(always)]
    pub(crate) fn begin(&mut self, model: &HealthModel) {
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

    /// Sets the corrections of the next block: force offset (N) and added friction (N).
    #[inline(always)]
    pub(crate) fn correct(&mut self, zero: f32, friction: f32) {
        self.zero = zero;
        self.friction = friction;
    }

    /// Adds a credible sample.
    #[inline(always)]
    pub(crate) fn add(&mut self, model: &HealthModel, displacement: f32, measured: f32) {
        let force = measured - self.zero;
        let working = force.abs() - self.friction;
        let working = if working > 0.0 { working } else { 0.0 };
        let piece = model.piece(working.copysign(force));
        let velocity = (piece.velocity + piece.velocity_slope * working).copysign(force);
        let oil = (piece.oil + piece.oil_slope * working).copysign(force);
        self.displacement = displacement;
        self.travel += model.half_step_s * (velocity + self.velocity);
        self.velocity = velocity;
        self.travels += self.travel;
        self.positions += displacement - oil;
        self.forces += force;
        self.moment += self.offset * force;
        self.slopes += piece.velocity_slope;
        self.lowest = if force < self.lowest {
            force
        } else {
            self.lowest
        };
        self.highest = if force > self.highest {
            force
        } else {
            self.highest
        };
        self.offset += 1.0;
    }

    /// Leaves out a sample, so that its block gives no measurement. Returns true if the block has no sample at all: the
    /// travel of the piston is then unknown.
    pub(crate) fn leave_out(&mut self, model: &HealthModel, displacement: f32) -> bool {
        let is_blind = self.ticks_left == 1 && self.offset <= -model.block_centre;
        if is_blind {
            self.velocity = 0.0;
        }
        self.travel += 2.0 * model.half_step_s * self.velocity;
        self.lowest = -f32::MAX;
        self.highest = f32::MAX;
        if displacement.is_finite() && displacement.abs() <= 1e3 {
            self.displacement = displacement;
        }
        is_blind
    }

    /// Returns the samples as one measurement.
    #[inline(always)]
    pub(crate) fn block(&self, model: &HealthModel) -> Block {
        Block {
            travel: self.travel,
            centre: self.travels * model.per_block,
            position: self.positions * model.per_block,
            force: self.forces * model.per_block,
            velocity: self.travel * model.per_block_s,
            rate: self.moment * model.rate_scale_per_s,
            slope: self.slopes * model.per_block,
            lowest: self.lowest,
            highest: self.highest,
            zero: self.zero,
            friction: self.friction,
        }
    }
}

#[cfg(test)]
mod tests;
