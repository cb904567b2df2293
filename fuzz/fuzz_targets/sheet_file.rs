//! Reads any text as a sheet file. Either it is refused, or a bench can run its tests and each limit can be
//! satisfied.
#![no_main]

use dashpot_files::sheet::SheetParameters;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let Ok(sheet) = SheetParameters::parse("fuzz.toml", text) else {
        return;
    };
    assert!(!sheet.tests.is_empty());
    for test in &sheet.tests {
        assert!(test.motion.check().is_ok());
        for limit in &test.limits {
            let end = limit.min.or(limit.max);
            assert!(end.is_some() && limit.is_kept(end));
        }
    }
});
