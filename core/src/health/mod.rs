//! Health of a damper in use: flow, stiffness and clearance tracked from measured displacement and force.
//!
//! With the measured force as input the chain of a damper is linear in what ages,
//!
//! ```text
//! x = x_r + delta_oil(F) + F kappa + a sign(F) + tau dx/dt,   dx_r/dt = phi v_h(F)
//! ```
//!
//! with the nominal velocity law `v_h` and the nominal oil column `delta_oil` of the built damper. `F` is the measured
//! force less the zero of its sensor, and both laws are those of a force less the added friction of the seals. A Kalman
//! filter has seven states: the piston's displacement `x_r`, the flow factor `phi`, the compliance of the mount
//! `kappa = 1/Ke`, half the clearance `a`, the lag of the force behind the displacement `tau`, the zero of the force
//! and the added friction. It measures where both ends are in contact and lets go of `x_r` where the element yields. Its
//! covariance is kept as `U D U'` (Bierman, *Factorization Methods for Discrete Sequential Estimation*, 1977), so that
//! it stays positive in single precision.
//!
//! [`HealthModel`] has the constants, built beside the damper; [`Health`] what changes from tick to tick. See
//! docs/health.md.

mod block;
#[cfg(feature = "builder")]
mod build;
mod estimator;
mod filter;
mod follow;
mod image;
mod model;
mod reading;
mod watch;

#[cfg(feature = "builder")]
pub use build::HealthSettings;
pub use estimator::Health;
pub use image::HealthImageError;
#[cfg(feature = "link")]
pub(crate) use image::HealthLoading;
pub use model::{Baseline, BaselineError, HealthLimits, HealthModel};
pub use reading::{Estimate, HealthReading, HealthStatus};
