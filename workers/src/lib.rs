#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![warn(missing_docs)]

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

/// Default number of threads: one per core.
pub fn threads() -> usize {
    thread::available_parallelism().map_or(1, usize::from)
}

/// Runs `work` on the items with a pool of threads. Passes each completed result to `on_result` at once.
/// Items are started in order. The calling thread calls `on_result`, with the index of the item and its result.
///
/// After `on_result` returns an error, no further item is started, and `is_cancelled`, the closure that `work`
/// receives, returns true.
///
/// # Errors
/// Returns the first error of `on_result`.
pub fn in_parallel<T: Sync, R: Send, E>(
    items: &[T],
    threads: usize,
    work: impl Fn(&T, &dyn Fn() -> bool) -> R + Sync,
    mut on_result: impl FnMut(usize, R) -> Result<(), E>,
) -> Result<(), E> {
    let (next, cancelled) = (AtomicUsize::new(0), AtomicBool::new(false));
    let (send, results) = mpsc::channel();
    thread::scope(|scope| {
        for started in 0..threads.clamp(1, items.len().max(1)) {
            let send = send.clone();
            let (next, cancelled, work) = (&next, &cancelled, &work);
            let run = move || {
                let is_cancelled = || cancelled.load(Ordering::Relaxed);
                while !is_cancelled() {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    let Some(item) = items.get(index) else {
                        return;
                    };
                    if send.send((index, work(item, &is_cancelled))).is_err() {
                        return;
                    }
                }
            };
            // If the system refuses more threads, the running ones do the work; if none is running, this thread does
            // it.
            if thread::Builder::new().spawn_scoped(scope, run).is_err() {
                if started == 0 {
                    let mut items = items.iter().enumerate();
                    return items
                        .try_for_each(|(index, item)| on_result(index, work(item, &|| false)));
                }
                break;
            }
        }
        drop(send);
        let mut outcome = Ok(());
        for (index, result) in results {
            // The results of items that were already running when the error occurred are ignored.
            if outcome.is_ok() {
                outcome = on_result(index, result);
                cancelled.store(outcome.is_err(), Ordering::Relaxed);
            }
        }
        outcome
    })
}

/// Runs `work` on all cores and returns the results in the order of the items.
///
/// # Errors
/// Returns the first error that occurred.
pub fn map<T: Sync, R: Send, E: Send>(
    items: &[T],
    work: impl Fn(&T) -> Result<R, E> + Sync,
) -> Result<Vec<R>, E> {
    let mut results: Vec<Option<R>> = items.iter().map(|_| None).collect();
    in_parallel(
        items,
        threads(),
        |item, _| work(item),
        |index, result| {
            results[index] = Some(result?);
            Ok(())
        },
    )?;
    Ok(results.into_iter().flatten().collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_are_in_the_order_of_the_items() {
        let items: Vec<u64> = (0..1000).collect();
        let squares = map(&items, |item| Ok::<_, ()>(item * item));
        assert_eq!(squares, Ok(items.iter().map(|item| item * item).collect()));
    }

    #[test]
    fn an_error_stops_further_items() {
        let items: Vec<u64> = (0..100_000).collect();
        let mut results = 0;
        let on_result = |_, item: u64| {
            results += 1;
            if item < 10 { Ok(()) } else { Err(item) }
        };
        let outcome = in_parallel(&items, 1, |item, _| *item, on_result);
        assert_eq!((outcome, results), (Err(10), 11));
    }
}
