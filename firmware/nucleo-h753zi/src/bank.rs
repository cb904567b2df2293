//! Dampers of the image: twelve `in-service`. The host may load any other into each place.
//!
//! For your own, replace `in_service.rs` by what `dashpot export --lang rust --step-us 1000` writes.

use dashpot_core::Damper;

use crate::in_service::IN_SERVICE;

/// Number of dampers of the bank.
pub const DAMPERS: usize = 12;

/// The bank, in the order of displacements and forces on the link.
pub static BANK: [&Damper<f32>; DAMPERS] = [&IN_SERVICE; DAMPERS];
