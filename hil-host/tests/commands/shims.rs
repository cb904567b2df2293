//! `dashpot shims` as a command: theory, tables, flow, plots, errors.

use std::path::Path;

use assert_cmd::assert::Assert;

use crate::common::{dashpot, error_of, json_of, text_of};

fn shims(arguments: &[&str]) -> Assert {
    dashpot(&[&["shims"], arguments].concat(), Path::new("."))
}

#[test]
fn theory_is_compared_with_the_published_deflections() {
    let folder = tempfile::tempdir().unwrap();
    let plots = folder.path().join("plots");
    let output = shims(&["--format", "json", "--plots", plots.to_str().unwrap()]).success();
    let report = json_of(&output);
    // Cw at the edge and deflection under 1 MPa from disc theory, the published rate, Ce, and the circumference of the
    // edge: values of the paper and of its check by hand.
    let expected = [
        (2.1427e-19, 0.4511, 0.01360, 0.2169, 0.029, 33.0),
        (2.1427e-19, 0.5650, 0.01370, 0.2000, 0.029, 41.0),
        (9.6981e-21, 0.04273, 0.001446, 0.8265, 0.011, 30.0),
    ];
    for (valve, (cw, theory, published, ce, edge, ratio)) in
        report["valves"].as_array().unwrap().iter().zip(expected)
    {
        let near = |value: &serde_json::Value, expected: f64, fraction: f64| {
            let value = value.as_f64().unwrap();
            assert!(
                (value / expected - 1.0).abs() < fraction,
                "{value} {expected}"
            );
        };
        let radii = valve["pack"]["cw"].as_array().unwrap();
        assert!(radii[0]["cw_m6_per_n"].as_f64().unwrap().abs() < 1e-4 * cw);
        near(&radii[radii.len() - 1]["cw_m6_per_n"], cw, 1e-4);
        near(
            &valve["pack"]["edge_compliance_m_per_pa"],
            theory * 1e-9,
            2e-4,
        );
        let reported = valve["theory_over_published"].as_f64().unwrap();
        assert!((reported - ratio).abs() < 0.5, "{reported} {ratio}");
        for row in valve["pressures"].as_array().unwrap() {
            let pressure = row["pressure_pa"].as_f64().unwrap();
            near(&row["theory_uniform_m"], theory * 1e-9 * pressure, 2e-4);
            near(
                &row["published_uniform_m"],
                published * 1e-9 * pressure,
                5e-3,
            );
            let lift = ce * published * 1e-9 * pressure;
            near(&row["lift_m"], lift, 1e-3);
            let flow = 0.61 * std::f64::consts::TAU * edge * lift * (2.0 * pressure / 860.0).sqrt();
            near(&row["flow_m3_per_s"], flow, 1e-3);
        }
    }
    for name in ["shim-lift.svg", "shim-deflection.svg", "valve-flow.svg"] {
        let svg = std::fs::read_to_string(plots.join(name)).unwrap();
        assert!(svg.starts_with("<svg width=\"1440\"") && svg.trim_end().ends_with("</svg>"));
        assert!(svg.matches("<polyline").count() >= 3);
    }
}

/// Draws the plot of the edge lift with `arguments`; returns the words in it.
fn lift_plot(arguments: &[&str]) -> (String, Vec<String>) {
    let folder = tempfile::tempdir().unwrap();
    let plots = folder.path().to_str().unwrap();
    shims(&[arguments, &["--plots", plots]].concat()).success();
    let svg = std::fs::read_to_string(folder.path().join("shim-lift.svg")).unwrap();
    let lines = svg.lines().map(str::trim);
    let words = lines.filter(|line| !line.is_empty() && !line.starts_with('<'));
    let words = words.map(str::to_owned).collect();
    (svg, words)
}

/// The slopes are computed by hand: by theory from Table 1, from the last rows of Tables 2-4, and the latter times Ce.
#[test]
fn theory_published_and_used_lift_are_named_curves() {
    let (svg, words) = lift_plot(&[]);
    for name in [
        "Piston extension valve, published in Table 2",
        "Piston compression valve, published in Table 3",
        "Foot compression valve, published in Table 4",
        "pressure, MPa",
        "edge lift, mm",
        "disc theory, uniform pressure: 0.451 mm/MPa",
        "disc theory, uniform pressure: 0.565 mm/MPa",
        "disc theory, uniform pressure: 0.0427 mm/MPa",
        "published, uniform pressure: 0.0136 mm/MPa",
        "published, uniform pressure: 0.0137 mm/MPa",
        "published, uniform pressure: 0.00145 mm/MPa",
        "published, real pressure (FEA)",
        "used, given compliance × Ce: 0.00295 mm/MPa",
        "used, given compliance × Ce: 0.00274 mm/MPa",
        "used, given compliance × Ce: 0.00120 mm/MPa",
    ] {
        assert!(words.iter().any(|word| word == name), "{name}: {words:?}");
    }
    // One point for each of the five rows of three tables, and one per legend entry.
    assert_eq!(svg.matches("<circle").count(), 3 * (5 + 1));
}

#[test]
fn a_pack_of_another_damper_has_no_published_curve() {
    let (svg, words) = lift_plot(&[
        "--set",
        "valves.piston_extension.free_radius_m=0.03",
        "--set",
        "valves.piston_compression.free_radius_m=0.03",
    ]);
    assert!(words.iter().any(|word| word == "Piston extension valve"));
    assert_eq!(svg.matches("<circle").count(), 5 + 1);
}

/// Below the preload, the valve is closed: the logarithm of zero lift, or of its rounding error, is not drawn.
#[test]
fn a_preload_leaves_the_scale_readable() {
    for preload_pa in ["3e5", "7e5", "2e7"] {
        let (_, words) = lift_plot(&[
            "--set",
            &format!("valves.foot_compression.preload_pa={preload_pa}"),
        ]);
        let numbers: Vec<f64> = words.iter().filter_map(|word| word.parse().ok()).collect();
        let min = numbers.iter().filter(|number| **number > 0.0);
        let min = min.fold(f64::MAX, |min, number| min.min(*number));
        assert!((1e-5..1e-2).contains(&min), "{preload_pa}: {words:?}");
    }
}

#[test]
fn text_states_the_erratum() {
    let output = shims(&["--no-plots"]);
    let text = text_of(&output);
    assert!(text.contains("33, 41 and 30 times"), "{text}");
    assert!(text.contains("piston extension: clamped at 16.0 mm, free at 29.0 mm, 7 shims"));
    assert!(!text.contains("plots:"));
}

#[test]
fn another_pack_has_no_published_figures() {
    let output = shims(&[
        "--no-plots",
        "--format",
        "json",
        "--set",
        "valves.foot_compression.free_radius_m=0.012",
    ]);
    let report = json_of(&output);
    assert!(report["valves"][2]["theory_over_published"].is_null());
    assert!(report["valves"][0]["theory_over_published"].is_f64());
}

#[test]
fn a_reduced_damper_has_no_packs() {
    let output = shims(&["--damper", "reduced-lateral", "--no-plots"]).code(1);
    let message = error_of(&output);
    assert!(
        message.contains("reduced damper has no shim packs; use a damper with"),
        "{message}"
    );
}
