//! Tests of the solver on equations with known solutions.

use super::*;
use crate::linear::Matrix;

/// Equations of two states with one event function.
struct Problem<R, J, E> {
    rates: R,
    jacobian: J,
    event: E,
}

impl<R, J, E> Equations for Problem<R, J, E>
where
    R: Fn(f64, &[f64]) -> [f64; 2],
    J: Fn(&[f64]) -> [[f64; 2]; 2],
    E: Fn(f64, &[f64]) -> f64,
{
    fn rates(&mut self, time: f64, state: &[f64], rates: &mut [f64]) {
        rates.copy_from_slice(&(self.rates)(time, state));
    }

    fn jacobian(&mut self, _time: f64, state: &[f64], jacobian: &mut Matrix) {
        for (row, entries) in (self.jacobian)(state).iter().enumerate() {
            jacobian.row_mut(row).copy_from_slice(entries);
        }
    }

    fn events(&mut self, time: f64, state: &[f64], values: &mut [f64]) {
        values[0] = (self.event)(time, state);
    }
}

fn solver(tableau: &'static Tableau, tolerance: f64) -> Esdirk {
    let tolerances = Tolerances {
        relative: tolerance,
        absolute: vec![tolerance; 2],
        min_length: 1e-15,
    };
    Esdirk::new(tableau, tolerances, 1)
}

/// Prothero and Robinson's equation `dx/dt = -rate (x - cos t) - sin t`, and a quadrature.
fn prothero_robinson(rate: f64) -> impl Equations {
    Problem {
        rates: move |t: f64, x: &[f64]| [-rate * (x[0] - t.cos()) - t.sin(), x[0]],
        jacobian: move |_: &[f64]| [[-rate, 0.0], [1.0, 0.0]],
        event: |_: f64, _: &[f64]| 1.0,
    }
}

fn run(solver: &mut Esdirk, equations: &mut impl Equations, end: f64) -> Vec<f64> {
    loop {
        match solver.step(equations, end).expect("a step") {
            StepEnd::Stop => return solver.state().to_vec(),
            StepEnd::Free => {}
            StepEnd::Event { .. } => unreachable!("no event"),
        }
    }
}

#[test]
fn a_stiff_solution_follows_the_tolerance() {
    let methods = [&ESDIRK3, &ESDIRK5];
    for (tableau, rate) in methods
        .iter()
        .flat_map(|m| [1.0, 1e3, 1e6].map(|rate| (*m, rate)))
    {
        for tolerance in [1e-6, 1e-9, 1e-12] {
            let mut equations = prothero_robinson(rate);
            let mut solver = solver(tableau, tolerance);
            solver.restart(&mut equations, 0.0, &[1.0, 0.0], 1e-4);
            let end = run(&mut solver, &mut equations, 2.0);
            assert_eq!(solver.time(), 2.0);
            let error = (end[0] - 2f64.cos()).abs().max((end[1] - 2f64.sin()).abs());
            // The tolerance bounds the estimated error of each step; a stiff equation reduces the order.
            let counts = solver.counts();
            let allowed = 50.0 * tolerance * counts.steps as f64;
            assert!(error < allowed, "{rate} {tolerance}: {error:e}, {counts:?}");
        }
    }
}

/// Without error control, halving the step length divides the error by two to the power of the order.
#[test]
fn the_orders_are_three_and_five() {
    let error = |tableau, steps: u32| {
        let mut equations = prothero_robinson(1.0);
        let mut solver = solver(tableau, 1e-14);
        let mut state = vec![1.0, 0.0];
        let length = 1.0 / f64::from(steps);
        for step in 0..steps {
            solver.restart(&mut equations, f64::from(step) * length, &state, length);
            assert!(solver.solve_stages(&mut equations, length, Guess::EarlierStages));
            state.copy_from_slice(&solver.stage);
        }
        (state[0] - 1f64.cos()).abs()
    };
    for (tableau, steps, expected) in [(&ESDIRK3, 20, 8.0), (&ESDIRK5, 8, 32.0)] {
        let ratio = error(tableau, steps) / error(tableau, 2 * steps);
        assert!((ratio / expected - 1.0).abs() < 0.1, "{ratio}");
    }
}

/// Runs a pendulum of period 2 pi, whose first state passes zero at pi/2, to the step that passes this event.
fn passed_event(solver: &mut Esdirk) -> (impl Equations + use<>, f64) {
    let mut equations = Problem {
        rates: |_: f64, x: &[f64]| [x[1], -x[0]],
        jacobian: |_: &[f64]| [[0.0, 1.0], [-1.0, 0.0]],
        event: |_: f64, x: &[f64]| x[0],
    };
    solver.restart(&mut equations, 0.0, &[1.0, 0.0], 1e-3);
    loop {
        match solver.step(&mut equations, 10.0).expect("a step") {
            StepEnd::Free => {}
            StepEnd::Event { time, index } => {
                assert_eq!(index, 0);
                return (equations, time);
            }
            StepEnd::Stop => unreachable!("the event comes first"),
        }
    }
}

/// The tolerance bounds the estimated error of each step, as a root mean square of relative and absolute parts.
fn allowed_error(solver: &Esdirk, tolerance: f64) -> f64 {
    4.0 * tolerance * solver.counts().steps as f64
}

#[test]
fn an_event_is_interpolated_to_the_tolerance() {
    for tolerance in [1e-6, 1e-9, 1e-12] {
        let mut solver = solver(&ESDIRK3, tolerance);
        let (_, time) = passed_event(&mut solver);
        let allowed = allowed_error(&solver, tolerance);
        let error = (time - std::f64::consts::FRAC_PI_2).abs();
        assert!(error < allowed, "{tolerance}: {error:e}");
        let mut state = [0.0; 2];
        solver.interpolate(time, &mut state);
        let past = -state[0];
        assert!(
            (0.0..1e-12).contains(&past) && (state[1] + 1.0).abs() < allowed,
            "{state:?}"
        );
    }
}

#[test]
fn a_repeated_step_ends_at_the_event() {
    for tolerance in [1e-6, 1e-9, 1e-12] {
        let mut solver = solver(&ESDIRK5, tolerance);
        let (mut equations, time) = passed_event(&mut solver);
        let steps = solver.counts().steps;
        let end = solver.end_at_event(&mut equations, (time, 0));
        let StepEnd::Event { time, index: 0 } = end else {
            panic!("{end:?}");
        };
        assert_eq!((solver.time(), solver.counts().steps), (time, steps));
        let allowed = allowed_error(&solver, tolerance);
        let error = (time - std::f64::consts::FRAC_PI_2).abs();
        assert!(error < allowed, "{tolerance}: {error:e}");
        let state = solver.state();
        assert!(
            state[0].abs() < 1e-13 && (state[1] + 1.0).abs() < allowed,
            "{state:?}"
        );
    }
}

/// The solution of `dx/dt = x^2` becomes infinite at time 1.
#[test]
fn a_solution_that_ends_is_an_error() {
    let mut equations = Problem {
        rates: |_: f64, x: &[f64]| [x[0] * x[0], 0.0],
        jacobian: |x: &[f64]| [[2.0 * x[0], 0.0], [0.0, 0.0]],
        event: |_: f64, _: &[f64]| 1.0,
    };
    let mut solver = solver(&ESDIRK5, 1e-9);
    solver.restart(&mut equations, 0.0, &[1.0, 0.0], 1e-3);
    let error = loop {
        match solver.step(&mut equations, 2.0) {
            Ok(end) => assert_eq!(end, StepEnd::Free),
            Err(error) => break error,
        }
    };
    assert!((error.time - 1.0).abs() < 1e-6, "{error}");
}

#[test]
fn rates_that_are_no_numbers_are_an_error() {
    let mut equations = Problem {
        rates: |_: f64, _: &[f64]| [f64::NAN, 0.0],
        jacobian: |_: &[f64]| [[0.0; 2]; 2],
        event: |_: f64, _: &[f64]| 1.0,
    };
    let mut solver = solver(&ESDIRK5, 1e-9);
    solver.restart(&mut equations, 0.0, &[1.0, 0.0], 1e-3);
    assert!(solver.step(&mut equations, 2.0).is_err());
}
