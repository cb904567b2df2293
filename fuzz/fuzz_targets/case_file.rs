//! Reads any text as a case file. Either it is refused, or its faults concern its dampers and have increasing times
//! within the case.
#![no_main]

use dashpot_files::case::CaseOptions;
use dashpot_rail::vehicle::Law;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let Ok(case) = CaseOptions::parse("fuzz.toml", text).and_then(|options| options.case()) else {
        return;
    };
    assert!(case.speed_m_per_s > 0.0 && case.step_s > 0.0);
    assert!(case.start_m < case.end_m());
    let mut time_s = 0.0;
    for fault in &case.faults {
        assert!(fault.time_s >= time_s && fault.time_s <= case.duration_s);
        time_s = fault.time_s;
        let element = &case.vehicle.elements[fault.element];
        assert!(element.name == fault.damper && matches!(element.law, Law::Damper { .. }));
    }
});
