//! `--step-us` accepts fractions in every command that has it.

use dashpot_core::Damper;
use dashpot_files::damper;
use dashpot_hil::commands::step_size::StepSize;

use crate::common::{dashpot, json_of};

const RAMP: &str = "time_s,displacement_m\n0,0\n0.001,0.001\n";

fn in_service(step_s: f64) -> Damper<f32> {
    let parameters = damper::load("in-service", &[]).unwrap();
    parameters.build(step_s).unwrap()
}

#[test]
fn replay_steps_at_16_khz() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("in.csv"), RAMP).unwrap();
    let arguments = ["replay", "--damper", "in-service", "--step-us", "62.5"];
    let files = ["--input", "in.csv", "--output", "out.csv"];
    dashpot(&[&arguments[..], &files].concat(), folder.path()).success();
    let written = std::fs::read_to_string(folder.path().join("out.csv")).unwrap();
    let rows: Vec<Vec<&str>> = written
        .lines()
        .skip(1)
        .map(|line| line.split(',').collect())
        .collect();
    assert_eq!(rows.len(), 17);
    let damper = in_service(62.5e-6);
    let mut state = damper.at_rest(0.0);
    for (tick, row) in rows.iter().enumerate() {
        // Printed with the shortest decimal number.
        let time_s: f64 = format!("{:.7}", tick as f64 * 62.5e-6).parse().unwrap();
        assert_eq!(row[0].parse(), Ok(time_s));
        let x: f64 = row[1].parse().unwrap();
        assert_eq!(row[2].parse(), Ok(damper.step(&mut state, x as f32)));
    }
}

#[test]
fn export_builds_for_a_fraction() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = ["export", "--damper", "in-service", "--step-us", "62.5"];
    for (lang, file) in [("bin", "damper.bin"), ("rust", "damper.rs")] {
        let rest = ["--lang", lang, "--output", file];
        dashpot(&[&arguments[..], &rest].concat(), folder.path()).success();
    }
    let bytes = std::fs::read(folder.path().join("damper.bin")).unwrap();
    assert_eq!(Damper::<f32>::from_image(&bytes), Ok(in_service(62.5e-6)));
    let source = std::fs::read_to_string(folder.path().join("damper.rs")).unwrap();
    for part in ["for a step of 62.5 us (16.000000 kHz)", "--step-us 62.5 "] {
        assert!(source.contains(part), "no {part} in the comment");
    }
}

#[test]
fn verify_and_rig_take_a_fraction() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("in.csv"), RAMP).unwrap();
    let verify = ["verify", "--input", "in.csv", "--step-us", "62.5"];
    let output = dashpot(
        &[&verify[..], &["--format", "json"]].concat(),
        folder.path(),
    )
    .success();
    assert_eq!(json_of(&output)["deviations"][0]["step_s"], 62.5e-6);
    let rig = ["rig", "--step-us", "312.5", "--frequency-hz", "1"];
    let output = dashpot(&[&rig[..], &["--format", "json"]].concat(), folder.path()).success();
    assert_eq!(json_of(&output)["step_s"], 312.5e-6);
}

/// A target reports its step size in single precision.
#[test]
fn the_step_of_a_target_is_the_one_it_was_built_for() {
    for us in [1.0, 62.5, 100.0, 333.3333, 1000.0, 20_000.0] {
        let step = StepSize::from_us(us).unwrap();
        let reported = in_service(step.step_s()).step_s();
        assert_eq!(StepSize::from_target(reported), Some(step), "{reported}");
    }
    for step_s in [0.0, 0.9e-6, 0.021, f32::NAN, f32::INFINITY] {
        assert_eq!(StepSize::from_target(step_s), None);
    }
}
