//! Further output of `dashpot rig`: loops of the settled cycle and Table 5 of the paper.

use std::path::Path;

use crate::common::{dashpot, json_of};

fn rig(arguments: &[&str], folder: &Path) -> serde_json::Value {
    let arguments = [&["rig", "--format", "json"], arguments].concat();
    json_of(&dashpot(&arguments, folder).success())
}

#[test]
fn table_5_is_compared_for_its_own_motion_in_si_units() {
    let folder = tempfile::tempdir().unwrap();
    let report = rig(&[], folder.path());
    // As printed in the paper: kN s/m, N, N, %, N m.
    let printed = [
        ("damping_coefficient_n_s_per_m", 127.96e3, 131.10e3),
        ("max_extension_force_n", 12892.0, 13109.0),
        ("max_compression_force_n", 12649.0, 12849.0),
        ("asymmetry_rate", 0.95e-2, 1.00e-2),
        ("energy_per_cycle_j", 1022.87, 1043.65),
    ];
    for (key, simulation, test) in printed {
        for (column, expected) in [("simulation", simulation), ("test", test)] {
            let found = report["published"][column][key].as_f64().unwrap();
            assert!(
                (found / expected - 1.0).abs() < 1e-12,
                "{column} {key}: {found}"
            );
        }
    }
    let report = rig(&["--frequency-hz", "1.9"], folder.path());
    assert!(report["published"].is_null());
}

#[test]
fn the_loops_are_drawn_on_request() {
    let folder = tempfile::tempdir().unwrap();
    let report = rig(&["--amplitude-m", "5e-3"], folder.path());
    assert_eq!(report["plots"].as_array().unwrap().len(), 0);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);

    let svg = |arguments: &[&str]| {
        let report = rig(&[arguments, &["--plots", "out"]].concat(), folder.path());
        assert_eq!(report["plots"][0], "out/force-loops.svg");
        std::fs::read_to_string(folder.path().join("out/force-loops.svg")).unwrap()
    };
    let nominal = svg(&[]);
    for words in [
        "Force against displacement, harmonic motion of ±24.875 mm at 0.64 Hz",
        "Force against velocity, harmonic motion",
        "displacement, mm",
        "velocity, m/s",
        "force, kN",
        "paper, computed",
        "measured maximum forces (Table 5)",
    ] {
        assert!(nominal.contains(words), "{words}");
    }
    // The paper has no measured forces for this motion.
    let other = svg(&["--frequency-hz", "1.9"]);
    assert!(other.contains("paper, computed") && !other.contains("measured"));
}
