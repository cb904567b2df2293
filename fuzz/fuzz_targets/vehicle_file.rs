//! Reads any text as a vehicle file. Either it is refused, or its modes are refused, or all natural frequencies are
//! finite.
#![no_main]

use dashpot_files::vehicle;
use dashpot_rail::vehicle::Standstill;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    if let Ok(vehicle) = vehicle::parse("fuzz.toml", text, &[])
        && let Ok(standstill) = Standstill::new(&vehicle)
        && let Ok(modes) = standstill.modes()
    {
        assert!(modes.iter().all(|mode| mode.undamped_hz().is_finite()));
    }
});
