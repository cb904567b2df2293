//! A wrong option ends any command with exit code 2, a bad file with exit code 1; both leave no file.

use predicates::prelude::PredicateBooleanExt;
use predicates::str::{contains, starts_with};

use crate::common::{dashpot, files_in};

const MOTION: &str = "time_s,displacement_m\n0,0\n1,1\n";

const BAD_DAMPER: &str = "[mount]\nstiffness_n_per_m = -1\n\
                          [reduced]\ndamping_n_s_per_m = 1e5\nsaturation_velocity_m_per_s = 0.03\n";

const REPLAY: [&str; 5] = ["replay", "--input", "in.csv", "--output", "out.csv"];
const VERIFY: [&str; 3] = ["verify", "--input", "in.csv"];
const PIL: [&str; 5] = ["pil", "--input", "in.csv", "--link", "tcp:localhost:1"];
const EXPORT: [&str; 3] = ["export", "--output", "damper"];

/// Runs `command` with `options` in a folder with a good recording, an invalid damper file and a text file that is not
/// a recording.
fn check(command: &[&str], options: &[&str], code: i32, part: &'static str) {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    std::fs::write(at("in.csv"), MOTION).unwrap();
    std::fs::write(at("bad.toml"), BAD_DAMPER).unwrap();
    std::fs::write(at("bad.csv"), "a,b\n0,0\n").unwrap();
    dashpot(&[command, options].concat(), folder.path())
        .code(code)
        .stdout("")
        .stderr(starts_with("error: ").and(contains(part)));
    assert_eq!(files_in(folder.path()), ["bad.csv", "bad.toml", "in.csv"]);
}

fn wrong_use(command: &[&str], options: &[&str], part: &'static str) {
    check(command, options, 2, part);
}

fn failed(command: &[&str], options: &[&str], part: &'static str) {
    check(command, options, 1, part);
}

#[test]
fn unknown_commands_and_options() {
    wrong_use(&["nonsense"], &[], "unrecognized subcommand");
    wrong_use(&["--outptu", "x.html"], &[], "unexpected argument");
    wrong_use(&["--format", "xml"], &[], "possible values: text, json");
    wrong_use(&["replay"], &[], "required arguments");
    wrong_use(&["rig", "--amplitude"], &[], "--amplitude");
    for command in [
        "replay", "rig", "response", "verify", "shims", "budget", "export", "contact", "pil",
        "link", "channels", "live",
    ] {
        wrong_use(
            &[command],
            &["--format", "xml"],
            "possible values: text, json",
        );
    }
}

#[test]
fn recording_formats() {
    for (options, part) in [
        (["--time-unit", "hours"], "allowed: s, ms, us, ns, min"),
        (["--displacement-unit", "N"], "allowed: m, cm, mm, um, in"),
        (["--header", "maybe"], "allowed: yes, no"),
        (
            ["--encoding", "utf-9"],
            "allowed: a name of the Encoding Standard",
        ),
        (
            ["--separator", "dot"],
            "possible values: comma, semicolon, tab, spaces, bar",
        ),
        (["--decimal-mark", "dot"], "possible values: point, comma"),
    ] {
        wrong_use(&REPLAY, &options, part);
        wrong_use(&VERIFY, &options, part);
    }
    failed(&REPLAY, &["--time", "x"], "column x is missing");
    failed(&REPLAY, &["--group", "1"], "group `1` is missing");
}

#[test]
fn step_sizes() {
    let export: &[&str] = &[&EXPORT[..], &["--lang", "bin"]].concat();
    for command in [&REPLAY[..], &VERIFY, export, &["rig"]] {
        for value in ["0", "0.9999", "20001", "-5", "nan", "inf", "1e3us", ""] {
            wrong_use(command, &["--step-us", value], "allowed: 1 to 20000 us");
        }
    }
    wrong_use(
        &REPLAY,
        &["--realtime", "--step-us", "62.5"],
        "allowed: 100 to 1000 us",
    );
    wrong_use(&REPLAY, &["--fifo", "10"], "require --realtime");
}

#[test]
fn dampers() {
    let export: &[&str] = &[&EXPORT[..], &["--lang", "bin"]].concat();
    let every: [&[&str]; 9] = [
        &REPLAY,
        &VERIFY,
        &PIL,
        export,
        &["rig"],
        &["rig", "--sheet", "example"],
        &["response", "--points", "2"],
        &["shims", "--no-plots"],
        &["budget", "--steps", "1"],
    ];
    for command in every {
        wrong_use(command, &["--damper", "papr"], "did you mean `paper`");
        failed(
            command,
            &["--damper", "none.toml"],
            "none.toml: cannot read",
        );
        failed(command, &["--damper", "./none"], "./none: cannot read");
        failed(
            command,
            &["--damper", "bad.toml"],
            "bad.toml: mount.stiffness",
        );
        for (set, part) in [
            ("mount.clearence_m=1e-3", "did you mean `clearance_m`"),
            ("mount.stiffness_n_per_m=-1", "mount.stiffness_n_per_m = -1"),
            ("mount.stiffness_n_per_m", "no `=`"),
            ("mount.clearance_m=wide", "expected table.key=value"),
            (
                "geometry.rod_diameter_m=0.07",
                "0 to 0.95 of piston_diameter_m",
            ),
            (
                "valves.foot_compression.clamp_radius_m=0.2",
                "below free_radius_m",
            ),
        ] {
            wrong_use(command, &["--set", set], part);
        }
        // The file is at fault, not the options that override it.
        let options = ["--damper", "bad.toml", "--set", "mount.clearance_m=1e-3"];
        failed(command, &options, "bad.toml: ");
    }
}

#[test]
fn recordings() {
    for command in [
        &["replay", "--output", "out.csv"][..],
        &["verify"],
        &PIL[..1],
    ] {
        let command = match command {
            ["pil"] => &["pil", "--link", "tcp:localhost:1"],
            other => other,
        };
        failed(command, &["--input", "none.csv"], "none.csv: cannot read");
        failed(command, &["--input", "."], "it is a folder");
        failed(command, &["--input", "bad.csv"], "column time_s is missing");
    }
    let onto_itself = ["--input", "in.csv", "--output", "in.csv"];
    wrong_use(
        &["replay"],
        &onto_itself,
        "--output in.csv: this is also an input file",
    );
    failed(
        &["replay", "--input", "in.csv"],
        &["--output", "none/out.csv"],
        "there is no folder none",
    );
}

#[test]
fn shims_as_plates() {
    let shims = ["shims", "--fe"];
    for (options, part) in [
        (
            &["--pressure-pa", "0"][..],
            "allowed: above 0 and at most 1e12 Pa",
        ),
        (&["--pressure-pa", "1e6,nan"], "allowed: above 0"),
        (&["--allowable-stress-pa", "-1"], "allowed: above 0"),
        (&["--loaded-radii-m", "0.02,0.025"], "--valve"),
        (&["--valve", "piston"], "possible values: piston-extension"),
    ] {
        wrong_use(&shims, options, part);
    }
    wrong_use(&["shims"], &["--bonded"], "--fe");
    let valve = ["shims", "--fe", "--valve", "piston-extension"];
    for (options, part) in [
        (
            &["--loaded-radii-m", "0.02"][..],
            "allowed: two radii in m separated by a comma",
        ),
        (
            &["--loaded-radii-m", "0.025,0.02"],
            "--loaded-radii-m: 0.025 to 0.02 m, allowed: rising, within the free part of the disc, 0.016 to 0.029 m",
        ),
        (&["--loaded-radii-m", "0.01,0.02"], "0.016 to 0.029 m"),
        (&["--loaded-radii-m", "nan,0.02"], "--loaded-radii-m: NaN"),
        (
            &[
                "--loaded-radii-m",
                "0.02,0.025",
                "--decay-radii-m",
                "0.021,0.029",
            ],
            "--decay-radii-m: 0.021 to 0.029 m, allowed: around the loaded radii",
        ),
        (&["--decay-radii-m", "0.02,0.03"], "--loaded-radii-m"),
        (
            &["--loaded-radii-m", "0.02,0.025", "--decay-exponent", "0"],
            "--decay-exponent: 0, allowed: above 0 and at most 10",
        ),
        (&["--decay-exponent", "2"], "--decay-exponent requires"),
        (&["--bosses", "6"], "--bosses requires --boss-share, or"),
        (
            &["--bosses", "37", "--boss-share", "0.5"],
            "--bosses: 37, allowed: 1 to 36",
        ),
        (
            &["--bosses", "0", "--boss-share", "0.5"],
            "--bosses: 0, allowed",
        ),
        (&["--bosses", "-1", "--boss-share", "0.5"], "--bosses"),
        (
            &["--bosses", "6", "--boss-share", "1.5"],
            "--boss-share: 1.5, allowed: above 0 and at most 1",
        ),
        (&["--boss-share", "0.5"], "--bosses"),
        (
            &["--bosses", "6", "--boss-radius-m", "0.005"],
            "--pitch-radius-m",
        ),
        (
            &[
                "--bosses",
                "6",
                "--boss-radius-m",
                "0.007",
                "--pitch-radius-m",
                "0.0225",
            ],
            "--boss-radius-m: 0.007 m, allowed: above 0 and at most 0.006500 m",
        ),
        (
            &[
                "--bosses",
                "6",
                "--boss-radius-m",
                "0.001",
                "--pitch-radius-m",
                "0.016",
            ],
            "--pitch-radius-m: 0.016 m, allowed: between 0.016 and 0.029 m",
        ),
        (
            &[
                "--bosses",
                "6",
                "--boss-radius-m",
                "0.005",
                "--pitch-radius-m",
                "0.0225",
                "--hole-radius-m",
                "0.006",
            ],
            "--hole-radius-m: 0.006 m, allowed: 0 to the boss radius, 0.005 m",
        ),
    ] {
        wrong_use(&valve, options, part);
    }
}

#[test]
fn verify_and_pil() {
    for value in ["0", "-1", "nan", "inf", "small"] {
        wrong_use(&VERIFY, &["--at-most", value], "allowed: a number above 0");
    }
    wrong_use(&PIL[..3], &["--link", "usb"], "allowed: tcp:HOST:PORT");
    wrong_use(
        &PIL,
        &["--faults", "flood=1"],
        "is not a fault; allowed: drop",
    );
    wrong_use(&PIL, &["--faults", "drop=2"], "not within 0 to 0.5");
    for (option, value) in [
        ("--ticks", "0"),
        ("--timeout-ms", "0"),
        ("--tries", "1001"),
        ("--baud", "0"),
        ("--seed", "x"),
    ] {
        wrong_use(&PIL, &[option, value], option);
    }
}

#[test]
fn rig() {
    for (options, part) in [
        (
            &["--amplitude-m", "0"][..],
            "--amplitude-m: 0, allowed: above 0",
        ),
        (&["--frequency-hz", "nan"], "--frequency-hz: NaN, allowed"),
        (&["--frequency-hz", "fast"], "--frequency-hz"),
        (&["--frequency-hz", "900"], "allowed: 20 to 2e7"),
        (
            &["--amplitude-m", "0.5", "--frequency-hz", "10"],
            "limits.rate_m_per_s",
        ),
    ] {
        wrong_use(&["rig"], options, part);
    }
}

#[test]
fn budget() {
    for (options, part) in [
        (&["--rate-hz", "999"][..], "1000..=10000"),
        (&["--steps", "0"], "1..="),
        (&["--dampers", "0"], "1..=10000"),
        (&["--fifo", "100"], "1..=99"),
        #[cfg(target_os = "linux")]
        (
            &["--core", "1000000"],
            "--core 1000000: this process may not use this core; allowed: ",
        ),
    ] {
        wrong_use(&["budget"], options, part);
    }
}

#[test]
fn export() {
    wrong_use(&EXPORT, &["--lang", "ada"], "possible values: rust, c, bin");
    wrong_use(
        &EXPORT,
        &["--lang", "rust", "--name", "fn"],
        "allowed: A to Z first",
    );
    wrong_use(
        &EXPORT,
        &["--lang", "c", "--name", "9X"],
        "allowed: A to Z first",
    );
    wrong_use(
        &EXPORT,
        &["--lang", "c", "--name", "INT32_MAX"],
        "allowed: names other than NULL",
    );
    wrong_use(
        &EXPORT,
        &["--lang", "c", "--scalar", "f64"],
        "allowed with --lang c: f32, or f64 with --standalone",
    );
    for lang in ["rust", "bin"] {
        wrong_use(
            &EXPORT,
            &["--lang", lang, "--standalone"],
            "allowed: --lang c",
        );
    }
    let health = ["--health", "--displacement-noise-m", "6e-5"];
    wrong_use(
        &EXPORT,
        &[&["--lang", "c", "--standalone"][..], &health].concat(),
        "cannot be used with",
    );
    for name in ["int", "double", "A-B", "_X", "\u{c4}", "DASHPOT_X"] {
        wrong_use(
            &EXPORT,
            &["--lang", "c", "--standalone", "--name", name],
            "allowed: ",
        );
    }
    wrong_use(
        &EXPORT,
        &["--lang", "bin", "--name", "X"],
        "allowed: --lang rust or c",
    );
    let nowhere = ["export", "--lang", "rust", "--output", "none/such.rs"];
    failed(&nowhere, &[], "none/such.rs: cannot write");
}

#[test]
fn contact() {
    let contact = ["contact", "--no-plots"];
    for (options, part) in [
        (
            &["--wheel", "s1003"][..],
            "s1003: no such profile, allowed: s1002",
        ),
        (
            &["--rail", "uic61"],
            "uic61: no such profile, allowed: uic60",
        ),
        (&["--gauge-m", "1.2"], "allowed: 0.03 to 0.12 m"),
        (&["--gauge-m", "nan"], "gauge: NaN, allowed: 0.5 to 2"),
        (
            &["--wheel-radius-m", "1e9"],
            "wheel radius: 1000000000, allowed: 0.1 to 1",
        ),
        (&["--wheel-radius-m", "large"], "--wheel-radius-m"),
        (
            &["--smoothing-m", "-1"],
            "--smoothing-m: -1, allowed: 0 to 0.05 m",
        ),
        (
            &["--smoothing-m=1"],
            "--smoothing-m: 1, allowed: 0 to 0.05 m",
        ),
        (
            &["--rail-format", "vampire"],
            "possible values: columns, miniprof, simpack, gensys",
        ),
        (&["--wheel-mirror", "x"], "possible values: none, y, z, yz"),
        (
            &["--wheel-format", "miniprof"],
            "s1002 is built in; a format or mirror is allowed for profile files only",
        ),
        (&["--load-kn", "0"], "--load-kn: 0, allowed: 1 to 400 kN"),
        (
            &["--load-kn", "nan"],
            "--load-kn: NaN, allowed: 1 to 400 kN",
        ),
        (
            &["--load-kn", "100", "--lateral-mm", "0,13"],
            "--lateral-mm: 13, allowed: -12 to 12 mm",
        ),
        (
            &["--load-kn", "100", "--yaw-mrad", "-60"],
            "--yaw-mrad: -60, allowed: -50 to 50 mrad",
        ),
        (
            &["--load-kn", "100", "--speed-km-h", "0"],
            "--speed-km-h: 0, allowed: 3.6 to 720 km/h",
        ),
        (
            &["--load-kn", "100", "--friction", "1.2"],
            "--friction: 1.2, allowed: 0.01 to 1",
        ),
        (&["--friction", "0.3"], "--load-kn <LOAD_KN>"),
        (&["--lateral-mm", "3"], "--load-kn <LOAD_KN>"),
        (
            &["--left-wheel", "s1003"],
            "s1003: no such profile, allowed: s1002",
        ),
        (&["--left-rail-mirror", "y"], "--left-rail <NAME|FILE>"),
        (&["--rail", "-", "--left-rail", "-"], "--left-rail"),
    ] {
        wrong_use(&contact, options, part);
    }
    failed(&contact, &["--wheel", "none.csv"], "none.csv: cannot read");
    failed(&contact, &["--rail", "bad.csv"], "bad.csv: too few points");
}

#[cfg(not(feature = "parquet"))]
#[test]
fn features_missing_from_the_build_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let options = ["vehicle", "--case", "straight-180", "--parquet"];
    dashpot(&options, folder.path())
        .code(2)
        .stderr(contains("build dashpot-hil with the feature `parquet`"));
}

#[test]
fn a_live_run_that_cannot_start() {
    let live = ["live", "--case", "straight-180", "--listen", "127.0.0.1:0"];
    wrong_use(&["live"], &[], "no case: give --case");
    wrong_use(
        &live,
        &["--record", "run.csv"],
        "a name that ends with .mf4",
    );
    wrong_use(&live, &["--token", "short"], "12 to 128 of A-Z");
    wrong_use(
        &["live", "--case", "straight-180"],
        &["--listen", "here"],
        "invalid socket address",
    );
    wrong_use(
        &live,
        &["--hold-ticks", "1"],
        "--hold-ticks requires --outside",
    );
    failed(
        &live,
        &["--record", "no-folder/run.mf4"],
        "no-folder/run.mf4",
    );
    wrong_use(&live, &["--step-us", "2000"], "a paced step");
}
