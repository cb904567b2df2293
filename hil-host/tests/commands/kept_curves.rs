//! Curves that `dashpot sweep` keeps beside the rows: the page drawn from them is that of runs, byte for byte, and
//! nothing is drawn from a damaged or stale file.

use std::fs;
use std::path::Path;

use dashpot_study::sweep::digest_of_cells;
use predicates::str::contains;
use tempfile::TempDir;

use crate::common::{dashpot, files_in, json_of, text_of};
use crate::sweep::{folder, read};

/// Six cases of 2.2 s, long enough for a spectrum. The clearance of 1 mm is that of the vehicle, so two cases have the
/// results of two others.
pub const STUDY: &str = r#"name = "curves"
seeds = [1, 2]
observed = ["body_vertical_rms_m_per_s2"]

[[sweep]]
name = "nominal"
track = "straight"
speed_km_h = 120
duration_s = 2.2

[[sweep]]
name = "clearance"
track = "straight"
speed_km_h = 120
duration_s = 2.2
vary = [{ parameter = "vertical.mount.clearance_m", values = [1e-3, 5e-3] }]

[[figure]]
title = "Forces"
dampers = { sweep = "nominal", dampers = ["front vertical damper 1", "rear vertical damper 4"] }

[[figure]]
title = "Acceleration"
signal = { sweep = "clearance", values = [1e-3, 5e-3], signal = "body_vertical_acceleration_m_per_s2" }

[[figure]]
title = "Ride"
indices = { sweeps = ["clearance"], observed = ["body_vertical_rms_m_per_s2"] }
"#;

const SWEEP: [&str; 4] = ["sweep", "study.toml", "--output", "one"];

/// Sentence about cases that ran again.
const AGAIN: &str = "for the page, which ran again";

/// Runs the study into `one`; returns the folder, the page and the curves.
fn studied() -> (TempDir, String, String) {
    let folder = folder(STUDY);
    let text = text_of(&dashpot(&SWEEP, folder.path()).success());
    assert!(text.contains("6 cases, 6 run now in "), "{text}");
    assert!(
        text.contains("2 cases identical to others, not simulated again"),
        "{text}"
    );
    let files = files_in(&folder.path().join("one"));
    assert_eq!(
        files,
        ["report.html", "rows.csv", "rows.curves", "rows.study"]
    );
    let [page, curves] =
        ["one/report.html", "one/rows.curves"].map(|name| read(folder.path(), name));
    (folder, page, curves)
}

/// Draws the page again without new rows; returns the text of the command.
fn drawn(folder: &Path) -> String {
    fs::remove_file(folder.join("one/report.html")).unwrap();
    let text = text_of(&dashpot(&SWEEP, folder).success());
    assert!(text.contains("6 cases, none run now"), "{text}");
    text
}

#[test]
fn a_page_of_kept_curves_is_that_of_runs() {
    let (folder, page, curves) = studied();
    let text = drawn(folder.path());
    assert!(!text.contains(AGAIN), "{text}");
    assert_eq!(read(folder.path(), "one/report.html"), page);
    // Without the file, all cases with curves run again: one of the first sweep, all four of the second.
    fs::remove_file(folder.path().join("one/rows.curves")).unwrap();
    let text = drawn(folder.path());
    assert!(
        text.contains("one/rows.curves: did not have the curves of 5 cases"),
        "{text}"
    );
    assert_eq!(read(folder.path(), "one/report.html"), page);
    assert_eq!(read(folder.path(), "one/rows.curves"), curves);
}

#[test]
fn a_case_has_the_row_and_curves_that_it_has_alone() {
    let (folder, _, curves) = studied();
    let sweep = ["sweep", "study.toml", "--no-page", "--output", "alone"];
    // Each shard has one case, so nothing is shared.
    let mut rows = String::new();
    let mut alone = Vec::new();
    for shard in ["0", "1", "2", "3", "4", "5"] {
        let options = ["--shard", shard, "--shards", "6"];
        dashpot(&[&sweep[..], &options].concat(), folder.path()).success();
        let row = read(folder.path(), &format!("alone/rows-{shard}-of-6.csv"));
        rows.push_str(row.split_once('\n').unwrap().1);
        let own = folder
            .path()
            .join(format!("alone/rows-{shard}-of-6.curves"));
        let own = fs::read_to_string(own).unwrap_or_default();
        alone.extend(own.lines().skip(2).map(str::to_owned));
    }
    let whole = read(folder.path(), "one/rows.csv");
    assert_eq!(whole.split_once('\n').unwrap().1, rows);
    assert_eq!(curves.lines().skip(2).collect::<Vec<_>>(), alone);
}

#[test]
fn a_study_without_a_page_keeps_curves_for_a_later_one() {
    let (folder, page, curves) = studied();
    fs::remove_dir_all(folder.path().join("one")).unwrap();
    dashpot(&[&SWEEP[..], &["--no-page"]].concat(), folder.path()).success();
    assert_eq!(read(folder.path(), "one/rows.curves"), curves);
    let report = dashpot(&[&SWEEP[..], &["--format", "json"]].concat(), folder.path());
    let report = json_of(&report.success());
    assert_eq!((&report["run_now"], report.get("notes")), (&0.into(), None));
    let files = report["files"].as_array().unwrap();
    assert_eq!(
        files,
        &[
            "one/rows.csv",
            "one/rows.curves",
            "one/rows.study",
            "one/report.html"
        ]
    );
    assert_eq!(read(folder.path(), "one/report.html"), page);
    // Over again: the old files stay under another name.
    dashpot(&[&SWEEP[..], &["--anew"]].concat(), folder.path()).success();
    assert_eq!(read(folder.path(), "one/rows.curves.old"), curves);
    assert_eq!(read(folder.path(), "one/rows.curves"), curves);
}

/// Replaces cells of a line and its digest.
fn with_cells(line: &str, changes: &[(usize, &str)]) -> String {
    let mut cells: Vec<&str> = line.split(',').collect();
    for (cell, text) in changes {
        cells[*cell] = text;
    }
    cells.pop();
    format!(
        "{},{}",
        cells.join(","),
        digest_of_cells(cells.iter().copied())
    )
}

#[test]
fn damaged_and_stale_curves_are_computed_again() {
    let (folder, page, curves) = studied();
    let path = folder.path().join("one/rows.curves");
    let lines: Vec<&str> = curves.lines().collect();
    // Two header lines; four histories of the dampers, two of the signal, four spectra.
    assert_eq!(lines.len(), 2 + 4 + 2 + 4);
    let swap = |number: usize, line: &str| curves.replacen(lines[number], line, 1);
    let digit = lines[4].rfind("1 ").unwrap();
    let mut altered = lines[4].to_owned();
    altered.replace_range(digit..=digit, "2");
    let cut = &curves[..curves.len() - 30];
    let is_of_last = lines[11].split(',').nth(1).unwrap();
    for (damaged, reasons, cases) in [
        (
            swap(4, &altered),
            &["one/rows.curves:5: damaged curve"][..],
            "1 case ",
        ),
        (
            swap(4, "\u{e9}"),
            &["one/rows.curves:5: damaged curve"],
            "1 case ",
        ),
        (
            cut.to_owned(),
            &["one/rows.curves:12: damaged curve"],
            "1 case ",
        ),
        (
            // The curve of another row, with a digest that matches.
            swap(6, &with_cells(lines[6], &[(1, is_of_last)])),
            &["one/rows.curves:7: stale curve: it is not of the row of case 2"],
            "1 case ",
        ),
        (
            swap(7, &with_cells(lines[7], &[(5, "1.0 2.0 3.0")])),
            &["one/rows.curves:8: damaged curve"],
            "1 case ",
        ),
        (
            curves.replacen("curves 1", "curves 9", 1),
            &[
                "one/rows.curves:1: not a file of curves of this version, which begins with `# dashpot curves 1`",
            ],
            "5 cases ",
        ),
        (
            String::new(),
            &["one/rows.curves:1: not a file of curves"],
            "5 cases ",
        ),
        (
            swap(3, "") + "0,1\n",
            &["one/rows.curves:13: damaged curve"],
            "1 case ",
        ),
    ] {
        assert_ne!(damaged, curves);
        fs::write(&path, &damaged).unwrap();
        let text = drawn(folder.path());
        for reason in reasons {
            assert!(text.contains(reason), "{reason}: {text}");
        }
        let again = format!("did not have the curves of {cases}{AGAIN}");
        assert!(text.contains(&again), "{again}: {text}");
        assert_eq!(read(folder.path(), "one/report.html"), page);
        assert_eq!(read(folder.path(), "one/rows.curves"), curves);
    }
}

/// A figure of another signal needs other curves of the same rows.
#[test]
fn a_changed_figure_runs_its_cases_again() {
    let (folder, page, _) = studied();
    let other = STUDY.replace("body_vertical_acc", "body_lateral_acc");
    fs::write(folder.path().join("study.toml"), other).unwrap();
    let text = drawn(folder.path());
    assert!(
        text.contains("did not have the curves of 4 cases"),
        "{text}"
    );
    assert_ne!(read(folder.path(), "one/report.html"), page);
    assert!(!drawn(folder.path()).contains(AGAIN));
}

#[test]
fn merged_shards_bring_their_curves() {
    let (folder, page, curves) = studied();
    for shard in ["0", "1", "2"] {
        let options = ["--shard", shard, "--shards", "3", "--output", "parts"];
        dashpot(
            &[&["sweep", "study.toml"][..], &options].concat(),
            folder.path(),
        )
        .success()
        .stdout(contains("2 cases, 2 run now"));
    }
    let shards = ["0", "1", "2"].map(|shard| format!("parts/rows-{shard}-of-3.csv"));
    let shards = shards.iter().map(String::as_str);
    let merge: Vec<&str> = ["merge", "study.toml", "--output", "merged"]
        .into_iter()
        .chain(shards)
        .collect();
    let merged = || {
        let text = text_of(&dashpot(&merge, folder.path()).success());
        assert_eq!(read(folder.path(), "merged/report.html"), page);
        assert_eq!(read(folder.path(), "merged/rows.curves"), curves);
        text
    };
    let text = merged();
    assert!(!text.contains(AGAIN), "{text}");
    // One shard lost its curves, another has damaged ones.
    fs::remove_file(folder.path().join("parts/rows-2-of-3.curves")).unwrap();
    let zero = folder.path().join("parts/rows-0-of-3.curves");
    let damaged = fs::read_to_string(&zero)
        .unwrap()
        .replacen("history", "histery", 1);
    fs::write(&zero, damaged).unwrap();
    let text = merged();
    assert!(
        text.contains("parts/rows-0-of-3.curves:3: damaged curve"),
        "{text}"
    );
    // Cases 2 and 5 of the lost file, and case 0.
    assert!(
        text.contains("did not have the curves of 3 cases"),
        "{text}"
    );
}

#[cfg(unix)]
#[test]
fn an_interrupted_study_keeps_the_curves_of_its_rows() {
    use std::io::Write;

    use crate::sweep::{ON_ONE_THREAD, interrupt, rows, started, wait_for_rows};

    // One thread, and cases that are long enough to be interrupted.
    let folder = folder(&STUDY.replace("duration_s = 2.2", "duration_s = 4"));
    let mut child = started(&ON_ONE_THREAD, folder.path());
    wait_for_rows(&mut child, folder.path(), 1);
    interrupt(&child);
    assert_eq!(child.wait().unwrap().code(), Some(1));
    let one = folder.path().join("one");
    let files = ["rows.csv.partial", "rows.curves.partial", "rows.study"];
    assert_eq!(files_in(&one), files);
    // A line that was being written when the machine failed.
    let partial = fs::File::options()
        .append(true)
        .open(one.join("rows.curves.partial"));
    partial
        .unwrap()
        .write_all(b"5,0123456789abcdef,body")
        .unwrap();
    let resumed = rows(folder.path());
    assert_eq!(files_in(&one), ["rows.csv", "rows.curves", "rows.study"]);
    let curves = read(folder.path(), "one/rows.curves");
    let drawn = text_of(&dashpot(&SWEEP, folder.path()).success());
    assert!(!drawn.contains("curves:"), "{drawn}");
    let page = read(folder.path(), "one/report.html");
    fs::remove_dir_all(&one).unwrap();
    assert_eq!(rows(folder.path()), resumed);
    assert_eq!(read(folder.path(), "one/rows.curves"), curves);
    dashpot(&SWEEP, folder.path()).success();
    assert_eq!(read(folder.path(), "one/report.html"), page);
}

/// Curves of a run during which a file of the study changed are removed with its rows.
#[cfg(unix)]
#[test]
fn a_vehicle_that_changes_while_it_runs_leaves_no_curves() {
    use crate::sweep::{ON_ONE_THREAD, started, wait_for_rows};

    let study = STUDY.replace("track = ", "vehicle = \"own.toml\"\ntrack = ");
    let folder = folder(&study.replace("duration_s = 2.2", "duration_s = 4"));
    let own = folder.path().join("own.toml");
    let text = include_str!("../../../data/vehicles/locomotive.toml");
    fs::write(&own, text).unwrap();
    let mut child = started(&ON_ONE_THREAD, folder.path());
    wait_for_rows(&mut child, folder.path(), 2);
    let new = folder.path().join("new.toml");
    fs::write(&new, text.replace("mass_kg = 63400", "mass_kg = 60000")).unwrap();
    fs::rename(&new, &own).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(1));
    let files = files_in(&folder.path().join("one"));
    assert_eq!(files, ["rows.csv.partial", "rows.study"]);
}
