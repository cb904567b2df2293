//! Fixed bug: an increase of the seal friction by 400 N was reported as less flow and another clearance.

use crate::sensors::{CONTAINED, Wrong};
use crate::synthetic::varied;

#[test]
fn added_friction_is_found_and_taken_out() {
    let healthy = varied("in-service", None);
    for seed in 0..5 {
        let run = Wrong::Friction(400.0).run(&healthy, seed).unwrap();
        let friction = run.last.added_friction_n;
        assert!(
            (friction.value - 400.0).abs() < 4.0 * friction.sd && friction.sd < 40.0,
            "{friction:?}"
        );
        assert!(
            run.error < CONTAINED && run.last.is_trusted() && !run.had_alarm,
            "{:?}",
            run.last
        );
    }
}
