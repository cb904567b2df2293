//! Indices of the steady motions in recorded loops, without skew and offset of the rig.

use dashpot_files::sheet::Index;
use dashpot_testbench::steady::{Samples, find};

use super::keys::{FORCE_OFFSET, SKEW};
use super::rig::HeldRig;
use super::{Calibrated, Calibration, IndexTest, Recorded};

impl Calibrated {
    /// Returns the parameters of the rig, found or held.
    pub fn rig(&self, calibration: &Calibration) -> HeldRig {
        let found = |key: &str| {
            let varied = calibration.varied.iter().zip(&self.values);
            varied.into_iter().find(|(varied, _)| varied.key == key)
        };
        let value = |key: &str, held: f64| found(key).map_or(held, |(_, value)| *value);
        HeldRig {
            skew_s: value(SKEW, calibration.rig.skew_s),
            force_offset_n: value(FORCE_OFFSET, calibration.rig.force_offset_n),
        }
    }
}

impl Recorded {
    /// Returns the indices of each steady harmonic motion in the recording.
    pub fn index_tests(&self, rig: HeldRig) -> Vec<IndexTest> {
        let forces_n = self.forces_without(rig);
        let found = find(Samples {
            times_s: &self.times_s,
            displacements_m: &self.displacements_m,
            forces_n: &forces_n,
        });
        let test = |motion: &dashpot_testbench::steady::SteadyMotion| {
            let indices = motion.indices();
            let value = |index: Index| {
                let (_, estimate) = indices.iter().find(|(other, _)| *other == index)?;
                estimate.map(|estimate| estimate.value)
            };
            IndexTest {
                amplitude_m: motion.mean.motion.amplitude_m,
                frequency_hz: motion.mean.motion.frequency_hz,
                max_extension_force_n: value(Index::MaxExtensionForceN),
                max_compression_force_n: value(Index::MaxCompressionForceN),
                energy_per_cycle_j: value(Index::EnergyPerCycleJ),
                ..IndexTest::default()
            }
        };
        found.motions.iter().map(test).collect()
    }

    /// Returns the forces as a sensor without delay and offset would read them.
    fn forces_without(&self, rig: HeldRig) -> Vec<f64> {
        let (times_s, forces_n) = (&self.times_s, &self.forces_n);
        let later = |time_s: &f64| {
            let time_s = time_s + rig.skew_s;
            let after = times_s.partition_point(|other| *other < time_s);
            let after = after.clamp(1, times_s.len() - 1);
            let [start_s, end_s] = [times_s[after - 1], times_s[after]];
            let share = ((time_s - start_s) / (end_s - start_s)).clamp(0.0, 1.0);
            forces_n[after - 1] + share * (forces_n[after] - forces_n[after - 1])
                - rig.force_offset_n
        };
        match times_s.len() {
            0 | 1 => forces_n.clone(),
            _ => times_s.iter().map(later).collect(),
        }
    }
}
