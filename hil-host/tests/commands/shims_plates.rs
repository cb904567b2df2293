//! `dashpot shims --fe` as a command: Ce, stress, plots and options.

use std::path::Path;

use assert_cmd::assert::Assert;
use predicates::str::contains;
use serde_json::Value;

use crate::common::{dashpot, files_in, json_of, text_of};

fn plates(arguments: &[&str]) -> Assert {
    dashpot(&[&["shims", "--fe"], arguments].concat(), Path::new("."))
}

fn report(arguments: &[&str]) -> Value {
    let json = ["--no-plots", "--format", "json"];
    json_of(&plates(&[&json, arguments].concat()).success())["plates"].take()
}

fn near(value: &Value, expected: f64, fraction: f64) {
    let value = value.as_f64().unwrap();
    assert!(
        (value / expected - 1.0).abs() < fraction,
        "{value} for {expected}"
    );
}

/// The expected values are Ce from Tables 2 to 4, and the edge compliance (m/Pa) of the packs of Table 1, from disc
/// theory with their cubed thickness.
#[test]
fn the_papers_valves_have_areas_fitted_to_their_factors() {
    let report = report(&[]);
    let expected = [
        (0.2169, 0.4511e-9, "round"),
        (0.2000, 0.5650e-9, "round"),
        (0.8265, 0.04273e-9, "ring"),
    ];
    let valves = report["valves"].as_array().unwrap();
    assert_eq!(valves.len(), expected.len());
    for (valve, (factor, uniform, kind)) in valves.iter().zip(expected) {
        near(&valve["correction_factor"], factor, 1e-6);
        near(&valve["edge_lift"]["mean_m_per_pa"], factor * uniform, 2e-4);
        assert_eq!(valve["pressure_area"]["kind"], kind);
        assert_eq!(valve["pressure_area_is_given"], false);
    }
    // For sectors over the whole width, Ce equals their share of the circumference.
    let fits = |valve: usize, kind: &str| -> Vec<Value> {
        let all = valves[valve]["fits"].as_array().unwrap().iter();
        all.filter(|fit| fit["kind"] == kind).cloned().collect()
    };
    near(&fits(0, "sectors").last().unwrap()["share"], 0.2169, 1e-6);
    near(&fits(1, "sectors").last().unwrap()["share"], 0.2000, 1e-6);
    assert!(fits(0, "round_bosses").len() > 10);
    assert_eq!(fits(2, "decay").len(), 3);
    assert_eq!(fits(2, "decay_on_both_sides").len(), 3);
    // Over a boss, the edge lifts more than on average.
    let greatest = &valves[0]["correction_factor_of_greatest_lift"];
    assert!(greatest.as_f64().unwrap() > 0.22);
}

/// Computed by hand: the clamp's moment `K_M P r_w^2` bends sliding discs in proportion to their cubed thickness, so
/// the thickest has `s_r = 6 K_M P r_w^2 h/sum h^3`, and at a clamp `s_t = nu s_r`. The force limit of 50 kN acts on
/// the annulus between 69.8 and 28 mm in extension.
#[test]
fn stress_and_lift_of_a_given_area_agree_with_a_hand_calculation() {
    let report = report(&[
        "--valve",
        "piston-extension",
        "--loaded-radii-m",
        "0.016,0.029",
        "--pressure-pa",
        "1e6,2e6",
        "--allowable-stress-pa",
        "1e9",
    ]);
    let valve = &report["valves"][0];
    assert_eq!(valve["pressure_area_is_given"], true);
    near(&valve["correction_factor"], 1.0, 1e-6);
    let cubes = 3.0 * 0.405_f64.powi(3) + 4.0 * 0.410_f64.powi(3);
    let disc = dashpot_core::shim::Disc::new("disc", 16e-3, 29e-3, 2e11, 0.3).unwrap();
    let moment_n = disc.clamp_moment_coefficient() * 29e-3_f64.powi(2);
    let radial = 6.0 * moment_n * 0.410e-3 / (cubes * 1e-9);
    let von_mises = radial * (1.0 - 0.3 + 0.3_f64 * 0.3).sqrt();
    let stress = &valve["largest_stress"];
    near(&stress["von_mises_per_pressure"], von_mises, 1e-3);
    near(&stress["radius_m"], 16e-3, 1e-12);
    assert_eq!(stress["discs"], serde_json::json!([4, 5, 6, 7]));
    near(&valve["allowable_pressure_pa"], 1e9 / von_mises, 1e-3);
    let rows = valve["pressures"].as_array().unwrap();
    assert_eq!(rows.len(), 3);
    near(&rows[1]["mean_lift_m"], 2.0 * 0.4511e-3, 2e-4);
    near(&rows[1]["largest_stress_pa"], 2e6 * von_mises, 1e-3);
    assert_eq!(rows[1]["plate_theory_holds"], false);
    let annulus = std::f64::consts::FRAC_PI_4 * (0.0698_f64.powi(2) - 0.028_f64.powi(2));
    near(&rows[2]["pressure_pa"], 50e3 / annulus, 1e-9);
    assert_eq!(rows[2]["at_force_limit"], true);
}

/// A preload holds the edge down but has already bent the discs.
#[test]
fn a_preload_is_no_lift_but_stress() {
    let report = report(&[
        "--set",
        "valves.foot_compression.preload_pa=4e5",
        "--pressure-pa",
        "3e5,1e6",
    ]);
    let valve = &report["valves"][2];
    let rows = valve["pressures"].as_array().unwrap();
    assert_eq!(rows[0]["mean_lift_m"], 0.0);
    near(&rows[1]["mean_lift_m"], 0.6 * 0.8265 * 0.04273e-3, 2e-4);
    let ratio = rows[1]["largest_stress_pa"].as_f64().unwrap();
    near(&rows[0]["largest_stress_pa"], 0.3 * ratio, 1e-9);
}

#[test]
fn bonded_discs_act_as_one() {
    let third_valve = |report: Value| report["valves"][2].clone();
    let (sliding, bonded) = (third_valve(report(&[])), third_valve(report(&["--bonded"])));
    near(&sliding["equivalent_thickness_m"], 2.0 * 0.305e-3, 1e-9);
    near(&bonded["equivalent_thickness_m"], 8.0 * 0.305e-3, 1e-9);
    // s = 6 M/h^2 for one disc of 8 h, against M/8 on each disc of h.
    let stress = sliding["largest_stress"]["von_mises_per_pressure"].as_f64();
    near(
        &bonded["largest_stress"]["von_mises_per_pressure"],
        stress.unwrap() / 8.0,
        1e-6,
    );
    near(&bonded["correction_factor"], 0.8265, 1e-6);
}

#[test]
fn text_lists_area_factor_stress_and_the_validity_of_theory() {
    let output = plates(&["--no-plots"]).success();
    let text = text_of(&output);
    for part in [
        "on 6 round bosses at radius 22.500 mm",
        "(of an assumed kind, fitted to the Ce of the file)",
        "Ce 0.8265 from the mean edge lift",
        "deg from the centre of a boss, discs 4, 5, 6, 7 of the file",
        "full from 5.000 to 10.436 mm, decaying to zero at 11.000 mm with exponent 2",
        "at r 5.00 mm, at all angles",
        "at the force limit",
        "*: lift above half the thickness",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
    let few = plates(&[
        "--no-plots",
        "--pressure-pa",
        "1",
        "--set",
        "limits.force_n=1",
    ])
    .success();
    assert!(!text_of(&few).contains("*: lift above"));
}

#[test]
fn plots_draw_plates_and_the_chart() {
    let folder = tempfile::tempdir().unwrap();
    let plots = folder.path().join("plots");
    plates(&["--plots", plots.to_str().unwrap()]).success();
    for (name, width, words) in [
        (
            "plate-deflection.svg",
            1440,
            &["over a boss", "between bosses"][..],
        ),
        (
            "plate-edge.svg",
            1440,
            &["mean: Ce 0.2169", "mean: Ce 0.8265"],
        ),
        ("plate-stress.svg", 1440, &["uniform pressure"]),
        ("plate-stress-map.svg", 1440, &["MPa/MPa"]),
        (
            "correction-factor.svg",
            1040,
            &[
                "Ce of the damper: 0.2",
                "decay with exponent 2",
                "boss radius, mm",
            ],
        ),
    ] {
        let svg = std::fs::read_to_string(plots.join(name)).unwrap();
        assert!(
            svg.starts_with(&format!("<svg width=\"{width}\"")),
            "{name}"
        );
        assert!(svg.trim_end().ends_with("</svg>"));
        for word in words {
            assert!(svg.contains(word), "{name}: {word}");
        }
    }
}

/// Two narrow bosses press down the edge midway between them.
#[test]
fn an_edge_pressed_down_is_reported() {
    let area = [
        "--no-plots",
        "--valve",
        "piston-extension",
        "--bosses",
        "2",
        "--boss-share",
        "0.1",
    ];
    let text = text_of(&plates(&area).success());
    assert!(
        text.contains("between bosses the edge moves down, by "),
        "{text}"
    );
    assert!(!text_of(&plates(&["--no-plots"]).success()).contains("moves down"));
}

/// A factor that no area of this kind can have is reported; the rest is computed for the whole disc.
#[test]
fn a_factor_out_of_reach_is_reported() {
    let set = [
        "--set",
        "valves.foot_compression.equivalent_pressure_factor=1.2",
    ];
    let valve = report(&set)["valves"][2].clone();
    assert!(valve["pressure_area"].is_null() && valve["correction_factor"].is_null());
    let text = plates(&[&["--no-plots"], &set[..]].concat()).success();
    assert!(text_of(&text).contains("no area of the assumed kind gives the Ce of the file, 1.2"));
}

/// A valve with a compliance but no shims is skipped; if selected explicitly, it is rejected.
#[test]
fn a_valve_without_shims_has_no_plate() {
    let set = ["--set", "valves.foot_compression.shims_m=[]"];
    let valves = report(&set)["valves"].as_array().unwrap().len();
    assert_eq!(valves, 2);
    let folder = tempfile::tempdir().unwrap();
    let named = ["shims", "--fe", "--valve", "foot-compression"];
    dashpot(&[&named[..], &set].concat(), folder.path())
        .code(2)
        .stdout("")
        .stderr(contains(
            "--valve: valves.foot_compression has no shims_m; allowed:",
        ));
    assert_eq!(files_in(folder.path()), [""; 0]);
}
