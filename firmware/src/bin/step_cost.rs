//! Counts instructions of the step, one damper or a bank of twelve, over a motion that the host puts
//! into memory, and digests the forces.
//!
//! The host loads an [`Experiment`] at [`EXPERIMENT`] before the start and reads one JSON object from
//! the link's UART. The motion is walked to its end and back until the steps are done. Counts are in
//! ticks of the clock and take in the call (`call`, of a function of one instruction, its return); under
//! QEMU's `-icount shift=10` an instruction takes 25.6 of them.
#![no_std]
#![no_main]

use core::arch::naked_asm;
use core::fmt::Write;
use core::hint::black_box;
use core::ptr::with_exposed_provenance;

use cortex_m_rt::entry;
use dashpot_core::{Damper, DamperState, step_bank};
use dashpot_firmware::board::{self, Port, Uart};
use dashpot_firmware::printer::Printer;

/// Where the host loads the experiment: the upper half of RAM.
const EXPERIMENT: usize = 0x2020_0000;
const BANK: usize = 12;
const LAG: u32 = 9;
/// Stack looked at below the measured call (bytes).
const PAINTED: usize = 2048;
const PAINT: u32 = 0xa5a5_a5a5;

/// What the host asks for; little-endian words, no padding.
#[repr(C)]
struct Experiment {
    /// Another damper, swapped in for one step.
    other: [u32; Damper::<f32>::WORDS],
    damper: [u32; Damper::<f32>::WORDS],
    /// 0: one damper; else the bank.
    bank: u32,
    steps: u32,
    samples: u32,
    /// Displacements (m).
    motion: [f32; 100_000],
}

/// Fewest, most and sum of clock ticks.
struct Cost {
    least: u32,
    most: u32,
    sum: u64,
}

impl Cost {
    fn new() -> Self {
        Self {
            least: u32::MAX,
            most: 0,
            sum: 0,
        }
    }

    fn add(&mut self, ticks: u32) {
        self.least = self.least.min(ticks);
        self.most = self.most.max(ticks);
        self.sum += u64::from(ticks);
    }
}

type Step = extern "C" fn(&Damper<f32>, &mut DamperState<f32>, f32) -> f32;
type Bank =
    extern "C" fn(&Dampers<'_>, &mut [DamperState<f32>; BANK], &[f32; BANK], &mut [f32; BANK]);
type Dampers<'a> = [&'a Damper<f32>; BANK];

extern "C" fn step(damper: &Damper<f32>, state: &mut DamperState<f32>, displacement: f32) -> f32 {
    damper.step(state, displacement)
}

extern "C" fn bank(
    dampers: &Dampers<'_>,
    states: &mut [DamperState<f32>; BANK],
    displacements: &[f32; BANK],
    forces: &mut [f32; BANK],
) {
    step_bank(dampers, states, displacements, forces);
}

/// One instruction, the return.
#[unsafe(naked)]
extern "C" fn no_step(_: &Damper<f32>, _: &mut DamperState<f32>, displacement: f32) -> f32 {
    naked_asm!("bx lr")
}

/// A hundred and one instructions: what is found for it proves the count.
#[unsafe(naked)]
extern "C" fn known_step(_: &Damper<f32>, _: &mut DamperState<f32>, displacement: f32) -> f32 {
    naked_asm!(".rept 100", "nop", ".endr", "bx lr")
}

/// As [`no_step`].
#[unsafe(naked)]
extern "C" fn no_bank(
    _: &Dampers<'_>,
    _: &mut [DamperState<f32>; BANK],
    _: &[f32; BANK],
    _: &mut [f32; BANK],
) {
    naked_asm!("bx lr")
}

/// Force (N) and clock ticks of a call.
#[inline(never)]
fn timed(
    call: Step,
    damper: &Damper<f32>,
    state: &mut DamperState<f32>,
    displacement: f32,
) -> (f32, u32) {
    let start = board::clock_now();
    let force = call(damper, state, displacement);
    (force, board::clock_now().wrapping_sub(start))
}

/// Clock ticks of a call.
#[inline(never)]
fn timed_bank(
    call: Bank,
    dampers: &Dampers<'_>,
    states: &mut [DamperState<f32>; BANK],
    displacements: &[f32; BANK],
    forces: &mut [f32; BANK],
) -> u32 {
    let start = board::clock_now();
    call(dampers, states, displacements, forces);
    board::clock_now().wrapping_sub(start)
}

/// As [`timed`] a step, and the bytes of stack the call took.
#[inline(always)]
fn timed_with_stack(
    damper: &Damper<f32>,
    state: &mut DamperState<f32>,
    displacement: f32,
) -> (u32, usize) {
    let top = cortex_m::register::msp::read() as usize & !3;
    let word = |offset: usize| core::ptr::with_exposed_provenance_mut::<u32>(top - offset);
    for offset in (4..=PAINTED).step_by(4) {
        // SAFETY: RAM below the stack pointer, used by nothing: no interrupt is enabled.
        unsafe { word(offset).write_volatile(PAINT) }
    }
    let (force, ticks) = timed(step, damper, state, displacement);
    black_box(force);
    let mut used = PAINTED;
    // SAFETY: as above.
    while used > 0 && unsafe { word(used).read_volatile() } == PAINT {
        used -= 4;
    }
    (ticks, used)
}

/// Continues FNV-1a (64 bit) with a force.
fn digest(hash: u64, force: f32) -> u64 {
    let bytes = force.to_bits().to_le_bytes();
    bytes.iter().fold(hash, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(0x100_0000_01b3)
    })
}

#[entry]
fn main() -> ! {
    board::start_clock();
    // SAFETY: the host loaded an experiment there before the start; nothing else is linked there.
    let experiment = unsafe { &*with_exposed_provenance::<Experiment>(EXPERIMENT) };
    let damper = Damper::<f32>::from_words(&experiment.damper);
    let other = Damper::<f32>::from_words(&experiment.other);
    let samples = experiment.samples.clamp(2, experiment.motion.len() as u32);
    // To the end of the motion and back.
    let displacement = |step: u32| {
        let place = step % (2 * (samples - 1));
        let place = place.min(2 * (samples - 1) - place);
        experiment.motion[place as usize]
    };

    let mut usual = Cost::new();
    let mut hash = 0xcbf2_9ce4_8422_2325;
    // The lanes of a bank run apart.
    let lane_displacement = |step: u32, lane: usize| displacement(step + LAG * lane as u32);
    let mut states = core::array::from_fn(|lane| damper.at_rest(lane_displacement(0, lane)));
    let mut forces = [0.0; BANK];
    let dampers = [&damper; BANK];
    let call;
    if experiment.bank == 0 {
        call = timed(no_step, &damper, &mut states[0], 0.0).1;
        for count in 0..experiment.steps {
            let (force, ticks) = timed(step, &damper, &mut states[0], displacement(count));
            usual.add(ticks);
            hash = digest(hash, force);
        }
    } else {
        call = timed_bank(no_bank, &dampers, &mut states, &[0.0; BANK], &mut forces);
        for count in 0..experiment.steps {
            let displacements = core::array::from_fn(|lane| lane_displacement(count, lane));
            let ticks = timed_bank(bank, &dampers, &mut states, &displacements, &mut forces);
            usual.add(ticks);
            hash = forces.iter().fold(hash, |hash, force| digest(hash, *force));
        }
    }

    // After the digest: the first step after a reset, and what is not usual, under force.
    let state = &mut states[0];
    *state = damper.at_rest(0.0);
    let first = timed_with_stack(&damper, state, 1.5e-3);
    let held = timed_with_stack(&damper, state, f32::NAN);
    let swapped = timed_with_stack(&other, state, 2.5e-3);
    let stack = first.1.max(held.1).max(swapped.1);
    let single = timed(no_step, &damper, state, 0.0).1;
    let known = timed(known_step, &damper, state, 0.0).1;

    let mut printer = Printer(Uart::start(Port::Link, 1_000_000));
    let _ = writeln!(
        printer,
        "{{\"call\": {call}, \"least\": {}, \"most\": {}, \"sum\": {}, \"digest\": \"{hash:016x}\", \
         \"single_call\": {single}, \"known\": {known}, \"first\": {}, \"held\": {}, \"swapped\": {}, \
         \"stack_bytes\": {stack}, \"damper_bytes\": {}, \"state_bytes\": {}}}",
        usual.least,
        usual.most,
        usual.sum,
        first.0,
        held.0,
        swapped.0,
        size_of::<Damper<f32>>(),
        size_of::<DamperState<f32>>(),
    );
    loop {
        cortex_m::asm::wfi();
    }
}
