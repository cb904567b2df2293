//! Adding wear does not allocate, as counted by the global allocator.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use dashpot_rail::creep::Creepage;
use dashpot_rail::profile::s1002;
use dashpot_wear::{Wear, WearGrid, WearLaw, WearingPatch};

struct Counting;

thread_local! {
    /// Calls of this thread; the thread of the test harness allocates too.
    static COUNT: Cell<usize> = const { Cell::new(0) };
}

// SAFETY: every call is forwarded unchanged to the system allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        COUNT.set(COUNT.get() + 1);
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

#[test]
fn wear_is_added_without_allocating() {
    let mut wear = Wear::new(WearGrid::new(&s1002::profile()), WearLaw::default());
    let before = COUNT.get();
    assert!(before > 0, "the counter does not count");
    for i in 0..10_000 {
        let patch = WearingPatch {
            load_n: 80e3,
            peak_pressure_pa: 1e9,
            semi_axes_m: [6e-3, 1e-3 * f64::from(i % 20)],
            creepage: Creepage {
                lateral: 1e-3,
                ..Creepage::default()
            },
            wear_number_n: 20.0,
            speed_m_per_s: 20.0,
            friction: 0.3,
        };
        wear.add(1e-5 * f64::from(i) - 0.06, &patch, 0.02);
    }
    assert_eq!(COUNT.get() - before, 0);
    assert!(wear.volume_m3() > 0.0);
}
