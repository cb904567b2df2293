//! Dampers of the image: each end of the two bogies has one in-service, one reduced vertical and one reduced lateral
//! damper.

mod in_service;
mod reduced_lateral;
mod reduced_vertical;

use dashpot_core::Damper;
use in_service::IN_SERVICE;
use reduced_lateral::REDUCED_LATERAL;
use reduced_vertical::REDUCED_VERTICAL;

/// Number of dampers of the bank.
pub const DAMPERS: usize = 12;

/// The bank, in the order of displacements and forces on the link.
pub static BANK: [&Damper<f32>; DAMPERS] = [
    &IN_SERVICE,
    &IN_SERVICE,
    &IN_SERVICE,
    &IN_SERVICE,
    &REDUCED_VERTICAL,
    &REDUCED_VERTICAL,
    &REDUCED_VERTICAL,
    &REDUCED_VERTICAL,
    &REDUCED_LATERAL,
    &REDUCED_LATERAL,
    &REDUCED_LATERAL,
    &REDUCED_LATERAL,
];
