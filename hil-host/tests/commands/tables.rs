//! `dashpot tables`: contact tables computed ahead give the same bits, and other tables are refused.

use std::fs;

use crate::common::{dashpot, error_of, files_in, json_of, text_of};
use crate::sweep::{folder, read};

/// Two cases on two pairs of wheel and rail.
const STUDY: &str = r#"name = "pairs"
observed = ["derailment_greatest"]

[[sweep]]
name = "gauge"
track = "straight"
speed_km_h = 120
duration_s = 0.5
vary = [{ parameter = "contact.gauge_m", values = [1.435, 1.434] }]
"#;

const SWEEP: [&str; 4] = ["sweep", "study.toml", "--no-page", "--output"];

#[test]
fn a_study_with_tables_computed_ahead_has_the_same_rows() {
    let folder = folder(STUDY);
    let tables = ["tables", "study.toml", "--output", "tables"];
    let text = text_of(&dashpot(&tables, folder.path()).success());
    assert_eq!(text.matches("wrote tables").count(), 2, "{text}");
    let files = files_in(&folder.path().join("tables"));
    assert_eq!(files.len(), 2, "{files:?}");
    let json = [&tables[..], &["--format", "json"]].concat();
    let report = json_of(&dashpot(&json, folder.path()).success());
    assert_eq!(report["files"][0]["computed"], false, "{report}");
    let with = [&SWEEP[..], &["with", "--contact-tables", "tables"]].concat();
    dashpot(&with, folder.path()).success();
    dashpot(&[&SWEEP[..], &["without"]].concat(), folder.path()).success();
    let [with_tables, without] =
        ["with/rows.csv", "without/rows.csv"].map(|name| read(folder.path(), name));
    assert_eq!(with_tables, without);

    // A damaged file, then no file.
    let path = folder.path().join("tables").join(&files[1]);
    let mut bytes = fs::read(&path).unwrap();
    *bytes.last_mut().unwrap() ^= 1;
    fs::write(&path, &bytes).unwrap();
    let error = error_of(&dashpot(&with, folder.path()).failure().code(1));
    for part in [
        "--contact-tables: tables/",
        &files[1],
        "damaged",
        "dashpot tables",
    ] {
        assert!(error.contains(part), "{part}: {error}");
    }
    fs::remove_file(&path).unwrap();
    let error = error_of(&dashpot(&with, folder.path()).failure().code(1));
    assert!(
        error.contains("no contact tables of a wheel and rail of this run"),
        "{error}"
    );
    // The command mends the folder.
    dashpot(&tables, folder.path()).success();
    assert_eq!(files_in(&folder.path().join("tables")), files);
    dashpot(&with, folder.path()).success();
}

#[test]
fn a_vehicle_with_tables_computed_ahead_has_the_same_history() {
    let folder = tempfile::tempdir().unwrap();
    let of_case = ["tables", "--case", "straight-180", "--output", "tables"];
    dashpot(&of_case, folder.path()).success();
    let vehicle = [
        "vehicle",
        "--case",
        "straight-180",
        "--duration-s",
        "0.2",
        "--no-page",
    ];
    let run = |more: &[&str]| dashpot(&[&vehicle[..], more].concat(), folder.path());
    run(&["--output", "with", "--contact-tables", "tables"]).success();
    run(&["--output", "without"]).success();
    let [with, without] =
        ["with", "without"].map(|name| read(folder.path(), &format!("{name}/history.csv")));
    assert_eq!(with, without);
    fs::create_dir(folder.path().join("empty")).unwrap();
    let error = error_of(&run(&["--contact-tables", "empty"]).failure().code(1));
    assert!(error.contains("--contact-tables: empty/"), "{error}");
}

#[test]
fn tables_are_of_a_study_or_of_a_case() {
    let folder = tempfile::tempdir().unwrap();
    for (options, part) in [
        (&["tables", "--output", "tables"][..], "required"),
        (&["tables", "paper"], "--output <FOLDER>"),
        (
            &["tables", "paper", "--case", "straight-180", "--output", "x"],
            "cannot be used with",
        ),
        (
            &["tables", "--case", "straight-18", "--output", "x"],
            "did you mean `straight-180`",
        ),
    ] {
        let error = error_of(&dashpot(options, folder.path()).failure().code(2));
        assert!(error.contains(part), "{options:?}: {error}");
    }
}
