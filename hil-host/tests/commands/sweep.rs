//! `dashpot sweep` and `dashpot merge`: any way of running gives the same rows, and no row is lost.

use std::fs::{self, File};
use std::path::Path;
use std::process::{Child, Stdio};

use dashpot_study::sweep::digest_of_cells;
use tempfile::TempDir;

use crate::common::{command, dashpot, error_of, files_in, json_of, text_of};

/// Twelve cases of half a second.
pub const STUDY: &str = r#"name = "small"
seeds = [1, 2]
observed = ["body_vertical_rms_m_per_s2", "derailment_greatest", "last_lateral_m"]

[[sweep]]
name = "clearance"
track = "straight"
speed_km_h = 120
duration_s = 1.5
vary = [
  { parameter = "vertical.mount.clearance_m", values = [0, 5e-3] },
  { parameter = "speed_km_h", from = 100, to = 140, count = 2 },
]

[[sweep]]
name = "worn"
track = "straight"
speed_km_h = 120
duration_s = 1.5
vary = [{ parameter = "worn_damper", values = ["none", "rear vertical damper 4"], set = ["mount.stiffness_n_per_m=1e5"] }]

[[figure]]
title = "Ride"
indices = { sweeps = ["clearance", "worn"], observed = ["body_vertical_rms_m_per_s2"] }
"#;

/// Computes the rows of the study with one thread, into `one`.
pub const ON_ONE_THREAD: [&str; 7] = [
    "sweep",
    "study.toml",
    "--no-page",
    "--threads",
    "1",
    "--output",
    "one",
];

/// Returns a folder that contains the study.
pub fn folder(study: &str) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("study.toml"), study).unwrap();
    folder
}

pub fn read(folder: &Path, name: &str) -> String {
    fs::read_to_string(folder.join(name)).unwrap()
}

/// Returns the row with the cell in the named column replaced.
pub fn altered(row: &str, column: &str, header: &str, cell: &str) -> String {
    let at = header.split(',').position(|name| name == column).unwrap();
    let mut cells: Vec<&str> = row.split(',').collect();
    cells[at] = cell;
    cells.join(",")
}

/// Returns the row with its digest recomputed from its cells.
pub fn with_its_digest(row: &str) -> String {
    let (cells, _) = row.rsplit_once(',').unwrap();
    format!("{cells},{}", digest_of_cells(cells.split(',')))
}

/// Computes the rows of the study in the folder with one thread.
pub fn rows(folder: &Path) -> String {
    dashpot(&ON_ONE_THREAD, folder).success();
    read(folder, "one/rows.csv")
}

/// Starts the command.
#[cfg(unix)]
pub fn started(arguments: &[&str], folder: &Path) -> Child {
    command(arguments, folder)
        .env("XDG_CACHE_HOME", env!("CARGO_TARGET_TMPDIR"))
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

/// Waits until a command that writes to `one` has this many rows.
#[cfg(unix)]
pub fn wait_for_rows(child: &mut Child, folder: &Path, rows: usize) {
    let partial = folder.join("one/rows.csv.partial");
    while fs::read_to_string(&partial).map_or(0, |text| text.lines().count()) < rows + 1 {
        assert_eq!(child.try_wait().unwrap(), None, "ended by itself");
        std::thread::yield_now();
    }
}

/// Asks a command to end. Ctrl-C does the same, but a test in the background may ignore it.
#[cfg(unix)]
pub fn interrupt(child: &Child) {
    let id = child.id().to_string();
    let kill = std::process::Command::new("kill")
        .args(["-TERM", &id])
        .status();
    assert!(kill.unwrap().success());
}

/// Cells of a row by column name.
fn cells(rows: &str) -> Vec<std::collections::BTreeMap<String, String>> {
    let mut reader = csv::Reader::from_reader(rows.as_bytes());
    reader.deserialize().map(Result::unwrap).collect()
}

#[test]
fn rows_are_those_of_the_vehicle_command() {
    let folder = folder(STUDY);
    let rows = cells(&rows(folder.path()));
    assert_eq!(rows.len(), 12);
    // The last case of the last sweep but one: the other axis is fixed, the track has seed 1.
    let row = &rows[6];
    let expected = ["clearance", "0.005", "140", "", "1", "completed"];
    let columns = [
        "sweep",
        "vertical.mount.clearance_m",
        "speed_km_h",
        "worn_damper",
        "seed",
        "ending",
    ];
    assert_eq!(columns.map(|column| row[column].as_str()), expected);
    let case = [
        "vehicle",
        "--track",
        "straight",
        "--speed-km-h",
        "140",
        "--duration-s",
        "1.5",
    ];
    let set = [
        "--set",
        "vertical.mount.clearance_m=5e-3",
        "--no-page",
        "--format",
        "json",
    ];
    let report = json_of(&dashpot(&[&case[..], &set].concat(), folder.path()).success());
    let number = |column: &str| row[column].parse::<f64>().unwrap();
    let body = &report["indices"]["bodies"][0];
    assert_eq!(
        number("body_vertical_rms_m_per_s2"),
        body["vertical_rms_m_per_s2"].as_f64().unwrap()
    );
    let wheels = report["indices"]["wheelsets"].as_array().unwrap().iter();
    let wheels = wheels.flat_map(|wheelset| wheelset["wheels"].as_array().unwrap());
    let greatest = wheels.map(|wheel| wheel["derailment_greatest"].as_f64().unwrap());
    assert_eq!(number("derailment_greatest"), greatest.fold(0.0, f64::max));
    let index_of_row = |row: usize| rows[row]["body_vertical_rms_m_per_s2"].clone();
    assert_ne!(index_of_row(8), index_of_row(10), "a worn damper is felt");
}

#[test]
fn threads_and_shards_give_the_same_bits() {
    let folder = folder(STUDY);
    let expected = rows(folder.path());
    let sweep = ["sweep", "study.toml", "--output", "many"];
    dashpot(&[&sweep[..], &["--threads", "5"]].concat(), folder.path())
        .success()
        .stdout(predicates::str::contains("12 cases, 12 run now"));
    assert_eq!(
        files_in(&folder.path().join("many")),
        ["report.html", "rows.csv", "rows.study"]
    );
    assert_eq!(read(folder.path(), "many/rows.csv"), expected);
    let mut shards = Vec::new();
    for shard in ["0", "1", "2", "3", "4"] {
        let options = ["--shard", shard, "--shards", "5", "--output", "parts"];
        dashpot(
            &[&["sweep", "study.toml"][..], &options].concat(),
            folder.path(),
        )
        .success();
        shards.push(format!("parts/rows-{shard}-of-5.csv"));
    }
    // Shards may be merged in any order.
    shards.rotate_left(2);
    let merge = ["merge", "study.toml", "--output", "merged"];
    let shards: Vec<&str> = shards.iter().map(String::as_str).collect();
    dashpot(&[&merge[..], &shards].concat(), folder.path()).success();
    assert_eq!(read(folder.path(), "merged/rows.csv"), expected);
    let page = |folder_name: &str| read(folder.path(), &format!("{folder_name}/report.html"));
    assert_eq!(page("merged"), page("many"));
}

#[test]
fn merge_names_missing_and_duplicate_cases() {
    let folder = folder(STUDY);
    let whole = rows(folder.path());
    let (header, rows) = whole.split_once('\n').unwrap();
    let rows: Vec<&str> = rows.lines().collect();
    let write = |name: &str, numbers: &[usize]| {
        let chosen: Vec<&str> = numbers.iter().map(|number| rows[*number]).collect();
        fs::write(
            folder.path().join(name),
            format!("{header}\n{}\n", chosen.join("\n")),
        )
        .unwrap();
    };
    write("a.csv", &[0, 1, 2, 5, 8]);
    write("b.csv", &[6, 7, 2, 1, 11]);
    let merge = [
        "merge",
        "study.toml",
        "a.csv",
        "b.csv",
        "--output",
        "merged",
    ];
    let error = error_of(&dashpot(&merge, folder.path()).code(1));
    assert!(
        error.contains("4 of 12 cases are missing: 3-4, 9-10; duplicates in a.csv and b.csv: 1-2"),
        "{error}"
    );
    assert!(!folder.path().join("merged").exists(), "nothing is written");
    // These rows are from another study or version, or were edited by hand.
    let row = rows[0];
    for (changed, expected) in [
        (
            row.replace(env!("CARGO_PKG_VERSION"), "0.0.9"),
            concat!(
                "column version: `0.0.9`, allowed: ",
                env!("CARGO_PKG_VERSION")
            ),
        ),
        (
            row.replacen("0,clearance", "0,worn", 1),
            "column sweep: `worn`, allowed: `clearance`",
        ),
        (
            row.replacen("0,clearance", "12,clearance", 1),
            "column case: `12`, allowed: 0 to 11",
        ),
        (
            row.replacen("completed,", "completed,NaN", 1),
            "column body_vertical_rms_m_per_s2: `NaN",
        ),
        (row.replacen(",completed", "", 1), "13 columns, allowed: 14"),
    ] {
        fs::write(
            folder.path().join("c.csv"),
            format!("{header}\n{changed}\n"),
        )
        .unwrap();
        let error = error_of(&dashpot(&["merge", "study.toml", "c.csv"], folder.path()).code(1));
        assert!(error.contains(&format!("c.csv:2: {expected}")), "{error}");
    }
}

#[test]
fn existing_rows_are_not_run_again() {
    let folder = folder(STUDY);
    let expected = rows(folder.path());
    let sweep = ["sweep", "study.toml", "--no-page", "--output", "one"];
    let again = dashpot(&sweep, folder.path()).success();
    assert!(text_of(&again).contains("12 cases, none run now"));
    // Recreate the state after a power failure: some rows and an incomplete one.
    let end = expected.match_indices('\n').nth(5).unwrap().0;
    let one = folder.path().join("one");
    fs::write(one.join("rows.csv.partial"), &expected[..end + 20]).unwrap();
    fs::remove_file(one.join("rows.csv")).unwrap();
    let rest = dashpot(&sweep, folder.path()).success();
    assert!(
        text_of(&rest).contains("12 cases, 7 run now"),
        "{}",
        text_of(&rest)
    );
    assert_eq!(files_in(&one), ["rows.csv", "rows.study"]);
    assert_eq!(read(&one, "rows.csv"), expected);
}

#[test]
fn rows_of_another_study_are_kept() {
    let folder = folder(STUDY);
    let kept = rows(folder.path());
    let other = STUDY.replace("5e-3", "4e-3");
    fs::write(folder.path().join("study.toml"), other).unwrap();
    let sweep = ["sweep", "study.toml", "--no-page", "--output", "one"];
    let error = error_of(&dashpot(&sweep, folder.path()).code(1));
    let reason = "value 0.005 of vertical.mount.clearance_m is not in the study now";
    assert!(error.contains(reason), "{error}");
    assert_eq!(read(folder.path(), "one/rows.csv"), kept);
    dashpot(&[&sweep[..], &["--anew"]].concat(), folder.path()).success();
    assert_ne!(read(folder.path(), "one/rows.csv"), kept);
    assert_eq!(read(folder.path(), "one/rows.csv.old"), kept);
}

#[test]
fn rows_of_another_shard_are_refused() {
    let folder = folder(STUDY);
    let shard = |number: &'static str| {
        [
            "sweep",
            "study.toml",
            "--shard",
            number,
            "--shards",
            "2",
            "--output",
            ".",
        ]
    };
    dashpot(&shard("1"), folder.path()).success();
    let [one, zero] = ["rows-1-of-2.csv", "rows-0-of-2.csv"].map(|name| folder.path().join(name));
    fs::copy(&one, &zero).unwrap();
    let error = error_of(&dashpot(&shard("0"), folder.path()).code(1));
    assert!(
        error.contains("rows-0-of-2.csv: case 1 does not belong to shard 0 of 2"),
        "{error}"
    );
}

#[cfg(unix)]
#[test]
fn a_vehicle_that_changes_while_it_runs_spoils_no_rows() {
    let study = STUDY.replace("track = ", "vehicle = \"own.toml\"\ntrack = ");
    let folder = folder(&study.replace("duration_s = 1.5", "duration_s = 4"));
    let own = folder.path().join("own.toml");
    let text = include_str!("../../../data/vehicles/locomotive.toml");
    fs::write(&own, text).unwrap();
    let sweep = ON_ONE_THREAD;
    let mut child = started(&sweep, folder.path());
    wait_for_rows(&mut child, folder.path(), 2);
    // Replace the file atomically, as an editor does.
    let new = folder.path().join("new.toml");
    fs::write(&new, text.replace("mass_kg = 63400", "mass_kg = 60000")).unwrap();
    fs::rename(&new, &own).unwrap();
    let ended = child.wait_with_output().unwrap();
    let error = String::from_utf8(ended.stderr).unwrap();
    assert_eq!(ended.status.code(), Some(1), "{error}");
    assert!(
        error.contains("a file of the study was changed during the run"),
        "{error}"
    );
    let kept = read(folder.path(), "one/rows.csv.partial");
    assert_eq!(kept.lines().count(), 1, "{kept}");
}

#[test]
fn varied_files_are_relative_to_the_study() {
    let study = STUDY.replace(
        "\"speed_km_h\", from = 100, to = 140, count = 2",
        "\"vertical\", values = [\"own.toml\", \"in-service\"]",
    );
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("sub")).unwrap();
    fs::write(folder.path().join("sub/study.toml"), study).unwrap();
    let damper = include_str!("../../../data/dampers/reduced-vertical.toml");
    fs::write(folder.path().join("sub/own.toml"), damper).unwrap();
    let list = ["sweep", "sub/study.toml", "--list", "--format", "json"];
    assert_eq!(
        json_of(&dashpot(&list, folder.path()).success())["cases"],
        12
    );
}

#[test]
fn seeds_can_exceed_those_of_the_study() {
    let folder = folder(STUDY);
    let list = |more: &[&str]| {
        let list = ["sweep", "study.toml", "--list", "--format", "json"];
        json_of(&dashpot(&[&list[..], more].concat(), folder.path()).success())
    };
    let (two, five) = (list(&[]), list(&["--seeds", "5"]));
    assert_eq!((&two["cases"], &five["cases"]), (&12.into(), &30.into()));
    assert_ne!(two["digest"], five["digest"]);
}

#[test]
fn two_processes_do_not_mix_their_rows() {
    let folder = folder(STUDY);
    fs::create_dir(folder.path().join("one")).unwrap();
    let partial = File::create(folder.path().join("one/rows.csv.partial")).unwrap();
    partial.lock().unwrap();
    let sweep = ["sweep", "study.toml", "--no-page", "--output", "one"];
    let error = error_of(&dashpot(&sweep, folder.path()).code(1));
    assert!(
        error.contains("one/rows.csv.partial: cannot write: another process is adding rows to it"),
        "{error}"
    );
}

#[cfg(unix)]
#[test]
fn an_interrupted_study_resumes() {
    // Use one thread, and cases that are long enough to be interrupted.
    let folder = folder(&STUDY.replace("duration_s = 1.5", "duration_s = 4"));
    let sweep = ON_ONE_THREAD;
    let mut child = started(&sweep, folder.path());
    wait_for_rows(&mut child, folder.path(), 2);
    interrupt(&child);
    let ended = child.wait_with_output().unwrap();
    let error = String::from_utf8(ended.stderr).unwrap();
    assert_eq!(ended.status.code(), Some(1), "{error}");
    assert!(
        error.contains("of 12 cases are done; the same command resumes with the rest"),
        "{error}"
    );
    let files = files_in(&folder.path().join("one"));
    assert_eq!(files, ["rows.csv.partial", "rows.study"]);
    let done = read(folder.path(), "one/rows.csv.partial").lines().count() - 1;
    assert!((2..12).contains(&done), "{done}");
    let rest = dashpot(&sweep, folder.path()).success();
    let expected = format!("12 cases, {} run now", 12 - done);
    assert!(text_of(&rest).contains(&expected), "{}", text_of(&rest));
    let resumed = read(folder.path(), "one/rows.csv");
    fs::remove_dir_all(folder.path().join("one")).unwrap();
    assert_eq!(rows(folder.path()), resumed);
}

#[test]
fn a_case_that_derails_is_a_row() {
    let study = r#"name = "too fast"
observed = ["body_lateral_rms_m_per_s2"]
[[sweep]]
name = "speed"
case = "curve-r200"
duration_s = 8
vary = [{ parameter = "speed_km_h", values = [40, 160] }]
"#;
    let folder = folder(study);
    let sweep = ["sweep", "study.toml", "--no-page", "--output", "."];
    let text = text_of(&dashpot(&sweep, folder.path()).success());
    assert!(text.contains("1 case did not complete"), "{text}");
    let rows = cells(&read(folder.path(), "rows.csv"));
    assert_eq!(rows[0]["ending"], "completed");
    assert!(rows[0]["body_lateral_rms_m_per_s2"].parse::<f64>().unwrap() > 0.0);
    assert_ne!(rows[1]["ending"], "completed");
    assert_eq!(rows[1]["body_lateral_rms_m_per_s2"], "");
}

#[test]
fn errors_are_reported_before_anything_runs() {
    let shards = |options: &[&str]| {
        let folder = folder(STUDY);
        let sweep = ["sweep", "study.toml", "--output", "out"];
        let error = error_of(&dashpot(&[&sweep[..], options].concat(), folder.path()).code(2));
        assert!(!folder.path().join("out").exists());
        error
    };
    assert!(shards(&["--shard", "1"]).contains("--shards"));
    assert!(shards(&["--shards", "2"]).contains("--shard"));
    assert!(
        shards(&["--shard", "2", "--shards", "2"])
            .contains("--shard 2: allowed with --shards 2: 0 to 1")
    );
    for (from, to, expected) in [
        (
            "\"derailment_greatest\"",
            "\"derailment_gratest\"",
            "study.toml:3: observed `derailment_gratest`: no such index; did you mean `derailment_greatest`?",
        ),
        (
            "vertical.mount.clearance_m",
            "vertical.mount.clearence_m",
            "study.toml:5: sweep clearance at vertical.mount.clearence_m 0, speed_km_h 100: override",
        ),
        (
            "values = [0, 5e-3]",
            "values = [0, -5e-3]",
            "study.toml:5: sweep clearance at vertical.mount.clearance_m -0.005",
        ),
        (
            "values = [0, 5e-3]",
            "values = []",
            "study.toml:11: vertical.mount.clearance_m: 0 values, allowed: 1 to 10000",
        ),
        (
            "values = [0, 5e-3]",
            "values = [1e-3, 0.001]",
            "study.toml:11: vertical.mount.clearance_m: duplicate value 0.001",
        ),
        (
            "from = 100, to = 140, count = 2",
            "from = 100, to = 1400, count = 2",
            "speed_km_h 1400, allowed: ",
        ),
        (
            "from = 100, to = 140, count = 2",
            "from = 100, to = 140",
            "study.toml:12: speed_km_h: give either `values`, or `from`, `to` and `count`",
        ),
        (
            "\"none\", \"rear vertical damper 4\"",
            "\"none\", \"rear vertical damper 5\"",
            "no damper `rear vertical damper 5`",
        ),
        (
            "name = \"worn\"",
            "name = \"clearance\"",
            "duplicate sweep name `clearance`",
        ),
        (
            "seeds = [1, 2]",
            "seeds = [1, 1]",
            "study.toml:5: sweep clearance: duplicate seed",
        ),
        (
            "track = \"straight\"",
            "track = \"ideal\"",
            "sweep clearance: seeds are given, but track",
        ),
        (
            "sweeps = [\"clearance\"",
            "sweeps = [\"clearence\"",
            "no sweep `clearence`; did you mean `clearance`?",
        ),
        (
            "[\"body_vertical_rms_m_per_s2\"] }",
            "[\"body_lateral_rms_m_per_s2\"] }",
            "`body_lateral_rms_m_per_s2` is not in `observed`; did you mean `body_vertical_rms_m_per_s2`?",
        ),
        ("indices = {", "indexes = {", "did you mean `indices`?"),
        (
            "\"speed_km_h\", from = 100, to = 140, count = 2",
            "\"vertical.mount.clearance_m\", values = [1e-3]",
            "study.toml:12: vary: duplicate parameter vertical.mount.clearance_m",
        ),
        (
            "observed = [\"body_vertical_rms_m_per_s2\", \"derailment_greatest\", \"last_lateral_m\"]",
            "observed = []",
            "study.toml:3: observed: empty or with a duplicate, allowed: one or more indices, each once",
        ),
        (
            "name = \"worn\"",
            "name = \"\"",
            "name of a sweep, allowed: one line of text",
        ),
        (
            "to = 140, count = 2",
            "to = 140, count = 2, factor = 0",
            "speed_km_h: factor 0, allowed: finite numbers except 0",
        ),
        (
            "indices = { sweeps = [\"clearance\", \"worn\"], observed = [\"body_vertical_rms_m_per_s2\"] }",
            "indices = { sweeps = [\"clearance\"], observed = [\"body_vertical_rms_m_per_s2\", \
             \"derailment_greatest\"] }",
            "several indices of a sweep with two axes, allowed: one",
        ),
        (
            "indices = { sweeps = [\"clearance\", \"worn\"], observed = [\"body_vertical_rms_m_per_s2\"] }",
            "signal = { sweep = \"worn\", values = [\"nobody\"], signal = \"body_lateral_m\" }",
            "nobody is not a value of the first axis of sweep worn",
        ),
        (
            "indices = { sweeps = [\"clearance\", \"worn\"], observed = [\"body_vertical_rms_m_per_s2\"] }",
            "signal = { sweep = \"worn\", values = [\"none\"], signal = \"body_latral_m\" }",
            "no signal `body_latral_m`; did you mean `body_lateral_m`?",
        ),
        (
            "indices = { sweeps = [\"clearance\", \"worn\"], observed = [\"body_vertical_rms_m_per_s2\"] }",
            "response = { sweep = \"worn\", values = [\"none\"], damper = \"front_vertical_damper 1\", amplitude_m = \
             1e-3 }",
            "no damper `front_vertical_damper 1`; did you mean `front vertical damper 1`?",
        ),
        (
            "indices = { sweeps = [\"clearance\", \"worn\"], observed = [\"body_vertical_rms_m_per_s2\"] }",
            "response = { sweep = \"worn\", values = [\"none\"], damper = \"front vertical damper 1\", amplitude_m = \
             9 }",
            "amplitude_m 9, allowed: above 0 and at most 1",
        ),
    ] {
        let changed = STUDY.replacen(from, to, 1);
        assert_ne!(changed, STUDY, "{from}");
        let folder = folder(&changed);
        let error = error_of(
            &dashpot(&["sweep", "study.toml", "--output", "out"], folder.path()).failure(),
        );
        assert!(error.contains(expected), "{from} -> {to}: {error}");
        assert!(!folder.path().join("out").exists(), "{to}");
    }
}

#[test]
fn the_shipped_studies_are_valid() {
    let folder = tempfile::tempdir().unwrap();
    for (study, cases) in [
        ("paper", 536),
        ("curve-r600", 168),
        ("stand-ins", 848),
        ("out-of-service", 789),
        ("hunting", 54),
        ("damping", 144),
        ("temperature", 144),
        ("worn-damper", 208),
    ] {
        let list = json_of(
            &dashpot(
                &["sweep", study, "--list", "--format", "json"],
                folder.path(),
            )
            .success(),
        );
        assert_eq!(list["cases"], cases, "{study}");
        let sweeps = list["sweeps"].as_array().unwrap().iter();
        let sum: u64 = sweeps.map(|sweep| sweep["cases"].as_u64().unwrap()).sum();
        assert_eq!(sum, cases, "{study}");
    }
    assert!(files_in(folder.path()).is_empty());
}

/// A study observes the same wear as the vehicle reports.
#[test]
fn wear_of_a_study_is_that_of_the_vehicle() {
    let study = "name = \"wear\"\nobserved = [\"max_wear_depth_um_per_1000km\"]\n\
                 [[sweep]]\nname = \"speed\"\ncase = \"curve-r300\"\nduration_s = 0.5\n\
                 vary = [{ parameter = \"speed_km_h\", values = [70] }]\n";
    let folder = folder(study);
    let sweep = ["sweep", "study.toml", "--no-page", "--output", "."];
    dashpot(&sweep, folder.path()).success();
    let mut rows = csv::Reader::from_path(folder.path().join("rows.csv")).unwrap();
    let mut columns = rows.headers().unwrap().iter();
    let column = columns.position(|name| name == "max_wear_depth_um_per_1000km");
    let row = rows.records().next().unwrap().unwrap();
    let observed: f64 = row[column.unwrap()].parse().unwrap();
    let vehicle = "vehicle --case curve-r300 --duration-s 0.5 --no-page --format json";
    let arguments: Vec<&str> = vehicle.split(' ').collect();
    let report = json_of(&dashpot(&arguments, folder.path()).success());
    let wheels = report["wear"]["wheels"].as_array().unwrap();
    let depth = |wheel: &serde_json::Value| wheel["max_depth_um_per_1000km"].as_f64().unwrap();
    let deepest = wheels.iter().map(depth).fold(0.0, f64::max);
    assert!(observed > 0.0);
    assert_eq!(observed, deepest);
}

/// The irregularities of this track are 1000 m long.
#[test]
fn a_study_that_outlasts_its_track_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let study = "name = \"long\"\n\
                 observed = [\"last_lateral_m\"]\n[[sweep]]\nname = \"even\"\n\
                 vehicle = \"coach\"\ntrack = \"straight\"\nspeed_km_h = 160\n\
                 duration_s = 0.2\nstart_m = 1000\nseeds = [1]\n\
                 vary = [{ parameter = \"speed_km_h\", values = [160, 180] }]\n";
    let ran = |text: &str| {
        fs::write(folder.path().join("long.toml"), text).unwrap();
        let arguments = ["sweep", "long.toml", "--anew", "--no-page"];
        let output = command(&arguments, folder.path()).output().unwrap();
        String::from_utf8_lossy(&output.stdout).into_owned()
            + &String::from_utf8_lossy(&output.stderr)
    };
    let short = ran(study);
    assert!(
        short.contains("2 cases") && !short.contains("irregularities"),
        "{short}"
    );
    let text = ran(&study.replace("duration_s = 0.2", "duration_s = 0.6"));
    let expected =
        "sweep even, 2 of 2 combinations of values: the irregularities of the track end at 1000 m";
    assert!(text.contains(expected), "{text}");
}
