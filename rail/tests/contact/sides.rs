//! Unequal wheels and rails, rolled rails, normal damping, and profiles that change along the track.

use std::sync::Arc;

use dashpot_rail::contact::{
    ContactGeometry, Installation, Motion, Pair, RailDisplacement, Status, Steel, WheelsetContact,
    WheelsetForces,
};
use dashpot_rail::creep::{Friction, ShenHedrickElkins};
use dashpot_rail::profile::{Profile, uic60};

use crate::common::{LEVEL, at_height_under_load, geometry, rolling, tables};

fn of(installation: Installation) -> Arc<ContactGeometry> {
    let pair = Pair::standard(installation).unwrap();
    Arc::new(ContactGeometry::new(pair, Steel::default()).unwrap())
}

fn contact(
    sides: [Arc<ContactGeometry>; 2],
) -> WheelsetContact<ShenHedrickElkins, ContactGeometry> {
    WheelsetContact::with_sides(sides, ShenHedrickElkins, Friction::default()).unwrap()
}

#[test]
fn a_larger_wheel_sits_deeper_and_rolls_on_its_own_radius() {
    let sides = [0.62495, 0.62505]
        .map(|wheel_radius_m| of(Installation::default().with_wheel_radius_m(wheel_radius_m)));
    let unequal = contact(sides);
    let equal = contact([Arc::new(geometry().clone()), Arc::new(geometry().clone())]);
    let motion = at_height_under_load(&equal, &rolling(20.0), 206e3);
    let forces = unequal.forces(&motion, &LEVEL);
    for (side, deeper_m) in [(0, -50e-6), (1, 50e-6)] {
        let moved = Motion {
            vertical_m: motion.vertical_m + deeper_m,
            ..motion
        };
        let expected = &equal.forces(&moved, &LEVEL).wheels[side];
        let found = &forces.wheels[side];
        assert!(
            (found.force_n[2] / expected.force_n[2] - 1.0).abs() < 2e-4,
            "{found:?} {expected:?}"
        );
        let [found, expected] =
            [found, expected].map(|wheel| wheel.loaded_patches().next().unwrap().rolling_radius_m);
        assert!(
            (found - expected - deeper_m).abs() < 1e-7,
            "{found} {expected}"
        );
    }
    // The larger right wheel drives forward and the smaller left wheel brakes, so the nose turns left.
    assert!(forces.wheels[1].force_n[0] > forces.wheels[0].force_n[0] + 1e3);
    assert!(forces.moment_n_m[2] < 0.0);
}

#[test]
fn rolling_a_rail_changes_its_inclination() {
    // A rail at 1:40, rolled to 1:32.
    let steeper = 1.0 / 32.0;
    let roll = f64::atan(steeper) - 0.025_f64.atan();
    let laid = |inclination| of(Installation::default().with_inclination(inclination));
    let (upright, inclined) = (laid(0.025), laid(steeper));
    // Finds the middle of the head, where the tangent has the inclination. The rail rolls about its top.
    let middle = |rail: &Profile, inclination: f64| {
        let points = rail.points();
        let i = points.partition_point(|p| p.angle_rad < -inclination.atan());
        let (p, q) = (&points[i - 1], &points[i]);
        let t = (-inclination.atan() - p.angle_rad) / (q.angle_rad - p.angle_rad);
        [p.y_m + t * (q.y_m - p.y_m), p.z_m + t * (q.z_m - p.z_m)]
    };
    let [y, z] = middle(upright.pair().rail(), 0.025);
    let arm = y - upright.pair().rail_top_m();
    // The left side of the right rail moves down.
    let (sin, cos) = (-roll).sin_cos();
    let turned = [
        upright.pair().rail_top_m() + arm * cos - z * sin,
        arm * sin + z * cos,
    ];
    let target = middle(inclined.pair().rail(), steeper);
    let right = RailDisplacement {
        lateral_m: target[0] - turned[0],
        vertical_m: target[1] - turned[1],
        roll_rad: -roll,
        ..RailDisplacement::default()
    };
    let left = RailDisplacement {
        lateral_m: -right.lateral_m,
        roll_rad: roll,
        ..right
    };
    let (rolled, laid) = (
        contact([Arc::clone(&upright), upright]),
        contact([Arc::clone(&inclined), inclined]),
    );
    for (lateral_m, yaw_rad) in [(0.0, 0.0), (2e-3, 3e-3), (-4e-3, -2e-3), (5.5e-3, 6e-3)] {
        let motion = Motion {
            lateral_m,
            yaw_rad,
            ..rolling(20.0)
        };
        let motion = at_height_under_load(&laid, &motion, 206e3);
        let expected = laid.forces(&motion, &LEVEL);
        let found = rolled.forces(&motion, &[left, right]);
        for k in 0..3 {
            assert!(
                (found.force_n[k] - expected.force_n[k]).abs() < 2e-3 * 206e3,
                "{lateral_m}: {found:?} {expected:?}"
            );
            assert!(
                (found.moment_n_m[k] - expected.moment_n_m[k]).abs() < 2e-3 * 206e3,
                "{lateral_m}: {found:?} {expected:?}"
            );
        }
    }
}

#[test]
fn a_rolling_rail_carries_the_contact_along() {
    // A rail that rolls about its top lifts a contact away from the top, which changes the normal damping force.
    let damped = WheelsetContact::new(tables(), ShenHedrickElkins, Friction::default())
        .and_then(|contact| contact.with_normal_damping(10.0))
        .unwrap();
    let motion = at_height_under_load(&damped, &rolling(20.0), 206e3);
    let at_rest = damped.forces(&motion, &LEVEL).wheels[1];
    let patch = at_rest.loaded_patches().next().unwrap();
    let beside_top = patch.position_m[1] - geometry().pair().rail_top_m();
    let rate = 0.5;
    let rail = RailDisplacement {
        roll_rate_rad_per_s: rate,
        ..RailDisplacement::default()
    };
    let turning = damped.forces(&motion, &[LEVEL[0], rail]).wheels[1];
    let load = turning.loaded_patches().next().unwrap().load_n;
    let expected = 1.0 - 10.0 * rate * beside_top;
    assert!(
        (load / patch.load_n / expected - 1.0).abs() < 1e-3,
        "{load} {expected}"
    );
}

#[test]
fn normal_damping_is_that_of_hunt_and_crossley_and_never_pulls() {
    let plain = WheelsetContact::new(tables(), ShenHedrickElkins, Friction::default()).unwrap();
    let damped = plain.clone().with_normal_damping(3.0).unwrap();
    let motion = at_height_under_load(&plain, &rolling(20.0), 206e3);
    let load = |contact: &WheelsetContact<_>, vertical_velocity_m_per_s: f64| {
        let motion = Motion {
            vertical_velocity_m_per_s,
            ..motion
        };
        let forces = contact.forces(&motion, &LEVEL);
        let patch = *forces.wheels[1].loaded_patches().next()?;
        Some((patch.load_n, patch.contact_angle_rad()))
    };
    let (still, angle) = load(&plain, 0.0).unwrap();
    assert_eq!(load(&damped, 0.0).unwrap().0, still);
    for velocity in [-0.2, -0.01, 0.05, 0.3] {
        assert_eq!(load(&plain, velocity).unwrap().0, still);
        let (found, _) = load(&damped, velocity).unwrap();
        let expected = still * (1.0 + 3.0 * velocity * angle.cos());
        assert!((found / expected - 1.0).abs() < 1e-9, "{found} {expected}");
    }
    // If the surfaces separate faster than 1/3 m/s, the rail carries no load, but does not pull either.
    assert_eq!(load(&damped, -0.5), None);
    let apart = Motion {
        vertical_velocity_m_per_s: -0.5,
        ..motion
    };
    assert_eq!(damped.forces(&apart, &LEVEL).force_n, [0.0; 3]);
}

#[test]
fn a_different_left_rail_changes_only_the_left_wheel() {
    // A left rail without inclination touches the wheel elsewhere; the right side does not change.
    let other = of(Installation::default().with_inclination(0.0));
    let usual = Arc::new(geometry().clone());
    let both = contact([Arc::clone(&usual), Arc::clone(&usual)]);
    let mixed = contact([other, usual]);
    let motion = at_height_under_load(&both, &rolling(20.0), 206e3);
    let (both, mixed) = (both.forces(&motion, &LEVEL), mixed.forces(&motion, &LEVEL));
    assert_eq!(both.wheels[1], mixed.wheels[1]);
    let place =
        |forces: &WheelsetForces| forces.wheels[0].loaded_patches().next().unwrap().wheel_y_m;
    assert!((place(&both) - place(&mixed)).abs() > 2e-3);
}

#[test]
fn forces_are_blended_where_profiles_change_along_the_track() {
    let worn: Vec<[f64; 2]> = uic60::profile()
        .points()
        .iter()
        .map(|p| [p.y_m, p.z_m + 0.5e-3 * (-(p.y_m / 8e-3).powi(2)).exp()])
        .collect();
    let worn = Profile::through("worn", &worn, 0.0).unwrap();
    let wheel = geometry().pair().wheel().clone();
    let pair = Pair::new(wheel, &worn, Installation::default()).unwrap();
    let worn = Arc::new(ContactGeometry::new(pair, Steel::default()).unwrap());
    let new = Arc::new(geometry().clone());
    let (new, worn) = (
        contact([Arc::clone(&new), new]),
        contact([Arc::clone(&worn), worn]),
    );
    let motion = at_height_under_load(&new, &rolling(20.0), 206e3);
    let (from, to) = (new.forces(&motion, &LEVEL), worn.forces(&motion, &LEVEL));
    let change = from.force_n[2] - to.force_n[2];
    assert!(change.abs() > 5e3, "{change}");
    assert_eq!(from.blended(&to, 0.0), from);
    assert_eq!(from.blended(&to, 1.0), to);
    let quarter = from.blended(&to, 0.25);
    for k in 0..3 {
        let expected = 0.75 * from.force_n[k] + 0.25 * to.force_n[k];
        assert!((quarter.force_n[k] - expected).abs() < 1e-6);
    }
    assert_eq!(quarter.wheels[0].patches, from.wheels[0].patches);
    assert_eq!(quarter.status, Status::Rolling);
}
