//! Reads any text as an actuator file. Either it is refused, or every value is in its range.
#![no_main]

use dashpot_files::actuator::ActuatorParameters;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let Ok(actuator) = ActuatorParameters::parse("fuzz.toml", text) else {
        return;
    };
    assert_eq!(actuator.check(), Ok(()));
});
