//! `dashpot verify` without a recording: the largest errors for a damper over a fixed set of motions.

use predicates::str::contains;
use serde_json::Value;

use crate::common::{dashpot, json_of, text_of};

fn verify(more: &[&str]) -> assert_cmd::assert::Assert {
    let folder = tempfile::tempdir().unwrap();
    dashpot(&[&["verify"], more].concat(), folder.path())
}

fn number(row: &Value, key: &str) -> f64 {
    row[key].as_f64().unwrap_or(f64::NAN)
}

#[test]
fn each_step_and_scalar_has_its_largest_errors_and_promised_bounds() {
    let steps = ["--step-us", "1000", "--rate-hz", "500", "--rate-hz", "1000"];
    let more = [&["--damper", "in-service", "--format", "json"], &steps[..]].concat();
    let output = verify(&more).success();
    let report = json_of(&output);
    assert_eq!(number(&report, "top_speed_m_per_s"), 0.6);
    let factor = number(&report, "promised_factor");
    let rows = report["errors"].as_array().unwrap();
    let combinations: Vec<(String, f64)> = rows
        .iter()
        .map(|row| {
            (
                row["scalar"].as_str().unwrap().to_owned(),
                number(row, "step_s"),
            )
        })
        .collect();
    let expected = [("f64", 1e-3), ("f32", 1e-3), ("f64", 2e-3), ("f32", 2e-3)];
    assert_eq!(
        combinations,
        expected.map(|(scalar, step_s)| (scalar.to_owned(), step_s))
    );
    for row in rows {
        let [nrmse, error_n] = ["nrmse", "largest_error_n"].map(|key| number(row, key));
        assert!(nrmse > 1e-5 && nrmse < 0.1, "{row}");
        assert!(number(row, "promised_nrmse") >= factor * nrmse, "{row}");
        assert!(number(row, "promised_error_n") >= factor * error_n, "{row}");
        assert!(number(row, "largest_wrong_sign_n") >= 0.0, "{row}");
        assert!(row["nrmse_motion"]["kind"].is_string(), "{row}");
    }
    // Twice the step size has larger errors.
    assert!(number(&rows[2], "nrmse") > 1.5 * number(&rows[0], "nrmse"));
}

#[test]
fn an_nrmse_above_the_limit_fails_and_the_table_is_for_people() {
    let more = ["--damper", "reduced-vertical", "--step-us", "1000"];
    let output = verify(&[&more[..], &["--at-most", "1e-9"]].concat());
    let output = output.code(1).stderr(contains("is above --at-most"));
    let text = text_of(&output);
    for part in [
        "largest errors over a fixed set of motions",
        "wrong sign N",
        "Guaranteed",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
}

#[test]
fn options_are_refused_in_the_wrong_mode() {
    for (options, part) in [
        (&["--time", "t"][..], "require --input"),
        (
            &["--input", "in.csv", "--top-speed-m-per-s", "1"],
            "cannot be used with",
        ),
        (&["--top-speed-m-per-s", "5"], "limits.rate_m_per_s = 2 m/s"),
        (&["--top-speed-m-per-s", "0"], "allowed: a number above 0"),
        (&["--rate-hz", "10"], "allowed: 50 to 1e6 Hz"),
        (&["--rate-hz", "fast"], "allowed: 50 to 1e6 Hz"),
    ] {
        verify(options).code(2).stdout("").stderr(contains(part));
    }
}

/// A damper without any flow has no reference; the command reports this and guarantees nothing.
#[test]
fn a_damper_without_a_reference_is_refused() {
    let closed = [
        "paper",
        "orifice.diameter_m=0",
        "valves.piston_extension.preload_pa=1e8",
    ];
    let more = [
        "--damper", closed[0], "--set", closed[1], "--set", closed[2],
    ];
    verify(&more)
        .code(1)
        .stdout("")
        .stderr(contains("reference: "));
}
