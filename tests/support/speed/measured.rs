//! Figures that benches and counts left in files.

use std::collections::HashMap;
use std::path::Path;

use serde_json::Value;

use super::Source;

/// Steps in a count of `benches/instructions.rs`.
const COUNTED_STEPS: f64 = 1000.0;

/// Figures of one run of the benches.
#[derive(Debug, Default)]
pub struct Measured {
    /// Median time of an element, s, by group and function.
    times: HashMap<(String, String), f64>,
    /// Report of `cargo xtask target`.
    target: Value,
    /// Instructions of all steps, by the name of the bench.
    counted: HashMap<String, f64>,
}

impl Measured {
    /// Reads what criterion wrote below `criterion`, the report of the emulated processors, and what Valgrind wrote
    /// below `counts`. Folders and files may be missing: their figures are then missing too.
    pub fn read(criterion: &Path, target: &Path, counts: &Path) -> Self {
        let mut measured = Self {
            target: json(target).unwrap_or_default(),
            ..Self::default()
        };
        for_each_file(criterion, &mut |path| {
            if path.ends_with("new/benchmark.json") {
                measured.times.extend(time_of_an_element(path));
            }
        });
        for_each_file(counts, &mut |path| {
            measured.counted.extend(counted(path));
        });
        measured
    }

    /// The figure of a source, in s or instructions, if it was measured.
    pub fn figure(&self, source: Source) -> Option<f64> {
        match source {
            Source::Time { group, function } => {
                let key = (group.to_owned(), function.to_owned());
                self.times.get(&key).copied()
            }
            Source::Target { processor, figure } => self.target[processor][figure].as_f64(),
            Source::Counted(name) => Some(self.counted.get(name)? / COUNTED_STEPS),
            Source::Instructions(value) | Source::Seconds(value) => Some(value),
        }
    }
}

fn json(path: &Path) -> Option<Value> {
    serde_json::from_slice(&std::fs::read(path).ok()?).ok()
}

/// Calls `visit` with each file below the folder.
fn for_each_file(folder: &Path, visit: &mut dyn FnMut(&Path)) {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    for path in entries.map(|entry| entry.path()) {
        if path.is_dir() {
            for_each_file(&path, visit);
        } else {
            visit(&path);
        }
    }
}

/// Group, function and median time of an element (s) of a bench, from criterion's two files about it.
fn time_of_an_element(benchmark: &Path) -> Option<((String, String), f64)> {
    let estimates = json(&benchmark.with_file_name("estimates.json"))?;
    let benchmark = json(benchmark)?;
    let text = |key: &str| benchmark[key].as_str().map(str::to_owned);
    let sample_ns = estimates["median"]["point_estimate"].as_f64()?;
    let elements = benchmark["throughput"]["Elements"].as_f64().unwrap_or(1.0);
    let key = (text("group_id")?, text("function_id")?);
    Some((key, 1e-9 * sample_ns / elements))
}

/// Name and instructions of a count: `callgrind.NAME.out` has them in a line `summary: INSTRUCTIONS ...`.
fn counted(path: &Path) -> Option<(String, f64)> {
    let file = path.file_name()?.to_str()?;
    let name = file.strip_prefix("callgrind.")?.strip_suffix(".out")?;
    let text = std::fs::read_to_string(path).ok()?;
    let summary = text
        .lines()
        .find_map(|line| line.strip_prefix("summary:"))?;
    let instructions = summary.split_whitespace().next()?.parse().ok()?;
    Some((name.to_owned(), instructions))
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::{Measured, Source};

    #[test]
    fn figures_are_read_from_the_files_of_each_tool() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = |name: &str| folder.path().join(name);
        let bench = path("criterion/step/paper f32/new");
        fs::create_dir_all(&bench).expect("a temporary folder");
        let about =
            r#"{"group_id":"step","function_id":"paper f32","throughput":{"Elements":100}}"#;
        fs::write(bench.join("benchmark.json"), about).expect("a temporary file");
        let estimates = r#"{"mean":{"point_estimate":9.0},"median":{"point_estimate":4700.0}}"#;
        fs::write(bench.join("estimates.json"), estimates).expect("a temporary file");
        fs::write(path("target.json"), r#"{"cortex_m7":{"step":149.0}}"#)
            .expect("a temporary file");
        fs::create_dir(path("counts")).expect("a temporary folder");
        let count = "events: Ir\nsummary: 155000000\n";
        fs::write(path("counts/callgrind.locomotive.curve.out"), count).expect("a temporary file");

        let measured = Measured::read(&path("criterion"), &path("target.json"), &path("counts"));
        let (group, function) = ("step", "paper f32");
        let step = measured.figure(Source::Time { group, function });
        assert_eq!(step, Some(1e-9 * 4700.0 / 100.0));
        let (processor, figure) = ("cortex_m7", "step");
        let on_target = measured.figure(Source::Target { processor, figure });
        assert_eq!(on_target, Some(149.0));
        let counted = measured.figure(Source::Counted("locomotive.curve"));
        assert_eq!(counted, Some(155_000.0));
        assert_eq!(measured.figure(Source::Counted("locomotive")), None);
    }

    #[test]
    fn missing_folders_have_no_figures() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let missing = folder.path().join("missing");
        let measured = Measured::read(&missing, &missing, &missing);
        let (group, function) = ("step", "paper f32");
        assert_eq!(measured.figure(Source::Time { group, function }), None);
        assert_eq!(measured.figure(Source::Seconds(1e-3)), Some(1e-3));
    }
}
