//! Which zones of a wheel carry load at its pose, and what the step reads of each.

use super::forces::{PatchForces, Status, WheelForces};
use super::silhouette::WheelPose;
use super::source::{PatchReader, sealed::Source};
use super::tables::NUMBERS;
use super::zones::ZONES;

/// The zones of a wheel that carry load at its pose.
pub(super) struct LoadedZones<R> {
    pub reader: R,
    pub interpenetrations: [f64; ZONES],
    /// Depth of the tread datum below the rail's top, m.
    depth: f64,
    /// The first `count` are those that carry load.
    pub zones: [usize; ZONES],
    pub count: usize,
}

impl<'a, R: PatchReader> LoadedZones<R> {
    /// Those of `source`; sets the status of `wheel` and clears the patches that carry nothing.
    #[inline(always)]
    pub fn of<S: Source<Reader<'a> = R>>(
        source: &'a S,
        [lateral_m, roll_rad, yaw_rad]: [f64; 3],
        depth: f64,
        wheel: &mut WheelForces,
    ) -> Self {
        let reader = source.locate(&WheelPose {
            lateral_m,
            roll_rad,
            yaw_rad,
        });
        wheel.status = if reader.is_inside() {
            Status::Lifted
        } else {
            Status::OutsideTables
        };
        let interpenetrations = reader.interpenetrations_m();
        let (mut zones, mut count) = ([0; ZONES], 0);
        for (zone, result) in wheel.patches.iter_mut().enumerate() {
            if interpenetrations[zone] + depth > 0.0 {
                zones[count] = zone;
                count += 1;
            } else if result.load_n != 0.0 {
                *result = PatchForces::default();
            }
        }
        Self {
            reader,
            interpenetrations,
            depth,
            zones,
            count,
        }
    }

    /// Depth and numbers of the loaded patch number `k`; without depth when there are fewer.
    #[inline(always)]
    pub fn patch(&self, k: usize) -> (f64, [f64; NUMBERS]) {
        let zone = self.zones[k];
        let depth = if k < self.count {
            self.interpenetrations[zone] + self.depth
        } else {
            0.0
        };
        (depth, self.reader.numbers(zone))
    }
}
