//! Expected result of `prefix_digest` in `damper.c`, computed with the core.

use dashpot_core::Damper;

use crate::Word;

/// Number of steps of the motion.
const STEPS: u32 = 2048;

/// Hash (FNV-1a, 32 bit) of a damper's states during the motion that `damper.c` generates. The motion consists of
/// random moves about zero from a linear congruential generator (Numerical Recipes). The moves start at the largest
/// credible size, are halved every 128 steps and start over every 1024 steps. There are also failed readings, a jump
/// and a change of clearance.
pub(super) fn digest<T: Word>(damper: &Damper<T>) -> u32 {
    let mut damper = *damper;
    let mut state = damper.at_rest(T::ZERO);
    // The first word is twice the bit pattern of the largest move.
    let largest_move = T::from_word(T::words(&damper).first().copied().unwrap_or_default() >> 1);
    let number = T::from_f64;
    let (mut hash, mut random) = (0x811c_9dc5_u32, 1_u32);
    let (mut scale, mut displacement) = (largest_move, T::ZERO);
    for step in 0..STEPS {
        random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let fraction = number(f64::from(random >> 9) / f64::from(1 << 22) - 1.0);
        displacement = displacement * number(0.875) + scale * fraction;
        if step % 128 == 127 {
            scale = if step % 1024 == 1023 {
                largest_move
            } else {
                number(0.5) * scale
            };
        }
        if step == 700 {
            displacement = displacement + number(1.0);
        }
        if step == 1500 {
            // The clearance is in range, so this cannot fail.
            let _ = damper.set_clearance_m(number(1.0 / 1024.0));
        }
        let failed = step % 512 == 300;
        damper.step(
            &mut state,
            if failed {
                number(f64::NAN)
            } else {
                displacement
            },
        );
        for byte in T::state_bytes(&state) {
            hash = (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193);
        }
    }
    hash
}
