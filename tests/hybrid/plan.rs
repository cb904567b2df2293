//! The delay that a position bears, against closed forms and against the roots of the delay equation.

use std::f64::consts::{PI, TAU};

use dashpot_hybrid::plan::{
    Complex, CriticalDelay, LoopStability, PlanError, PlantWithoutDamper, critical_delay, stability,
};
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;

use crate::delay_equation::System;

impl System {
    pub fn plant(&self) -> PlantWithoutDamper {
        let (a, b, c) = (self.a.clone(), self.b.clone(), self.c.clone());
        PlantWithoutDamper::new(a, b, c, self.d, self.k).unwrap()
    }
}

/// A mass of `m` on a spring of `spring` and a damper of `damping`, and a damper `d` with a stiffness `k`.
fn oscillator(m: f64, damping: f64, spring: f64, d: f64, k: f64) -> System {
    System {
        a: DMatrix::from_row_slice(2, 2, &[-damping / m, -spring / m, 1.0, 0.0]),
        b: DVector::from_vec(vec![1.0 / m, 0.0]),
        c: DVector::from_vec(vec![0.0, 1.0]),
        d,
        k,
        actuator: None,
    }
}

fn critical(system: &System) -> CriticalDelay {
    critical_delay(&system.plant()).unwrap().unwrap()
}

/// Delay after which the damper alone takes the oscillation along: its force at the higher frequency at which
/// `c omega = |k - m omega^2|` is a quarter of a period late.
#[test]
fn a_delayed_dashpot_on_an_undamped_oscillator_is_critical_at_a_quarter_period() {
    for (m, spring, d) in [(1.0_f64, 100.0, 3.0), (70.0, 5.0, 0.1), (0.02, 4e3, 90.0)] {
        let omega = (d + (d * d + 4.0 * m * spring).sqrt()) / (2.0 * m);
        let found = critical(&oscillator(m, 0.0, spring, d, 1e8 * d * omega));
        assert!(
            (found.frequency_hz / (omega / TAU) - 1.0).abs() < 1e-7,
            "{found:?}"
        );
        assert!(
            (found.delay_s / (0.5 * PI / omega) - 1.0).abs() < 1e-7,
            "{found:?}"
        );
    }
}

/// A dashpot that is stiff against its mounts is their spring. `(K - m omega^2)^2 + (c omega)^2 = k^2` is quadratic in
/// `omega^2`; a force on the mass with the phase `pi - arg(...)`, late.
#[test]
fn a_delayed_spring_is_critical_where_its_closed_form_says() {
    let (m, damping, spring, k) = (2.0, 3.0, 300.0, 120.0);
    let found = critical(&oscillator(m, damping, spring, 1e8, k));
    let (half, constant) = (
        (2.0 * m * spring - damping * damping) / (2.0 * m * m),
        (spring * spring - k * k) / (m * m),
    );
    let root = (half * half - constant).sqrt();
    let delays = [half - root, half + root].map(|square: f64| {
        let omega = square.sqrt();
        let without = Complex::new(spring - m * square, damping * omega);
        let phase = (-(without.inv() * k)).arg().rem_euclid(TAU);
        (phase / omega, omega)
    });
    let [first, second] = delays;
    let (delay_s, omega) = if first.0 < second.0 { first } else { second };
    assert!(
        (found.delay_s / delay_s - 1.0).abs() < 1e-6,
        "{found:?} {delays:?}"
    );
    assert!(
        (found.frequency_hz * TAU / omega - 1.0).abs() < 1e-6,
        "{found:?}"
    );
}

/// A dashpot in soft mounts: the frequencies follow from a cubic in `omega^2`, here found by halving.
#[test]
fn a_damper_in_soft_mounts_is_critical_where_its_cubic_says() {
    let (m, spring, d, k) = (1.0, 100.0, 8.0, 60.0);
    let found = critical(&oscillator(m, 0.0, spring, d, k));
    let excess = |omega: f64| {
        let square = omega * omega;
        let without = (spring - m * square).powi(2) * (k * k + d * d * square);
        k * k * d * d * square - without
    };
    // Above the oscillator's own 10 rad/s, at which the loop is infinite.
    let (mut low, mut high) = (10.0, 100.0);
    while high - low > 1e-13 * high {
        let middle = 0.5 * (low + high);
        if excess(middle) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    let damper = Complex::new(0.0, k * d * low) / Complex::new(k, d * low);
    let delay_s = (-damper / (spring - m * low * low)).arg().rem_euclid(TAU) / low;
    assert!(
        (found.frequency_hz * TAU / low - 1.0).abs() < 1e-10,
        "{found:?} {low}"
    );
    assert!(
        (found.delay_s / delay_s - 1.0).abs() < 1e-10,
        "{found:?} {delay_s}"
    );
}

/// A damper weaker than what is in parallel with it never feeds energy into the motion.
#[test]
fn a_weak_damper_bears_any_delay() {
    for (damping, d) in [(3.0, 2.9), (5.0, 1e-3)] {
        let system = oscillator(1.0, damping, 1000.0, d, 1e7);
        assert_eq!(critical_delay(&system.plant()), Ok(None));
        for delay_s in [0.01, 0.05, 0.2, 1.0] {
            assert!(system.rightmost(delay_s) < 0.0);
        }
    }
    let stronger = oscillator(1.0, 3.0, 1000.0, 3.2, 1e7);
    assert!(critical_delay(&stronger.plant()).unwrap().is_some());
}

/// With equal dampers the loop touches 1, at the frequency of the oscillator; mounts make it slightly less than 1,
/// which is resolved until rounding hides it.
#[test]
fn a_loop_that_touches_one_is_refused() {
    let touching = |k: f64| critical_delay(&oscillator(1.0, 3.0, 1000.0, 3.0, k).plant());
    assert!(
        matches!(touching(1e7), Err(PlanError::Touches { .. })),
        "{:?}",
        touching(1e7)
    );
    assert_eq!(touching(1e5), Ok(None));
}

#[test]
fn a_vehicle_that_needs_no_delay_to_be_unstable_is_refused() {
    let growing = oscillator(1.0, -5.0, 1000.0, 2.0, 1e7).plant();
    let error = critical_delay(&growing).unwrap_err();
    assert!(
        matches!(error, PlanError::UnstableWithoutDelay { .. }),
        "{error}"
    );
    assert!(error.to_string().contains("unstable at 5.02"), "{error}");
    assert_eq!(
        stability(&growing, |_| Complex::from(1.0)),
        Ok(LoopStability::Unstable { roots: 2 })
    );
    // Four times the force is stable.
    assert!(matches!(
        stability(&growing, |_| Complex::from(4.0)),
        Ok(LoopStability::Stable { .. })
    ));
    // A second mass that nothing damps.
    let mut apart = oscillator(1.0, 0.0, 1000.0, 2.0, 1e7);
    let mut a = DMatrix::zeros(4, 4);
    a.view_mut((0, 0), (2, 2)).copy_from(&apart.a);
    a[(2, 3)] = -50.0;
    a[(3, 2)] = 1.0;
    apart.a = a;
    apart.b = apart.b.resize_vertically(4, 0.0);
    apart.c = apart.c.resize_vertically(4, 0.0);
    assert!(matches!(
        critical_delay(&apart.plant()),
        Err(PlanError::Undamped { .. })
    ));
}

#[test]
fn a_factor_that_cannot_be_followed_is_refused() {
    let plant = oscillator(1.0, 1.0, 100.0, 5.0, 1e4).plant();
    assert!(matches!(
        stability(&plant, |_| Complex::from(f64::NAN)),
        Err(PlanError::LoopFactor { .. })
    ));
    assert!(matches!(
        stability(&plant, |s| s * s * s),
        Err(PlanError::LoopFactorGrows { .. })
    ));
    assert!(matches!(
        stability(&plant, |s| (-s * 1e9).exp()),
        Err(PlanError::LoopFactorVaries { .. })
    ));
}

/// Masses in a chain between two walls, with a damper between two of them or to a wall.
fn chain() -> impl Strategy<Value = System> {
    (1_usize..5)
        .prop_flat_map(|n| {
            let value = |min: f64, max: f64| (min.ln()..max.ln()).prop_map(f64::exp);
            (
                prop::collection::vec(value(0.1, 10.0), n),
                prop::collection::vec((value(1.0, 1e4), value(1e-3, 10.0)), n + 1),
                (0..n, 0..=n),
                (value(0.1, 300.0), value(10.0, 1e6)),
            )
        })
        .prop_map(|(masses, links, (first, second), (d, k))| {
            let n = masses.len();
            let mut a = DMatrix::zeros(2 * n, 2 * n);
            for i in 0..n {
                a[(n + i, i)] = 1.0;
                for (other, (spring, damping)) in [i.wrapping_sub(1), i + 1].iter().zip(&links[i..])
                {
                    a[(i, i)] -= damping / masses[i];
                    a[(i, n + i)] -= spring / masses[i];
                    if *other < n {
                        a[(i, *other)] += damping / masses[i];
                        a[(i, n + other)] += spring / masses[i];
                    }
                }
            }
            let [mut b, mut c] = [DVector::zeros(2 * n), DVector::zeros(2 * n)];
            b[first] = 1.0 / masses[first];
            c[n + first] = 1.0;
            if second < n && second != first {
                b[second] = -1.0 / masses[second];
                c[n + second] = -1.0;
            }
            let actuator = None;
            System {
                a,
                b,
                c,
                d,
                k,
                actuator,
            }
        })
}

/// Any matrix, input and output.
fn any_system() -> impl Strategy<Value = System> {
    (1_usize..6).prop_flat_map(|n| {
        (
            prop::collection::vec(-3.0..3.0, n * n),
            prop::collection::vec(-2.0..2.0, 2 * n),
            (0.0..6.0, 0.1..10.0, 0.1..10.0),
        )
            .prop_map(move |(entries, vectors, (shift, d, k))| System {
                a: DMatrix::from_vec(n, n, entries) - DMatrix::identity(n, n) * shift,
                b: DVector::from_column_slice(&vectors[..n]),
                c: DVector::from_column_slice(&vectors[n..]),
                d,
                k,
                actuator: None,
            })
    })
}

/// A critical delay is one in the delay equation.
pub fn check(system: &System, found: Option<CriticalDelay>) {
    let Some(CriticalDelay { delay_s, .. }) = found else {
        for delay_s in [1e-3, 0.03, 0.3] {
            let rightmost = system.rightmost(delay_s);
            assert!(
                rightmost < 0.0,
                "never, but {rightmost} at {delay_s} s of {system:?}"
            );
        }
        return;
    };
    for part in [0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 0.999] {
        let rightmost = system.rightmost(part * delay_s);
        assert!(
            rightmost < 0.0,
            "{rightmost} at {part} of {delay_s} s of {system:?}"
        );
    }
    let rightmost = system.rightmost(1.001 * delay_s);
    assert!(
        rightmost > 0.0,
        "{rightmost} above {delay_s} s of {system:?}"
    );
}

/// Unstable roots of the delay equation, and the distance of the rightmost from the axis.
fn unstable(system: &System, delay_s: f64) -> (usize, f64) {
    let roots = system.roots(delay_s);
    let distances = roots
        .iter()
        .map(|root| root.re.abs() / root.norm().max(1.0));
    let nearest = distances.fold(f64::INFINITY, f64::min);
    (roots.iter().filter(|root| root.re > 0.0).count(), nearest)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn the_roots_of_a_chain_cross_the_axis_at_its_critical_delay(system in chain()) {
        check(&system, critical_delay(&system.plant())?);
    }

    #[test]
    fn the_roots_of_any_system_cross_the_axis_at_its_critical_delay(system in any_system()) {
        match critical_delay(&system.plant()) {
            Ok(found) => check(&system, found),
            Err(PlanError::UnstableWithoutDelay { .. }) => {
                prop_assert!(system.rightmost(0.0) > 0.0);
            }
            Err(error) => prop_assert!(false, "{error}"),
        }
    }

    /// The count of roots is that of the eigenvalues without delay, and that of the delay equation with one.
    #[test]
    fn unstable_roots_are_counted(
        system in any_system(),
        omega in 0.5..50.0_f64,
        damping in 0.2..1.5_f64,
        delay_s in prop_oneof![Just(0.0), 0.01..0.3_f64],
    ) {
        let system = System { actuator: Some([omega, damping]), ..system };
        let (expected, nearest) = unstable(&system, delay_s);
        prop_assume!(nearest > 1e-6);
        let factor = |s: Complex<f64>| {
            let second = s * s + s * (2.0 * damping * omega) + omega * omega;
            (-s * delay_s).exp() * (omega * omega) / second
        };
        match stability(&system.plant(), factor)? {
            LoopStability::Unstable { roots } => prop_assert_eq!(roots, expected),
            LoopStability::Stable { margin } => {
                prop_assert_eq!(expected, 0);
                let Some(margin) = margin else {
                    prop_assert!(system.rightmost(delay_s + 0.3) < 0.0);
                    return Ok(());
                };
                for part in [0.3, 0.7, 0.999] {
                    prop_assert!(system.rightmost(delay_s + part * margin.delay_s) < 0.0);
                }
                prop_assert!(system.rightmost(delay_s + 1.001 * margin.delay_s) > 0.0);
            }
        }
    }
}
