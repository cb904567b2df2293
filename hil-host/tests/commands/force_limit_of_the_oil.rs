//! Regression: a force limit above bulk modulus times area gave a table with NaN: `rig` printed 0 N and exited with
//! code 0, `replay` jumped to the limit, and `export` wrote an image with 30 NaN words.

use predicates::prelude::PredicateBooleanExt;
use predicates::str::contains;

use crate::common::{dashpot, files_in};

#[test]
fn every_command_refuses_the_limit_and_names_both_values() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("in.csv"),
        "time_s,displacement_m\n0,0\n1,0.01\n",
    )
    .unwrap();
    let rig = ["rig", "--amplitude-m", "0.01", "--frequency-hz", "4.8"];
    let replay = ["replay", "--input", "in.csv", "--output", "out.csv"];
    let export = ["export", "--lang", "bin", "--output", "damper"];
    for command in [&rig[..], &replay, &export, &["verify"], &["budget"]] {
        for (limit, more) in [
            ("limits.force_n=1e7", "mount.clearance_m=0"),
            ("limits.force_n=1e6", "oil.column.bulk_modulus_pa=3e8"),
        ] {
            let damper = ["--damper", "in-service", "--set", more, "--set", limit];
            let output = dashpot(&[command, &damper].concat(), folder.path());
            let value = if limit.ends_with('7') {
                "10000000"
            } else {
                "1000000"
            };
            output
                .code(predicates::ord::eq(1).or(predicates::ord::eq(2)))
                .stdout("")
                .stderr(contains("limits.force_n").and(contains(value)))
                .stderr(contains("oil.column.bulk_modulus_pa").and(contains("the bound is ")));
        }
    }
    assert_eq!(files_in(folder.path()), ["in.csv"]);
}
