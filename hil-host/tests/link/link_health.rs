//! `dashpot link health`: loads a model, feeds a measurement, and compares the reading with the host's own estimator.

use std::fmt::Write;

use dashpot_core::Damper;
use dashpot_core::health::{Estimate, HealthModel, HealthReading, HealthSettings};
use dashpot_files::damper;
use dashpot_testbench::excitation::Excitation;
use dashpot_testbench::health::watch;
use serde_json::{Value, json};

use crate::link_common::Rig;

/// Returns displacement and force of an in-service damper over the ride forth and back, as numbers and as rows of CSV.
fn measurement(set: &[&str], ticks: usize) -> (Vec<(f64, f64)>, String) {
    let set: Vec<String> = set.iter().map(|set| (*set).to_owned()).collect();
    let parameters = damper::load("in-service", &set).unwrap();
    let damper: Damper<f32> = parameters.build(1e-3).unwrap();
    let mut state = damper.at_rest(0.0);
    let ride = Excitation::Ride.displacements_m(1e-3);
    let to_and_fro = ride.iter().chain(ride.iter().rev()).copied().cycle();
    let mut rows = String::from("time_s,displacement_m,force_n\n");
    let samples = to_and_fro.take(ticks).enumerate().map(|(tick, x)| {
        let force = f64::from(damper.step(&mut state, x as f32));
        writeln!(rows, "{},{x},{force}", tick as f64 / 1e3).unwrap();
        (x, force)
    });
    (samples.collect(), rows)
}

fn model(name: &str) -> HealthModel {
    let parameters = damper::load(name, &[]).unwrap();
    let settings = HealthSettings::new(60e-6, 60.0).memory_s(2.0);
    parameters.health_model(&settings, 1e-3).unwrap()
}

/// Reading printed by the command, with all bits.
fn expected_reading(reading: &HealthReading, time_s: Option<f64>) -> Value {
    // JSON has the shortest decimal of a number in single precision.
    let number = |number: f32| -> Value {
        serde_json::from_str(&serde_json::to_string(&number).unwrap()).unwrap()
    };
    let estimate =
        |estimate: Estimate| json!({"value": number(estimate.value), "sd": number(estimate.sd)});
    let names = reading.status.iter_names();
    let status: Vec<String> = names.map(|(name, _)| name.to_lowercase()).collect();
    let mut expected_reading = json!({
        "flow_factor": estimate(reading.flow_factor),
        "damping_factor": estimate(reading.damping_factor()),
        "stiffness_n_per_m": estimate(reading.stiffness_n_per_m),
        "clearance_m": estimate(reading.clearance_m),
        "lag_s": estimate(reading.lag_s),
        "compliance_m_per_n": estimate(reading.compliance_m_per_n),
        "force_zero_n": estimate(reading.force_zero_n),
        "added_friction_n": estimate(reading.added_friction_n),
        "trusted": reading.is_trusted(),
        "samples": reading.samples,
        "rejected": reading.rejected,
        "status": status,
    });
    if let Some(time_s) = time_s {
        expected_reading["time_s"] = json!(time_s);
    }
    expected_reading
}

const MODEL: [&str; 8] = [
    "--damper",
    "in-service",
    "--displacement-noise-m",
    "60e-6",
    "--force-noise-n",
    "60",
    "--memory-s",
    "2",
];

#[test]
fn a_measurement_gives_the_desks_readings() {
    let rig = Rig::new();
    let (samples, rows) = measurement(&[], 5001);
    rig.write("run.csv", rows);
    let feed = [
        "health",
        "--place",
        "1",
        "--input",
        "run.csv",
        "--every-s",
        "2",
    ];
    let report = rig.json(&[&feed[..], &MODEL].concat());
    let history = watch(&model("in-service"), samples.iter().copied(), 2.0);
    let times_s = [1.999, 3.999, 5.0];
    assert_eq!(history.readings.len(), times_s.len());
    let pairs = history.readings.iter().zip(times_s);
    let expected: Vec<Value> = pairs
        .map(|(reading, time_s)| expected_reading(&reading.reading, Some(time_s)))
        .collect();
    assert_eq!(report["readings"], json!(expected));
    assert_eq!(
        (&report["fed"], &report["damper"]),
        (&json!(5001), &json!("in-service"))
    );
    // The target keeps the model, so another measurement continues with it.
    let last = history.last().unwrap();
    let now = rig.json(&["health", "--place", "1"]);
    assert_eq!(now["readings"], json!([expected_reading(last, None)]));
    let more = rig.json(&["health", "--place", "1", "--input", "run.csv"]);
    let twice = samples.iter().chain(&samples).copied();
    let history = watch(&model("in-service"), twice, 100.0);
    let expected = expected_reading(history.last().unwrap(), Some(5.0));
    assert_eq!(more["readings"], json!([expected]));
}

#[test]
fn alarms_are_reported_in_words_and_cleared() {
    let rig = Rig::new();
    // The clearance is 1 mm larger than that of the model's damper.
    let (_, rows) = measurement(&["mount.clearance_m=2e-3"], 15_000);
    rig.write("run.csv", rows);
    let feed = ["health", "--input", "run.csv", "--clear"];
    let text = rig.text(&[&feed[..], &MODEL].concat());
    assert!(
        text.contains("model of in-service loaded\n15000 samples fed\n"),
        "{text}"
    );
    assert!(
        text.contains("  clearance\n") && text.contains("status cleared"),
        "{text}"
    );
    let now = rig.json(&["health"]);
    let status = now["readings"][0]["status"].as_array().unwrap();
    assert!(!status.contains(&json!("clearance")), "{now}");
}

#[test]
fn invalid_requests_are_reported() {
    let rig = Rig::new();
    let none = rig.error(&["health"], 1);
    assert!(none.contains("does not watch this damper"), "{none}");
    let beyond = rig.error(&["health", "--place", "3"], 2);
    assert!(
        beyond.contains("--place 3: the target has 3 dampers"),
        "{beyond}"
    );
    let noise = rig.error(&["health", "--damper", "paper"], 2);
    assert!(noise.contains("--displacement-noise-m"), "{noise}");
    let wrong = [
        "health",
        "--damper",
        "paper",
        "--displacement-noise-m",
        "-1",
        "--force-noise-n",
        "60",
    ];
    let wrong = rig.error(&wrong, 2);
    assert!(
        wrong.contains("--displacement-noise-m -1: allowed: 1e-9 to 1e-2 m"),
        "{wrong}"
    );
    rig.write("run.csv", "time_s,displacement_m\n0,0\n");
    let force = rig.error(&["health", "--input", "run.csv"], 1);
    assert!(force.contains("force_n"), "{force}");
}
