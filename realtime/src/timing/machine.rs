//! Description of the machine on which times are measured.

use std::fmt;
use std::fs;
use std::path::Path;
use std::time::SystemTime;

use chrono::{DateTime, SecondsFormat, Utc};
use serde::Serialize;

/// Description of the machine on which times are measured. Properties that the system does not report, for example in a
/// container without `/proc` or outside Linux, are `None`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Machine {
    /// Model of the processor.
    pub processor: Option<String>,
    /// Architecture of the processor.
    pub architecture: &'static str,
    /// Operating system.
    pub system: &'static str,
    /// Release of the kernel.
    pub kernel: Option<String>,
    /// Frequency governor of the cores; several if they differ.
    pub governor: Option<String>,
    /// Mean number of running or waiting tasks over 1, 5 and 15 minutes.
    pub load_average: Option<[f64; 3]>,
    /// Date and time of this description, UTC.
    pub date: String,
}

impl Machine {
    /// Describes this machine at the time `now`, from the Linux directories `proc` and `sys` under `root` (`/` except
    /// in tests). If the program is pinned to `core`, the governor is that of this core.
    pub fn read(root: &Path, core: Option<usize>, now: SystemTime) -> Self {
        let text = |path: &str| fs::read_to_string(root.join(path)).ok();
        Self {
            processor: text("proc/cpuinfo")
                .and_then(|cpuinfo| model_name(&cpuinfo))
                // On ARM this is the name of the board.
                .or_else(|| text("proc/device-tree/model").and_then(|model| trimmed(&model))),
            architecture: std::env::consts::ARCH,
            system: std::env::consts::OS,
            kernel: text("proc/sys/kernel/osrelease").and_then(|release| trimmed(&release)),
            governor: governor(root, core),
            load_average: text("proc/loadavg").and_then(|loads| load_average(&loads)),
            date: DateTime::<Utc>::from(now).to_rfc3339_opts(SecondsFormat::Secs, true),
        }
    }
}

/// Trims whitespace and zero bytes; returns `None` if nothing is left.
fn trimmed(text: &str) -> Option<String> {
    let text = text.trim_matches(|c: char| c.is_whitespace() || c == '\0');
    (!text.is_empty()).then(|| text.to_owned())
}

fn model_name(cpuinfo: &str) -> Option<String> {
    let mut lines = cpuinfo.lines().filter_map(|line| line.split_once(':'));
    let (_, name) = lines.find(|(key, _)| key.trim() == "model name")?;
    trimmed(name)
}

fn governor(root: &Path, core: Option<usize>) -> Option<String> {
    let cores = root.join("sys/devices/system/cpu");
    let governor_of = |name: &str| {
        let path = cores.join(name).join("cpufreq/scaling_governor");
        fs::read_to_string(path)
            .ok()
            .and_then(|text| trimmed(&text))
    };
    if let Some(core) = core {
        return governor_of(&format!("cpu{core}"));
    }
    let folders = fs::read_dir(&cores).ok()?.flatten();
    let mut governors: Vec<String> = folders
        .filter_map(|folder| governor_of(folder.file_name().to_str()?))
        .collect();
    governors.sort();
    governors.dedup();
    (!governors.is_empty()).then(|| governors.join(", "))
}

fn load_average(loads: &str) -> Option<[f64; 3]> {
    let mut numbers = loads.split_whitespace().map(|load| load.parse().ok());
    Some([numbers.next()??, numbers.next()??, numbers.next()??])
}

impl fmt::Display for Machine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let known = |value: &Option<String>| value.clone().unwrap_or_else(|| "unknown".into());
        let loads = self.load_average.map_or_else(
            || "unknown".into(),
            |[one, five, fifteen]| format!("{one:.2} {five:.2} {fifteen:.2}"),
        );
        write!(
            f,
            "processor {}, {}; system {}, kernel {}; governor {}; load average {loads}; {}",
            known(&self.processor),
            self.architecture,
            self.system,
            known(&self.kernel),
            known(&self.governor),
            self.date
        )
    }
}
