//! A run's state as a text, from which it goes on with the same bits.

use std::fmt::Write;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use dashpot_files::case::Case;
use dashpot_rail::track::Defect;
use dashpot_rail::vehicle::VehicleState;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use crate::simulation::Inputs;
use crate::{Action, ActionError, Choice, Desk, Simulation};

/// The run that a saved state belongs to.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Subject {
    /// A choice, from which a page builds its case.
    Choice(Choice),
    /// A case with this digest, which a command was started with.
    Case(String),
}

impl Subject {
    /// The case of a command, whose track, rails and events may be any.
    pub fn of_case(case: &Case) -> Self {
        let mut digest = Hasher(Sha256::new());
        // Written in this way, every number keeps all its bits.
        let _never_fails = write!(digest, "{case:?}");
        Self::Case(dashpot_files::hexadecimal(&digest.0.finalize()))
    }
}

/// Hashes what is written.
struct Hasher(Sha256);

impl Write for Hasher {
    fn write_str(&mut self, text: &str) -> std::fmt::Result {
        self.0.update(text);
        Ok(())
    }
}

/// Everything that a run needs to go on.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Saved {
    version: String,
    subject: Subject,
    actions: Vec<(u64, Action)>,
    /// Actions alone do not tell where the vehicle was.
    defects: Vec<Defect>,
    state_base64: String,
}

impl Saved {
    /// Saves a run and what the operator has changed.
    ///
    /// # Errors
    /// None are known: states can be written.
    pub fn new(
        subject: Subject,
        desk: &Desk,
        simulation: &Simulation,
    ) -> Result<Self, ActionError> {
        let state = postcard::to_stdvec(&(simulation.run().state(), simulation.inputs()));
        let state = state.map_err(|_| ActionError::State("the state cannot be written"))?;
        Ok(Self {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            subject,
            actions: desk.actions().to_vec(),
            defects: desk.defects().to_vec(),
            state_base64: BASE64_STANDARD.encode(state),
        })
    }

    /// The saved state as a text.
    ///
    /// # Errors
    /// None are known: states can be written.
    pub fn text(&self) -> Result<String, ActionError> {
        serde_json::to_string(self).map_err(|_| ActionError::State("the state cannot be written"))
    }

    /// Reads a saved state.
    ///
    /// # Errors
    /// It is damaged, or of another version.
    pub fn read(text: &str) -> Result<Self, ActionError> {
        let damaged = |_| ActionError::State("this is not a saved state, or it is damaged");
        let saved: Self = serde_json::from_str(text).map_err(damaged)?;
        if saved.version != env!("CARGO_PKG_VERSION") {
            return Err(ActionError::State(
                "the state is of another version of Dashpot",
            ));
        }
        Ok(saved)
    }

    /// The run that it belongs to.
    pub fn subject(&self) -> &Subject {
        &self.subject
    }

    /// Brings a run that is at its start, and its desk, to the saved state.
    ///
    /// # Errors
    /// The state is damaged, or of another vehicle.
    pub fn restore(&self, desk: &mut Desk, simulation: &mut Simulation) -> Result<(), ActionError> {
        let (state, inputs) = self.state()?;
        desk.replay(&self.actions, &self.defects)?;
        simulation.restore(state, inputs)?;
        for change in desk.changes()? {
            simulation.apply(&change)?;
        }
        Ok(())
    }

    /// The vehicle's state and the inputs.
    fn state(&self) -> Result<(VehicleState, Inputs), ActionError> {
        let bytes = BASE64_STANDARD.decode(&self.state_base64).ok();
        let state = bytes.and_then(|bytes| postcard::from_bytes(&bytes).ok());
        state.ok_or(ActionError::State("the saved state is damaged"))
    }
}
