//! The line to a target, as commands name it.

use std::time::Duration;

use crate::commands::failure::Outcome;
use dashpot_host_link::{Link, LinkChoice, LinkError, RetryLimits};

/// Which line to a target, and how long to wait for answers.
#[derive(Debug, Clone, clap::Args)]
pub struct LineArguments {
    /// The target: tcp:HOST:PORT, serial:DEVICE, qemu (an emulator of our own) or qemu:IMAGE.
    #[arg(long, value_name = "LINK")]
    link: LinkChoice,
    #[command(flatten)]
    options: LineOptions,
}

/// How a line is used, whichever it is.
#[derive(Debug, Clone, PartialEq, Eq, clap::Args)]
pub struct LineOptions {
    /// First wait for an answer, ms; each wait without one doubles the next, up to eight times the first and 12 s.
    #[arg(long, default_value_t = TIMEOUT_MS, value_parser = clap::value_parser!(u64).range(1..=60_000), value_name = "MS")]
    timeout_ms: u64,
    /// Tries of a request before the target counts as silent.
    #[arg(long, default_value_t = TRIES, value_parser = clap::value_parser!(u32).range(1..=1000))]
    tries: u32,
    /// Rate of a serial device, bit/s.
    #[arg(long, default_value_t = BAUD, value_parser = clap::value_parser!(u32).range(1..))]
    baud: u32,
}

const TIMEOUT_MS: u64 = 200;
const TRIES: u32 = 8;
const BAUD: u32 = 1_000_000;

impl LineArguments {
    /// Opens the line.
    ///
    /// # Errors
    /// As [`LinkChoice::open`].
    pub fn open(&self) -> Outcome<Box<dyn Link + Send>> {
        Ok(self.options.open(&self.link)?)
    }

    /// How long to wait for an answer, and how often to ask.
    pub fn retry_limits(&self) -> RetryLimits {
        self.options.retry_limits()
    }
}

impl Default for LineOptions {
    fn default() -> Self {
        Self {
            timeout_ms: TIMEOUT_MS,
            tries: TRIES,
            baud: BAUD,
        }
    }
}

impl LineOptions {
    /// Opens a line.
    ///
    /// # Errors
    /// As [`LinkChoice::open`].
    pub fn open(&self, link: &LinkChoice) -> Result<Box<dyn Link + Send>, LinkError> {
        link.open(self.baud)
    }

    /// How long to wait for an answer, and how often to ask.
    pub fn retry_limits(&self) -> RetryLimits {
        RetryLimits {
            timeout: Duration::from_millis(self.timeout_ms),
            tries: self.tries,
        }
    }
}
