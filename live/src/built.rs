//! A case whose contact and track are ready, so that a run starts at once.

use std::sync::Arc;

use dashpot_files::case::Case;
use dashpot_rail::contact::Tables;
use dashpot_rail::track::Track;
use dashpot_vehicle_run::contact::{Contact, ContactSetup, WheelOnRail};
use dashpot_vehicle_run::{Run, VehicleRunError};

use crate::ActionError;

/// A case with its contact and its track.
#[derive(Debug, Clone)]
pub struct Built {
    case: Case,
    contacts: Vec<Contact>,
    track: Arc<Track>,
}

impl Built {
    /// Generates the track of a case and gets its contact tables.
    ///
    /// # Errors
    /// The case has no contact or no track, or the tables do not belong to it.
    pub fn new(
        mut case: Case,
        tables: impl Fn(&WheelOnRail) -> Result<Arc<Tables>, ActionError>,
    ) -> Result<Self, ActionError> {
        let setup = ContactSetup::of_case(&case).map_err(VehicleRunError::from)?;
        let tables = setup
            .pairs()
            .iter()
            .map(tables)
            .collect::<Result<Vec<_>, _>>()?;
        // Generated once, so that a defect on the track costs no time.
        case.track = case.track.resolved().map_err(VehicleRunError::from)?;
        let track = case.track.build().map_err(VehicleRunError::from)?;
        Ok(Self {
            contacts: setup.contacts(&tables)?,
            track: Arc::new(track),
            case,
        })
    }

    /// The case, with its irregularities generated.
    pub fn case(&self) -> &Case {
        &self.case
    }

    /// A run at its start.
    ///
    /// # Errors
    /// An invalid vehicle.
    pub fn run(&self) -> Result<Run, VehicleRunError> {
        Run::on(&self.case, self.contacts.clone(), Arc::clone(&self.track))
    }
}
