//! Lateral force of a wheel under constant load, over its lateral shift in steps of a micrometre.

use std::sync::Arc;

use dashpot_rail::contact::{Motion, PatchSource, RailDisplacement, WheelForces, WheelsetContact};
use dashpot_rail::creep::{Friction, Polach};

/// Range of the shift, m, and its step, m.
pub const SHIFTS_M: [f64; 2] = [-16e-3, 16e-3];
pub const STEP_M: f64 = 1e-6;
/// Maximum lateral force that counts: as a multiple of the load, and in N. Beyond it, a steep worn flange jams, the
/// normal load approaches the 400 kN that the tables hold, and no track would bear it.
pub const MAX_RATIO: f64 = 3.0;
pub const MAX_LATERAL_N: f64 = 300e3;
/// Error of the vertical force, N.
const TOLERANCE_N: f64 = 0.5;

/// Attitude and load of a wheel: 0 is the left one, 1 the right one.
#[derive(Debug, Clone, Copy)]
pub struct Given {
    pub side: usize,
    pub roll_rad: f64,
    pub yaw_rad: f64,
    pub load_n: f64,
}

/// A change of the lateral force over one step that ends at a shift.
#[derive(Debug, Clone, Copy, Default)]
pub struct Change {
    pub change_n: f64,
    pub lateral_m: f64,
    /// Lateral force before and after the step, N.
    pub forces_n: [f64; 2],
}

/// A contact with a friction coefficient.
pub fn contact<S: PatchSource>(source: &Arc<S>, friction: f64) -> WheelsetContact<Polach, S> {
    WheelsetContact::new(Arc::clone(source), Polach, Friction::constant(friction)).unwrap()
}

/// The wheel at a lateral shift and a height.
pub fn wheel<S: PatchSource>(
    contact: &WheelsetContact<Polach, S>,
    given: &Given,
    lateral_m: f64,
    vertical_m: f64,
) -> WheelForces {
    let radius_m = contact.sources()[given.side]
        .geometry()
        .pair()
        .installation()
        .wheel_radius_m;
    let motion = Motion {
        speed_m_per_s: 20.0,
        rotation_rad_per_s: 20.0 / radius_m,
        lateral_m,
        vertical_m,
        roll_rad: given.roll_rad,
        yaw_rad: given.yaw_rad,
        ..Motion::default()
    };
    contact
        .forces(&motion, &[RailDisplacement::default(); 2])
        .wheels[given.side]
}

/// The wheel under its load at a lateral shift; `height_m` is a guess of its height, and becomes it. `None` if no
/// height carries the load, because the flange jams.
pub fn under_load<S: PatchSource>(
    contact: &WheelsetContact<Polach, S>,
    given: &Given,
    lateral_m: f64,
    height_m: &mut f64,
) -> Option<WheelForces> {
    let excess = |vertical_m: f64| {
        let wheel = wheel(contact, given, lateral_m, vertical_m);
        (-wheel.force_n[2] - given.load_n, wheel)
    };
    let (mut low, mut high) = (*height_m, *height_m);
    let (mut at_low, found) = excess(low);
    if at_low.abs() < TOLERANCE_N {
        return Some(found);
    }
    let mut at_high = at_low;
    let mut reach = 1e-6;
    while at_low > 0.0 {
        (high, at_high) = (low, at_low);
        low -= reach;
        at_low = excess(low).0;
        reach *= 2.0;
    }
    while at_high < 0.0 {
        (low, at_low) = (high, at_high);
        high += reach;
        at_high = excess(high).0;
        reach *= 2.0;
        if high > 0.1 {
            return None;
        }
    }
    // The Illinois method.
    let mut last_side = 0;
    let mut wheel_found = found;
    for step in 0..200 {
        let middle = if step < 60 {
            (low * at_high - high * at_low) / (at_high - at_low)
        } else {
            0.5 * (low + high)
        };
        let (at_middle, wheel) = excess(middle);
        (*height_m, wheel_found) = (middle, wheel);
        if at_middle.abs() < TOLERANCE_N || high - low < 1e-15 {
            break;
        }
        let side = if at_middle < 0.0 { -1 } else { 1 };
        if side < 0 {
            (low, at_low) = (middle, at_middle);
            at_high *= if last_side == side { 0.5 } else { 1.0 };
        } else {
            (high, at_high) = (middle, at_middle);
            at_low *= if last_side == side { 0.5 } else { 1.0 };
        }
        last_side = side;
    }
    Some(wheel_found)
}

/// The greatest change over one step between two shifts, of forces up to [`MAX_RATIO`] and [`MAX_LATERAL_N`]. Ends
/// where the force exceeds them: on the flange, which may jam from there on.
pub fn greatest_change<S: PatchSource>(
    contact: &WheelsetContact<Polach, S>,
    given: &Given,
    [from_m, to_m]: [f64; 2],
    step_m: f64,
) -> Change {
    let mut height_m = 0.0;
    let max_n = MAX_LATERAL_N.min(MAX_RATIO * given.load_n);
    let mut worst = Change::default();
    let mut lateral_n = |lateral_m: f64| {
        let wheel = under_load(contact, given, lateral_m, &mut height_m);
        wheel.map(|wheel| wheel.force_n[1])
    };
    let mut before = lateral_n(from_m).expect("the flange does not jam at the start");
    for step in 1..=((to_m - from_m) / step_m).round() as u32 {
        let lateral_m = from_m + step_m * f64::from(step);
        let now = lateral_n(lateral_m);
        let now = now.unwrap_or_else(|| panic!("jams at {lateral_m} m after {before} N"));
        if (now - before).abs() > worst.change_n {
            worst = Change {
                change_n: (now - before).abs(),
                lateral_m,
                forces_n: [before, now],
            };
        }
        before = now;
        if before.abs() > max_n {
            break;
        }
    }
    worst
}
