//! The dampers linked into the image: for each end of two bogies one in-service damper, one vertical
//! and one lateral damper of reduced form.

mod in_service;
mod reduced_lateral;
mod reduced_vertical;

use dashpot_core::Damper;
use in_service::IN_SERVICE;
use reduced_lateral::REDUCED_LATERAL;
use reduced_vertical::REDUCED_VERTICAL;

/// Dampers of the bank.
pub const DAMPERS: usize = 12;

/// The bank, in order of the link's displacements and forces.
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
