//! The same bits as one wheelset at a time.

use std::sync::{Arc, OnceLock};

use super::*;
use crate::contact::{ContactGeometry, Installation, Pair, Steel, Tables};
use crate::creep::{Friction, KalkerBook, Polach};
use crate::math::with_narrowest_vectors;

fn tables() -> Arc<Tables> {
    static TABLES: OnceLock<Arc<Tables>> = OnceLock::new();
    let tables = TABLES.get_or_init(|| {
        let pair = Pair::standard(Installation::default()).unwrap();
        let geometry = ContactGeometry::new(pair, Steel::default()).unwrap();
        Arc::new(Tables::new(geometry))
    });
    Arc::clone(tables)
}

/// Numbers from -1 to 1 that look random.
fn number(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
    (*seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

/// A wheelset between lifted and both flanges pressed to the rails.
fn wheelset(seed: &mut u64) -> (Motion, [RailDisplacement; 2]) {
    let mut next = |scale: f64| scale * number(seed);
    let motion = Motion {
        speed_m_per_s: 20.0,
        rotation_rad_per_s: 32.0 + next(0.1),
        lateral_m: next(8e-3),
        vertical_m: 0.1e-3 + next(0.6e-3),
        roll_rad: next(1e-3),
        yaw_rad: next(10e-3),
        lateral_velocity_m_per_s: next(0.1),
        vertical_velocity_m_per_s: next(0.05),
        roll_rate_rad_per_s: next(0.05),
        yaw_rate_rad_per_s: next(0.05),
    };
    let rails = [0, 1].map(|_| RailDisplacement {
        lateral_m: next(7e-3),
        vertical_m: next(0.3e-3),
        roll_rad: next(2e-3),
        roll_rate_rad_per_s: next(0.01),
        yaw_rad: next(1e-3),
        friction_ratio: 1.0 + next(0.5),
        ..RailDisplacement::default()
    });
    (motion, rails)
}

/// Steps pairs of wheelsets together and alone. Returns which numbers of patches on a wheel occurred.
fn compared<L: CreepLaw>(contact: &WheelsetContact<L>) -> [bool; 4] {
    let mut seed = 1;
    let mut counts = [false; 4];
    let (mut together, mut alone) = (
        [WheelsetForces::default(); 2],
        [WheelsetForces::default(); 2],
    );
    for step in 0..3000 {
        let pair = [wheelset(&mut seed), wheelset(&mut seed)];
        let mut motions = [pair[0].0, pair[1].0];
        let rails = [pair[0].1, pair[1].1];
        match step % 100 {
            97 => motions[0].speed_m_per_s = -20.0,
            98 => motions
                .each_mut()
                .iter_mut()
                .for_each(|motion| motion.speed_m_per_s = -20.0),
            99 => motions[1].yaw_rad = f64::NAN,
            _ => {}
        }
        let [first, second] = &mut together;
        contact.update_two(&motions, &rails, [first, second]);
        for number in 0..2 {
            contact.update(&motions[number], &rails[number], &mut alone[number]);
            for wheel in &alone[number].wheels {
                counts[wheel.loaded_patches().count().min(3)] = true;
            }
        }
        // The text of a number has all its bits, also those of a zero.
        assert_eq!(format!("{together:?}"), format!("{alone:?}"), "{step}");
    }
    counts
}

#[test]
fn forces_have_the_bits_of_one_wheelset_at_a_time() {
    let damped = |contact: WheelsetContact<KalkerBook>| contact.with_normal_damping(5.0).unwrap();
    let by_book = |friction: Friction| {
        damped(WheelsetContact::new(tables(), KalkerBook::new(), friction).unwrap())
    };
    let counts = compared(&by_book(Friction::default()));
    assert_eq!(counts[..3], [true; 3]);
    compared(&by_book(Friction::constant(0.0)));
    let falling = Friction::default().with_residual_ratio(0.4);
    compared(&by_book(falling));
    compared(&WheelsetContact::new(tables(), Polach, falling).unwrap());
    with_narrowest_vectors(|| compared(&by_book(Friction::default())));
}
