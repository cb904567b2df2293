//! The option `--place`, which selects slots of a bank.

use dashpot_core::link::MAX_DAMPERS;

use super::target::Target;
use crate::commands::failure::{Failure, Outcome};

/// `--place`, once per slot.
#[derive(Debug, Clone, clap::Args)]
pub(super) struct Places {
    /// Slot of the bank, from 0; may be repeated; default: all slots.
    #[arg(long = "place", value_name = "PLACE", value_parser = place())]
    places: Vec<u8>,
}

/// Returns a parser for the slots that a target may have.
pub(super) fn place() -> clap::builder::RangedI64ValueParser<u8> {
    clap::value_parser!(u8).range(..MAX_DAMPERS as i64)
}

impl Places {
    /// Returns the selected slots of `target`, sorted and without duplicates.
    ///
    /// # Errors
    /// The target does not have one of the slots.
    pub(super) fn of(&self, target: &Target) -> Outcome<Vec<u8>> {
        if self.places.is_empty() {
            return Ok((0..).take(target.greeting.dampers).collect());
        }
        let mut places = self.places.clone();
        places.sort_unstable();
        places.dedup();
        places.iter().try_for_each(|place| check(*place, target))?;
        Ok(places)
    }
}

/// Rejects a slot that the target does not have.
pub(super) fn check(place: u8, target: &Target) -> Outcome<()> {
    let dampers = target.greeting.dampers;
    if usize::from(place) < dampers {
        return Ok(());
    }
    Err(Failure::wrong_use(format!(
        "--place {place}: the target has {dampers} dampers; allowed: 0 to {}",
        dampers.saturating_sub(1)
    )))
}

/// Formats slots: `slot 0`, `slots 0, 2, 3`.
pub(super) fn named(places: &[u8]) -> String {
    let numbers: Vec<String> = places.iter().map(u8::to_string).collect();
    let plural = if places.len() == 1 { "" } else { "s" };
    format!("slot{plural} {}", numbers.join(", "))
}
