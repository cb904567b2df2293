//! `dashpot vehicle` with events: what changes is in the report, the page and indices.json, and `--check` refuses it.

use std::fs;

use crate::common::{dashpot, error_of, json_of};

const CASE: &str = "name = \"gust\"
vehicle = \"coach\"
track = \"ideal\"
speed_km_h = 100
duration_s = 0.5
[[fault]]
time_s = 0.1
damper = \"front lateral damper 1\"
damper_file = \"in-service\"
[[event]]
time_s = 0.2
ramp_s = 0.2
speed_km_h = 99
[[event]]
time_s = 0.3
force_on = \"body\"
force_at_m = [0, 0, 2.2]
force_n = [30e3, 0]
";

#[test]
fn events_are_reported() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("gust.toml"), CASE).unwrap();
    let line = ["vehicle", "--case", "gust.toml", "--output", "out"];
    let run = dashpot(&[&line[..], &["--format", "json"]].concat(), folder.path()).success();
    let changes = [
        "at 0.1 s: front lateral damper 1 changes",
        "at 0.2 s, within 0.2 s: speed 99.0 km/h",
        "at 0.3 s: 30.0 kN to the right and 0.0 kN down on body, 0 m forward, 0 m to the right, 2.2 m high",
    ];
    assert_eq!(json_of(&run)["changes"], serde_json::json!(changes));
    let page = fs::read_to_string(folder.path().join("out/report.html")).unwrap();
    for change in changes {
        assert!(page.contains(change), "{change}");
    }
    let error = error_of(&dashpot(&[&line[..3], &["--check"]].concat(), folder.path()).code(2));
    assert!(
        error.contains("which the reference does not support"),
        "{error}"
    );
}
