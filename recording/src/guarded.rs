//! Turns panics of a library into errors.

use std::cell::Cell;
use std::panic::{self, AssertUnwindSafe, PanicHookInfo};
use std::sync::Once;

thread_local! {
    static IS_GUARDED: Cell<bool> = const { Cell::new(false) };
}

/// Runs `read`; returns `None` without printing anything if it panics. The Parquet library panics on some damaged
/// files, such as one without a dictionary. After a panic, the data passed to `read` must not be used again.
pub(super) fn guarded<T>(read: impl FnOnce() -> T) -> Option<T> {
    static QUIET: Once = Once::new();
    QUIET.call_once(|| panic::set_hook(silent_while_guarded(panic::take_hook())));
    let before = IS_GUARDED.replace(true);
    let read = panic::catch_unwind(AssertUnwindSafe(read));
    IS_GUARDED.set(before);
    read.ok()
}

type Hook = Box<dyn Fn(&PanicHookInfo<'_>) + Sync + Send>;

/// Returns a hook that calls `print` unless the panic is guarded.
fn silent_while_guarded(print: Hook) -> Hook {
    Box::new(move |panic| {
        if !IS_GUARDED.get() {
            print(panic);
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    thread_local! {
        /// Number of panics printed in this thread; `None` if they are not counted.
        static PRINTED: Cell<Option<u32>> = const { Cell::new(None) };
    }

    #[test]
    fn only_guarded_panics_are_silent() {
        let print = panic::take_hook();
        panic::set_hook(silent_while_guarded(Box::new(move |panic| {
            match PRINTED.get() {
                Some(count) => PRINTED.set(Some(count + 1)),
                None => print(panic),
            }
        })));
        // The outer call still guards after the inner one has returned.
        let nested = || -> u32 {
            guarded(|| 7);
            panic!("in the library");
        };
        PRINTED.set(Some(0));
        let results = [guarded(|| 7), guarded(nested)];
        let printed_by_library = PRINTED.get();
        let unguarded = panic::catch_unwind(|| panic!("elsewhere"));
        let printed = PRINTED.replace(None);
        assert_eq!(results, [Some(7), None]);
        assert_eq!(printed_by_library, Some(0));
        assert!(unguarded.is_err());
        assert_eq!(printed, Some(1));
    }
}
