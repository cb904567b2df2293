//! docs/reference/indices.md lists every index of a run and of its wear by its name in `indices.json`, and no other.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use dashpot_files::case::CaseOptions;
use dashpot_vehicle_run::wear::WearLaw;
use dashpot_vehicle_run::{Indexer, Run, RunWear};
use serde::Serialize;
use serde_json::Value;

/// Names of all values, such as `wheelsets[].wheels[].side`. `nadal` is one of `nadal_limits`, so it counts as a whole.
fn names(value: &impl Serialize) -> BTreeSet<String> {
    fn collect(value: &Value, path: &str, names: &mut BTreeSet<String>) {
        match value {
            Value::Object(keys) if path != "nadal" => {
                for (key, value) in keys {
                    let dot = if path.is_empty() { "" } else { "." };
                    collect(value, &format!("{path}{dot}{key}"), names);
                }
            }
            Value::Array(values) if values.iter().all(Value::is_object) => {
                assert!(!values.is_empty(), "{path} is empty");
                for value in values {
                    collect(value, &format!("{path}[]"), names);
                }
            }
            _ => {
                names.insert(path.to_owned());
            }
        }
    }
    let mut found = BTreeSet::new();
    collect(&serde_json::to_value(value).unwrap(), "", &mut found);
    found
}

/// Names in the first cells of the tables of a section of the page.
fn documented(section: &str) -> BTreeSet<String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/reference/indices.md");
    let page = fs::read_to_string(&path).unwrap();
    let heading = format!("## {section}");
    let lines = page.lines().skip_while(|line| *line != heading).skip(1);
    let lines = lines.take_while(|line| !line.starts_with("## "));
    let rows = lines.filter_map(|line| line.strip_prefix("| `"));
    let cells = rows.map(|row| row.split('|').next().unwrap().trim().trim_end_matches('`'));
    cells
        .flat_map(|cell| cell.split("`, `").map(str::to_owned))
        .collect()
}

#[test]
fn the_page_lists_the_indices_of_a_run_and_no_others() {
    let mut options = CaseOptions::load("curve-r300").unwrap();
    options.duration_s = 0.02;
    let case = options.case().unwrap();
    let mut run = Run::new(&case).unwrap();
    let mut indexer = Indexer::new(&case);
    let mut wear = RunWear::new(&case, &run, WearLaw::default());
    while run.step().unwrap().is_none() {
        indexer.add(run.state());
        wear.add(run.state());
    }
    assert_eq!(
        names(&indexer.indices().unwrap()),
        documented("Vehicle run")
    );
    assert_eq!(names(&wear.indices().unwrap()), documented("Wear"));
}
