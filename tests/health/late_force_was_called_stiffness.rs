//! Fixed bug: a force that was 5 ms late was reported as another stiffness with a narrow interval.

use dashpot_core::health::HealthStatus;

use crate::sensors::Wrong;
use crate::synthetic::{PRESETS, varied};

#[test]
fn channels_that_are_too_far_apart_in_time_are_reported() {
    for preset in PRESETS {
        for seed in 0..3 {
            for wrong in [Wrong::ForceLag(5), Wrong::DisplacementLag(5)] {
                let run = wrong.run(&varied(preset, None), seed).unwrap();
                let status = run.last.status;
                assert!(
                    status.contains(HealthStatus::LATE),
                    "{preset}, {wrong:?}: {:?}",
                    run.last
                );
            }
        }
    }
}
