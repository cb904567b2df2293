//! Calls any function and counts its clock ticks.

use core::arch::asm;

use crate::board;

/// Arguments of a function: integers and addresses in r0 to r3 and on the stack, a real number in s0 (Procedure Call
/// Standard for the Arm Architecture, hard-float variant).
#[derive(Clone, Copy, Debug, Default)]
pub struct Arguments {
    /// Integers and addresses.
    pub integers: [usize; 5],
    /// A real number.
    pub real: f32,
}

/// Results of a function and its cost.
#[derive(Clone, Copy, Debug)]
pub struct Returned {
    /// Result in r0.
    pub integer: usize,
    /// Result in s0.
    pub real: f32,
    /// Clock ticks of the function, of its call and of reading the clock.
    pub ticks: u32,
}

/// Calls the function at an address.
///
/// The count always includes the same two additional instructions. To subtract them, measure a function that only
/// returns.
///
/// # Safety
/// `function` must take arguments of these types with valid addresses, and return.
#[inline(never)]
pub unsafe fn counted_call(function: *const (), arguments: Arguments) -> Returned {
    let [mut integer, a1, a2, a3, on_stack] = arguments.integers;
    let mut real = arguments.real.to_bits();
    let (start, end): (u32, u32);
    // SAFETY: the caller passes a function and arguments as required above; the stack pointer is restored and stays
    // aligned to 8 bytes.
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

/// Clock ticks of a function with these integers and addresses as arguments; see [`counted_call`].
///
/// # Safety
/// As for [`counted_call`].
pub unsafe fn counted_ticks(function: *const (), integers: [usize; 5]) -> u32 {
    let arguments = Arguments {
        integers,
        real: 0.0,
    };
    // SAFETY: the caller passes a function and arguments as required.
    unsafe { counted_call(function, arguments).ticks }
}

/// A function that only returns, to measure the call itself.
#[unsafe(naked)]
pub extern "C" fn nothing() {
    core::arch::naked_asm!("bx lr")
}
