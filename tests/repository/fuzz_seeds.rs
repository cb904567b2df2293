//! Checks the seeds in `fuzz/seeds/`. They are valid input, so that fuzzing reaches the code behind the checks.
//! `DASHPOT_BLESS=1 cargo test -p dashpot --test repository fuzz_seeds` writes them.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use dashpot::requests::every_request;
use dashpot::{damper, document};
use dashpot_core::Damper;
use dashpot_core::health::HealthSettings;
use dashpot_core::hybrid::wire::{Frame, FrameFlags, FrameKind};
use dashpot_core::link::{Header, Reals, Request, request_frame};
use dashpot_files::actuator::ACTUATORS;
use dashpot_files::case::{CASES, CaseOptions};
use dashpot_files::damper::PRESETS;
use dashpot_files::sheet::{SHEETS, SheetParameters};
use dashpot_files::study::{STUDIES, StudyParameters};
use dashpot_files::track::TRACKS;
use dashpot_files::vehicle::VEHICLES;
use dashpot_rail::profile::Body;
use dashpot_rail::profile::measured::{self, Mirror, Options};
use dashpot_rail::track;
use dashpot_study::sweep::{Row, Study};

/// Name and bytes of a seed.
type Seed = (String, Vec<u8>);

/// Asserts that the target's folder has exactly these files, or writes them when blessing.
pub fn compare(target: &str, seeds: Vec<Seed>) {
    let folder = format!("fuzz/seeds/{target}");
    if document::blessing() {
        fs::create_dir_all(document::in_repository(&folder)).expect("a folder");
    }
    let names: BTreeSet<&str> = seeds.iter().map(|(name, _)| &**name).collect();
    for (name, bytes) in &seeds {
        document::compare_bytes(&format!("{folder}/{name}"), bytes);
    }
    let found = fs::read_dir(document::in_repository(&folder)).expect("the target's seeds");
    for entry in found {
        let name = entry.expect("an entry").file_name();
        let name = name.to_string_lossy();
        assert!(
            names.contains(&*name),
            "{folder}/{name}: not a seed of this test"
        );
    }
}

/// Seeds from texts that ship with the program.
fn shipped(texts: &[(&str, &str)]) -> Vec<Seed> {
    let seeds = texts
        .iter()
        .map(|(name, text)| ((*name).to_owned(), text.as_bytes().to_vec()));
    seeds.collect()
}

#[test]
fn damper_files_are_the_presets() {
    compare("damper_file", shipped(&PRESETS));
}

/// One more seed is needed because the shipped files have no ride points.
#[test]
fn vehicle_files_are_the_shipped_ones_and_one_with_a_ride_point() {
    let ride_points = include_str!("vehicle.toml");
    let parsed = dashpot_files::vehicle::parse("vehicle.toml", ride_points, &[]);
    assert!(parsed.is_ok(), "{:?}", parsed.err());
    let mut seeds = shipped(&VEHICLES);
    seeds.push(("ride-points".into(), ride_points.into()));
    compare("vehicle_file", seeds);
}

/// One more seed is needed because the shipped files have no defects and no German spectrum.
#[test]
fn track_files_are_the_shipped_ones_and_one_with_all_keys() {
    let every_key = include_str!("track.toml");
    let parsed = dashpot_files::track::parse("track.toml", every_key, Path::new(""));
    assert!(parsed.is_ok(), "{:?}", parsed.err());
    let mut seeds = shipped(&TRACKS);
    seeds.push(("every-key".into(), every_key.into()));
    compare("track_file", seeds);
}

/// One more seed is needed because the shipped files have no faults.
#[test]
fn case_files_are_the_shipped_ones_and_one_with_all_keys() {
    let every_key = include_str!("case.toml");
    let parsed = CaseOptions::parse("case.toml", every_key).and_then(|options| options.case());
    assert!(parsed.is_ok(), "{:?}", parsed.err());
    let mut seeds = shipped(&CASES);
    seeds.push(("every-key".into(), every_key.into()));
    compare("case_file", seeds);
}

#[test]
fn actuator_files_are_the_shipped_ones() {
    compare("actuator_file", shipped(&ACTUATORS));
}

/// Messages of a page, one of each kind, with what they may contain.
#[test]
fn messages_of_the_live_page_are_one_of_each_kind() {
    let act =
        |action: &str| format!(r#"{{"id": 7, "do": "act", "action": {{"action": {action}}}}}"#);
    let damper = r#""damper": "front yaw damper 1""#;
    let messages = [
        (
            "damper",
            act(&format!(
                r#""damper", {damper}, "key": "mount.clearance_m", "value": 0.003"#
            )),
        ),
        (
            "wear",
            act(&format!(
                r#""damper", {damper}, "key": "wear", "value": 0.5"#
            )),
        ),
        (
            "preset",
            act(&format!(r#""preset", {damper}, "preset": "in-service""#)),
        ),
        ("as-new", act(&format!(r#""as-new", {damper}"#))),
        (
            "fault",
            act(&format!(r#""fault", {damper}, "fault": "torn-off""#)),
        ),
        ("speed", act(r#""speed", "speed_km_h": 90"#)),
        ("friction", act(r#""friction", "factor": 0.5"#)),
        ("defect", act(r#""defect", "kind": "twist", "size": 15"#)),
        ("gust", act(r#""gust", "force_n": 3e4, "duration_s": 3"#)),
        ("run", r#"{"id": 1, "do": "run", "factor": 0.1}"#.into()),
        ("step", r#"{"id": 1, "do": "step", "ticks": 2}"#.into()),
        (
            "compare",
            r#"{"id": 1, "do": "compare", "on": true}"#.into(),
        ),
        ("save", r#"{"id": 1, "do": "save"}"#.into()),
        ("load", r#"{"id": 1, "do": "load", "state": "{}"}"#.into()),
        ("record", r#"{"id": 1, "do": "record", "on": true}"#.into()),
        (
            "recording",
            r#"{"id": 1, "do": "recording", "format": "csv"}"#.into(),
        ),
        ("status", r#"{"id": 1, "do": "status"}"#.into()),
        ("stop", r#"{"id": 1, "do": "stop"}"#.into()),
    ];
    let seeds = messages
        .into_iter()
        .map(|(name, text)| (name.to_owned(), text.into_bytes()));
    compare("live_message", seeds.collect());
}

#[test]
fn rig_frames_are_one_of_each_kind() {
    let frame = |kind| Frame {
        kind,
        flags: FrameFlags::START,
        session: 7,
        sequence: 2,
        answers: 1,
        time_s: 0.002,
        displacement_m: 0.01,
        other: 0.5,
    };
    let seed = |name: &str, kind| (name.to_owned(), frame(kind).to_bytes().to_vec());
    let seeds = [
        seed("command", FrameKind::Command),
        seed("measurement", FrameKind::Measurement),
    ];
    compare("rig_frame", seeds.into());
}

/// One more seed is needed because the shipped file does not have every index.
#[test]
fn sheet_files_are_the_shipped_one_and_one_with_all_keys() {
    let every_key = include_str!("sheet.toml");
    let parsed = SheetParameters::parse("sheet.toml", every_key);
    assert!(parsed.is_ok(), "{:?}", parsed.err());
    let mut seeds = shipped(&SHEETS);
    seeds.push(("every-key".into(), every_key.into()));
    compare("sheet_file", seeds);
}

/// One more seed is needed because the shipped files have neither equal ratios nor a vehicle of their own.
#[test]
fn study_files_are_the_shipped_ones_and_one_with_all_keys() {
    let every_key = include_str!("study.toml");
    let parsed = StudyParameters::parse("study.toml", every_key);
    assert!(parsed.is_ok(), "{:?}", parsed.err());
    let mut seeds = shipped(&STUDIES);
    seeds.push(("every-key".into(), every_key.into()));
    compare("study_file", seeds);
}

/// The seeds are rows computed of three cases, one of them without an index.
#[test]
fn study_rows_are_of_a_shipped_study() {
    let parameters = StudyParameters::load("hunting").expect("a shipped study");
    let study = Study::new(parameters).expect("a shipped study");
    let seed = |number: u64, observed: Option<f64>| {
        let row = Row {
            case: number,
            ending: "completed".into(),
            observed: vec![observed],
        };
        let case = study.case(number).expect("a case");
        let record = study.record(&case, &row);
        let cells = record.iter().map(String::as_str);
        assert_eq!(study.row(cells), Ok(row));
        // The fuzz target appends the digests of physics and row, which change with the text.
        let text = record[..record.len() - 2].join(",");
        (format!("row_{number}"), text.into_bytes())
    };
    compare(
        "study_row",
        vec![seed(0, Some(3.2e-8)), seed(53, Some(6.6e-3)), seed(7, None)],
    );
}

#[test]
fn images_are_of_dampers_in_both_precisions() {
    let single: Damper<f32> = damper("in-service", &[]).build(1e-3).expect("a preset");
    let reduced: Damper<f32> = damper("reduced-vertical", &[])
        .build(1e-3)
        .expect("a preset");
    let double: Damper<f64> = damper("paper", &[]).build(1e-4).expect("a preset");
    compare(
        "image",
        vec![
            ("in_service_f32".into(), single.to_image().into()),
            ("reduced_vertical_f32".into(), reduced.to_image().into()),
            ("paper_f64".into(), double.to_image().into()),
        ],
    );
}

/// Each seed is a session with one request to two dampers at rest. For a request about health, it first loads the
/// model.
#[test]
fn frames_are_of_every_request() {
    let built: Damper<f32> = damper("reduced-vertical", &[])
        .build(1e-3)
        .expect("a preset");
    let image = built.to_image();
    // The fuzz target's device has dampers whose words are all zero.
    let zeros = Damper::<f32>::from_words(&[0; Damper::<f32>::WORDS]);
    let states = [zeros.at_rest(0.0).to_bytes(); 2].concat();
    let displacements_m = Reals::from_iter([1e-3, -2e-3]);
    let settings = HealthSettings::new(60e-6, 60.0);
    let checked = damper("reduced-vertical", &[]).check().expect("a preset");
    let model = checked.health_model(&settings, 1e-3).expect("in range");
    let model = model.to_image();
    let requests = every_request(&image, &model, &states, &displacements_m);
    let frame = |sequence: u32, request: &Request<'_>| {
        let header = Header {
            session: 1,
            sequence,
        };
        request_frame(header, request).bytes().to_vec()
    };
    let hello = frame(0, &requests[0]);
    let load = |request: &&Request<'_>| matches!(request, Request::LoadHealth { .. });
    let load = requests.iter().find(load).expect("a model");
    let seeds = requests.iter().map(|request| {
        let text = format!("{request:?}");
        let name = text.chars().take_while(char::is_ascii_alphabetic);
        let name: String = name.collect();
        // These requests come first in the session.
        let earlier = match request {
            Request::Hello { .. } => vec![],
            Request::Measure { .. } | Request::Health { .. } | Request::ClearHealth { .. } => {
                vec![hello.clone(), frame(1, load)]
            }
            _ => vec![hello.clone()],
        };
        let frame = frame(earlier.len() as u32, request);
        let all = earlier.into_iter().chain([frame]);
        (name.to_lowercase(), all.flatten().collect())
    });
    compare("link_frame", seeds.collect());
}

#[test]
fn recordings_are_of_every_kind() {
    let rows = "0,0\n0.001,1.5e-4\n0.0021,-2e-4\n0.0031,0\n";
    let headed = format!("# made\ntime_s,displacement_m\n{rows}");
    let german = "Zeit [ms];Weg\n[s];[mm]\n0,5;1\n1,5;-2,25;\n";
    let mut seeds: Vec<Seed> = vec![
        ("headed.csv".into(), headed.clone().into()),
        ("crlf.csv".into(), headed.replace('\n', "\r\n").into()),
        ("german.csv".into(), german.into()),
        // The fuzz target writes the header.
        ("rows.csv".into(), rows.into()),
    ];
    let samples = document::in_repository("hil-host/tests/recordings/samples");
    for name in [
        "transposed.mf4",
        "groups.mf4",
        "nulls.parquet",
        "stamps_us.parquet",
        "german.csv.gz",
    ] {
        let bytes = fs::read(samples.join(name)).expect("a sample");
        seeds.push((name.into(), bytes));
    }
    compare("recording", seeds);
}

#[test]
fn profiles_are_the_samples_of_every_format() {
    let folder = document::in_repository("rail/tests/data");
    let mut seeds = Vec::new();
    for entry in fs::read_dir(folder).expect("the samples") {
        let path = entry.expect("an entry").path();
        let name = path.file_name().expect("a name").to_string_lossy();
        let body = match &*name {
            "README.md" => continue,
            name if name.starts_with("s1002") => Body::Wheel,
            _ => Body::Rail,
        };
        let text = fs::read_to_string(&path).expect("text");
        let options = Options::default().with_mirror(name.ends_with(".rail").then_some(Mirror::Y));
        let read = measured::parse(&name, &text, body, &options);
        assert!(read.is_ok(), "{name}: {:?}", read.err());
        seeds.push((name.into_owned(), text.into_bytes()));
    }
    compare("measured_profile", seeds);
}

#[test]
fn tracks_are_in_m_and_mm_with_and_without_header() {
    let row = |i: u32| {
        let distance_m = 0.25 * f64::from(i);
        format!("{distance_m},0.00{i},-1e-3,0,0\n")
    };
    let rows: String = (0..9).map(row).collect();
    let headed = format!("distance_m,vertical_m,lateral_m,cross_level_m,gauge_m\n{rows}");
    let one = (0..9).map(|i| format!("-{i}.5 , {}\r\n", 30 + i));
    let one: String = one.collect();
    let millimetres = format!("# made\r\ngauge_mm,distance_m\r\n{one}");
    let options = track::measured::Options::default().with_ramp_m(1.0);
    for text in [&headed, &millimetres] {
        let read = track::measured::parse(text, &options);
        assert!(read.is_ok(), "{:?}", read.err());
    }
    compare(
        "measured_track",
        vec![
            ("headed.csv".into(), headed.into()),
            ("millimetres.csv".into(), millimetres.into()),
            // The fuzz target writes the header.
            ("rows.csv".into(), rows.into()),
        ],
    );
}
