//! The zones of a wheel that carry load at its pose.

use super::forces::{PatchForces, WheelForces};
use super::zones::ZONES;

/// Iterates over the zones that carry load.
pub(super) struct LoadedZones {
    /// Bit mask of the remaining zones.
    zones: u32,
    /// The current zone.
    zone: usize,
}

impl LoadedZones {
    /// Starts with the bit mask `zones`, and clears the patches of `wheel` that no longer carry load.
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

    /// True if there is a next zone that carries load.
    #[inline(always)]
    pub fn are_left(&self) -> bool {
        self.zones != 0
    }

    /// Advances to the next zone, or stays at the last. Returns the zone, and true if it is a new one.
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
