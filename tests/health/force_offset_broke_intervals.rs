//! Fixed bug: an offset of the force sensor moved flow, stiffness and clearance by ten standard deviations and was
//! reported as wear.

use dashpot_core::health::HealthStatus;

use crate::sensors::{CONTAINED, Wrong};
use crate::synthetic::{PRESETS, varied};

#[test]
fn the_zero_of_the_force_is_found_and_taken_out() {
    for preset in PRESETS {
        let healthy = varied(preset, None);
        for (offset, seed) in [(50.0, 1), (200.0, 2), (300.0, 3), (-300.0, 4), (1000.0, 5)] {
            let run = Wrong::ForceBias(offset).run(&healthy, seed).unwrap();
            let zero = run.last.force_zero_n;
            assert!(
                (f64::from(zero.value) - offset).abs() < 5.0 * f64::from(zero.sd) && zero.sd < 40.0,
                "{preset}, {offset} N: {zero:?}"
            );
            assert!(
                run.error < CONTAINED,
                "{preset}, {offset} N: {:?}",
                run.last
            );
            assert!(!run.had_alarm, "{preset}, {offset} N: {:?}", run.last);
            let is_alarm = run.last.status.contains(HealthStatus::FORCE_ZERO);
            assert!(
                is_alarm || offset < 1000.0,
                "{preset}, {offset} N: {:?}",
                run.last
            );
        }
    }
}
