//! A coupled vehicle with its variables by number, and what it has to tell.

use std::ffi::{CStr, CString};
use std::path::Path;

use dashpot_vehicle_run::{Coupled, CoupledCase, Ending};

use crate::result::ModelResult;

/// A model of `model.h`.
pub struct Model {
    vehicle: Coupled,
    /// Room for a saved state: twice that of the start, which leaves every count its largest.
    saved_bytes: usize,
    /// Whether it goes no further for a reason that is not of its case.
    failure: bool,
    /// To be told next.
    notice: Option<CString>,
    /// Told last, and read by others until the next.
    told: Option<CString>,
}

impl Model {
    /// Of the case of this digest and the tables in a folder.
    ///
    /// # Errors
    /// A file that is not there or is none of this version, in words.
    pub fn new(resources: &Path, digest: &str) -> Result<Self, String> {
        let path = resources.join(CoupledCase::FILE);
        let told = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
        let text = std::fs::read(&path).map_err(|error| told(&error))?;
        if CoupledCase::digest(&text) != digest {
            return Err(told(&"not the case that this FMU was exported with"));
        }
        let case: CoupledCase = serde_json::from_slice(&text).map_err(|error| told(&error))?;
        let contact = case.contact().map_err(|error| error.to_string())?;
        let tables = contact.tables_in(resources);
        let vehicle = tables.and_then(|tables| Coupled::new(&case, tables));
        let vehicle = vehicle.map_err(|error| error.to_string())?;
        let saved = vehicle.save().map_err(|error| error.to_string())?;
        Ok(Self {
            saved_bytes: size_of::<u64>() + 2 * saved.len(),
            vehicle,
            failure: false,
            notice: None,
            told: None,
        })
    }

    pub fn reset(&mut self) {
        self.vehicle.reset();
        self.failure = false;
        self.notice = None;
    }

    /// Place of a variable: they count from 1 on.
    fn place(variable: u32) -> Option<usize> {
        usize::try_from(variable).ok()?.checked_sub(1)
    }

    pub fn number(&self, variable: u32) -> Option<f64> {
        self.vehicle.value(Self::place(variable)?)
    }

    /// Behind the last number there is how it ended.
    pub fn integer(&self, variable: u32) -> Option<i32> {
        let is_ending = Self::place(variable)? == self.vehicle.variables().len();
        is_ending.then(|| self.vehicle.ending_code())
    }

    pub fn check(&self, variable: u32, value: f64) -> ModelResult {
        let place = Self::place(variable);
        match place.and_then(|place| self.vehicle.variables().get(place)) {
            None => ModelResult::NoVariable,
            Some(variable) if !variable.is_force() => ModelResult::ReadOnly,
            Some(_) if !value.is_finite() => ModelResult::OutOfRange,
            Some(_) => ModelResult::Done,
        }
    }

    pub fn set(&mut self, variable: u32, value: f64) {
        if let Some(place) = Self::place(variable)
            && let Err(error) = self.vehicle.set_force_n(place, value)
        {
            self.fail(&error.to_string());
        }
    }

    /// Ticks, fewer where it ends: how many.
    pub fn step(&mut self, ticks: u64) -> u64 {
        if self.failure {
            return 0;
        }
        let had_ended = self.vehicle.ending().is_some();
        match self.vehicle.step(ticks) {
            Ok(taken) => {
                // That a case is over is no news.
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

    /// How many bytes follow, then those, into zeros. Left as they are where there is no room, which is no state.
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
                self.failure = false;
                self.notice = None;
                ModelResult::Done
            }
            _ => ModelResult::Other,
        }
    }

    /// It goes no further, for this reason; no ticks.
    pub fn fail(&mut self, reason: &str) -> u64 {
        self.failure = true;
        self.notice = CString::new(reason).ok();
        0
    }

    pub fn has_ended(&self) -> bool {
        self.failure || self.vehicle.ending().is_some()
    }

    pub fn has_failed(&self) -> bool {
        self.failure
    }

    pub fn notice(&mut self) -> Option<&CStr> {
        self.told = self.notice.take();
        self.told.as_deref()
    }
}
