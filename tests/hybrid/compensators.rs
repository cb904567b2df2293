//! Compensators before an actuator of second order with a delay, whose inverse is known in closed form.

use dashpot_core::hybrid::{
    AdaptiveSettings, AdaptiveTimeSeries, Compensator, InverseModel, Motion, MotionFilter,
    PolynomialExtrapolation, Uncompensated,
};

const STEP_S: f64 = 1e-3;
const OMEGA: f64 = std::f64::consts::TAU * 20.0;
const DAMPING: f64 = 0.7;
const DELAY_TICKS: usize = 4;

/// Coefficients of `(1 + 2 D s/omega + s^2/omega^2) exp(tau s)`, to the third power; the command is held for a tick,
/// which adds half a tick to the delay.
fn inverse() -> [f32; 4] {
    let tau = (DELAY_TICKS as f64 + 0.5) * STEP_S;
    let (a, b) = (2.0 * DAMPING / OMEGA, 1.0 / (OMEGA * OMEGA));
    let third = tau.powi(3) / 6.0 + a * tau * tau / 2.0 + b * tau;
    [1.0, a + tau, b + a * tau + tau * tau / 2.0, third].map(|c| c as f32)
}

/// An actuator in motion, in fine steps.
#[derive(Default)]
struct Actuator {
    past_m: [f64; DELAY_TICKS],
    displacement_m: f64,
    velocity_m_per_s: f64,
}

impl Actuator {
    fn step(&mut self, command_m: f64) {
        self.past_m.rotate_right(1);
        let late_m = std::mem::replace(&mut self.past_m[0], command_m);
        for _ in 0..100 {
            let (h, to_go) = (STEP_S / 100.0, late_m - self.displacement_m);
            let acceleration =
                OMEGA * OMEGA * to_go - 2.0 * DAMPING * OMEGA * self.velocity_m_per_s;
            self.velocity_m_per_s += h * acceleration;
            self.displacement_m += h * self.velocity_m_per_s;
        }
    }
}

/// A motion of two frequencies.
fn desired(t: f64) -> Motion {
    let parts = [(0.004, 7.0), (0.001, 25.0)];
    let sum = |of: fn(f64, f64) -> f64| -> f32 {
        parts.iter().map(|(a, w)| a * of(*w, w * t)).sum::<f64>() as f32
    };
    Motion {
        displacement_m: sum(|_, phase| phase.sin()),
        velocity_m_per_s: sum(|w, phase| w * phase.cos()),
        acceleration_m_per_s2: sum(|w, phase| -w * w * phase.sin()),
        jerk_m_per_s3: sum(|w, phase| -w * w * w * phase.cos()),
    }
}

/// Root mean square of the error relative to the motion, from 5 to 10 s.
fn relative_error(compensator: &mut impl Compensator, motion: impl FnMut(f64) -> Motion) -> f64 {
    let mut motion = motion;
    let mut actuator = Actuator::default();
    let (mut error, mut size) = (0.0, 0.0);
    for tick in 0..10_000 {
        let t = STEP_S * f64::from(tick);
        let desired = motion(t);
        let command = compensator.command_m(&desired);
        compensator.observe(command, actuator.displacement_m as f32);
        if tick >= 5000 {
            error += (actuator.displacement_m - f64::from(desired.displacement_m)).powi(2);
            size += f64::from(desired.displacement_m).powi(2);
        }
        actuator.step(f64::from(command));
    }
    (error / size).sqrt()
}

#[test]
fn each_compensator_reduces_the_error_of_a_known_actuator() {
    let none = relative_error(&mut Uncompensated, desired);
    assert!(none > 0.1, "{none}");
    let mut known = InverseModel::new(inverse()).unwrap();
    let exact = relative_error(&mut known, desired);
    assert!(exact < 0.01 * none, "{exact} of {none}");
    let mut from_samples = MotionFilter::new(60.0, STEP_S as f32).unwrap();
    let filtered = relative_error(&mut known, |t| from_samples.push(desired(t).displacement_m));
    assert!(filtered < 0.05 * none, "{filtered} of {none}");
    let delay_s = inverse()[1];
    let mut polynomial = PolynomialExtrapolation::new(3, delay_s, STEP_S as f32).unwrap();
    let extrapolated = relative_error(&mut polynomial, desired);
    assert!(extrapolated < 0.15 * none, "{extrapolated} of {none}");
}

/// An adaptive compensator that starts from half the delay learns the rest.
#[test]
fn an_adaptive_compensator_learns_the_actuator() {
    let half = [1.0, 0.5 * inverse()[1], 0.0, 0.0];
    let settings = AdaptiveSettings::new(half, inverse()[1]);
    let mut adaptive = AdaptiveTimeSeries::new(&settings, STEP_S as f32).unwrap();
    let learnt = relative_error(&mut adaptive, desired);
    let fixed = relative_error(&mut InverseModel::new(half).unwrap(), desired);
    assert!(learnt < 0.05 * fixed, "{learnt} of {fixed}");
    for (index, coefficient) in adaptive.coefficients().into_iter().enumerate() {
        let change = (coefficient - half[index]).abs();
        assert!(
            change <= settings.largest_change[index],
            "coefficient {index}"
        );
    }
}

/// Sensor noise alone teaches nothing, nor does a steady displacement.
#[test]
fn a_damper_that_hardly_moves_freezes_the_coefficients() {
    let settings = AdaptiveSettings::new(inverse(), 0.005);
    let mut adaptive = AdaptiveTimeSeries::new(&settings, STEP_S as f32).unwrap();
    adaptive.rest_at(0.02);
    for tick in 0..5000_u32 {
        let noise = 5e-6 * (tick.wrapping_mul(2_654_435_761) as f32 / u32::MAX as f32 - 0.5);
        adaptive.observe(0.02, 0.02 + noise);
    }
    assert!(adaptive.is_frozen());
    assert_eq!(adaptive.coefficients(), settings.nominal);
}
