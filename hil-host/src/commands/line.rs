//! Options for the link to a target.

use std::time::Duration;

use crate::commands::failure::Outcome;
use dashpot_host_link::{Link, LinkChoice, LinkError, RetryLimits};

/// Link to a target, with timeouts.
#[derive(Debug, Clone, clap::Args)]
pub struct LineArguments {
    /// Target: tcp:HOST:PORT, serial:DEVICE, qemu (a new emulator) or qemu:IMAGE.
    #[arg(long, value_name = "LINK")]
    link: LinkChoice,
    #[command(flatten)]
    options: LineOptions,
}

/// Link options that apply to all kinds of links.
#[derive(Debug, Clone, PartialEq, Eq, clap::Args)]
pub struct LineOptions {
    /// First timeout for a response, ms [default: 200]. It doubles after each timeout, but does not grow beyond eight
    /// times the first or beyond 12 s.
    #[arg(
        long,
        value_parser = clap::value_parser!(u64).range(1..=60_000),
        value_name = "MS"
    )]
    timeout_ms: Option<u64>,
    /// Number of attempts before the target is reported as silent.
    #[arg(long, default_value_t = TRIES, value_parser = clap::value_parser!(u32).range(1..=1000))]
    tries: u32,
    /// Bit rate of a serial device, bit/s.
    #[arg(long, default_value_t = BAUD, value_parser = clap::value_parser!(u32).range(1..))]
    baud: u32,
}

/// The first timeout, which the help of `--timeout-ms` states.
const TIMEOUT: Duration = Duration::from_millis(200);
const TRIES: u32 = 8;
const BAUD: u32 = 1_000_000;

impl LineArguments {
    /// Opens the link.
    ///
    /// # Errors
    /// See [`LinkChoice::open`].
    pub fn open(&self) -> Outcome<Box<dyn Link + Send>> {
        Ok(self.options.open(&self.link)?)
    }

    /// Returns the timeout and the number of attempts.
    pub fn retry_limits(&self) -> RetryLimits {
        self.options.retry_limits()
    }
}

impl Default for LineOptions {
    fn default() -> Self {
        Self {
            timeout_ms: None,
            tries: TRIES,
            baud: BAUD,
        }
    }
}

impl LineOptions {
    /// Opens a link.
    ///
    /// # Errors
    /// See [`LinkChoice::open`].
    pub fn open(&self, link: &LinkChoice) -> Result<Box<dyn Link + Send>, LinkError> {
        link.open(self.baud)
    }

    /// Returns the first timeout, if it is given.
    pub fn timeout(&self) -> Option<Duration> {
        self.timeout_ms.map(Duration::from_millis)
    }

    /// Returns the timeout and the number of attempts.
    pub fn retry_limits(&self) -> RetryLimits {
        RetryLimits {
            timeout: self.timeout().unwrap_or(TIMEOUT),
            tries: self.tries,
        }
    }
}
