//! `dashpot health`: the fleet from a folder of recordings, its page, its tables, and what is wrong with a folder.

use std::fs;
use std::path::Path;

use assert_cmd::assert::Assert;
use xtask::run::repository;

use crate::common::{dashpot, error_of, json_of, text_of};

const NOISE: [&str; 4] = ["--displacement-noise-m", "60e-6", "--force-noise-n", "60"];

/// Extensions of the recordings of five months.
const EXTENSIONS: [&str; 5] = ["csv", "mf4", "parquet", "csv", "mf4"];

fn health(folder: &Path, options: &[&str]) -> Assert {
    let command = ["health", "--history", "fleet", "--damper", "in-service"];
    dashpot(&[&command[..], &NOISE, options].concat(), folder)
}

/// Records the ride with a damper whose clearance (mm) is given for each month.
fn record(folder: &Path, damper: &str, clearances_mm: [f64; 5]) {
    let positions = folder.join("fleet/401").join(damper);
    fs::create_dir_all(&positions).unwrap();
    let ride = repository().join("data/excitations/ride_made.csv");
    for (month, (clearance_mm, extension)) in clearances_mm.iter().zip(EXTENSIONS).enumerate() {
        let clearance = format!("mount.clearance_m={clearance_mm}e-3");
        let output = format!("fleet/401/{damper}/2026-0{}-01.{extension}", month + 1);
        let replay = [
            "replay",
            "--damper",
            "in-service",
            "--set",
            &clearance,
            "--input",
            ride.to_str().unwrap(),
        ];
        dashpot(&[&replay[..], &["--output", &output]].concat(), folder).success();
    }
}

/// A healthy lateral damper, and a vertical one whose clearance grows by 0.2 mm a month.
fn fleet() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    record(folder.path(), "rear-lateral-1", [1.0; 5]);
    record(folder.path(), "front-left", [1.0, 1.2, 1.4, 1.6, 1.8]);
    folder
}

#[test]
fn the_worn_damper_is_first_and_a_bad_file_stops_nothing() {
    let folder = fleet();
    let bad = folder
        .path()
        .join("fleet/401/rear-lateral-1/2026-06-01.csv");
    fs::write(bad, "no <recording>\n").unwrap();
    let options = [
        "--page",
        "fleet.html",
        "--trends",
        "trends.csv",
        "--format",
        "json",
    ];
    let ended = health(folder.path(), &options).code(1);
    assert_eq!(error_of(&ended), "error: 1 recording cannot be read\n");
    let report = json_of(&ended);
    assert_eq!(
        (&report["dampers"], &report["recordings"]),
        (&2.into(), &11.into()),
        "{report}"
    );
    assert_eq!(report["recordings_used"], 10, "{}", report["refused"]);
    let trends = report["trends"].as_array().unwrap();
    let clearance = &trends[2];
    assert_eq!(clearance["damper"], "front-left");
    assert_eq!(clearance["parameter"], "clearance_m");
    assert_eq!(
        (&clearance["kind"], &clearance["verdict"]),
        (&"vertical".into(), &"reached".into()),
        "{clearance}"
    );
    // 2.9 mm is reached 9.5 months after January.
    let [earliest, latest] =
        ["limit_earliest", "limit_latest"].map(|key| clearance[key].as_str().unwrap());
    assert!(
        earliest < "2026-10-18" && latest > "2026-10-12",
        "{clearance}"
    );
    assert!(earliest > "2026-08" && latest < "2027-01", "{clearance}");
    assert_eq!(trends[5]["verdict"], "no_limit", "{}", trends[5]);
    let refused = report["refused"].as_array().unwrap();
    assert_eq!(refused.len(), 1);
    assert!(
        refused[0]["refused_because"]
            .as_str()
            .unwrap()
            .contains("time_s"),
        "{}",
        refused[0]
    );

    let page = fs::read_to_string(folder.path().join("fleet.html")).unwrap();
    for part in [
        "<h1>Dampers of a fleet</h1>",
        "front-left",
        "2026-06-01.csv",
        "&lt;recording&gt;",
    ] {
        assert!(page.contains(part), "{part}");
    }
    let (first, second) = (page.find("front-left"), page.find("rear-lateral-1"));
    assert!(first < second, "{first:?} {second:?}");
    let rows = fs::read_to_string(folder.path().join("trends.csv")).unwrap();
    assert_eq!(rows.lines().count(), 7);

    let text = text_of(&health(folder.path(), &[]).code(1));
    assert!(
        text.starts_with("2 dampers of 1 vehicle, 10 of 11 recordings used\n"),
        "{text}"
    );
    assert!(
        text.lines()
            .nth(3)
            .is_some_and(|line| line.starts_with("401      front-left ")),
        "{text}"
    );
    assert!(
        text.contains("note: not used: fleet/401/rear-lateral-1/2026-06-01.csv: "),
        "{text}"
    );
}

#[cfg(feature = "parquet")]
#[test]
fn parquet_has_the_numbers_of_csv() {
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::Field;

    let folder = fleet();
    let index: String = (1..=5)
        .flat_map(|month| ["front-left", "rear-lateral-1"].map(|damper| (month, damper)))
        .map(|(month, damper)| {
            let extension = EXTENSIONS[month - 1];
            format!(
                "401,{damper},2026-0{month}-01,{}00,401/{damper}/2026-0{month}-01.{extension}\n",
                100 * month
            )
        })
        .collect();
    let index = format!("vehicle,damper,date,mileage_km,file\n{index}");
    fs::write(folder.path().join("fleet/recordings.csv"), index).unwrap();
    for (readings, trends) in [("r.csv", "t.csv"), ("r.parquet", "t.parquet")] {
        let options = ["--mileage", "--output", readings, "--trends", trends];
        let text = text_of(&health(folder.path(), &options).success());
        assert!(
            text.contains(&format!("wrote {readings}\nwrote {trends}\n")),
            "{text}"
        );
        assert!(text.contains(" per 100 000 km "), "{text}");
    }
    for (table, count) in [("r", 10), ("t", 6)] {
        let mut rows = csv::Reader::from_path(folder.path().join(format!("{table}.csv"))).unwrap();
        let file = fs::File::open(folder.path().join(format!("{table}.parquet"))).unwrap();
        let reader = SerializedFileReader::new(file).unwrap();
        let mut found = reader.get_row_iter(None).unwrap();
        let names = rows.headers().unwrap().clone();
        let mut seen = 0;
        for row in rows.records() {
            let found = found.next().unwrap().unwrap();
            seen += 1;
            for (cell, (name, (found_name, value))) in row
                .unwrap()
                .iter()
                .zip(names.iter().zip(found.get_column_iter()))
            {
                assert_eq!(name, found_name);
                match value {
                    Field::Double(number) => {
                        assert_eq!(cell.parse::<f64>().unwrap(), *number, "{name}")
                    }
                    Field::Str(text) => assert_eq!(cell, text, "{name}"),
                    Field::Null => assert_eq!(cell, "", "{name}"),
                    other => panic!("{name}: {other:?}"),
                }
            }
            assert!(matches!(
                found.get_column_iter().find(|(name, _)| *name == "vehicle"),
                Some((_, Field::Str(_)))
            ));
        }
        assert_eq!((seen, found.next().is_none()), (count, true));
    }
}

#[test]
fn what_is_wrong_with_a_folder_or_an_option_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let error = |options: &[&str], code: i32| error_of(&health(folder.path(), options).code(code));
    assert!(
        error(&[], 1).contains("fleet: cannot read"),
        "{}",
        error(&[], 1)
    );
    fs::create_dir(folder.path().join("fleet")).unwrap();
    assert!(
        error(&[], 1).contains("VEHICLE/DAMPER/DATE.EXTENSION"),
        "{}",
        error(&[], 1)
    );
    let index = folder.path().join("fleet/recordings.csv");
    fs::write(&index, "vehicle,damper,date,file\n401,a,2026,x.csv\n").unwrap();
    let expected = "fleet/recordings.csv:2: column date: \"2026\", allowed: YYYY-MM-DD";
    assert!(error(&[], 1).contains(expected), "{}", error(&[], 1));
    fs::write(&index, "vehicle,damper,date,file\n401,a,2026-01-01,x.csv\n").unwrap();
    assert!(error(&["--limit-clearance-m", "-1"], 2).contains("--limit-clearance-m"));
    assert!(error(&["--output", "x.mf4"], 2).contains("allowed: .csv, .parquet"));
    assert!(error(&["--output", "x", "--trends", "x"], 2).contains("--output and --trends"));
    assert!(error(&["--output", "fleet/recordings.csv"], 2).contains("--output"));
    assert!(error(&["--memory-s", "0"], 2).contains("--memory-s"));
    assert!(error(&["--set", "mount.clearance=1"], 2).contains("after --set"));
    // A listed recording that is not there is listed with the reason.
    let text = text_of(&health(folder.path(), &["--mileage"]).success());
    assert!(
        text.contains("x.csv: no mileage_km in recordings.csv"),
        "{text}"
    );
    let text = text_of(&health(folder.path(), &[]).code(1));
    assert!(text.contains("fleet/x.csv: cannot read"), "{text}");
}
