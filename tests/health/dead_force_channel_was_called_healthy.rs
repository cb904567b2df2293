//! Fixed bug: for as long as the damper moved, a force channel reduced to noise and oil full of air were taken for a
//! healthy damper, with narrow intervals and without a status bit.

use dashpot_core::health::HealthStatus;

use crate::sensors::{Run, Wrong};
use crate::synthetic::{PRESETS, varied};

fn check(preset: &str, run: &Run) {
    let after_s = run.no_force_after_s;
    assert!(
        after_s.is_some_and(|after_s| after_s < 1.0),
        "{preset}: {after_s:?}"
    );
    assert!(!run.last.is_trusted(), "{preset}: {:?}", run.last);
    // The knowledge from before the fault must fade.
    assert!(run.last.flow_factor.sd > 0.25, "{preset}: {:?}", run.last);
    assert!(run.last.status.contains(HealthStatus::LITTLE_EXCITATION));
    assert!(!run.had_alarm, "{preset}: no wear was measured");
}

#[test]
fn a_dead_force_channel_is_an_alarm_within_a_second() {
    for preset in PRESETS {
        for seed in 0..5 {
            let run = Wrong::ForceDead.run(&varied(preset, None), seed).unwrap();
            check(preset, &run);
        }
    }
}

#[test]
fn oil_full_of_air_is_an_alarm_within_a_second() {
    for seed in 0..5 {
        let run = Wrong::Air(0.15)
            .run(&varied("in-service", None), seed)
            .unwrap();
        check("in-service", &run);
    }
}
