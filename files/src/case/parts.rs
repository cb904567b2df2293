//! A case given by name or by its parts.

use super::{CaseError, CaseOptions};

/// A case given by name with some parts replaced, or by its parts alone.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct CaseParts<'a> {
    /// Built-in case or file.
    pub case: Option<&'a str>,
    /// Built-in vehicle or file; defaults to that of the case, or to the locomotive if there is no case.
    pub vehicle: Option<&'a str>,
    /// Built-in track or file.
    pub track: Option<&'a str>,
    /// Numbers that replace those of the case or the defaults.
    pub numbers: CaseNumbers,
}

/// Optional numbers of a case, with the units of [`CaseOptions`].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct CaseNumbers {
    /// Speed, km/h.
    pub speed_km_h: Option<f64>,
    /// Simulated time, s.
    pub duration_s: Option<f64>,
    /// Initial distance of the vehicle's centre along the track, m.
    pub start_m: Option<f64>,
    /// Static friction coefficient between wheel and rail.
    pub friction: Option<f64>,
    /// Normal contact damping divided by the normal force, s/m.
    pub normal_damping_s_per_m: Option<f64>,
    /// Time step, us.
    pub step_us: Option<f64>,
    /// Initial lateral offset of all bodies except the first, m; positive to the right.
    pub push_m: Option<f64>,
}

impl CaseNumbers {
    /// Returns each number with its key.
    fn keyed(&self) -> [(&'static str, Option<f64>); CaseOptions::NUMBERS.len()] {
        [
            ("speed_km_h", self.speed_km_h),
            ("duration_s", self.duration_s),
            ("start_m", self.start_m),
            ("friction", self.friction),
            ("normal_damping_s_per_m", self.normal_damping_s_per_m),
            ("step_us", self.step_us),
            ("push_m", self.push_m),
        ]
    }
}

impl CaseParts<'_> {
    /// Returns the unresolved case; `None` if there is neither a case nor both track and speed.
    ///
    /// # Errors
    /// Same errors as [`CaseOptions::load`].
    pub fn options(&self) -> Result<Option<CaseOptions>, CaseError> {
        let mut options = match (self.case, self.track, self.numbers.speed_km_h) {
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
        for (key, number) in self.numbers.keyed() {
            if let Some(number) = number {
                options.set_number(key, number);
            }
        }
        Ok(Some(options))
    }
}
