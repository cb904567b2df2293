//! Lists of recordings: the index file, the names of folders and files, and what is wrong with them.

use std::fs;
use std::path::Path;

use dashpot_testbench::trend::Axis;
use dashpot_testbench::trend::limits::Kind;
use dashpot_testbench::trend::recordings::{Listed, list};
use dashpot_testbench::trend::series::series;

fn with_index(text: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("recordings.csv"), text).unwrap();
    folder
}

fn error(text: &str) -> String {
    let folder = with_index(text);
    let error = list(folder.path()).unwrap_err().to_string();
    error.replace(&folder.path().display().to_string(), "")
}

#[test]
fn an_index_says_what_names_do_not() {
    let folder = with_index(
        "vehicle,damper,date,mileage_km,file,temperature_c,serial_number,kind,model\n\
         # a comment\n\
         401, rear 2, 2026-03-14, 12000, a.csv, 41.5, 77, yaw, own.toml\n\
         401,front lateral 1,2026-04-02T08:30,,b.mf4,,,,in-service\n",
    );
    fs::write(folder.path().join("own.toml"), "").unwrap();
    let listed = list(folder.path()).unwrap();
    let first: &Listed = &listed[0];
    assert_eq!(
        (&*first.vehicle, &*first.damper, &*first.serial_number),
        ("401", "rear 2", "77")
    );
    assert_eq!(
        (first.mileage_km, first.temperature_c, first.kind),
        (Some(12_000.0), Some(41.5), Kind::Yaw)
    );
    assert_eq!(first.file, folder.path().join("a.csv"));
    assert!(
        first
            .model
            .as_ref()
            .is_some_and(|model| Path::new(model).is_file())
    );
    let second = &listed[1];
    assert_eq!(
        (second.mileage_km, second.temperature_c, second.kind),
        (None, None, Kind::Lateral)
    );
    assert_eq!(second.date.unwrap().to_string(), "2026-04-02");
    assert_eq!(second.model.as_deref(), Some("in-service"));
    // Without a mileage there is no place on that axis, and the recording is not dropped.
    let (placed, unplaced) = series(listed, Axis::Mileage);
    assert_eq!((placed.len(), unplaced.len()), (1, 1));
    let reason = unplaced[0].refusal.as_ref().unwrap().reason();
    assert_eq!(reason, "no mileage_km in recordings.csv");
}

#[test]
fn errors_of_the_index_name_line_and_column() {
    let header = "vehicle,damper,date,file,kind\n";
    assert_eq!(
        error(&format!(
            "{header}401,a,2026-03-14,a.csv,\n401,a,14.03.2026,b.csv,\n"
        )),
        "/recordings.csv:3: column date: \"14.03.2026\", allowed: YYYY-MM-DD"
    );
    assert_eq!(
        error(&format!("{header}401,a,2026-03-14,a.csv,sideways\n")),
        "/recordings.csv:2: column kind: \"sideways\", allowed: vertical, lateral, yaw"
    );
    assert!(error(&format!("{header},a,2026-03-14,a.csv,\n")).contains("column vehicle: empty"));
    assert!(
        error("vehicle,damper,date,file,milage\n401,a,2026-03-14,a.csv,7\n")
            .contains("unknown field `milage`")
    );
    assert!(error("vehicle,damper,file\n401,a,a.csv\n").contains("missing field `date`"));
    assert!(error(header).contains("no recording"));
}

#[test]
fn names_of_folders_and_files_say_vehicle_damper_and_date() {
    let folder = tempfile::tempdir().unwrap();
    let damper = folder.path().join("401/front-yaw-1");
    fs::create_dir_all(&damper).unwrap();
    for name in [
        "2026-04-01.mf4",
        "2026-03-14.csv.gz",
        "notes.txt",
        ".hidden",
    ] {
        fs::write(damper.join(name), "").unwrap();
    }
    fs::write(folder.path().join("401/readme"), "").unwrap();
    let listed = list(folder.path()).unwrap();
    assert_eq!(listed.len(), 3);
    assert!(
        listed
            .iter()
            .all(|listed| listed.vehicle == "401" && listed.kind == Kind::Yaw)
    );
    let (placed, unplaced) = series(listed, Axis::Date);
    let dates = placed[0]
        .recordings
        .iter()
        .map(|listed| listed.date.unwrap().to_string());
    assert_eq!(dates.collect::<Vec<_>>(), ["2026-03-14", "2026-04-01"]);
    assert!(unplaced[0].listed.file.ends_with("notes.txt"));
}

#[test]
fn a_new_serial_number_begins_a_new_series() {
    let row = |date: &str, serial_number: &str| format!("401,a,{date},x.csv,{serial_number}\n");
    let rows: String = [
        ("2026-03-01", "7"),
        ("2026-01-01", "7"),
        ("2026-05-01", "8"),
        ("2026-06-01", "7"),
    ]
    .map(|(date, serial_number)| row(date, serial_number))
    .concat();
    let folder = with_index(&format!("vehicle,damper,date,file,serial_number\n{rows}"));
    let (placed, _) = series(list(folder.path()).unwrap(), Axis::Date);
    // Number 7 comes back from its overhaul as another damper.
    let found = placed
        .iter()
        .map(|series| (series.recordings.len(), series.is_installed));
    assert_eq!(
        found.collect::<Vec<_>>(),
        [(2, false), (1, false), (1, true)]
    );
}
