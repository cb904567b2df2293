//! One calibration over several tests: temperatures, parameters of single tests, held-back recordings and the next
//! test. The recordings are those of the reference solver.

use dashpot_calibration::{
    Assumed, Calibrated, Calibration, HeldRig, LoopTest, PlannedTest, Recorded, Request,
};
use dashpot_core::CheckedParameters;
use dashpot_files::damper::{KeyedParameters, load};
use dashpot_files::harmonic::Harmonic;
use fastrand::Rng;

use crate::fits::{recorded, with};

const STEP_S: f64 = 5e-4;

const DISCHARGE: &str = "orifice.discharge_coefficient";

const STIFFNESS: &str = "mount.stiffness_n_per_m";

/// Amplitude (m) and frequency (Hz).
const SLOW: (f64, f64) = (24.875e-3, 0.64);
const FAST: (f64, f64) = (24.665e-3, 1.9);

fn truth(temperature_c: f64) -> CheckedParameters {
    with(
        "in-service",
        [DISCHARGE, "oil.temperature_c"],
        [0.62, temperature_c],
    )
}

fn record(temperature_c: f64, motion: (f64, f64), seed: u64) -> Recorded {
    recorded(
        &truth(temperature_c),
        motion,
        0.02,
        &mut Rng::with_seed(seed),
    )
}

fn test(recorded: &Recorded, temperature_c: Option<f64>) -> LoopTest {
    let mut tests = LoopTest::from_recording(recorded, STEP_S).unwrap();
    let mut test = tests.remove(0);
    test.temperature_c = temperature_c;
    test
}

/// Returns a calibration of `in-service` with these parameters for all tests, and these for each.
fn calibration(loops: Vec<LoopTest>, keys: &[&str], each: &[&str]) -> Calibration {
    let damper = KeyedParameters::new("start", &load("in-service", &[]).unwrap()).unwrap();
    let all = |keys: &[&str]| keys.iter().map(|key| ((*key).to_owned(), None)).collect();
    let request = Request {
        vary: all(keys),
        vary_each: all(each),
        ..Request::default()
    };
    request.check(&damper).unwrap();
    let (varied, rig) = request.varied(&damper, &loops).unwrap();
    assert_eq!(rig, HeldRig::default());
    Calibration {
        damper,
        varied,
        loops,
        indices: Vec::new(),
        step_s: STEP_S,
        starts: 1,
        rig,
        assumed: Assumed::default(),
    }
}

fn value(calibration: &Calibration, found: &Calibrated, key: &str) -> f64 {
    let at = calibration
        .varied
        .iter()
        .position(|varied| varied.key == key);
    found.values[at.unwrap()]
}

#[test]
fn each_recording_has_its_oil_temperature() {
    let recordings = [record(40.0, SLOW, 1), record(-15.0, FAST, 2)];
    let found = |temperatures_c: [Option<f64>; 2]| {
        let loops = recordings.iter().zip(temperatures_c);
        let loops = loops.map(|(recorded, temperature_c)| test(recorded, temperature_c));
        let calibration = calibration(loops.collect(), &[DISCHARGE], &[]);
        let found = calibration.run(&|_| {}).unwrap();
        value(&calibration, &found, DISCHARGE)
    };
    let (told, untold) = (found([Some(40.0), Some(-15.0)]), found([None; 2]));
    println!("discharge 0.62: {told} with temperatures, {untold} without");
    assert!((told / 0.62 - 1.0).abs() < 0.01, "{told}");
    assert!(
        (untold / 0.62 - 1.0).abs() > 2.0 * (told / 0.62 - 1.0).abs(),
        "{untold}"
    );
}

#[test]
fn a_parameter_may_belong_to_each_test() {
    let offsets_n = [300.0, -200.0];
    let mut loops = Vec::new();
    for (offset_n, (motion, seed)) in offsets_n.iter().zip([(SLOW, 3), (FAST, 4)]) {
        let mut recorded = record(40.0, motion, seed);
        recorded
            .forces_n
            .iter_mut()
            .for_each(|force| *force += offset_n);
        loops.push(test(&recorded, Some(40.0)));
    }
    let calibration = calibration(loops, &[DISCHARGE], &["force_offset_n"]);
    let found = calibration.run(&|_| {}).unwrap();
    for (number, offset_n) in (1..).zip(offsets_n) {
        let found_n = value(&calibration, &found, &format!("force_offset_n@{number}"));
        assert!((found_n - offset_n).abs() < 30.0, "{number}: {found_n}");
    }
    assert!((value(&calibration, &found, DISCHARGE) / 0.62 - 1.0).abs() < 0.01);
    // The offset that all tests would share is not varied.
    assert!(
        calibration
            .varied
            .iter()
            .all(|varied| varied.key != "force_offset_n")
    );
}

#[test]
fn a_recording_that_was_held_back_is_predicted() {
    let loops = vec![test(&record(40.0, SLOW, 5), Some(40.0))];
    let calibration = calibration(loops, &[DISCHARGE], &[]);
    let found = calibration.run(&|_| {}).unwrap();
    let same = record(40.0, FAST, 6);
    let mut other = same.clone();
    // A difference of 8 % at large forces only, as of a valve that opens too late.
    other
        .forces_n
        .iter_mut()
        .for_each(|force| *force += 0.08 * (force.abs() - 5e3).max(0.0) * force.signum());
    let tests = [same, other].map(|recorded| test(&recorded, Some(40.0)));
    let [same, other] = calibration
        .predicted(&found, tests.to_vec())
        .unwrap()
        .try_into()
        .unwrap();
    println!(
        "{:?} {:?}",
        (same.error_share, same.systematic),
        (other.error_share, other.systematic)
    );
    assert!(same.error_share < 0.02, "{}", same.error_share);
    assert!(other.error_share > 0.03, "{}", other.error_share);
    let systematic = other.systematic.unwrap();
    assert!(systematic.difference_n.abs() > 500.0, "{systematic:?}");
    assert!(systematic.velocity_m_per_s.abs() > 0.1, "{systematic:?}");
}

/// Does the planned test, and compares the narrower intervals with what was promised.
#[test]
fn the_next_test_narrows_the_intervals_as_promised() {
    let slow = || test(&record(40.0, SLOW, 7), Some(40.0));
    let keys = [DISCHARGE, STIFFNESS];
    let before = calibration(vec![slow()], &keys, &[]);
    let found = before.run(&|_| {}).unwrap();
    let planned = |name: &str, (amplitude_m, frequency_hz)| PlannedTest {
        name: name.into(),
        motion: Harmonic {
            amplitude_m,
            frequency_hz,
        },
        temperature_c: Some(40.0),
    };
    let tests = [planned("slow again", SLOW), planned("fast", FAST)];
    let promises = before.promises(&found, &tests).unwrap();
    println!("{promises:?}");
    let share = |test: usize, parameter: usize| promises[test].shares[parameter].1;
    // The stiffness shows where the force changes fast.
    assert!(share(1, 1) < share(0, 1) && share(0, 1) < 0.95);
    let after = calibration(
        vec![slow(), test(&record(40.0, FAST, 8), Some(40.0))],
        &keys,
        &[],
    );
    let narrowed = after.run(&|_| {}).unwrap();
    for (parameter, key) in keys.iter().enumerate() {
        let deviation =
            |found: &Calibrated| found.determination.parameters[parameter].standard_deviation;
        let done = deviation(&narrowed) / deviation(&found);
        println!(
            "{key}: {done} of the deviation, {} promised",
            share(1, parameter)
        );
        assert!(
            (0.5..2.0).contains(&(done / share(1, parameter))),
            "{key}: {done}"
        );
    }
}
