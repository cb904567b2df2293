//! Fixed bug: if damage made a value of a stepped state NaN, every later force was NaN, because mark and revision were
//! still valid.

use dashpot::damper;
use dashpot::memory::bytes;
use dashpot_core::Damper;

#[test]
fn a_force_after_nan_in_a_state_is_a_number() {
    let damper: Damper<f32> = damper("in-service", &[]).build(1e-3).expect("a preset");
    for offset in (0..16).step_by(4) {
        for number in [f32::NAN, -f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            let mut state = damper.at_rest(0.0);
            damper.step(&mut state, 1e-3);
            bytes(&mut state)[offset..offset + 4].copy_from_slice(&number.to_ne_bytes());
            let forces = [2e-3, 3e-3, 4e-3].map(|x| damper.step(&mut state, x));
            let limit = damper.force_limit_n();
            assert!(
                forces.iter().all(|force| force.abs() <= limit),
                "{number} at byte {offset}: {forces:?} N"
            );
        }
    }
}
