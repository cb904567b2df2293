//! Fixed bug: after damage, the outputs held the force of the tick before the damage was found. By then, damaged memory
//! had produced forces for up to ten seconds, so the held force was wrong by up to 37.9 kN.

use dashpot_core::integrity::SLICES;
use dashpot_core::link::{LossOfLink, Request, SafeOutput};

use crate::common::{Bench, reals};
use crate::damage::flip_a_bit_of;

/// Displacement (m) at a tick.
fn displacement(tick: u32) -> f32 {
    4e-3 * (0.05 * tick as f32).sin()
}

/// A bench whose dampers move and whose safe output holds, with the force of the first damper at each tick.
struct Moving {
    bench: Bench,
    tick: u32,
    forces_n: Vec<f32>,
}

impl Moving {
    fn new() -> Self {
        let mut bench = Bench::open();
        bench.done(&Request::LossOfLink(LossOfLink {
            after_ticks: u32::MAX,
            output: SafeOutput::Hold,
        }));
        bench.ask(&Request::Run {
            displacements_m: reals([0.0; 2]),
        });
        Self {
            bench,
            tick: 0,
            forces_n: vec![0.0],
        }
    }

    fn tick(&mut self) {
        self.tick += 1;
        self.bench.ask(&Request::Displace {
            displacements_m: reals([displacement(self.tick); 2]),
        });
        self.bench.device.tick(1);
        self.forces_n.push(self.bench.device.outputs_n()[0]);
    }
}

#[test]
fn constants_found_damaged_hold_a_force_from_before_the_damage() {
    let mut moving = Moving::new();
    // Waits until both dampers have been checked for a round.
    while moving.tick < 2 * SLICES + 100 {
        moving.tick();
    }
    let damaged_at = moving.tick as usize;
    let words = moving.bench.dampers[0].to_words();
    let piece: Vec<u8> = words[13 + 13 * 20..][..13]
        .iter()
        .flat_map(|word| word.to_le_bytes())
        .collect();
    flip_a_bit_of(&mut moving.bench.device, &piece);
    while moving.bench.counters().corruptions == 0 {
        moving.tick();
        assert!(moving.tick < 6 * SLICES, "not found");
    }
    // The check round that began at the first tick found no damage; the one that began at 2 SLICES + 1 did.
    let held = moving.bench.device.outputs_n()[0];
    let sound = moving.forces_n[1];
    assert_eq!(held, sound);
    assert!(damaged_at > 2 * SLICES as usize && moving.tick > 2 * SLICES);
    moving.bench.device.tick(100);
    assert_eq!(moving.bench.device.outputs_n()[0], sound, "it is held");
}

#[test]
fn a_state_found_damaged_holds_the_force_of_its_last_sound_check() {
    let mut moving = Moving::new();
    while moving.tick < 300 {
        moving.tick();
    }
    let pointer = std::ptr::from_ref(&moving.bench.device.states()[0]).cast_mut();
    // SAFETY: plain data with no other reference at this point. The stretch becomes 1e38 m.
    unsafe { pointer.cast::<[u8; 24]>().as_mut().expect("a state")[7] ^= 1 << 6 };
    let damaged_at = moving.tick as usize;
    while moving.bench.counters().corruptions == 0 {
        moving.tick();
        assert!(moving.tick < 310, "not found");
    }
    let held = moving.bench.device.outputs_n()[0];
    let sound = &moving.forces_n[damaged_at - 1..=damaged_at];
    assert!(
        sound.contains(&held),
        "{held} N, {sound:?} N before the damage"
    );
}
