//! Options of the command.

use std::net::SocketAddr;
use std::path::PathBuf;

use super::target_options::TargetArguments;
use crate::commands::arguments::{Format, RealtimeArguments, TickLimitArguments};
use crate::commands::failure::{Failure, Outcome};
use crate::commands::vehicle::CaseArguments;
use crate::commands::vehicle::outside::OutsideArguments;
use dashpot_files::case::Case;
use dashpot_live::endless;

/// Shortest length of generated irregularities, m: more than six minutes at 90 km/h.
const IRREGULAR_M: f64 = 10_000.0;

/// Watch and change a running vehicle from a page in a browser; or a target, or a recording.
#[derive(Debug, Clone, clap::Args)]
#[command(
    allow_negative_numbers = true,
    after_help = "Examples:
  dashpot live --case straight-180
  dashpot live --case curve-r600 --record run.mf4
  dashpot live --case curve-r300 --page curve.html
  dashpot live --case curve-r600 --recording run.mf4
  dashpot live --link serial:/dev/ttyACM0 --slot-damper in-service
  dashpot live --case straight-180 --outside \"front lateral damper 1=serial:/dev/ttyACM0\" --fifo 80
  dashpot live --case straight-180 --outside \"front yaw damper 1=udp:rig:7001\" --actuator servo
  dashpot live --case straight-180 --listen 0.0.0.0:8089 --token at-least-12-characters

Prints the address of the page. The first who opens it operates, others watch; see docs/live.md. On an address that
other machines reach, viewers need a token: that of --token, or a random one that the printed address contains. The
options of a process can be read by other users of the machine, so prefer the random one there.

With --link, a target without a vehicle: its dampers move in a sine that the page sets, and the same dampers run beside
it on this machine. A target that runs free is only watched.

The run ends with --duration-s, by SIGINT or SIGTERM, or when an external damper ends it. The guards of rigs then come
to rest first. Without an external damper a derailed vehicle waits for a reset. The report is printed at the end. The
exit code is 1 if the run ended in another way than asked, if the recording failed, or with --fail-on-miss if a
deadline was missed."
)]
pub struct LiveArguments {
    #[command(flatten)]
    pub(super) case: CaseArguments,
    #[command(flatten)]
    pub(super) outside: OutsideArguments,
    #[command(flatten)]
    pub(super) target: TargetArguments,
    /// Show a recording of the vehicle of the case as it ran: MDF4 (of --record), Parquet or text, with signals named
    /// as in history.csv.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["choices", "record", "page", "link"])]
    pub(super) recording: Option<PathBuf>,
    /// Address and port of the page; port 0 takes a free one.
    #[arg(long, default_value = "127.0.0.1:8089", value_name = "ADDRESS:PORT")]
    pub(super) listen: SocketAddr,
    /// Token that viewers need, 12 to 128 characters of A-Z, a-z, 0-9, - and _.
    #[arg(long, value_name = "TEXT")]
    pub(super) token: Option<String>,
    /// Record every tick into this file (MDF4), from the start on. It can be read at any time, also after the process
    /// was killed. After a reset the recording goes on in FILE-2.
    #[arg(long, value_name = "FILE.mf4")]
    pub(super) record: Option<PathBuf>,
    /// Write a page in which the vehicle runs by itself, in the browser, into this file, and end. The case is a shipped
    /// one with --vehicle, --track, --speed-km-h, --friction and --set.
    #[arg(long, value_name = "FILE.html", conflicts_with_all = ["choices", "record", "token", "link"])]
    pub(super) page: Option<PathBuf>,
    #[command(flatten)]
    pub(super) limits: TickLimitArguments,
    #[command(flatten)]
    pub(super) options: RealtimeArguments,
    /// Output format of the report.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub(super) format: Format,
}

impl LiveArguments {
    /// The case, without an end unless a duration is given.
    ///
    /// # Errors
    /// See [`CaseArguments::case`].
    pub(super) fn case(&self) -> Outcome<Case> {
        let mut case = endless(self.case.case()?, IRREGULAR_M);
        if let Some(duration_s) = self.case.duration_s() {
            case.duration_s = duration_s;
        }
        Ok(case)
    }

    /// Checks the options that need no case.
    ///
    /// # Errors
    /// A target's dampers without a target, or the recording is not of a form that a killed process leaves readable.
    pub(super) fn check(&self) -> Outcome<()> {
        if self.target.link.is_none() && !self.target.slot_dampers.is_empty() {
            return Err(Failure::wrong_use("--slot-damper requires --link"));
        }
        let Some(path) = &self.record else {
            return Ok(());
        };
        if !cfg!(feature = "mdf") {
            return Err(Failure::wrong_use(
                "--record is not available in this build; build dashpot-hil with the feature `mdf`",
            ));
        }
        match path.extension() {
            Some(extension) if extension.eq_ignore_ascii_case("mf4") => Ok(()),
            _ => Err(Failure::wrong_use(format!(
                "--record {}: allowed: a name that ends with .mf4",
                path.display()
            ))),
        }
    }
}
