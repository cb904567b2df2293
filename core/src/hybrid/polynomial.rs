//! Compensation by extrapolation (Horiuchi and others, 1996).

use super::compensator::Compensator;
use super::limits;
use super::motion::Motion;
use crate::BuildError;

/// Samples of a polynomial of third order.
const SAMPLES: usize = 4;
/// Largest number of ticks between two samples.
const MAX_SPACING: usize = 256;

/// The polynomial through the last samples of the displacement, evaluated one delay ahead.
///
/// It needs the displacement alone. The delay must be known, and high frequencies are amplified: at order 3 a frequency
/// whose period is 12 delays by 7 %.
///
/// The samples are as far apart as the delay, rounded to whole ticks, and the extrapolation reaches exactly the delay.
///
/// ```
/// use dashpot_core::hybrid::{Compensator, Motion, PolynomialExtrapolation};
///
/// let mut polynomial = PolynomialExtrapolation::new(3, 0.02, 1e-3)?;
/// let mut command_m = 0.0;
/// for tick in 0..200 {
///     let t = 1e-3 * tick as f32;
///     command_m = polynomial.command_m(&Motion::at_rest(t * t));
/// }
/// assert!((command_m - 0.219 * 0.219).abs() < 1e-6); // at 0.199 s, 0.02 s ahead
/// # Ok::<(), dashpot_core::BuildError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct PolynomialExtrapolation {
    /// Weights of the present displacement and of those one, two and three spacings ago.
    weights: [f32; SAMPLES],
    /// Ticks between two samples.
    spacing: usize,
    past: [f32; (SAMPLES - 1) * MAX_SPACING],
    /// Place of the oldest displacement in `past`.
    oldest: usize,
}

impl PolynomialExtrapolation {
    /// Extrapolates by a polynomial of `order` 1 to 3 over the delay (s) of the actuator, at most 256 ticks.
    ///
    /// # Errors
    /// A number is outside its range.
    pub fn new(order: u8, delay_s: f32, step_s: f32) -> Result<Self, BuildError> {
        const SECTION: &str = "polynomial";
        limits::step(SECTION, step_s)?;
        limits::within((SECTION, "order"), f32::from(order), (1.0, 3.0), "1 to 3")?;
        let ticks = delay_s / step_s;
        let allowed = "1 to 256 ticks";
        limits::within(
            (SECTION, "delay_s"),
            ticks,
            (1.0, MAX_SPACING as f32),
            allowed,
        )
        .map_err(|_| limits::refused((SECTION, "delay_s"), delay_s, allowed))?;
        let spacing = libm::roundf(ticks);
        // Lagrange weights at `ahead` spacings after the present sample.
        let ahead = ticks / spacing;
        let order = usize::from(order);
        let mut weights = [0.0; SAMPLES];
        for (node, weight) in weights.iter_mut().enumerate().take(order + 1) {
            *weight = (0..=order)
                .filter(|other| *other != node)
                .map(|other| (ahead + other as f32) / (other as f32 - node as f32))
                .product();
        }
        Ok(Self {
            weights,
            spacing: spacing as usize,
            past: [0.0; (SAMPLES - 1) * MAX_SPACING],
            oldest: 0,
        })
    }

    /// The displacement (m) a number of ticks ago, at least one.
    fn ago(&self, ticks: usize) -> f32 {
        let count = (SAMPLES - 1) * self.spacing;
        let place = self.oldest + count - ticks;
        let wrapped = if place >= count { place - count } else { place };
        self.past.get(wrapped).copied().unwrap_or_default()
    }
}

impl Compensator for PolynomialExtrapolation {
    fn command_m(&mut self, desired: &Motion) -> f32 {
        let x = desired.displacement_m;
        let [now, one, two, three] = self.weights;
        let command = now * x
            + one * self.ago(self.spacing)
            + two * self.ago(2 * self.spacing)
            + three * self.ago(3 * self.spacing);
        if let Some(place) = self.past.get_mut(self.oldest) {
            *place = x;
        }
        let next = self.oldest + 1;
        self.oldest = if next == (SAMPLES - 1) * self.spacing {
            0
        } else {
            next
        };
        command
    }

    fn rest_at(&mut self, displacement_m: f32) {
        self.past.fill(displacement_m);
    }
}
