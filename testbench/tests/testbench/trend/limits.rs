//! The limits are those of docs/out-of-service.md.

use std::fs;
use std::path::Path;

use dashpot_testbench::trend::limits::Kind;

#[test]
fn limits_are_those_of_the_study_of_worn_dampers() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/out-of-service.md");
    let page = fs::read_to_string(page).unwrap();
    let [vertical, lateral, yaw] = Kind::ALL.map(Kind::limits);
    let mm = |limit: Option<f64>| limit.unwrap() * 1e3;
    let mn_per_m = |limit: Option<f64>| limit.unwrap() * 1e-6;
    for expected in [
        format!(
            "| all vertical | clearance above | {:.1} mm",
            mm(vertical.clearance_m)
        ),
        format!(
            "| all vertical | effective stiffness below | {:.1} MN/m",
            mn_per_m(vertical.stiffness_n_per_m)
        ),
        format!(
            "| all lateral | effective stiffness below | {:.1} MN/m",
            mn_per_m(lateral.stiffness_n_per_m)
        ),
        format!(
            "with {:.0} mm of play in all of them the lateral force exceeds its limit",
            mm(yaw.clearance_m)
        ),
        format!(
            "with ends of {:.0} MN/m by",
            mn_per_m(yaw.stiffness_n_per_m)
        ),
        "| all lateral | clearance above | not reached |".into(),
    ] {
        assert!(page.contains(&expected), "{expected}");
    }
    assert_eq!(lateral.clearance_m, None);
}
