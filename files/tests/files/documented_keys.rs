//! The documents of the files that people write list every key of each table and no other key, with the allowed range.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use dashpot_files::actuator::{ACTUATORS, ActuatorParameters};
use dashpot_files::case::CaseOptions;
use dashpot_files::sheet::SheetParameters;
use dashpot_files::study::StudyParameters;
use dashpot_files::track::TrackParameters;
use dashpot_files::vehicle::VEHICLES;
use dashpot_files::{damper, track};
use tempfile::tempdir;

/// Key that no table has. Readers answer it with the keys that the table has.
const WRONG: &str = "not_a_key";

/// Reads a file and returns the error.
type Reader = fn(&str) -> Result<(), String>;

/// Kind of file: the page that documents it, its reader, and its tables. Each table has a heading of the page and a
/// file in which it has the wrong key.
struct Kind {
    page: &'static str,
    reader: Reader,
    tables: &'static [(&'static str, &'static str)],
}

const KINDS: [Kind; 6] = [
    Kind {
        page: "reference/vehicle-file.md",
        reader: read_vehicle,
        tables: &[
            ("Top of the file", "not_a_key = 1"),
            ("`[[body]]`", "[[body]]\nnot_a_key = 1"),
            ("`[[wheelset]]`", "[[wheelset]]\nnot_a_key = 1"),
            ("`[[spring_damper]]`", "[[spring_damper]]\nnot_a_key = 1"),
            ("`[[bush]]`", "[[bush]]\nnot_a_key = 1"),
            ("`[[damper]]`", "[[damper]]\nnot_a_key = 1"),
            ("`[[bump_stop]]`", "[[bump_stop]]\nnot_a_key = 1"),
            ("`[[friction]]`", "[[friction]]\nnot_a_key = 1"),
            ("`[[anti_roll_bar]]`", "[[anti_roll_bar]]\nnot_a_key = 1"),
            ("`[[traction_rod]]`", "[[traction_rod]]\nnot_a_key = 1"),
            ("`[[ride_point]]`", "[[ride_point]]\nnot_a_key = 1"),
            ("`[contact]`", "[contact]\nnot_a_key = 1"),
            (
                "`[[contact.other_wheel]]`",
                "[[contact.other_wheel]]\nnot_a_key = 1",
            ),
        ],
    },
    Kind {
        page: "reference/case-file.md",
        reader: read_case,
        tables: &[
            ("Top of the file", "not_a_key = 1"),
            ("`[rails]`", "[rails]\nnot_a_key = 1"),
            ("`[[fault]]`", "[[fault]]\nnot_a_key = 1"),
            ("`[[event]]`", "[[event]]\nnot_a_key = 1"),
            ("`[contact]`", "[contact]\nnot_a_key = 1"),
        ],
    },
    Kind {
        page: "track.md",
        reader: read_track,
        tables: &[
            ("Top of the file", "not_a_key = 1"),
            ("`[[part]]`", "[[part]]\nnot_a_key = 1"),
            ("`[irregularity]`", "[irregularity]\nnot_a_key = 1"),
            ("`[[defect]]`", "[[defect]]\nnot_a_key = 1"),
        ],
    },
    Kind {
        page: "reference/study-file.md",
        reader: |text| error_of(StudyParameters::parse("file.toml", text)),
        tables: &[
            ("Top of the file", "not_a_key = 1"),
            ("`[[sweep]]`", "[[sweep]]\nnot_a_key = 1"),
            ("`[[sweep.vary]]`", "[[sweep]]\nvary = [{ not_a_key = 1 }]"),
            ("`[[figure]]`", "[[figure]]\nnot_a_key = 1"),
            (
                "`[figure.indices]`",
                "[[figure]]\nindices = { not_a_key = 1 }",
            ),
            (
                "`[figure.dampers]`",
                "[[figure]]\ndampers = { not_a_key = 1 }",
            ),
            (
                "`[figure.signal]`",
                "[[figure]]\nsignal = { not_a_key = 1 }",
            ),
            (
                "`[figure.response]`",
                "[[figure]]\nresponse = { not_a_key = 1 }",
            ),
        ],
    },
    Kind {
        page: "rig.md",
        reader: |text| error_of(SheetParameters::parse("file.toml", text)),
        tables: &[
            ("Top of the file", "not_a_key = 1"),
            ("`[[field]]`", "[[field]]\nnot_a_key = 1"),
            ("`[[test]]`", "[[test]]\nnot_a_key = 1"),
            (
                "`[test.limits.INDEX]`",
                "[[test]]\nlimits = { asymmetry_rate = { not_a_key = 1 } }",
            ),
        ],
    },
    Kind {
        page: "reference/actuator-file.md",
        reader: read_actuator,
        tables: &[
            ("Top of the file", "not_a_key = 1"),
            ("`[limits]`", "[limits]\nnot_a_key = 1"),
            ("`[coupled]`", "[coupled]\nnot_a_key = 1"),
            ("`[second_order]`", "[second_order]\nnot_a_key = 1"),
            ("`[servo_hydraulic]`", "[servo_hydraulic]\nnot_a_key = 1"),
            (
                "`[displacement_sensor]`",
                "[displacement_sensor]\nnot_a_key = 1",
            ),
            ("`[force_sensor]`", "[force_sensor]\nnot_a_key = 1"),
        ],
    },
];

fn error_of<T, E: ToString>(read: Result<T, E>) -> Result<(), String> {
    read.map(drop).map_err(|error| error.to_string())
}

fn read_vehicle(text: &str) -> Result<(), String> {
    let folder = tempdir().unwrap();
    let file = folder.path().join("file.toml");
    fs::write(&file, text).unwrap();
    // A case also checks the dimensions of the wheels.
    error_of(CaseOptions::new(file.to_str().unwrap(), "ideal", 72.0).case())
}

fn read_case(text: &str) -> Result<(), String> {
    error_of(CaseOptions::parse("file.toml", text).and_then(|options| options.case()))
}

fn read_track(text: &str) -> Result<(), String> {
    let parameters: TrackParameters =
        track::parse("file.toml", text, Path::new("")).map_err(|error| error.to_string())?;
    error_of(parameters.build())
}

fn read_actuator(text: &str) -> Result<(), String> {
    error_of(ActuatorParameters::parse("file.toml", text))
}

fn page(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../docs")
        .join(name);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The words between backquotes.
fn quoted(text: &str) -> BTreeSet<String> {
    let words = text.split('`').skip(1).step_by(2);
    words.map(str::to_owned).collect()
}

/// The keys that a reader lists in its answer to the wrong key.
fn accepted(reader: Reader, wrong: &str) -> BTreeSet<String> {
    let message = reader(wrong).expect_err(wrong);
    let unknown = ["unknown field", "unknown variant"].map(|what| format!("{what} `{WRONG}`"));
    let at = unknown.iter().find_map(|what| message.find(what));
    let at = at.unwrap_or_else(|| panic!("{wrong:?}: {message}"));
    let expected = &message[at..].split("; did you mean").next().unwrap();
    let mut keys = quoted(expected);
    keys.remove(WRONG);
    assert!(!keys.is_empty(), "{message}");
    keys
}

/// Cells of the rows of the table below a heading; `None` if there is no such heading.
fn rows<'a>(page: &'a str, heading: &str) -> Option<Vec<Vec<&'a str>>> {
    let is_heading = |line: &&str| line.starts_with("##");
    let mut lines = page.lines();
    lines.find(|line| is_heading(line) && line.trim_start_matches('#').trim() == heading)?;
    let table = lines.take_while(|line| !is_heading(line));
    let rows = table.filter(|line| line.starts_with("| `"));
    Some(
        rows.map(|row| {
            let cells = row.split('|').skip(1);
            cells.map(str::trim).collect()
        })
        .collect(),
    )
}

#[test]
fn every_key_is_documented_and_every_documented_key_exists() {
    for Kind {
        page: name,
        reader,
        tables,
    } in KINDS
    {
        let text = page(name);
        for (heading, wrong) in tables {
            let rows = rows(&text, heading)
                .unwrap_or_else(|| panic!("docs/{name}: no heading `{heading}`"));
            let documented = rows.iter().flat_map(|row| quoted(row[0])).collect();
            let accepted = accepted(reader, wrong);
            let missing: Vec<_> = accepted.difference(&documented).collect();
            let stale: Vec<_> = documented.difference(&accepted).collect();
            assert!(
                missing.is_empty() && stale.is_empty(),
                "docs/{name}, {heading}: missing {missing:?}, stale {stale:?}"
            );
        }
    }
}

/// docs/parameters.md has one table for all tables of a damper file.
#[test]
fn every_key_of_a_damper_is_documented() {
    let read: Reader = |text| error_of(damper::parse("file.toml", text, &[]));
    let text = page("parameters.md");
    let mut documented: BTreeMap<&str, BTreeSet<String>> = BTreeMap::new();
    let mut table = "";
    for line in text.lines().filter(|line| line.starts_with('|')) {
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        if let Some(name) = cells[1].strip_prefix("`[") {
            table = name.trim_end_matches("]`");
        }
        documented
            .entry(table)
            .or_default()
            .extend(quoted(cells[2]));
    }
    let expect = |table: &str, keys: BTreeSet<String>| {
        let accepted = accepted(read, &format!("[{table}]\n{WRONG} = 1"));
        assert_eq!(accepted, keys, "docs/parameters.md, [{table}]");
    };
    let column = documented.get("oil.column").cloned().unwrap_or_default();
    for (table, keys) in &documented {
        match *table {
            "" => {}
            "valves.*" => {
                for valve in accepted(read, &format!("[valves]\n{WRONG} = 1")) {
                    assert!(text.contains(&format!("`[valves.{valve}]`")), "{valve}");
                    expect(&format!("valves.{valve}"), keys.clone());
                }
            }
            "oil" => {
                let mut with_column = keys.clone();
                with_column.insert("column".to_owned());
                expect(table, with_column);
            }
            _ => expect(table, keys.clone()),
        }
    }
    assert!(column.contains("air_fraction"), "{column:?}");
    for table in accepted(read, &format!("{WRONG} = 1")) {
        let has = documented
            .keys()
            .any(|known| known.split('.').next() == Some(&table[..]));
        assert!(has, "docs/parameters.md: no table [{table}]");
    }
}

/// Sets a key of a table: of the first table in an array that has the key, or of the first one. Returns true if the key
/// had a value.
fn set(file: &mut toml::Table, path: &str, key: &str, number: f64) -> bool {
    let mut table = file;
    for name in path.split('.').filter(|name| !name.is_empty()) {
        let next = table
            .entry(name)
            .or_insert_with(|| toml::Table::new().into());
        table = match next {
            toml::Value::Array(tables) => {
                let has_key = |value: &toml::Value| value.get(key).is_some();
                let at = tables.iter().position(has_key).unwrap_or(0);
                tables[at].as_table_mut().unwrap()
            }
            next => next.as_table_mut().unwrap(),
        };
    }
    let had_value = table.contains_key(key);
    let mut value = table.entry(key).or_insert(toml::Value::Float(0.0));
    while let toml::Value::Array(values) = value {
        value = &mut values[0];
    }
    *value = toml::Value::Float(number);
    had_value
}

/// The two numbers of `A to B`, in front of any other words.
fn range(text: &str) -> Option<[f64; 2]> {
    let (from, rest) = text.split_once(" to ")?;
    let to = rest.split([' ', ',', ';', '\n']).next()?;
    Some([from.parse().ok()?, to.parse().ok()?])
}

/// The first example of a page, if it has one.
fn example(page: &str) -> Option<&str> {
    let (_, rest) = page.split_once("```toml\n")?;
    rest.split("```").next()
}

#[test]
fn documented_ranges_are_those_of_the_readers() {
    let mut compared = 0;
    for Kind {
        page: name,
        reader,
        tables,
    } in KINDS
    {
        let text = page(name);
        let every_defect = page("../tests/repository/track.toml");
        let shipped = |texts: &[(_, &'static str)]| texts.iter().map(|(_, text)| *text).collect();
        let more: Vec<&str> = match name {
            "reference/vehicle-file.md" => shipped(&VEHICLES),
            "reference/actuator-file.md" => shipped(&ACTUATORS),
            "track.md" => vec![&every_defect],
            _ => Vec::new(),
        };
        let samples: Vec<&str> = example(&text).into_iter().chain(more).collect();
        let samples: Vec<toml::Table> = samples
            .iter()
            .map(|sample| toml::from_str(sample).expect(name))
            .collect();
        for sample in &samples {
            let text = toml::to_string(sample).unwrap();
            reader(&text).unwrap_or_else(|error| panic!("docs/{name}: {error}"));
        }
        for (heading, _) in tables {
            let path = heading.trim_matches(['`', '[', ']']);
            let path = if path.contains(' ') { "" } else { path };
            for row in rows(&text, heading).unwrap() {
                let [key] = &quoted(row[0]).into_iter().collect::<Vec<_>>()[..] else {
                    continue;
                };
                let allowed = row[3].trim_end_matches(" each");
                let Some(documented) = range(allowed).filter(|_| allowed.matches(' ').count() == 2)
                else {
                    continue;
                };
                let has_key = |sample: &&toml::Table| set(&mut (*sample).clone(), path, key, 0.0);
                let sample = samples.iter().find(has_key).unwrap_or(&samples[0]);
                let mut file = sample.clone();
                set(&mut file, path, key, 1e300);
                let error = reader(&toml::to_string(&file).unwrap()).expect_err(key);
                let stated = error
                    .rsplit_once("allowed: ")
                    .map_or("", |(_, stated)| stated);
                assert_eq!(
                    range(stated),
                    Some(documented),
                    "docs/{name}, {heading}, {key}: {error}"
                );
                compared += 1;
            }
        }
    }
    // A search that finds no ranges must fail.
    assert!(compared > 60, "{compared}");
}
