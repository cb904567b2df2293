//! SIGINT, SIGTERM and SIGHUP: temporary files are deleted and child processes ended, then the process ends
//! by the signal as it would have without this. A command that ends gently is asked first, and ended by a second signal.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::commands::failure::{Failure, Outcome};

static ENDS_GENTLY: AtomicBool = AtomicBool::new(false);
static IS_WANTED: AtomicBool = AtomicBool::new(false);

/// While it lives, the first interruption only asks: see [`is_wanted`].
#[derive(Debug)]
pub struct EndsGently(());

/// From now on the command looks at [`is_wanted`] often, and ends with what it has when it is.
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

/// Whether the user wants the command to end.
pub fn is_wanted() -> bool {
    IS_WANTED.load(Ordering::Relaxed)
}

/// Lets interruptions delete this process's temporary files and end its children from now on. A signal that
/// the process was started to ignore, as `nohup` has it for SIGHUP, stays ignored.
///
/// # Errors
/// The system refuses the handlers or the thread that waits for them.
#[cfg(unix)]
pub fn clean_up() -> Outcome<()> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;
    use signal_hook::low_level::emulate_default_handler;

    use dashpot_files::temporary;

    /// Cleaning up takes little of it (bytes).
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
                // Ends the process, by the signal.
                let _ = emulate_default_handler(signal);
            }
        })
        .map_err(failed)?;
    Ok(())
}

/// The signals that this process ignores, signal n as bit n - 1; 0 where the system does not report them.
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

/// Nothing to do: these signals are Unix's.
///
/// # Errors
/// None.
#[cfg(not(unix))]
pub fn clean_up() -> Outcome<()> {
    Ok(())
}
