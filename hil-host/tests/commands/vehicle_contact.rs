//! `dashpot vehicle` and `dashpot modes` with other wheels, rails and friction.

use std::fs;

use tempfile::tempdir;

use crate::common::{dashpot, error_of, json_of, text_of};

/// S1002 with 0.2 mm worn off its tread, as a file of columns.
fn worn() -> String {
    let mut text = "y_mm,z_mm\n".to_owned();
    for point in dashpot_rail::profile::s1002::profile()
        .points()
        .iter()
        .step_by(5)
    {
        let (y, z) = (1e3 * point.y_m, 1e3 * point.z_m);
        text += &format!(
            "{y:.4},{:.4}\n",
            z - 0.2 * (-((y - 5.0) / 20.0).powi(2)).exp()
        );
    }
    text
}

#[test]
fn options_and_overrides_are_on_the_report_and_the_page() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("worn.csv"), worn()).unwrap();
    let arguments = [
        "vehicle",
        "--case",
        "curve-r300",
        "--duration-s",
        "0.5",
        "--wheel",
        "worn.csv",
        "--rail-inclination",
        "0.05",
        "--gauge-m",
        "1.437",
        "--set",
        "contact.right_friction=0.2",
        "--set",
        "contact.gauge_over_distance=[[0, 1.437], [5, 1.44]]",
        "--format",
        "json",
        "--output",
        "results",
    ];
    let report = json_of(&dashpot(&arguments, folder.path()).success());
    let contact = &report["contact"];
    assert_eq!(contact["wheels"].as_array().unwrap().len(), 6);
    assert_eq!(contact["wheels"][5]["left"], "worn");
    assert_eq!(
        (&contact["left_rail"], &contact["right_rail"]),
        (&"UIC 60".into(), &"UIC 60".into())
    );
    assert_eq!(
        (&contact["rail_inclination"], &contact["gauge_m"]),
        (&0.05.into(), &1.437.into())
    );
    assert_eq!(contact["friction_over_distance"][0][2], 0.2);
    assert_eq!(contact["gauge_over_distance"][1][1], 1.44);
    let limits = report["indices"]["nadal_limits"].as_array().unwrap();
    assert_eq!(limits.len(), 2);
    assert_eq!(limits[1]["friction"], 0.2);
    let page = fs::read_to_string(folder.path().join("results/report.html")).unwrap();
    let friction = report["friction"].as_f64().unwrap();
    for part in [
        "worn; 1360.0 mm back to back",
        "UIC 60, inclined 1:20",
        "1437.00 to 1440.00 mm along the track",
        &format!("{friction} left, 0.2 right"),
        "wheelset 1 left",
    ] {
        assert!(page.contains(part), "{part}");
    }
    // The worn wheels change the motion.
    let standard = [
        &arguments[..5],
        &["--format", "json", "--output", "standard"],
    ]
    .concat();
    let standard = json_of(&dashpot(&standard, folder.path()).success());
    assert_eq!(standard["contact"]["wheels"][0]["right"], "S1002");
    assert_ne!(
        standard["indices"]["wheelsets"],
        report["indices"]["wheelsets"]
    );
}

#[test]
fn modes_depend_on_the_wheels_and_rails() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("worn.csv"), worn()).unwrap();
    let modes = |more: &[&str]| {
        let arguments = [
            &[
                "modes",
                "--vehicle",
                "coach",
                "--speed-km-h",
                "100",
                "--format",
                "json",
            ],
            more,
        ];
        json_of(&dashpot(&arguments.concat(), folder.path()).success())["modes"].clone()
    };
    let standard = modes(&[]);
    assert_eq!(
        modes(&["--wheel", "s1002", "--rail-inclination", "0.025"]),
        standard
    );
    assert_ne!(modes(&["--wheel", "worn.csv"]), standard);
    assert_ne!(modes(&["--rail-inclination", "0.05"]), standard);
    assert_ne!(modes(&["--set", "contact.gauge_m=1.43"]), standard);
    let text = text_of(&dashpot(&["modes", "--vehicle", "coach"], folder.path()).success());
    assert!(text.contains("at standstill"));
}

#[test]
fn errors_name_the_value_and_what_is_allowed() {
    let folder = tempdir().unwrap();
    let error = |arguments: &[&str]| error_of(&dashpot(arguments, folder.path()).failure());
    let run = |more: &[&str]| error(&[&["vehicle", "--case", "curve-r300"], more].concat());
    assert!(
        run(&["--rail", "uic54"]).contains("contact.rail: uic54: no such profile, allowed: uic60")
    );
    assert!(
        run(&["--gauge-m", "1.2"]).contains("contact.gauge_m: gauge minus back-to-back distance")
    );
    assert!(run(&["--set", "contact.gage_m=1"]).contains("did you mean `gauge_m`?"));
    let modes = error(&[
        "modes",
        "--speed-km-h",
        "100",
        "--set",
        "contact.left_friction=0.1",
    ]);
    assert!(
        modes.contains("allowed: values of the whole track"),
        "{modes}"
    );
}
