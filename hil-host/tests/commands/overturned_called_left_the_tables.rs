//! Regression: the locomotive in a curve of 200 m at 130 km/h was reported as having left the tables of the contact
//! when it overturned.

use std::fs;

use serde_json::Value;
use tempfile::tempdir;

use crate::common::{dashpot, error_of};

fn ended(arguments: &[&str]) -> (String, Value) {
    let folder = tempdir().unwrap();
    let all = [&["vehicle", "--no-page", "--output", "."], arguments];
    let error = error_of(&dashpot(&all.concat(), folder.path()).code(1));
    let text = fs::read_to_string(folder.path().join("indices.json")).unwrap();
    (error, serde_json::from_str(&text).unwrap())
}

#[test]
fn a_vehicle_that_tips_over_is_reported_as_overturned() {
    // It overturns gradually as the curve begins, still in the transition curve.
    for speed_km_h in ["115", "120", "130", "160"] {
        let (error, report) = ended(&["--case", "curve-r200", "--speed-km-h", speed_km_h]);
        assert!(
            error.contains("overturned to the left at ")
                && error.contains("wheels on the other side carry no load"),
            "{speed_km_h} km/h: {error}"
        );
        let ending = &report["ending"];
        assert_eq!(ending["reason"], "overturned");
        assert!(ending["unloaded_wheels"].as_u64().unwrap() > 3, "{ending}");
        assert!(ending["roll_rad"].as_f64().unwrap() < -12e-3, "{ending}");
        assert!(report["indices"].is_null());
    }
}

/// A flange that climbs on dry rails raises a wheel that still carries load.
#[test]
fn flange_climb_is_not_reported_as_overturning() {
    let options = ["--case", "curve-r200", "--speed-km-h", "90"];
    let (error, report) = ended(&[&options[..], &["--friction", "0.9"]].concat());
    let reason = report["ending"]["reason"].as_str().unwrap();
    assert!(["climbed", "outside_tables"].contains(&reason), "{error}");
}
