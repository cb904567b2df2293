//! The line to a target, as commands name it.

use std::time::Duration;

use crate::commands::failure::Outcome;
use crate::target::pil::{Link, LinkChoice, RetryLimits};

/// Which line to a target, and how long to wait for answers.
#[derive(Debug, Clone, clap::Args)]
pub struct LineArguments {
    /// The target: tcp:HOST:PORT, serial:DEVICE, qemu (an emulator of our own) or qemu:IMAGE.
    #[arg(long, value_name = "LINK")]
    link: LinkChoice,
    /// Wait for an answer, ms.
    #[arg(long, default_value_t = 200, value_parser = clap::value_parser!(u64).range(1..=60_000), value_name = "MS")]
    timeout_ms: u64,
    /// Tries of a request before the target counts as silent.
    #[arg(long, default_value_t = 8, value_parser = clap::value_parser!(u32).range(1..=1000))]
    tries: u32,
    /// Rate of a serial device, bit/s.
    #[arg(long, default_value_t = 1_000_000, value_parser = clap::value_parser!(u32).range(1..))]
    baud: u32,
}

impl LineArguments {
    /// Opens the line.
    ///
    /// # Errors
    /// As [`LinkChoice::open`].
    pub fn open(&self) -> Outcome<Box<dyn Link>> {
        Ok(self.link.open(self.baud)?)
    }

    /// How long to wait for an answer, and how often to ask.
    pub fn retry_limits(&self) -> RetryLimits {
        RetryLimits {
            timeout: Duration::from_millis(self.timeout_ms),
            tries: self.tries,
        }
    }
}
