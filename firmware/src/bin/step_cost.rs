//! Counts the instructions that each step of one damper, or of a bank of twelve, takes over a motion that the host puts
//! into memory. Also computes a digest of the forces. Then it counts the instructions of unusual steps and of the
//! functions of the C library.
//!
//! The host loads an [`Experiment`] at [`__sheap`] before the start and reads one JSON object from the link's UART.
//! Counts are in clock ticks and include the function call itself; `call` is the count of a function that only returns.
//! Under QEMU's `-icount shift=10` an instruction takes 1024 ns.
#![no_std]
#![no_main]

use core::arch::naked_asm;
use core::cell::Cell;
use core::fmt::Write;
use core::hint::black_box;

use cortex_m_rt::entry;
use dashpot::{
    DASHPOT_CHECK_SLICES, DASHPOT_DAMPER_WORDS, DASHPOT_STATE_WORDS, DashpotCheck, DashpotDamper,
    DashpotState, dashpot_check_slice, dashpot_damper_init, dashpot_damper_set_clearance,
    dashpot_state_init, dashpot_step, dashpot_step_bank,
};
use dashpot_core::{Damper, DamperState, Loading, step_bank};
use dashpot_experiment::{BANK, BYTES, Experiment};
use dashpot_firmware::board::{self, CLOCK_HZ, Port, Uart};
use dashpot_firmware::counted_call::{Arguments, Returned, counted_call, nothing};
use dashpot_firmware::printer::Printer;

/// Size of the part of the stack, below the measured call, that is checked for use (bytes).
const PAINTED: usize = 2048;
const PAINT: u32 = 0xa5a5_a5a5;

unsafe extern "C" {
    /// RAM for the experiment from the host, unused by start-up code, data and stack. The linker script of cortex-m-rt
    /// defines the symbol.
    static __sheap: [u8; BYTES];
}

/// Smallest, largest and total number of clock ticks of the calls.
#[derive(Clone, Copy)]
struct Cost {
    least: u32,
    most: u32,
    sum: u64,
}

impl Cost {
    const NONE: Self = Self {
        least: u32::MAX,
        most: 0,
        sum: 0,
    };

    fn with(self, ticks: u32) -> Self {
        Self {
            least: self.least.min(ticks),
            most: self.most.max(ticks),
            sum: self.sum + u64::from(ticks),
        }
    }
}

extern "C" fn bank(
    dampers: &[&Damper<f32>; BANK],
    states: &mut [DamperState<f32>; BANK],
    displacements: &[f32; BANK],
    forces: &mut [f32; BANK],
) {
    step_bank(dampers, states, displacements, forces);
}

/// Returns 0 while slices are left, then 1; 2 if the image is refused.
extern "C" fn load_slice(damper: &mut Damper<f32>, image: &&[u8], loading: &mut Loading) -> usize {
    damper.load_slice(image, loading).map_or(2, usize::from)
}

/// Returns the largest number of clock ticks of one slice while a damper is loaded; 0 if the image is refused.
fn timed_load(image: &[u8]) -> u32 {
    let mut damper = Damper::<f32>::from_words(&[0; Damper::<f32>::WORDS]);
    let mut loading = Loading::START;
    let mut most = 0;
    loop {
        let integers = [
            (&raw mut damper).expose_provenance(),
            address(&image),
            (&raw mut loading).expose_provenance(),
            0,
            0,
        ];
        let slice = timed(load_slice as *const (), integers, 0.0);
        most = slice.ticks.max(most);
        match slice.integer {
            0 => {}
            1 => return most,
            _ => return 0,
        }
    }
}

/// A function of 101 instructions, which shows that the count is correct.
#[unsafe(naked)]
extern "C" fn known() {
    naked_asm!(".rept 100", "nop", ".endr", "bx lr")
}

/// Calls a function of this file or of the C library with valid arguments.
fn timed(function: *const (), integers: [usize; 5], real: f32) -> Returned {
    // SAFETY: every caller below passes valid arguments of the function's types.
    unsafe { counted_call(function, Arguments { integers, real }) }
}

fn timed_step(damper: &Damper<f32>, state: &mut DamperState<f32>, displacement: f32) -> Returned {
    let integers = [
        address(damper),
        (&raw mut *state).expose_provenance(),
        0,
        0,
        0,
    ];
    // On this processor Rust passes these arguments and returns the force as C does; other forces would have another
    // digest. A wrapper in C would add its own call.
    let step: fn(&Damper<f32>, &mut DamperState<f32>, f32) -> f32 = Damper::step;
    timed(step as *const (), integers, displacement)
}

fn address<T: ?Sized>(value: &T) -> usize {
    (&raw const *value).expose_provenance()
}

/// Stack that `call` uses, including the stack frames of the counting (bytes).
#[inline(always)]
fn stack_of(call: impl FnOnce()) -> usize {
    let top = cortex_m::register::msp::read() as usize & !3;
    let word = |offset: usize| core::ptr::with_exposed_provenance_mut::<u32>(top - offset);
    for offset in (4..=PAINTED).step_by(4) {
        // SAFETY: RAM below the stack pointer is unused because no interrupt is enabled.
        unsafe { word(offset).write_volatile(PAINT) }
    }
    call();
    let mut used = PAINTED;
    // SAFETY: this is the same unused RAM.
    while used > 0 && unsafe { word(used).read_volatile() } == PAINT {
        used -= 4;
    }
    used
}

/// Clock ticks of the functions of the C library.
struct Library {
    damper_init: u32,
    step: u32,
    step_bank: u32,
    set_clearance: u32,
    /// Largest number of clock ticks of one slice in a round of the integrity check.
    check_slice: u32,
}

impl Library {
    fn timed(experiment: &Experiment<'_>) -> Self {
        let mut damper = DashpotDamper {
            opaque: [0; DASHPOT_DAMPER_WORDS],
        };
        let mut states = [DashpotState {
            opaque: [0; DASHPOT_STATE_WORDS],
        }; BANK];
        let displacements = [1e-3_f32; BANK];
        let mut forces = [0.0_f32; BANK];
        let image = experiment.damper;
        let damper_address = (&raw mut damper).expose_provenance();
        let init = timed(
            dashpot_damper_init as *const (),
            [damper_address, address(image), image.len(), 0, 0],
            0.0,
        );
        for state in &mut states {
            // SAFETY: the storage is separate and the damper is initialised.
            let _ = unsafe { dashpot_state_init(state, &damper, 0.0) };
        }
        let states_address = (&raw mut states).expose_provenance();
        let forces_address = (&raw mut forces).expose_provenance();
        let step = timed(
            dashpot_step as *const (),
            [damper_address, states_address, forces_address, 0, 0],
            1e-3,
        );
        let dampers = [damper_address; BANK];
        let integers = [
            address(&dampers),
            states_address,
            address(&displacements),
            forces_address,
            BANK,
        ];
        let step_bank = timed(dashpot_step_bank as *const (), integers, 0.0);
        let mut check = DashpotCheck { opaque: [0; 3] };
        let check_address = (&raw mut check).expose_provenance();
        let slices = (0..DASHPOT_CHECK_SLICES).map(|_| {
            timed(
                dashpot_check_slice as *const (),
                [damper_address, states_address, check_address, 0, 0],
                0.0,
            )
        });
        let most =
            |worst: Returned, slice: Returned| match (worst.integer, slice.ticks > worst.ticks) {
                (0, true) => slice,
                _ => worst,
            };
        let none = Returned {
            integer: 0,
            real: 0.0,
            ticks: 0,
        };
        let check_slice = slices.fold(none, most);
        let set_clearance = timed(
            dashpot_damper_set_clearance as *const (),
            [damper_address, 0, 0, 0, 0],
            2e-3,
        );
        // A refused call does not do the work, so its clock ticks are reported as 0.
        let counted = |returned: Returned| match returned.integer {
            0 => returned.ticks,
            _ => 0,
        };
        Self {
            damper_init: counted(init),
            step: counted(step),
            step_bank: counted(step_bank),
            set_clearance: counted(set_clearance),
            check_slice: counted(check_slice),
        }
    }
}

#[entry]
fn main() -> ! {
    board::start_clock();
    let mut printer = Printer(Uart::start(Port::Link, 1_000_000));
    // SAFETY: the host wrote this memory before the start; nothing writes it now.
    let bytes = unsafe { &*black_box(&raw const __sheap) };
    match Experiment::parse(bytes) {
        Some(experiment) => measure(&experiment, &mut printer),
        None => drop(writeln!(printer, "no experiment was loaded")),
    }
    loop {
        cortex_m::asm::wfi();
    }
}

fn measure(experiment: &Experiment<'_>, printer: &mut Printer) {
    let read = |image| Damper::<f32>::from_image(image);
    let (Ok(damper), Ok(other)) = (read(experiment.damper), read(experiment.other)) else {
        let _ = writeln!(
            printer,
            "the experiment contains no valid damper for this core"
        );
        return;
    };
    let call = timed(nothing as *const (), [0; 5], 0.0).ticks;
    let cost = Cell::new(Cost::NONE);
    let digest = experiment.run(
        &damper,
        |damper, state, displacement| {
            let returned = timed_step(damper, state, displacement);
            cost.set(cost.get().with(returned.ticks));
            returned.real
        },
        |dampers, states, displacements, forces| {
            let integers = [
                address(dampers),
                (&raw mut *states).expose_provenance(),
                address(displacements),
                (&raw mut *forces).expose_provenance(),
                0,
            ];
            let returned = timed(bank as *const (), integers, 0.0);
            cost.set(cost.get().with(returned.ticks));
        },
    );
    let cost = cost.get();

    // The first step after a reset, then unusual steps while the damper is under force.
    let state = &mut damper.at_rest(0.0);
    let mut stack = 0;
    let mut unusual = |damper: &Damper<f32>, displacement: f32| {
        let mut ticks = 0;
        let used = stack_of(|| ticks = timed_step(damper, state, displacement).ticks);
        stack = used.max(stack);
        ticks
    };
    let first = unusual(&damper, 1.5e-3);
    let held = unusual(&damper, f32::NAN);
    let limited = unusual(&damper, 10e-3);
    let jumped = unusual(&damper, 0.2);
    let swapped = unusual(&other, 2.5e-3);
    let unused = stack_of(|| _ = timed(nothing as *const (), [0; 5], 0.0));
    let known = timed(known as *const (), [0; 5], 0.0).ticks;
    let load_slice = timed_load(experiment.damper);
    let library = Library::timed(experiment);

    let _ = writeln!(
        printer,
        "{{\"clock_hz\": {CLOCK_HZ}, \"call\": {call}, \"known\": {known}, \"least\": {}, \"most\": {}, \
         \"sum\": {}, \"digest\": \"{:016x}\", \"first\": {first}, \"held\": {held}, \
         \"limited\": {limited}, \"jumped\": {jumped}, \"swapped\": {swapped}, \"load_slice\": {load_slice}, \
         \"stack_bytes\": {}, \"damper_bytes\": {}, \
         \"state_bytes\": {}, \"c_damper_init\": {}, \"c_step\": {}, \"c_step_bank\": {}, \
         \"c_set_clearance\": {}, \"c_check_slice\": {}}}",
        cost.least,
        cost.most,
        cost.sum,
        digest.value(),
        stack - unused,
        size_of::<Damper<f32>>(),
        size_of::<DamperState<f32>>(),
        library.damper_init,
        library.step,
        library.step_bank,
        library.set_clearance,
        library.check_slice,
    );
}
