#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![warn(missing_docs)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

mod action;
mod built;
mod choice;
mod damper_desk;
mod defect;
mod desk;
mod error;
mod fault;
mod frame;
mod health;
mod message;
mod observer;
mod outline;
mod quantity;
mod recording;
mod reference;
mod saved;
mod scene;
mod session;
mod signal;
mod simulation;
mod status;
mod unknown_name;

pub use action::Action;
pub use built::Built;
pub use choice::{Choice, ChoiceError, endless};
pub use damper_desk::{DamperDesk, DamperStatus};
pub use dashpot_vehicle_run::contact::WheelOnRail;
pub use defect::{DEFECTS, DefectKind};
pub use desk::{Change, Desk, Place, SPEED_KM_H};
pub use error::{ActionError, within};
pub use fault::{FAULTS, FaultKind};
pub use frame::{Frame, FrameHead, flags};
pub use health::HealthLine;
pub use message::{FACTOR, MAX_STEPS, Message, Request};
pub use observer::Observer;
pub use outline::{Outline, wheelbase};
pub use quantity::Quantity;
pub use reference::{REFERENCE_DIGEST, reference_digest};
pub use saved::{Saved, Subject};
pub use scene::Scene;
/// A message to a page.
pub use serde_json::Value as Json;
pub use session::{Session, TablesOf};
pub use signal::SignalWords;
pub use simulation::Simulation;
pub use status::{Setting, Status};
pub use unknown_name::UnknownName;
