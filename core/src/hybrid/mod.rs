//! Hybrid tests: a real damper moved by an actuator, with the rest of the vehicle simulated around it.
//!
//! An actuator follows late and smaller at higher frequencies. On the vehicle this acts as negative damping, so the
//! test is wrong before it is unstable. Each tick of a test takes the following path:
//!
//! ```text
//! simulated displacement -> compensator -> guard -> actuator -> damper -> measured displacement and force
//! ```
//!
//! - A [`Compensator`] computes the command with which the actuator arrives in time: [`Uncompensated`],
//!   [`PolynomialExtrapolation`], [`InverseModel`], [`AdaptiveTimeSeries`] or one of your own.
//! - [`Tracking`] measures how well the displacement follows, and [`AddedEnergy`] how much energy the actuator adds to
//!   the vehicle.
//! - A [`Guard`] checks commands and measured values, and ends the test without a step of the command.
//! - [`TransferSystem`] combines them.
//! - [`wire`] is the protocol between a simulated vehicle and a rig.
//!
//! All parts take a bounded number of operations a tick, use single precision, do not allocate, and return only finite
//! numbers; a [`MotionFilter`] does so for finite displacements. Displacements (m) are positive in extension, forces
//! (N) when they resist extension. See docs/hybrid.md.

mod adaptive;
mod compensator;
mod energy;
mod guard;
mod inverse;
mod limits;
mod motion;
mod polynomial;
mod status;
mod tracking;
mod transfer;
pub mod wire;

pub use adaptive::{AdaptiveSettings, AdaptiveTimeSeries};
pub use compensator::{Compensator, Uncompensated};
pub use energy::{AddedEnergy, EnergySettings};
pub use guard::{Guard, GuardAction, GuardSettings};
pub use inverse::InverseModel;
pub use motion::{Motion, MotionFilter};
pub use polynomial::PolynomialExtrapolation;
pub use status::HybridStatus;
pub use tracking::{Tracking, TrackingReading};
pub use transfer::{Command, Measured, TransferSettings, TransferSystem};
