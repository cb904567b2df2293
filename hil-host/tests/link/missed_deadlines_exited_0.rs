//! Regression: `dashpot vehicle --realtime` exited with code 0 although it missed 8027 of 10 000 deadlines.

use std::time::Duration;

use dashpot_core::link::Response;
use dashpot_host_link::Link;

use crate::common::{dashpot, error_of, json_of};
use crate::pil_common::{altered, serve_tcp};

/// A target that answers each tick three ticks late, independent of the speed of the machine.
fn late_target() -> Box<dyn Link> {
    Box::new(altered(|header, response, frame| {
        if let Response::Forces(_) = &response {
            std::thread::sleep(Duration::from_millis(3));
        }
        frame.write(&(header, response))
    }))
}

#[test]
fn a_run_that_misses_its_deadlines_fails() {
    let folder = tempfile::tempdir().unwrap();
    let link = format!("tcp:{}", serve_tcp(|| late_target()));
    let outside = format!("front lateral damper 1={link}");
    let ended = dashpot(
        &[
            "vehicle",
            "--case",
            "straight-180",
            "--duration-s",
            "0.05",
            "--realtime",
            "--outside",
            &outside,
            "--timeout-ms",
            "60000",
            "--output",
            ".",
            "--no-page",
            "--format",
            "json",
        ],
        folder.path(),
    );
    let realtime = &json_of(&ended)["realtime"];
    assert_eq!(realtime["ticks"], 50);
    assert_eq!(realtime["missed_deadlines"], 50);
    assert!(realtime["work"]["worst_ns"].as_f64().unwrap() >= 3e6);
    let error = error_of(&ended.code(1));
    assert!(
        error.contains("50 of 50 deadlines missed; allowed with --realtime: one in 1000"),
        "{error}"
    );
    // Results computed so far are kept.
    let history = std::fs::read_to_string(folder.path().join("history.csv")).unwrap();
    assert_eq!(history.lines().count(), 51);
}
