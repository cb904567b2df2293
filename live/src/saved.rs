//! A run's state as a text, from which it goes on with the same bits.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use dashpot_rail::track::Defect;
use dashpot_rail::vehicle::VehicleState;
use serde::{Deserialize, Serialize};

use crate::simulation::Inputs;
use crate::{Action, ActionError, Choice};

/// Everything that a run needs to go on.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Saved {
    version: String,
    pub choice: Choice,
    pub actions: Vec<(u64, Action)>,
    /// Actions alone do not tell where the vehicle was.
    pub defects: Vec<Defect>,
    state_base64: String,
}

impl Saved {
    pub fn new(
        choice: Choice,
        actions: Vec<(u64, Action)>,
        defects: Vec<Defect>,
        state: &VehicleState,
        inputs: Inputs,
    ) -> Result<Self, ActionError> {
        let state = postcard::to_stdvec(&(state, inputs));
        let state = state.map_err(|_| ActionError::State("the state cannot be written"))?;
        Ok(Self {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            choice,
            actions,
            defects,
            state_base64: BASE64_STANDARD.encode(state),
        })
    }

    /// Reads a saved state.
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

    /// The vehicle's state and the inputs.
    pub fn state(&self) -> Result<(VehicleState, Inputs), ActionError> {
        let bytes = BASE64_STANDARD.decode(&self.state_base64).ok();
        let state = bytes.and_then(|bytes| postcard::from_bytes(&bytes).ok());
        state.ok_or(ActionError::State("the saved state is damaged"))
    }
}
