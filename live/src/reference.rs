//! A reference run whose digest shows that a processor computes the same bits.

use std::sync::Arc;

use dashpot_files::case::Case;
use dashpot_rail::contact::Tables;
use dashpot_vehicle_run::contact::WheelOnRail;
use sha2::{Digest, Sha256};

use crate::{ActionError, Built};

/// Digest of [`reference_digest`] on every processor.
pub const REFERENCE_DIGEST: &str = include_str!("reference.sha256").trim_ascii_end();

/// Case of the reference run.
const CASE: &str = "straight-180";

/// Ticks of the reference run.
const TICKS: u64 = 2000;

/// Runs the locomotive at 180 km/h for two seconds and returns the SHA-256 of the bits of its coordinates, wheel forces
/// and damper forces after every hundredth tick, in hexadecimal.
///
/// # Errors
/// The tables do not belong to the case.
pub fn reference_digest(
    tables: impl Fn(&WheelOnRail) -> Result<Arc<Tables>, ActionError>,
) -> Result<String, ActionError> {
    let case = Case::load(CASE).map_err(|error| crate::ChoiceError::Case(Box::new(error)))?;
    let mut run = Built::new(case, tables)?.run()?;
    let mut hash = Sha256::new();
    for tick in 1..=TICKS {
        run.step()?;
        if tick % 100 == 0 {
            let state = run.state();
            let wheels = state
                .contacts()
                .iter()
                .flat_map(|contact| contact.wheels.iter());
            let numbers = state.coordinates().iter().flatten().copied();
            let numbers = numbers.chain(wheels.flat_map(|wheel| wheel.force_n));
            for number in numbers.chain(state.damper_forces_n().iter().copied()) {
                hash.update(number.to_bits().to_le_bytes());
            }
        }
    }
    Ok(dashpot_files::hexadecimal(&hash.finalize()))
}
