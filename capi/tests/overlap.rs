//! A call is refused and writes nothing if the memory that it changes overlaps another argument.

mod common;

use std::ptr::null_mut;
use std::sync::LazyLock;

use common::core_damper;
use dashpot::*;

const OVERLAP: DashpotError = DashpotError::Overlap;
const DONE: DashpotError = DashpotError::None;
const IMAGE: usize = DASHPOT_IMAGE_SIZE;
const SAVED: usize = DASHPOT_SAVED_STATE_SIZE;

/// Returns an image that is built only once, because a build takes seconds under Miri.
fn image() -> &'static [u8; IMAGE] {
    static MADE: LazyLock<[u8; IMAGE]> = LazyLock::new(|| core_damper(120e3).to_image());
    &MADE
}

/// Words for several objects, and a copy of the words from before a call.
struct Arena {
    words: Vec<u32>,
    before: Vec<u32>,
}

impl Arena {
    /// A damper at the start, followed by a state at rest and free words.
    fn new() -> Self {
        let mut words = vec![0; 4 * DASHPOT_DAMPER_WORDS];
        let image = image();
        let damper: *mut DashpotDamper = words.as_mut_ptr().cast();
        let state = words[DASHPOT_DAMPER_WORDS..].as_mut_ptr().cast();
        // SAFETY: there is room for a damper and a state behind it.
        unsafe {
            assert_eq!(dashpot_damper_init(damper, image.as_ptr(), IMAGE), DONE);
            assert_eq!(dashpot_state_init(state, damper, 0.0), DONE);
        }
        let before = words.clone();
        Self { words, before }
    }

    /// Returns a pointer to a byte.
    fn at<T>(&mut self, byte: usize) -> *mut T {
        assert!(byte + size_of::<T>() <= 4 * self.words.len());
        self.words.as_mut_ptr().wrapping_byte_add(byte).cast()
    }

    fn assert_refused(&self, code: DashpotError, call: &str) {
        assert_eq!(code, OVERLAP, "{call}");
        assert!(self.words == self.before, "{call} wrote");
    }
}

const STATE_AT: usize = DASHPOT_DAMPER_SIZE;
const FREE_AT: usize = STATE_AT + DASHPOT_STATE_SIZE;

#[test]
fn an_image_is_refused_inside_the_storage_and_accepted_next_to_it() {
    let mut arena = Arena::new();
    // The image overlaps the start of the storage, lies inside it, or overlaps its end.
    let storage_at = DASHPOT_DAMPER_SIZE;
    let overlapping = [
        storage_at - IMAGE + 1,
        storage_at - 1,
        storage_at,
        storage_at + 1,
        storage_at + DASHPOT_DAMPER_SIZE - 1,
    ];
    for (image_at, expected) in overlapping
        .map(|at| (at, OVERLAP))
        .into_iter()
        .chain([(storage_at - IMAGE, DONE), (2 * storage_at, DONE)])
    {
        arena.words.fill(7);
        let place: *mut u8 = arena.at(image_at);
        // SAFETY: the bytes are within the arena, which is large enough for every offset above.
        unsafe { place.copy_from(image().as_ptr(), IMAGE) };
        arena.before.clone_from(&arena.words);
        let storage = arena.at(storage_at);
        // SAFETY: the pointers are within the arena.
        let code = unsafe { dashpot_damper_init(storage, arena.at(image_at), IMAGE) };
        assert_eq!(
            code, expected,
            "image at {image_at}, storage at {storage_at}"
        );
        assert_eq!(
            code == DONE,
            arena.words != arena.before,
            "image at {image_at}"
        );
    }
}

#[test]
fn functions_on_a_state_refuse_overlap() {
    let mut arena = Arena::new();
    let (damper, state): (*mut DashpotDamper, *mut DashpotState) =
        (arena.at(0), arena.at(STATE_AT));
    let mut saved = [0; SAVED];
    // SAFETY: every pointer is aligned and points into the arena or to a whole object.
    unsafe {
        assert_eq!(dashpot_state_save(state, saved.as_mut_ptr(), SAVED), DONE);
        for at in [0, 4, STATE_AT - 4] {
            let code = dashpot_damper_describe(damper, arena.at(at));
            arena.assert_refused(code, "describe");
            let code = dashpot_state_init(arena.at(at), damper, 0.0);
            arena.assert_refused(code, "state_init");
            let code = dashpot_state_restore(arena.at(at), damper, saved.as_ptr(), SAVED);
            arena.assert_refused(code, "state_restore, the damper");
        }
        for at in [STATE_AT - 8, STATE_AT, FREE_AT - 4] {
            let code = dashpot_state_read(state, arena.at(at));
            arena.assert_refused(code, "state_read");
        }
        for at in [STATE_AT - SAVED + 1, STATE_AT, FREE_AT - 1] {
            let code = dashpot_state_save(state, arena.at(at), SAVED);
            arena.assert_refused(code, "state_save");
            let code = dashpot_state_restore(state, damper, arena.at(at), SAVED);
            arena.assert_refused(code, "state_restore, the bytes");
        }
        assert_eq!(dashpot_state_save(state, arena.at(FREE_AT), SAVED), DONE);
        let code = dashpot_state_restore(state, damper, arena.at(FREE_AT), SAVED);
        assert_eq!(code, DONE, "bytes right behind the state");
    }
}

#[test]
fn a_step_refuses_overlap() {
    let mut arena = Arena::new();
    let (damper, state): (*mut DashpotDamper, *mut DashpotState) =
        (arena.at(0), arena.at(STATE_AT));
    let mut force = 0.0;
    // SAFETY: every pointer is aligned and points into the arena or to a whole object.
    unsafe {
        for at in [0, STATE_AT - 4, STATE_AT, FREE_AT - 4] {
            let code = dashpot_step(damper, state, 1e-3, arena.at(at));
            arena.assert_refused(code, "the force");
        }
        for at in [0, STATE_AT - 4] {
            let code = dashpot_step(damper, arena.at(at), 1e-3, &mut force);
            arena.assert_refused(code, "the state");
        }
        assert_eq!(dashpot_step(damper, state, 1e-3, arena.at(FREE_AT)), DONE);
    }
}

#[test]
fn a_bank_refuses_overlap_but_for_forces_in_place() {
    let mut arena = Arena::new();
    let damper: *mut DashpotDamper = arena.at(0);
    let state: *mut DashpotState = arena.at(STATE_AT);
    // Two states, side by side.
    // SAFETY: the pointers are within the arena.
    unsafe { state.add(1).write(state.read()) };
    let dampers = [damper.cast_const(); 2];
    let outside_at = STATE_AT + 2 * DASHPOT_STATE_SIZE;
    // An aligned array of pointers behind the states and the displacements.
    let pointers_at = (outside_at + 64).next_multiple_of(align_of::<*const DashpotDamper>());
    // SAFETY: the bytes are within the arena; they are the bytes of pointers and are read back as pointers.
    unsafe {
        arena
            .at::<[*const DashpotDamper; 2]>(pointers_at)
            .write_unaligned(dampers)
    };
    arena.before.clone_from(&arena.words);
    let bank = |dampers: *const *const DashpotDamper, states, x: *const f32, forces| {
        // SAFETY: every pointer points into the arena or to two elements.
        unsafe { dashpot_step_bank(dampers, states, x, forces, 2) }
    };
    let list = dampers.as_ptr();
    let mut forces = [0.0_f32; 2];
    let (x, to): (*mut f32, *mut f32) = (arena.at(outside_at), forces.as_mut_ptr());
    for (call, code) in [
        (
            "states and a damper",
            bank(list, arena.at(STATE_AT - 4), x, to),
        ),
        (
            "states and displacements",
            bank(list, state, arena.at(outside_at - 4), to),
        ),
        (
            "states and forces",
            bank(list, state, x, arena.at(outside_at - 4)),
        ),
        ("forces and a damper", bank(list, state, x, arena.at(0))),
        (
            "forces one element on",
            bank(list, state, x, x.wrapping_add(1)),
        ),
        (
            "forces one element back",
            bank(list, state, x.wrapping_add(1), x),
        ),
    ] {
        arena.assert_refused(code, call);
    }
    let pointers: *const *const DashpotDamper = arena.at::<*const DashpotDamper>(pointers_at);
    if pointers.is_aligned() {
        let code = bank(pointers, state, x, arena.at(pointers_at));
        arena.assert_refused(code, "forces and the pointers to dampers");
        let code = bank(pointers, arena.at(pointers_at - 4), x, to);
        arena.assert_refused(code, "states and the pointers to dampers");
    }
    assert_eq!(
        bank(list, state, x, x),
        DONE,
        "forces in place of displacements"
    );
    assert_eq!(bank(list, null_mut(), x, to), DashpotError::NullPointer);
}
