//! Stability of a loop, and the delay it bears.

use std::f64::consts::TAU;

use nalgebra::Complex;

use super::crossing::Crossing;
use super::error::PlanError;
use super::frequency_response::ClosedWithoutDelay;
use super::plant::PlantWithoutDamper;
use super::sweep::{Loop, Swept};

/// Distance from a whole number that the count of unstable roots may have.
const MAX_FRACTION: f64 = 0.05;
/// Relative difference below which two delays count as equal.
const SAME_DELAY: f64 = 1e-6;

/// The shortest delay at which a root reaches the imaginary axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CriticalDelay {
    /// Pure delay (s): the loop is stable with less.
    pub delay_s: f64,
    /// Frequency of the growing motion (Hz).
    pub frequency_hz: f64,
}

/// Stability of a loop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LoopStability {
    /// Motion decays.
    Stable {
        /// The additional pure delay that the loop bears; `None` if it bears any.
        margin: Option<CriticalDelay>,
    },
    /// Motion grows.
    Unstable {
        /// Roots with positive real part; a growing oscillation counts twice.
        roots: usize,
    },
}

/// Computes the shortest pure delay of the damper's force at which the vehicle is no longer stable: the smallest
/// `(arg(-L(j omega)) mod 2 pi)/omega` over all `|L(j omega)| = 1` (Walton and Marshall 1987). `None` if there is no
/// such frequency: the vehicle is stable with any delay. The result is exact to a relative error of about 1e-10.
///
/// ```
/// use dashpot_hybrid::plan::{PlantWithoutDamper, critical_delay};
/// use nalgebra::{DMatrix, DVector};
///
/// // 2 kg on 800 N/m with 20 N s/m of its own: a damper of 10 N s/m cannot make it unstable.
/// let a = DMatrix::from_row_slice(2, 2, &[-10.0, -400.0, 1.0, 0.0]);
/// let [b, c] = [[0.5, 0.0], [0.0, 1.0]].map(|row| DVector::from_row_slice(&row));
/// let with = |damping| PlantWithoutDamper::new(a.clone(), b.clone(), c.clone(), damping, 1e6);
/// assert_eq!(critical_delay(&with(10.0)?)?, None);
/// // One of 40 N s/m can, with 69 ms: a third of the period at which omega^2 - 400 = sqrt(300) omega.
/// let critical = critical_delay(&with(40.0)?)?.unwrap();
/// assert!((critical.delay_s - 0.0688).abs() < 1e-4, "{critical:?}");
/// # Ok::<(), dashpot_hybrid::plan::PlanError>(())
/// ```
///
/// # Errors
/// The vehicle is unstable or undamped without any delay, or the result is undecided to within rounding.
pub fn critical_delay(plant: &PlantWithoutDamper) -> Result<Option<CriticalDelay>, PlanError> {
    let closed = ClosedWithoutDelay::new(plant)?;
    let poles = closed.poles().iter();
    let fastest = poles.max_by(|a, b| a.re.total_cmp(&b.re));
    if let Some(pole) = fastest
        && pole.re > 0.0
    {
        return Err(PlanError::UnstableWithoutDelay {
            frequency_hz: pole.im.abs() / TAU,
            growth_per_s: pole.re,
        });
    }
    let factor = |_| Complex::from(1.0);
    let undelayed = Loop {
        closed: &closed,
        factor,
    };
    shortest(&undelayed.sweep()?)
}

/// Counts the unstable roots of `1 + L(s) F(s) = 0` by the argument principle, and computes the additional pure delay
/// that a stable loop bears. `loop_factor` is `F`, the ratio of the force that the vehicle feels to the force of the
/// damper without any lag, at `s = j omega` with `omega > 0`.
///
/// `F` must be stable, real at zero frequency and bounded at high frequency. Between frequencies 5 % apart its
/// magnitude must not vary by more than a factor of two, so resonances must have a damping ratio of a twentieth or
/// more.
///
/// ```
/// use dashpot_hybrid::plan::{Complex, LoopStability, PlantWithoutDamper, critical_delay, stability};
/// use nalgebra::{DMatrix, DVector};
///
/// let a = DMatrix::from_row_slice(2, 2, &[-1.0, -400.0, 1.0, 0.0]);
/// let [b, c] = [[1.0, 0.0], [0.0, 1.0]].map(|row| DVector::from_row_slice(&row));
/// let plant = PlantWithoutDamper::new(a, b, c, 5.0, 1e5)?;
/// let critical = critical_delay(&plant)?.unwrap();
/// let delayed = |delay_s: f64| stability(&plant, |s: Complex<f64>| (-s * delay_s).exp());
/// let LoopStability::Stable { margin: Some(margin) } = delayed(0.01)? else { panic!() };
/// assert!((margin.delay_s + 0.01 - critical.delay_s).abs() < 1e-9);
/// assert_eq!(delayed(critical.delay_s + 1e-3)?, LoopStability::Unstable { roots: 2 });
/// # Ok::<(), dashpot_hybrid::plan::PlanError>(())
/// ```
///
/// # Errors
/// A motion of the vehicle with the damper and without lag is undamped; `loop_factor` is not finite or grows too fast
/// with frequency; or the result is undecided to within rounding.
pub fn stability(
    plant: &PlantWithoutDamper,
    loop_factor: impl Fn(Complex<f64>) -> Complex<f64>,
) -> Result<LoopStability, PlanError> {
    let closed = ClosedWithoutDelay::new(plant)?;
    let lagging = Loop {
        closed: &closed,
        factor: loop_factor,
    };
    let swept = lagging.sweep()?;
    // The poles of 1 - T + T F are those of T, and its zeros are the roots. By the argument principle their difference
    // on the right of the axis is minus the turns about zero along the whole axis, twice those along the upper half.
    let unstable_poles = closed.poles().iter().filter(|pole| pole.re > 0.0).count();
    let count = unstable_poles as f64 - swept.half_turns;
    let roots = count.round();
    if (count - roots).abs() > MAX_FRACTION || roots < 0.0 {
        return Err(PlanError::NoCount { count });
    }
    if roots > 0.0 {
        let roots = roots as usize;
        return Ok(LoopStability::Unstable { roots });
    }
    let margin = shortest(&swept)?;
    Ok(LoopStability::Stable { margin })
}

/// The crossing with the shortest delay.
fn shortest(swept: &Swept) -> Result<Option<CriticalDelay>, PlanError> {
    let of_delay = |a: &&Crossing, b: &&Crossing| a.delay_s.total_cmp(&b.delay_s);
    let crossing = swept.crossings.iter().min_by(of_delay);
    let limit = crossing.map_or(f64::INFINITY, |crossing| crossing.delay_s);
    // A touch at a longer delay does not matter.
    if let Some(touch) = swept.touches.iter().min_by(of_delay)
        && touch.delay_s < limit * (1.0 - SAME_DELAY)
    {
        return Err(PlanError::Touches {
            frequency_hz: touch.omega / TAU,
            delay_s: touch.delay_s,
        });
    }
    Ok(crossing.map(|crossing| CriticalDelay {
        delay_s: crossing.delay_s,
        frequency_hz: crossing.omega / TAU,
    }))
}
