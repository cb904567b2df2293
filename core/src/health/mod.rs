//! Health of a damper in use: estimates flow, stiffness and clearance from measured displacement and force.
//!
//! With the measured force as the input, the chain of a damper is linear in the parameters that age,
//!
//! ```text
//! x = x_r + delta_oil(F) + F kappa + a sign(F) + tau dx/dt,   dx_r/dt = phi v_h(F)
//! ```
//!
//! with the nominal velocity law `v_h` and the nominal oil column `delta_oil` of the built damper. `F` is the measured
//! force minus the zero offset of its sensor. Both laws are evaluated at the force minus the added friction of the
//! seals.
//!
//! A Kalman filter has seven states: displacement of the piston `x_r`, flow factor `phi`, compliance of the mount
//! `kappa = 1/Ke`, half the clearance `a`, lag of the force behind the displacement `tau`, zero offset of the force and
//! added friction. It takes measurements only while both ends are in contact, and forgets `x_r` when the element
//! yields. The covariance is stored as `U D U'` (Bierman, *Factorization Methods for Discrete Sequential Estimation*,
//! 1977), so it stays positive in single precision.
//!
//! [`HealthModel`] contains the constants and [`Health`] the state. See docs/health.md.

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
