//! Friction that differs between the rails.

use std::sync::Arc;

use dashpot_rail::contact::{
    Motion, PatchSource, RailDisplacement, WheelsetContact, WheelsetForces,
};
use dashpot_rail::creep::{CreepLaw, Friction, KalkerBook, Polach};

use crate::common::{LEVEL, at_height_under_load, geometry, rolling, tables};

/// Compares the wheels on rails with the ratios 1 and 1/2 with those of contacts that have the whole and half the
/// friction. A factor of 1/2 is exact, so every bit must be the same.
fn compare<L: CreepLaw + Clone, S: PatchSource>(source: &Arc<S>, law: &L, friction: Friction) {
    let contact =
        |friction| WheelsetContact::new(Arc::clone(source), law.clone(), friction).unwrap();
    let whole = contact(friction);
    let half = contact(friction.with_static_coefficient(0.5 * friction.static_coefficient));
    let motion = Motion {
        yaw_rad: 4e-3,
        lateral_m: 2e-3,
        ..rolling(20.0)
    };
    let motion = at_height_under_load(&whole, &motion, 180e3);
    let slippery = RailDisplacement {
        friction_ratio: 0.5,
        ..RailDisplacement::default()
    };
    let rails = [LEVEL[0], slippery];
    let found = whole.forces(&motion, &rails);
    let expected = [whole.forces(&motion, &LEVEL), half.forces(&motion, &LEVEL)];
    for (side, expected) in expected.iter().enumerate() {
        assert_eq!(found.wheels[side], expected.wheels[side], "side {side}");
    }
    assert_ne!(expected[0].wheels[1].force_n, expected[1].wheels[1].force_n);
    let mut forces = WheelsetForces::default();
    let found = whole.update_with_derivatives(&motion, &rails, &mut forces);
    for (side, contact) in [&whole, &half].into_iter().enumerate() {
        let expected = contact.update_with_derivatives(&motion, &LEVEL, &mut forces);
        assert_eq!(found[side], expected[side], "derivatives of side {side}");
    }
}

#[test]
fn a_rail_with_half_the_friction_acts_as_if_the_contact_had_half() {
    let constant = Friction::constant(0.3);
    let falling = constant
        .with_residual_ratio(0.4)
        .with_decay_speed_m_per_s(0.1);
    for friction in [constant, falling] {
        compare(&tables(), &KalkerBook::new(), friction);
        compare(&tables(), &Polach, friction);
        compare(&Arc::new(geometry().clone()), &KalkerBook::new(), friction);
    }
}

#[test]
fn a_rail_without_friction_has_no_creep_forces() {
    let contact = WheelsetContact::new(tables(), KalkerBook::new(), Friction::default()).unwrap();
    let motion = at_height_under_load(&contact, &rolling(20.0), 180e3);
    let motion = Motion {
        yaw_rad: 4e-3,
        ..motion
    };
    let mut rails = LEVEL;
    rails[0].friction_ratio = 0.0;
    let forces = contact.forces(&motion, &rails);
    let creep = |side: usize| {
        let patches = forces.wheels[side].loaded_patches();
        patches
            .map(|patch| patch.creep.lateral_n.abs())
            .sum::<f64>()
    };
    assert_eq!(creep(0), 0.0);
    assert!(creep(1) > 10e3, "{}", creep(1));
}
