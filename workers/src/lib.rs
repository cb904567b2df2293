#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![warn(missing_docs)]

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

/// Threads where none are asked for: one a core.
pub fn threads() -> usize {
    thread::available_parallelism().map_or(1, usize::from)
}

/// Has threads work on items, in their order, and takes each result with its item's number as soon as there is one. Once `take` returns an
/// error, no other item is begun, and work that asks is told to end.
///
/// # Errors
/// What `take` returns.
pub fn in_parallel<T: Sync, R: Send, E>(
    items: &[T],
    threads: usize,
    work: impl Fn(&T, &dyn Fn() -> bool) -> R + Sync,
    mut take: impl FnMut(usize, R) -> Result<(), E>,
) -> Result<(), E> {
    let (next, ended) = (AtomicUsize::new(0), AtomicBool::new(false));
    let (send, results) = mpsc::channel();
    thread::scope(|scope| {
        for started in 0..threads.clamp(1, items.len().max(1)) {
            let send = send.clone();
            let (next, ended, work) = (&next, &ended, &work);
            let run = move || {
                let is_ended = || ended.load(Ordering::Relaxed);
                while !is_ended() {
                    let number = next.fetch_add(1, Ordering::Relaxed);
                    let Some(item) = items.get(number) else {
                        return;
                    };
                    if send.send((number, work(item, &is_ended))).is_err() {
                        return;
                    }
                }
            };
            // Where the system gives no more, those there are do the work; where it gives none, this one.
            if thread::Builder::new().spawn_scoped(scope, run).is_err() {
                if started == 0 {
                    let mut items = items.iter().enumerate();
                    return items
                        .try_for_each(|(number, item)| take(number, work(item, &|| false)));
                }
                break;
            }
        }
        drop(send);
        let mut taken = Ok(());
        for (number, result) in results {
            // What comes after an error had been begun before.
            if taken.is_ok() {
                taken = take(number, result);
                ended.store(taken.is_err(), Ordering::Relaxed);
            }
        }
        taken
    })
}

/// The result of each item, in their order.
///
/// # Errors
/// The first that there was.
pub fn map<T: Sync, R: Send, E: Send>(
    items: &[T],
    work: impl Fn(&T) -> Result<R, E> + Sync,
) -> Result<Vec<R>, E> {
    let mut results: Vec<Option<R>> = items.iter().map(|_| None).collect();
    in_parallel(
        items,
        threads(),
        |item, _| work(item),
        |number, result| {
            results[number] = Some(result?);
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
    fn an_error_ends_the_work() {
        let items: Vec<u64> = (0..100_000).collect();
        let mut taken = 0;
        let take = |_, item: u64| {
            taken += 1;
            if item < 10 { Ok(()) } else { Err(item) }
        };
        let ended = in_parallel(&items, 1, |item, _| *item, take);
        assert_eq!((ended, taken), (Err(10), 11));
    }
}
