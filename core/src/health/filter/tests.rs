//! The factored filter against the textbook equations of a Kalman filter with a dense covariance in double precision.

use super::{FLOW, FRICTION, Filter, POSITION, Prepared, STATES, UPPER, ZERO, index};

type Matrix = [[f64; STATES]; STATES];

/// A filter whose states are all correlated.
fn correlated() -> Filter {
    let mut filter = Filter::new(
        [0.5, 1.25, -0.75, 0.375, 2.0, -3.0, 1.5],
        [0.5, 1.5, 0.75, 2.0, 1.25, 0.625, 3.0],
    );
    for (number, entry) in filter.upper.iter_mut().enumerate() {
        *entry = 0.125 * ((5 * number) % 13) as f32 - 0.75;
    }
    filter
}

/// `P = U D U'`.
fn covariance(filter: &Filter) -> Matrix {
    let mut upper = [[0.0; STATES]; STATES];
    for (row, entries) in upper.iter_mut().enumerate() {
        entries[row] = 1.0;
        for (column, entry) in entries.iter_mut().enumerate().skip(row + 1) {
            *entry = f64::from(filter.upper[index(row, column)]);
        }
    }
    let diagonal = filter.diagonal.map(f64::from);
    upper.map(|a| upper.map(|b| (0..STATES).map(|k| a[k] * diagonal[k] * b[k]).sum()))
}

/// Product of a symmetric matrix and a vector.
fn times(matrix: &Matrix, vector: &[f64; STATES]) -> [f64; STATES] {
    matrix.map(|row| dot(&row, vector))
}

fn dot(a: &[f64; STATES], b: &[f64; STATES]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[track_caller]
fn assert_near(found: f64, expected: f64) {
    let error = (found - expected).abs();
    assert!(
        error <= 1e-5 * expected.abs().max(1.0),
        "{found} is not {expected}"
    );
}

#[track_caller]
fn assert_matrices_near(found: &Matrix, expected: &Matrix) {
    for (found, expected) in found.as_flattened().iter().zip(expected.as_flattened()) {
        assert_near(*found, *expected);
    }
}

#[test]
fn every_pair_of_states_has_its_own_entry() {
    let mut next = 0;
    for row in 0..STATES {
        for column in row + 1..STATES {
            assert_eq!(index(row, column), next);
            next += 1;
        }
    }
    assert_eq!(next, UPPER);
}

#[test]
fn a_variance_is_a_diagonal_entry_of_the_covariance() {
    let filter = correlated();
    let expected = covariance(&filter);
    for (row, entries) in expected.iter().enumerate() {
        assert_near(f64::from(filter.variance(row)), entries[row]);
    }
}

#[test]
fn travel_transforms_state_and_covariance_as_a_linear_motion() {
    let mut filter = correlated();
    let (travel, zero, friction) = (0.75, 0.25, -0.5);
    // x' = x + travel flow - zero_slip zero - friction_slip friction; the other states remain.
    let mut transition = [[0.0; STATES]; STATES];
    for (row, entries) in transition.iter_mut().enumerate() {
        entries[row] = 1.0;
    }
    transition[POSITION][FLOW] = f64::from(travel);
    transition[POSITION][ZERO] = -f64::from(zero);
    transition[POSITION][FRICTION] = -f64::from(friction);
    let before = covariance(&filter);
    let mut expected = transition.map(|a| transition.map(|b| dot(&a, &times(&before, &b))));
    expected[POSITION][POSITION] += 0.125;

    filter.travel(travel, [zero, friction], 0.125);
    assert_matrices_near(&covariance(&filter), &expected);
    // The caller corrects the position for offset and friction.
    assert_eq!(
        filter.state,
        [0.5 + 0.75 * 1.25, 1.25, -0.75, 0.375, 2.0, -3.0, 1.5]
    );
}

#[test]
fn a_forgotten_position_is_uncorrelated_and_leaves_the_parameters_alone() {
    let mut filter = correlated();
    let mut expected = covariance(&filter);
    for row in &mut expected {
        row[POSITION] = 0.0;
    }
    expected[POSITION] = [0.0; STATES];
    expected[POSITION][POSITION] = 4.0;
    filter.forget_position(4.0);
    assert_matrices_near(&covariance(&filter), &expected);
}

#[test]
fn an_update_is_that_of_a_kalman_filter() {
    let mut filter = correlated();
    let parts = [0.5, -1.0, 1.0, 0.25, -0.5, 0.75];
    let mut h = [1.0; STATES];
    for (h, part) in h.iter_mut().skip(1).zip(parts) {
        *h = f64::from(part);
    }
    let noise = 0.375;
    let mut prepared = Prepared {
        measured: 2.5,
        parts,
        ..Prepared::NONE
    };
    let before = covariance(&filter);
    let gain = times(&before, &h);
    let variance = dot(&h, &gain) + noise;
    // The measurement is already corrected for force offset and friction, so only five states predict it.
    let state = filter.state.map(f64::from);
    let predicted: f64 = (0..ZERO).map(|row| h[row] * state[row]).sum();
    let innovation = 2.5 - predicted;

    filter.prepare(&mut prepared, noise as f32);
    assert_near(f64::from(prepared.innovation), innovation);
    assert_near(f64::from(prepared.variance), variance);
    let information = variance - noise - f64::from(filter.diagonal[POSITION]);
    assert_near(f64::from(prepared.information), information);

    filter.update_first(&mut prepared);
    filter.update_second(&mut prepared);
    for (row, found) in filter.state.iter().enumerate() {
        assert_near(
            f64::from(*found),
            state[row] + gain[row] * innovation / variance,
        );
    }
    let mut expected = before;
    for (row, entries) in expected.iter_mut().enumerate() {
        for (column, entry) in entries.iter_mut().enumerate() {
            *entry -= gain[row] * gain[column] / variance;
        }
    }
    assert_matrices_near(&covariance(&filter), &expected);
    assert!(filter.diagonal.iter().all(|number| *number > 0.0));
}
