//! Which zones of a wheel carry load at its pose.

use super::forces::{PatchForces, WheelForces};
use super::zones::ZONES;

/// The zones of a wheel that carry load at its pose, one by one.
pub(super) struct LoadedZones {
    /// A bit for each that is still to come.
    zones: u32,
    /// The zone that came last.
    zone: usize,
}

impl LoadedZones {
    /// The `zones`, a bit for each, that carry load; clears the patches of `wheel` that carry load no more.
    #[inline(always)]
    pub fn new(zones: u32, wheel: &mut WheelForces) -> Self {
        let mut unloaded = wheel.loaded_zones & !zones;
        wheel.loaded_zones = zones;
        while unloaded != 0 {
            wheel.patches[unloaded.trailing_zeros() as usize % ZONES] = PatchForces::default();
            unloaded &= unloaded - 1;
        }
        Self { zones, zone: 0 }
    }

    /// Whether another one carries load.
    #[inline(always)]
    pub fn are_left(&self) -> bool {
        self.zones != 0
    }

    /// Goes on to the next one, or stays at the last; whether there was another.
    #[inline(always)]
    pub fn advance(&mut self) -> (usize, bool) {
        let is_another = self.are_left();
        if is_another {
            self.zone = self.zones.trailing_zeros() as usize % ZONES;
            self.zones &= self.zones - 1;
        }
        (self.zone, is_another)
    }
}
