//! The compiled part of the Python package `dashpot`. It contains no physics and no rules; it only handles arrays and
//! exceptions and releases the GIL.
#![deny(unsafe_code)]
#![warn(missing_docs)]

mod arrays;
mod bank;
mod built;
mod calibration;
mod calibration_request;
mod calibration_words;
mod class;
mod contact;
mod contact_table;
mod contact_warnings;
mod creep_forces;
mod damper;
mod error;
mod export;
mod fleet;
mod health;
mod hybrid;
mod interruption;
mod json;
mod modes;
mod overrides;
mod pickled;
mod range;
mod recording;
mod remedy;
mod replacements;
mod response;
mod rig;
mod sensors;
mod sheet;
mod shims;
mod state;
mod stepped_vehicle;
mod sweep;
mod table;
mod vehicle;
mod verify;
mod whole;

/// The compiled module.
#[pyo3::pymodule]
mod _dashpot {
    /// Version of the package, and of the rows of a study.
    #[pymodule_export]
    const VERSION: &str = dashpot_study::sweep::VERSION;

    #[pymodule_export]
    use crate::bank::Bank;
    #[pymodule_export]
    use crate::built::BuiltDamper;
    #[pymodule_export]
    use crate::calibration::{Calibrated, calibrate};
    #[pymodule_export]
    use crate::contact::{Contact, contact};
    #[pymodule_export]
    use crate::creep_forces::creep_forces;
    #[pymodule_export]
    use crate::damper::Damper;
    #[pymodule_export]
    use crate::export::{export, export_fmu, export_health};
    #[pymodule_export]
    use crate::fleet::fleet;
    #[pymodule_export]
    use crate::health::health;
    #[pymodule_export]
    use crate::hybrid::{MotionFilter, TransferSystem};
    #[pymodule_export]
    use crate::modes::modes;
    #[pymodule_export]
    use crate::recording::read;
    #[pymodule_export]
    use crate::response::response;
    #[pymodule_export]
    use crate::rig::Cycle;
    #[pymodule_export]
    use crate::sheet::sheet;
    #[pymodule_export]
    use crate::shims::shims;
    #[pymodule_export]
    use crate::state::State;
    #[pymodule_export]
    use crate::stepped_vehicle::Vehicle;
    #[pymodule_export]
    use crate::sweep::Study;
    #[pymodule_export]
    use crate::vehicle::{VehicleRun, vehicle};
    #[pymodule_export]
    use crate::verify::verify;
}
