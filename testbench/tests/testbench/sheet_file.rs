//! Sheet files: parsing, results of their tests, and errors with file, line and name.

use std::f64::consts::TAU;

use dashpot_files::damper;
use dashpot_files::sheet::Index;
use dashpot_files::sheet::{SHEETS, SheetFileError, SheetParameters};
use dashpot_testbench::bench_sheet;
use dashpot_testbench::bench_test::run_until_periodic;

const TEST: &str = "title = \"sheet\"\n\n[[test]]\nname = \"one\"\namplitude_m = 10e-3\n";

fn parse(text: &str) -> Result<SheetParameters, SheetFileError> {
    SheetParameters::parse("sheet.toml", text)
}

/// A complete test with additional keys.
fn with(keys: &str) -> String {
    format!("{TEST}frequency_hz = 1\n{keys}\n")
}

#[test]
fn two_of_amplitude_frequency_and_velocity_define_a_motion() {
    for keys in [
        "amplitude_m = 10e-3\nfrequency_hz = 2",
        "amplitude_m = 10e-3\nvelocity_m_per_s = 0.12566370614359174",
        "frequency_hz = 2\nvelocity_m_per_s = 0.12566370614359174",
    ] {
        let text = format!("title = \"t\"\n[[test]]\nname = \"n\"\n{keys}\n");
        let motion = parse(&text).unwrap().tests[0].motion;
        assert!((motion.amplitude_m - 10e-3).abs() < 1e-15, "{keys}");
        assert!((motion.frequency_hz - 2.0).abs() < 1e-12, "{keys}");
    }
}

#[test]
fn the_shipped_sheets_cite_no_standard() {
    for (name, text) in SHEETS {
        let sheet = SheetParameters::parse(name, text).unwrap();
        for limit in sheet.tests.iter().flat_map(|test| &test.limits) {
            let clause = limit.clause.as_deref().unwrap();
            assert_eq!(clause, "example, not from a standard", "{name}");
        }
    }
}

/// Spring in series with a dashpot: `K' = K r^2/(1 + r^2)`, `K'' = K r/(1 + r^2)`, `r = w C/K`; at mid-stroke the force
/// is `A K''`.
#[test]
fn indices_are_those_of_a_maxwell_element() {
    let (c, k) = (120e3, 8e6);
    let overrides = [
        "mount.clearance_m=0.0",
        "reduced.saturation_velocity_m_per_s=1.0",
    ];
    let damper = damper::load("reduced-vertical", &overrides.map(str::to_owned)).unwrap();
    // The last case has an odd number of steps per cycle.
    for (frequency_hz, step_s) in [(1.0, 1e-4), (8.0, 1e-4), (8.0, 0.125 / 1001.0)] {
        let text = format!("{TEST}frequency_hz = {frequency_hz}\n");
        let sheet = parse(&text).unwrap();
        let tested = bench_sheet::run(&sheet, "maxwell", &damper, step_s).unwrap();
        let ratio = TAU * frequency_hz * c / k;
        let stiffness = k * ratio / (1.0 + ratio * ratio).sqrt();
        let loss = k * ratio / (1.0 + ratio * ratio);
        let expected = |index| match index {
            Index::MaxExtensionForceN | Index::MaxCompressionForceN => 10e-3 * stiffness,
            Index::ExtensionForceAtPeakVelocityN | Index::CompressionForceAtPeakVelocityN => {
                10e-3 * loss
            }
            Index::AsymmetryRate => 0.0,
            Index::EnergyPerCycleJ => std::f64::consts::PI * 1e-4 * loss,
            Index::DampingCoefficientNSPerM => stiffness / (TAU * frequency_hz),
            Index::DynamicStiffnessNPerM => stiffness,
            Index::LossAngleDeg => (1.0 / ratio).atan().to_degrees(),
        };
        for (index, value) in tested[0].values() {
            let (value, expected) = (value.unwrap(), expected(index));
            let error = (value - expected).abs() / expected.abs().max(1.0);
            assert!(
                error < 1e-3,
                "{frequency_hz} Hz, {index}: {value} for {expected}"
            );
        }
    }
}

#[test]
fn a_test_runs_at_its_own_temperature_or_that_of_the_damper() {
    let sheet = parse(&with(
        "[[test]]\nname = \"cold\"\namplitude_m = 10e-3\nfrequency_hz = 1\ntemperature_c = -20",
    ))
    .unwrap();
    let load = |overrides: &[String]| damper::load("in-service", overrides).unwrap();
    let tested = bench_sheet::run(&sheet, "in-service", &load(&[]), 1e-4).unwrap();
    let cold = load(&["oil.temperature_c=-20.0".into()]);
    for (tested, damper, temperature_c) in
        [(&tested[0], load(&[]), 45.0), (&tested[1], cold, -20.0)]
    {
        assert_eq!(tested.temperature_c, Some(temperature_c));
        let expected = run_until_periodic(&damper, tested.test.motion, 1e-4).unwrap();
        assert_eq!(tested.cycle, expected);
    }
    assert_ne!(tested[0].cycle.forces_n, tested[1].cycle.forces_n);
}

#[test]
fn limits_are_inclusive() {
    let limits = |keys: &str| {
        let text = with(&format!("[test.limits.energy_per_cycle_j]\n{keys}"));
        parse(&text).unwrap().tests[0].limits[0].clone()
    };
    let both = limits("least = 1\nmost = 2\nclause = \"5.3\"");
    assert_eq!(both.index, Index::EnergyPerCycleJ);
    assert_eq!(both.clause.as_deref(), Some("5.3"));
    for (value, kept) in [(0.9, false), (1.0, true), (2.0, true), (2.1, false)] {
        assert_eq!(both.is_kept(Some(value)), kept, "{value}");
    }
    assert!(limits("least = 1").is_kept(Some(1e9)));
    assert!(limits("most = 1").is_kept(Some(-1e9)));
    // An undefined value, such as the asymmetry of zero force, violates every limit.
    assert!(!both.is_kept(None));
}

#[test]
fn errors_have_file_line_and_name() {
    let limit = |keys: &str| with(&format!("[test.limits.max_extension_force_n]\n{keys}"));
    let cases = [
        (
            "title = \"t\"\n".to_owned(),
            "sheet.toml:1: no tests, allowed: one or more",
        ),
        (TEST.replace("title", "titel"), "line 1, column 1"),
        (TEST.replace("title", "titel"), "did you mean `title`?"),
        (
            TEST.to_owned(),
            "sheet.toml:3: test `one`: give exactly two of `amplitude_m`, `frequency_hz`",
        ),
        (
            with("velocity_m_per_s = 1"),
            "sheet.toml:3: test `one`: give exactly two of",
        ),
        (with("temprature_c = 1"), "did you mean `temperature_c`?"),
        (
            format!("{TEST}frequency_hz = -1\n"),
            "sheet.toml:3: test `one`: frequency: -1, allowed: above 0",
        ),
        (
            format!("{TEST}frequency_hz = nan\n"),
            "test `one`: frequency: NaN, allowed",
        ),
        (
            format!("{TEST}velocity_m_per_s = 0\n"),
            "velocity_m_per_s 0, allowed: above 0",
        ),
        (
            format!("{TEST}velocity_m_per_s = nan\n"),
            "velocity_m_per_s NaN, allowed: above 0",
        ),
        (
            with("[[test]]\nname = \"one\"\namplitude_m = 1\nfrequency_hz = 1"),
            "sheet.toml:7: duplicate test name `one`",
        ),
        (
            TEST.replace("\"one\"", "\"\""),
            "name of a test, allowed: one line",
        ),
        (
            limit("clause = \"5\""),
            "sheet.toml:7: test `one`: max_extension_force_n: give `least`, `most` or both",
        ),
        (
            limit("least = 2\nmost = 1"),
            "sheet.toml:7: test `one`: max_extension_force_n: `least` 2 is greater than `most` 1",
        ),
        (
            limit("least = -inf"),
            "max_extension_force_n: not finite, allowed: finite numbers",
        ),
        (limit("leats = 2"), "did you mean `least`?"),
        (
            with("[test.limits.max_extnsion_force_n]\nleast = 1"),
            "line 7, column 14",
        ),
        (
            with("[test.limits.max_extnsion_force_n]\nleast = 1"),
            "did you mean `max_extension_force_n`?",
        ),
        (with("[[field]]\nname = \"a\""), "missing field `text`"),
    ];
    for (text, expected) in cases {
        let message = parse(&text).unwrap_err().to_string();
        assert!(message.contains("sheet.toml"), "{message}");
        assert!(message.contains(expected), "{message}\nexpected {expected}");
    }
    let message = SheetParameters::load("exampel").unwrap_err().to_string();
    let expected = "sheet `exampel`: no such sheet or file; give a TOML file or a sheet: example; did you mean \
     `example`?";
    assert_eq!(message, expected);
}

/// The last test is invalid. If the tests were not all checked first, the first test would run.
#[test]
fn invalid_tests_are_reported_with_their_line_before_any_test_runs() {
    let second = |keys: &str| {
        with(&format!(
            "[[test]]\nname = \"two\"\namplitude_m = 10e-3\n{keys}"
        ))
    };
    let cases = [
        (
            "reduced-vertical",
            "frequency_hz = 1\ntemperature_c = 20",
            "test `two`: temperature_c: the reduced damper reduced-vertical has no oil; allowed: a damper with [oil]",
        ),
        (
            "in-service",
            "frequency_hz = 1\ntemperature_c = 200",
            "test `two`: temperature_c: in-service: oil.temperature_c = 200 is not allowed",
        ),
        (
            "in-service",
            "frequency_hz = 1\ntemperature_c = nan",
            "oil.temperature_c = NaN",
        ),
        (
            "in-service",
            "velocity_m_per_s = 3",
            "test `two`: the motion reaches 3.000 m/s, allowed",
        ),
        (
            "in-service",
            "frequency_hz = 1e-9",
            "test `two`: 1000000000",
        ),
    ];
    for (name, keys, expected) in cases {
        let sheet = parse(&second(keys)).unwrap();
        let damper = damper::load(name, &[]).unwrap();
        let error = bench_sheet::run(&sheet, name, &damper, 1e-4).unwrap_err();
        let message = error.to_string();
        assert!(message.starts_with("sheet.toml:7: "), "{message}");
        assert!(message.contains(expected), "{message}\nexpected {expected}");
    }
}

#[test]
fn a_nominal_value_with_its_tolerance_is_a_limit() {
    let limit = |keys: &str| {
        let sheet = parse(&with(&format!("[test.limits.asymmetry_rate]\n{keys}")))?;
        Ok::<_, SheetFileError>(sheet.tests[0].limits[0].clone())
    };
    let tolerance = limit("nominal = -0.2\ntolerance_percent = 10").unwrap();
    assert_eq!(
        (tolerance.min, tolerance.max),
        (Some(-0.22), Some(-0.18000000000000002))
    );
    assert_eq!(tolerance.nominal, Some(-0.2));
    for (keys, message) in [
        (
            "nominal = 1.0",
            "or `nominal` together with `tolerance_percent`",
        ),
        (
            "tolerance_percent = 5",
            "or `nominal` together with `tolerance_percent`",
        ),
        (
            "nominal = 1.0\ntolerance_percent = 5\nleast = 0.5",
            "give `least`, `most` or both",
        ),
        (
            "nominal = 1.0\ntolerance_percent = 0",
            "tolerance_percent 0, allowed: above 0, at most 1000",
        ),
        ("nominal = nan\ntolerance_percent = 5", "not finite"),
    ] {
        let error = limit(keys).unwrap_err().to_string();
        assert!(
            error.starts_with("sheet.toml:") && error.contains(message),
            "{keys}: {error}"
        );
    }
}

#[test]
fn tolerances_of_motions_and_temperatures_have_ranges() {
    let tolerance =
        |keys: &str| parse(&format!("{keys}\n{}", with(""))).map(|sheet| sheet.tolerance);
    let given = tolerance("motion_tolerance_percent = 2\ntemperature_tolerance_k = 10").unwrap();
    assert_eq!((given.motion_percent, given.temperature_k), (2.0, 10.0));
    let error = tolerance("motion_tolerance_percent = 60")
        .unwrap_err()
        .to_string();
    assert_eq!(
        error,
        "sheet.toml:1: motion_tolerance_percent 60, allowed: above 0, at most 50"
    );
}
