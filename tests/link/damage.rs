//! Damage to memory while the tick runs freely is found, latched and counted, and the device switches to the safe
//! output until the damper is loaded again.

use dashpot_core::Status;
use dashpot_core::integrity::SLICES;
use dashpot_core::link::{Device, LossOfLink, Refusal, Request, Response, SafeOutput};

use crate::common::{Bench, reals};

/// Flips a bit of these bytes, which occur only once in the device.
pub fn flip_a_bit_of(device: &mut Device<2, 2>, bytes: &[u8]) {
    let (start, length) = (
        std::ptr::from_mut(device).cast::<u8>(),
        size_of::<Device<2, 2>>(),
    );
    // SAFETY: the device's memory; the changed value is a number, for which every bit pattern is valid.
    let memory = unsafe { std::slice::from_raw_parts_mut(start, length) };
    let windows = memory.windows(bytes.len()).enumerate();
    let found: Vec<usize> = windows
        .filter_map(|(offset, window)| (window == bytes).then_some(offset))
        .collect();
    let [offset] = found[..] else {
        panic!("{} occurrences", found.len());
    };
    memory[offset + 2] ^= 1 << 5;
}

fn running() -> Bench {
    let mut bench = Bench::open();
    bench.done(&Request::LossOfLink(LossOfLink {
        after_ticks: u32::MAX,
        output: SafeOutput::RampToZero { ticks: 4 },
    }));
    bench.ask(&run());
    bench.ask(&Request::Displace {
        displacements_m: reals([2e-3; 2]),
    });
    bench.device.tick(1);
    assert!(bench.device.outputs_n().iter().all(|force| *force > 100.0));
    bench
}

fn run() -> Request<'static> {
    Request::Run {
        displacements_m: reals([0.0; 2]),
    }
}

/// Returns the number of ticks until the damage is found, and checks that the outputs then fall to zero. The damaged
/// damper's output starts at a force computed before the damage.
fn falls_to_zero(bench: &mut Bench, damaged: usize, sound_n: f32) -> u32 {
    let mut ticks = 0;
    let mut last_good = *bench.device.outputs_n();
    while bench.counters().corruptions == 0 {
        last_good = *bench.device.outputs_n();
        bench.device.tick(1);
        ticks += 1;
        assert!(ticks < 5 * SLICES, "not found");
    }
    last_good[damaged] = sound_n;
    for share in [0.75, 0.5, 0.25, 0.0, 0.0] {
        assert_eq!(
            *bench.device.outputs_n(),
            last_good.map(|force| share * force)
        );
        bench.device.tick(1);
    }
    assert_eq!(bench.counters().corruptions, 1);
    ticks
}

#[test]
fn damaged_constants_take_the_safe_output_until_the_damper_is_loaded_again() {
    let mut bench = running();
    // A piece of the first damper's table: twelve coefficients and its knot.
    let words = bench.dampers[0].to_words();
    let piece = words[13 + 13 * 5..][..13]
        .iter()
        .flat_map(|word| word.to_le_bytes());
    let piece: Vec<u8> = piece.collect();
    flip_a_bit_of(&mut bench.device, &piece);
    // A check takes one round for each damper, plus the rest of the round in progress. No round has been completed
    // since the dampers were at rest.
    assert!(falls_to_zero(&mut bench, 0, 0.0) <= 3 * SLICES);
    let (status, _) = bench.status(&Request::Status);
    let damaged = |bits: u16| bits & Status::CORRUPTED.bits() != 0;
    assert_eq!([damaged(status[0]), damaged(status[1])], [true, false]);
    let displace = Request::Displace {
        displacements_m: reals([0.0; 2]),
    };
    assert_eq!(bench.ask(&displace).refusal(), Some(Refusal::Corrupted(0)));
    assert_eq!(bench.ask(&run()).refusal(), Some(Refusal::Corrupted(0)));
    let image = bench.dampers[0].to_image();
    assert_eq!(bench.load(0, &image).response().1, Response::Done);
    assert_eq!(bench.ask(&run()).forces().tick, 0);
    assert_eq!(bench.ask(&displace).forces().forces_n[..], [0.0; 2]);
    bench.device.tick(4 * SLICES);
    assert_eq!(bench.counters().corruptions, 1, "undamaged again");
}

/// The damaged value is the step of the first damper, which is also the step of the bank.
#[test]
fn a_damper_with_a_damaged_step_can_be_loaded_again() {
    let mut bench = running();
    let scalars = bench.dampers[0].to_words()[..11].to_vec();
    let scalars: Vec<u8> = scalars.iter().flat_map(|word| word.to_le_bytes()).collect();
    // The bytes start at the step, so that the flipped bit belongs to it.
    flip_a_bit_of(&mut bench.device, &scalars[12..]);
    falls_to_zero(&mut bench, 0, 0.0);
    let image = bench.dampers[0].to_image();
    assert_eq!(bench.load(0, &image).response().1, Response::Done);
    assert_eq!(bench.ask(&run()).forces().tick, 0);
}

#[test]
fn a_damaged_state_takes_the_safe_output_until_run() {
    let mut bench = running();
    // Overwrites the second state, including its revision and mark, as if it had never been written.
    let state = bench.device.states()[1].to_bytes();
    let before = bench.device.tick_number();
    bench.device.tick(1); // in which the second state is checked
    let sound_n = bench.device.outputs_n()[1];
    let pointer = std::ptr::from_ref(&bench.device.states()[1]).cast_mut();
    // SAFETY: plain data with no other reference at this point.
    unsafe { pointer.cast::<[u8; 24]>().write([0xff; 24]) };
    let ticks = falls_to_zero(&mut bench, 1, sound_n);
    assert!(ticks <= 2, "{ticks}");
    assert_ne!(bench.device.states()[1].to_bytes(), state);
    assert!(bench.device.tick_number() > before);
    assert_eq!(bench.ask(&run()).forces().tick, 0);
    bench.device.tick(10);
    assert_eq!(bench.counters().corruptions, 1);
}
