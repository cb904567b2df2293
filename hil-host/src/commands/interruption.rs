//! Handling of SIGINT, SIGTERM and SIGHUP.
//!
//! The handler deletes temporary files and ends child processes; then the signal ends the process as usual. If a
//! command supports a gentle end, the first signal only notifies it and the second signal ends it.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::commands::failure::Outcome;

static ENDS_GENTLY: AtomicBool = AtomicBool::new(false);
static IS_WANTED: AtomicBool = AtomicBool::new(false);

/// While this value exists, the first interruption only makes [`is_wanted`] return true.
#[derive(Debug)]
pub struct EndsGently(());

/// Announces that the command polls [`is_wanted`] and ends early with the results so far.
#[must_use]
pub fn end_gently() -> EndsGently {
    IS_WANTED.store(false, Ordering::Relaxed);
    ENDS_GENTLY.store(true, Ordering::Relaxed);
    EndsGently(())
}

impl Drop for EndsGently {
    fn drop(&mut self) {
        ENDS_GENTLY.store(false, Ordering::Relaxed);
    }
}

/// True if the user has asked the command to end.
pub fn is_wanted() -> bool {
    IS_WANTED.load(Ordering::Relaxed)
}

/// Installs handlers that delete temporary files and end child processes on interruption.
///
/// A signal that was ignored when the process started, such as SIGHUP under `nohup`, stays ignored.
///
/// # Errors
/// The system refuses the handlers or their thread.
#[cfg(unix)]
pub fn clean_up() -> Outcome<()> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;
    use signal_hook::low_level::emulate_default_handler;

    use dashpot_files::temporary;

    use crate::commands::failure::Failure;

    /// Stack of the signal thread (bytes); cleaning up needs little.
    const STACK: usize = 64 * 1024;

    let failed = |error: std::io::Error| Failure::new(format!("cannot wait for signals: {error}"));
    let ignored = ignored_signals();
    let signals = [SIGINT, SIGTERM, SIGHUP]
        .into_iter()
        .filter(|signal| ignored >> (signal - 1) & 1 == 0);
    let mut signals = Signals::new(signals).map_err(failed)?;
    std::thread::Builder::new()
        .name("signals".into())
        .stack_size(STACK)
        .spawn(move || {
            for signal in signals.forever() {
                if ENDS_GENTLY.swap(false, Ordering::Relaxed) {
                    IS_WANTED.store(true, Ordering::Relaxed);
                    continue;
                }
                let _no_new_files = temporary::delete_all();
                let _no_new_children = dashpot_host_link::end_children();
                // The default action of the signal ends the process.
                let _ = emulate_default_handler(signal);
            }
        })
        .map_err(failed)?;
    Ok(())
}

/// Returns the ignored signals, with signal n as bit n - 1; 0 if the system does not report them.
#[cfg(unix)]
fn ignored_signals() -> u64 {
    std::fs::read_to_string("/proc/self/status")
        .ok()
        .and_then(|status| {
            let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
            u64::from_str_radix(mask?.trim(), 16).ok()
        })
        .unwrap_or(0)
}

/// Does nothing: these signals exist only on Unix.
///
/// # Errors
/// Never fails.
#[cfg(not(unix))]
pub fn clean_up() -> Outcome<()> {
    Ok(())
}
