//! Storage for the dampers of a bank and a spare one that is loaded while the others step.

use crate::damper::Damper;

/// Dampers in the order of their slots. The damper in the spare slot is not part of the bank.
#[derive(Clone, Debug)]
pub(crate) struct Slots<const N: usize> {
    dampers: [Damper<f32>; N],
    /// Damper of the last slot.
    last: Damper<f32>,
    /// Slot of each damper of the bank.
    slots: [u8; N],
    /// Slot of the spare damper.
    spare: u8,
}

impl<const N: usize> Slots<N> {
    /// Slots before the dampers are copied into them: all bits are zero.
    pub(crate) const fn new() -> Self {
        Self {
            dampers: [Damper::<f32>::EMPTY; N],
            last: Damper::<f32>::EMPTY,
            slots: [0; N],
            spare: 0,
        }
    }

    /// Copies these dampers into the bank.
    pub(crate) fn fill(&mut self, dampers: &[&Damper<f32>; N]) {
        for (slot, damper) in self.dampers.iter_mut().zip(dampers) {
            *slot = **damper;
        }
        self.slots = core::array::from_fn(|slot| slot as u8);
        self.spare = N as u8;
    }

    /// Returns all dampers of the bank.
    #[inline]
    pub(crate) fn all(&self) -> [&Damper<f32>; N] {
        let slot = |slot| self.dampers.get(usize::from(slot)).unwrap_or(&self.last);
        self.slots.map(slot)
    }

    /// Returns a damper of the bank.
    pub(crate) fn get(&self, damper: u8) -> Option<&Damper<f32>> {
        let slot = self.slots.get(usize::from(damper))?;
        Some(self.dampers.get(usize::from(*slot)).unwrap_or(&self.last))
    }

    /// Returns a damper of the bank for changes.
    pub(crate) fn get_mut(&mut self, damper: u8) -> Option<&mut Damper<f32>> {
        let slot = *self.slots.get(usize::from(damper))?;
        Some(self.slot_mut(slot))
    }

    /// Returns the spare damper.
    pub(crate) fn spare_mut(&mut self) -> &mut Damper<f32> {
        self.slot_mut(self.spare)
    }

    /// Exchanges a damper of the bank with the spare damper.
    pub(crate) fn swap_spare(&mut self, damper: u8) {
        if let Some(slot) = self.slots.get_mut(usize::from(damper)) {
            core::mem::swap(slot, &mut self.spare);
        }
    }

    fn slot_mut(&mut self, slot: u8) -> &mut Damper<f32> {
        let slot = self.dampers.get_mut(usize::from(slot));
        slot.unwrap_or(&mut self.last)
    }
}
