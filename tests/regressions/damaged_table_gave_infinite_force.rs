//! Fixed bug: a constant that was damaged in memory produced a force of any size, up to infinity, without an error.

use dashpot::damper;
use dashpot::memory::bytes;
use dashpot_core::Damper;
use dashpot_core::parameters::MAX_FORCE_N;

#[test]
fn any_number_of_the_constants_may_be_infinite() {
    let built: Damper<f32> = damper("in-service", &[]).build(1e-3).expect("a preset");
    for offset in (0..size_of::<Damper<f32>>()).step_by(4) {
        for number in [f32::INFINITY, f32::NEG_INFINITY, f32::NAN, f32::MAX] {
            let mut damaged = built;
            bytes(&mut damaged)[offset..offset + 4].copy_from_slice(&number.to_ne_bytes());
            let mut state = damaged.at_rest(0.0);
            for x in [1e-3, -2e-3, 5e-3] {
                let force = damaged.step(&mut state, x);
                assert!(
                    force.abs() <= MAX_FORCE_N as f32,
                    "{number} at byte {offset}: {force} N"
                );
            }
        }
    }
}
