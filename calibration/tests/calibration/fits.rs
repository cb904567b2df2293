//! Calibration against synthetic tests with known parameters. The reference solver generates them; it shares no law
//! with the fitted model. Both signals have noise, and the recorded force has a delay.

use std::f64::consts::TAU;

use dashpot_calibration::{
    Assumed, Calibrated, Calibration, CalibrationError, HeldRig, IndexTest, LoopTest, Prior,
    Recorded, SKEW, Varied,
};
use dashpot_core::CheckedParameters;
use dashpot_files::damper::{KeyedParameters, load};
use dashpot_files::harmonic::Harmonic;
use dashpot_testbench::health::Noise;
use dashpot_testbench::verification::reference_forces;
use fastrand::Rng;

/// Sample interval of the synthetic recordings (s).
const INTERVAL_S: f64 = 1e-3;

/// Delay of the force in samples: 3 ms.
const DELAY: usize = 3;

/// Amplitude (m) and frequency (Hz) of the bench tests; peak velocities 0.013 to 0.29 m/s.
const MOTIONS: [(f64, f64); 5] = [
    (24.875e-3, 0.64),
    (24.665e-3, 1.9),
    (10e-3, 0.2),
    (5e-3, 2.0),
    (2e-3, 4.0),
];

/// Returns a synthetic bench recording of `damper`; `noise` is the standard deviation divided by the rms of each
/// signal.
pub(crate) fn recorded(
    damper: &CheckedParameters,
    (amplitude_m, frequency_hz): (f64, f64),
    noise: f64,
    rng: &mut Rng,
) -> Recorded {
    let motion = Harmonic {
        amplitude_m,
        frequency_hz,
    };
    let samples = (10.0 / INTERVAL_S) as usize;
    let x: Vec<f64> = (0..samples)
        .map(|sample| {
            let angle = TAU * motion.frequency_hz * sample as f64 * INTERVAL_S;
            motion.amplitude_m * angle.sin()
        })
        .collect();
    let forces = reference_forces(damper, INTERVAL_S, &x).unwrap();
    let noise = Noise::from_rms(noise, &x, &forces);
    let (x, forces) = noise.add_to(&x, &forces, rng.u64(..));
    Recorded {
        name: format!("{frequency_hz} Hz"),
        times_s: (DELAY..samples)
            .map(|sample| sample as f64 * INTERVAL_S)
            .collect(),
        displacements_m: x[DELAY..].to_vec(),
        forces_n: forces[..samples - DELAY].to_vec(),
    }
}

/// Returns a calibration that starts from `start`, with synthetic tests of the damper `truth`.
fn calibration(
    truth: &CheckedParameters,
    start: &CheckedParameters,
    keys: &[&str],
    (noise, seed): (f64, u64),
) -> Calibration {
    let step_s = 5e-4;
    let mut rng = Rng::with_seed(seed);
    let damper = KeyedParameters::new("start", start).unwrap();
    let loops = MOTIONS.iter().flat_map(|motion| {
        let recorded = recorded(truth, *motion, noise, &mut rng);
        LoopTest::from_recording(&recorded, step_s).unwrap()
    });
    let loops: Vec<LoopTest> = loops.collect();
    let varied = keys
        .iter()
        .map(|key| Varied::new(&damper, key, None, None).unwrap());
    let varied = varied
        .chain([Varied::skew(), Varied::force_offset(&loops)])
        .collect();
    Calibration {
        damper,
        varied,
        loops,
        indices: Vec::new(),
        step_s,
        starts: 2,
        rig: HeldRig::default(),
        assumed: Assumed::default(),
    }
}

fn value(calibration: &Calibration, found: &Calibrated, key: &str) -> f64 {
    let index = calibration
        .varied
        .iter()
        .position(|v| v.key == key)
        .unwrap();
    found.values[index]
}

/// Returns random true values: each start value times a ratio from 0.6 to 1.6.
fn truths<const N: usize>(starts: [f64; N], rng: &mut Rng) -> [f64; N] {
    starts.map(|start| start * (0.6 + rng.f64()))
}

pub(crate) fn with<const N: usize>(
    preset: &str,
    keys: [&str; N],
    values: [f64; N],
) -> CheckedParameters {
    let set = keys.into_iter().zip(values);
    let overrides: Vec<String> = set.map(|(key, value)| format!("{key}={value:?}")).collect();
    load(preset, &overrides).unwrap()
}

#[test]
fn parameters_of_a_physical_damper_are_recovered() {
    let start = load("in-service", &[]).unwrap();
    let keys = [
        "orifice.discharge_coefficient",
        "mount.stiffness_n_per_m",
        "mount.clearance_m",
    ];
    let mut rng = Rng::with_seed(11);
    for seed in 0..3 {
        let [discharge, stiffness, clearance_m] = truths([0.62, 6e6, 1e-3], &mut rng);
        let truth = with("in-service", keys, [discharge, stiffness, clearance_m]);
        let calibration = calibration(&truth, &start, &keys, (0.02, seed));
        let found = calibration.run(&|_| {}).unwrap();
        let value = |key| value(&calibration, &found, key);
        let relative = [
            value(keys[0]) / discharge - 1.0,
            value(keys[1]) / stiffness - 1.0,
        ];
        let (clearance_mm, skew_ms) = (
            (value(keys[2]) - clearance_m) * 1e3,
            value(SKEW) * 1e3 - 3.0,
        );
        println!("{relative:?}, 2a {clearance_mm} mm, skew {skew_ms} ms");
        assert!(
            relative.iter().all(|error| error.abs() < 0.03),
            "{relative:?}"
        );
        assert!(clearance_mm.abs() < 0.05 && skew_ms.abs() < 0.2);
    }
}

#[test]
fn parameters_of_a_reduced_damper_are_recovered() {
    let start = load("reduced-vertical", &[]).unwrap();
    let keys = [
        "reduced.damping_n_s_per_m",
        "reduced.saturation_velocity_m_per_s",
        "mount.stiffness_n_per_m",
        "mount.clearance_m",
    ];
    let mut rng = Rng::with_seed(5);
    for seed in 0..2 {
        let truths = truths([120e3, 0.05, 8e6, 1e-3], &mut rng);
        let truth = with("reduced-vertical", keys, truths);
        let calibration = calibration(&truth, &start, &keys, (0.02, seed));
        let found = calibration.run(&|_| {}).unwrap();
        let value = |key| value(&calibration, &found, key);
        let relative: Vec<f64> = (0..3).map(|n| value(keys[n]) / truths[n] - 1.0).collect();
        let clearance_mm = (value(keys[3]) - truths[3]) * 1e3;
        println!(
            "{truths:?}: {relative:?}, 2a {clearance_mm} mm, skew {} s",
            value(SKEW)
        );
        assert!(
            relative.iter().all(|error| error.abs() < 0.03),
            "{relative:?}"
        );
        assert!(clearance_mm.abs() < 0.05);
    }
}

#[test]
fn confounded_parameters_are_rejected_with_the_reason() {
    let damper = load("in-service", &[]).unwrap();
    let keys = ["orifice.diameter_m", "orifice.discharge_coefficient"];
    let mut calibration = calibration(&damper, &damper, &keys, (0.02, 1));
    // Without a transition the flow depends only on the product of the coefficient and the area.
    calibration.damper = {
        let turbulent = load("in-service", &["orifice.transition_reynolds=0.0".into()]).unwrap();
        KeyedParameters::new("turbulent", &turbulent).unwrap()
    };
    for varied in &mut calibration.varied {
        varied.prior = None;
    }
    let error = calibration.run(&|_| {}).err().unwrap();
    assert!(matches!(error, CalibrationError::Undetermined { .. }));
    let text = error.to_string();
    assert!(
        text.contains(
            "orifice.diameter_m: only in combination with `orifice.discharge_coefficient`"
        ),
        "{text}"
    );
    // The prior of the coefficient separates them.
    calibration.varied[1].prior = Some(Prior {
        mean: 0.72,
        standard_deviation: 0.02,
    });
    let found = calibration.run(&|_| {}).unwrap();
    let by_tests =
        |number: usize| found.profiles[number].is_determined_by_tests(&calibration.varied[number]);
    assert!(!by_tests(1) && by_tests(2));
    assert!(
        (found.values[1] / 0.72 - 1.0).abs() < 0.03,
        "{:?}",
        found.values
    );
    // Only the prior distinguishes the two.
    assert!(found.determination.correlation[0][1] < -0.98);
}

#[test]
fn a_parameter_without_effect_is_rejected() {
    let damper = load("in-service", &["relief.opening_pressure_pa=2e7".into()]).unwrap();
    let keys = ["relief.opening_pressure_pa", "mount.stiffness_n_per_m"];
    let calibration = calibration(&damper, &damper, &keys, (0.02, 1));
    let text = calibration.run(&|_| {}).err().unwrap().to_string();
    assert!(
        text.contains("relief.opening_pressure_pa: no force of these tests changes"),
        "{text}"
    );
    assert!(!text.contains("mount.stiffness"), "{text}");
}

#[test]
fn calibration_recovers_the_preset_and_table_5() {
    let keys = [
        (
            "valves.piston_extension.preload_pa",
            3.0e6,
            Some((3.0e6, 3e5)),
        ),
        (
            "valves.piston_compression.preload_pa",
            2.2e6,
            Some((2.2e6, 3e5)),
        ),
        (
            "valves.piston_extension.equivalent_pressure_factor",
            0.7,
            None,
        ),
        (
            "valves.piston_compression.equivalent_pressure_factor",
            1.0,
            None,
        ),
        ("orifice.diameter_m", 2e-3, Some((2e-3, 5e-5))),
    ];
    let start = keys.map(|(key, start, _)| format!("{key}={start:?}"));
    let damper = KeyedParameters::new("paper", &load("paper", &start).unwrap()).unwrap();
    let varied = keys.iter().map(|(key, _, prior)| {
        let prior = prior.map(|(mean, standard_deviation)| Prior {
            mean,
            standard_deviation,
        });
        Varied::new(&damper, key, None, prior).unwrap()
    });
    let table = concat!(env!("CARGO_MANIFEST_DIR"), "/../data/bench/table5.csv");
    let calibration = Calibration {
        varied: varied.collect(),
        damper: damper.clone(),
        loops: Vec::new(),
        indices: IndexTest::read(std::path::Path::new(table)).unwrap(),
        step_s: 5e-4,
        starts: 2,
        rig: HeldRig::default(),
        assumed: Assumed::default(),
    };
    let found = calibration.run(&|_| {}).unwrap();
    let preset = load("calibrated", &[]).unwrap();
    let shipped = KeyedParameters::new("calibrated", &preset).unwrap();
    for ((key, ..), found) in keys.iter().zip(&found.values) {
        let number = shipped.number(key).unwrap();
        assert!(
            (found / number - 1.0).abs() < 2e-3,
            "{key}: {found}, shipped {number}"
        );
    }
    // Indices of the reference solution over a periodic cycle.
    let indices = |amplitude_m: f64, frequency_hz: f64| {
        let (ticks, step_s) = (4000, 0.00025 / frequency_hz);
        let x: Vec<f64> = (0..=3 * ticks)
            .map(|tick| amplitude_m * (TAU * f64::from(tick) / f64::from(ticks)).sin())
            .collect();
        let forces = reference_forces(&preset, step_s, &x).unwrap();
        let cycle = 2 * ticks as usize..3 * ticks as usize;
        let extension = forces[cycle.clone()].iter().copied().fold(0.0, f64::max);
        let compression = -forces[cycle.clone()].iter().copied().fold(0.0, f64::min);
        let energy: f64 = cycle
            .map(|tick| 0.5 * (forces[tick] + forces[tick + 1]) * (x[tick + 1] - x[tick]))
            .sum();
        [extension, compression, energy]
    };
    for (here, published) in indices(24.875e-3, 0.64)
        .iter()
        .zip([13109.0, 12849.0, 1043.65])
    {
        assert!(
            (here / published - 1.0).abs() < 0.01,
            "{here} for {published}"
        );
    }
    let [extension, compression, _] = indices(24.665e-3, 1.9);
    assert!(
        extension < 25e3 && compression < 25e3,
        "{extension}, {compression}"
    );
}

#[test]
fn intervals_of_95_percent_contain_the_truth() {
    let keys = [
        "reduced.damping_n_s_per_m",
        "mount.stiffness_n_per_m",
        "mount.clearance_m",
    ];
    let truths = [110e3, 7e6, 0.8e-3];
    let truth = with("reduced-vertical", keys, truths);
    let start = load("reduced-vertical", &[]).unwrap();
    let damper = KeyedParameters::new("start", &start).unwrap();
    let (seeds, step_s) = (12, 2.5e-4);
    let mut within = [0; 4];
    for seed in 0..seeds {
        let mut rng = Rng::with_seed(100 + seed);
        let loops = [(10e-3, 0.8), (3e-3, 3.1)].iter().flat_map(|motion| {
            let recorded = recorded(&truth, *motion, 0.02, &mut rng);
            LoopTest::from_recording(&recorded, step_s).unwrap()
        });
        let loops: Vec<LoopTest> = loops.collect();
        let varied = keys
            .iter()
            .map(|key| Varied::new(&damper, key, None, None).unwrap());
        let calibration = Calibration {
            damper: damper.clone(),
            varied: varied
                .chain([Varied::skew(), Varied::force_offset(&loops)])
                .collect(),
            loops,
            indices: Vec::new(),
            step_s,
            starts: 1,
            rig: HeldRig::default(),
            assumed: Assumed::default(),
        };
        let found = calibration.run(&|_| {}).unwrap();
        let profiles = found.profiles.iter().zip(truths.iter().chain(&[3e-3]));
        for ((profile, truth), within) in profiles.zip(&mut within) {
            let [least, greatest] = [profile.lower.unwrap(), profile.upper.unwrap()];
            *within += usize::from((least..=greatest).contains(truth));
        }
    }
    println!("of {seeds}: {within:?}");
    // Once in 50 times, by chance, fewer than 10 of 12 such intervals contain the truth; fewer than 42 of 48 almost
    // never do.
    assert!(within.iter().sum::<usize>() >= 42, "{within:?}");
}
