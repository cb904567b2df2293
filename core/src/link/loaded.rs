//! The dampers of a device with their states and the tick count.

use super::limits::MAX_DAMPERS;
use super::lists::{PerDamper, Reals};
use super::message::{Forces, Response};
use super::refusal::Refusal;
use super::slots::Slots;
use crate::bank::step_bank;
use crate::damper::Damper;
use crate::integrity::Check;
use crate::state::DamperState;
use crate::status::Status;

const STATE_BYTES: usize = DamperState::<f32>::BYTES;

/// Buffer for the states of a bank in bytes.
pub(crate) type SavedStates = [u8; MAX_DAMPERS * STATE_BYTES];

/// The dampers of a bank are built for different step sizes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("damper {damper} is built for another step than damper 0")]
#[non_exhaustive]
pub struct StepSizeError {
    /// Index of the first damper whose step size differs from that of damper 0.
    pub damper: usize,
}

/// Dampers and states, last displacements and forces, tick count.
#[derive(Clone, Debug)]
pub(crate) struct Loaded<const N: usize> {
    dampers: Slots<N>,
    states: [DamperState<f32>; N],
    displacements_m: [f32; N],
    forces_n: [f32; N],
    tick: u32,
    /// Step of the bank (s), copied from the first damper at the start so that later damage cannot change it.
    step_s: f32,
}

impl<const N: usize> Loaded<N> {
    /// A bank before the dampers are copied into it: all bits are zero.
    pub(crate) const fn new() -> Self {
        Self {
            dampers: Slots::new(),
            states: [DamperState::<f32>::UNWRITTEN; N],
            displacements_m: [0.0; N],
            forces_n: [0.0; N],
            tick: 0,
            step_s: 0.0,
        }
    }

    /// Copies these dampers and puts them at rest at 0.
    pub(crate) fn start(&mut self, dampers: &[&Damper<f32>; N]) -> Result<(), StepSizeError> {
        let step_s = dampers.first().map_or(0.0, |damper| damper.step_s());
        if let Some(damper) = dampers.iter().position(|other| other.step_s() != step_s) {
            return Err(StepSizeError { damper });
        }
        self.dampers.fill(dampers);
        self.step_s = step_s;
        self.rest_at([0.0; N]);
        Ok(())
    }

    pub(crate) fn tick(&self) -> u32 {
        self.tick
    }

    pub(crate) fn forces_n(&self) -> &[f32; N] {
        &self.forces_n
    }

    pub(crate) fn states(&self) -> &[DamperState<f32>; N] {
        &self.states
    }

    pub(crate) fn step_s(&self) -> f32 {
        self.step_s
    }

    pub(crate) fn revisions(&self) -> PerDamper<u32> {
        let revisions = self.dampers.all().map(Damper::revision);
        revisions.into_iter().collect()
    }

    /// Sets the displacements (m) of the following ticks.
    pub(crate) fn displace(&mut self, displacements_m: &Reals) -> Result<(), Refusal> {
        self.displacements_m = all(displacements_m)?;
        Ok(())
    }

    /// Steps every damper once, at the last displacements.
    #[inline]
    pub(crate) fn step(&mut self) {
        let (dampers, states) = (self.dampers.all(), &mut self.states);
        step_bank(&dampers, states, &self.displacements_m, &mut self.forces_n);
        self.tick = self.tick.wrapping_add(1);
    }

    /// Puts every damper at rest and sets the tick to 0.
    pub(crate) fn reset(&mut self, displacements_m: &Reals) -> Result<(), Refusal> {
        let displacements_m = all(displacements_m)?;
        let dampers = self.dampers.all();
        let mut pairs = dampers.iter().zip(&displacements_m);
        if !pairs.all(|(damper, displacement)| damper.is_displacement(*displacement)) {
            return Err(Refusal::Range);
        }
        self.rest_at(displacements_m);
        Ok(())
    }

    fn rest_at(&mut self, displacements_m: [f32; N]) {
        let dampers = self.dampers.all();
        let states = self.states.iter_mut().zip(dampers).zip(&displacements_m);
        for ((state, damper), displacement_m) in states {
            *state = damper.at_rest(*displacement_m);
        }
        self.displacements_m = displacements_m;
        self.forces_n = [0.0; N];
        self.tick = 0;
    }

    /// Returns the spare damper, which [`Self::replace`] puts into the bank once it is loaded.
    pub(crate) fn spare(&mut self) -> &mut Damper<f32> {
        self.dampers.spare_mut()
    }

    /// Replaces a damper of the bank with the loaded one; the state keeps its force.
    pub(crate) fn replace(&mut self, damper: u8) -> Result<(), Refusal> {
        let step_s = self.spare().step_s();
        if step_s != self.step_s {
            return Err(Refusal::StepSize);
        }
        self.dampers.swap_spare(damper);
        self.carry_over(damper);
        Ok(())
    }

    /// Changes the clearance 2a (m) of a damper; the state keeps its force.
    pub(crate) fn set_clearance(&mut self, damper: u8, clearance_m: f32) -> Result<(), Refusal> {
        if let Some(damper) = self.dampers.get_mut(damper) {
            let set = damper.set_clearance_m(clearance_m);
            set.map_err(|_| Refusal::Range)?;
        }
        self.carry_over(damper);
        Ok(())
    }

    /// Adopts a state between ticks, so that the next tick has its usual cost.
    fn carry_over(&mut self, damper: u8) {
        let state = self.states.get_mut(usize::from(damper));
        if let Some((damper, state)) = self.dampers.get(damper).zip(state) {
            damper.adopt(state);
        }
    }

    /// Refuses an index without a damper.
    pub(crate) fn require_damper(&self, damper: u8) -> Result<(), Refusal> {
        let known = usize::from(damper) < N;
        known.then_some(()).ok_or(Refusal::Damper(N as u8))
    }

    /// Checks a slice of a damper's constants. If it finds damage, it latches the damage and returns false.
    pub(crate) fn check_constants(&mut self, damper: u8, check: &mut Check) -> bool {
        let found = self.dampers.get(damper);
        let good = found.is_none_or(|damper| check.slice(damper).is_ok());
        self.latch_unless(good, damper);
        good
    }

    /// Checks a damper's state. If it finds damage, or the last step did, it latches the damage and returns false.
    pub(crate) fn check_state(&mut self, damper: u8) -> bool {
        let pair = self.dampers.get(damper);
        let pair = pair.zip(self.states.get(usize::from(damper)));
        let good = pair.is_none_or(|(damper, state)| {
            let latched = state.status().contains(Status::CORRUPTED);
            !latched && Check::state(damper, state).is_ok()
        });
        self.latch_unless(good, damper);
        good
    }

    fn latch_unless(&mut self, good: bool, damper: u8) {
        let state = self.states.get_mut(usize::from(damper));
        if let Some(state) = state.filter(|_| !good) {
            state.latch(Status::CORRUPTED);
        }
    }

    /// Writes the states as bytes, in order.
    pub(crate) fn save<'a>(&self, buffer: &'a mut SavedStates) -> &'a [u8] {
        let (bytes, _) = buffer.as_chunks_mut::<STATE_BYTES>();
        for (bytes, state) in bytes.iter_mut().zip(&self.states) {
            *bytes = state.to_bytes();
        }
        buffer.get(..N * STATE_BYTES).unwrap_or_default()
    }

    /// Restores the tick and all states from bytes. Nothing changes unless every state is valid.
    pub(crate) fn restore(&mut self, tick: u32, bytes: &[u8]) -> Result<(), Refusal> {
        let (saved, rest) = bytes.as_chunks::<STATE_BYTES>();
        if saved.len() != N || !rest.is_empty() {
            return Err(Refusal::Count(N as u8));
        }
        let mut states = self.states;
        for ((state, damper), saved) in states.iter_mut().zip(self.dampers.all()).zip(saved) {
            *state = damper.state_from_bytes(saved).map_err(|_| Refusal::State)?;
        }
        self.states = states;
        self.displacements_m = states.map(|state| state.displacement_m());
        self.forces_n = states.map(|state| state.force_n());
        self.tick = tick;
        Ok(())
    }

    /// Returns the result of the tick, with `outputs_n` as the forces (N).
    pub(crate) fn forces(&self, outputs_n: &[f32; N], clock_ticks: u32) -> Forces {
        Forces {
            tick: self.tick,
            forces_n: outputs_n.iter().copied().collect(),
            status: self.status_bits(),
            clock_ticks,
        }
    }

    /// Returns status bits and rejected inputs.
    pub(crate) fn status(&self) -> Response<'static> {
        Response::Status {
            status: self.status_bits(),
            rejected_inputs: self.states.iter().map(|s| s.rejected_inputs()).collect(),
        }
    }

    /// Clears status bits and rejected inputs.
    pub(crate) fn clear_status(&mut self) {
        self.states.iter_mut().for_each(DamperState::clear_status);
    }

    fn status_bits(&self) -> PerDamper<u16> {
        self.states.iter().map(|s| s.status().bits()).collect()
    }
}

/// Returns the numbers as an array, if there are exactly `N`.
fn all<const N: usize>(reals: &Reals) -> Result<[f32; N], Refusal> {
    <[f32; N]>::try_from(&**reals).map_err(|_| Refusal::Count(N as u8))
}
