//! In place of a rig's sensors: parabolic arcs, and one sensor that fails for 50 ms each second. Replace it by yours.

use dashpot_firmware::bank::DAMPERS;

/// Start of a hash.
pub const HASH: u32 = 2_166_136_261;

/// Displacement of each damper (m), positive in extension. A failed reading is not a number.
pub fn read(tick: u32) -> [f32; DAMPERS] {
    let mut displacements_m = [0.0; DAMPERS];
    for (displacement_m, number) in displacements_m.iter_mut().zip(0..) {
        // Ticks of an arc, different for each damper. An arc is 3 mm high.
        let half = 200 + 35 * number;
        let in_arc = tick % half;
        let arc = (in_arc * (half - in_arc)) as f32 * (0.012 / (half * half) as f32);
        let is_positive = (tick / half).is_multiple_of(2);
        *displacement_m = if is_positive { arc } else { -arc };
    }
    if (500..550).contains(&(tick % 1000)) {
        displacements_m[1] = f32::NAN;
    }
    displacements_m
}

/// Continues a hash (FNV-1a, a word at a time) with the bits of forces. An image that computes the forces of another
/// prints the same.
pub fn hash(before: u32, forces_n: &[f32; DAMPERS]) -> u32 {
    forces_n.iter().fold(before, |hash, force_n| {
        (hash ^ force_n.to_bits()).wrapping_mul(16_777_619)
    })
}
