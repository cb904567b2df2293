//! The evaluation allocates nothing: a counting allocator under it.

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering};

use dashpot_rail::contact::hertz::Steel;
use dashpot_rail::contact::motion::{Motion, Rail};
use dashpot_rail::contact::pair::{Installation, Pair};
use dashpot_rail::contact::table::{Grid, Tables};
use dashpot_rail::contact::wheelset::WheelsetContact;
use dashpot_rail::creep::friction::Friction;
use dashpot_rail::creep::polach::Polach;

struct Counting;

static COUNT: AtomicUsize = AtomicUsize::new(0);

// SAFETY: every call goes unchanged to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        COUNT.fetch_add(1, Ordering::Relaxed);
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

#[test]
fn forces_are_computed_without_allocating() {
    let pair = Pair::standard(Installation::default()).unwrap();
    let mut grid = Grid::default();
    grid.roll.cells = [1, 2, 1];
    let tables = Tables::new(pair, Steel::default(), grid);
    let contact = WheelsetContact::new(tables, Polach, Friction::default());
    let rails = [Rail::default(); 2];
    let before = COUNT.load(Ordering::Relaxed);
    assert!(before > 0, "the counter does not count");
    let mut loads = 0.0;
    for i in 0..10_000 {
        let motion = Motion {
            speed: 20.0,
            rotation: 32.0,
            lateral: f64::from(i) * 1e-6,
            vertical: -0.2e-3,
            yaw: 2e-3,
            ..Motion::default()
        };
        loads += contact.forces(&motion, &rails).force[2];
    }
    let after = COUNT.load(Ordering::Relaxed);
    assert!(loads < 0.0);
    assert_eq!(after - before, 0);
}
