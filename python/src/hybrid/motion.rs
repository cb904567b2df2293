//! The motion filter.

use pyo3::prelude::*;

use super::Class;
use crate::error::{Outcome, refuse};

static MOTION: Class = super::class("Motion");

/// Estimates velocity, acceleration and jerk of a displacement that is known only at the ticks.
///
/// `pole_hz` is the pole of the filter: 1 Hz to a quarter of the rate of the ticks. The filter starts at rest at 0.
///
/// >>> import dashpot
/// >>> motion_filter = dashpot.MotionFilter(pole_hz=100.0, step_s=1e-3)
/// >>> for tick in range(400):
/// ...     motion = motion_filter.push(0.2e-3 * tick)
/// >>> round(motion.velocity_m_per_s, 4)
/// 0.2
#[pyclass(module = "dashpot")]
pub struct MotionFilter {
    filter: dashpot_core::hybrid::MotionFilter,
}

#[pymethods]
impl MotionFilter {
    #[new]
    #[pyo3(signature = (pole_hz, step_s=1e-3))]
    fn new(pole_hz: f32, step_s: f32) -> Outcome<Self> {
        let filter = dashpot_core::hybrid::MotionFilter::new(pole_hz, step_s)?;
        Ok(Self { filter })
    }

    /// Puts the filter at rest at a displacement (m): at the start, and after a displacement that was not finite.
    ///
    /// >>> import dashpot
    /// >>> motion_filter = dashpot.MotionFilter(pole_hz=100.0)
    /// >>> motion_filter.rest_at(0.25)
    /// >>> motion_filter.push(0.25)
    /// Motion(displacement_m=0.25, velocity_m_per_s=0.0, acceleration_m_per_s2=0.0, jerk_m_per_s3=0.0)
    fn rest_at(&mut self, displacement_m: f32) -> Outcome<()> {
        if !displacement_m.is_finite() {
            return refuse(format!(
                "displacement_m: {displacement_m}, allowed: finite numbers"
            ));
        }
        self.filter.rest_at(displacement_m);
        Ok(())
    }

    /// Takes the displacement (m) of this tick and returns its `dashpot.Motion`. A displacement that is not finite
    /// makes this motion and those after it useless, until `rest_at`.
    fn push<'py>(&mut self, py: Python<'py>, displacement_m: f32) -> Outcome<Bound<'py, PyAny>> {
        let motion = self.filter.push(displacement_m);
        MOTION.make(
            py,
            (
                motion.displacement_m,
                motion.velocity_m_per_s,
                motion.acceleration_m_per_s2,
                motion.jerk_m_per_s3,
            ),
        )
    }

    fn __copy__(&self) -> Self {
        Self {
            filter: self.filter,
        }
    }

    fn __deepcopy__(&self, _memo: &Bound<'_, PyAny>) -> Self {
        self.__copy__()
    }
}
