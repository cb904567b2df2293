//! No memory is allocated between two ticks.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::hint::black_box;

use crate::driven;

thread_local! {
    static ALLOCATIONS: Cell<u64> = const { Cell::new(0) };
}

/// The system allocator with a count of calls per thread.
struct Counting;

// SAFETY: every call is passed to the system allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // The counter may already be destroyed while a thread ends.
        let _is_counted = ALLOCATIONS.try_with(|count| count.set(count.get() + 1));
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Number of ticks: enough to enlarge and merge the curves of a page, and to complete a window of 5 s of the ride
/// indices.
const TICKS: u64 = 5200;

#[test]
fn the_counter_counts() {
    let before = ALLOCATIONS.get();
    drop(black_box(Box::new(1)));
    assert_eq!(ALLOCATIONS.get() - before, 1);
}

#[test]
fn no_tick_allocates() {
    let mut counts = Vec::with_capacity(TICKS as usize);
    driven(TICKS, || counts.push(ALLOCATIONS.get()));
    assert_eq!(counts.len() as u64, TICKS);
    let ticks = counts.windows(2).map(|pair| pair[1] - pair[0]).enumerate();
    let found: Vec<_> = ticks.filter(|(_, count)| *count > 0).collect();
    assert!(found.is_empty(), "allocations by tick: {found:?}");
}
