//! A case by its name or by its parts.

use super::{CaseError, CaseOptions};

/// A case by its name, of which the parts that are given change those of the case, or by its parts.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct CaseParts<'a> {
    /// A shipped case or a file.
    pub case: Option<&'a str>,
    /// A shipped vehicle or a file; the locomotive where there is no case either.
    pub vehicle: Option<&'a str>,
    /// A shipped track or a file.
    pub track: Option<&'a str>,
    /// The numbers, in the order of [`CaseOptions::NUMBERS`], speed first.
    pub numbers: [Option<f64>; CaseOptions::NUMBERS.len()],
}

impl CaseParts<'_> {
    /// The case in names; none of neither a case nor track and speed.
    ///
    /// # Errors
    /// As [`CaseOptions::load`].
    pub fn options(&self) -> Result<Option<CaseOptions>, CaseError> {
        let mut options = match (self.case, self.track, self.numbers[0]) {
            (Some(case), ..) => {
                let mut options = CaseOptions::load(case)?;
                if let Some(vehicle) = self.vehicle {
                    options.set_vehicle(vehicle);
                }
                if let Some(track) = self.track {
                    options.set_track(track);
                }
                options
            }
            (None, Some(track), Some(speed_km_h)) => {
                CaseOptions::new(self.vehicle.unwrap_or("locomotive"), track, speed_km_h)
            }
            _ => return Ok(None),
        };
        for (key, number) in CaseOptions::NUMBERS.iter().zip(self.numbers) {
            if let Some(number) = number {
                options.set_number(key, number);
            }
        }
        Ok(Some(options))
    }
}
