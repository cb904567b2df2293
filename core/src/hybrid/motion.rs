//! The motion at one tick, and a filter that estimates it from displacements.

use super::limits;
use crate::BuildError;

/// Displacement of the damper's ends at a tick, and its derivatives.
///
/// ```
/// use dashpot_core::hybrid::Motion;
///
/// let motion = Motion::at_rest(0.01);
/// assert_eq!(motion.series([1.0, 0.02, 0.0, 0.0]), 0.01);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Motion {
    /// Displacement (m), positive in extension.
    pub displacement_m: f32,
    /// Velocity (m/s).
    pub velocity_m_per_s: f32,
    /// Acceleration (m/s^2).
    pub acceleration_m_per_s2: f32,
    /// Jerk (m/s^3).
    pub jerk_m_per_s3: f32,
}

impl Motion {
    /// No motion at a displacement (m).
    pub const fn at_rest(displacement_m: f32) -> Self {
        Self {
            displacement_m,
            velocity_m_per_s: 0.0,
            acceleration_m_per_s2: 0.0,
            jerk_m_per_s3: 0.0,
        }
    }

    /// Returns `a0 x + a1 x' + a2 x'' + a3 x'''` (m); the coefficients are in s^0 to s^3.
    #[inline]
    pub fn series(&self, [a0, a1, a2, a3]: [f32; 4]) -> f32 {
        a0 * self.displacement_m
            + a1 * self.velocity_m_per_s
            + a2 * self.acceleration_m_per_s2
            + a3 * self.jerk_m_per_s3
    }

    /// True if all numbers are finite.
    pub fn is_finite(&self) -> bool {
        self.series([0.0; 4]) == 0.0
    }
}

/// Low-pass filters of first order in a chain, by the trapezoidal rule.
///
/// The difference between neighbouring stages is a derivative, so the chain gives the low-passed displacement and its
/// derivatives without dividing by the step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Chain<const STAGES: usize> {
    /// Memory of the trapezoidal integrators.
    memory: [f32; STAGES],
    /// `g/(1+g)` with `g` half the step times the pole.
    gain: f32,
}

impl<const STAGES: usize> Chain<STAGES> {
    /// A chain with the pole `pole_per_s` (rad/s), at rest at 0.
    pub(super) fn new(pole_per_s: f32, step_s: f32) -> Self {
        let g = 0.5 * pole_per_s * step_s;
        Self {
            memory: [0.0; STAGES],
            gain: g / (1.0 + g),
        }
    }

    /// Puts the chain at rest at a value.
    pub(super) fn rest_at(&mut self, value: f32) {
        self.memory = [value; STAGES];
    }

    /// Takes a value; returns those after each stage.
    #[inline]
    fn stages(&mut self, mut value: f32) -> [f32; STAGES] {
        let gain = self.gain;
        self.memory.each_mut().map(|memory| {
            let change = (value - *memory) * gain;
            value = *memory + change;
            *memory = value + change;
            value
        })
    }
}

impl Chain<1> {
    /// Takes a value; returns the low-passed value and its derivative divided by the pole.
    #[inline]
    pub(super) fn push(&mut self, x: f32) -> [f32; 2] {
        let [a] = self.stages(x);
        [a, x - a]
    }
}

impl Chain<3> {
    /// Takes a displacement `x`; returns the low-passed displacement and its first three derivatives, divided by the
    /// first three powers of the pole (all in m).
    #[inline]
    pub(super) fn push(&mut self, x: f32) -> [f32; 4] {
        let [a, b, c] = self.stages(x);
        let [first, second, third] = [x - a, a - b, b - c];
        [
            c,
            third,
            second - third,
            (first - second) - (second - third),
        ]
    }
}

/// Estimates velocity, acceleration and jerk of a displacement that is known only at the ticks.
///
/// The displacement itself is passed on as it is. The derivatives come from a chain of three low-pass filters; its
/// delay is corrected by the higher derivatives, which leaves an error of third order in the frequency divided by the
/// pole.
///
/// ```
/// use dashpot_core::hybrid::MotionFilter;
///
/// let mut filter = MotionFilter::new(100.0, 1e-3)?;
/// let mut velocity_m_per_s = 0.0;
/// for tick in 0..400 {
///     let t = 1e-3 * tick as f32;
///     velocity_m_per_s = filter.push(0.2 * t).velocity_m_per_s;
/// }
/// assert!((velocity_m_per_s - 0.2).abs() < 1e-4);
/// # Ok::<(), dashpot_core::BuildError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotionFilter {
    chain: Chain<3>,
    pole_per_s: f32,
}

impl MotionFilter {
    /// A filter at rest at 0. Its pole is at `pole_hz`: 1 Hz to a quarter of the rate of the ticks.
    ///
    /// # Errors
    /// A number is outside its range.
    pub fn new(pole_hz: f32, step_s: f32) -> Result<Self, BuildError> {
        limits::step("motion", step_s)?;
        let most = 0.25 / step_s;
        limits::within(
            ("motion", "pole_hz"),
            pole_hz,
            (1.0, most),
            "1 to a quarter of the rate of the ticks",
        )?;
        let pole_per_s = core::f32::consts::TAU * pole_hz;
        Ok(Self {
            chain: Chain::new(pole_per_s, step_s),
            pole_per_s,
        })
    }

    /// Puts the filter at rest at a displacement (m).
    pub fn rest_at(&mut self, displacement_m: f32) {
        self.chain.rest_at(displacement_m);
    }

    /// Takes the displacement (m) of this tick and returns its motion.
    #[inline]
    pub fn push(&mut self, displacement_m: f32) -> Motion {
        let w = self.pole_per_s;
        let [_, first, second, third] = self.chain.push(displacement_m);
        // The chain multiplies by 1/(1 + s/w)^3; its inverse is 1 + 3 s/w + 3 (s/w)^2 + ...
        Motion {
            displacement_m,
            velocity_m_per_s: w * (first + 3.0 * (second + third)),
            acceleration_m_per_s2: w * w * (second + 3.0 * third),
            jerk_m_per_s3: w * w * w * third,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Chain, MotionFilter};

    #[test]
    fn derivatives_of_a_sine_are_those_of_the_closed_form() {
        let (h, f) = (1.0 / 4096.0, 3.0_f64);
        let w = core::f64::consts::TAU * f;
        let mut filter = MotionFilter::new(100.0, h as f32).unwrap();
        for tick in 0..8192 {
            let t = h * f64::from(tick);
            let motion = filter.push((1e-3 * libm::sin(w * t)) as f32);
            if tick > 2048 {
                let velocity = 1e-3 * w * libm::cos(w * t);
                let acceleration = -1e-3 * w * w * libm::sin(w * t);
                assert!((f64::from(motion.velocity_m_per_s) - velocity).abs() < 3e-4 * 1e-3 * w);
                let error = f64::from(motion.acceleration_m_per_s2) - acceleration;
                assert!(error.abs() < 6e-3 * 1e-3 * w * w, "{error}");
            }
        }
    }

    #[test]
    fn a_chain_at_rest_stays_at_rest() {
        let mut chain = Chain::<3>::new(100.0, 1e-3);
        chain.rest_at(0.25);
        assert_eq!(chain.push(0.25), [0.25, 0.0, 0.0, 0.0]);
    }
}
