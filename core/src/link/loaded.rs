//! The dampers a device steps, with their states and the tick count.

use super::message::{Forces, MOST_DAMPERS, Reals, Refusal};
use crate::bank::step_bank;
use crate::damper::Damper;
use crate::parameters::LARGEST_CLEARANCE_M;
use crate::revision;
use crate::state::DamperState;

const STATE_BYTES: usize = DamperState::<f32>::BYTES;

/// One number that tells banks of dampers apart: hash of their revisions in order.
pub fn bank_revision(revisions: impl IntoIterator<Item = u32>) -> u32 {
    revision::of_words(revision::START, revisions.into_iter().map(u64::from))
}

/// Dampers, states, last displacements and forces, tick.
#[derive(Clone, Debug)]
pub(crate) struct Loaded<const N: usize> {
    dampers: [Damper<f32>; N],
    states: [DamperState<f32>; N],
    displacements_m: [f32; N],
    forces_n: [f32; N],
    tick: u32,
}

impl<const N: usize> Loaded<N> {
    pub(crate) fn new(dampers: &[&Damper<f32>; N]) -> Self {
        Self {
            dampers: dampers.map(|damper| *damper),
            states: dampers.map(|damper| damper.at_rest(0.0)),
            displacements_m: [0.0; N],
            forces_n: [0.0; N],
            tick: 0,
        }
    }

    pub(crate) fn tick(&self) -> u32 {
        self.tick
    }

    pub(crate) fn forces_n(&self) -> &[f32; N] {
        &self.forces_n
    }

    pub(crate) fn state(&self, damper: u8) -> Option<&DamperState<f32>> {
        self.states.get(usize::from(damper))
    }

    /// Step of the bank (s), that of its first damper.
    pub(crate) fn step_s(&self) -> f32 {
        self.dampers.first().map_or(0.0, Damper::step_s)
    }

    pub(crate) fn revision(&self) -> u32 {
        bank_revision(self.dampers.iter().map(Damper::revision))
    }

    /// Displacements (m) of the ticks from now on.
    pub(crate) fn displace(&mut self, displacements_m: &Reals) -> Result<(), Refusal> {
        self.displacements_m = all(displacements_m)?;
        Ok(())
    }

    /// One tick at the displacements given last.
    #[inline]
    pub(crate) fn step(&mut self) {
        let dampers = self.dampers.each_ref();
        let states = &mut self.states;
        step_bank(&dampers, states, &self.displacements_m, &mut self.forces_n);
        self.tick = self.tick.wrapping_add(1);
    }

    /// Every damper at rest, tick 0.
    pub(crate) fn reset(&mut self, displacements_m: &Reals) -> Result<(), Refusal> {
        if !displacements_m.iter().all(|x| x.is_finite()) {
            return Err(Refusal::Range);
        }
        self.displace(displacements_m)?;
        let places = self.states.iter_mut().zip(&self.dampers);
        for ((state, damper), displacement_m) in places.zip(&self.displacements_m) {
            *state = damper.at_rest(*displacement_m);
        }
        self.forces_n = [0.0; N];
        self.tick = 0;
        Ok(())
    }

    /// Puts a damper in a place; its state keeps the force.
    pub(crate) fn replace(&mut self, place: u8, damper: &Damper<f32>) -> Result<(), Refusal> {
        *self.damper(place)? = *damper;
        self.carry_over(place);
        Ok(())
    }

    /// Changes the clearance 2a (m) of a damper; its state keeps the force.
    pub(crate) fn set_clearance(&mut self, place: u8, clearance_m: f32) -> Result<(), Refusal> {
        let damper = self.damper(place)?;
        if !(0.0..=LARGEST_CLEARANCE_M as f32).contains(&clearance_m) {
            return Err(Refusal::Range);
        }
        damper.set_clearance_m(clearance_m);
        self.carry_over(place);
        Ok(())
    }

    /// Between ticks, so that the next tick costs what every tick costs.
    fn carry_over(&mut self, place: u8) {
        let place = usize::from(place);
        if let (Some(damper), Some(state)) = (self.dampers.get(place), self.states.get_mut(place)) {
            damper.adopt(state);
        }
    }

    pub(crate) fn has(&self, place: u8) -> Result<(), Refusal> {
        let known = usize::from(place) < N;
        known.then_some(()).ok_or(Refusal::Damper(N as u8))
    }

    fn damper(&mut self, place: u8) -> Result<&mut Damper<f32>, Refusal> {
        let damper = self.dampers.get_mut(usize::from(place));
        damper.ok_or(Refusal::Damper(N as u8))
    }

    /// The states as bytes, in order.
    pub(crate) fn save<'a>(&self, place: &'a mut [u8; MOST_DAMPERS * STATE_BYTES]) -> &'a [u8] {
        let (places, _) = place.as_chunks_mut::<STATE_BYTES>();
        for (place, state) in places.iter_mut().zip(&self.states) {
            *place = state.to_bytes();
        }
        place.get(..N * STATE_BYTES).unwrap_or_default()
    }

    /// All states and the tick from bytes; nothing changes unless every state is right.
    pub(crate) fn restore(&mut self, tick: u32, bytes: &[u8]) -> Result<(), Refusal> {
        let (saved, rest) = bytes.as_chunks::<STATE_BYTES>();
        if saved.len() != N || !rest.is_empty() {
            return Err(Refusal::Count(N as u8));
        }
        let mut states = self.states;
        for ((state, damper), saved) in states.iter_mut().zip(&self.dampers).zip(saved) {
            *state = damper.restore(saved).map_err(|_| Refusal::State)?;
        }
        self.states = states;
        self.displacements_m = states.map(|state| state.displacement());
        self.forces_n = states.map(|state| state.force());
        self.tick = tick;
        Ok(())
    }

    /// The tick's result, `outputs_n` for the forces (N).
    pub(crate) fn forces(&self, outputs_n: &[f32; N], clock_ticks: u32) -> Forces {
        Forces {
            tick: self.tick,
            forces_n: outputs_n.iter().copied().collect(),
            status: self.states.iter().map(|s| s.status().bits()).collect(),
            clock_ticks,
        }
    }
}

/// The numbers of all `N` dampers.
fn all<const N: usize>(reals: &Reals) -> Result<[f32; N], Refusal> {
    <[f32; N]>::try_from(reals.as_slice()).map_err(|_| Refusal::Count(N as u8))
}
