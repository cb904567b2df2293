//! Coupled vehicle with numbered variables and pending messages.

use std::ffi::{CStr, CString};
use std::path::Path;

use dashpot_vehicle_run::{Coupled, CoupledCase, Ending};

use crate::result::ModelResult;

/// The type `model` of `model.h`.
pub struct Model {
    vehicle: Coupled,
    /// Fixed size of a saved state: twice the initial size, so that every counter has room to grow.
    saved_bytes: usize,
    /// True after an error that is not an ending of the case.
    has_failed: bool,
    /// Message not yet returned.
    notice: Option<CString>,
    /// Message returned last, which the caller may read until the next call.
    last_notice: Option<CString>,
}

impl Model {
    /// Reads the case and the contact tables from a folder. The case must have the digest `digest`.
    ///
    /// # Errors
    /// Returns a description of the problem if a file is missing, invalid or from another version.
    pub fn new(resources: &Path, digest: &str) -> Result<Self, String> {
        let path = resources.join(CoupledCase::FILE);
        let in_file = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
        let text = std::fs::read(&path).map_err(|error| in_file(&error))?;
        if CoupledCase::digest(&text) != digest {
            return Err(in_file(&"not the case that this FMU was exported with"));
        }
        let case: CoupledCase = serde_json::from_slice(&text).map_err(|error| in_file(&error))?;
        let contact = case.contact().map_err(|error| error.to_string())?;
        let tables = contact.pairs().iter().map(|pair| {
            let name = pair.tables_file_name().map_err(|error| error.to_string())?;
            let path = resources.join(name);
            let in_tables = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
            let bytes = std::fs::read(&path).map_err(|error| in_tables(&error))?;
            pair.tables_from(&bytes).map_err(|error| in_tables(&error))
        });
        let tables: Vec<_> = tables.collect::<Result<_, String>>()?;
        let vehicle = Coupled::new(&case, &tables);
        let vehicle = vehicle.map_err(|error| error.to_string())?;
        let saved = vehicle.save().map_err(|error| error.to_string())?;
        Ok(Self {
            saved_bytes: size_of::<u64>() + 2 * saved.len(),
            vehicle,
            has_failed: false,
            notice: None,
            last_notice: None,
        })
    }

    pub fn reset(&mut self) {
        self.vehicle.reset();
        self.has_failed = false;
        self.notice = None;
    }

    /// Index of a variable; variables count from 1.
    fn index(variable: u32) -> Option<usize> {
        usize::try_from(variable).ok()?.checked_sub(1)
    }

    pub fn number(&self, variable: u32) -> Option<f64> {
        self.vehicle.value(Self::index(variable)?)
    }

    /// Reads an integer variable. The only one follows the last real variable and states how the run ended.
    pub fn integer(&self, variable: u32) -> Option<i32> {
        let is_ending = Self::index(variable)? == self.vehicle.variables().len();
        is_ending.then(|| self.vehicle.ending_code())
    }

    pub fn check(&self, variable: u32, value: f64) -> ModelResult {
        let index = Self::index(variable);
        match index.and_then(|index| self.vehicle.variables().get(index)) {
            None => ModelResult::NoVariable,
            Some(variable) => match variable.input() {
                None => ModelResult::ReadOnly,
                Some(input) if input.allows(value) => ModelResult::Done,
                Some(_) => ModelResult::OutOfRange,
            },
        }
    }

    pub fn set(&mut self, variable: u32, value: f64) {
        if let Some(index) = Self::index(variable)
            && let Err(error) = self.vehicle.set(index, value)
        {
            self.fail(&error.to_string());
        }
    }

    /// Runs ticks and returns their number, which is smaller if the run ends.
    pub fn step(&mut self, ticks: u64) -> u64 {
        if self.has_failed {
            return 0;
        }
        let had_ended = self.vehicle.ending().is_some();
        match self.vehicle.step(ticks) {
            Ok(taken) => {
                // A completed case needs no message.
                if let Some(ending) = self.vehicle.ending()
                    && !had_ended
                    && *ending != Ending::Completed
                {
                    self.notice = CString::new(ending.to_string()).ok();
                }
                taken
            }
            Err(error) => self.fail(&error.to_string()),
        }
    }

    pub fn saved_bytes(&self) -> usize {
        self.saved_bytes
    }

    /// Writes the length and the bytes of the state into `to`, which contains zeros. If `to` is too short, it is not
    /// changed; zeros are not a valid state.
    pub fn save(&self, to: &mut [u8]) {
        let saved = self.vehicle.save().unwrap_or_default();
        if let Some((count, content)) = to.split_first_chunk_mut()
            && let Some(content) = content.get_mut(..saved.len())
        {
            *count = (saved.len() as u64).to_le_bytes();
            content.copy_from_slice(&saved);
        }
    }

    pub fn restore(&mut self, from: &[u8]) -> ModelResult {
        let saved = from.split_first_chunk().and_then(|(count, content)| {
            let count = usize::try_from(u64::from_le_bytes(*count)).ok()?;
            content.get(..count)
        });
        match saved.map(|saved| self.vehicle.restore(saved)) {
            Some(Ok(())) => {
                self.has_failed = false;
                self.notice = None;
                ModelResult::Done
            }
            _ => ModelResult::Other,
        }
    }

    /// Stops the model with a message. Returns 0, the number of ticks run.
    pub fn fail(&mut self, reason: &str) -> u64 {
        self.has_failed = true;
        self.notice = CString::new(reason).ok();
        0
    }

    pub fn has_ended(&self) -> bool {
        self.has_failed || self.vehicle.ending().is_some()
    }

    pub fn has_failed(&self) -> bool {
        self.has_failed
    }

    pub fn notice(&mut self) -> Option<&CStr> {
        self.last_notice = self.notice.take();
        self.last_notice.as_deref()
    }
}
