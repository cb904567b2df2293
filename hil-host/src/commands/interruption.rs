//! SIGINT, SIGTERM and SIGHUP: temporary files are deleted and child processes ended, then the process ends
//! by the signal as it would have without this.

use crate::commands::failure::{Failure, Outcome};

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

    use crate::files::temporary;
    use crate::target;

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
                let _no_new_files = temporary::delete_all();
                let _no_new_children = target::end_children();
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
