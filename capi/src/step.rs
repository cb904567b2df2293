//! The step of one damper and of several.

use core::{ptr, slice};

use dashpot_core::{Damper, DamperState, VectorWidth, step_bank_with};

use crate::damper::made;
use crate::error::DashpotError;
use crate::pointer::{Memory, check, check_count, exclusive, shared};
use crate::types::{DashpotDamper, DashpotState};

/// Dampers that are stepped together. Where the core has no vectors, stepping them one by one needs no copies.
const GROUP: usize = if cfg!(any(target_arch = "x86_64", target_arch = "aarch64")) {
    16
} else {
    1
};

/// Refuses uninitialised memory. A state that this damper stepped last is recognised by its revision.
fn check_state(damper: &Damper<f32>, state: &DamperState<f32>) -> Result<(), DashpotError> {
    if state.revision() == damper.revision() || state.is_marked() {
        Ok(())
    } else {
        Err(DashpotError::NoState)
    }
}

/// Steps one damper: computes the force at this tick for the displacement of this tick.
///
/// A displacement that is NaN, infinite, out of range or too fast is not an error: it is held or limited, latched in
/// the status and counted. If it is too far away to catch up with, the damper restarts there at rest. An impossible
/// state restarts at rest and latches `DASHPOT_STATUS_CORRUPTED`. The force is finite and within the force limit, even
/// if the damper or the state is damaged. A step takes about 191 instructions on a Cortex-M7.
///
/// @param damper          initialised by `dashpot_damper_init`
/// @param state           from `dashpot_state_init` or `dashpot_state_restore`, changed
/// @param displacement_m  displacement (m), positive in extension
/// @param force_n         written: force (N), positive when it resists extension
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_step(
    damper: *const DashpotDamper,
    state: *mut DashpotState,
    displacement_m: f32,
    force_n: *mut f32,
) -> DashpotError {
    let done = || {
        // SAFETY: the caller keeps the contract.
        let damper = unsafe { made(damper) }?;
        check(state)?;
        check(force_n)?;
        Memory::of(state).check_apart(Memory::of(damper))?;
        Memory::of(force_n).check_apart(Memory::of(damper))?;
        Memory::of(force_n).check_apart(Memory::of(state))?;
        // SAFETY: the caller keeps the contract; the storage has the layout of `DamperState`.
        let state: &mut DamperState<f32> = unsafe { exclusive(state.cast()) }?;
        check_state(damper, state)?;
        let force = damper.step(state, displacement_m);
        // SAFETY: the pointer is checked, and the caller keeps the contract.
        unsafe { force_n.write(force) };
        Ok(())
    };
    DashpotError::from(done())
}

/// Steps several dampers. The forces are bit-identical to those of `dashpot_step`. After an error, no damper has
/// stepped.
///
/// On x86-64 and 64-bit Arm, dampers are stepped in groups of 16 and 8 with the vector instructions that every such
/// processor has, SSE2 or NEON. The library does not look for wider ones, since that needs an operating system.
///
/// @param dampers          `count` pointers to dampers; one damper can serve several states
/// @param states           `count` states, changed
/// @param displacements_m  `count` displacements (m)
/// @param forces_n         written: `count` forces (N); can be the array of displacements itself
/// @param count            number of dampers, can be 0
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_step_bank(
    dampers: *const *const DashpotDamper,
    states: *mut DashpotState,
    displacements_m: *const f32,
    forces_n: *mut f32,
    count: usize,
) -> DashpotError {
    let done = || {
        check(dampers)?;
        check(states)?;
        check(displacements_m)?;
        check(forces_n)?;
        check_count::<DashpotState>(count)?;
        let forces = Memory::array(forces_n, count);
        let moving = Memory::array(states, count);
        moving.check_apart(forces)?;
        for changed in [moving, forces] {
            changed.check_apart(Memory::array(dampers, count))?;
        }
        moving.check_apart(Memory::array(displacements_m, count))?;
        if !ptr::eq(forces_n, displacements_m) {
            forces.check_apart(Memory::array(displacements_m, count))?;
        }
        for index in 0..count {
            // SAFETY: the element is within the caller's array, and the caller keeps the contract.
            let damper = unsafe { made(*dampers.add(index)) }?;
            moving.check_apart(Memory::of(damper))?;
            forces.check_apart(Memory::of(damper))?;
            // SAFETY: the element is within the caller's array, and the caller keeps the contract; the reference ends
            // with this statement.
            check_state(damper, unsafe { shared(states.add(index).cast()) }?)?;
        }
        let mut start = 0;
        while start < count {
            let group = GROUP.min(count - start);
            // SAFETY: the elements are within the caller's arrays and checked, and the caller keeps the contract. The
            // displacements are copied before the forces are written, so both can be the same array.
            unsafe {
                let first = made(*dampers.add(start))?;
                let mut together = [first; GROUP];
                let mut displacements = [0.0; GROUP];
                for index in 0..group {
                    together[index] = made(*dampers.add(start + index))?;
                    displacements[index] = displacements_m.add(start + index).read();
                }
                step_bank_with(
                    VectorWidth::baseline(),
                    &together[..group],
                    slice::from_raw_parts_mut(states.add(start).cast(), group),
                    &displacements,
                    slice::from_raw_parts_mut(forces_n.add(start), group),
                );
            }
            start += group;
        }
        Ok(())
    };
    DashpotError::from(done())
}
