//! A call of any function, counted in ticks of the clock.

use core::arch::asm;

use crate::board;

/// What a function gets: whole numbers and addresses in r0 to r3 and the next on the stack, a real number
/// in s0 (Procedure Call Standard for the Arm Architecture, hard-float variant).
#[derive(Clone, Copy, Debug, Default)]
pub struct Arguments {
    /// Whole numbers and addresses.
    pub integers: [usize; 5],
    /// A real number.
    pub real: f32,
}

/// What a function returned, and what it took.
#[derive(Clone, Copy, Debug)]
pub struct Returned {
    /// In r0.
    pub integer: usize,
    /// In s0.
    pub real: f32,
    /// Clock ticks: of the function, its call and a reading of the clock.
    pub ticks: u32,
}

/// Calls the function at an address. The same two instructions are counted beside the function's own
/// whatever it is, so the ticks of a function of one instruction tell what to subtract.
///
/// # Safety
/// `function` takes arguments of these types, those of addresses are right, and it returns.
#[inline(never)]
pub unsafe fn counted_call(function: *const (), arguments: Arguments) -> Returned {
    let [mut integer, a1, a2, a3, on_stack] = arguments.integers;
    let mut real = arguments.real.to_bits();
    let (start, end): (u32, u32);
    // SAFETY: the caller's promise; the stack pointer is as before at the end, and stays aligned to 8.
    unsafe {
        asm!(
            "push {{r9, r10}}",
            "vmov s0, r10",
            "ldr r5, [r4]",
            "blx r8",
            "ldr r4, [r4]",
            "vmov r10, s0",
            "add sp, #8",
            inout("r0") integer, inout("r1") a1 => _, inout("r2") a2 => _, inout("r3") a3 => _,
            in("r9") on_stack, inout("r10") real,
            inout("r4") board::TIMER_VALUE => end, out("r5") start, in("r8") function,
            lateout("r12") _, lateout("lr") _,
            lateout("d0") _, lateout("d1") _, lateout("d2") _, lateout("d3") _,
            lateout("d4") _, lateout("d5") _, lateout("d6") _, lateout("d7") _,
        );
    }
    Returned {
        integer,
        real: f32::from_bits(real),
        // The timer counts down.
        ticks: start.wrapping_sub(end),
    }
}
