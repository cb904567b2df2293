//! Steady motions in recordings, compared with the closed form of a spring beside a dashpot, `F = K x + C v`.

use std::f64::consts::TAU;

use dashpot_files::sheet::{Index, SheetParameters};
use dashpot_testbench::measured_sheet::{SheetRecording, assign};
use dashpot_testbench::steady::{Found, Samples, SensorUncertainty, SteadyMotion, Unused, find};
use fastrand::Rng;

const STIFFNESS_N_PER_M: f64 = 100e3;
const DAMPING_N_S_PER_M: f64 = 20e3;

/// A recording of a bench in memory.
#[derive(Default)]
struct Bench {
    times_s: Vec<f64>,
    displacements_m: Vec<f64>,
    forces_n: Vec<f64>,
}

/// A motion with its number of cycles; amplitude grows and falls over one cycle at either end.
#[derive(Clone, Copy)]
struct Motion {
    amplitude_m: f64,
    frequency_hz: f64,
    cycles: f64,
}

impl Bench {
    /// Adds a motion about `offset_m`, sampled at intervals around `interval_s`, after a pause. Force and displacement
    /// have noise of this share of their amplitudes, and the force of each cycle a factor of its own.
    fn add(&mut self, motion: Motion, offset_m: f64, interval_s: f64, noise: f64, rng: &mut Rng) {
        let Motion {
            amplitude_m,
            frequency_hz,
            cycles,
        } = motion;
        let w = TAU * frequency_hz;
        let start_s = self.times_s.last().map_or(0.0, |last| last + interval_s);
        let force_n = amplitude_m * STIFFNESS_N_PER_M.hypot(w * DAMPING_N_S_PER_M);
        let factors: Vec<f64> = (0..=cycles as usize)
            .map(|_| 1.0 + noise * normal(rng))
            .collect();
        let mut time_s = -0.4;
        while time_s < cycles / frequency_hz + 0.3 {
            let cycle = (time_s * frequency_hz).clamp(0.0, cycles);
            let ramp = cycle.min(cycles - cycle).min(1.0);
            let angle = TAU * cycle;
            let force = amplitude_m
                * (STIFFNESS_N_PER_M * angle.sin() + w * DAMPING_N_S_PER_M * angle.cos());
            self.times_s.push(start_s + 0.4 + time_s);
            let x = offset_m + ramp * amplitude_m * angle.sin();
            self.displacements_m
                .push(x + noise * amplitude_m * normal(rng));
            let force = ramp * force * factors[cycle as usize];
            self.forces_n.push(force + noise * force_n * normal(rng));
            time_s += interval_s * (1.0 + 0.2 * (rng.f64() - 0.5));
        }
    }

    fn found(&self) -> Found {
        find(Samples {
            times_s: &self.times_s,
            displacements_m: &self.displacements_m,
            forces_n: &self.forces_n,
        })
    }
}

/// A number from the standard normal distribution (Box and Muller).
fn normal(rng: &mut Rng) -> f64 {
    (-2.0 * (1.0 - rng.f64()).ln()).sqrt() * (TAU * rng.f64()).cos()
}

fn expected(index: Index, motion: Motion) -> Option<f64> {
    let w = TAU * motion.frequency_hz;
    let (k, c, a) = (STIFFNESS_N_PER_M, DAMPING_N_S_PER_M, motion.amplitude_m);
    let stiffness = k.hypot(w * c);
    Some(match index {
        Index::MaxExtensionForceN | Index::MaxCompressionForceN => a * stiffness,
        Index::ExtensionForceAtPeakVelocityN | Index::CompressionForceAtPeakVelocityN => a * w * c,
        Index::AsymmetryRate => 0.0,
        Index::EnergyPerCycleJ => std::f64::consts::PI * a * a * w * c,
        Index::DampingCoefficientNSPerM => stiffness / w,
        Index::DynamicStiffnessNPerM => stiffness,
        Index::LossAngleDeg => (w * c).atan2(k).to_degrees(),
    })
}

/// Unit in which an index is compared: its own size, or 1 for a rate and 90 for an angle.
fn size(index: Index, motion: Motion) -> f64 {
    match index {
        Index::AsymmetryRate => 1.0,
        Index::LossAngleDeg => 90.0,
        _ => expected(index, motion).unwrap(),
    }
}

fn worst_error(found: &SteadyMotion, motion: Motion) -> (f64, Index) {
    let errors = found.indices().map(|(index, estimate)| {
        let error = estimate.unwrap().value - expected(index, motion).unwrap();
        ((error / size(index, motion)).abs(), index)
    });
    errors
        .into_iter()
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .unwrap()
}

#[test]
fn indices_of_clean_recordings_are_those_of_the_closed_form() {
    let mut rng = Rng::with_seed(1);
    for run in 0..60 {
        let motion = Motion {
            amplitude_m: 10_f64.powf(-3.5 + 2.5 * rng.f64()),
            frequency_hz: 10_f64.powf(-1.0 + 2.0 * rng.f64()),
            cycles: 5.0 + 7.0 * rng.f64(),
        };
        let interval_s = 1.0 / motion.frequency_hz / (25.0 + 500.0 * rng.f64());
        let mut bench = Bench::default();
        bench.add(motion, 0.05 * (rng.f64() - 0.5), interval_s, 0.0, &mut rng);
        let found = bench.found();
        assert_eq!(found.motions.len(), 1, "{run}: {:?}", found.unused);
        let steady = &found.motions[0];
        assert!(
            steady.loops.len() as f64 >= motion.cycles.floor() - 3.0,
            "{run}"
        );
        let (error, index) = worst_error(steady, motion);
        assert!(error < 5e-3, "{run}: {index:?} {error}, {interval_s} s");
    }
}

/// Each cycle has its own factor, so an interval has to contain the truth in about 95 of 100 recordings.
#[test]
fn intervals_contain_the_truth() {
    let mut rng = Rng::with_seed(2);
    let motion = Motion {
        amplitude_m: 0.01,
        frequency_hz: 1.0,
        cycles: 10.0,
    };
    let runs = 200;
    let mut inside = 0;
    for _ in 0..runs {
        let mut bench = Bench::default();
        bench.add(motion, 0.0, 4e-3, 0.01, &mut rng);
        let found = bench.found();
        let indices = found.motions[0].indices();
        let (index, estimate) = indices[5];
        assert_eq!(index, Index::EnergyPerCycleJ);
        let estimate = estimate.unwrap();
        let error = estimate.value - expected(index, motion).unwrap();
        inside += usize::from(error.abs() <= estimate.half_width);
    }
    println!("{inside} of {runs} intervals of 95 % contain the energy");
    assert!((180..=199).contains(&inside), "{inside} of {runs}");
}

#[test]
fn several_motions_follow_each_other_in_one_recording() {
    let mut rng = Rng::with_seed(3);
    let motions = [(25e-3, 0.5), (25e-3, 2.0), (0.5e-3, 2.0), (0.5e-3, 8.0)];
    let motions = motions.map(|(amplitude_m, frequency_hz)| Motion {
        amplitude_m,
        frequency_hz,
        cycles: 8.0,
    });
    let mut bench = Bench::default();
    for motion in motions {
        bench.add(motion, 3e-3, 1e-3, 1e-4, &mut rng);
    }
    let found = bench.found();
    assert_eq!(found.motions.len(), motions.len(), "{:?}", found.unused);
    for (steady, motion) in found.motions.iter().zip(motions) {
        let measured = steady.mean.motion;
        assert!((measured.amplitude_m / motion.amplitude_m - 1.0).abs() < 2e-3);
        assert!((measured.frequency_hz / motion.frequency_hz - 1.0).abs() < 1e-3);
        assert!((steady.offset_m - 3e-3).abs() < 1e-4);
        assert!(steady.loops.len() >= 5);
    }
}

/// Samples whose force is their displacement.
fn samples<'a>(times_s: &'a [f64], displacements_m: &'a [f64]) -> Samples<'a> {
    Samples {
        times_s,
        displacements_m,
        forces_n: displacements_m,
    }
}

#[test]
fn cycles_that_are_no_sine_have_a_reason() {
    let times_s: Vec<f64> = (0..4000).map(|tick| f64::from(tick) * 2e-3).collect();
    let triangle = |time_s: &f64| 0.01 * (4.0 * (time_s.fract() - 0.5).abs() - 1.0);
    let displacements_m: Vec<f64> = times_s.iter().map(triangle).collect();
    let found = find(samples(&times_s, &displacements_m));
    assert!(found.motions.is_empty());
    assert!(
        found
            .unused
            .iter()
            .all(|cycles| cycles.reason == Unused::NotHarmonic)
    );
    // The same times with twelve samples per cycle of a sine.
    let sine = |tick: u32| (TAU * f64::from(tick) / 12.0).sin();
    let displacements_m: Vec<f64> = (0..4000).map(sine).collect();
    let found = find(samples(&times_s, &displacements_m));
    assert!(found.motions.is_empty());
    assert!(
        found
            .unused
            .iter()
            .all(|cycles| cycles.cycles == 1 || cycles.reason == Unused::FewSamples),
        "{:?}",
        found.unused
    );
    assert!(find(samples(&times_s, &vec![0.0; 4000])).is_empty());
    assert!(find(samples(&[], &[])).is_empty());
    assert!(find(samples(&[1.0], &[1.0])).is_empty());
}

#[test]
fn the_first_cycles_of_a_damper_that_warms_up_are_left_out() {
    let period = 500;
    let times_s: Vec<f64> = (0..12 * period)
        .map(|tick| f64::from(tick) * 2e-3)
        .collect();
    let angle = |time_s: &f64| TAU * time_s;
    let displacements_m: Vec<f64> = times_s
        .iter()
        .map(|time_s| 0.01 * angle(time_s).sin())
        .collect();
    let force = |time_s: &f64| (1.0 + (-time_s).exp()) * angle(time_s).cos();
    let forces_n: Vec<f64> = times_s.iter().map(force).collect();
    let found = find(Samples {
        times_s: &times_s,
        displacements_m: &displacements_m,
        forces_n: &forces_n,
    });
    let steady = &found.motions[0];
    // After four seconds the force is within 2 % of its end.
    assert!(
        (3..=4).contains(&steady.unsteady_cycles),
        "{}",
        steady.unsteady_cycles
    );
    assert!(steady.force_change() < 0.0 && steady.force_change() > -0.02);
}

#[test]
fn the_uncertainty_of_a_sensor_adds_to_that_of_the_scatter() {
    let sensors = SensorUncertainty {
        force: 0.03,
        displacement: 0.04,
    };
    let estimate = dashpot_testbench::steady::Estimate {
        value: 100.0,
        half_width: 4.0,
    };
    let width = |index| sensors.widened(index, estimate).half_width;
    assert!((width(Index::MaxExtensionForceN) - 5.0).abs() < 1e-12);
    assert!((width(Index::EnergyPerCycleJ) - 41_f64.sqrt()).abs() < 1e-12);
    assert!((width(Index::LossAngleDeg) - 4.0).abs() < 1e-12);
}

const SHEET: &str = r#"title = "sheet"
[[test]]
name = "warm"
amplitude_m = 10e-3
frequency_hz = 1
temperature_c = 20
[[test]]
name = "cold"
amplitude_m = 10e-3
frequency_hz = 1
temperature_c = -20
[[test]]
name = "fast"
amplitude_m = 10e-3
frequency_hz = 1.08
[[test]]
name = "never"
amplitude_m = 1e-3
frequency_hz = 1
"#;

/// A recording of 10 mm at these frequencies.
fn recording(temperature_c: Option<f64>, frequencies_hz: &[f64]) -> SheetRecording {
    let mut bench = Bench::default();
    for frequency_hz in frequencies_hz {
        let motion = Motion {
            amplitude_m: 10e-3,
            frequency_hz: *frequency_hz,
            cycles: 7.0,
        };
        bench.add(motion, 0.0, 5e-3, 0.0, &mut Rng::with_seed(4));
    }
    SheetRecording {
        name: "run7".into(),
        temperature_c,
        found: bench.found(),
    }
}

fn names(sheet: &SheetParameters, recordings: &[SheetRecording]) -> Vec<String> {
    let assigned = assign(sheet, recordings).unwrap();
    assigned
        .measured
        .iter()
        .map(|(test, _)| test.name.clone())
        .collect()
}

#[test]
fn a_motion_belongs_to_the_nearest_test_at_its_temperature() {
    let sheet = SheetParameters::parse("sheet.toml", SHEET).unwrap();
    assert_eq!(names(&sheet, &[recording(Some(22.0), &[1.02])]), ["warm"]);
    assert_eq!(names(&sheet, &[recording(Some(-24.0), &[1.02])]), ["cold"]);
    assert_eq!(names(&sheet, &[recording(Some(22.0), &[1.06])]), ["fast"]);
    assert_eq!(names(&sheet, &[recording(Some(40.0), &[1.04])]), ["fast"]);
    assert_eq!(names(&sheet, &[recording(None, &[1.1])]), ["fast"]);
    let cold_and_warm = [
        recording(Some(-20.0), &[1.0]),
        recording(Some(20.0), &[1.0, 3.0]),
    ];
    assert_eq!(names(&sheet, &cold_and_warm), ["warm", "cold"]);
    let assigned = assign(&sheet, &cold_and_warm).unwrap();
    let missing: Vec<&str> = assigned
        .missing
        .iter()
        .map(|test| test.name.as_str())
        .collect();
    assert_eq!(missing, ["fast", "never"]);
    assert_eq!(assigned.others.len(), 1);
    let error = assign(&sheet, &[recording(None, &[1.0])]).unwrap_err();
    assert!(
        error
            .to_string()
            .contains("tests at several oil temperatures: warm, cold"),
        "{error}"
    );
}
