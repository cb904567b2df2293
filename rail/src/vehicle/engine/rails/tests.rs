//! Motion and equations of the rails.

use nalgebra::{DMatrix, DVector};

use super::*;

#[test]
fn a_rail_moves_in_addition_to_its_irregularity() {
    let irregularity = RailDisplacement {
        lateral_m: 1.0,
        vertical_m: 2.0,
        lateral_velocity_m_per_s: 3.0,
        vertical_velocity_m_per_s: 4.0,
        roll_rad: 5.0,
        roll_rate_rad_per_s: 6.0,
        yaw_rad: 8.0,
        friction_ratio: 0.7,
    };
    let mut rails = [irregularity; 2];
    let (q, v) = ([0.1, 0.2, 0.3, 0.4, 0.0], [0.5, 0.6, 0.7, 0.8, 0.0]);
    displace(&mut rails, &q, &v);
    for (rail, [y, z, vy, vz]) in rails
        .iter()
        .zip([[0.1, 0.2, 0.5, 0.6], [0.3, 0.4, 0.7, 0.8]])
    {
        let expected = RailDisplacement {
            lateral_m: 1.0 + y,
            vertical_m: 2.0 + z,
            lateral_velocity_m_per_s: 3.0 + vy,
            vertical_velocity_m_per_s: 4.0 + vz,
            ..irregularity
        };
        assert_eq!(*rail, expected);
    }
}

/// At standstill the supports carry the wheelset, so the rails stay where they are.
#[test]
fn only_a_change_of_the_wheel_forces_moves_the_rails() {
    let standing = [[100.0, 2e3, -50e3], [-100.0, -2.5e3, -51e3]];
    let mut contact = WheelsetForces::default();
    for (wheel, force_n) in contact.wheels.iter_mut().zip(standing) {
        wheel.force_n = force_n;
    }
    let mut forces = [0.0; N];
    push(&contact, &standing_n(&standing), &mut forces);
    assert_eq!(forces, [0.0; N]);
    // The right rail pushes its wheel harder to the left and upward.
    contact.wheels[1].force_n = [0.0, -3e3, -60e3];
    push(&contact, &standing_n(&standing), &mut forces);
    assert_eq!(forces, [0.0, 0.0, 500.0, 9e3, 0.0]);
}

#[test]
fn rails_follow_the_bodies_in_the_equations() {
    let support = RailSupport::new(60.0)
        .with_lateral(2.0, 3.0)
        .with_lateral_mass(50.0)
        .with_vertical(4.0, 5.0);
    let bodies = 3 * N;
    let mut linear = Linear {
        inertia: DVector::from_element(bodies, 7.0),
        stiffness: DMatrix::from_element(bodies, bodies, 8.0),
        damping: DMatrix::from_element(bodies, bodies, 9.0),
        series: Vec::new(),
    };
    support.append(2, &mut linear);
    let Linear {
        inertia,
        stiffness,
        damping,
        ..
    } = linear;
    assert_eq!((inertia.len(), stiffness.shape()), (25, (25, 25)));
    for wheelset in 0..2 {
        let first = bodies + N * wheelset;
        let (lateral, vertical) = ([50.0, 2.0, 3.0], [60.0, 4.0, 5.0]);
        for (i, expected) in [lateral, vertical, lateral, vertical]
            .into_iter()
            .enumerate()
        {
            let at = (first + i, first + i);
            assert_eq!([inertia[first + i], stiffness[at], damping[at]], expected);
        }
        // The fifth coordinate has an inertia, so that the equations can be solved.
        let unused = first + 4;
        assert_eq!((inertia[unused], stiffness[(unused, unused)]), (1.0, 0.0));
    }
    assert!(stiffness.columns(bodies, N).rows(0, bodies).amax() == 0.0);
    assert_eq!(stiffness[(bodies - 1, bodies - 1)], 8.0);
}
