//! The step does not allocate, as counted by the global allocator.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::sync::Arc;

use dashpot_rail::contact::{
    ContactGeometry, Installation, Motion, Pair, RailDisplacement, Steel, Tables, WheelsetContact,
};
use dashpot_rail::creep::{Friction, KalkerBook};
use dashpot_rail::track::{self, Defect, Generation, Rails, Spectrum, Track};

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
fn forces_are_computed_without_allocating() {
    let pair = Pair::standard(Installation::default()).unwrap();
    let geometry = ContactGeometry::new(pair, Steel::default()).unwrap();
    let tables = Tables::new(geometry);
    let contact =
        WheelsetContact::new(Arc::new(tables), KalkerBook::new(), Friction::default()).unwrap();
    let irregularity = Generation::new(Spectrum::german_low())
        .irregularity()
        .unwrap();
    let dip = Defect::CosineDip {
        rails: Rails::Left,
        start_m: 500.0,
        length_m: 1.0,
        depth_m: 1e-3,
    };
    let track = Track::new(track::Layout::default(), irregularity, vec![dip]).unwrap();
    let before = COUNT.get();
    assert!(before > 0, "the counter does not count");
    let mut loads = 0.0;
    for i in 0..10_000 {
        let motion = Motion {
            speed_m_per_s: 20.0,
            rotation_rad_per_s: 32.0,
            lateral_m: f64::from(i) * 1e-6,
            vertical_m: -0.2e-3,
            yaw_rad: 2e-3,
            ..Motion::default()
        };
        let point = track.at(0.1 * f64::from(i));
        let rails: [RailDisplacement; 2] = point.rails.map(|rail| rail.displacement(20.0));
        loads += contact.forces(&motion, &rails).force_n[2];
    }
    let after = COUNT.get();
    assert!(loads < 0.0);
    assert_eq!(after - before, 0);
}
