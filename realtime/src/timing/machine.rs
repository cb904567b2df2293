//! The machine a time was measured on.

use std::fmt;
use std::fs;
use std::path::Path;
use std::time::SystemTime;

use serde::Serialize;

/// What decides how long a step takes besides the program. What the system does not report, as in a
/// container without `/proc` or outside Linux, is `None`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Machine {
    /// Model of the processor.
    pub processor: Option<String>,
    /// Its architecture.
    pub architecture: &'static str,
    /// The operating system.
    pub system: &'static str,
    /// Release of its kernel.
    pub kernel: Option<String>,
    /// Frequency governor of the processor's cores; several where they differ.
    pub governor: Option<String>,
    /// Mean number of tasks that run or want to, over 1, 5 and 15 minutes.
    pub load_average: Option<[f64; 3]>,
    /// When this was read, UTC.
    pub date: String,
}

impl Machine {
    /// This machine at the time `now`, from Linux's `proc` and `sys` folders under `root`, which is `/`
    /// outside tests. `core` is the one the program is pinned to; the governor is then that core's.
    pub fn read(root: &Path, core: Option<usize>, now: SystemTime) -> Self {
        let text = |path: &str| fs::read_to_string(root.join(path)).ok();
        Self {
            processor: text("proc/cpuinfo")
                .and_then(|cpuinfo| model_name(&cpuinfo))
                // On ARM the name of the board.
                .or_else(|| text("proc/device-tree/model").and_then(|model| filled(&model))),
            architecture: std::env::consts::ARCH,
            system: std::env::consts::OS,
            kernel: text("proc/sys/kernel/osrelease").and_then(|release| filled(&release)),
            governor: governor(root, core),
            load_average: text("proc/loadavg").and_then(|loads| load_average(&loads)),
            date: humantime::format_rfc3339_seconds(now).to_string(),
        }
    }
}

/// `text` without spaces and zero bytes around it; `None` when nothing is left.
fn filled(text: &str) -> Option<String> {
    let text = text.trim_matches(|c: char| c.is_whitespace() || c == '\0');
    (!text.is_empty()).then(|| text.to_owned())
}

fn model_name(cpuinfo: &str) -> Option<String> {
    let mut lines = cpuinfo.lines().filter_map(|line| line.split_once(':'));
    let (_, name) = lines.find(|(key, _)| key.trim() == "model name")?;
    filled(name)
}

fn governor(root: &Path, core: Option<usize>) -> Option<String> {
    let cores = root.join("sys/devices/system/cpu");
    let of = |name: &str| {
        let path = cores.join(name).join("cpufreq/scaling_governor");
        fs::read_to_string(path).ok().and_then(|text| filled(&text))
    };
    if let Some(core) = core {
        return of(&format!("cpu{core}"));
    }
    let folders = fs::read_dir(&cores).ok()?.flatten();
    let mut governors: Vec<String> = folders
        .filter_map(|folder| of(folder.file_name().to_str()?))
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
