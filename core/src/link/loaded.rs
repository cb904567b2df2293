//! The dampers a device steps, with their states and the tick count.

use heapless::Vec;

use super::message::{Forces, MOST_DAMPERS, Reals, Response};
use super::refusal::Refusal;
use super::slots::Slots;
use crate::bank::step_bank;
use crate::damper::Damper;
use crate::integrity::Check;
use crate::state::DamperState;
use crate::status::Status;

const STATE_BYTES: usize = DamperState::<f32>::BYTES;

/// Buffer for the states of a bank as bytes.
pub(crate) type SavedStates = [u8; MOST_DAMPERS * STATE_BYTES];

/// A bank whose dampers are not all built for one step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("damper {damper} is built for another step than damper 0")]
pub struct StepSizeError {
    /// The first damper of another step than the first of all.
    pub damper: usize,
}

/// Dampers, states, last displacements and forces, tick.
#[derive(Clone, Debug)]
pub(crate) struct Loaded<const N: usize> {
    dampers: Slots<N>,
    states: [DamperState<f32>; N],
    displacements_m: [f32; N],
    forces_n: [f32; N],
    tick: u32,
    /// Step of the bank (s), that of its first damper at the start: a damaged one must not decide it.
    step_s: f32,
}

impl<const N: usize> Loaded<N> {
    /// No dampers yet.
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

    /// Copies of these dampers, at rest at 0.
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

    pub(crate) fn revisions(&self) -> Vec<u32, MOST_DAMPERS> {
        let revisions = self.dampers.all().map(Damper::revision);
        revisions.into_iter().collect()
    }

    /// Displacements (m) of the ticks from now on.
    pub(crate) fn displace(&mut self, displacements_m: &Reals) -> Result<(), Refusal> {
        self.displacements_m = all(displacements_m)?;
        Ok(())
    }

    /// One tick at the displacements given last.
    #[inline]
    pub(crate) fn step(&mut self) {
        let (dampers, states) = (self.dampers.all(), &mut self.states);
        step_bank(&dampers, states, &self.displacements_m, &mut self.forces_n);
        self.tick = self.tick.wrapping_add(1);
    }

    /// Every damper at rest, tick 0.
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

    /// The damper to load into, for [`Self::replace`].
    pub(crate) fn spare(&mut self) -> &mut Damper<f32> {
        self.dampers.spare_mut()
    }

    /// Makes the damper that was loaded one of the bank, in place of another, whose state keeps the force.
    pub(crate) fn replace(&mut self, damper: u8) -> Result<(), Refusal> {
        let step_s = self.spare().step_s();
        if step_s != self.step_s {
            return Err(Refusal::StepSize);
        }
        self.dampers.swap_spare(damper);
        self.carry_over(damper);
        Ok(())
    }

    /// Changes the clearance 2a (m) of a damper; its state keeps the force.
    pub(crate) fn set_clearance(&mut self, damper: u8, clearance_m: f32) -> Result<(), Refusal> {
        if let Some(damper) = self.dampers.get_mut(damper) {
            let set = damper.set_clearance_m(clearance_m);
            set.map_err(|_| Refusal::Range)?;
        }
        self.carry_over(damper);
        Ok(())
    }

    /// Between ticks, so that the next tick costs what every tick costs.
    fn carry_over(&mut self, damper: u8) {
        let state = self.states.get_mut(usize::from(damper));
        if let Some((damper, state)) = self.dampers.get(damper).zip(state) {
            damper.adopt(state);
        }
    }

    /// Refuses a damper that is not there.
    pub(crate) fn has(&self, damper: u8) -> Result<(), Refusal> {
        let known = usize::from(damper) < N;
        known.then_some(()).ok_or(Refusal::Damper(N as u8))
    }

    /// Whether a slice of a damper's constants is undamaged; latched when it is not.
    pub(crate) fn check_constants(&mut self, damper: u8, check: &mut Check) -> bool {
        let found = self.dampers.get(damper);
        let good = found.is_none_or(|damper| check.slice(damper).is_ok());
        self.latch_unless(good, damper);
        good
    }

    /// Whether a damper's state is undamaged, and was when it was last stepped; latched when it is not.
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

    /// The states as bytes, in order.
    pub(crate) fn save<'a>(&self, buffer: &'a mut SavedStates) -> &'a [u8] {
        let (bytes, _) = buffer.as_chunks_mut::<STATE_BYTES>();
        for (bytes, state) in bytes.iter_mut().zip(&self.states) {
            *bytes = state.to_bytes();
        }
        buffer.get(..N * STATE_BYTES).unwrap_or_default()
    }

    /// All states and the tick from bytes; nothing changes unless every state is right.
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

    /// The tick's result, `outputs_n` for the forces (N).
    pub(crate) fn forces(&self, outputs_n: &[f32; N], clock_ticks: u32) -> Forces {
        Forces {
            tick: self.tick,
            forces_n: outputs_n.iter().copied().collect(),
            status: self.status_bits(),
            clock_ticks,
        }
    }

    /// Status bits and rejected inputs.
    pub(crate) fn status(&self) -> Response<'static> {
        Response::Status {
            status: self.status_bits(),
            rejected_inputs: self.states.iter().map(|s| s.rejected_inputs()).collect(),
        }
    }

    /// Clears what [`Self::status`] tells.
    pub(crate) fn clear_status(&mut self) {
        self.states.iter_mut().for_each(DamperState::clear_status);
    }

    fn status_bits(&self) -> Vec<u16, MOST_DAMPERS> {
        self.states.iter().map(|s| s.status().bits()).collect()
    }
}

/// The numbers of all `N` dampers.
fn all<const N: usize>(reals: &Reals) -> Result<[f32; N], Refusal> {
    <[f32; N]>::try_from(reals.as_slice()).map_err(|_| Refusal::Count(N as u8))
}
