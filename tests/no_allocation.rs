//! The step of a damper, a bank and a vehicle, a live change and telemetry do not allocate memory. The global allocator
//! of this test counts its calls.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::hint::black_box;
use std::sync::Arc;

use dashpot::damper;
use dashpot_core::telemetry::{Sample, Telemetry};
use dashpot_core::{Damper, step_bank};
use dashpot_files::case::Case;
use dashpot_rail::contact::{ContactGeometry, Installation, Pair, Steel, Tables, WheelsetContact};
use dashpot_rail::creep::{Friction, KalkerBook};
use dashpot_rail::vehicle::{Direction, Element, End, FrictionLoad, Law, Vehicle};

thread_local! {
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

/// The system's allocator, counting the calls of each thread.
struct Counting;

// SAFETY: every call goes to the system's allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // While a thread ends, its counter may already be gone.
        let _ = ALLOCATIONS.try_with(|count| count.set(count.get() + 1));
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Allocations of this thread during `work`.
fn allocations(work: impl FnOnce()) -> usize {
    let before = ALLOCATIONS.get();
    work();
    ALLOCATIONS.get() - before
}

/// A motion through the clearance, past the rate limit and through a bad sensor value.
fn displacement(tick: u32) -> f32 {
    match tick % 1000 {
        500 => f32::NAN,
        700 => 1.0,
        _ => 0.01 * (0.01 * tick as f32).sin(),
    }
}

#[test]
fn the_counter_counts() {
    assert_eq!(allocations(|| drop(black_box(Box::new(1)))), 1);
}

#[test]
fn steps_and_live_changes_allocate_nothing() {
    let in_service: Damper<f32> = damper("in-service", &[]).build(1e-3).unwrap();
    let paper: Damper<f32> = damper("paper", &[]).build(1e-3).unwrap();
    let mut worn = paper;
    let mut state = paper.at_rest(0.0);
    let found = allocations(|| {
        for tick in 0..10_000 {
            let damper = [&in_service, &paper, &worn][tick as usize / 100 % 3];
            black_box(damper.step(&mut state, displacement(tick)));
        }
        worn.set_clearance_m(2e-3).unwrap();
        black_box(worn.step(&mut state, 0.0));
    });
    assert_eq!(found, 0);
    assert!(state.rejected_inputs() > 0, "the motion met no bad value");
}

#[test]
fn banks_and_telemetry_allocate_nothing() {
    let damper: Damper<f32> = damper("paper", &[]).build(1e-3).unwrap();
    let mut states = [damper.at_rest(0.0); 17];
    let mut forces = [0.0; 17];
    let mut telemetry = Telemetry::<64>::new();
    let found = allocations(|| {
        for tick in 0..10_000 {
            let x = displacement(tick);
            step_bank(&[&damper; 17], &mut states, &[x; 17], &mut forces);
            telemetry.record(Sample::new(tick, x, forces[16], states[16].status()));
        }
        black_box(telemetry.approximate_rms_force_n());
        black_box(telemetry.take());
    });
    assert_eq!(found, 0);
    assert!(telemetry.overwritten() > 0, "the ring was never full");
}

#[test]
fn a_vehicle_steps_and_restores_without_allocation() {
    let case = Case::load("straight-180").unwrap();
    let installation = Installation::default().with_wheel_radius_m(0.625);
    let pair = Pair::standard(installation).unwrap();
    let geometry = ContactGeometry::new(pair, Steel::default()).unwrap();
    let tables = Arc::new(Tables::new(geometry));
    let contact = WheelsetContact::new(tables, KalkerBook::new(), Friction::default()).unwrap();
    let mut parameters = case.vehicle.clone();
    let at = [5.39, 0.0, 0.8];
    let ends = [End::body("front bogie", at), End::body("body", at)];
    let friction = Law::Friction {
        direction: Direction::Vertical,
        stiffness_n_per_m: 1e6,
        friction_n: 10.0,
        load: Some(FrictionLoad::new(1e-4, "front secondary spring 1")),
    };
    parameters
        .elements
        .push(Element::new("friction", ends, friction));
    let vehicle = Vehicle::new(&parameters, Arc::new(contact), 1e-3).unwrap();
    let track = case.track.build().unwrap();
    let mut state = vehicle.at_rest(&track, 60.0, 50.0).unwrap();
    let start = state.clone();
    let found = allocations(|| {
        for _ in 0..300 {
            vehicle.step(&mut state, &track);
        }
        state.set_outside_force_n(0, Some(1e3)).unwrap();
        vehicle.step(&mut state, &track);
    });
    assert_eq!(found, 0);
    assert!(!state.is_diverged());
    assert_ne!(state, start);
    assert_ne!(state.sliders_m(), start.sliders_m());
    assert_eq!(allocations(|| state.clone_from(&start)), 0);
    assert_eq!(state, start);
}
